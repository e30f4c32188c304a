//! Head-on collisions of two grains in both readings of "no tension" against their closed forms.

use super::lab::lab;
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec2;
use std::f64::consts::PI;
use tsubu_contact::{SpringDashpot, Tension, restitution};
use tsubu_model::{Kind, View};

const D: f64 = 1e-3;
const MASS: f64 = 1e-6;
const STIFFNESS: f64 = 100.0;
const SPEED: f64 = 0.01;

/// Damping ratios of reference/theory.md §4.1 and one below.
const RATIOS: [f64; 8] = [0.1, 0.3, 0.7, 0.9, 1.0, 1.3, 1.838, 5.0];

/// Restitution and duration of contact in 1/ω, at steps of h/ω. The two begin just apart; one that does not end within
/// `most`/ω is cut there.
fn collide(zeta: f64, tension: Tension, h: f64, most: f64) -> (f64, f64) {
    let (reduced, kind) = (0.5 * MASS, Kind::with_mass(D, MASS));
    let omega = (STIFFNESS / reduced).sqrt();
    let damping = 2.0 * zeta * (STIFFNESS * reduced).sqrt();
    let law = SpringDashpot::new(STIFFNESS, 0.4 * STIFFNESS, damping, 0.6 * damping, 0.5);
    let dt = h / omega;
    let gap = 0.5 * SPEED * dt;
    let at = |side: f64| {
        (
            DVec2::X * side * 0.5 * (D + gap),
            DVec2::X * -side * 0.5 * SPEED,
        )
    };
    let mut run = lab(
        kind,
        law.tension(tension),
        Vec::new(),
        DVec2::ZERO,
        dt,
        &[at(-1.0), at(1.0)],
    );
    let speed = |run: &super::lab::Lab| {
        let of = |identity: u32| {
            (0..2)
                .find(|&i| run.identity(i) == identity)
                .map_or(f64::NAN, |i| run.velocity(i).x)
        };
        of(1) - of(0)
    };
    let (mut steps, mut before) = (0u64, speed(&run));
    for _ in 0..(most / h) as u64 {
        run.advance(1);
        let now = speed(&run);
        // The first step only closes the gap.
        steps += u64::from(now != before);
        if steps > 0 && now == before {
            break;
        }
        before = now;
    }
    (before / SPEED, steps as f64 * h)
}

/// Duration in 1/ω that ends at zero force.
fn duration_at_zero_force(zeta: f64) -> f64 {
    let gap = 1.0 - zeta * zeta;
    if gap.abs() < 1e-12 {
        2.0
    } else if gap > 0.0 {
        2.0 * zeta.acos() / gap.sqrt()
    } else {
        2.0 * zeta.acosh() / (-gap).sqrt()
    }
}

/// All ratios, and the order in the step.
pub fn run(report: &mut Report) {
    let h = 1e-4;
    for zeta in RATIOS {
        let (e, time) = collide(zeta, Tension::NoPull, h, 100.0);
        report.check(
            format!("no_pull, ζ = {zeta}: restitution"),
            restitution::at_zero_force(zeta),
            e,
            Tolerance::Relative(2.0 * zeta.max(1.0) * h),
            "first order: one kick of the dashpot is 2ζh of the speed, h = 1e-4",
        );
        report.check(
            format!("no_pull, ζ = {zeta}: duration in 1/ω"),
            duration_at_zero_force(zeta),
            time,
            Tolerance::Absolute(2.0 * (1.0 + zeta) * h),
            "two steps at either end, more where the end is flat",
        );
        let (e, time) = collide(zeta, Tension::AsPrinted, h, 100.0);
        if zeta < 1.0 {
            let root = (1.0 - zeta * zeta).sqrt();
            let slack = 1.0 + PI * zeta * zeta / root.powi(3);
            report.check(
                format!("as_printed, ζ = {zeta}: restitution"),
                restitution::at_zero_overlap(zeta),
                e,
                Tolerance::Relative(slack * h),
                "the old velocity acts as ζ + ζ²h/2",
            );
            report.check(
                format!("as_printed, ζ = {zeta}: duration in 1/ω"),
                PI / root,
                time,
                Tolerance::Absolute((2.0 + PI * zeta.powi(3) / root.powi(3)) * h),
                "as above",
            );
        } else {
            report.check(
                format!("as_printed, ζ = {zeta}: speed left after 100/ω over that of the impact"),
                1e-4,
                e.abs(),
                Tolerance::AtMost,
                "overdamped: the grains stay glued; the slower rate at ζ = 5 leaves e^-10",
            );
        }
    }
    let expected = restitution::at_zero_force(0.3);
    let error = |h: f64| (collide(0.3, Tension::NoPull, h, 100.0).0 / expected - 1.0).abs();
    // The phase of the first touch is the same in all: half a step of way.
    let order = (error(4e-3) / error(1e-3)).log2() / 2.0;
    report.check(
        "no_pull, ζ = 0.3: order of the restitution in the step",
        1.0,
        order,
        Tolerance::Absolute(0.1),
        "damping from the old velocity is of first order",
    );
}
