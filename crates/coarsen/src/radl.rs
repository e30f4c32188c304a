//! Radl's restitution: fewer collisions that each lose more.

use crate::{CoarseRule, Level, Renormalised, TooCoarse};
use std::f64::consts::PI;
use std::fmt;
use tsubu_model::Quantity;

/// As [`Renormalised`], with a restitution that keeps the rate at which collisions dissipate.
///
/// ```text
/// e_c = √(1 + (e² − 1) λ),   γ' = λ² γ ζ(e_c)/ζ(e),   ζ(e) = −ln e / √(π² + ln² e)
/// ```
///
/// e: restitution of a pair of real grains (pure number); γ in kg/s; ζ the damping ratio of a contact
/// that ends at zero overlap, as that of a grain pair does. A coarse grain collides 1/λ times as often
/// and loses 1 − e_c² = λ(1 − e²) of its energy each time.
///
/// Validity: rapid, collisional flow, and only λ < 1/(1 − e²): below that e_c has a value. Every
/// constant is held to it where the level is known, in [`coarsen`](crate::coarsen). The damping ratio
/// grows with λ, and the stable step must be looked up again: Δt' = λ Δt is for light damping.
/// For grains among themselves; walls go through [`Renormalised`] (crate page).
///
/// A rule maps one value at a time, so it carries the pair's e to know what a damping stands for;
/// a restitution that a law lists is mapped by its own value.
///
/// Source: `Radl2011`; restitution `Schwager2007`.
///
/// ```
/// use tsubu_coarsen::{CoarseRule, RadlRestitution};
/// use tsubu_model::Quantity;
/// let rule = RadlRestitution::new(0.9)?;
/// // e = 0.9, λ = 4: e_c = √(1 − 0.19·4) = 0.4899; the limit is λ < 1/0.19 = 5.263.
/// assert!((rule.scale(Quantity::Restitution, 0.9, 4.0) - 0.4899).abs() < 1e-4);
/// assert!((rule.limit(Quantity::Damping, 0.1257) - 5.263).abs() < 1e-3);
/// // ζ(0.4899)/ζ(0.9) = 0.22149/0.033518 = 6.608.
/// assert!((rule.scale(Quantity::Damping, 1.0, 4.0) - 16.0 * 6.608).abs() < 0.01);
/// # Ok::<(), tsubu_coarsen::NotARestitution>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadlRestitution {
    restitution: f64,
}

impl RadlRestitution {
    /// For grains whose pairs rebound with this restitution, in (0, 1].
    pub fn new(restitution: f64) -> Result<Self, NotARestitution> {
        if restitution > 0.0 && restitution <= 1.0 {
            Ok(Self { restitution })
        } else {
            Err(NotARestitution { value: restitution })
        }
    }

    /// The pair's restitution e that the rule carries.
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// The rule for grains that this rule has already brought to `level`: it carries their e_c.
    pub fn after(&self, level: Level) -> Result<Self, TooCoarse> {
        let (value, limit) = (self.restitution, limit(self.restitution));
        if level.lambda() >= limit {
            return Err(TooCoarse {
                rule: self.name(),
                constant: "restitution",
                value,
                level,
                limit,
            });
        }
        Ok(Self {
            restitution: corrected(value, level.lambda()),
        })
    }

    /// ζ(e_c)/ζ(e); its limit λ where nothing is lost.
    fn damping_ratio(&self, lambda: f64) -> f64 {
        let corrected = corrected(self.restitution, lambda);
        if self.restitution == 1.0 {
            lambda
        } else {
            zeta(corrected) / zeta(self.restitution)
        }
    }
}

/// e_c.
fn corrected(e: f64, lambda: f64) -> f64 {
    (1.0 + (e * e - 1.0) * lambda).sqrt()
}

/// λ at which e_c reaches zero.
fn limit(e: f64) -> f64 {
    1.0 / (1.0 - e * e)
}

/// Damping ratio of a contact that ends at zero overlap.
fn zeta(e: f64) -> f64 {
    let ln = e.ln();
    -ln / (PI * PI + ln * ln).sqrt()
}

impl CoarseRule for RadlRestitution {
    fn name(&self) -> &'static str {
        "RadlRestitution"
    }

    fn source(&self) -> &'static str {
        "Radl2011, Sumitomo2024, Schwager2007"
    }

    fn scale(&self, quantity: Quantity, value: f64, lambda: f64) -> f64 {
        match quantity {
            Quantity::Restitution => corrected(value, lambda),
            Quantity::Damping => {
                Renormalised.scale(quantity, value, lambda) * self.damping_ratio(lambda)
            }
            _ => Renormalised.scale(quantity, value, lambda),
        }
    }

    fn step_factor(&self, lambda: f64) -> f64 {
        lambda
    }

    fn limit(&self, quantity: Quantity, value: f64) -> f64 {
        match quantity {
            Quantity::Restitution => limit(value),
            Quantity::Damping => limit(self.restitution),
            _ => f64::INFINITY,
        }
    }
}

/// The number is not in (0, 1] and so no restitution that Radl's rule can start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotARestitution {
    /// The number.
    pub value: f64,
}

impl fmt::Display for NotARestitution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the pair's restitution is {}, it must lie above 0 and at most at 1",
            self.value
        )
    }
}

impl std::error::Error for NotARestitution {}
