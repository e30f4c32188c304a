//! The scenes that benches step: a dense bed of still grains, of grains that turn, and of two sizes.
#![allow(dead_code)] // each bench takes what it needs

use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{Repulsion, RepulsiveWall, SpringDashpot, Stretch};
use tsubu_engine::{
    Body, KindSet, Lanes, ManyKinds, NoTally, OneKind, Placed, Setup, Tally, TouchesAt, World,
};
use tsubu_integrate::Scheme;
use tsubu_model::{
    ContactLaw, Domain, Kind, Motion, Numbers, Space, SpinState, Spins, Still, Touch,
};
use tsubu_sdf::{Ball, DistanceGrid, GridOptions, HalfSpace, Mesh};

/// Diameter in m and mass in kg of paper A's coke.
pub const COKE: (f64, f64) = (1.350e-3, 1.7649e-6);

/// A face-centred cubic bed, every grain in touch with twelve: the densest work a force loop can have.
pub fn bed(cells: usize) -> (Vec<Placed<Space>>, DVec3) {
    let side = 2f64.sqrt() * COKE.0 * 0.9999;
    let mut grains = Vec::new();
    for k in 0..2 * cells {
        for j in 0..2 * cells {
            for i in (0..2 * cells).filter(|i| (i + j + k) % 2 == 0) {
                let position = DVec3::new(i as f64, j as f64, k as f64 + 1.4) * (0.5 * side);
                grains.push(Placed {
                    position,
                    velocity: DVec3::ZERO,
                    kind: 0,
                });
            }
        }
    }
    let length = cells as f64 * side;
    (grains, DVec3::new(length, length, f64::INFINITY))
}

/// Coke softened by 1000.
pub fn repulsion() -> Repulsion {
    Repulsion::new(9.434e-5, 1.203e-3, 3.975e-3, 3.975e-3, COKE.0)
}

/// Springs of about the same stiffness.
pub fn springs() -> SpringDashpot {
    SpringDashpot::new(3725.2, 1432.8, 3.9746e-3, 1.9873e-3, 0.413)
}

/// A bed on a floor; grains of several kinds take turns.
pub fn world<S: SpinState, K: KindSet, L, W, T: Tally>(
    cells: usize,
    kinds: K,
    (law, wall): (L, W),
    lanes: Lanes,
    scheme: Scheme,
) -> World<Space, S, K, L, W, T>
where
    L: ContactLaw<Space, S>,
    W: ContactLaw<Space, S>,
{
    let (mut grains, period) = bed(cells);
    let many = kinds.all().len();
    for (number, grain) in grains.iter_mut().enumerate() {
        grain.kind = number % many;
    }
    World::new(Setup {
        kinds,
        law,
        bodies: vec![Body {
            name: "floor".into(),
            surface: Arc::new(HalfSpace::new(DVec3::ZERO, DVec3::Z)),
            law: wall,
            touches_at: TouchesAt::Surface,
            removed_at: None,
            motion: Motion::default(),
            waits: false,
        }],
        domain: Domain { period },
        gravity: DVec3::new(0.0, 0.0, -9.80665),
        scheme,
        dt: 4.8e-6,
        skin: None,
        lanes,
        pool: None,
        grains,
        gates: Vec::new(),
    })
}

/// The wall of the scenes with law Repulsion.
pub fn wall() -> RepulsiveWall {
    RepulsiveWall {
        grains: repulsion(),
        restitution: Some(0.5),
        friction: 0.413,
    }
}

/// Grains of one kind.
pub fn alike() -> OneKind {
    OneKind([Kind::with_mass(COKE.0, COKE.1)])
}

/// Grains of two sizes.
pub fn mixture() -> ManyKinds {
    let kind = |scale: f64| Kind::with_mass(COKE.0 * scale, COKE.1 * scale.powi(3));
    ManyKinds(vec![kind(1.0), kind(0.95)])
}

/// A bed of law Repulsion.
pub fn still_bed(
    cells: usize,
    lanes: Lanes,
) -> World<Space, Still, OneKind, Repulsion, RepulsiveWall, NoTally> {
    let laws = (repulsion(), wall());
    world(cells, alike(), laws, lanes, Scheme::SymplecticEuler)
}

/// A bed of two sizes.
pub fn mixed_bed(
    cells: usize,
    lanes: Lanes,
) -> World<Space, Still, ManyKinds, Repulsion, RepulsiveWall, NoTally> {
    let laws = (repulsion(), wall());
    world(cells, mixture(), laws, lanes, Scheme::SymplecticEuler)
}

/// A bed of law SpringDashpot, with spin and memory.
pub fn turning_bed(
    cells: usize,
    lanes: Lanes,
) -> World<Space, Spins, OneKind, SpringDashpot, SpringDashpot, NoTally> {
    let laws = (springs(), springs());
    world(cells, alike(), laws, lanes, Scheme::SymplecticEuler)
}

/// A grid of distances from a ball of 10 mm, and points around it that grains of coke may touch it from.
pub fn ball() -> (DistanceGrid, Vec<DVec3>, Vec<f64>) {
    let shell =
        Ball::new(DVec3::ZERO, 10e-3).map(|ball| tsubu_model::Surface::<Space>::shell(&ball));
    let shell = shell.ok().flatten().unwrap_or_default();
    let mesh = Mesh::from(shell);
    let options = GridOptions::new(1e-3, 4e-3);
    let grid = DistanceGrid::build(&mesh, &options, &|_| ()).expect("a ball has an inside");
    let points: Vec<DVec3> = (0..512)
        .map(|k| {
            // A spiral over the ball, half of it within reach.
            let (turn, height) = (2.399_963 * k as f64, (k as f64 + 0.5) / 256.0 - 1.0);
            let wide = (1.0 - height * height).sqrt();
            let out = DVec3::new(wide * turn.cos(), wide * turn.sin(), height);
            out * (10e-3 + 0.5 * COKE.0 * (0.5 + (k % 4) as f64 / 3.0))
        })
        .collect();
    let reach = vec![0.5 * COKE.0; points.len()];
    (grid, points, reach)
}

/// Where the grains of a bed are, and its box.
pub fn lone_bed(cells: usize) -> (Vec<DVec3>, Domain<Space>) {
    let (grains, period) = bed(cells);
    let domain = Domain { period };
    let places = grains.iter().map(|grain| domain.wrap(grain.position));
    (places.collect(), domain)
}

/// The law of springs over a sweep of contacts, one after the other; how many.
pub fn law() -> usize {
    let kind = Kind::with_mass(COKE.0, COKE.1);
    let pair = ContactLaw::<Space, Spins>::pair(&springs(), &kind, &kind);
    let mut sum = DVec3::ZERO;
    let many = 1000;
    for k in 0..many {
        let apart = DVec3::new(0.6, 0.64, 0.48) * COKE.0 * (0.97 + 0.04 * k as f64 / many as f64);
        let touch = Touch::<Space, Spins> {
            apart,
            velocity: DVec3::new(0.01, -0.02, 0.005),
            r2: apart.length_squared(),
            reach: COKE.0,
            spin: DVec3::new(0.0, 0.01, 0.0),
            roll: DVec3::ZERO,
        };
        let mut memory = Stretch::zero();
        let push = SpringDashpot::force(&pair, &touch, &mut memory, 4.8e-6);
        sum += push.total();
    }
    assert!(std::hint::black_box(sum).is_finite());
    many
}
