//! The linear solves of the averaged and the implicit dashpot: a fixed number of sweeps, so a limit of their own.

use super::limits::{STEPS, claimed, claimed_of_packing};
use super::pressed::{Arrangement, Case, Contact, frequency};
use crate::validate::check::Tolerance;
use crate::validate::lab::{Lab, name};
use crate::validate::report::Report;
use crate::validate::wca::{GAMMA, Wca, coke, grain};
use glam::DVec3;
use tsubu_integrate::{Scheme, relative_mode_gain};

/// Share of the limit that the pair's relative mode uses with the documented gain g on stiffness and
/// damping: the step is that of the old velocity with gK/(1 + θC) and gC/(1 + θC), θ = ½ for the
/// averaged and 1 for the implicit dashpot (K and C on the reduced mass).
fn used_as_built(scheme: Scheme, k: f64, c: f64) -> f64 {
    let theta = scheme.kick() * c;
    let gain = relative_mode_gain(theta, scheme.sweeps()) / (1.0 + theta);
    gain * (k + 2.0 * c) / 4.0
}

/// The checks.
pub fn run(report: &mut Report) {
    let averaged = |sweeps| Scheme::VerletAveraged { sweeps };
    let implicit = |sweeps| Scheme::DashpotImplicit { sweeps };
    for scheme in [
        averaged(1),
        averaged(2),
        averaged(4),
        implicit(1),
        implicit(2),
        implicit(4),
    ] {
        for zeta in [0.3, 1.0] {
            limit_as_built(
                report,
                Case {
                    scheme,
                    arrangement: Arrangement::Pair,
                    contact: Contact::Repulsion(zeta),
                },
                zeta,
            );
        }
        for (arrangement, words) in [
            (Arrangement::Pair, "Pair"),
            (Arrangement::Column(8), "Column(8)"),
        ] {
            exact_solve(report, scheme, arrangement, words);
        }
    }
    residual(report);
}

/// A pair against the limit with the documented gain. A pair has twice K and C of one grain.
fn limit_as_built(report: &mut Report, case: Case, zeta: f64) {
    let scheme = case.scheme;
    if let Some(dt) = claimed(&case, |k, c| used_as_built(scheme, 2.0 * k, 2.0 * c)) {
        let (k, c) = case.numbers(dt);
        report.check(
            format!(
                "limit of Pair as built, {}, K = {:.3}, C = {:.3}: Δt found over claimed",
                name(scheme),
                2.0 * k,
                2.0 * c
            ),
            1.0,
            case.found(dt, STEPS),
            Tolerance::Absolute(0.01),
            "the documented gain of a solve that stops early; 1 % as for the other limits",
        );
    } else {
        // Stopped this early, the gain falls faster than K grows: no step is too long.
        let dt = [1.0, 3.0, 10.0].map(|turn| turn / frequency());
        let grown = dt.into_iter().filter(|&dt| case.grows(dt, STEPS)).count();
        report.check(
            format!(
                "no limit of Pair as built, {}, ζ = {}: steps of 1, 3, 10 √(m/k) that grow",
                name(scheme),
                zeta
            ),
            0.0,
            grown as f64,
            Tolerance::AtMost,
            "by the documented gain every step is stable",
        );
    }
}

/// An even number of sweeps never tightens the limit of the exact solve: nothing grows just below it.
fn exact_solve(report: &mut Report, scheme: Scheme, arrangement: Arrangement, words: &str) {
    let mut worst = f64::INFINITY;
    for zeta in [0.1, 0.3, 1.0] {
        let case = Case {
            scheme,
            arrangement,
            contact: Contact::Repulsion(zeta),
        };
        let dt = claimed_of_packing(&case).unwrap_or(f64::NAN);
        let shares = [0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99];
        let first = shares
            .into_iter()
            .find(|share| case.grows(share * dt, STEPS))
            .unwrap_or(1.0);
        worst = worst.min(first);
    }
    let even = scheme.sweeps().is_multiple_of(2);
    let tolerance = if even {
        Tolerance::AtLeast
    } else {
        Tolerance::Information
    };
    report.check(
        format!("{words}, {}: share of the exact solve's limit without growth (ζ 0.1, 0.3, 1)", name(scheme)),
        1.0,
        worst,
        tolerance,
        "looked at 0.5…0.99 of the limit; 1 = no growth at any. An odd number of sweeps may fall short",
    );
}

/// How far the sweeps are from their end at paper A's coke and the usual step.
fn residual(report: &mut Report) {
    let wca = Wca::of(&coke(GAMMA));
    let mass = 0.5 * grain().mass;
    let dt = wca.period(mass) / 20.0;
    for scheme in [1, 2, 4].map(|sweeps| Scheme::VerletAveraged { sweeps }) {
        let half = DVec3::X * (0.5 * 0.9999 * wca.range());
        let v = DVec3::X * 0.5;
        let mut world = Lab::new(grain(), coke(GAMMA), scheme, dt)
            .grain(half, -v)
            .grain(-half, v)
            .world();
        world.advance(1);
        let name = format!(
            "last change of a velocity over the speed, coke at 20 steps per period, {}",
            name(scheme)
        );
        report.tell(name, world.solve_residual() / v.x, "residual of the solve");
    }
}
