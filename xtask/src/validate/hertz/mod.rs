//! Suite `hertz`: law Hertz–Mindlin through the engine, against closed forms, a published benchmark and measurements.

mod angles;
mod bulk;
mod coarse;
mod column;
mod curves;
mod elastic;
mod grazing;
mod hoppers;
mod impact;
mod lab;
mod on_wall;
mod pile;
mod restitution;
mod rolling;
mod slips;
mod spinning;
mod theory;

use super::report::Report;

/// Grain-steps of `--full`: the short version and the curves of the figures, two columns, three silos, a rectangular hopper and four
/// bins.
pub const FULL_GRAIN_STEPS: f64 = 2.5e9;

/// Every check.
pub fn run(report: &mut Report) -> Result<(), String> {
    elastic::run(report)?;
    report.progress("elastic impacts");
    restitution::run(report)?;
    report.progress("restitution");
    angles::run(report)?;
    slips::run(report)?;
    report.progress("oblique impacts");
    spinning::run(report)?;
    report.progress("spinning spheres");
    grazing::run(report);
    report.progress("grazing impacts");
    rolling::run(report);
    report.progress("sliding and rolling");
    pile::run(report);
    report.progress("piles of three");
    coarse::run(report)?;
    report.progress("coarse grains");
    column::small_heap(report)?;
    report.progress("a heap in the plane");
    if !report.full() {
        return Ok(());
    }
    column::collapse(report)?;
    report.progress("column collapse");
    hoppers::janssen(report)?;
    report.progress("silo");
    hoppers::rectangular(report)?;
    report.progress("rectangular hopper");
    hoppers::beverloo(report)?;
    Ok(())
}

/// The largest size of these, or not a number if one is none.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values
        .map(f64::abs)
        .fold(0.0, |most, by| if by.is_nan() { by } else { by.max(most) })
}
