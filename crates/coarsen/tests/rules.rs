//! The algebra of the rules: composition, round trip, units, what each keeps; and the check of gaps.

use proptest::prelude::*;
use tsubu_coarsen::{
    CoarseRule, Gap, Level, RadlRestitution, Renormalised, SakaiKoshizuka, check_gaps, coarsen,
};
use tsubu_contact::Repulsion;
use tsubu_model::{Constants, Kind, Quantity};

const QUANTITIES: [Quantity; 8] = [
    Quantity::Length,
    Quantity::Mass,
    Quantity::Energy,
    Quantity::Stiffness,
    Quantity::Damping,
    Quantity::Modulus,
    Quantity::Restitution,
    Quantity::Number,
];

fn coke() -> Repulsion {
    Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3)
}

fn radl(e: f64) -> RadlRestitution {
    RadlRestitution::new(e).expect("a restitution in (0, 1]")
}

/// Relative difference.
fn off(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn narrow_gaps_are_named() {
    let screw = [
        Gap::new("outlet", 324e-3),
        Gap::new("clearance", 12.3e-3),
        Gap::new("pitch", 150e-3),
    ];
    assert_eq!(check_gaps(&screw, 1.350e-3, Level::new(3)), Ok(()));
    assert_eq!(check_gaps(&[], 1.350e-3, Level::new(30)), Ok(()));
    // One d' exactly still fits: "under 1 d'" is what is refused.
    assert_eq!(
        check_gaps(&[Gap::new("slot", 10.8e-3)], 1.350e-3, Level::new(3)),
        Ok(())
    );
    let narrow = check_gaps(&screw, 1.350e-3, Level::new(6)).unwrap_err();
    assert_eq!(
        (narrow.gap.name.as_str(), narrow.largest),
        ("clearance", Some(Level::new(3)))
    );
    let never = check_gaps(&[Gap::new("crack", 1e-3)], 1.350e-3, Level::new(2)).unwrap_err();
    assert!(
        never
            .to_string()
            .ends_with("not even the real grain (n = 0) fits"),
        "{never}"
    );
    // A width that is no number is never wide enough, whatever stands beside it.
    let lost = [Gap::new("wide", 1.0), Gap::new("lost", f64::NAN)];
    assert!(check_gaps(&lost, 1.350e-3, Level::new(0)).is_err());
}

proptest! {
    /// λ₁ and then λ₂ is λ₁λ₂, and 1/λ undoes λ. Each is two powers and two products: 1e-14.
    #[test]
    fn powers_compose(value in 1e-9..1e9f64, one in 1.0..20.0f64, two in 1.0..20.0f64) {
        for rule in [&Renormalised as &dyn CoarseRule, &SakaiKoshizuka] {
            for quantity in QUANTITIES {
                let twice = rule.scale(quantity, rule.scale(quantity, value, one), two);
                prop_assert!(off(twice, rule.scale(quantity, value, one * two)) < 1e-14);
                let back = rule.scale(quantity, rule.scale(quantity, value, one), 1.0 / one);
                prop_assert!(off(back, value) < 1e-14);
            }
            prop_assert!(off(rule.step_factor(one) * rule.step_factor(two), rule.step_factor(one * two)) < 1e-14);
        }
    }

    /// Level 1 twice is level 2 for whole laws, to the bit for powers of two.
    #[test]
    fn one_level_twice_is_two_levels(epsilon in 1e-6..1e2f64, gamma in 0.0..10.0f64, d in 1e-5..1.0f64) {
        let law = Repulsion::new(epsilon, Repulsion::sigma_for_diameter(d), gamma, gamma, d);
        for rule in [&Renormalised as &dyn CoarseRule, &SakaiKoshizuka] {
            let once = coarsen(rule, &law, Level::new(1)).unwrap();
            prop_assert_eq!(coarsen(rule, &once, Level::new(1)).unwrap(), coarsen(rule, &law, Level::new(2)).unwrap());
        }
    }

    /// The same for Radl's rule, which must carry the restitution of the grains it meets. e_c² is a
    /// difference of numbers near 1 and kept above 0.05; ζ of e = 0.999 carries 1e-13: 1e-10 holds both.
    #[test]
    fn radl_composes_if_it_carries_the_restitution(e in 0.9..0.999f64, value in 1e-3..1e3f64) {
        let (rule, next) = (radl(e), radl(e).after(Level::new(1)).unwrap());
        for quantity in QUANTITIES {
            let value = if quantity == Quantity::Restitution { e } else { value };
            let once = rule.scale(quantity, value, 2.0);
            prop_assert!(off(next.scale(quantity, once, 2.0), rule.scale(quantity, value, 4.0)) < 1e-10);
            prop_assert!(off(next.scale(quantity, once, 0.5), value) < 1e-10);
        }
    }

    /// A rule does not care for units: it commutes with any factor on a quantity that has one.
    #[test]
    fn rules_know_no_units(value in 1e-9..1e9f64, unit in 1e-3..1e3f64, lambda in 1.0..5.0f64) {
        for rule in [&Renormalised as &dyn CoarseRule, &SakaiKoshizuka, &radl(0.9)] {
            for quantity in QUANTITIES.into_iter().filter(|q| q.exponents() != [0, 0, 0]) {
                let scaled = rule.scale(quantity, value, lambda);
                prop_assert!(off(rule.scale(quantity, value * unit, lambda), scaled * unit) < 1e-14);
            }
            prop_assert_eq!(rule.scale(Quantity::Number, value, lambda), value);
        }
    }

    /// The table of the crate page. Density for all; modulus and ζ; √(m*/k)/d, the overlap ratio at a
    /// given speed; √(m*/k), the duration. 1e-13: a dozen roundings.
    #[test]
    fn the_table_of_what_is_kept_holds(young in 1e5..1e11f64, density in 500.0..9000.0f64, d in 1e-5..1.0f64, zeta in 0.0..0.9f64, n in 1u32..9) {
        let sigma = Repulsion::sigma_for_diameter(d);
        let kind = Kind::sphere(d, density);
        let damping = 2.0 * zeta * (young * sigma * 0.5 * kind.mass).sqrt();
        let law = Repulsion::from_young_modulus(young, sigma, damping, damping, d);
        // [density, E, ζ, overlap ratio per speed, duration]
        let numbers = |kind: &Kind, law: &Repulsion| {
            let time = (0.5 * kind.mass / law.stiffness()).sqrt();
            let density = kind.mass / kind.diameter().powi(3);
            [density, law.stiffness() / law.sigma, 1.0 + law.damping_ratio(0.5 * kind.mass), time / kind.diameter(), time]
        };
        let (level, lambda) = (Level::new(n), Level::new(n).lambda());
        let fine = numbers(&kind, &law);
        let expected: [(&dyn CoarseRule, [f64; 5]); 2] = [
            (&Renormalised, [1.0, 1.0, 1.0, 1.0, lambda]),
            (&SakaiKoshizuka, [1.0, lambda * lambda, 1.0, 1.0 / lambda, 1.0]),
        ];
        for (rule, factors) in expected {
            let coarse = numbers(&coarsen(rule, &kind, level).unwrap(), &coarsen(rule, &law, level).unwrap());
            for i in 0..5 {
                prop_assert!(off(coarse[i], factors[i] * fine[i]) < 1e-13, "{} {i}: {coarse:?} {fine:?}", rule.name());
            }
        }
    }

    /// Radl: a pair loses λ times as large a share of its energy, and collides 1/λ times as often.
    #[test]
    fn radl_keeps_the_rate_of_loss(e in 0.5..1.0f64, share in 0.0..0.99f64) {
        let rule = radl(e);
        // λ runs from 1 to just below the limit.
        let lambda = 1.0 + share * (rule.limit(Quantity::Damping, 1.0) - 1.0).min(1e3);
        let e_c = rule.scale(Quantity::Restitution, e, lambda);
        prop_assert!(((1.0 - e_c * e_c) / lambda - (1.0 - e * e)).abs() < 1e-14);
    }

    /// Constants keep their names, order and number.
    #[test]
    fn the_list_of_constants_is_the_same(n in 0u32..9) {
        let names = |law: &Repulsion| law.constants().iter().map(|c| (c.0, c.1)).collect::<Vec<_>>();
        let law = coarsen(&Renormalised, &coke(), Level::new(n)).unwrap();
        prop_assert_eq!(names(&law), names(&coke()));
    }
}
