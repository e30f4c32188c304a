//! Where the force is nothing: at and beyond the range, and for the dummy that fills short lists.

use super::history::listed;
use super::report::{Breach, Check, Worst};
use super::states::{Case, State, axis, directions, parts, scattered};
use tsubu_model::{ContactLaw, Dim, Linear, Numbers, SpinState, Vector};

/// Exactly zero from the range on. `range` is one root away from what a law compares, so the
/// nearest distance tried is four units in the last place beyond it.
pub(super) fn nothing_beyond<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Range);
    let near = [
        1.0 + 4.0 * f64::EPSILON,
        1.0 + 1e-12,
        1.0 + 1e-6,
        1.1,
        2.0,
        100.0,
    ];
    let far = [1e29, 1e30, 3e30];
    let distances = near.map(|r| r * case.range).into_iter().chain(far);
    for distance in distances {
        for (i, direction) in directions::<D::V>().enumerate() {
            for fast in [0.0, 1.0].map(|fast| fast * case.range * case.rate) {
                exactly_nothing(
                    case,
                    State {
                        apart: direction * distance,
                        velocity: scattered::<D::V>(i as u64) * fast,
                        spin: scattered::<S::Turn<D>>(i as u64) * fast,
                        roll: scattered::<S::Turn<D>>(i as u64) * (fast / case.range),
                    },
                    &mut worst,
                );
            }
        }
    }
    worst.breach()
}

fn exactly_nothing<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    state: State<D, S>,
    worst: &mut Worst,
) {
    let touch = case.at(state);
    // A contact that has ended may still remember something.
    let mut memory = L::Memory::zero();
    for k in 0..L::Memory::N {
        memory.set(k, 1.0);
    }
    let push = L::force(&case.pair, &touch, &mut memory, case.dt);
    for (name, part) in parts(&push) {
        worst.demand(part == D::V::ZERO, || {
            format!("{name} force = {part:?} N {}", case.words(state))
        });
    }
    worst.demand(push.twist == S::Turn::<D>::ZERO, || {
        format!("twist = {:?} N {}", push.twist, case.words(state))
    });
    worst.demand(push.couple == S::Turn::<D>::ZERO, || {
        format!("couple = {:?} N m {}", push.couple, case.words(state))
    });
    let left = listed(&memory);
    worst.demand(left.iter().all(|&x| x == 0.0), || {
        format!("{left:?} is still remembered {}", case.words(state))
    });
    let stored = case.stored(state);
    worst.demand(stored == 0.0, || {
        format!("stored = {stored:e} J {}", case.words(state))
    });
    let linear = L::linear(&case.pair, &touch, case.dt);
    worst.demand(linear == Linear::default(), || {
        format!("{linear:?} {}", case.words(state))
    });
}

/// The force of resting grains grows from zero: at an overlap δ it is at most 2kδ, k the law's own
/// slope there (kδ for a spring, ⅔kδ for Hertz). A jump of the force at the range is far above.
pub(super) fn begins_gently<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Rest);
    for overlap in [1e-9, 1e-6] {
        let state = State::at_rest(axis::<D::V>(D::UP) * (case.range * (1.0 - overlap)));
        let force = case.push(state).total().length();
        let slope = L::linear(&case.pair, &case.at(state), case.dt).normal_stiffness;
        // The distance is known to a few units of its last place.
        let rounding = 1e-14 * case.stiffness * case.range;
        let most = 2.0 * slope * overlap * case.range + rounding;
        worst.see(force, most, || {
            format!(
                "force = {force:e} N, at most {most:e} N expected, {}",
                case.words(state)
            )
        });
    }
    worst.breach()
}
