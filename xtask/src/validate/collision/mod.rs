//! Suite `collision`: two grains, a grain on a wall, a row and a small pile, all through the engine as built.

mod bits;
mod budget;
pub mod order;
pub mod pair;
mod row;
mod wall;

use super::report::Report;

/// Grain-steps of `--full`: mostly the row's million steps at three lengths of step.
pub const FULL_GRAIN_STEPS: f64 = 2e8;

/// Runs every check.
pub fn run(report: &mut Report) -> Result<(), String> {
    report.progress("pair against quadrature");
    pair::run(report);
    report.progress("order in the step");
    order::run(report)?;
    report.progress("walls: restitution and friction");
    wall::run(report)?;
    report.progress("a periodic row");
    row::run(report)?;
    report.progress("energy budget of a collapsing pile");
    budget::run(report)?;
    report.progress("bits");
    bits::run(report)
}
