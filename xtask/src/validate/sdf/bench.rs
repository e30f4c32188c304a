//! One grain and one surface: paper A's coke at n = 3 and a hundredth of its modulus, thrown or laid down.

use super::shapes::Shared;
use crate::validate::lab::Lab;
use crate::validate::wca::{GAMMA, Wca, coke, grain};
use glam::DVec3;
use tsubu_coarsen::{Level, Renormalised, coarsen};
use tsubu_contact::Repulsion;
use tsubu_contact::restitution::ratio_from_restitution;
use tsubu_integrate::Scheme;
use tsubu_model::{Kind, Motion, View};

/// Standard gravity in m/s².
pub const GRAVITY: f64 = 9.80665;
/// μ of the paper.
pub const FRICTION: f64 = 0.413;
/// e of the paper.
pub const RESTITUTION: f64 = 0.5;
/// Second order in the step, for comparisons. A sweep of the solve leaves a third of the damping's error
/// where friction holds a grain, see [`rebound`](super::rebound); eight leave 3e-5 of e.
pub const EXACT: Scheme = Scheme::VerletAveraged { sweeps: 8 };
/// What a scene takes that names none.
pub const USUAL: Scheme = Scheme::SymplecticEuler;
/// Steps of a contact's undamped period that a run takes.
pub const USUAL_STEPS: f64 = 20.0;

/// The grain and its law.
#[derive(Clone, Copy)]
pub struct Bench {
    /// d = 10.8 mm.
    pub kind: Kind,
    /// k = E d/100.
    pub law: Repulsion,
    /// Integrator.
    pub scheme: Scheme,
}

impl Bench {
    /// The grain of the suite. E/100 makes the contact of 1 m/s half a percent of d deep, and the step
    /// of a run 17 µs.
    pub fn new() -> Result<Self, String> {
        Self::softened(100.0)
    }

    /// The grain as a run steps it.
    pub fn as_run() -> Result<Self, String> {
        Ok(Self {
            scheme: USUAL,
            ..Self::new()?
        })
    }

    /// The grain with its modulus divided by `soften`.
    pub fn softened(soften: f64) -> Result<Self, String> {
        let refused = |e: tsubu_coarsen::TooCoarse| e.to_string();
        let (level, soft) = (Level::new(3), coke(GAMMA).softened(soften, 1.0, 1.0));
        Ok(Self {
            kind: coarsen(&Renormalised, &grain(), level).map_err(refused)?,
            law: coarsen(&Renormalised, &soft, level).map_err(refused)?,
            scheme: EXACT,
        })
    }

    /// Distance of the centre from a surface at which contact begins, in m.
    pub fn touch(&self) -> f64 {
        Wca::of(&self.law).range() - self.kind.radius
    }

    /// Undamped period against a wall, in s.
    pub fn period(&self) -> f64 {
        Wca::of(&self.law).period(self.kind.mass)
    }

    /// How much nearer than `touch` a grain lies that is pressed on with `force` N, in m.
    pub fn overlap_under(&self, force: f64) -> f64 {
        let wca = Wca::of(&self.law);
        wca.range() - wca.at_rest_under(force)
    }

    /// Restitution of the paper's wall at a closing speed in m/s by fine integration of the potential, which
    /// stiffens with the overlap: 0.5 asked is 0.500 for a shallow contact and 0.505 for one of half a percent.
    pub fn restitution_at(&self, closing: f64) -> f64 {
        let wca = Wca::of(&self.law);
        let zeta = ratio_from_restitution(RESTITUTION);
        let damping = 2.0 * zeta * (self.kind.mass * wca.edge_stiffness()).sqrt();
        wca.restitution_without_pull(self.kind.mass, damping, closing)
    }

    /// A lab with this surface.
    pub fn lab(&self, surface: &Shared, motion: Motion, e: f64, friction: f64, dt: f64) -> Lab {
        let lab = Lab::new(self.kind, self.law, self.scheme, dt);
        lab.body(surface.clone(), motion, Some(e), friction)
    }
}

/// A grain in flight towards a surface.
#[derive(Clone)]
pub struct Throw {
    /// Where it would first touch the true surface.
    pub contact: DVec3,
    /// The normal there.
    pub normal: DVec3,
    /// Velocity relative to the wall, in m/s.
    pub velocity: DVec3,
    /// Distance along the normal at which the flight begins and ends, in m.
    pub gap: f64,
    /// Restitution of the wall.
    pub restitution: f64,
    /// Friction of the wall.
    pub friction: f64,
    /// Steps per period.
    pub steps: f64,
    /// True if the grain may pass by: then it is seen off two diameters further.
    pub may_miss: bool,
    /// How the wall moves; the grain moves along.
    pub motion: Motion,
    /// Velocity of the wall in m/s.
    pub carried: DVec3,
}

impl Throw {
    /// With the paper's wall, at rest.
    pub fn new(contact: DVec3, normal: DVec3, velocity: DVec3) -> Self {
        Self {
            contact,
            normal,
            velocity,
            gap: 6e-5,
            restitution: RESTITUTION,
            friction: FRICTION,
            steps: 1000.0,
            may_miss: false,
            motion: Motion::default(),
            carried: DVec3::ZERO,
        }
    }

    /// Velocity relative to the wall after the impact, or `None` if the grain does not come back.
    pub fn at(&self, bench: &Bench, surface: &Shared) -> Option<DVec3> {
        let dt = bench.period() / self.steps;
        let closing = -self.velocity.dot(self.normal);
        let start = self.contact - self.velocity * (self.gap / closing);
        let motion = self.motion.clone();
        let lab = bench.lab(surface, motion, self.restitution, self.friction, dt);
        let mut world = lab.grain(start, self.velocity + self.carried).world();
        for _ in 0..10_000_000_u64 {
            world.advance(1);
            let v = world.velocity(0) - self.carried;
            let apart = world.position(0) - self.contact - self.carried * world.now();
            // A bent surface falls back by s²/2R along the way, so half the gap is enough.
            if v.dot(self.normal) > 0.0 && apart.dot(self.normal) >= 0.5 * self.gap {
                return Some(v);
            }
            if apart.length() > 4.0 * bench.kind.radius {
                return self.may_miss.then_some(v);
            }
            if !world.health().is_fine() {
                break;
            }
        }
        None
    }
}

/// The rigid impact with restitution e and friction μ: the normal velocity turns round as −e, the tangential
/// one loses μ(1 + e) of the normal one but never reverses.
pub fn impulse(velocity: DVec3, normal: DVec3, e: f64, friction: f64) -> DVec3 {
    let closing = -velocity.dot(normal);
    let slip = velocity + normal * closing;
    let left = (slip.length() - friction * (1.0 + e) * closing).max(0.0);
    normal * (e * closing) + slip.normalize_or_zero() * left
}
