//! A grain against a wall that is built of grains: the grains' own law, the partner driven.

use crate::{PerDirection, Repulsion, RepulsionPair};
use tsubu_model::{Constants, ContactLaw, Dim, Kind, Linear, Push, Quantity, SpinState, Touch};

/// Grain against one wall grain of infinite mass.
///
/// ```text
/// F = −φ'(r) n − γn vn − γt vt      r the distance of the two centres, v the velocity against the wall grain's centre
/// ```
///
/// The law is the grains' [`Repulsion`]; the wall grain is of the grains' own material at its radius
/// rs. With q = rs/rp, rp the grain's radius, its σ is q times, its k q times, its γ q² times the
/// grain's, and the two mix as [`Repulsion::mixed`] says (a choice; the paper is silent).
/// At q = 1 the contact is that of two equal grains.
///
/// `s` of the engine's touch is r, so a body of such grains reports distances from their surfaces and
/// the engine adds rs. One grain may touch many of them at once.
///
/// What it is *not*: there is no restitution and no friction to choose. What a grain feels of the
/// wall's material is γ and the bumps between wall grains. As among grains, the dashpot may pull
/// while two part.
///
/// Source: `Sumitomo2024`, sections 2.1 and 4.
///
/// ```
/// use tsubu_contact::{Repulsion, WallGrains};
/// use tsubu_model::{ContactLaw, Kind, Space, Still};
/// let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
/// let wall = WallGrains { grains: coke, radius: 0.675e-3 };
/// let grain = Kind::sphere(1.350e-3, 1370.0);
/// let pair = <WallGrains as ContactLaw<Space, Still>>::pair(&wall, &grain, &Kind::immovable());
/// assert_eq!(pair, <Repulsion as ContactLaw<Space, Still>>::pair(&coke, &grain, &grain));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallGrains {
    /// The law of the grains. γn and γt act each in its direction.
    pub grains: Repulsion,
    /// Radius of a wall grain rs in m.
    pub radius: f64,
}

impl<D: Dim, S: SpinState> ContactLaw<D, S> for WallGrains {
    type Pair = RepulsionPair;
    type Memory = [f64; 0];

    /// The wall grain's size is the law's; the second kind says nothing.
    fn pair(&self, grain: &Kind, _wall: &Kind) -> RepulsionPair {
        let grains = self.grains.at_diameter(grain.diameter());
        grains.mixed(&self.grains.at_diameter(2.0 * self.radius))
    }

    fn range(pair: &RepulsionPair) -> f64 {
        <Repulsion as ContactLaw<D, S>>::range(pair)
    }

    #[inline(always)]
    fn force(
        pair: &RepulsionPair,
        touch: &Touch<D, S>,
        memory: &mut [f64; 0],
        dt: f64,
    ) -> Push<D, S> {
        <Repulsion<PerDirection> as ContactLaw<D, S>>::force(pair, touch, memory, dt)
    }

    fn stored(pair: &RepulsionPair, touch: &Touch<D, S>, _memory: &[f64; 0]) -> f64 {
        pair.potential(touch.r2)
    }

    fn linear(pair: &RepulsionPair, touch: &Touch<D, S>, dt: f64) -> Linear {
        <Repulsion<PerDirection> as ContactLaw<D, S>>::linear(pair, touch, dt)
    }
}

impl Constants for WallGrains {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        let mut all = self.grains.constants();
        all.push(("wall_radius", Quantity::Length, self.radius));
        all
    }

    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            grains: self.grains.mapped(&mut f),
            radius: f(Quantity::Length, self.radius),
        }
    }
}
