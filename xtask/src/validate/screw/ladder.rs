//! The λ ladder: one pitch of the screw in its tube, without ends, at n = 4, 3 and 2, and the whole feeder at n = 4 and 3.
//!
//! Renormalisation keeps stiffness over d, stress and restitution, but not a gap of a few d': the clearance of 12.3 mm is
//! 0.57, 1.14 and 2.3 d'. The section says what that does to the flow alone: it has no hopper that may starve the
//! screw, and holds the same mass of grains at every level.
//!
//! A wall that is touched at the centres (s = R) acts as one that is touched at the surface (s = R + d'/2) and stands
//! δ = d'/2 further in. The most a screw can carry, area × pitch, over (π/4)(Ds² − ds²) p is then
//! C(δ) = ((Rc − δ)² − (rs + δ)²)/(R² − rs²) · (p − t − 2δ)/p, with R, rs and Rc the radii of flight, shaft and casing, p the
//! pitch and t the thickness of the flight; C(0) = 1.22. Both readings are given the same share of that room, because the
//! same mass does not fit: at n = 4 it would take a solid fraction of 0.56 of the room, where the hopper's bed has 0.52.

use super::kept::{self, Measured};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use rayon::prelude::*;
use std::path::Path;
use tsubu_picture::Figure;

/// The shipped scene.
const SCENE: &str = "scenarios/screw_section.ron";

/// Grain-steps of the rungs: two of n = 2 for 4 turns, four of n = 3 and of n = 4 for 8 turns.
pub const GRAIN_STEPS: f64 = 4.0e10;

/// Radii of flight, shaft and casing, pitch and thickness of the flight, m.
const FLIGHT: f64 = 0.1025;
const SHAFT: f64 = 0.0275;
const CASING: f64 = 0.1148;
const PITCH: f64 = 0.150;
const THICKNESS: f64 = 0.006;

/// Density of the solid, kg/m³, and mass of the grains in a pitch where walls are touched at the surface, kg.
const DENSITY: f64 = 1370.0;
const MASS: f64 = 2.75;
/// Volume of the box that the scene fills, m³.
const BOX: f64 = PITCH * 4.0 * CASING * CASING;
/// Densest packing of equal balls (Kepler, proved by Hales), π/√18.
const DENSEST: f64 = 0.740_480_5;

/// The most a screw can carry over (π/4)(Ds² − ds²) p, its walls moved in by δ in m.
fn most(inward: f64) -> f64 {
    let area = (CASING - inward).powi(2) - (SHAFT + inward).powi(2);
    area / (FLIGHT * FLIGHT - SHAFT * SHAFT) * (PITCH - THICKNESS - 2.0 * inward) / PITCH
}

/// Volume that a full screw moves per turn, m³.
fn per_turn() -> f64 {
    std::f64::consts::PI * (FLIGHT * FLIGHT - SHAFT * SHAFT) * PITCH
}

/// One run of the section.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rung {
    coarse: u32,
    rpm: f64,
    /// Walls are touched at the centres.
    at_centres: bool,
}

impl Rung {
    fn name(&self) -> String {
        let place = if self.at_centres {
            "s = R"
        } else {
            "s = R + d/2"
        };
        format!("section, n = {}, {} r/min, {place}", self.coarse, self.rpm)
    }

    fn lambda(&self) -> f64 {
        f64::from(1u32 << self.coarse)
    }

    /// Diameter of a coarse grain, m.
    fn diameter(&self) -> f64 {
        1.350e-3 * self.lambda()
    }

    /// The room of the screw over (π/4)(Ds² − ds²) p.
    fn most(&self) -> f64 {
        let inward = if self.at_centres {
            0.5 * self.diameter()
        } else {
            0.0
        };
        most(inward)
    }

    /// Mass of grains, kg: the same share of the room.
    fn mass(&self) -> f64 {
        MASS * self.most() / most(0.0)
    }

    /// Turns from the start of the screw; four of n = 2 take some ten minutes of one core.
    fn turns(&self) -> f64 {
        if self.coarse < 3 { 4.0 } else { 8.0 }
    }

