//! Grains that turn: the torque belongs to the tangential force, and what rolls does not rub.

use super::history::Moment;
use super::report::{Breach, Check, Worst};
use super::states::{Case, State, directions, moment, parts, rolled, scattered, size, turns};
use tsubu_model::{ContactLaw, Dim, Numbers, SpinState, Vector};

/// Twist = −n × f, f the whole force. Rounding of the products only: 1e-12 of the parts.
pub(super) fn twists<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Twist);
    if !turns::<D, S>() {
        return None;
    }
    for history in case.histories(0.0) {
        case.walk(&history, |Moment { state, push, .. }| {
            let expected = -moment::<D>(state.normal(), push.total());
            let twist = S::to_space::<D>(push.twist);
            worst.see((twist - expected).length(), 1e-12 * size(&push), || {
                format!(
                    "twist {twist:?} N, −n × force = {expected:?} N (in space), {}",
                    case.words(state)
                )
            });
        });
    }
    worst.breach()
}

/// No tangential force while two grains roll on each other without slip, v = −n × (r_a ω_a + r_b ω_b).
/// If the pair turns as one body at Ω, v = Ω × apart and both spins Ω, lever arms of r_a + r_b leave a slip of (r_a + r_b − r) Ω
/// at an overlap: then at most the force that this slip has.
///
/// Beside that the rounding of the two velocities that cancel, 1e-13 of what either alone would give, and of the normal force.
pub(super) fn rolls<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Rolling);
    if !turns::<D, S>() {
        return None;
    }
    let omega = 0.01 * case.rate;
    for overlap in super::states::OVERLAPS {
        for (i, n) in directions::<D::V>().enumerate() {
            let apart = n * (case.range * (1.0 - overlap));
            let turn = scattered::<S::Turn<D>>(300 + i as u64) * omega;
            let spin = turn * case.range;
            let rolling = State {
                apart,
                velocity: -rolled::<D, S>(n, spin),
                spin,
                roll: turn,
            };
            rubs_at_most(case, rolling, 0.0, "rolling without slip", &mut worst);
            if case.is_wall() {
                continue;
            }
            let reach = case.at(rolling).reach;
            let one_body = State {
                apart,
                velocity: -rolled::<D, S>(apart, turn),
                spin: turn * reach,
                roll: S::Turn::<D>::ZERO,
            };
            let slip = (reach - apart.length()).abs() * turn.length();
            rubs_at_most(case, one_body, slip, "turning as one body", &mut worst);
        }
    }
    worst.breach()
}

/// The tangential force over three steps, against that of a slip.
fn rubs_at_most<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    state: State<D, S>,
    slip: f64,
    what: &str,
    worst: &mut Worst,
) {
    let mut memory = L::Memory::zero();
    let (touch, n) = (case.at(state), state.normal());
    for step in 1..=3 {
        let push = L::force(&case.pair, &touch, &mut memory, case.dt);
        let linear = L::linear(&case.pair, &touch, case.dt);
        let answer =
            linear.tangential_damping + linear.tangential_stiffness * case.dt * f64::from(step);
        let rubbing: f64 = parts(&push)
            .iter()
            .map(|&(_, part)| (part - n * part.dot(n)).length())
            .sum();
        let most = answer * slip;
        let rounding = 1e-13 * (answer * state.spin.length() + size(&push)) + 1e-9 * most;
        worst.see((rubbing - most).max(0.0), rounding, || {
            format!(
                "{what}: tangential force {rubbing:e} N, at most {most:e} N expected, {}",
                case.words(state)
            )
        });
        worst.demand(!rubbing.is_nan(), || {
            format!("{what}: tangential force {rubbing}, {}", case.words(state))
        });
    }
}
