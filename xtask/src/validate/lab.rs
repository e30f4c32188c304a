//! A bench for few grains: what most checks share of building a world.

use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{PerDirection, Repulsion, RepulsiveWall};
use tsubu_engine::{Body, Lanes, NoTally, OneKind, Placed, Setup, TouchesAt, WithTally, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Motion, Space, Still, Surface};
use tsubu_sdf::HalfSpace;

/// Grains of one kind that repel and damp.
pub type Dry = World<Space, Still, OneKind, Repulsion, RepulsiveWall, NoTally>;
/// The same with the work of damping and friction summed.
pub type Tallied = World<Space, Still, OneKind, Repulsion, RepulsiveWall, WithTally>;
/// Grains whose damping differs along and across the contact.
pub type Directed = World<Space, Still, OneKind, Repulsion<PerDirection>, RepulsiveWall, NoTally>;

/// A scene in the making.
#[derive(Clone)]
pub struct Lab {
    /// The grain.
    pub kind: Kind,
    /// The law between grains.
    pub law: Repulsion,
    /// Planes (a point, the outward direction) with their laws.
    pub walls: Vec<(DVec3, DVec3, RepulsiveWall)>,
    /// Bodies of any other surface, after the planes.
    pub surfaces: Vec<(Arc<dyn Surface<Space>>, Motion, RepulsiveWall)>,
    /// Periods in m; infinite = open.
    pub period: DVec3,
    /// Gravity in m/s².
    pub gravity: DVec3,
    /// Integrator.
    pub scheme: Scheme,
    /// Step in s.
    pub dt: f64,
    /// Vector path.
    pub lanes: Lanes,
    /// Threads, or none.
    pub pool: Option<Arc<rayon::ThreadPool>>,
    /// Positions and velocities.
    pub grains: Vec<(DVec3, DVec3)>,
}

impl Lab {
    /// Grains in open space without weight.
    pub fn new(kind: Kind, law: Repulsion, scheme: Scheme, dt: f64) -> Self {
        Self {
            kind,
            law,
            walls: Vec::new(),
            surfaces: Vec::new(),
            period: DVec3::INFINITY,
            gravity: DVec3::ZERO,
            scheme,
            dt,
            lanes: Lanes::best(),
            pool: None,
            grains: Vec::new(),
        }
    }

    /// With a plane through `point`.
    pub fn wall(
        mut self,
        point: DVec3,
        outward: DVec3,
        restitution: Option<f64>,
        friction: f64,
    ) -> Self {
        self.walls.push((
            point,
            outward,
            RepulsiveWall {
                grains: self.law,
                restitution,
                friction,
            },
        ));
        self
    }

    /// With a body of any surface.
    pub fn body(
        mut self,
        surface: Arc<dyn Surface<Space>>,
        motion: Motion,
        restitution: Option<f64>,
        friction: f64,
    ) -> Self {
        let grains = self.law;
        let law = RepulsiveWall {
            grains,
            restitution,
            friction,
        };
        self.surfaces.push((surface, motion, law));
        self
    }

    /// With a grain.
    pub fn grain(mut self, position: DVec3, velocity: DVec3) -> Self {
        self.grains.push((position, velocity));
        self
    }

    fn setup<K, L>(self, kinds: K, law: L) -> Setup<Space, K, L, RepulsiveWall> {
        let plane = |(point, outward, law)| -> (Arc<dyn Surface<Space>>, Motion, RepulsiveWall) {
            let surface = HalfSpace::<Space>::new(point, outward);
            (Arc::new(surface), Motion::default(), law)
        };
        let body = |(number, (surface, motion, law))| Body {
            name: format!("wall {number}"),
            surface,
            law,
            touches_at: TouchesAt::Surface,
            removed_at: None,
            motion,
            waits: false,
        };
        let planes = self.walls.into_iter().map(plane);
        let bodies = planes.chain(self.surfaces).enumerate().map(body).collect();
        Setup {
            kinds,
            law,
            bodies,
            domain: Domain {
                period: self.period,
            },
            gravity: self.gravity,
            scheme: self.scheme,
            dt: self.dt,
            skin: None,
            lanes: self.lanes,
            pool: self.pool,
            grains: self
                .grains
                .into_iter()
                .map(|(position, velocity)| Placed {
                    position,
                    velocity,
                    kind: 0,
                })
                .collect(),
            gates: Vec::new(),
        }
    }

    /// The world.
    pub fn world(self) -> Dry {
        let (kind, law) = (self.kind, self.law);
        World::new(self.setup(OneKind([kind]), law))
    }

    /// The world with its tally.
    pub fn tallied(self) -> Tallied {
        let (kind, law) = (self.kind, self.law);
        World::new(self.setup(OneKind([kind]), law))
    }

    /// The world with damping along the contact only.
    pub fn without_tangential_damping(self) -> Directed {
        let (kind, law) = (self.kind, self.law.softened(1.0, 1.0, 0.0).per_direction());
        World::new(self.setup(OneKind([kind]), law))
    }
}

/// Name of a scheme, with the sweeps of its solve if it has one.
pub fn name(scheme: Scheme) -> String {
    match scheme.sweeps() {
        0 => scheme.name().into(),
        sweeps => format!("{}({sweeps})", scheme.name()),
    }
}

/// Numbers in 0…1 from a counter: the same on every machine.
pub struct Draw(pub u64);

impl Draw {
    /// The next number.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A normal deviate, by Box and Muller.
    pub fn normal(&mut self) -> f64 {
        let (a, b) = (1.0 - self.next(), self.next());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}
