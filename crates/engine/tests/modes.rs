//! The stiffest motion of a packing against closed forms.

mod common;

use common::{D, law};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use tsubu_contact::{Repulsion, RepulsiveWall, SpringDashpot};
use tsubu_engine::{Body, Lanes, NoTally, OneKind, Placed, Setup, TouchesAt, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Motion, Plane, Space, Spins, Still};
use tsubu_sdf::HalfSpace;

/// A column of `count` touching grains on a floor: λ = (2 + 2 cos(2π/(2n + 1))) kΔt²/m without damping
/// (reference: a chain fixed at one end). Overlaps of 1e-6 change k by 2e-5.
#[test]
fn a_column_on_a_floor() {
    let grains = Repulsion::new(law().epsilon, law().sigma, 0.0, 0.0, D);
    let kind = Kind::sphere(D, 1370.0);
    let range = D * (1.0 - 1e-6);
    for (count, factor) in [(1, 1.0), (2, 2.618_03), (3, 3.246_98), (4, 3.532_09)] {
        let dt = 1e-8;
        let world: World<Space, Still, OneKind, Repulsion, RepulsiveWall, NoTally> =
            World::new(Setup {
                kinds: OneKind([kind]),
                law: grains,
                bodies: vec![Body {
                    name: "floor".into(),
                    surface: Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z)),
                    law: RepulsiveWall {
                        grains,
                        restitution: None,
                        friction: 0.0,
                    },
                    touches_at: TouchesAt::Surface,
                    removed_at: None,
                    motion: Motion::default(),
                    waits: false,
                }],
                domain: Domain::open(),
                gravity: DVec3::ZERO,
                scheme: Scheme::SymplecticEuler,
                dt,
                skin: None,
                lanes: Lanes::best(),
                pool: None,
                grains: (0..count)
                    .map(|k| Placed {
                        position: DVec3::Z * range * (0.5 + f64::from(k)),
                        velocity: DVec3::ZERO,
                        kind: 0,
                    })
                    .collect(),
                gates: Vec::new(),
            });
        let expected = factor * grains.stiffness() * dt * dt / kind.mass;
        let found = world.stiffest_mode();
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{count} grains: {found:e}, expected {expected:e}"
        );
    }
}

/// Paper B's constants at β = 1 and 15.8 (reference: table of its stability): a pair that rolls on itself 5.84 and 5.69,
/// a periodic hexagonal packing 26.2 and 25.5, in which rotation is the stiffest mode. Three digits as printed: 0.5 %.
/// The packing of 12 × 12 holds the mode of the infinite one.
#[test]
fn a_pair_and_a_hexagonal_packing_that_turn() {
    let d = 0.5e-3;
    let volume = std::f64::consts::PI / 6.0 * d * d * d;
    let dry = Kind::with_mass(d, 2650.0 * volume);
    let kind = Kind {
        mass: 3150.0 * volume,
        ..dry
    };
    let dt = 2e-5;
    // Drawn together by 1e-6, so that neighbours touch.
    let a = d * (1.0 - 1e-6);
    let hexagonal = (0..144).map(|k| {
        let (column, row) = (k % 12, k / 12);
        DVec2::new(
            (f64::from(column) + 0.5 * f64::from(row % 2)) * a,
            0.75f64.sqrt() * f64::from(row) * a,
        )
    });
    let pair = vec![DVec2::ZERO, DVec2::X * a];
    let period = DVec2::new(12.0 * a, 12.0 * 0.75f64.sqrt() * a);
    let open = DVec2::splat(f64::INFINITY);
    for (places, period, expected) in [
        (pair, open, [5.84, 5.69]),
        (hexagonal.collect(), period, [26.2, 25.5]),
    ] {
        for (beta, expected) in [1.0, 15.8].into_iter().zip(expected) {
            let law = SpringDashpot::from_time_step(dt, kind.mass, 20.0, 1.3, 0.3, 0.577);
            let world: World<Plane, Spins, OneKind, SpringDashpot, SpringDashpot, NoTally> =
                World::new(Setup {
                    kinds: OneKind([kind]),
                    law: law.scaled_by(beta),
                    bodies: Vec::new(),
                    domain: Domain { period },
                    gravity: DVec2::ZERO,
                    scheme: Scheme::SymplecticEuler,
                    dt,
                    skin: None,
                    lanes: Lanes::best(),
                    pool: None,
                    grains: places
                        .iter()
                        .map(|&position| Placed {
                            position,
                            velocity: DVec2::ZERO,
                            kind: 0,
                        })
                        .collect(),
                    gates: Vec::new(),
                });
            let found = world.stiffest_mode();
            println!("{} grains, β = {beta}: {found:.3}", places.len());
            assert!(
                (found / expected - 1.0).abs() < 5e-3,
                "{found}, expected {expected}"
            );
        }
    }
}
