//! Grains that turn and contacts that remember.

mod common;

use common::pool;
use glam::{DVec2, DVec3};
use std::sync::Arc;
use tsubu_contact::SpringDashpot;
use tsubu_engine::{
    Body, Lanes, Layout, ManyKinds, NoTally, OneKind, Placed, Setup, TouchesAt, World,
};
use tsubu_integrate::Scheme;
use tsubu_model::{
    Change, Damaged, Dim, Domain, Kind, Load, Motion, Plane, Saved, Seen, Space, Spins, Vector,
    View, Words, uniform,
};
use tsubu_sdf::HalfSpace;

/// Diameter in m and mass in kg of a grain.
const D: f64 = 1e-3;
const MASS: f64 = 1e-6;

type Spinning<D> = World<D, Spins, OneKind, SpringDashpot, SpringDashpot, NoTally>;

fn law(friction: f64) -> SpringDashpot {
    SpringDashpot::from_restitution(100.0, 0.5, 0.5 * MASS, 0.3, friction)
}

/// A floor whose outward normal leans by `lean` rad from the vertical towards −x.
fn floor<D: Layout>(friction: f64, lean: f64) -> Body<D, SpringDashpot> {
    let outward = D::from_space(DVec3::new(-lean.sin(), 0.0, lean.cos()));
    Body {
        name: "floor".into(),
        surface: Arc::new(HalfSpace::<D>::new(D::V::ZERO, outward)),
        law: law(friction),
        touches_at: TouchesAt::Surface,
        removed_at: None,
        motion: Motion::default(),
        waits: false,
    }
}

struct Scene {
    friction: f64,
    dt: f64,
    skin: Option<f64>,
    lanes: Lanes,
    threads: usize,
    domain: f64,
}

const PLAIN: Scene = Scene {
    friction: 0.5,
    dt: 1e-6,
    skin: None,
    lanes: Lanes::Portable,
    threads: 1,
    domain: f64::INFINITY,
};

fn world<D: Layout>(
    scene: &Scene,
    grains: Vec<Placed<D>>,
    bodies: Vec<Body<D, SpringDashpot>>,
) -> Spinning<D> {
    World::new(Setup {
        kinds: OneKind([Kind::with_mass(self::D, MASS)]),
        law: law(scene.friction),
        bodies,
        domain: Domain {
            period: D::V::from_axes(|a| if a == 0 { scene.domain } else { f64::INFINITY }),
        },
        gravity: D::from_space(DVec3::new(0.0, 0.0, -9.81)),
        scheme: Scheme::SymplecticEuler,
        dt: scene.dt,
        skin: scene.skin,
        lanes: scene.lanes,
        pool: pool(scene.threads),
        grains,
        gates: vec!["gate".into()],
    })
}

fn at<D: Dim>(position: DVec3, velocity: DVec3) -> Placed<D> {
    Placed {
        position: D::from_space(position),
        velocity: D::from_space(velocity),
        kind: 0,
    }
}

/// A heap of `count` grains in random places, two d apart at most, on a floor.
fn heap(scene: &Scene, count: usize) -> Spinning<Space> {
    let side = (count as f64).cbrt().ceil() as usize;
    let grains = (0..count)
        .map(|k| {
            let draw = |event| 0.05 * uniform(3, k as u64, event);
            let place = DVec3::new(
                (k % side) as f64 + draw(0),
                (k / side % side) as f64 + draw(1),
                (k / side / side) as f64 + 0.5 + draw(2),
            );
            at(1.06 * D * place, DVec3::new(draw(3), draw(4), -draw(5)))
        })
        .collect();
    world(scene, grains, vec![floor(scene.friction, 0.0)])
}

fn state<D: Layout>(run: &Spinning<D>) -> Vec<(D::V, D::V, D::W)> {
    let mut order: Vec<usize> = (0..run.len()).collect();
    order.sort_by_key(|&i| run.identity(i));
    let of = |i: usize| (run.position(i), run.velocity(i), run.spin(i));
    order.into_iter().map(of).collect()
}

/// v = 5/7 v₀ once it rolls, ω = v/r; at μ = 0.5 after 2v₀/(7μg) = 5.8 ms (reference: sliding to rolling). The contact
/// is settled at the start; steps of 1 µs leave 1e-3.
#[test]
fn a_grain_that_slides_ends_up_rolling() {
    fn rolls<D: Layout>() {
        let rest = 0.5 * self::D - MASS * 9.81 / law(0.5).normal_stiffness;
        let grain = at(DVec3::Z * rest, DVec3::X * 0.1);
        let mut run: Spinning<D> = world(&PLAIN, vec![grain], vec![floor(0.5, 0.0)]);
        run.advance(20_000);
        let velocity = D::to_space(run.velocity(0));
        assert!(
            (velocity.x / (5.0 / 7.0 * 0.1) - 1.0).abs() < 1e-3,
            "{velocity}"
        );
        // To the right it turns about +y: clockwise in a picture with z up.
        let spin = D::spin_to_space(run.spin(0));
        assert!(
            (spin.y * 0.5 * self::D / velocity.x - 1.0).abs() < 1e-3,
            "{spin}"
        );
    }
    rolls::<Plane>();
    rolls::<Space>();
}

