//! Suite `coarsen`: what coarse-graining keeps, and that what it does not keep changes by the stated power of λ.
//!
//! The rival rules run through the same cases; their rows are to read, not to pass.

mod binary;
mod column;
mod creep;
mod gas;

use super::report::Report;
use super::wca::{Wca, coke, grain};
use tsubu_coarsen::{CoarseRule, Level, RadlRestitution, Renormalised, SakaiKoshizuka, coarsen};
use tsubu_contact::Repulsion;
use tsubu_contact::restitution::at_zero_overlap;
use tsubu_model::Kind;

/// Grain-steps of `--full`: the settling column at n = 0 under two rules, and the gas.
pub const FULL_GRAIN_STEPS: f64 = 4.2e9;

/// A grain, its law and its step at a coarse level.
struct Coarse {
    kind: Kind,
    law: Repulsion,
    dt: f64,
    lambda: f64,
}

/// Paper A's grain softened by `soften` with damping ratio `zeta` of a pair, at level `n` under `rule`;
/// the step is the rule's factor times a `steps_per_period`-th of the period at n = 0.
fn level(
    rule: &dyn CoarseRule,
    soften: f64,
    zeta: f64,
    steps_per_period: f64,
    n: u32,
) -> Result<Coarse, String> {
    let mass = 0.5 * grain().mass;
    let elastic = coke(0.0).softened(soften, 1.0, 1.0);
    let wca = Wca::of(&elastic);
    let damping = 2.0 * zeta * (wca.edge_stiffness() * mass).sqrt();
    let law = coke(damping).softened(soften, 1.0, 1.0);
    let level = Level::new(n);
    let lambda = level.lambda();
    let refused = |e: tsubu_coarsen::TooCoarse| e.to_string();
    Ok(Coarse {
        kind: coarsen(rule, &grain(), level).map_err(refused)?,
        law: coarsen(rule, &law, level).map_err(refused)?,
        dt: wca.period(mass) / steps_per_period * rule.step_factor(lambda),
        lambda,
    })
}

/// The three rules, for grains of damping ratio `zeta`.
fn rules(zeta: f64) -> Result<Vec<Box<dyn CoarseRule>>, String> {
    let radl = RadlRestitution::new(at_zero_overlap(zeta)).map_err(|e| e.to_string())?;
    Ok(vec![
        Box::new(Renormalised),
        Box::new(SakaiKoshizuka),
        Box::new(radl),
    ])
}

/// Runs every check.
pub fn run(report: &mut Report) -> Result<(), String> {
    report.progress("binary collision");
    binary::run(report)?;
    report.progress("creep of a sheared lattice");
    creep::run(report)?;
    report.progress("a cooling gas");
    gas::run(report)?;
    report.progress("a settled column");
    column::run(report)
}
