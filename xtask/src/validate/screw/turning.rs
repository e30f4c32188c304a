//! What turns Coulomb grains with the screw, in one pitch without ends: seconds a run, and no hopper that could starve it.
//!
//! Grains that turn with the screw at Ω are not advanced by p n but by p (n − Ω/2π). Roberts' theory says how far a filling
//! turns that slides on the flight with the friction of the wall and is held by nothing else: at the flight's edge
//! 1/(1 + tan α tan(α + φ)) of p n is left, with tan α = p/(2πR) and tan φ = μ, and with the speed around the axis the same
//! at every radius 1 − (1 − that) · 2/(1 + Rs/R) over the annulus. A casing that holds the grains lifts it, a clearance whose
//! grains stay behind lowers it, so it is told beside and nothing is held to it.

use super::friction::{FRICTION, RPM};
use super::runs::Case;
use super::section::{FLIGHT, PITCH, SCENE, SHAFT};
use crate::validate::kept::Measured;
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

/// Of a run.
const TURNS: f64 = 8.0;

/// Axial speed over p n of a filling that slides on a screw of this friction, `Roberts1999`.
fn roberts(friction: f64) -> f64 {
    let alpha = (PITCH / (2.0 * PI * FLIGHT)).atan();
    let edge = 1.0 / (1.0 + alpha.tan() * (alpha + friction.atan()).tan());
    1.0 - (1.0 - edge) * 2.0 / (1.0 + SHAFT / FLIGHT)
}

/// The section at n = 4, one thing changed at a time. `own` is the fingerprint of runs of these grains.
pub fn run(report: &mut Report, root: &Path, own: u64) -> Result<(), String> {
    let case = Case {
        soften: 1000.0,
        ..Case::of(4, RPM)
    };
    let formula = "walls.screw.shape=Screw(from: (\"-150 mm\", \"0 mm\", \"0 mm\"), to: (\"300 mm\", \"0 mm\", \"0 mm\"), shaft: \"55 mm\", outer: \"205 mm\", pitch: \"150 mm\", thickness: \"6 mm\")";
    let stiff = Case {
        soften: 100.0,
        ..case
    };
    let turning = |friction: f64| case.with_coulomb(friction).law(0);
    let with = |set: &str| [turning(FRICTION), vec![set.to_owned()]].concat();
    // What is changed, and the friction of the screw.
    let runs = [
        ("μ = 0.413 everywhere", FRICTION, turning(FRICTION)),
        (
            "μ = 0.2 at the screw",
            0.2,
            with("walls.screw.friction=0.2"),
        ),
        (
            "μ = 0.6 at the screw",
            0.6,
            with("walls.screw.friction=0.6"),
        ),
        (
            "μ = 0.2 at the casing",
            FRICTION,
            with("walls.casing.friction=0.2"),
        ),
        (
            "μ = 1 at the casing",
            FRICTION,
            with("walls.casing.friction=1"),
        ),
        ("μ = 0 between grains", FRICTION, turning(0.0)),
        ("μ = 0.1 between grains", FRICTION, turning(0.1)),
        ("μ = 0.2 between grains", FRICTION, turning(0.2)),
        ("μ = 0.6 between grains", FRICTION, turning(0.6)),
        (
            "1.63 kg in the pitch",
            FRICTION,
            with("initial.fill.solid_fraction=0.15"),
        ),
        (
            "2.17 kg in the pitch",
            FRICTION,
            with("initial.fill.solid_fraction=0.2"),
        ),
        (
            "3.03 kg in the pitch",
            FRICTION,
            with("initial.fill.solid_fraction=0.28"),
        ),
        (
            "e = 0.9 between grains",
            FRICTION,
            with("grains.law.constants.restitution=0.9"),
        ),
        ("half the step", FRICTION, with("time.step=PerPeriod(40)")),
        ("the screw by formula", FRICTION, with(formula)),
        (
            "ten times stiffer",
            FRICTION,
            stiff.with_coulomb(FRICTION).law(0),
        ),
        ("n = 3", FRICTION, with("grains.coarse=3")),
    ];
    let found = runs
        .par_iter()
        .map(|(what, _, sets)| {
            let file = root.join(format!(
                "target/validate/screw/{own:016x}-turning-{}.csv",
                what.replace(' ', "-")
            ));
            let until = [format!("time.until={TURNS} s")];
            let source = changed(&root.join(SCENE), &[&sets[..], &until].concat())?;
            match Measured::kept(&file) {
                Some(measured) => Ok(measured),
                None => Measured::of_run(&source, &file, None, 1),
            }
        })
        .collect::<Result<Vec<_>, String>>()?;
    for ((what, friction, _), found) in runs.iter().zip(&found) {
        let (value, error) = found.get("axial_efficiency");
        report.beside(
            format!("section, 60 r/min, {what}: axial speed over p n, beside Roberts' annulus"),
            roberts(*friction),
            value,
            &format!("± {error:.4}; n = 4, 2.75 kg and μ = 0.413 unless said; theory knows the friction of the screw alone"),
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_annulus_turns_as_roberts_has_it() {
        // Worked by hand: α = 13.11°; at μ = 0.413, φ = 22.44° and 0.857 is left at the edge.
        for (friction, left) in [(0.2, 0.849), (0.413, 0.775), (0.6, 0.710)] {
            assert!(
                (roberts(friction) - left).abs() < 1e-3,
                "{friction}: {}",
                roberts(friction)
            );
        }
    }
}
