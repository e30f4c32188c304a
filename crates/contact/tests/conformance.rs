//! Every public law passes the conformance suite: the paper's constants, and any sane ones.

use proptest::prelude::*;
use tsubu_contact::testing::{Claims, breaches, conforms, rebounds_with};
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_model::{Kind, Plane, Space};

/// Paper A's coke: ε, σ, γ and d as printed.
fn coke() -> Repulsion {
    Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3)
}

fn grain() -> Kind {
    Kind::sphere(1.350e-3, 1370.0)
}

#[test]
fn repulsion_conforms() {
    conforms(&coke(), &grain(), &grain(), Claims::default());
    conforms(
        &coke(),
        &grain(),
        &Kind::sphere(2.1e-3, 1370.0),
        Claims::default(),
    );
}

#[test]
fn repulsion_per_direction_conforms() {
    let mut law = coke().per_direction();
    law.tangential_damping = 0.4;
    conforms(&law, &grain(), &grain(), Claims::default());
    conforms(
        &law,
        &Kind::sphere(0.7e-3, 2650.0),
        &grain(),
        Claims::default(),
    );
}

#[test]
fn a_driven_grain_of_infinite_mass_conforms() {
    let driven = Kind {
        mass: f64::INFINITY,
        inertia: f64::INFINITY,
        weight: 0.0,
        ..Kind::sphere(0.9e-3, 1370.0)
    };
    conforms(&coke(), &grain(), &driven, Claims::default());
}

#[test]
fn repulsive_walls_conform() {
    for restitution in [None, Some(0.5), Some(0.05)] {
        for friction in [0.0, 0.413] {
            let wall = RepulsiveWall {
                grains: coke(),
                restitution,
                friction,
            };
            let claims = Claims::default().friction(friction).never_pulls();
            conforms(&wall, &grain(), &Kind::immovable(), claims);
        }
    }
}

/// The wall's restitution is the one asked for. ζ belongs to the linear spring; the repulsion stiffens
/// by 21 δ/σ, and at 10 m/s the overlap against a wall is δ = v/ω = 0.5 % of σ. Half the stiffening
/// acts on average and ζ falls with its root, so ln e shrinks by up to 3 %: at most 0.011 in e, since
/// −e ln e ≤ 0.37.
#[test]
fn a_wall_rebounds_as_asked() {
    for e in [0.1, 0.3, 0.5, 0.9] {
        let wall = RepulsiveWall {
            grains: coke(),
            restitution: Some(e),
            friction: 0.413,
        };
        rebounds_with::<Space, _>(&wall, &grain(), &Kind::immovable(), e, 0.012);
    }
    let elastic = RepulsiveWall {
        grains: coke(),
        restitution: None,
        friction: 0.413,
    };
    rebounds_with::<Plane, _>(&elastic, &grain(), &Kind::immovable(), 1.0, 1e-5);
}

/// A pair of the paper's coke: e = 0.8967 of the linear spring, 0.89774 at 10 m/s (theory, section 4.4).
#[test]
fn a_pair_of_coke_rebounds_as_in_theory() {
    rebounds_with::<Space, _>(&coke(), &grain(), &grain(), 0.8967, 2e-3);
}

proptest! {
    // Each case is two full suites; 24 of them take a few seconds.
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Any grain from 10 µm to 1 m, soft or hard, light or heavy, damped lightly or heavily.
    #[test]
    fn any_repulsion_conforms(
        log_d in -5.0..0.0f64,
        log_young in 4.0..11.0f64,
        density in 100.0..20_000.0f64,
        zeta in 0.0..1.5f64,
        tangential in 0.0..3.0f64,
        size_ratio in 0.3..3.0f64,
    ) {
        let d = 10f64.powf(log_d);
        let (a, b) = (Kind::sphere(d, density), Kind::sphere(d * size_ratio, density));
        let sigma = Repulsion::sigma_for_diameter(d);
        let critical = 2.0 * (10f64.powf(log_young) * sigma * 0.5 * a.mass).sqrt();
        let (normal, tangential) = (zeta * critical, zeta * critical * tangential);
        let law = Repulsion::from_young_modulus(10f64.powf(log_young), sigma, normal, normal, d);
        let found = breaches::<Space, _>(&law, &a, &b, Claims::default());
        prop_assert!(found.is_empty(), "{found:#?}");
        let mut law = law.per_direction();
        law.tangential_damping = tangential;
        let found = breaches::<Plane, _>(&law, &a, &b, Claims::default());
        prop_assert!(found.is_empty(), "{found:#?}");
    }

    #[test]
    fn any_repulsive_wall_conforms(
        log_d in -5.0..0.0f64,
        log_young in 4.0..11.0f64,
        density in 100.0..20_000.0f64,
        e in 0.05..1.0f64,
        friction in 0.0..1.5f64,
    ) {
        let d = 10f64.powf(log_d);
        let grain = Kind::sphere(d, density);
        let grains = Repulsion::from_young_modulus(10f64.powf(log_young), Repulsion::sigma_for_diameter(d), 0.0, 0.0, d);
        let wall = RepulsiveWall { grains, restitution: Some(e), friction };
        let claims = Claims::default().friction(friction).never_pulls();
        let found = breaches::<Space, _>(&wall, &grain, &Kind::immovable(), claims);
        prop_assert!(found.is_empty(), "{found:#?}");
        let found = breaches::<Plane, _>(&wall, &grain, &Kind::immovable(), claims);
        prop_assert!(found.is_empty(), "{found:#?}");
    }
}
