//! Explicit Euler is there to fail: it grows without damping at every step, and only much damping tames it.

use super::limits::{STEPS, claimed};
use super::pressed::{Arrangement, Case, Contact};
use crate::validate::check::Tolerance;
use crate::validate::lab::Lab;
use crate::validate::report::Report;
use crate::validate::wca::{Wca, coke, grain};
use glam::DVec3;
use tsubu_integrate::Scheme;
use tsubu_model::View;

/// Growth of the energy of an undamped wall contact per step, at so many steps per period.
fn growth_per_step(steps_per_period: f64) -> f64 {
    let wca = Wca::of(&coke(0.0));
    let mass = grain().mass;
    let dt = wca.period(mass) / steps_per_period;
    let load = 1e-5 * wca.range() * wca.edge_stiffness();
    let rest = wca.at_rest_under(load);
    let stiff = wca.stiffness(rest);
    let mut lab = Lab::new(grain(), coke(0.0), Scheme::ExplicitEuler, dt).wall(
        DVec3::ZERO,
        DVec3::Z,
        None,
        0.0,
    );
    lab.gravity = DVec3::Z * (-load / mass);
    let speed = 1e-9 * wca.range() * (stiff / mass).sqrt();
    let mut world = lab
        .grain(DVec3::Z * (rest - grain().radius), DVec3::Z * speed)
        .world();
    let energy = |x: f64, v: f64| stiff * (x + grain().radius - rest).powi(2) + mass * v * v;
    let before = energy(world.position(0).z, world.velocity(0).z);
    let steps = 100;
    world.advance(steps);
    let after = energy(world.position(0).z, world.velocity(0).z);
    (after / before).powf(1.0 / steps as f64)
}

/// The checks.
pub fn run(report: &mut Report) {
    for steps_per_period in [20.0, 100.0, 1000.0] {
        let turn = std::f64::consts::TAU / steps_per_period;
        report.check(
            format!("explicit Euler without damping, {steps_per_period} steps per period: energy per step"),
            1.0 + turn * turn,
            growth_per_step(steps_per_period),
            Tolerance::Relative(1e-3),
            "|z|² = 1 + K; the contact's curvature at an overlap of 1e-5 is 2e-4 of K",
        );
    }
    // K < C and C < 2 + K/2. Above the first the growth per step is only εC/2, so ζ is not small here.
    for zeta in [0.4, 0.7, 1.5] {
        let case = Case {
            scheme: Scheme::ExplicitEuler,
            arrangement: Arrangement::Column(1),
            contact: Contact::Repulsion(zeta),
        };
        let dt = claimed(&case, |k, c| case.scheme.limit().used(k, c)).unwrap_or(f64::NAN);
        let (k, c) = case.numbers(dt);
        report.check(
            format!(
                "limit at a wall, ExplicitEuler, K = {k:.3}, C = {c:.3}: Δt found over claimed"
            ),
            1.0,
            case.found(dt, STEPS),
            Tolerance::Absolute(0.01),
            "as for the other schemes",
        );
    }
}
