//! A program that simulates dry grains in the plane holds no water and no step in space. This test is that program: it steps
//! one such world and then looks for names in itself.

mod common;

use common::program_holds;
use glam::DVec2;
use tsubu_contact::SpringDashpot;
use tsubu_engine::{Lanes, NoTally, OneKind, Placed, Setup, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Plane, Spins, View};

#[test]
fn a_dry_plane_program_holds_neither_water_nor_a_step_in_space() {
    let mut world: World<Plane, Spins, OneKind, SpringDashpot, SpringDashpot, NoTally> =
        World::new(Setup {
            kinds: OneKind([Kind::with_mass(common::D, 1e-6)]),
            law: SpringDashpot::from_restitution(100.0, 0.5, 0.5e-6, 0.3, 0.5),
            bodies: Vec::new(),
            domain: Domain {
                period: DVec2::splat(f64::INFINITY),
            },
            gravity: DVec2::ZERO,
            scheme: Scheme::SymplecticEuler,
            dt: common::USUAL,
            skin: None,
            lanes: Lanes::best(),
            pool: None,
            grains: [0.0, 0.95]
                .map(|x| Placed {
                    position: DVec2::new(x * common::D, 0.0),
                    velocity: DVec2::ZERO,
                    kind: 0,
                })
                .to_vec(),
            gates: Vec::new(),
        });
    world.advance(10);
    assert!(world.velocity(0).x < 0.0);

    // Without the first two there would be no names to look for, and the rest would say nothing.
    assert!(program_holds("tsubu_*engine"));
    assert!(program_holds("Chunk<tsubu_model::dim::*Plane>"));
    assert!(!program_holds("tsubu_*stream"), "water in a dry program");
    assert!(
        !program_holds("Chunk<tsubu_model::dim::*Space>"),
        "a step in space in a program of the plane"
    );
}
