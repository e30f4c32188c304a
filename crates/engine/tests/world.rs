//! The engine with a real law: what must hold whatever the scene.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::sync::Arc;
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_engine::{
    Body, Health, KindSet, Lanes, Layout, ManyKinds, NoTally, OneKind, Placed, Setup, TouchesAt,
    World,
};
use tsubu_integrate::Scheme;
use tsubu_model::{Dim, Domain, Kind, Motion, Plane, Space, Still, Vector, View};
use tsubu_sdf::HalfSpace;

const D: f64 = 1.35e-3;

fn law() -> Repulsion {
    Repulsion::from_young_modulus(3.1e7, Repulsion::sigma_for_diameter(D), 0.0126, 0.0126, D)
}

fn grain() -> Kind {
    Kind::sphere(D, 1370.0)
}

/// A world of grains at these places; a tenth of the period of a pair is 20 steps of this length.
fn world<X: Layout, K: KindSet>(
    kinds: K,
    grains: Vec<Placed<X>>,
    domain: Domain<X>,
    gravity: X::V,
    floor: bool,
) -> World<X, Still, K, Repulsion, RepulsiveWall, NoTally> {
    let wall = RepulsiveWall {
        grains: law(),
        restitution: Some(0.5),
        friction: 0.4,
    };
    let up = X::V::from_axes(|a| if a == X::UP { 1.0 } else { 0.0 });
    let floor = floor.then(|| Body {
        name: "floor".into(),
        surface: Arc::new(HalfSpace::<X>::new(X::V::ZERO, up)),
        law: wall,
        touches_at: TouchesAt::Surface,
        removed_at: None,
        motion: Motion::default(),
        waits: false,
    });
    World::new(Setup {
        kinds,
        law: law(),
        bodies: floor.into_iter().collect(),
        domain,
        gravity,
        scheme: Scheme::SymplecticEuler,
        dt: 1.5e-6,
        skin: None,
        lanes: Lanes::best(),
        pool: None,
        grains,
        gates: Vec::new(),
    })
}

fn at<X: Dim>(position: X::V, velocity: X::V, kind: usize) -> Placed<X> {
    Placed {
        position,
        velocity,
        kind,
    }
}

/// A loose block of grains falling on a floor, jittered so that nothing is symmetric.
fn block(side: usize, kinds: usize) -> Vec<Placed<Space>> {
    let jitter = |k: usize| ((k * 7919) % 1000) as f64 / 1000.0 - 0.5;
    (0..side * side * side)
        .map(|k| {
            let cell = DVec3::new(
                (k % side) as f64,
                (k / side % side) as f64,
                (k / side / side) as f64 + 1.0,
            );
            let shake = DVec3::new(jitter(3 * k), jitter(3 * k + 1), jitter(3 * k + 2)) * 0.05;
            at::<Space>((cell + shake) * (1.06 * D), DVec3::ZERO, k % kinds)
        })
        .collect()
}

#[test]
fn several_kinds_that_are_alike_give_the_bits_of_one() {
    let gravity = DVec3::new(0.0, 0.0, -9.8);
    let mut one = world(
        OneKind([grain()]),
        block(7, 1),
        Domain::open(),
        gravity,
        true,
    );
    let kinds = ManyKinds(vec![grain(); 3]);
    let mut many = world(kinds, block(7, 3), Domain::open(), gravity, true);
    one.advance(4000);
    many.advance(4000);
    assert!(
        one.list_builds() > 1,
        "the lists were built anew on the way"
    );
    for i in 0..one.len() {
        assert_eq!(one.identity(i), many.identity(i));
        assert_eq!(one.position(i), many.position(i));
        assert_eq!(one.velocity(i), many.velocity(i));
    }
}

