//! Exchange of the grains, to the bit, and rotation of the pair, to rounding.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, size, touch, turned};
use tsubu_model::{ContactLaw, Dim, Numbers, Still, Vector};

/// Each side computes the contact for itself, so momentum is kept to the bit only if the law is odd
/// to the bit: positions and velocities exchanged, and the kinds too where the partner is a grain.
pub(super) fn odd<D: Dim, L: ContactLaw<D, Still>>(case: &Case<D, L>) -> Option<Breach> {
    let mut worst = Worst::of(Check::Odd);
    let swapped = if case.is_wall() {
        case.pair
    } else {
        case.law.pair(case.b, case.a)
    };
    for state in case.states(0.0) {
        let there = case.push(state);
        let mirrored = State {
            apart: -state.apart,
            velocity: -state.velocity,
        };
        let partner = case.at(mirrored);
        for (who, pair) in [
            ("seen from the other side", &case.pair),
            ("pair(b, a) against pair(a, b)", &swapped),
        ] {
            let back = L::force(pair, &partner, &mut L::Memory::zero(), case.dt);
            let parts = [
                ("elastic", there.elastic, back.elastic),
                ("viscous", there.viscous, back.viscous),
                ("slip", there.slip, back.slip),
            ];
            for (name, there, back) in parts {
                worst.demand(there == -back, || {
                    format!(
                        "{name} force {there:?} N and {back:?} N, {who}, {}",
                        case.words(state)
                    )
                });
            }
            let (one, other) = (
                case.stored(state),
                L::stored(pair, &partner, &L::Memory::zero()),
            );
            worst.demand(one == other, || {
                format!(
                    "stored {one:e} J and {other:e} J, {who}, {}",
                    case.words(state)
                )
            });
        }
    }
    worst.breach()
}

/// Turning changes the distance by a few roundings, and a stiffness k answers with k·r·1e-16 each:
/// 1e-13 k·r leaves two orders of magnitude, and is still 1e-9 of the force at the smallest overlap.
pub(super) fn turns<D: Dim, L: ContactLaw<D, Still>>(case: &Case<D, L>) -> Option<Breach> {
    let mut worst = Worst::of(Check::Turning);
    for state in case.states(0.0) {
        let push = case.push(state);
        let tolerance = 1e-13 * case.stiffness * case.range + 1e-12 * size(&push);
        let round = State {
            apart: turned(state.apart),
            velocity: turned(state.velocity),
        };
        let after = L::force(
            &case.pair,
            &touch(round, case.at(state).reach),
            &mut L::Memory::zero(),
            case.dt,
        );
        let parts = [
            ("elastic", push.elastic, after.elastic),
            ("viscous", push.viscous, after.viscous),
            ("slip", push.slip, after.slip),
        ];
        for (name, before, after) in parts {
            let expected = turned(before);
            worst.see((after - expected).length(), tolerance, || {
                format!(
                    "{name} force {after:?} N, expected {expected:?} N after a turn, {}",
                    case.words(state)
                )
            });
        }
        let (before, after) = (case.stored(state), case.stored(round));
        let energy = tolerance * case.range;
        worst.see((after - before).abs(), energy, || {
            format!(
                "stored {before:e} J, {after:e} J after a turn, {}",
                case.words(state)
            )
        });
    }
    worst.breach()
}
