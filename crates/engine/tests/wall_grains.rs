//! Bodies built of grains: the same contact as between two grains, books that close, the same bits.

mod common;

use common::{D, FINE, USUAL, at, law, pool, steady, turning};
use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{BodyLaw, Repulsion, RepulsiveWall, WallGrains};
use tsubu_engine::{
    Body, Lanes, ManyKinds, NoTally, OneKind, Placed, Setup, TouchesAt, WithTally, World,
};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Motion, Space, Still, Surface, View};
use tsubu_sdf::{Cuboid, GrainBody, GrainBodyOptions, Mesh};

/// Radius of a wall grain: q = rs/rp = 0.8.
const RS: f64 = 0.4 * D;

type Tallied = World<Space, Still, OneKind, Repulsion, BodyLaw, WithTally>;

/// A block of grains between two corners, moving.
fn block(low: DVec3, high: DVec3, motion: Motion) -> Body<Space, BodyLaw> {
    let shell = Cuboid::<Space>::new(low, high).unwrap().shell().unwrap();
    let mesh = Mesh {
        vertices: shell.vertices,
        triangles: shell.triangles,
        parts: Vec::new(),
    };
    let grains = GrainBody::build(&mesh, &GrainBodyOptions::new(RS, D)).unwrap();
    Body {
        name: "block".into(),
        surface: Arc::new(grains),
        law: BodyLaw::Grains(WallGrains {
            grains: law(),
            radius: RS,
        }),
        touches_at: TouchesAt::WallGrains(RS),
        removed_at: None,
        motion,
        waits: false,
    }
}

/// One wall grain, its centre at the origin.
fn one(motion: Motion) -> Body<Space, BodyLaw> {
    let half = DVec3::splat(RS);
    block(-half, half, motion)
}

fn setup<K>(
    kinds: K,
    bodies: Vec<Body<Space, BodyLaw>>,
    grains: Vec<Placed<Space>>,
    dt: f64,
    threads: usize,
) -> Setup<Space, K, Repulsion, BodyLaw> {
    Setup {
        kinds,
        law: law(),
        bodies,
        domain: Domain::open(),
        gravity: DVec3::ZERO,
        scheme: Scheme::SymplecticEuler,
        dt,
        skin: None,
        lanes: Lanes::best(),
        pool: pool(threads),
        grains,
        gates: Vec::new(),
    }
}

fn world(body: Body<Space, BodyLaw>, grains: Vec<Placed<Space>>, dt: f64) -> Tallied {
    let kinds = OneKind([Kind::sphere(D, 1370.0)]);
    World::new(setup(kinds, vec![body], grains, dt, 1))
}

/// A grain off the axis of a wall grain, about to touch it.
const ASIDE: DVec3 = DVec3::new(0.3 * D, 0.1 * D, 0.9 * D);
const STRIKES: DVec3 = DVec3::new(0.1, -0.2, -0.8);

#[test]
fn a_wall_grain_is_a_grain_of_endless_mass() {
    let mut wall = world(one(Motion::default()), vec![at(ASIDE, STRIKES)], FINE);
    wall.advance(30_000);
    // The same with two grains, one of them 10¹² times as heavy.
    let grain = Kind::sphere(D, 1370.0);
    let heavy = Kind::with_mass(2.0 * RS, 1e12 * grain.mass);
    let placed = Placed {
        kind: 1,
        ..at(DVec3::ZERO, DVec3::ZERO)
    };
    let kinds = ManyKinds(vec![grain, heavy]);
    let grains = vec![at(ASIDE, STRIKES), placed];
    let mut pair: World<Space, Still, ManyKinds, Repulsion, BodyLaw, NoTally> =
        World::new(setup(kinds, vec![], grains, FINE, 1));
    pair.advance(30_000);
    let thrown = (0..2).find(|&i| pair.identity(i) == 0).unwrap();
    let (v, w) = (wall.velocity(0), pair.velocity(thrown));
    assert!(v.z > 0.0, "it has struck and is off again: {v}");
    // The heavy grain takes 10⁻¹² of the speed, and rounding adds up over the contact.
    assert!((v - w).length() < 1e-9, "{v} against {w}");
}

#[test]
fn a_body_of_grains_that_runs_into_a_grain_is_a_grain_that_runs_into_it() {
    let speed = DVec3::new(0.3, -0.1, 0.7);
    let hit = |velocity: DVec3, motion: Motion| {
        let size = DVec3::new(5.0 * RS, 5.0 * RS, 3.0 * RS);
        let body = block(-size, DVec3::new(size.x, size.y, 0.0), motion);
        let place = DVec3::new(0.2 * D, 0.1 * D, 0.6 * D);
        let mut world = world(body, vec![at(place, velocity)], FINE);
        world.advance(40_000);
        world.velocity(0)
    };
    let seen_from_the_body = hit(DVec3::ZERO, steady(speed)) - speed;
    let at_rest = hit(-speed, Motion::default());
    assert!(at_rest.z > 0.1, "the grain is off again: {at_rest}");
    assert!(
        (seen_from_the_body - at_rest).length() < 1e-6,
        "{seen_from_the_body} against {at_rest}"
    );
}

