//! Paper A's law for a grain against a surface: the grains' repulsion, restitution, kinetic friction.

use crate::{Isotropic, Repulsion, RepulsionPair, restitution};
use tsubu_model::{
    Constants, ContactLaw, Dim, Kind, Linear, Push, Quantity, SpinState, Touch, Vector,
};

/// Grain against a surface.
///
/// ```text
/// N  = max(−φ'(s) − γw vn, 0)                   normal, never pulls
/// Ft = −min(μ N, m |vt|/Δt) vt/|vt|             kinetic friction, never reverses the slip within a step
/// γw = 2 ζ √(m k)                                ζ from the restitution asked for
/// ```
///
/// φ is the potential of the grains' own [`Repulsion`], m the grain's mass, s the distance from the
/// surface as the engine reads it (centre + d/2, or the centre alone). Because N is clamped, a
/// contact ends when the force vanishes, so ζ is taken from that end
/// ([`restitution::ratio_from_restitution`]): the restitution asked for is the one got. The relation
/// that the paper prints ends at zero overlap and would give 0.550 for 0.5 asked.
///
/// What it is *not*: there is no static friction; a grain at rest on a slope slides where μ < tan θ
/// and below that creeps at about g sin θ Δt. The cap looks at one contact: a grain that sticks to two
/// surfaces at once feels it twice.
///
/// Source: `Sumitomo2024`, section 5.3; restitution `Schwager2007`.
///
/// ```
/// use tsubu_contact::{Repulsion, RepulsiveWall};
/// use tsubu_model::{ContactLaw, Kind, Space, Still};
/// let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
/// let wall = RepulsiveWall { grains: coke, restitution: Some(0.5), friction: 0.413 };
/// let grain = Kind::sphere(1.350e-3, 1370.0);
/// let pair = <RepulsiveWall as ContactLaw<Space, Still>>::pair(&wall, &grain, &Kind::immovable());
/// assert!((pair.damping - 1.3091).abs() < 1e-3); // kg/s; the paper's printed relation gives 1.105
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepulsiveWall {
    /// The law of the grains, whose potential the wall shares.
    pub grains: Repulsion<Isotropic>,
    /// Restitution asked for; `None` is a wall without damping.
    pub restitution: Option<f64>,
    /// Coefficient of kinetic friction μ; 0 is a smooth wall.
    pub friction: f64,
}

/// Constants of [`RepulsiveWall`] for one kind of grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepulsiveWallPair {
    /// The potential.
    pub repulsion: RepulsionPair,
    /// γw in kg/s.
    pub damping: f64,
    /// μ.
    pub friction: f64,
    /// Mass of the grain in kg.
    pub mass: f64,
}

impl<D: Dim, S: SpinState> ContactLaw<D, S> for RepulsiveWall {
    type Pair = RepulsiveWallPair;
    type Memory = [f64; 0];

    fn pair(&self, grain: &Kind, _wall: &Kind) -> RepulsiveWallPair {
        let repulsion = <Repulsion as ContactLaw<D, S>>::pair(&self.grains, grain, grain);
        let stiffness = repulsion.stiffness(repulsion.range2 * (1.0 - 1e-15));
        let zeta = self
            .restitution
            .map_or(0.0, restitution::ratio_from_restitution);
        RepulsiveWallPair {
            repulsion,
            damping: 2.0 * zeta * (grain.mass * stiffness).sqrt(),
            friction: self.friction,
            mass: grain.mass,
        }
    }

    fn range(pair: &RepulsiveWallPair) -> f64 {
        pair.repulsion.range2.sqrt()
    }

    #[inline(always)]
    fn force(
        pair: &RepulsiveWallPair,
        touch: &Touch<D, S>,
        _memory: &mut [f64; 0],
        dt: f64,
    ) -> Push<D, S> {
        let touching = if touch.r2 < pair.repulsion.range2 {
            1.0
        } else {
            0.0
        };
        let r = touch.r();
        let normal = touch.apart * (1.0 / r);
        let elastic = pair.repulsion.push_over_r(touch.r2) * r * touching;
        let closing = touch.velocity.dot(normal);
        let pressed = (elastic - pair.damping * closing * touching).max(0.0);
        let sliding = touch.velocity - normal * closing;
        let slip = sliding.length();
        let drag = (pair.friction * pressed / slip.max(f64::MIN_POSITIVE)).min(pair.mass / dt);
        Push {
            elastic: normal * elastic,
            viscous: normal * (pressed - elastic),
            slip: sliding * -drag,
            twist: Default::default(),
            couple: Default::default(),
        }
    }

    fn stored(pair: &RepulsiveWallPair, touch: &Touch<D, S>, _memory: &[f64; 0]) -> f64 {
        pair.repulsion.potential(touch.r2)
    }

    fn linear(pair: &RepulsiveWallPair, touch: &Touch<D, S>, dt: f64) -> Linear {
        if touch.r2 >= pair.repulsion.range2 {
            return Linear::default();
        }
        let push = <Self as ContactLaw<D, S>>::force(pair, touch, &mut [], dt);
        let normal = touch.normal();
        let pressed = (push.elastic + push.viscous).dot(normal);
        let slip = (touch.velocity - normal * touch.velocity.dot(normal)).length();
        Linear {
            normal_stiffness: pair.repulsion.stiffness(touch.r2),
            tangential_stiffness: 0.0,
            normal_damping: pair.damping,
            // Friction as the dashpot that gives the same force at this slip.
            tangential_damping: (pair.friction * pressed / slip.max(f64::MIN_POSITIVE))
                .min(pair.mass / dt),
        }
    }
}

impl Constants for RepulsiveWall {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        let mut all = self.grains.constants();
        all.extend(
            self.restitution
                .map(|e| ("restitution", Quantity::Restitution, e)),
        );
        all.push(("friction", Quantity::Number, self.friction));
        all
    }

    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            grains: self.grains.mapped(&mut f),
            restitution: self.restitution.map(|e| f(Quantity::Restitution, e)),
            friction: f(Quantity::Number, self.friction),
        }
    }
}
