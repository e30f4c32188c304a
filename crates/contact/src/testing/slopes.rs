//! `linear` against slopes taken numerically from the force.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, frame};
use tsubu_model::{ContactLaw, Dim, Still, Vector};

/// Normal stiffness and damping are slopes of the normal force at rest. The tangential pair is held
/// to the force of a first step at a small slip, Ft = −(ηt + kt Δt) vt: the slope of a smooth law, and
/// the equivalent dashpot of one that slips.
///
/// All differences are central with relative width 1e-4 (stiffness) and 1e-2 (damping, linear in v);
/// both the truncation and the rounding k·r·1e-15 over that width stay below 1e-8, so 1e-6 it is.
pub(super) fn linear<D: Dim, L: ContactLaw<D, Still>>(case: &Case<D, L>) -> Option<Breach> {
    let mut worst = Worst::of(Check::Linear);
    for (i, overlap) in [1e-3, 1e-2, 5e-2].into_iter().enumerate() {
        let (n, t) = frame::<D::V>(i as u64);
        let (r, delta) = (case.range * (1.0 - overlap), case.range * overlap);
        let state = |r: f64, vn: f64, vt: f64| State {
            apart: n * r,
            velocity: n * vn + t * vt,
        };
        let normal = |r: f64, vn: f64| case.push(state(r, vn, 0.0)).total().dot(n);
        let rest = L::linear(&case.pair, &case.at(state(r, 0.0, 0.0)), case.dt);

        let h = 1e-4 * delta;
        let slope = -(normal(r + h, 0.0) - normal(r - h, 0.0)) / (2.0 * h);
        let mut compare = |name: &str, got: f64, expected: f64, floor: f64| {
            worst.see(
                (got - expected).abs(),
                1e-6 * expected.abs() + floor,
                || {
                    let at = case.words(state(r, 0.0, 0.0));
                    format!("{name} = {got:e}, from the force {expected:e} (SI units), {at}")
                },
            );
        };
        compare("normal_stiffness", rest.normal_stiffness, slope, 0.0);

        // No law damps less than 1e-8 of critical and means it; that floor carries the rounding.
        let floor = 1e-8 * case.mass * case.rate;
        let v = 1e-2 * case.rate * delta;
        let slope = -(normal(r, v) - normal(r, -v)) / (2.0 * v);
        compare("normal_damping", rest.normal_damping, slope, floor);

        let sliding = state(r, 0.0, v);
        let there = L::linear(&case.pair, &case.at(sliding), case.dt);
        let answer = there.tangential_damping + there.tangential_stiffness * case.dt;
        let slope = -case.push(sliding).total().dot(t) / v;
        compare(
            "tangential_damping + tangential_stiffness·Δt",
            answer,
            slope,
            floor,
        );
    }
    worst.breach()
}
