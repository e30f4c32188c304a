//! The same force in any units: a stray root or a wrong mass shows at once.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, parts, reach, size, touch};
use tsubu_model::{Constants, ContactLaw, Dim, Linear, Numbers, Quantity, SpinState, Vector};

/// Factors on the numbers of length, mass and time. One at a time first, so that the report says
/// which of them a formula treats wrongly; none is a power of two, which would hide nothing but rounding.
const UNITS: [(&str, [f64; 3]); 4] = [
    ("length × 0.3048", [0.3048, 1.0, 1.0]),
    ("mass × 0.45359", [1.0, 0.453_59, 1.0]),
    ("time × 1/7.3", [1.0, 1.0, 1.0 / 7.3]),
    (
        "length × 1/0.0254, mass × 14.6, time × 3600.7",
        [1.0 / 0.0254, 14.593_9, 3600.7],
    ),
];

/// Range, force, twist, stored energy and linearisation of the rescaled law in the rescaled states.
///
/// Overlaps from 1e-2 of the range on: rounding of the range, 1e-16, is then 1e-14 of the overlap,
/// and 1e-12 of the force leaves two orders of magnitude. What has been summed up since a touch carries the rounding of the
/// touch, 1e-16 k·r; 1e-13 k·r is the tolerance there.
pub(super) fn any_units<D: Dim, S: SpinState, L: ContactLaw<D, S> + Constants>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Units);
    let histories = case.histories(1e-2);
    for (words, factors) in UNITS {
        let unit =
            |[l, m, t]: [i32; 3]| factors[0].powi(l) * factors[1].powi(m) * factors[2].powi(t);
        let rescale = |quantity: Quantity, value: f64| value * unit(quantity.exponents());
        let law = case.law.mapped(rescale);
        listed_as_mapped(case.law, &law, rescale, &mut worst);
        let (a, b) = (case.a.mapped(rescale), case.b.mapped(rescale));
        let pair = law.pair(&a, &b);

        let (range, expected) = (L::range(&pair), case.range * unit([1, 0, 0]));
        worst.see((range / expected - 1.0).abs(), 1e-13, || {
            format!("{words}: range {range:e}, expected {expected:e}")
        });

        for history in &histories {
            let there = history.seen(|state| State {
                apart: state.apart * unit([1, 0, 0]),
                velocity: state.velocity * unit([1, 0, -1]),
                spin: state.spin * unit([1, 0, -1]),
                roll: state.roll * unit([0, 0, -1]),
            });
            let dt = history.dt * unit([0, 0, 1]);
            let drift = history.drift() * case.stiffness * case.range;
            let mut states = there.states.iter();
            let mut memory = L::Memory::zero();
            case.walk(history, |moment| {
                let (state, before) = (moment.state, moment.push);
                let Some(&there) = states.next() else { return };
                let seen = touch(there, reach(&a, &b));
                let after = L::force(&pair, &seen, &mut memory, dt);
                let tolerance = 1e-12 * size(&before) + drift;
                let newton = unit([1, 1, -2]);
                for ((name, si), (_, part)) in parts(&before).into_iter().zip(parts(&after)) {
                    let back = part * (1.0 / newton);
                    worst.see((back - si).length(), tolerance, || {
                        format!(
                            "{words}: {name} force {back:?} N, {si:?} N in SI, {}",
                            case.words(state)
                        )
                    });
                }
                let back = after.twist * (1.0 / newton);
                worst.see((back - before.twist).length(), tolerance, || {
                    format!(
                        "{words}: twist {back:?} N, {:?} N in SI, {}",
                        before.twist,
                        case.words(state)
                    )
                });
                let back = after.couple * (1.0 / unit([2, 1, -2]));
                let off = (back - before.couple).length();
                worst.see(off, tolerance * case.range, || {
                    format!(
                        "{words}: couple {back:?} N m, {:?} N m in SI, {}",
                        before.couple,
                        case.words(state)
                    )
                });
                let (stored, back) = (
                    L::stored(&case.pair, &case.at(state), moment.after),
                    L::stored(&pair, &seen, &memory) / unit([2, 1, -2]),
                );
                // Energies of 1e-5 k r² carry the rounding of the potential's depth, 1e-17 k r².
                let tolerance = 1e-11 * stored.abs() + drift * case.range;
                worst.see((back - stored).abs(), tolerance, || {
                    format!(
                        "{words}: stored {back:e} J, {stored:e} J in SI, {}",
                        case.words(state)
                    )
                });
                let si = L::linear(&case.pair, &case.at(state), history.dt);
                let back = L::linear(&pair, &seen, dt);
                let per = [unit([0, 1, -2]), unit([0, 1, -1])];
                for (name, si, back, least) in slopes(case, si, back, per) {
                    worst.see((back - si).abs(), 1e-11 * si.abs() + least, || {
                        format!(
                            "{words}: {name} {back:e}, {si:e} in SI, {}",
                            case.words(state)
                        )
                    });
                }
            });
        }
    }
    worst.breach()
}

/// The numbers of two linearisations side by side, the second turned back by the units of stiffness and damping;
/// with the size below which a difference is nothing.
fn slopes<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    si: Linear,
    other: Linear,
    [k, c]: [f64; 2],
) -> [(&'static str, f64, f64, f64); 4] {
    let (least_k, least_c) = (1e-11 * case.stiffness, 1e-11 * case.mass * case.rate);
    [
        (
            "normal_stiffness",
            si.normal_stiffness,
            other.normal_stiffness / k,
            least_k,
        ),
        (
            "tangential_stiffness",
            si.tangential_stiffness,
            other.tangential_stiffness / k,
            least_k,
        ),
        (
            "normal_damping",
            si.normal_damping,
            other.normal_damping / c,
            least_c,
        ),
        (
            "tangential_damping",
            si.tangential_damping,
            other.tangential_damping / c,
            least_c,
        ),
    ]
}

/// The mapped law lists the mapped constants, all of them and in the same order.
fn listed_as_mapped<L: Constants>(
    law: &L,
    mapped: &L,
    rescale: impl Fn(Quantity, f64) -> f64,
    worst: &mut Worst,
) {
    let (before, after) = (law.constants(), mapped.constants());
    worst.demand(before.len() == after.len(), || {
        format!("{} constants become {}", before.len(), after.len())
    });
    for (&(name, quantity, value), &(name_after, quantity_after, value_after)) in
        before.iter().zip(&after)
    {
        let expected = rescale(quantity, value);
        let same_name = name == name_after && quantity == quantity_after;
        let same_value = (value_after - expected).abs() <= 1e-14 * expected.abs();
        worst.demand(same_name && same_value, || {
            format!("{name} ({quantity:?}) = {value:e} is mapped to {name_after} ({quantity_after:?}) = {value_after:e}, expected {expected:e}")
        });
    }
}