/// Two grains that collide keep momentum to rounding, and angular momentum about any point up to the overlap, which the
/// lever arms do not see: δ/d is 2e-3 here, so 1 % of what is exchanged is a wide bound, and a wrong sign is far off.
#[test]
fn a_collision_keeps_momentum_and_angular_momentum() {
    let grains = vec![
        at(DVec3::new(0.0, 0.0, 0.0), DVec3::new(0.2, 0.0, 0.0)),
        at(
            DVec3::new(0.0009, 0.0002, 0.0005),
            DVec3::new(0.0, 0.1, 0.0),
        ),
    ];
    let mut run: Spinning<Space> = World::new(Setup {
        kinds: OneKind([Kind::with_mass(D, MASS)]),
        law: law(0.4),
        bodies: Vec::new(),
        domain: Domain::open(),
        gravity: DVec3::ZERO,
        scheme: Scheme::SymplecticEuler,
        dt: 1e-7,
        skin: None,
        lanes: Lanes::Portable,
        pool: None,
        grains,
        gates: Vec::new(),
    });
    run.set_spin(0, DVec3::new(30.0, -200.0, 100.0));
    run.set_spin(1, DVec3::new(-50.0, 80.0, 10.0));
    let sum = |run: &Spinning<Space>| {
        let inertia = run.kind(0).inertia;
        (0..2).fold((DVec3::ZERO, DVec3::ZERO), |(p, l), i| {
            let (x, v) = (run.position(i), run.velocity(i));
            (p + MASS * v, l + MASS * x.cross(v) + inertia * run.spin(i))
        })
    };
    let (before, spin_before) = (sum(&run), run.spin(0));
    run.advance(40_000);
    let (after, spin_after) = (sum(&run), run.spin(0));
    let exchanged = run.kind(0).inertia * (spin_after - spin_before).length();
    assert!(exchanged > 1e-12, "they did not touch: {exchanged:e}");
    assert!((after.0 - before.0).length() < 1e-14 * before.0.length());
    assert!(
        (after.1 - before.1).length() < 0.01 * exchanged,
        "{:e} of {exchanged:e}",
        (after.1 - before.1).length()
    );
}

/// Lists built every few steps and lists built hardly ever give the same heap: what contacts remember, of each other
/// and of the floor, is carried over. Sums in another order differ by rounding, which 3000 steps let grow little.
#[test]
fn memory_survives_lists_that_are_built_anew() {
    let run = |skin: f64| {
        let mut run = heap(
            &Scene {
                skin: Some(skin * D),
                ..PLAIN
            },
            150,
        );
        run.advance(9000);
        (run.list_builds(), state(&run))
    };
    let ((often, a), (rarely, b)) = (run(0.002), run(0.6));
    assert!(often > 20 * rarely, "{often} and {rarely}");
    let apart = a
        .iter()
        .zip(&b)
        .map(|(a, b)| (a.0 - b.0).length())
        .fold(0.0, f64::max);
    let moved = a.iter().map(|a| a.2.length()).fold(0.0, f64::max);
    println!(
        "{often} builds against {rarely}: {:e} d apart, spins up to {moved} rad/s",
        apart / D
    );
    assert!(apart < 1e-9 * D && moved > 1.0);
}

/// The bits do not depend on threads or vector path, with spins, memory, a floor, periodic sides and grains that are
/// put elsewhere and come.
#[test]
fn the_same_bits_for_any_thread_and_lane() {
    let run = |threads: usize, lanes: Lanes| {
        let mut run = heap(
            &Scene {
                threads,
                lanes,
                domain: 14.0 * D,
                ..PLAIN
            },
            1200,
        );
        for k in 0..4u32 {
            run.advance(150);
            let position = DVec3::new(3.0 * D, 3.0 * D, (30.0 + 2.0 * f64::from(k)) * D);
            run.apply(&[
                Change::Move {
                    identity: 100 * k,
                    position,
                    gate: 0,
                },
                Change::Remove {
                    identity: 7 + k,
                    gate: 0,
                },
                Change::Add {
                    position: position + DVec3::X * 2.0 * D,
                    kind: 0,
                    gate: 0,
                },
            ]);
        }
        run.advance(150);
        state(&run)
    };
    let expected = run(1, Lanes::Portable);
    for threads in [1, 2, 3] {
        for lanes in Lanes::ALL.into_iter().filter(|l| l.is_here()) {
            assert_eq!(
                run(threads, lanes),
                expected,
                "{threads} threads, {lanes:?}"
            );
        }
    }
}

