//! The conformance suite: what every contact law must do, whatever its formula.
//!
//! One line enrols a law, from this crate or from any other:
//!
//! ```
//! use tsubu_contact::testing::{Claims, conforms, conforms_spinning};
//! use tsubu_contact::{Repulsion, RepulsiveWall, SpringDashpot};
//! use tsubu_model::Kind;
//! let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
//! let (grain, larger) = (Kind::sphere(1.350e-3, 1370.0), Kind::sphere(2.7e-3, 1370.0));
//! conforms(&coke, &grain, &larger, Claims::default());
//! // Against a wall: the partner is `Kind::immovable()`, and the law says what it promises.
//! let wall = RepulsiveWall { grains: coke, restitution: Some(0.5), friction: 0.413 };
//! conforms(&wall, &grain, &Kind::immovable(), Claims::default().friction(0.413).never_pulls());
//! // Grains that turn, contacts that remember.
//! let law = SpringDashpot::from_restitution(1.0e4, 0.7, 0.5 * grain.mass, 0.3, 0.577);
//! conforms_spinning(&law, &grain, &larger, Claims::default().friction(0.577).never_pulls());
//! ```
//!
//! [`conforms`] tries a law of [`Still`] grains in space and in the plane, [`conforms_spinning`] one of grains that
//! turn; [`conforms_in`] and [`conforms_spinning_in`] try one dimension, for a law made for one only. All
//! panic with a report that names each failed [`Check`], the worst state found and the numbers. [`breaches`] and
//! [`breaches_spinning`] return the same as values. What can be asked only of a law that promises a restitution is
//! apart: [`rebounds_with`], [`rebounds_spinning_with`].
//!
//! Every state is measured in the law's own scales (its range, its stiffness at 1 % overlap, the
//! reduced mass of the pair), so a law for sand in micrometres and one for boulders meet the same
//! suite. A law that remembers is tried in contacts that have just begun, and driven along short histories: pressed, rubbed
//! and parted. States and histories are fixed: a failure repeats.
//!
//! What is not tried: overlaps above 5 % of the range except where a collision goes there by itself; more than one
//! contact at a time, and so whether a step is stable for a packing.

mod energy;
mod history;
mod momentum;
mod parts;
mod reach;
mod rebound;
mod report;
mod rolling;
mod slopes;
mod states;
mod stretch;
mod symmetry;
mod units;

pub use rebound::{
    Rebound, SPEEDS, collide, collide_spinning, rebounds_spinning_with, rebounds_with,
};
pub use report::{Breach, Check};

use states::Case;
use tsubu_model::{Constants, ContactLaw, Dim, Kind, Plane, Space, SpinState, Spins, Still};

/// What a law promises beyond what all laws must do.
/// The default: no friction, and the dashpot may pull while the grains part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Claims {
    friction: Option<Friction>,
    tension: Tension,
}

/// Coulomb's μ, and what the normal force is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Friction {
    coefficient: f64,
    of: Of,
}

/// The normal force that limits friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Of {
    /// All of it.
    Normal,
    /// That of the spring.
    Spring,
}

/// Whether the normal force may pull.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Tension {
    #[default]
    Allowed,
    Never,
}

impl Claims {
    /// The law has Coulomb friction: its slip force, and of grains that turn its whole tangential force, never exceeds μ times
    /// its normal force. Without a claim of friction the slip force must be zero.
    pub fn friction(self, coefficient: f64) -> Self {
        self.limited(coefficient, Of::Normal)
    }

    /// The law has friction of its springs alone: its slip force and the elastic part of its tangential force never exceed μ
    /// times the elastic part of its normal force, and the tangential dashpot has no limit.
    pub fn friction_of_springs(self, coefficient: f64) -> Self {
        self.limited(coefficient, Of::Spring)
    }

    fn limited(self, coefficient: f64, of: Of) -> Self {
        Self {
            friction: Some(Friction { coefficient, of }),
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

/// As [`conforms`], for a law of grains that turn.
#[track_caller]
pub fn conforms_spinning<L>(law: &L, a: &Kind, b: &Kind, claims: Claims)
where
    L: ContactLaw<Space, Spins> + ContactLaw<Plane, Spins> + Constants,
{
    conforms_spinning_in::<Space, L>(law, a, b, claims);
    conforms_spinning_in::<Plane, L>(law, a, b, claims);
}

/// As [`conforms_spinning`], in one dimension only.
#[track_caller]
pub fn conforms_spinning_in<D: Dim, L: ContactLaw<D, Spins> + Constants>(
    law: &L,
    a: &Kind,
    b: &Kind,
    claims: Claims,
) {
    let found = breaches_spinning::<D, L>(law, a, b, claims);
    assert!(found.is_empty(), "{}", report::listing::<L, D>(&found));
}

/// Every check that the law fails, with the worst state of each; empty if it passes all.
pub fn breaches<D: Dim, L: ContactLaw<D, Still> + Constants>(
    law: &L,
    a: &Kind,
    b: &Kind,
    claims: Claims,
) -> Vec<Breach> {
    tried::<D, Still, L>(law, a, b, claims)
}

/// As [`breaches`], for a law of grains that turn.
pub fn breaches_spinning<D: Dim, L: ContactLaw<D, Spins> + Constants>(
    law: &L,
    a: &Kind,
    b: &Kind,
    claims: Claims,
) -> Vec<Breach> {
    tried::<D, Spins, L>(law, a, b, claims)
}

fn tried<D: Dim, S: SpinState, L: ContactLaw<D, S> + Constants>(
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
        parts::follows_potential(&case, claims.friction),
        parts::only_takes(&case),
        parts::within_coulomb(&case, claims.friction),
        parts::pushes(&case, claims.tension == Tension::Never),
        slopes::linear(&case, claims.friction),
        rolling::twists(&case),
        rolling::rolls(&case),
        stretch::never_overstretched(&case, claims.friction),
        energy::closed_paths(&case),
        energy::collisions(&case),
        momentum::kept(&case),
        units::any_units(&case),
    ]
    .into_iter()
    .flatten()
    .collect()
}