#[test]
fn a_layer_in_space_moves_as_in_the_plane() {
    let places: Vec<DVec2> = (0..60)
        .map(|k| {
            DVec2::new(
                (k % 10) as f64 * 1.03 + 0.1 * (k / 10 % 2) as f64,
                (k / 10) as f64 * 1.02 + 0.6,
            ) * D
        })
        .collect();
    let flat = places
        .iter()
        .map(|&p| at::<Plane>(p, DVec2::ZERO, 0))
        .collect();
    let solid = places
        .iter()
        .map(|p| at::<Space>(DVec3::new(p.x, 0.0, p.y), DVec3::ZERO, 0))
        .collect();
    let mut plane = world(
        OneKind([grain()]),
        flat,
        Domain::<Plane>::open(),
        DVec2::new(0.0, -9.8),
        true,
    );
    let mut space = world(
        OneKind([grain()]),
        solid,
        Domain::<Space>::open(),
        DVec3::new(0.0, 0.0, -9.8),
        true,
    );
    plane.advance(8000);
    space.advance(8000);
    let find = |id: u32| (0..space.len()).find(|&i| space.identity(i) == id).unwrap();
    for i in 0..plane.len() {
        let (p, s) = (plane.position(i), space.position(find(plane.identity(i))));
        // The lists, and with them the order of the sums, differ: rounding, grown over 8000 steps.
        assert!((Plane::to_space(p) - s).length() < 1e-9 * D, "{p} {s}");
    }
}

#[test]
fn health_names_the_grain_that_ran_away() {
    let mut grains = block(8, 1);
    grains[300].velocity = DVec3::new(0.0, 2.0e4, 0.0);
    let mut run = world(
        OneKind([grain()]),
        grains,
        Domain::open(),
        DVec3::ZERO,
        false,
    );
    run.advance(10);
    let Health::Runaway { grain, speed, .. } = run.health() else {
        panic!("a grain at 20 km/s is not fine");
    };
    assert_eq!(grain, 300);
    assert!((speed / 2.0e4 - 1.0).abs() < 0.01, "{speed}");
}

#[test]
fn a_bed_at_rest_weighs_on_the_floor() {
    let gravity = DVec3::new(0.0, 0.0, -9.8);
    let column = (0..6)
        .map(|k| at::<Space>(DVec3::Z * D * (k as f64 + 0.5), DVec3::ZERO, 0))
        .collect();
    let mut run = world(OneKind([grain()]), column, Domain::open(), gravity, true);
    run.advance(60_000);
    let weight = 6.0 * grain().mass * 9.8;
    let felt = -run.bodies()[0].force.z;
    // At rest the balance is exact; what is left is the last of the ringing.
    assert!((felt / weight - 1.0).abs() < 1e-6, "{felt} of {weight}");
    run.remove_body(0);
    run.advance(2000);
    assert!(
        run.velocity(0).z < -9.8 * 2000.0 * 1.5e-6 * 0.99,
        "without a floor they fall"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn momentum_is_kept_in_a_periodic_gas(seed in 1u64..1000, speed in 0.01..1.0f64) {
        let draw = |k: u64| ((k.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(seed * 1_442_695)) >> 33) as f64 / 2f64.powi(31) - 0.5;
        let side = 6.0 * 1.2 * D;
        let grains: Vec<Placed<Space>> = block(6, 1)
            .into_iter()
            .enumerate()
            .map(|(i, g)| {
                let i = i as u64;
                let v = DVec3::new(draw(3 * i), draw(3 * i + 1), draw(3 * i + 2)) * (2.0 * speed);
                at::<Space>(g.position * (1.2 / 1.06), v, 0)
            })
            .collect();
        let mut run = world(OneKind([grain()]), grains, Domain { period: DVec3::splat(side) }, DVec3::ZERO, false);
        let momentum = |run: &dyn View<Space, Still>| (0..run.len()).fold(DVec3::ZERO, |sum, i| sum + run.velocity(i));
        let before = momentum(&run);
        run.advance(3000);
        // Forces are odd to the bit; what remains is the rounding of each addition to a velocity.
        prop_assert!((momentum(&run) - before).length() < 1e-12 * speed * run.len() as f64);
        prop_assert!(run.list_builds() > 1);
    }
}
