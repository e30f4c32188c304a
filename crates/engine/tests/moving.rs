//! Bodies that move and grains that come and go.

mod common;

use common::{D, FINE, USUAL, at, law, pool, steady, turning};
use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_engine::{Body, Lanes, OneKind, Placed, Setup, TouchesAt, WithTally, World};
use tsubu_integrate::Scheme;
use tsubu_model::{
    Change, Course, Domain, HitBuffer, Kind, Motion, Shift, Space, Span, Still, Surface, View,
};
use tsubu_sdf::{Cuboid, HalfSpace};

type Tallied = World<Space, Still, OneKind, Repulsion, RepulsiveWall, WithTally>;

fn plane(outward: DVec3, friction: f64, motion: Motion) -> Body<Space, RepulsiveWall> {
    Body {
        name: "wall".into(),
        surface: Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, outward)),
        law: RepulsiveWall {
            grains: law(),
            restitution: Some(0.5),
            friction,
        },
        touches_at: TouchesAt::Surface,
        removed_at: None,
        motion,
        waits: false,
    }
}

fn world(
    body: Body<Space, RepulsiveWall>,
    grains: Vec<Placed<Space>>,
    gravity: f64,
    dt: f64,
    scheme: Scheme,
    threads: usize,
) -> Tallied {
    World::new(Setup {
        kinds: OneKind([Kind::sphere(D, 1370.0)]),
        law: law(),
        bodies: vec![body],
        domain: Domain::open(),
        gravity: DVec3::new(0.0, 0.0, -gravity),
        scheme,
        dt,
        skin: None,
        lanes: Lanes::best(),
        pool: pool(threads),
        grains,
        gates: vec!["in".into(), "out".into()],
    })
}

#[test]
fn a_wall_that_runs_into_a_grain_is_a_grain_that_runs_into_a_wall() {
    for scheme in Scheme::ALL.into_iter().skip(1) {
        let (place, speed) = (DVec3::new(0.0, 0.0, 0.6 * D), DVec3::new(0.3, 0.0, 0.7));
        let hit = |velocity: DVec3, motion: Motion| {
            let mut world = world(
                plane(DVec3::Z, 0.4, motion),
                vec![at(place, velocity)],
                0.0,
                FINE,
                scheme,
                1,
            );
            world.advance(40_000);
            world.velocity(0)
        };
        let seen_from_the_wall = hit(DVec3::ZERO, steady(speed)) - speed;
        let at_rest = hit(-speed, Motion::default());
        assert!(
            at_rest.z > 0.3,
            "{scheme:?}: the grain is off again: {at_rest}"
        );
        assert!(
            (seen_from_the_wall - at_rest).length() < 1e-6,
            "{scheme:?}: {seen_from_the_wall} against {at_rest}"
        );
    }
}

#[test]
fn a_belt_takes_a_grain_along_and_its_drive_pays_for_it() {
    let belt = plane(DVec3::Z, 0.4, steady(DVec3::X * 0.2));
    let sag = Kind::sphere(D, 1370.0).mass * 9.80665 / law().stiffness();
    let mut world = world(
        belt,
        // At the height at which the contact carries the weight.
        vec![at(DVec3::new(0.0, 0.0, 0.5 * D - sag), DVec3::ZERO)],
        9.80665,
        USUAL,
        Scheme::SymplecticEuler,
        1,
    );
    let start = world.energies().total();
    let mass = world.kind(0).mass;
    // Sliding friction brings it to the speed of the belt after v/(μ g) = 51 ms.
    world.advance(20_000);
    let sliding = world.velocity(0).x / (0.4 * 9.80665 * 20_000.0 * USUAL);
    assert!(
        (sliding - 1.0).abs() < 0.01,
        "it speeds up by μ g: {sliding}"
    );
    world.advance(40_000);
    assert!((world.velocity(0).x - 0.2).abs() < 1e-4);
    let energies = world.energies();
    // On the way half of the drive's work becomes kinetic energy and half is lost: m v² in all.
    let paid = energies.work_of_bodies / (mass * 0.2 * 0.2);
    assert!((paid - 1.0).abs() < 0.01, "{paid}");
    assert!((energies.total() - start).abs() < 0.01 * mass * 0.2 * 0.2);
    let load = &world.bodies()[0];
    let floor = load.force.z / (-mass * 9.80665);
    assert!((floor - 1.0).abs() < 1e-3, "it carries the weight: {floor}");
}

