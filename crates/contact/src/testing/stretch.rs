//! The tangential spring of a law that remembers is never longer than friction can hold.

use super::Friction;
use super::report::{Breach, Check, Worst};
use super::states::{Case, State, frame, rolled, scattered, size, turns};
use tsubu_model::{ContactLaw, Dim, Numbers, SpinState, Vector};

/// A contact pressed to 1 % overlap is rubbed by spin ten times as far as its spring can follow, μN/kt, and then back.
/// On the way the rubbing stores at most (μN)²/(2kt); and 2.2 μN/kt of the way back turn the force round to 0.9 μN and
/// more. A spring that was stretched on while it slid fails both. N is the normal force of the springs.
///
/// It is rubbed so slowly that the dashpot adds at most 1e-3 μN, which also bounds what a spring that has only its share
/// of the friction falls short; so 0.9 is clear of rounding and of the step, 1/20 of μN.
pub(super) fn never_overstretched<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    friction: Option<Friction>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Stretch);
    let coefficient = friction.map_or(0.0, |f| f.coefficient);
    if L::Memory::N == 0 || !turns::<D, S>() || coefficient == 0.0 {
        return None;
    }
    for number in 0..4 {
        let (n, _) = frame::<D::V>(number);
        let (still, mut memory) = case.pressed(n, 1e-2);
        let touch = case.at(still);
        let pressed = L::stored(&case.pair, &touch, &memory);
        let linear = L::linear(&case.pair, &touch, case.dt);
        let elastic = L::force(&case.pair, &touch, &mut memory.clone(), case.dt).elastic;
        let limit = coefficient * elastic.dot(n);
        let way = limit / linear.tangential_stiffness;
        if !way.is_finite() {
            continue;
        }
        let step = way / 20.0;
        let dt = case.dt.max(1e3 * linear.tangential_damping * step / limit);
        let turn = scattered::<S::Turn<D>>(500 + number);
        let slip = rolled::<D, S>(n, turn);
        let turn = turn * (step / (dt * slip.length()));
        let forward = slip * (1.0 / slip.length());
        let mut rubbed = |direction: f64| {
            let state = State {
                spin: turn * direction,
                ..still
            };
            let push = L::force(&case.pair, &case.at(state), &mut memory, dt);
            let most = limit * way / 2.0;
            let stored = L::stored(&case.pair, &touch, &memory) - pressed;
            worst.see(
                (stored - most).max(0.0),
                1e-9 * most + 1e-13 * pressed,
                || {
                    format!(
                        "rubbing stored {stored:e} J, (μN)²/2kt = {most:e} J, {}",
                        case.words(state)
                    )
                },
            );
            (state, push)
        };
        for _ in 0..200 {
            rubbed(1.0);
        }
        for _ in 0..43 {
            rubbed(-1.0);
        }
        let (state, push) = rubbed(-1.0);
        let got = push.total().dot(forward);
        worst.see((0.9 * limit - got).max(0.0), 1e-12 * size(&push), || {
            format!(
                "2.2 μN/kt back from a slide the force forward is {got:e} N, μN = {limit:e} N, {}",
                case.words(state)
            )
        });
        worst.demand(!got.is_nan(), || {
            format!("the force is {push:?}, {}", case.words(state))
        });
    }
    worst.breach()
}
