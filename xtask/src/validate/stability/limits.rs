//! The closed-form limits of `integrate` against the engine: the Δt between growth and decay is searched for.

use super::pressed::{Arrangement, Case, Contact, frequency};
use crate::validate::check::Tolerance;
use crate::validate::lab::name;
use crate::validate::report::Report;
use tsubu_integrate::{Packing, Scheme};

/// Steps in which growth must show: just above the limit it is 4ε/C per step, a hundredfold for ε > 2e-4 C.
pub const STEPS: u64 = 8000;

/// Why 1 %.
const NOTE: &str = "1 % asked; the search resolves 0.02 % and growth shows above 0.02 % of C";

/// What `integrate` knows of an arrangement.
pub fn packing(arrangement: Arrangement) -> Option<Packing> {
    match arrangement {
        Arrangement::Column(1) => Some(Packing::OneWallContact),
        Arrangement::Column(n) => Some(Packing::Column(n)),
        Arrangement::Pair => Some(Packing::Pair),
        Arrangement::FaceCentredCubic => Some(Packing::FaceCentredCubic),
        Arrangement::Hexagonal => None,
    }
}

/// The Δt at which a claimed limit is used up, by halving; `used` grows with Δt.
/// None if there is no such step below 50 over the frequency.
pub fn claimed(case: &Case, used: impl Fn(f64, f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = (1e-9 / frequency(), 50.0 / frequency());
    let (k, c) = case.numbers(high);
    if used(k, c) < 1.0 {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let (k, c) = case.numbers(middle);
        if used(k, c) < 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

/// The Δt that `integrate` claims for an arrangement that it knows.
pub fn claimed_of_packing(case: &Case) -> Option<f64> {
    let packing = packing(case.arrangement)?;
    let limit = case.scheme.limit();
    claimed(case, |k, c| limit.used_by_packing(k, c, packing))
}

/// The checks.
pub fn run(report: &mut Report) {
    let old = [Scheme::SymplecticEuler, Scheme::VerletOld];
    let solves = [
        Scheme::VerletAveraged { sweeps: 4 },
        Scheme::DashpotImplicit { sweeps: 4 },
    ];
    for scheme in old.into_iter().chain(solves) {
        for zeta in [0.0, 0.0347, 0.3, 1.0, 3.0] {
            found(report, scheme, Arrangement::Column(1), zeta);
        }
    }
    for scheme in old {
        for zeta in [0.0, 0.3, 1.0] {
            found(report, scheme, Arrangement::Pair, zeta);
        }
    }
    for n in 2..=8 {
        found(report, Scheme::SymplecticEuler, Arrangement::Column(n), 0.3);
    }
    found(report, Scheme::VerletOld, Arrangement::Column(8), 0.3);
}

fn found(report: &mut Report, scheme: Scheme, arrangement: Arrangement, zeta: f64) {
    let case = Case {
        scheme,
        arrangement,
        contact: Contact::Repulsion(zeta),
    };
    let dt = claimed_of_packing(&case).unwrap_or(f64::NAN);
    let (k, c) = case.numbers(dt);
    let what = format!(
        "limit of {arrangement:?}, {}, K = {k:.3}, C = {c:.3}: Δt found over claimed",
        name(scheme)
    );
    report.check(
        what,
        1.0,
        case.found(dt, STEPS),
        Tolerance::Absolute(0.01),
        NOTE,
    );
}
