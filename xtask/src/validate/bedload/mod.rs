//! Suite `bedload`: paper B's law, its water and its movable bed against closed forms and measured transport.

mod beds;
mod collisions;
mod flume;
mod knobs;
mod lab;
mod nearest;
mod packing;
mod rolling;
mod threshold;
mod transport;
mod usable;

use super::check::Tolerance;
use super::report::Report;
use beds::Beds;
use lab::SAND;
use tsubu_contact::SpringDashpot;
use tsubu_stream::{Sediment, Setting, Stream, Water};

/// The long version: some 700 beds, most of 400 grains and half a million steps.
pub const FULL_GRAIN_STEPS: f64 = 3.0e11;

/// The suite.
pub fn run(report: &mut Report) -> Result<(), String> {
    constants(report)?;
    drag(report)?;
    collisions::run(report);
    rolling::run(report);
    report.progress("collisions and rolling");
    threshold::run(report)?;
    report.progress("thresholds");
    let root = report.root().to_owned();
    let beds = Beds::new(&root)?;
    transport::shipped(report, &beds)?;
    report.progress("the shipped bed");
    if !report.full() {
        return Ok(());
    }
    transport::converged(report, &beds)?;
    transport::against_shields(report, &beds)?;
    packing::run(report)?;
    nearest::run(report, &beds)?;
    knobs::run(report, &beds)?;
    usable::run(report, &beds)
}

/// The constants that paper B prints, in SI, with the added mass in m.
fn constants(report: &mut Report) -> Result<(), String> {
    let sand = Water::fresh()
        .grain(&Sediment::quartz(SAND))
        .map_err(|e| e.to_string())?;
    let law = SpringDashpot::from_time_step(2.0e-4, sand.mass, 20.0, 1.0, 0.3, 0.577);
    for (name, printed, got) in [
        ("kn, N/m", 2.54e2, law.normal_stiffness),
        ("ks, N/m", 9.78e1, law.tangential_stiffness),
        ("ηn, kg/s", 4.58e-1, law.normal_damping),
        ("ηs, kg/s", 2.84e-1, law.tangential_damping),
    ] {
        report.check(
            format!("constants of Δt = 2.0e-4 s, d = 0.5 mm: {name}"),
            printed * 1e-3,
            got,
            Tolerance::Relative(2e-3),
            "three printed digits; the paper prints them with mass in grams, a thousand times larger",
        );
    }
    Ok(())
}

/// Drag of the mean flow over submerged weight.
fn drag(report: &mut Report) -> Result<(), String> {
    let water = Stream::new(Setting::over_grains(SAND, 0.05, 1)).map_err(|e| e.to_string())?;
    for (where_, y, expected) in [("d/2", 0.5 * SAND, 12.0), ("0", 0.0, 3.33)] {
        report.check(
            format!("drag over submerged weight per τ*, y = {where_}"),
            expected,
            water.drag_over_weight(y),
            Tolerance::Relative(5e-3),
            "worked by hand to three digits",
        );
    }
    Ok(())
}
