//! Suite `stability`: where each scheme fails, on contacts that a load keeps closed.

pub mod edges;
mod euler;
mod guard;
pub mod limits;
pub mod network;
pub mod pressed;
mod solves;

use super::report::Report;

/// Grain-steps of `--full`, which does what the quick version does.
pub const FULL_GRAIN_STEPS: f64 = 5e7;

/// Runs every check.
pub fn run(report: &mut Report) -> Result<(), String> {
    report.progress("limits in closed form");
    limits::run(report);
    euler::run(report);
    report.progress("solves");
    solves::run(report);
    report.progress("1.02 and 0.98 of the limit");
    edges::run(report);
    report.progress("200 stable and 200 unstable scenes");
    guard::run(report)
}
