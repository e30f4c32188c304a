//! The law of a body as a value: a surface, or grains.

use crate::{RepulsionPair, RepulsiveWall, RepulsiveWallPair, WallGrains};
use tsubu_model::{Constants, ContactLaw, Dim, Kind, Linear, Push, Quantity, SpinState, Touch};

/// How grains feel a body. Bodies of one world share this type, each with its own value.
///
/// Each variant is the law it holds, with its formula and validity: [`RepulsiveWall`] and [`WallGrains`].
///
/// Source: `Sumitomo2024`, sections 5.3 and 4.
///
/// ```
/// use tsubu_contact::{BodyLaw, Repulsion, WallGrains};
/// use tsubu_model::{ContactLaw, Kind, Space, Still};
/// let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
/// let law = BodyLaw::Grains(WallGrains { grains: coke, radius: 0.225e-3 });
/// let grain = Kind::sphere(1.350e-3, 1370.0);
/// let pair = <BodyLaw as ContactLaw<Space, Still>>::pair(&law, &grain, &Kind::immovable());
/// // The range is the mean of the two: (1 + 1/3)/2 of 2^(1/6) σ.
/// let range = <BodyLaw as ContactLaw<Space, Still>>::range(&pair);
/// assert!((range / (2.0 / 3.0 * 1.3503e-3) - 1.0).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyLaw {
    /// A surface with restitution and friction.
    Surface(RepulsiveWall),
    /// Driven grains of the grains' material.
    Grains(WallGrains),
}

/// Constants of [`BodyLaw`] for one kind of grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyPair {
    /// Against a surface.
    Surface(RepulsiveWallPair),
    /// Against a wall grain.
    Grains(RepulsionPair),
}

impl<D: Dim, S: SpinState> ContactLaw<D, S> for BodyLaw {
    type Pair = BodyPair;
    type Memory = [f64; 0];

    fn pair(&self, grain: &Kind, wall: &Kind) -> BodyPair {
        match self {
            Self::Surface(law) => {
                let pair = <RepulsiveWall as ContactLaw<D, S>>::pair(law, grain, wall);
                BodyPair::Surface(pair)
            }
            Self::Grains(law) => {
                BodyPair::Grains(<WallGrains as ContactLaw<D, S>>::pair(law, grain, wall))
            }
        }
    }

    fn range(pair: &BodyPair) -> f64 {
        match pair {
            BodyPair::Surface(pair) => <RepulsiveWall as ContactLaw<D, S>>::range(pair),
            BodyPair::Grains(pair) => <WallGrains as ContactLaw<D, S>>::range(pair),
        }
    }

    #[inline(always)]
    fn force(pair: &BodyPair, touch: &Touch<D, S>, memory: &mut [f64; 0], dt: f64) -> Push<D, S> {
        match pair {
            BodyPair::Surface(pair) => {
                <RepulsiveWall as ContactLaw<D, S>>::force(pair, touch, memory, dt)
            }
            BodyPair::Grains(pair) => {
                <WallGrains as ContactLaw<D, S>>::force(pair, touch, memory, dt)
            }
        }
    }

    fn stored(pair: &BodyPair, touch: &Touch<D, S>, memory: &[f64; 0]) -> f64 {
        match pair {
            BodyPair::Surface(pair) => {
                <RepulsiveWall as ContactLaw<D, S>>::stored(pair, touch, memory)
            }
            BodyPair::Grains(pair) => <WallGrains as ContactLaw<D, S>>::stored(pair, touch, memory),
        }
    }

    fn linear(pair: &BodyPair, touch: &Touch<D, S>, dt: f64) -> Linear {
        match pair {
            BodyPair::Surface(pair) => <RepulsiveWall as ContactLaw<D, S>>::linear(pair, touch, dt),
            BodyPair::Grains(pair) => <WallGrains as ContactLaw<D, S>>::linear(pair, touch, dt),
        }
    }
}

impl Constants for BodyLaw {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        match self {
            Self::Surface(law) => law.constants(),
            Self::Grains(law) => law.constants(),
        }
    }

    fn mapped(&self, f: impl FnMut(Quantity, f64) -> f64) -> Self {
        match self {
            Self::Surface(law) => Self::Surface(law.mapped(f)),
            Self::Grains(law) => Self::Grains(law.mapped(f)),
        }
    }
}