    fn sets(&self) -> Vec<String> {
        let place = if self.at_centres { "Centre" } else { "Surface" };
        vec![
            format!("grains.coarse={}", self.coarse),
            format!("walls.screw.motion.turn.rate=-{} rpm", self.rpm),
            format!("walls.screw.touches_at={place}"),
            format!("walls.casing.touches_at={place}"),
            format!(
                "initial.fill.solid_fraction={}",
                self.mass() / DENSITY / BOX
            ),
            format!("time.until={} s", 60.0 * self.turns() / self.rpm),
        ]
    }

    fn measured(&self, root: &Path, fingerprint: u64) -> Result<Measured, String> {
        let Rung { coarse, rpm, .. } = self;
        let place = if self.at_centres { "centre" } else { "surface" };
        let file = root.join(format!(
            "target/validate/screw/{fingerprint:016x}-section-n{coarse}-{rpm}rpm-{place}-{}turns.csv",
            self.turns()
        ));
        match Measured::kept(&file) {
            Some(measured) => Ok(measured),
            None => {
                eprintln!("  {} …", self.name());
                Measured::of_run(&changed(&root.join(SCENE), &self.sets())?, &file)
            }
        }
    }
}

/// A rung and what it gave.
struct Found {
    rung: Rung,
    measured: Measured,
}

impl Found {
    /// Mass rate with its error, kg/s.
    fn rate(&self) -> (f64, f64) {
        self.measured.get("mass_rate")
    }

    /// Axial speed over p n, with the error of the rate, which is that of the same sum.
    fn efficiency(&self) -> (f64, f64) {
        let (rate, error) = self.rate();
        let value = self.measured.get("axial_efficiency").0;
        (value, value * error / rate)
    }
}

/// The section at n = 4, and with `--full` the ladder. `feeder` is the whole feeder at n = 4 and 60 r/min.
pub fn run(report: &mut Report, feeder: &Measured) -> Result<(), String> {
    formula(report);
    let speeds: &[(f64, &[u32])] = if report.full() {
        &[(60.0, &[2, 3, 4]), (100.0, &[3, 4])]
    } else {
        &[(60.0, &[4])]
    };
    let rungs: Vec<Rung> = speeds
        .iter()
        .flat_map(|&(rpm, levels)| levels.iter().map(move |&coarse| (coarse, rpm)))
        .flat_map(|(coarse, rpm)| {
            [false, true].map(|at_centres| Rung {
                coarse,
                rpm,
                at_centres,
            })
        })
        .collect();
    let root = report.root().to_owned();
    let print = kept::fingerprint(&changed(&root.join(SCENE), &[])?)?;
    let found = rungs
        .into_par_iter()
        .map(|rung| {
            let measured = rung.measured(&root, print)?;
            Ok(Found { rung, measured })
        })
        .collect::<Result<Vec<_>, String>>()?;
    report.progress("the section is run");
    for found in &found {
        limits(report, found);
    }
    for pair in found.chunks_exact(2) {
        offsets(report, &pair[0], &pair[1]);
    }
    if let Some(one) = found.iter().find(|f| f.rung.coarse == 4) {
        let name = one.rung.name();
        report.beside(
            format!("{name}: axial efficiency beside that in the tube of the whole feeder"),
            feeder.get("axial_efficiency").0,
            one.efficiency().0,
            "the same screw; the feeder's tube is 1.5 pitches long and fed by a hopper",
        );
        report.tell(
            format!("{name}: filling ratio a with the bulk density of the whole feeder's hopper"),
            one.rung.mass() / feeder.get("hopper_bulk_density").0 / per_turn(),
            "the section has no hopper of its own",
        );
    }
    if report.full() {
        levels(report, &found)?;
    }
    Ok(())
}

/// The room of the screw against the numbers that are known of it.
fn formula(report: &mut Report) {
    let half = 0.5 * 10.8e-3;
    for (name, expected, inward) in [("0", 1.22, 0.0), ("d'/2 at n = 3", 0.99, half)] {
        report.check(
            format!(
                "most that the screw carries over (π/4)(Ds² − ds²) p, walls moved in by {name}"
            ),
            expected,
            most(inward),
            Tolerance::Absolute(0.005),
            "area times pitch, by hand to two decimals",
        );
    }
}

