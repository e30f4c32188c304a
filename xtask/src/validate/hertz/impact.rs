//! One impact of a sphere on another, or on a wall, stepped by the engine.

use super::lab::{Ball, Bench, seen};
use glam::DVec3;
use tsubu_contact::{Freely, HertzMindlin};
use tsubu_integrate::Scheme;
use tsubu_model::{Kind, Space};

/// A sphere that falls along −z onto a partner at rest.
#[derive(Clone, Copy, Debug)]
pub struct Impact {
    /// Law of the contact.
    pub law: HertzMindlin,
    /// The sphere.
    pub ball: Kind,
    /// What it meets: another sphere, or the wall z = 0.
    pub partner: Option<Kind>,
    /// Velocity of the sphere in m/s; z < 0.
    pub velocity: DVec3,
    /// Spins of sphere and partner in rad/s.
    pub spins: [DVec3; 2],
    /// Integrator.
    pub scheme: Scheme,
    /// Step in s.
    pub dt: f64,
    /// Share of its step at which the first touch falls.
    pub phase: f64,
}

/// How it went.
#[derive(Clone, Debug)]
pub struct Rebound {
    /// Sphere and partner afterwards; without a partner the second is a copy of the wall's rest.
    pub after: [Ball; 2],
    /// Velocity of the sphere relative to the partner, in m/s.
    pub velocity: DVec3,
    /// Largest overlap in m.
    pub deepest: f64,
    /// Largest normal force in N.
    pub force: f64,
    /// From first touch to parting, in s.
    pub duration: f64,
    /// Steps that begin with an overlap.
    pub touching: u64,
    /// Energy of the motion relative to the centre of mass, after over before.
    pub energy: f64,
    /// Overlap in m and force in N at each step of the contact.
    pub path: Vec<(f64, f64)>,
}

impl Impact {
    /// An impact with so many steps to the duration `lasts` in s.
    pub fn new(law: HertzMindlin, ball: Kind, velocity: DVec3, lasts: f64, steps: f64) -> Self {
        Self {
            law,
            ball,
            partner: None,
            velocity,
            spins: [DVec3::ZERO; 2],
            scheme: Scheme::VerletOld,
            dt: lasts / steps,
            phase: 0.5,
        }
    }

    /// On this instead of on a wall.
    pub fn on(mut self, partner: Option<Kind>) -> Self {
        self.partner = partner;
        self
    }

    /// With these spins.
    pub fn spinning(mut self, ball: DVec3, partner: DVec3) -> Self {
        self.spins = [ball, partner];
        self
    }

    /// Runs it; `None` if the two do not part within 10⁷ steps.
    pub fn run(&self) -> Option<Rebound> {
        let range = self.ball.radius + self.partner.map_or(0.0, |kind| kind.radius);
        let place = DVec3::Z * range - self.velocity * (self.phase * self.dt);
        let mut balls = vec![Ball {
            velocity: self.velocity,
            spin: self.spins[0],
            ..Ball::at(self.ball, place)
        }];
        if let Some(kind) = self.partner {
            balls.push(Ball {
                spin: self.spins[1],
                ..Ball::at(kind, DVec3::ZERO)
            });
        }
        let bench = Bench::<Freely> {
            law: self.law,
            floor: self.partner.is_none().then_some(self.law),
            gravity: DVec3::ZERO,
            scheme: self.scheme,
            dt: self.dt,
        };
        let mut world = bench.world::<Space>(&balls);
        let overlap = |balls: &[Ball]| match balls {
            [a, b] => range - (a.place - b.place).length(),
            balls => range - balls[0].place.z,
        };
        let approach = |balls: &[Ball]| -> DVec3 {
            balls[0].velocity - balls.get(1).map_or(DVec3::ZERO, |b| b.velocity)
        };
        let light = self.partner.map_or(0.0, |kind| 1.0 / kind.mass);
        let mass = 1.0 / (1.0 / self.ball.mass + light);
        let (before, mut last) = (energy(&balls), balls);
        let (mut deepest, mut force, mut touching, mut path) = (0.0f64, 0.0f64, 0, Vec::new());
        for step in 1..10_000_000u64 {
            world.advance(1);
            let now = seen(&world);
            let (was, is) = (overlap(&last), overlap(&now));
            let push = mass * (approach(&now) - approach(&last)).length() / self.dt;
            if is > 0.0 {
                touching += 1;
                path.push((0.5 * (was + is), push));
            }
            deepest = deepest.max(is);
            force = force.max(push);
            if is <= 0.0 && was > 0.0 {
                let duration = (step as f64 - 1.0 - self.phase + was / (was - is)) * self.dt;
                let partner = now.get(1).copied();
                return Some(Rebound {
                    after: [
                        now[0],
                        partner.unwrap_or(Ball::at(now[0].kind, DVec3::ZERO)),
                    ],
                    velocity: approach(&now),
                    deepest,
                    force,
                    duration,
                    touching,
                    energy: energy(&now) / before,
                    path,
                });
            }
            last = now;
        }
        None
    }
}

/// ½ m* v² of the relative motion and ½ I ω² of both, in J.
fn energy(balls: &[Ball]) -> f64 {
    let turning: f64 = balls
        .iter()
        .map(|ball| 0.5 * ball.kind.inertia * ball.spin.length_squared())
        .sum();
    let relative = match balls {
        [a, b] => {
            let mass = a.kind.mass * b.kind.mass / (a.kind.mass + b.kind.mass);
            0.5 * mass * (a.velocity - b.velocity).length_squared()
        }
        balls => 0.5 * balls[0].kind.mass * balls[0].velocity.length_squared(),
    };
    turning + relative
}
