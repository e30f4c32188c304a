//! What a coarse-graining rule is, and its application to anything that lists its constants.

use crate::Level;
use std::fmt;
use tsubu_model::{Constants, Quantity};

/// A rule of coarse-graining: what a grain's constants become when its diameter grows by λ.
///
/// λ need not be a power of two, and 1/λ undoes λ.
pub trait CoarseRule {
    /// Its name in a scene and in a report.
    fn name(&self) -> &'static str;
    /// Keys of its sources in `docs/literature.bib`, separated by commas.
    fn source(&self) -> &'static str;
    /// The constant after coarsening by λ. Not a number at or beyond [`limit`](CoarseRule::limit).
    fn scale(&self, quantity: Quantity, value: f64, lambda: f64) -> f64;
    /// The largest time step over that of the real grain.
    fn step_factor(&self, lambda: f64) -> f64;
    /// λ that this constant cannot reach; infinite where there is no such limit.
    fn limit(&self, _quantity: Quantity, _value: f64) -> f64 {
        f64::INFINITY
    }
}

/// The same grain, wall or law at a coarse level, each constant scaled by the rule.
/// Refused if a constant has no value at that level.
///
/// ```
/// use tsubu_coarsen::{Level, SakaiKoshizuka, coarsen};
/// use tsubu_model::Kind;
/// let coarse = coarsen(&SakaiKoshizuka, &Kind::sphere(1.0e-3, 2500.0), Level::new(1))?;
/// assert_eq!(coarse.diameter(), 2.0e-3);
/// # Ok::<(), tsubu_coarsen::TooCoarse>(())
/// ```
pub fn coarsen<C: Constants>(
    rule: &dyn CoarseRule,
    fine: &C,
    level: Level,
) -> Result<C, TooCoarse> {
    let lambda = level.lambda();
    for (constant, quantity, value) in fine.constants() {
        let limit = rule.limit(quantity, value);
        if lambda >= limit {
            return Err(TooCoarse {
                rule: rule.name(),
                constant,
                value,
                level,
                limit,
            });
        }
    }
    Ok(fine.mapped(|quantity, value| rule.scale(quantity, value, lambda)))
}

/// A constant has no value at this level under this rule.
#[derive(Clone, Debug, PartialEq)]
pub struct TooCoarse {
    /// Name of the rule.
    pub rule: &'static str,
    /// Name of the constant.
    pub constant: &'static str,
    /// Its value at n = 0.
    pub value: f64,
    /// The level asked for.
    pub level: Level,
    /// λ must stay below this.
    pub limit: f64,
}

impl TooCoarse {
    /// The largest level that this constant can reach.
    pub fn largest(&self) -> Level {
        let fits = (0..self.level.n())
            .rev()
            .map(Level::new)
            .find(|level| level.lambda() < self.limit);
        fits.unwrap_or_default()
    }
}

impl fmt::Display for TooCoarse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            rule,
            constant,
            value,
            level,
            limit,
        } = self;
        write!(
            f,
            "the rule `{rule}` gives `{constant}` = {value} no value at {level} (λ = {}): \
             λ must stay below {limit:.3}; the largest level is {}",
            level.lambda(),
            self.largest(),
        )
    }
}

impl std::error::Error for TooCoarse {}