#[test]
fn a_paddle_that_turns_throws_a_grain_with_the_energy_of_its_torque() {
    // A plane through the axis y at the origin, turning towards the grain at 20 rad/s.
    let paddle = plane(DVec3::Z, 0.3, turning(DVec3::ZERO, -20.0));
    let mut world = world(
        paddle,
        vec![at(DVec3::new(20.0 * D, 0.0, 0.52 * D), DVec3::ZERO)],
        0.0,
        FINE,
        Scheme::SymplecticEuler,
        1,
    );
    let (mut work, mut start) = (0.0, None);
    for _ in 0..40_000 {
        // The force of a step belongs to the step that follows the look.
        world.advance(1);
        start.get_or_insert(world.energies().total());
        work += world.bodies()[0].power() * FINE;
    }
    let energies = world.energies();
    let speed = world.velocity(0).length();
    // (1 + e) times the speed of the paddle at the grain.
    let thrown = speed / (1.5 * 20.0 * 20.0 * D);
    assert!((thrown - 1.0).abs() < 0.01, "{thrown}");
    assert!((energies.work_of_bodies / work - 1.0).abs() < 1e-9);
    let drift = (energies.total() - start.unwrap_or(f64::NAN)).abs() / energies.kinetic;
    assert!(drift < 0.01, "{drift}");
}

#[test]
fn a_body_that_waits_rests_until_it_is_started() {
    let mut body = plane(DVec3::Z, 0.4, steady(DVec3::X));
    body.waits = true;
    let mut world = world(body, vec![], 9.8, USUAL, Scheme::SymplecticEuler, 1);
    world.advance(100);
    assert_eq!(world.bodies()[0].pose.shift, DVec3::ZERO);
    world.apply(&[Change::StartBody(0)]);
    world.advance(100);
    let gone = world.bodies()[0].pose.shift.x / USUAL;
    assert!(
        (98.9..100.1).contains(&gone),
        "a hundred steps from the start on: {gone}"
    );
    assert_eq!(world.bodies()[0].pose.velocity, DVec3::X);
}

/// A block of grains a little above z = 0, falling.
fn block() -> Vec<Placed<Space>> {
    (0..14 * 14 * 14)
        .map(|k: usize| {
            let cell = DVec3::new(
                (k % 14) as f64,
                (k / 14 % 14) as f64,
                (k / 196) as f64 + 2.0,
            );
            let shake = DVec3::new(
                ((k * 7919) % 1000) as f64,
                ((k * 104_729) % 1000) as f64,
                0.0,
            );
            at(
                (cell + shake * 1e-4) * (1.1 * D),
                DVec3::new(0.0, 0.0, -0.3),
            )
        })
        .collect()
}

/// A block of grains that falls on a floor which turns a little below it.
fn falling(threads: usize) -> Tallied {
    world(
        plane(DVec3::Z, 0.4, turning(DVec3::new(7.0 * D, 0.0, 0.0), 3.0)),
        block(),
        9.8,
        USUAL,
        Scheme::SymplecticEuler,
        threads,
    )
}

fn gates_at_work(threads: usize) -> (Tallied, f64) {
    let mut world = falling(threads);
    let start = world.energies().total();
    for round in 0..6u32 {
        world.advance(700);
        let mut changes: Vec<Change> = (0..300)
            .map(|k| Change::Remove {
                identity: 5 + 9 * (k + 40 * round),
                gate: 1,
            })
            .collect();
        changes.push(Change::Move {
            identity: 6 + 9 * round,
            position: DVec3::new(0.0, 0.0, (40.0 + 2.0 * f64::from(round)) * D),
            gate: 1,
        });
        for k in 0..40 {
            changes.push(Change::Add {
                position: DVec3::new(2.0 * f64::from(k), 3.0 * f64::from(round), 60.0) * D,
                kind: 0,
                gate: 0,
            });
        }
        world.apply(&changes);
    }
    world.advance(700);
    (world, start)
}

