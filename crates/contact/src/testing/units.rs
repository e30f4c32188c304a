//! The same force in any units: a stray root or a wrong mass shows at once.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, size, touch};
use tsubu_model::{Constants, ContactLaw, Dim, Numbers, Quantity, Still, Vector};

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

/// Range, force, stored energy and linearisation of the rescaled law in the rescaled state.
///
/// Overlaps from 1e-2 of the range on: rounding of the range, 1e-16, is then 1e-14 of the overlap,
/// and 1e-12 of the force leaves two orders of magnitude.
pub(super) fn any_units<D: Dim, L: ContactLaw<D, Still> + Constants>(
    case: &Case<D, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Units);
    for (words, factors) in UNITS {
        let unit =
            |[l, m, t]: [i32; 3]| factors[0].powi(l) * factors[1].powi(m) * factors[2].powi(t);
        let rescale = |quantity: Quantity, value: f64| value * unit(quantity.exponents());
        let law = case.law.mapped(rescale);
        listed_as_mapped(case.law, &law, rescale, &mut worst);
        let (a, b) = (case.a.mapped(rescale), case.b.mapped(rescale));
        let pair = law.pair(&a, &b);
        let dt = case.dt * unit([0, 0, 1]);

        let (range, expected) = (L::range(&pair), case.range * unit([1, 0, 0]));
        worst.see((range / expected - 1.0).abs(), 1e-13, || {
            format!("{words}: range {range:e}, expected {expected:e}")
        });

        for state in case.states(1e-2) {
            let there = State {
                apart: state.apart * unit([1, 0, 0]),
                velocity: state.velocity * unit([1, 0, -1]),
            };
            let seen = touch::<D>(there, a.radius + b.radius);
            let (before, after) = (
                case.push(state),
                L::force(&pair, &seen, &mut L::Memory::zero(), dt),
            );
            let parts = [
                ("elastic", before.elastic, after.elastic),
                ("viscous", before.viscous, after.viscous),
                ("slip", before.slip, after.slip),
            ];
            for (name, before_part, after_part) in parts {
                let back = after_part * (1.0 / unit([1, 1, -2]));
                worst.see((back - before_part).length(), 1e-12 * size(&before), || {
                    format!(
                        "{words}: {name} force {back:?} N, {before_part:?} N in SI, {}",
                        case.words(state)
                    )
                });
            }
            let (stored, back) = (
                case.stored(state),
                L::stored(&pair, &seen, &L::Memory::zero()) / unit([2, 1, -2]),
            );
            // Energies of 1e-5 k r² carry the rounding of the potential's depth, 1e-17 k r².
            worst.see((back - stored).abs(), 1e-11 * stored.abs(), || {
                format!(
                    "{words}: stored {back:e} J, {stored:e} J in SI, {}",
                    case.words(state)
                )
            });
            let (one, other) = (
                L::linear(&case.pair, &case.at(state), case.dt),
                L::linear(&pair, &seen, dt),
            );
            let (k, c) = (unit([0, 1, -2]), unit([0, 1, -1]));
            let (least_k, least_c) = (1e-11 * case.stiffness, 1e-11 * case.mass * case.rate);
            let slopes = [
                (
                    "normal_stiffness",
                    one.normal_stiffness,
                    other.normal_stiffness / k,
                    least_k,
                ),
                (
                    "tangential_stiffness",
                    one.tangential_stiffness,
                    other.tangential_stiffness / k,
                    least_k,
                ),
                (
                    "normal_damping",
                    one.normal_damping,
                    other.normal_damping / c,
                    least_c,
                ),
                (
                    "tangential_damping",
                    one.tangential_damping,
                    other.tangential_damping / c,
                    least_c,
                ),
            ];
            for (name, si, back, least) in slopes {
                worst.see((back - si).abs(), 1e-11 * si.abs() + least, || {
                    format!(
                        "{words}: {name} {back:e}, {si:e} in SI, {}",
                        case.words(state)
                    )
                });
            }
        }
    }
    worst.breach()
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
