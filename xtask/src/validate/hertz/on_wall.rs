//! A sphere that meets a rigid wall obliquely, by the engine and by the plain integration.

use super::impact::{Impact, Rebound};
use super::theory::{Hertz, Material, NoSlip, Spring};
use glam::DVec3;
use tsubu_contact::restitution::ratio_from_restitution;
use tsubu_contact::{Elastic, HertzMindlin};

const STEPS: f64 = 10_000.0;

/// A sphere that meets a rigid wall.
pub struct OnWall {
    pub material: Material,
    /// In m.
    pub radius: f64,
    pub restitution: f64,
    pub friction: f64,
}

impl OnWall {
    /// At these speeds along and into the wall, turning at `spin` about y.
    pub fn impact(&self, along: f64, into: f64, spin: f64) -> Option<Rebound> {
        let ball = self.material.sphere(self.radius);
        let (own, wall) = (&self.material.elastic, Elastic::RIGID);
        let law = HertzMindlin::between(own, &wall, self.restitution, self.friction);
        let lasts = Hertz::of((&ball, own), (None, &wall)).duration(into);
        Impact::new(law, ball, DVec3::new(along, 0.0, -into), lasts, STEPS)
            .spinning(DVec3::Y * spin, DVec3::ZERO)
            .run()
    }

    /// The same as a plain integration.
    pub fn integrated(&self, spring: Spring, share: f64) -> NoSlip {
        NoSlip {
            poisson: self.material.elastic.poisson,
            damping: ratio_from_restitution(self.restitution),
            friction: self.friction,
            spring,
            share,
        }
    }
}

/// Speed along x of the sphere's surface over that of its partner where they touch; a wall does not turn.
pub fn slip(rebound: &Rebound) -> f64 {
    let turning = rebound.after.map(|ball| ball.kind.radius * ball.spin.y);
    rebound.velocity.x - turning[0] - turning[1]
}