/// A fixed grain is a kind of infinite mass: it holds others and stays.
#[test]
fn a_fixed_grain_stays_where_it_is() {
    let mut fixed = Kind::with_mass(D, f64::INFINITY);
    fixed.weight = 0.0;
    let mut run: World<Plane, Spins, ManyKinds, SpringDashpot, SpringDashpot, NoTally> =
        World::new(Setup {
            kinds: ManyKinds(vec![Kind::with_mass(D, MASS), fixed]),
            law: law(0.5),
            bodies: Vec::new(),
            domain: Domain::open(),
            gravity: DVec2::new(0.0, -9.81),
            scheme: Scheme::SymplecticEuler,
            dt: 1e-6,
            skin: None,
            lanes: Lanes::best(),
            pool: None,
            grains: [(-0.55, 0.0, 1), (0.55, 0.0, 1), (0.0, 0.9, 0)]
                .map(|(x, z, kind)| Placed {
                    position: DVec2::new(x, z) * D,
                    velocity: DVec2::ZERO,
                    kind,
                })
                .to_vec(),
            gates: Vec::new(),
        });
    run.advance(200_000);
    let state: Vec<_> = (0..3)
        .map(|i| (run.identity(i), run.position(i) / D, run.velocity(i)))
        .collect();
    for (identity, place, velocity) in state {
        let expected = match identity {
            0 => DVec2::new(-0.55, 0.0),
            1 => DVec2::new(0.55, 0.0),
            // On both: √(1 − 0.55²) above, less what springs of 100 N/m give way.
            _ => DVec2::new(0.0, (1.0f64 - 0.55 * 0.55).sqrt()),
        };
        assert!(
            (place - expected).length() < 1e-3 && velocity.length() < 1e-6,
            "{identity}: {place} {velocity}"
        );
    }
    assert!(run.energies().kinetic.is_finite());
}

/// A force that grows with identity and is asked for at every time.
struct Push;

/// It knows nothing but its constants.
impl Saved for Push {
    fn save(&self, _words: &mut Words) {}
    fn restore(&mut self, _words: &mut Words) -> Result<(), Damaged> {
        Ok(())
    }
}

impl Load<Space, Spins> for Push {
    fn is_due(&self, _t: f64) -> bool {
        false
    }
    fn renew(&mut self, _view: &dyn View<Space, Spins>, _t: f64) {}
    fn push(&self, _t: f64, grains: &[Seen<Space>], force: &mut [DVec3]) {
        for (grain, force) in grains.iter().zip(force) {
            *force += DVec3::X * MASS * f64::from(grain.identity);
        }
    }
}

/// a = F/m: after t the speed is a t for every grain, wherever it lies in memory.
#[test]
fn a_load_pushes_every_grain() {
    let grains = (0..700)
        .map(|k| at(DVec3::X * 2.0 * D * f64::from(k * 37 % 700), DVec3::ZERO))
        .collect();
    let mut run: Spinning<Space> = world(&PLAIN, grains, Vec::new());
    run.add_load(Box::new(Push));
    run.advance(100);
    for (identity, (_, velocity, _)) in state(&run).into_iter().enumerate() {
        assert!(
            (velocity.x - 1e-4 * identity as f64).abs() < 1e-12,
            "{identity}: {velocity}"
        );
    }
}

/// A grain that comes, and one that is put elsewhere, do not turn, whatever those turned whose place in memory they take.
#[test]
fn a_grain_that_comes_does_not_turn() {
    let place = |k: f64| DVec3::X * 3.0 * D * k;
    let grains = (0..4)
        .map(|k| at(place(f64::from(k)), DVec3::ZERO))
        .collect();
    let mut run: Spinning<Space> = world(&PLAIN, grains, Vec::new());
    for identity in 0..4 {
        run.set_spin(identity, DVec3::Y * 100.0);
    }
    run.apply(&[
        Change::Remove {
            identity: 3,
            gate: 0,
        },
        Change::Move {
            identity: 1,
            position: place(20.0),
            gate: 0,
        },
        Change::Add {
            position: place(30.0),
            kind: 0,
            gate: 0,
        },
    ]);
    for (i, identity) in (0..4).map(|i| (i, run.identity(i))) {
        let expected = match identity {
            0 | 2 => DVec3::Y * 100.0,
            _ => DVec3::ZERO,
        };
        assert_eq!(run.spin(i), expected, "grain {identity}");
    }
}
