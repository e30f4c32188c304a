//! The parts of a push: the elastic one has a potential, the viscous one takes, slip is limited.

use super::history::Moment;
use super::report::{Breach, Check, Worst};
use super::states::{Case, State, axis, frame, rolled, scattered, size, turns};
use super::{Friction, Of};
use tsubu_model::{ContactLaw, Dim, Numbers, SpinState, Vector};

/// The elastic force against a central difference of the stored energy, coordinate by coordinate, at rest.
///
/// With a displacement h = 3e-4 δ of an overlap δ the difference is wrong by about 4h²/(rδ) ≤ 2e-8
/// for the steepest power law, and a stored energy of rounding 1e-17 k r² adds 1e-17 r²/(hδ) ≤ 5e-8
/// from δ = 1e-3 r on; 1e-6 of the force stands clear of both.
pub(super) fn follows_potential<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    friction: Option<Friction>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Potential);
    for state in case.states(1e-3) {
        let state = State::<D, S>::at_rest(state.apart);
        let h = 3e-4 * (case.range - state.apart.length());
        let slope = D::V::from_axes(|a| {
            let moved = |by: f64| case.stored(State::at_rest(state.apart + axis::<D::V>(a) * by));
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
    if L::Memory::N > 0 {
        for number in 0..4 {
            holds_what_was_put_in(case, friction, number, &mut worst);
        }
    }
    worst.breach()
}

/// A contact that remembers is pressed to 1 % overlap and then rubbed by spin, without sliding: it stores the work done
/// against its elastic force (trapezia).
///
/// Pressing in 20 steps: a trapezium is exact for a spring and 8e-4 of the whole work off for Hertz (a quarter of the first step's),
/// tolerance 2e-3 of the whole. Rubbing changes no distance,
/// and any tangential spring at a given overlap is linear: 1e-6 of the largest work on the way.
fn holds_what_was_put_in<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    friction: Option<Friction>,
    number: u64,
    worst: &mut Worst,
) {
    const STEPS: u32 = 20;
    let (n, _) = frame::<D::V>(number);
    let depth = 1e-2 * case.range;
    let mut memory = L::Memory::zero();
    let mut elastic = D::V::ZERO;
    let mut work = 0.0;
    let mut advance = |state: State<D, S>, dt: f64, work: &mut f64| {
        let touch = case.at(state);
        let now = L::force(&case.pair, &touch, &mut memory, dt).elastic;
        *work -= (elastic + now).dot(state.surface_velocity()) * (0.5 * dt);
        elastic = now;
        L::stored(&case.pair, &touch, &memory)
    };
    let closing = n * (-depth / (f64::from(STEPS) * case.dt));
    let mut steps = Vec::new();
    for step in 1..=STEPS {
        let r = case.range - depth * f64::from(step) / f64::from(STEPS);
        let state = State::moving(n * r, closing);
        let stored = advance(state, case.dt, &mut work);
        steps.push((state, stored, work));
    }
    let whole = work.abs();
    for (state, stored, work) in steps {
        worst.see((stored - work).abs(), 2e-3 * whole, || {
            format!(
                "stored {stored:e} J after a work of {work:e} J, {}",
                case.words(state)
            )
        });
    }
    let still = State::at_rest(n * (case.range - depth));
    let pressed = advance(still, case.dt, &mut work);
    if !turns::<D, S>() || friction.is_some_and(|f| f.coefficient == 0.0) {
        return;
    }
    // Far below the limit of friction, dashpot included.
    let spring = pressed * 2.0 / depth;
    let limit = friction.map_or(f64::INFINITY, |f| f.coefficient * spring);
    let linear = L::linear(&case.pair, &case.at(still), case.dt);
    let way = (0.2 * limit / linear.tangential_stiffness).min(0.3 * depth);
    let dt = case
        .dt
        .max(10.0 * linear.tangential_damping * way / limit.min(spring));
    let turn = scattered::<S::Turn<D>>(90 + number);
    let turn = turn * (way / rolled::<D, S>(n, turn).length());
    let place = |step: u32| (f64::from(step) * std::f64::consts::TAU / 40.0).sin();
    let (mut work, mut most, mut errors) = (0.0, 0.0_f64, Vec::new());
    for step in 1..=40 {
        let state = State {
            spin: turn * ((place(step) - place(step - 1)) / dt),
            ..still
        };
        let stored = advance(state, dt, &mut work) - pressed;
        most = most.max(work.abs());
        errors.push((state, stored, work));
    }
    for (state, stored, work) in errors {
        // What is pressed is subtracted and leaves its rounding.
        let tolerance = 1e-6 * most + 1e-13 * pressed;
        worst.see((stored - work).abs(), tolerance, || {
            format!(
                "rubbing stored {stored:e} J, its work is {work:e} J, {}",
                case.words(state)
            )
        });
    }
}

/// The viscous force never drives; nor does the slip force of a law without memory
/// (with memory it may hold a spring, and the closed paths judge it).
pub(super) fn only_takes<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Dashpot);
    for history in case.histories(0.0) {
        case.walk(&history, |Moment { state, push, .. }| {
            let slip = if L::Memory::N == 0 {
                push.slip
            } else {
                D::V::ZERO
            };
            let velocity = state.surface_velocity();
            // What the surface velocity is made of leaves its rounding.
            let speed = state.velocity.length() + state.spin.length();
            for (name, part) in [("viscous", push.viscous), ("slip", slip)] {
                let power = part.dot(velocity);
                // The product of two vectors is exact to a few units in the last place of their lengths.
                worst.see(power.max(0.0), 1e-13 * part.length() * speed, || {
                    format!(
                        "the {name} force {part:?} N drives with {power:e} W {}",
                        case.words(state)
                    )
                });
                worst.demand(!power.is_nan(), || {
                    format!("the {name} force is {part:?} N {}", case.words(state))
                });
            }
        });
    }
    worst.breach()
}

