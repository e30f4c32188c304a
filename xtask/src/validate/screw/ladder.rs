//! The λ ladder: one pitch of the screw in its tube, without ends, at n = 4, 3 and 2, and the whole feeder at n = 4 and 3.
//!
//! Renormalisation keeps stiffness over d, stress and restitution, but not a gap of a few d': the clearance of 12.3 mm is
//! 0.57, 1.14 and 2.3 d'. The section says what that does to the flow alone: it has no hopper that may starve the
//! screw, and holds the same mass of grains at every level.

use super::levels::levels;
use super::section::{CASING, DENSITY, Found, PITCH, Rung, SCENE, SHAFT, most, per_turn};
use crate::validate::check::Tolerance;
use crate::validate::kept::{self, Measured};
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use rayon::prelude::*;

/// Turns of a run, and of the rungs that are held against each other: all as long as five turns of n = 2, eleven minutes of
/// one core. At n = 4 and 3 the axial speed differs between the two by 0.3 % at most.
const TURNS: f64 = 8.0;
const TURNS_OF_LADDER: f64 = 5.0;

/// Densest packing of equal balls (Kepler, proved by Hales), π/√18.
const DENSEST: f64 = 0.740_480_5;

/// Grain-steps of the rungs: those of two of n = 2, and a fifth of that for the others.
pub const GRAIN_STEPS: f64 = 5.1e10;

/// The section at n = 4, and with `--full` the ladder. `feeder` is the whole feeder at n = 4 and 60 r/min.
pub fn run(report: &mut Report, feeder: &Measured) -> Result<(), String> {
    formula(report);
    // Coarse level, r/min, turns.
    let wanted: &[(u32, f64, f64)] = if report.full() {
        &[
            (2, 60.0, TURNS_OF_LADDER),
            (3, 60.0, TURNS_OF_LADDER),
            (4, 60.0, TURNS_OF_LADDER),
            (3, 60.0, TURNS),
            (4, 60.0, TURNS),
            (3, 100.0, TURNS),
            (4, 100.0, TURNS),
        ]
    } else {
        &[(4, 60.0, TURNS)]
    };
    let rungs: Vec<Rung> = wanted
        .iter()
        .flat_map(|&(coarse, rpm, turns)| {
            [false, true].map(|at_centres| Rung {
                coarse,
                rpm,
                turns,
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
    let (ladder, long): (Vec<Found>, Vec<Found>) = found
        .into_iter()
        .partition(|f| f.rung.turns == TURNS_OF_LADDER);
    if let Some(one) = long.iter().find(|f| f.rung.coarse == 4) {
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
    for short in &ladder {
        longer(report, short, &long);
    }
    if ladder.is_empty() {
        return Ok(());
    }
    levels(report, &ladder)
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

/// What more turns change: how far from steady the ladder is.
fn longer(report: &mut Report, short: &Found, long: &[Found]) {
    let same = |f: &&Found| {
        let (a, b) = (f.rung, short.rung);
        (a.coarse, a.rpm, a.at_centres) == (b.coarse, b.rpm, b.at_centres)
    };
    if let Some(other) = long.iter().find(same) {
        report.beside(
            format!(
                "{}: axial efficiency, beside that after {} turns",
                short.rung.name(),
                other.rung.turns
            ),
            other.efficiency().0,
            short.efficiency().0,
            "what is left of the start in the rungs of the ladder, of which only the coarser ones could run on",
        );
    }
}

/// The two readings of where a grain touches a wall.
fn offsets(report: &mut Report, surface: &Found, centre: &Found) {
    let Rung {
        coarse, rpm, turns, ..
    } = surface.rung;
    let name = format!("section, n = {coarse}, {rpm} r/min, {turns} turns");
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
    let tube = "mass_rate_from_section";
    let ((a, ea), (b, eb)) = (surface.get(tube), centre.get(tube));
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
