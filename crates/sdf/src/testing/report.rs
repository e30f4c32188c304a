//! What the suite says of a surface that fails: the check, the worst point, the numbers.

use std::fmt;

/// A check of the suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Check {
    /// Distances and bounds are finite and normals have length one, at special points too.
    Finite,
    /// No hit is as far away as the reach or farther.
    Reach,
    /// A point nearer than its reach has its nearest hit, whatever the reach.
    Found,
    /// Many points at once give what each gives alone, after what the buffer held before.
    Batch,
    /// The distance never changes by more than the way gone.
    Lipschitz,
    /// The lower bound is not above the distance.
    Bound,
    /// Within the room that a surface grants there is no hit.
    Room,
    /// The distance is negative inside the body and only there (only with an oracle).
    Sign,
    /// Away from creases the normal is the gradient of the distance.
    Gradient,
    /// The point at −distance along the normal lies on the surface.
    Foot,
    /// Concave places have as many hits as stated.
    Expected,
    /// Bounds hold the surface, corners of the shell lie on it, the outline stays in its box.
    Drawing,
}

impl Check {
    /// What the check asks, as a sentence.
    pub fn asks(self) -> &'static str {
        match self {
            Self::Finite => "every number is finite and normals have length 1",
            Self::Reach => "no hit at the reach or beyond",
            Self::Found => "the nearest hit is found whenever it is within reach",
            Self::Batch => "many points at once give what each gives alone",
            Self::Lipschitz => "the distance changes by at most the way gone",
            Self::Bound => "`lower_bound` is not above the distance",
            Self::Room => "no hit is nearer than `room` says",
            Self::Sign => "the distance is negative inside and only there",
            Self::Gradient => "the normal is the gradient of the distance",
            Self::Foot => "x − normal·distance lies on the surface",
            Self::Expected => "as many hits as stated",
            Self::Drawing => "bounds, shell and outline belong to the surface",
        }
    }
}

/// A check that failed, at the point where it failed worst.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// Which check.
    pub check: Check,
    /// By how many tolerances it failed.
    pub excess: f64,
    /// The point and the numbers.
    pub found: String,
}

/// What the suite found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// How many points were tried.
    pub points: usize,
    /// The checks that failed.
    pub breaches: Vec<Breach>,
    /// For every check the largest error as a share of its tolerance, and how often it was asked.
    pub worst: Vec<(Check, f64, usize)>,
}

impl Report {
    pub(super) fn of<const N: usize>(points: usize, checks: [Worst; N]) -> Self {
        Self {
            points,
            worst: checks
                .iter()
                .map(|w| (w.check, w.excess, w.asked))
                .collect(),
            breaches: checks.into_iter().filter_map(Worst::breach).collect(),
        }
    }

    /// True if this check failed.
    pub fn fails(&self, check: Check) -> bool {
        self.breaches.iter().any(|b| b.check == check)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the surface fails {} of the conformance checks at {} points",
            self.breaches.len(),
            self.points
        )?;
        for Breach {
            check,
            excess,
            found,
        } in &self.breaches
        {
            write!(f, "\n  {check:?}: {}\n    {found}", check.asks())?;
            if excess.is_finite() {
                write!(f, "\n    {excess:.3e} times the tolerance")?;
            }
        }
        Ok(())
    }
}

/// Keeps the worst point of one check.
pub(super) struct Worst {
    check: Check,
    excess: f64,
    found: String,
    asked: usize,
}

impl Worst {
    pub(super) fn of(check: Check) -> Self {
        Self {
            check,
            excess: 0.0,
            found: String::new(),
            asked: 0,
        }
    }

    /// One comparison: `error` against `tolerance`. Not a number counts as infinitely wrong.
    pub(super) fn see(&mut self, error: f64, tolerance: f64, found: impl FnOnce() -> String) {
        self.asked += 1;
        let excess = match error / tolerance {
            _ if error <= 0.0 => 0.0,
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

    /// How many comparisons were made.
    pub(super) fn asked(&self) -> usize {
        self.asked
    }

    fn breach(self) -> Option<Breach> {
        (self.excess > 1.0).then_some(Breach {
            check: self.check,
            excess: self.excess,
            found: self.found,
        })
    }
}