/// The claim of friction: |slip| ≤ μ N, N the normal part of the elastic and viscous forces, and of grains that
/// turn the whole tangential force. Of friction of the spring alone: slip and tangential spring against the normal spring.
pub(super) fn within_coulomb<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    friction: Option<Friction>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Coulomb);
    for history in case.histories(0.0) {
        case.walk(&history, |Moment { state, push, .. }| {
            let Some(Friction { coefficient, of }) = friction else {
                let slip = push.slip.length();
                worst.demand(slip == 0.0, || {
                    format!(
                        "slip force {slip:e} N without a claim of friction, {}",
                        case.words(state)
                    )
                });
                return;
            };
            let n = state.normal();
            let across = |force: D::V| (force - n * force.dot(n)).length();
            let (limited, normal) = match of {
                Of::Normal if turns::<D, S>() => {
                    (across(push.total()), (push.elastic + push.viscous).dot(n))
                }
                Of::Normal => (push.slip.length(), (push.elastic + push.viscous).dot(n)),
                Of::Spring => (
                    push.slip.length().max(across(push.elastic)),
                    push.elastic.dot(n),
                ),
            };
            // The normal force is a difference of the parts and carries their rounding, and so does what is across it.
            let rounding = 1e-12 * coefficient * (push.elastic.length() + push.viscous.length());
            let projected = if turns::<D, S>() {
                1e-14 * size(&push)
            } else {
                0.0
            };
            let over = limited - coefficient * normal.max(0.0);
            worst.see(over.max(0.0), rounding + projected, || {
                format!(
                    "slip force {limited:e} N over μN = {:e} N, {}",
                    coefficient * normal,
                    case.words(state)
                )
            });
            worst.demand(!over.is_nan(), || {
                format!("slip force {:?} N, {}", push.slip, case.words(state))
            });
        });
    }
    worst.breach()
}

/// The normal force never pulls, for a law that promises so. Fast separation makes a dashpot pull.
pub(super) fn pushes<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    promised: bool,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Tension);
    if !promised {
        return None;
    }
    for history in case.histories(0.0) {
        case.walk(&history, |Moment { state, before, .. }| {
            let apart = state.normal();
            let leaving = State {
                velocity: state.velocity + apart * (0.1 * case.range * case.rate),
                ..state
            };
            let mut memory = before;
            let push = L::force(&case.pair, &case.at(leaving), &mut memory, history.dt);
            let normal = push.total().dot(apart);
            let rounding = 1e-12 * (push.elastic.length() + push.viscous.length());
            let projected = if turns::<D, S>() {
                1e-14 * size(&push)
            } else {
                0.0
            };
            worst.see((-normal).max(0.0), rounding + projected, || {
                format!("normal force {normal:e} N {}", case.words(leaving))
            });
            worst.demand(!normal.is_nan(), || {
                format!("normal force {normal} {}", case.words(leaving))
            });
        });
    }
    worst.breach()
}