#[test]
fn grains_come_and_go_and_the_books_of_number_and_energy_close() {
    let (world, start) = gates_at_work(1);
    let passages = world.passages();
    assert_eq!(
        (passages[0].came, passages[0].went, passages[1].moved),
        (240, 0, 6)
    );
    assert_eq!(
        world.len() as u64,
        14 * 14 * 14 + passages[0].came - passages[1].went
    );
    let mass = passages[1].mass / world.kind(0).mass;
    assert!((mass - (passages[1].went + passages[1].moved) as f64).abs() < 1e-6);
    let mut identities: Vec<u32> = (0..world.len()).map(|i| world.identity(i)).collect();
    identities.sort_unstable();
    identities.dedup();
    assert_eq!(identities.len(), world.len(), "identities are never reused");
    assert!(
        identities
            .last()
            .is_some_and(|&last| last == 14 * 14 * 14 + 239)
    );
    let energies = world.energies();
    let through = energies.kinetic + energies.lost_damping + energies.lost_wall_damping;
    let missing = (energies.total() - start).abs() / through;
    assert!(missing < 0.01, "{missing}");
}

#[test]
fn threads_change_no_bit_of_a_scene_with_gates_and_moving_bodies() {
    let (one, _) = gates_at_work(1);
    for threads in [2, 3] {
        let (many, _) = gates_at_work(threads);
        assert_eq!(one.len(), many.len());
        for i in 0..one.len() {
            assert_eq!(one.identity(i), many.identity(i));
            assert_eq!(one.position(i), many.position(i));
            assert_eq!(one.velocity(i), many.velocity(i));
        }
        assert_eq!(one.bodies()[0].torque, many.bodies()[0].torque);
        assert_eq!(
            one.energies().work_of_bodies,
            many.energies().work_of_bodies
        );
        assert!(one.velocity(0).is_finite());
    }
}

/// The same surface, which grants no grain any room: none sleeps.
struct Restless(Cuboid<Space>);

impl Surface<Space> for Restless {
    fn lower_bound(&self, x: DVec3) -> f64 {
        self.0.lower_bound(x)
    }
    fn room(&self, _: DVec3, _: f64) -> f64 {
        -1.0
    }
    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        self.0.hits(x, reach, out);
    }
    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        self.0.outline(low, high)
    }
    fn bounds(&self) -> Option<[DVec3; 2]> {
        self.0.bounds()
    }
}

#[test]
fn grains_that_sleep_near_a_moving_body_wake_in_time() {
    // A bar that turns through the falling block and shakes along its axis.
    let bar = Cuboid::<Space>::new(
        DVec3::new(-8.0, 4.0, -1.0) * D,
        DVec3::new(8.0, 9.0, 1.0) * D,
    )
    .unwrap();
    let motion = Motion {
        shifts: vec![Shift {
            direction: DVec3::Y,
            course: Course::Swing {
                amplitude: 0.5 * D,
                frequency: 40.0,
            },
            span: Span::ALWAYS,
        }],
        ..turning(DVec3::ZERO, 12.0)
    };
    let run = |surface: Arc<dyn Surface<Space>>, scheme: Scheme| {
        let body = Body {
            surface,
            ..plane(DVec3::Z, 0.4, motion.clone())
        };
        let mut world = world(body, block(), 9.8, USUAL, scheme, 1);
        world.advance(4000);
        world
    };
    for scheme in [
        Scheme::SymplecticEuler,
        Scheme::VerletOld,
        Scheme::VerletAveraged { sweeps: 4 },
    ] {
        let (asleep, awake) = (
            run(Arc::new(bar), scheme),
            run(Arc::new(Restless(bar)), scheme),
        );
        let pushed = asleep.energies().work_of_bodies.abs();
        assert!(
            pushed > 1e-7 && pushed.is_finite(),
            "the bar works: {pushed}"
        );
        for i in 0..asleep.len() {
            assert_eq!(asleep.position(i), awake.position(i), "{scheme:?}");
        }
    }
}