/// What must hold of any rung.
fn limits(report: &mut Report, found: &Found) {
    let (rung, name) = (found.rung, found.rung.name());
    let (rate, rate_error) = found.rate();
    let (efficiency, error) = found.efficiency();
    let ring = std::f64::consts::PI * (CASING * CASING - SHAFT * SHAFT) * PITCH;
    let grain = DENSITY * std::f64::consts::PI / 6.0 * rung.diameter().powi(3);
    report.check(
        format!("{name}: mass in the section, kg"),
        rung.mass(),
        found.measured.get("solid_fraction").0 * ring * DENSITY,
        Tolerance::Absolute(grain),
        "to a grain; none is lost or counted twice at the ends of the period",
    );
    report.check(
        format!("{name}: axial speed over p n, less three of its errors"),
        1.0,
        efficiency - 3.0 * error,
        Tolerance::AtMost,
        "grains between two turns of a flight cannot overtake them",
    );
    let room = rung.most() * per_turn() * rung.rpm / 60.0 * DENSITY;
    report.check(
        format!("{name}: rate over what the room carries at one pitch per turn, in solid"),
        DENSEST,
        (rate - 3.0 * rate_error) / room,
        Tolerance::AtMost,
        "equal balls pack no denser than π/√18",
    );
    report.tell(
        format!("{name}: mass rate, kg/s"),
        rate,
        &format!("± {rate_error:.4}"),
    );
    report.tell(
        format!("{name}: axial efficiency"),
        efficiency,
        &format!("axial speed over p n; ± {error:.4}"),
    );
    let (around, around_error) = found.measured.get("tangential_speed");
    report.tell(
        format!("{name}: tangential speed, m/s"),
        around,
        &format!("± {around_error:.4}"),
    );
    let (torque, torque_error) = found.measured.get("screw_torque");
    report.tell(
        format!("{name}: torque, N m"),
        torque,
        &format!("of one pitch; ± {torque_error:.3}"),
    );
    report.tell(
        format!("{name}: steady from, s"),
        found.measured.get("steady_from").0,
        "NaN if the rate was not steady; counted from the first look, the screw starts some 0.1 s later",
    );
}

/// The two readings of where a grain touches a wall.
fn offsets(report: &mut Report, surface: &Found, centre: &Found) {
    let name = format!(
        "section, n = {}, {} r/min",
        surface.rung.coarse, surface.rung.rpm
    );
    let ((a, ea), (b, eb)) = (surface.rate(), centre.rate());
    report.beside(
        format!("{name}: rate with s = R over that with s = R + d/2"),
        centre.rung.most() / surface.rung.most(),
        b / a,
        &format!(
            "expected: C(d'/2)/C(0), the same share of the room at the same efficiency; ± {:.4}",
            b / a * (ea / a).hypot(eb / b)
        ),
    );
}

/// The two readings in the whole feeder, which draws what it can.
pub fn offsets_of_feeder(report: &mut Report, coarse: u32, surface: &Measured, centre: &Measured) {
    let half = 0.5 * 1.350e-3 * f64::from(1u32 << coarse);
    let ((a, ea), (b, eb)) = (surface.get("mass_rate"), centre.get("mass_rate"));
    report.beside(
        format!("feeder, n = {coarse}, 60 r/min: rate with s = R over that with s = R + d/2"),
        most(half) / most(0.0),
        b / a,
        &format!(
            "expected: C(d'/2)/C(0), the same share of the room at the same efficiency; ± {:.4}",
            b / a * (ea / a).hypot(eb / b)
        ),
    );
}

/// A straight line in λ through two levels, taken to λ = 1: value and error.
///
/// With f(λ) = f₀ + c λ and two measured values at λ and 2λ, f(1) = f(λ) − (f(2λ) − f(λ))(λ − 1)/λ.
fn at_real_grain(lambda: f64, fine: (f64, f64), coarse: (f64, f64)) -> (f64, f64) {
    let share = (lambda - 1.0) / lambda;
    (
        fine.0 - (coarse.0 - fine.0) * share,
        ((1.0 + share) * fine.1).hypot(share * coarse.1),
    )
}

