//! Exchange of the grains, to the bit; rotation and mirror image of the pair, to rounding.

use super::history::{listed, same};
use super::report::{Breach, Check, Worst};
use super::states::{Case, State, mirrored, mirrored_axial, parts, reach, size, touch, turned};
use tsubu_model::{ContactLaw, Dim, Numbers, SpinState, Vector};

/// Each side computes the contact for itself, so momentum is kept to the bit only if the law is odd
/// to the bit: positions and velocities exchanged, and the kinds too where the partner is a grain.
/// What turns the two grains, and what they remember, is even to the bit; what keeps them from rolling, and what they remember
/// of that, is odd.
pub(super) fn odd<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Odd);
    let swapped = if case.is_wall() {
        case.pair
    } else {
        case.law.pair(case.b, case.a)
    };
    for history in case.histories(0.0) {
        for (who, pair) in [
            ("seen from the other side", &case.pair),
            ("pair(b, a) against pair(a, b)", &swapped),
        ] {
            let mut memory = L::Memory::zero();
            case.walk(&history, |moment| {
                let (state, there) = (moment.state, moment.push);
                let partner = case.at(state.other_side());
                let back = L::force(pair, &partner, &mut memory, history.dt);
                for ((name, there), (_, back)) in parts(&there).into_iter().zip(parts(&back)) {
                    worst.demand(there == -back, || {
                        format!(
                            "{name} force {there:?} N and {back:?} N, {who}, {}",
                            case.words(state)
                        )
                    });
                }
                worst.demand(there.twist == back.twist, || {
                    format!(
                        "twist {:?} N and {:?} N, {who}, {}",
                        there.twist,
                        back.twist,
                        case.words(state)
                    )
                });
                worst.demand(there.couple == -back.couple, || {
                    format!(
                        "couple {:?} N m and {:?} N m, {who}, {}",
                        there.couple,
                        back.couple,
                        case.words(state)
                    )
                });
                worst.demand(same::<D, S, L>(moment.after, &memory), || {
                    format!(
                        "{:?} and {:?} remembered, {who}, {}",
                        listed(moment.after),
                        listed(&memory),
                        case.words(state)
                    )
                });
                let (one, other) = (
                    L::stored(&case.pair, &case.at(state), moment.after),
                    L::stored(pair, &partner, &memory),
                );
                worst.demand(one == other, || {
                    format!(
                        "stored {one:e} J and {other:e} J, {who}, {}",
                        case.words(state)
                    )
                });
            });
        }
    }
    worst.breach()
}

/// A way to look at a contact from elsewhere: what becomes of a vector and of an axial vector.
type View<V, W> = (&'static str, fn(V) -> V, fn(W) -> W);

/// The whole history of a contact is turned, or seen in a mirror, and the forces turn with it.
///
/// Turning changes the distance by a few roundings, and a stiffness k answers with k·r·1e-16 each:
/// 1e-13 k·r leaves two orders of magnitude, and is still 1e-9 of the force at the smallest overlap.
pub(super) fn turns<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Turning);
    let views: [View<D::V, S::Turn<D>>; 2] = [
        ("a turn", turned, turned),
        ("a mirror", mirrored, mirrored_axial),
    ];
    for history in case.histories(0.0) {
        for (view, polar, axial) in views {
            let mut memory = L::Memory::zero();
            case.walk(&history, |moment| {
                let (state, push) = (moment.state, moment.push);
                let tolerance = 1e-13 * case.stiffness * case.range + 1e-12 * size(&push);
                let there = touch::<D, S>(
                    State {
                        apart: polar(state.apart),
                        velocity: polar(state.velocity),
                        spin: axial(state.spin),
                        roll: axial(state.roll),
                    },
                    reach(case.a, case.b),
                );
                let after = L::force(&case.pair, &there, &mut memory, history.dt);
                for ((name, before), (_, after)) in parts(&push).into_iter().zip(parts(&after)) {
                    let expected = polar(before);
                    worst.see((after - expected).length(), tolerance, || {
                        format!(
                            "{name} force {after:?} N, expected {expected:?} N after {view}, {}",
                            case.words(state)
                        )
                    });
                }
                let expected = axial(push.twist);
                worst.see((after.twist - expected).length(), tolerance, || {
                    format!(
                        "twist {:?} N, expected {expected:?} N after {view}, {}",
                        after.twist,
                        case.words(state)
                    )
                });
                let expected = axial(push.couple);
                let off = (after.couple - expected).length();
                worst.see(off, tolerance * case.range, || {
                    format!(
                        "couple {:?} N m, expected {expected:?} N m after {view}, {}",
                        after.couple,
                        case.words(state)
                    )
                });
                let (before, after) = (
                    L::stored(&case.pair, &case.at(state), moment.after),
                    L::stored(&case.pair, &there, &memory),
                );
                worst.see((after - before).abs(), tolerance * case.range, || {
                    format!(
                        "stored {before:e} J, {after:e} J after {view}, {}",
                        case.words(state)
                    )
                });
            });
        }
    }
    worst.breach()
}
