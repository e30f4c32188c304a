//! `linear` against slopes taken numerically from the force.

use super::Friction;
use super::report::{Breach, Check, Worst};
use super::states::{Case, State, frame, rolled, scattered, turns};
use tsubu_model::{ContactLaw, Dim, Numbers, SpinState, Vector};

/// Normal stiffness and damping are slopes of the normal force at rest. The tangential pair is held
/// to the force of a first step at a small slip, Ft = −(ηt + kt Δt) vt: the slope of a smooth law, and
/// the equivalent dashpot of one that slips.
///
/// A law that remembers may count its overlap step by step, so its normal pair is held to the force of a step too:
/// from a pressed contact at rest −dF = (ηn + kn Δt) dv, at two steps, which tells the one from the other.
///
/// All differences are central with relative width 1e-4 (stiffness; 1e-5 in a step) and 1e-2 (damping, linear in v);
/// both the truncation and the rounding k·r·1e-16 over that width stay below 1e-7, so 1e-6 it is.
pub(super) fn linear<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    friction: Option<Friction>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Linear);
    for (i, overlap) in [1e-3, 1e-2, 5e-2].into_iter().enumerate() {
        let (n, t) = frame::<D::V>(i as u64);
        if L::Memory::N == 0 {
            normal_at_rest(case, n, overlap, &mut worst);
        } else {
            normal_in_a_step(case, n, overlap, &mut worst);
        }
        let turn = scattered::<S::Turn<D>>(700 + i as u64);
        let slip = rolled::<D, S>(n, turn).length();
        let v = 1e-2 * case.rate * case.range * overlap;
        tangential(
            case,
            friction,
            n,
            overlap,
            (t * v, S::Turn::<D>::ZERO),
            &mut worst,
        );
        if turns::<D, S>() {
            let by_spin = (D::V::ZERO, turn * (v / slip));
            tangential(case, friction, n, overlap, by_spin, &mut worst);
        }
    }
    worst.breach()
}

/// One number of the linearisation against the one from the force.
fn compare<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    worst: &mut Worst,
    state: State<D, S>,
    name: &str,
    [got, expected]: [f64; 2],
    floor: f64,
) {
    worst.see(
        (got - expected).abs(),
        1e-6 * expected.abs() + floor,
        || {
            let at = case.words(state);
            format!("{name} = {got:e}, from the force {expected:e} (SI units), {at}")
        },
    );
}

/// No law damps less than 1e-8 of critical and means it; that floor carries the rounding.
fn floor<D: Dim, S: SpinState, L: ContactLaw<D, S>>(case: &Case<D, S, L>) -> f64 {
    1e-8 * case.mass * case.rate
}

fn normal_at_rest<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    n: D::V,
    overlap: f64,
    worst: &mut Worst,
) {
    let (r, delta) = (case.range * (1.0 - overlap), case.range * overlap);
    let state = |r: f64, vn: f64| State::moving(n * r, n * vn);
    let normal = |r: f64, vn: f64| case.push(state(r, vn)).total().dot(n);
    let rest = L::linear(&case.pair, &case.at(state(r, 0.0)), case.dt);
    let mut compare = |name, got, expected, floor| {
        compare(case, worst, state(r, 0.0), name, [got, expected], floor);
    };

    let h = 1e-4 * delta;
    let slope = -(normal(r + h, 0.0) - normal(r - h, 0.0)) / (2.0 * h);
    compare("normal_stiffness", rest.normal_stiffness, slope, 0.0);

    let v = 1e-2 * case.rate * delta;
    let slope = -(normal(r, v) - normal(r, -v)) / (2.0 * v);
    compare("normal_damping", rest.normal_damping, slope, floor(case));
}

fn normal_in_a_step<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    n: D::V,
    overlap: f64,
    worst: &mut Worst,
) {
    let (still, memory) = case.pressed(n, overlap);
    // Small enough that not even thirty times critical damping pulls.
    let h = 1e-5 * overlap * case.range;
    for dt in [case.dt, 0.25 * case.dt] {
        let moved = |by: f64| {
            let state = State::moving(still.apart + n * by, n * (by / dt));
            let push = L::force(&case.pair, &case.at(state), &mut memory.clone(), dt);
            push.total().dot(n)
        };
        let answer = -(moved(h) - moved(-h)) / (2.0 * h) * dt;
        let linear = L::linear(&case.pair, &case.at(still), dt);
        let listed = linear.normal_damping + linear.normal_stiffness * dt;
        let name = "normal_damping + normal_stiffness·Δt";
        compare(case, worst, still, name, [listed, answer], floor(case));
    }
}

/// The answer to a slip, by the motion of the centres or by the spin.
fn tangential<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    friction: Option<Friction>,
    n: D::V,
    overlap: f64,
    (velocity, spin): (D::V, S::Turn<D>),
    worst: &mut Worst,
) {
    let (still, memory) = if L::Memory::N == 0 {
        let apart = n * (case.range * (1.0 - overlap));
        (State::at_rest(apart), L::Memory::zero())
    } else {
        case.pressed(n, overlap)
    };
    let sliding = State {
        velocity,
        spin,
        ..still
    };
    let surface = sliding.surface_velocity();
    let speed = surface.length();
    let steps = if L::Memory::N == 0 { 1 } else { 2 };
    for dt in [case.dt, 0.25 * case.dt].into_iter().take(steps) {
        let touch = case.at(sliding);
        let linear = L::linear(&case.pair, &touch, dt);
        let listed = linear.tangential_damping + linear.tangential_stiffness * dt;
        let push = L::force(&case.pair, &touch, &mut memory.clone(), dt);
        let answer = -push.total().dot(surface) / (speed * speed);
        let limit = friction.map_or(f64::INFINITY, |f| f.coefficient * push.elastic.dot(n));
        // Where friction has its say the linearisation is a bound.
        let expected = if listed * speed > 1.01 * limit {
            answer.max(listed)
        } else {
            answer
        };
        let name = "tangential_damping + tangential_stiffness·Δt";
        compare(case, worst, sliding, name, [listed, expected], floor(case));
    }
}