/// The ladder at 60 r/min: order, extrapolation, figures.
fn levels(report: &mut Report, found: &[Found]) -> Result<(), String> {
    let mut efficiency = Figure::new(
        "One pitch of the screw at 60 r/min, n = 2, 3, 4",
        "grain diameter d' (mm)",
        "axial speed over p n (–)",
    );
    let mut rate = Figure::new(
        "One pitch of the screw at 60 r/min, n = 2, 3, 4",
        "grain diameter d' (mm)",
        "mass rate (kg/s)",
    );
    for (at_centres, place) in [(false, "s = R + d/2"), (true, "s = R")] {
        // From n = 2 up.
        let rungs: Vec<&Found> = found
            .iter()
            .filter(|f| f.rung.rpm == 60.0 && f.rung.at_centres == at_centres)
            .collect();
        let x: Vec<f64> = rungs.iter().map(|f| f.rung.diameter() * 1e3).collect();
        let values: Vec<(f64, f64)> = rungs.iter().map(|f| f.efficiency()).collect();
        let rates: Vec<(f64, f64)> = rungs.iter().map(|f| f.rate()).collect();
        let [fine, middle, coarse] = values[..] else {
            return Err("the ladder has three rungs".into());
        };
        let order = ((coarse.0 - middle.0) / (middle.0 - fine.0)).log2();
        report.tell(
            format!("ladder, 60 r/min, {place}: order of the axial efficiency in λ"),
            order,
            "log2 of the ratio of its changes from n = 4 to 3 and from 3 to 2; NaN if they differ in sign",
        );
        let lambda = rungs[0].rung.lambda();
        let (at_one, error) = at_real_grain(lambda, fine, middle);
        report.tell(
            format!("ladder, 60 r/min, {place}: axial efficiency taken to λ = 1"),
            at_one,
            &format!(
                "straight in λ through n = 3 and n = 2, whatever the order; ± {error:.4} of the two"
            ),
        );
        let (rate_at_one, rate_error) = at_real_grain(lambda, rates[0], rates[1]);
        report.tell(
            format!("ladder, 60 r/min, {place}: mass rate taken to λ = 1, kg/s"),
            rate_at_one,
            &format!("as above; ± {rate_error:.4}"),
        );
        let line = [1.350, x[1]];
        let (y, e): (Vec<f64>, Vec<f64>) = values.into_iter().unzip();
        efficiency = efficiency.points(place, &x, &y, Some(&e)).line(
            &format!("{place}: straight in λ to n = 0"),
            &line,
            &[at_one, middle.0],
        );
        let middle = rates[1].0;
        let (y, e): (Vec<f64>, Vec<f64>) = rates.into_iter().unzip();
        rate = rate.points(place, &x, &y, Some(&e)).line(
            &format!("{place}: straight in λ to n = 0"),
            &line,
            &[rate_at_one, middle],
        );
    }
    report.figure("screw_ladder", efficiency)?;
    report.figure("screw_ladder_rate", rate)
}

/// The whole feeder at 60 r/min: what changes from n = 4 to n = 3, and where a straight line goes.
pub fn feeder(report: &mut Report, n3: &Measured, n4: &Measured) {
    for (what, words) in [
        ("mass_rate", "mass rate, kg/s"),
        ("ratio_to_theory", "rate over theory at a = 1"),
        ("fill_ratio", "filling ratio a"),
        ("axial_efficiency", "axial efficiency"),
    ] {
        let (fine, coarse) = (n3.get(what), n4.get(what));
        let error = fine.0 / coarse.0 * (fine.1 / fine.0).hypot(coarse.1 / coarse.0);
        report.tell(
            format!("feeder, 60 r/min: {words}, n = 3 over n = 4"),
            fine.0 / coarse.0,
            &format!("± {error:.3}"),
        );
        let (value, error) = at_real_grain(8.0, fine, coarse);
        report.tell(
            format!("feeder, 60 r/min: {words}, taken to λ = 1"),
            value,
            &format!(
                "straight in λ through n = 4 and n = 3, an assumption; ± {error:.3} of the two"
            ),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_taken_to_the_real_grain() {
        // 1 − 0.01 λ is 0.99 at λ = 1; its error is that of 2 × fine less coarse, a little less.
        let (value, error) = at_real_grain(4.0, (0.96, 0.1), (0.92, 0.0));
        assert!((value - 0.99).abs() < 1e-12 && (error - 0.175).abs() < 1e-12);
    }

    #[test]
    fn the_room_shrinks_with_the_grain_as_worked_by_hand() {
        // d' = 21.6 mm: (104.0² − 38.3²)/9750 · 122.4/150.
        assert!((most(0.0108) - 0.7825).abs() < 1e-4);
        assert!((most(0.0027) - 1.1044).abs() < 1e-4);
        assert!((per_turn() - 4.5946e-3).abs() < 1e-7);
    }
}
