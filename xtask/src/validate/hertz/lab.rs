//! A bench for few spheres of any kinds under law Hertz–Mindlin, in open space or over a level floor.

use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{HertzMindlin, Rolling};
use tsubu_engine::{Body, Lanes, Layout, ManyKinds, NoTally, Placed, Setup, TouchesAt, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Dim, Domain, Kind, Motion, Spins, View};
use tsubu_sdf::HalfSpace;

/// Gravity in m/s².
pub const GRAVITY: f64 = 9.806_65;

/// Spheres that turn, each of its own kind.
pub type Lab<D, R> = World<D, Spins, ManyKinds, HertzMindlin<R>, HertzMindlin<R>, NoTally>;

/// A sphere, at the start or later. In the plane y is left out and the spin is that about y.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Radius, mass, inertia.
    pub kind: Kind,
    /// Centre in m.
    pub place: DVec3,
    /// Velocity in m/s.
    pub velocity: DVec3,
    /// Angular velocity in rad/s.
    pub spin: DVec3,
}

impl Ball {
    /// A sphere at rest.
    pub fn at(kind: Kind, place: DVec3) -> Self {
        Self {
            kind,
            place,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
        }
    }
}

/// A scene in the making.
pub struct Bench<R: Rolling> {
    /// Law between spheres.
    pub law: HertzMindlin<R>,
    /// Law against the floor z = 0, if there is one.
    pub floor: Option<HertzMindlin<R>>,
    /// Gravity in m/s².
    pub gravity: DVec3,
    /// Integrator.
    pub scheme: Scheme,
    /// Step in s.
    pub dt: f64,
}

impl<R: Rolling> Bench<R> {
    /// The world with these spheres; the index is the identity.
    pub fn world<D: Layout>(&self, balls: &[Ball]) -> Lab<D, R> {
        let floor = self.floor.map(|law| Body {
            name: "floor".into(),
            surface: Arc::new(HalfSpace::<D>::new(
                D::from_space(DVec3::ZERO),
                D::from_space(DVec3::Z),
            )),
            law,
            touches_at: TouchesAt::Surface,
            removed_at: None,
            motion: Motion::default(),
            waits: false,
        });
        let mut world = World::new(Setup {
            kinds: ManyKinds(balls.iter().map(|ball| ball.kind).collect()),
            law: self.law,
            bodies: floor.into_iter().collect(),
            domain: Domain::open(),
            gravity: D::from_space(self.gravity),
            scheme: self.scheme,
            dt: self.dt,
            skin: None,
            lanes: Lanes::best(),
            pool: None,
            grains: balls
                .iter()
                .enumerate()
                .map(|(kind, ball)| Placed {
                    position: D::from_space(ball.place),
                    velocity: D::from_space(ball.velocity),
                    kind,
                })
                .collect(),
            gates: Vec::new(),
        });
        for (identity, ball) in (0..).zip(balls) {
            world.set_spin(identity, D::spin_from_space(ball.spin));
        }
        world
    }
}

/// The spheres as they are now, by identity.
pub fn seen<D: Layout, R: Rolling>(world: &Lab<D, R>) -> Vec<Ball> {
    let mut order: Vec<usize> = (0..world.len()).collect();
    order.sort_by_key(|&i| world.identity(i));
    let ball = |i: usize| Ball {
        kind: *world.kind(i),
        place: <D as Dim>::to_space(world.position(i)),
        velocity: D::to_space(world.velocity(i)),
        spin: D::spin_to_space(world.spin(i)),
    };
    order.into_iter().map(ball).collect()
}
