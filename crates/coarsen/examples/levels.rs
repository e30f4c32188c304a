//! Paper A's coke at the coarse levels n = 0…4 under the three rules.
//!
//! ```text
//! cargo run -p tsubu-coarsen --example levels
//! ```
//!
//! k is the contact stiffness, ζ that of a pair, e its restitution by the linear spring, the step a
//! twentieth of the real pair's period times the rule's factor, the cost that of one second at n = 0.

use std::error::Error;
use std::f64::consts::TAU;
use tsubu_coarsen::{CoarseRule, Level, RadlRestitution, Renormalised, SakaiKoshizuka, coarsen};
use tsubu_contact::{Repulsion, restitution};
use tsubu_model::Kind;

fn main() -> Result<(), Box<dyn Error>> {
    let grain = Kind::sphere(1.350e-3, 1370.0);
    let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
    let reduced = 0.5 * grain.mass;
    let step = TAU * (reduced / coke.stiffness()).sqrt() / 20.0;
    let radl = RadlRestitution::new(restitution::at_zero_overlap(coke.damping_ratio(reduced)))?;

    for rule in [&Renormalised as &dyn CoarseRule, &SakaiKoshizuka, &radl] {
        println!("{} ({})", rule.name(), rule.source());
        println!(
            "  n  d', mm  m', kg     E = k'/sigma', Pa  gamma', kg/s  zeta    e       dt', s     cost"
        );
        for n in 0..=4 {
            let level = Level::new(n);
            match coarsen(rule, &coke, level) {
                Ok(law) => row(rule, level, &coarsen(rule, &grain, level)?, &law, step),
                Err(refused) => println!("  {n}  {refused}"),
            }
        }
        println!();
    }
    Ok(())
}

/// One line of the table.
fn row(rule: &dyn CoarseRule, level: Level, grain: &Kind, law: &Repulsion, step: f64) {
    let zeta = law.damping_ratio(0.5 * grain.mass);
    let (lambda, factor) = (level.lambda(), rule.step_factor(level.lambda()));
    println!(
        "  {}  {:<6.2}  {:.3e}  {:<17.3e}  {:<12.4}  {zeta:.4}  {:.4}  {:.3e}  {:.2e}",
        level.n(),
        grain.diameter() * 1e3,
        grain.mass,
        law.stiffness() / law.sigma,
        law.normal_damping,
        restitution::at_zero_overlap(zeta),
        step * factor,
        1.0 / (lambda.powi(3) * factor),
    );
}
