//! Order in Δt of the restitution averaged over the phase of first touch, and the spread over it.

use super::pair::head_on;
use crate::validate::check::Tolerance;
use crate::validate::lab::name;
use crate::validate::report::Report;
use crate::validate::wca::{Wca, coke, grain};
use tsubu_integrate::Scheme;
use tsubu_picture::Figure;

const ZETA: f64 = 0.35;
const PHASES: u32 = 64;
const SPEED: f64 = 0.1;
/// From where physics is resolved (K = 0.1) to where the mean over 64 phases still stands out of the
/// remainder of the spread.
const STEPS_PER_PERIOD: [f64; 4] = [20.0, 40.0, 80.0, 160.0];

/// More of them for the figure of the spread, which depends on how a contact fits into whole steps.
const MORE_STEPS_PER_PERIOD: [f64; 13] = [
    20.0, 24.0, 28.0, 33.0, 40.0, 48.0, 57.0, 67.0, 80.0, 95.0, 113.0, 134.0, 160.0,
];

/// e − e_exact over the phases of first touch: mean, lowest, highest.
#[derive(Clone, Copy)]
struct Error {
    mean: f64,
    low: f64,
    high: f64,
}

fn error(scheme: Scheme, zeta: f64, steps_per_period: f64) -> Error {
    let mass = 0.5 * grain().mass;
    let wca = Wca::of(&coke(0.0));
    let damping = 2.0 * zeta * (wca.edge_stiffness() * mass).sqrt();
    // The reference is a converged fine integration: the closed form of the linear spring is off by
    // the potential's own curvature.
    let exact = wca.restitution(mass, damping, SPEED);
    let dt = wca.period(mass) / steps_per_period;
    let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
    for k in 0..PHASES {
        let phase = (f64::from(k) + 0.5) / f64::from(PHASES);
        let e = head_on(grain(), &coke(damping), scheme, dt, SPEED, phase)
            .map_or(f64::NAN, |r| r.restitution);
        sum += e - exact;
        (low, high) = (low.min(e - exact), high.max(e - exact));
    }
    Error {
        mean: sum / f64::from(PHASES),
        low,
        high,
    }
}

/// Slope of log|y| on log x by least squares.
pub fn slope(x: &[f64], y: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> = x
        .iter()
        .zip(y)
        .map(|(x, y)| (x.ln(), y.abs().ln()))
        .collect();
    let n = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let (top, bottom) = points.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - mx) * (p.1 - my), s.1 + (p.0 - mx).powi(2))
    });
    top / bottom
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let old = (
        1.0,
        Tolerance::Absolute(0.2),
        "damping from the old velocity is first order",
    );
    let averaged = (
        2.0,
        Tolerance::Absolute(0.3),
        "damping from the averaged velocity is second order",
    );
    let implicit = (
        1.0,
        Tolerance::Information,
        "damping from the new velocity: first order, told only",
    );
    let cases = [
        (Scheme::SymplecticEuler, old),
        (Scheme::VerletOld, old),
        (Scheme::VerletAveraged { sweeps: 4 }, averaged),
        (Scheme::DashpotImplicit { sweeps: 4 }, implicit),
    ];
    let mut figure = Figure::new(
        "Error of e at ζ = 0.35, mean over 64 phases",
        "steps per period (–)",
        "|e − e exact| (–)",
    )
    .log_x()
    .log_y();
    for (scheme, (expected, tolerance, why)) in cases {
        let errors: Vec<Error> = STEPS_PER_PERIOD
            .iter()
            .map(|&n| error(scheme, ZETA, n))
            .collect();
        let mean: Vec<f64> = errors.iter().map(|e| e.mean).collect();
        let order = -slope(&STEPS_PER_PERIOD, &mean);
        let scheme_name = name(scheme);
        report.check(
            format!("order of e in the step, {scheme_name}"),
            expected,
            order,
            tolerance,
            why,
        );
        for (n, e) in [
            (STEPS_PER_PERIOD[0], errors[0]),
            (STEPS_PER_PERIOD[2], errors[2]),
        ] {
            report.tell(
                format!("  mean error of e at {n} steps per period, {scheme_name}"),
                e.mean,
                "",
            );
            report.tell(
                format!("  spread of e over 64 phases at {n}, {scheme_name}"),
                e.high - e.low,
                "",
            );
        }
        let size: Vec<f64> = mean.iter().map(|e| e.abs()).collect();
        figure = figure.points(&scheme_name, &STEPS_PER_PERIOD, &size, None);
    }
    let ends = [STEPS_PER_PERIOD[0], STEPS_PER_PERIOD[3]];
    for (order, at) in [(1, 0.023), (2, 0.0045)] {
        let line = ends.map(|n| at * (ends[0] / n).powi(order));
        figure = figure.line(&format!("slope {order}"), &ends, &line);
    }
    report.figure("collision_order", figure)?;
    // Paper A's coke at its usual step: stable is not accurate.
    for scheme in [
        Scheme::SymplecticEuler,
        Scheme::VerletAveraged { sweeps: 4 },
    ] {
        let e = error(scheme, 0.0347, 20.0);
        let what = format!("error of e, coke at 20 steps per period, {}", name(scheme));
        report.beside(
            format!("{what}: lowest"),
            -0.007,
            e.low,
            "theory note: −0.7 %",
        );
        report.beside(
            format!("{what}: highest"),
            0.024,
            e.high,
            "theory note: +2.4 %",
        );
    }
    spread(report)
}

/// The figure of the spread over the phases; SymplecticEuler gives the same numbers as VerletOld.
fn spread(report: &Report) -> Result<(), String> {
    if !report.full() {
        return Ok(());
    }
    let mut figure = Figure::new(
        "Error of e at ζ = 0.35: spread over 64 phases of first touch",
        "steps per period (–)",
        "e − e exact (–)",
    )
    .log_x();
    let sweeps = 4;
    for scheme in [
        Scheme::VerletOld,
        Scheme::VerletAveraged { sweeps },
        Scheme::DashpotImplicit { sweeps },
    ] {
        let errors = MORE_STEPS_PER_PERIOD.map(|n| error(scheme, ZETA, n));
        let (mean, low, high) = (
            errors.map(|e| e.mean),
            errors.map(|e| e.low),
            errors.map(|e| e.high),
        );
        let label = name(scheme);
        figure = figure
            .band(&label, &MORE_STEPS_PER_PERIOD, &low, &high)
            .line(&label, &MORE_STEPS_PER_PERIOD, &mean);
    }
    report.figure("collision_spread", figure)
}