#[test]
fn what_a_grain_feels_the_body_feels_in_return() {
    // A grain held by several wall grains of a turning block, for one step without weight.
    let body = block(
        DVec3::splat(-8.0 * RS),
        DVec3::splat(8.0 * RS),
        turning(DVec3::ZERO, 50.0),
    );
    let top = {
        let centres = body.surface.bounds().unwrap()[1].z;
        centres + 0.33 * D
    };
    let start = at(
        DVec3::new(1.1 * D, 0.2 * D, top),
        DVec3::new(0.0, 0.1, -0.2),
    );
    let mut world = world(body, vec![start], FINE);
    world.advance(1);
    let mass = world.kind(0).mass;
    let force = (world.velocity(0) - start.velocity) * (mass / FINE);
    let load = &world.bodies()[0];
    assert!(force.length() > 0.0);
    let rest = (load.force + force).length() / force.length();
    assert!(rest < 1e-9, "{} against {force}", load.force);
    // An elastic and a viscous force along the line of centres and across: the arm of the whole is
    // that of the wall grains' centres, so the torque is (x − r n) × F, within the layer's depth.
    let off = (load.torque - start.position.cross(load.force)).length();
    assert!(off < 1.1 * (0.5 * D + RS) * force.length(), "{off}");
}

#[test]
fn the_energy_books_of_a_turning_body_of_grains_close() {
    // A bar that turns about the axis y and strikes a row of grains.
    let bar = block(
        DVec3::new(2.0 * D, -2.0 * D, -2.0 * RS),
        DVec3::new(14.0 * D, 2.0 * D, 2.0 * RS),
        turning(DVec3::ZERO, -40.0),
    );
    let top = bar.surface.bounds().unwrap()[1].z;
    let grains = (0..8)
        .map(|k| {
            let x = (4.0 + 1.2 * f64::from(k)) * D;
            at(DVec3::new(x, 0.3 * D, top + 0.52 * D), DVec3::ZERO)
        })
        .collect();
    let mut world = world(bar, grains, FINE);
    let (mut work, mut start) = (0.0, None);
    for _ in 0..40_000 {
        // The force of a step belongs to the step that follows the look.
        world.advance(1);
        start.get_or_insert(world.energies().total());
        work += world.bodies()[0].power() * FINE;
    }
    let energies = world.energies();
    let struck = (0..8).filter(|&i| world.velocity(i).z > 0.1).count();
    assert_eq!(struck, 8, "every grain is thrown");
    assert!(energies.kinetic > 0.0 && energies.lost_wall_damping > 0.0);
    assert_eq!(energies.lost_wall_friction, 0.0);
    let given = (energies.work_of_bodies / work - 1.0).abs();
    assert!(
        given < 1e-9,
        "{} J against {work} J",
        energies.work_of_bodies
    );
    // First order in the step: 600 steps to a contact leave well below 1 %.
    let drift = (energies.total() - start.unwrap_or(f64::NAN)).abs() / energies.kinetic;
    assert!(drift < 0.01, "{drift}");
}

/// Grains that rain on a turning block of grains and on a plain wall beneath.
fn raining(threads: usize) -> Tallied {
    let grains = (0..1500)
        .map(|k: usize| {
            let cell = DVec3::new((k % 10) as f64, (k / 10 % 10) as f64, (k / 100) as f64);
            let shake = DVec3::new((k * 7919 % 1000) as f64, (k * 104_729 % 1000) as f64, 0.0);
            let x = (cell - DVec3::new(5.0, 5.0, -1.0) + shake * 1e-4) * (1.1 * D);
            at(x, DVec3::new(0.0, 0.0, -0.5))
        })
        .collect();
    let size = DVec3::new(6.0, 6.0, 0.5) * D;
    let mut floor = one(Motion::default());
    floor.name = "floor".into();
    floor.touches_at = TouchesAt::Surface;
    floor.surface = Arc::new(tsubu_sdf::HalfSpace::<Space>::new(
        DVec3::Z * (-4.0 * D),
        DVec3::Z,
    ));
    floor.law = BodyLaw::Surface(RepulsiveWall {
        grains: law(),
        restitution: Some(0.5),
        friction: 0.4,
    });
    let bodies = vec![block(-size, size, turning(DVec3::ZERO, 20.0)), floor];
    let kinds = OneKind([Kind::sphere(D, 1370.0)]);
    let mut world: Tallied = World::new(setup(kinds, bodies, grains, USUAL, threads));
    world.advance(1500);
    world
}

#[test]
fn threads_change_no_bit_beside_a_body_of_grains() {
    let one = raining(1);
    assert!(one.bodies()[0].torque.is_finite() && one.energies().lost_wall_damping > 0.0);
    assert!(one.energies().lost_wall_friction >= 0.0);
    for threads in [2, 3] {
        let many = raining(threads);
        for i in 0..one.len() {
            assert_eq!(one.identity(i), many.identity(i));
            assert_eq!(one.position(i), many.position(i));
            assert_eq!(one.velocity(i), many.velocity(i));
        }
        assert_eq!(one.bodies()[0].torque, many.bodies()[0].torque);
        assert_eq!(one.bodies()[0].force, many.bodies()[0].force);
        assert_eq!(
            one.energies().work_of_bodies,
            many.energies().work_of_bodies
        );
    }
}
