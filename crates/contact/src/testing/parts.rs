//! The parts of a push: the elastic one has a potential, the viscous one takes, slip is limited.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, axis};
use tsubu_model::{ContactLaw, Dim, Numbers, Still, Vector};

/// The elastic force against a central difference of the stored energy, coordinate by coordinate, at rest.
///
/// With a displacement h = 3e-4 δ of an overlap δ the difference is wrong by about 4h²/(rδ) ≤ 2e-8
/// for the steepest power law, and a stored energy of rounding 1e-17 k r² adds 1e-17 r²/(hδ) ≤ 5e-8
/// from δ = 1e-3 r on; 1e-6 of the force stands clear of both.
pub(super) fn follows_potential<D: Dim, L: ContactLaw<D, Still>>(
    case: &Case<D, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Potential);
    for state in case.states(1e-3) {
        let state = State {
            velocity: D::V::ZERO,
            ..state
        };
        let h = 3e-4 * (case.range - state.apart.length());
        let slope = D::V::from_axes(|a| {
            let moved = |by: f64| {
                case.stored(State {
                    apart: state.apart + axis::<D::V>(a) * by,
                    ..state
                })
            };
            (moved(h) - moved(-h)) / (2.0 * h)
        });
        let elastic = case.push(state).elastic;
        worst.see((elastic + slope).length(), 1e-6 * slope.length(), || {
            format!(
                "elastic force {elastic:?} N, −d(stored)/dx = {:?} N, {}",
                -slope,
                case.words(state)
            )
        });
    }
    worst.breach()
}

/// The viscous force never drives; nor does the slip force of a law without memory
/// (with memory it may hold a spring, and the closed paths judge it).
pub(super) fn only_takes<D: Dim, L: ContactLaw<D, Still>>(case: &Case<D, L>) -> Option<Breach> {
    let mut worst = Worst::of(Check::Dashpot);
    for state in case.states(0.0) {
        let push = case.push(state);
        let slip = if L::Memory::N == 0 {
            push.slip
        } else {
            D::V::ZERO
        };
        for (name, part) in [("viscous", push.viscous), ("slip", slip)] {
            let power = part.dot(state.velocity);
            // The product of two vectors is exact to a few units in the last place of their lengths.
            let rounding = 1e-13 * part.length() * state.velocity.length();
            worst.see(power.max(0.0), rounding, || {
                format!(
                    "the {name} force {part:?} N drives with {power:e} W {}",
                    case.words(state)
                )
            });
            worst.demand(!power.is_nan(), || {
                format!("the {name} force is {part:?} N {}", case.words(state))
            });
        }
    }
    worst.breach()
}

/// |slip| ≤ μ N, N the normal part of the elastic and viscous forces.
pub(super) fn within_coulomb<D: Dim, L: ContactLaw<D, Still>>(
    case: &Case<D, L>,
    friction: Option<f64>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Coulomb);
    for state in case.states(0.0) {
        let push = case.push(state);
        let slip = push.slip.length();
        let Some(friction) = friction else {
            worst.demand(slip == 0.0, || {
                format!(
                    "slip force {slip:e} N without a claim of friction, {}",
                    case.words(state)
                )
            });
            continue;
        };
        let normal = (push.elastic + push.viscous).dot(state.apart) / state.apart.length();
        // The normal force is a difference of the two parts and carries their rounding.
        let rounding = 1e-12 * friction * (push.elastic.length() + push.viscous.length());
        let over = slip - friction * normal.max(0.0);
        worst.see(over.max(0.0), rounding, || {
            format!(
                "slip force {slip:e} N over μN = {:e} N, {}",
                friction * normal,
                case.words(state)
            )
        });
        worst.demand(!over.is_nan(), || {
            format!("slip force {:?} N, {}", push.slip, case.words(state))
        });
    }
    worst.breach()
}

/// The normal force never pulls, for a law that promises so. Fast separation makes a dashpot pull.
pub(super) fn pushes<D: Dim, L: ContactLaw<D, Still>>(
    case: &Case<D, L>,
    promised: bool,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Tension);
    for state in case.states(0.0).filter(|_| promised) {
        let apart = state.apart * (1.0 / state.apart.length());
        let leaving = State {
            velocity: state.velocity + apart * (0.1 * case.range * case.rate),
            ..state
        };
        let push = case.push(leaving);
        let normal = push.total().dot(apart);
        let rounding = 1e-12 * (push.elastic.length() + push.viscous.length());
        worst.see((-normal).max(0.0), rounding, || {
            format!("normal force {normal:e} N {}", case.words(leaving))
        });
        worst.demand(!normal.is_nan(), || {
            format!("normal force {normal} {}", case.words(leaving))
        });
    }
    worst.breach()
}
