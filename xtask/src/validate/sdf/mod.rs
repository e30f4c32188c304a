//! Suite `sdf`: one surface said in several ways – formula, triangles, grid of distances – and what a grain feels of each.

pub mod bench;
mod cost;
mod distance;
mod grazing;
mod moving;
mod rebound;
mod rest;
pub mod shapes;
mod slide;
mod trial;
mod walls;

use super::report::Report;

/// Grain-steps of `--full`: mostly a million steps of rest on each of a dozen surfaces.
pub const FULL_GRAIN_STEPS: f64 = 2.5e7;

/// Runs every check.
pub fn run(report: &mut Report) -> Result<(), String> {
    report.progress("distances of grids against formulas");
    distance::run(report)?;
    report.progress("rebounds");
    rebound::run(report)?;
    report.progress("sliding down an incline");
    slide::run(report)?;
    report.progress("rest");
    rest::run(report)?;
    report.progress("grazing impacts");
    grazing::run(report)?;
    report.progress("walls that move");
    moving::run(report)?;
    report.progress("cost of a query");
    cost::run(report)
}
