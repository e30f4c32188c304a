//! The conformance suite: what every contact law must do, whatever its formula.
//!
//! One line enrols a law, from this crate or from any other:
//!
//! ```
//! use tsubu_contact::testing::{Claims, conforms};
//! use tsubu_contact::{Repulsion, RepulsiveWall};
//! use tsubu_model::Kind;
//! let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
//! let (grain, larger) = (Kind::sphere(1.350e-3, 1370.0), Kind::sphere(2.7e-3, 1370.0));
//! conforms(&coke, &grain, &larger, Claims::default());
//! // Against a wall: the partner is `Kind::immovable()`, and the law says what it promises.
//! let wall = RepulsiveWall { grains: coke, restitution: Some(0.5), friction: 0.413 };
//! conforms(&wall, &grain, &Kind::immovable(), Claims::default().friction(0.413).never_pulls());
//! ```
//!
//! [`conforms`] tries a law in space and in the plane; [`conforms_in`] tries one of them, for a law
//! made for one only. Both panic with a report that names each failed [`Check`], the worst state
//! found and the numbers. [`breaches`] returns the same as values. What can be asked only of a law
//! that promises a restitution is apart: [`rebounds_with`].
//!
//! Every state is measured in the law's own scales (its range, its stiffness at 1 % overlap, the
//! reduced mass of the pair), so a law for sand in micrometres and one for boulders meet the same
//! suite. The states are fixed: a failure repeats.
//!
//! What is not tried: torque (the suite is for [`Still`] grains), overlaps above 5 % of the range
//! except where a collision goes there by itself.

mod energy;
mod parts;
mod reach;
mod rebound;
mod report;
mod slopes;
mod states;
mod symmetry;
mod units;

pub use rebound::{Rebound, SPEEDS, collide, rebounds_with};
pub use report::{Breach, Check};

use states::Case;
use tsubu_model::{Constants, ContactLaw, Dim, Kind, Plane, Space, Still};

/// What a law promises beyond what all laws must do.
/// The default: no friction, and the dashpot may pull while the grains part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Claims {
    friction: Option<f64>,
    tension: Tension,
}

/// Whether the normal force may pull.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Tension {
    #[default]
    Allowed,
    Never,
}

impl Claims {
    /// The law has Coulomb friction: its slip force never exceeds μ times its normal force.
    /// Without this claim the slip force must be zero.
    pub fn friction(self, coefficient: f64) -> Self {
        Self {
            friction: Some(coefficient),
            ..self
        }
    }

    /// The law never pulls: its normal force is never negative.
    pub fn never_pulls(self) -> Self {
        Self {
            tension: Tension::Never,
            ..self
        }
    }
}

/// Panics with a report unless the law passes every check, in space and in the plane.
/// `b` is [`Kind::immovable`] for a law between a grain and a wall.
#[track_caller]
pub fn conforms<L>(law: &L, a: &Kind, b: &Kind, claims: Claims)
where
    L: ContactLaw<Space, Still> + ContactLaw<Plane, Still> + Constants,
{
    conforms_in::<Space, L>(law, a, b, claims);
    conforms_in::<Plane, L>(law, a, b, claims);
}

/// As [`conforms`], in one dimension only: `conforms_in::<Plane, _>(&law, …)`.
#[track_caller]
pub fn conforms_in<D: Dim, L: ContactLaw<D, Still> + Constants>(
    law: &L,
    a: &Kind,
    b: &Kind,
    claims: Claims,
) {
    let found = breaches::<D, L>(law, a, b, claims);
    assert!(found.is_empty(), "{}", report::listing::<L, D>(&found));
}

/// Every check that the law fails, with the worst state of each; empty if it passes all.
pub fn breaches<D: Dim, L: ContactLaw<D, Still> + Constants>(
    law: &L,
    a: &Kind,
    b: &Kind,
    claims: Claims,
) -> Vec<Breach> {
    let case = match Case::new(law, a, b) {
        Ok(case) => case,
        Err(breach) => return vec![breach],
    };
    [
        reach::nothing_beyond(&case),
        reach::begins_gently(&case),
        symmetry::odd(&case),
        symmetry::turns(&case),
        parts::follows_potential(&case),
        parts::only_takes(&case),
        parts::within_coulomb(&case, claims.friction),
        parts::pushes(&case, claims.tension == Tension::Never),
        slopes::linear(&case),
        energy::closed_paths(&case),
        energy::collisions(&case),
        units::any_units(&case),
    ]
    .into_iter()
    .flatten()
    .collect()
}
