//! What the suite says of a law that fails: the check, the worst state, the numbers.

use std::fmt;

/// A check of the suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Check {
    /// Range and stiffness are finite and positive, so that the suite has scales to work in.
    Scales,
    /// Force, twist, stored energy, linearisation and what is remembered are exactly zero at and beyond the
    /// range and for a far-away dummy, whatever the contact remembered.
    Range,
    /// The force of resting grains starts from zero at the range.
    Rest,
    /// Exchanging the two grains negates the force to the bit, and leaves twist and memory as they are.
    Odd,
    /// Turning the pair, or looking at it in a mirror, turns the force and changes nothing else.
    Turning,
    /// The elastic force is the negative gradient of the stored energy; with memory, what is stored is the
    /// work that was put in.
    Potential,
    /// The viscous force never drives the motion; nor does slip without memory.
    Dashpot,
    /// The slip force (of grains that turn the whole tangential force) is at most μ times the normal force; zero
    /// without friction.
    Coulomb,
    /// The normal force never pulls (only if claimed).
    Tension,
    /// The linearisation is the slope of the force.
    Linear,
    /// No energy is gained over a closed path.
    Loop,
    /// No energy is gained in a collision, grazing impact included.
    Collision,
    /// The force is the same in any units.
    Units,
    /// The torque is that of the tangential force at the contact.
    Twist,
    /// No tangential force on grains that roll without slip, or turn as one body.
    Rolling,
    /// The tangential spring is never stretched further than friction can hold.
    Stretch,
    /// Momentum is kept, and angular momentum up to the overlap.
    Momentum,
}

impl Check {
    /// What the check asks, as a sentence.
    pub fn asks(self) -> &'static str {
        match self {
            Self::Scales => "range and stiffness are finite and positive",
            Self::Range => "exactly no force, energy, stiffness or memory at and beyond the range",
            Self::Rest => "no force at the range and rest",
            Self::Odd => "exchanging the grains negates the force to the bit",
            Self::Turning => "turning the pair turns the force and nothing else",
            Self::Potential => "the elastic force is −d(stored)/dx",
            Self::Dashpot => "the viscous force only takes energy",
            Self::Coulomb => "the slip force is at most μ times the normal force",
            Self::Tension => "the normal force never pulls",
            Self::Linear => "`linear` is the slope of the force",
            Self::Loop => "no energy is gained over a closed path",
            Self::Collision => "no energy is gained in a collision",
            Self::Units => "the same force in any units",
            Self::Twist => "twist = −n × force",
            Self::Rolling => "what rolls without slip is not rubbed",
            Self::Stretch => "the tangential spring is no longer than friction can hold",
            Self::Momentum => "momentum and angular momentum are kept",
        }
    }
}

/// A check that failed, at the state where it failed worst.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// Which check.
    pub check: Check,
    /// By how many tolerances it failed.
    pub excess: f64,
    /// The state and the numbers.
    pub found: String,
}

impl fmt::Display for Breach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            check,
            excess,
            found,
        } = self;
        write!(f, "{check:?}: {}\n    {found}", check.asks())?;
        if excess.is_finite() {
            write!(f, "\n    {excess:.3e} times the tolerance")?;
        }
        Ok(())
    }
}

/// All breaches of a law as one text.
pub(super) fn listing<L, D>(found: &[Breach]) -> String {
    let law = std::any::type_name::<L>();
    let dim = std::any::type_name::<D>().rsplit("::").next().unwrap_or("");
    let each = found
        .iter()
        .map(|breach| format!("\n  {breach}"))
        .collect::<String>();
    format!(
        "{law} in {dim} fails {} of the conformance checks{each}",
        found.len()
    )
}

/// Keeps the worst state of one check.
pub(super) struct Worst {
    check: Check,
    excess: f64,
    found: String,
}

impl Worst {
    pub(super) fn of(check: Check) -> Self {
        Self {
            check,
            excess: 0.0,
            found: String::new(),
        }
    }

    /// One comparison: `error` against `tolerance`. Not a number counts as infinitely wrong.
    pub(super) fn see(&mut self, error: f64, tolerance: f64, found: impl FnOnce() -> String) {
        let excess = match error / tolerance {
            _ if error == 0.0 => 0.0,
            ratio if ratio.is_nan() => f64::INFINITY,
            ratio => ratio,
        };
        if excess > self.excess {
            self.excess = excess;
            self.found = found();
        }
    }

    /// Something that holds or does not.
    pub(super) fn demand(&mut self, holds: bool, found: impl FnOnce() -> String) {
        self.see(if holds { 0.0 } else { f64::INFINITY }, 1.0, found);
    }

    /// The breach, if any state went beyond its tolerance.
    pub(super) fn breach(self) -> Option<Breach> {
        let Self {
            check,
            excess,
            found,
        } = self;
        (excess > 1.0).then_some(Breach {
            check,
            excess,
            found,
        })
    }
}
