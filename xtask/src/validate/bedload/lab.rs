//! Single grains that turn, in the plane.

use glam::DVec2;
use std::sync::Arc;
use tsubu_contact::SpringDashpot;
use tsubu_engine::{Body, Lanes, NoTally, OneKind, Placed, Setup, TouchesAt, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Motion, Plane, Spins};
use tsubu_sdf::HalfSpace;

/// Diameter of paper B's sand in m.
pub const SAND: f64 = 0.5e-3;

/// Grains in the plane under law SpringDashpot.
pub type Lab = World<Plane, Spins, OneKind, SpringDashpot, SpringDashpot, NoTally>;

/// A level floor at height 0.
pub fn floor(law: SpringDashpot) -> Body<Plane, SpringDashpot> {
    Body {
        name: "floor".into(),
        surface: Arc::new(HalfSpace::<Plane>::new(DVec2::ZERO, DVec2::Y)),
        law,
        touches_at: TouchesAt::Surface,
        removed_at: None,
        motion: Motion::default(),
        waits: false,
    }
}

/// These grains (place, velocity) in open space.
pub fn lab(
    kind: Kind,
    law: SpringDashpot,
    bodies: Vec<Body<Plane, SpringDashpot>>,
    gravity: DVec2,
    dt: f64,
    grains: &[(DVec2, DVec2)],
) -> Lab {
    World::new(Setup {
        kinds: OneKind([kind]),
        law,
        bodies,
        domain: Domain::open(),
        gravity,
        scheme: Scheme::SymplecticEuler,
        dt,
        skin: None,
        lanes: Lanes::best(),
        pool: None,
        grains: grains
            .iter()
            .map(|&(position, velocity)| Placed {
                position,
                velocity,
                kind: 0,
            })
            .collect(),
        gates: Vec::new(),
    })
}
