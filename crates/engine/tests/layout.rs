//! What a grain costs in memory: no coordinate and no spin is stored that its dimension does not have.

mod common;

use glam::DVec3;
use tsubu_contact::{RepulsiveWall, SpringDashpot};
use tsubu_engine::{Lanes, Layout, NoTally, OneKind, Placed, Setup, World};
use tsubu_integrate::Scheme;
use tsubu_model::{ContactLaw, Domain, Kind, Plane, Space, SpinState, Spins, Still, Vector};

/// Grains in a square of the plane of x and z: a multiple of a chunk, so that no chunk is partly empty.
const SIDE: usize = 64;

/// Bytes per grain of grains that far apart that no list has an entry: what they hold themselves.
fn bytes<D: Layout, S: SpinState, L: ContactLaw<D, S>, W: ContactLaw<D, S>>(law: L) -> f64 {
    let apart = 4.0 * common::D;
    let place = |k: usize| DVec3::new((k % SIDE) as f64, 0.0, (k / SIDE) as f64) * apart;
    let world: World<D, S, OneKind, L, W, NoTally> = World::new(Setup {
        kinds: OneKind([Kind::with_mass(common::D, 1.7649e-6)]),
        law,
        bodies: Vec::new(),
        domain: Domain {
            period: D::V::from_axes(|_| f64::INFINITY),
        },
        gravity: D::V::ZERO,
        scheme: Scheme::SymplecticEuler,
        dt: common::USUAL,
        skin: Some(0.1 * common::D),
        lanes: Lanes::Portable,
        pool: None,
        grains: (0..SIDE * SIDE)
            .map(|k| Placed {
                position: D::from_space(place(k)),
                velocity: D::V::ZERO,
                kind: 0,
            })
            .collect(),
        gates: Vec::new(),
    });
    world.bytes_per_grain()
}

#[test]
fn a_plane_grain_stores_no_third_coordinate_and_one_number_of_spin() {
    let springs = SpringDashpot::from_restitution(100.0, 0.5, 1e-6, 0.3, 0.5);
    let plane_spins = bytes::<Plane, Spins, _, SpringDashpot>(springs);
    let space_spins = bytes::<Space, Spins, _, SpringDashpot>(springs);
    let plane_still = bytes::<Plane, Still, _, RepulsiveWall>(common::law());
    let space_still = bytes::<Space, Still, _, RepulsiveWall>(common::law());
    // In space a grain has a second line for its spin (as the dummy has), and one coordinate more of its place at the last
    // list build and of its force; its torque has two numbers more. All else is the same.
    let n = (SIDE * SIDE) as f64;
    let second_line = 64.0 * (n + 1.0) / n;
    let more = space_spins - plane_spins;
    assert!(
        (more - (second_line + 8.0 + 8.0 + 16.0)).abs() < 1e-9,
        "{more}"
    );
    let more = space_still - plane_still;
    assert!((more - 16.0).abs() < 1e-9, "{more}");
    // A spin in the plane lies in the line that is there anyway: a torque comes, and what finds the contacts' memory again.
    let turning = plane_spins - plane_still;
    assert!((8.0..32.0).contains(&turning), "{turning}");
    // The line itself, place, force and identity; the rest is lists and what builds them.
    assert!((100.0..140.0).contains(&plane_still), "{plane_still}");
}

/// The counterpart of `plane_only.rs`: what steps in both dimensions holds the names that are absent there.
#[test]
fn a_program_of_both_dimensions_holds_both() {
    for name in ["Plane", "Space"] {
        assert!(
            common::program_holds(&format!("Chunk<tsubu_model::dim::*{name}>")),
            "{name}"
        );
    }
}
