//! Sakai and Koshizuka's rule: a coarse grain stands for λ³ grains that move together.

use crate::CoarseRule;
use tsubu_model::Quantity;

/// A coarse grain carries the contact forces of λ³ real grains at the same overlap.
///
/// ```text
/// d' = λ d,  m' = λ³ m,  k' = λ³ k,  η' = λ³ η,  ε' = λ⁵ ε (a stiffness × a length²),  E' = λ^(5/2) E,  Δt' = Δt
/// ```
///
/// λ: ratio of diameters; d in m; m in kg; k in N/m; η in kg/s; ε in J; E in Pa, of a Hertzian contact, whose force at the same
/// overlap goes with E √R; Δt in s.
/// Kept: density, ζ and e, the duration of a contact and the overlap in metres at a given impact speed.
/// Not kept: the modulus k/d of a linear contact grows with λ² (so static overlaps shrink), the collision rate falls
/// with 1/λ, and whatever depends on d (crate page). The step is not enlarged: the gain is λ³, not λ⁴.
/// Validity: made for dense gas–solid flow, where the drag on a grain also takes λ³.
///
/// Source: `Sakai2009`.
///
/// ```
/// use tsubu_coarsen::{CoarseRule, SakaiKoshizuka};
/// use tsubu_model::Quantity;
/// // Coke at λ = 2: 3.725e6 N/m becomes 2.98e7 N/m, through k and through ε/σ² alike.
/// assert!((SakaiKoshizuka.scale(Quantity::Stiffness, 3.725e6, 2.0) / 2.98e7 - 1.0).abs() < 1e-12);
/// let (epsilon, sigma) = (9.434e-2, 1.203e-3);
/// let coarse = SakaiKoshizuka.scale(Quantity::Energy, epsilon, 2.0) / SakaiKoshizuka.scale(Quantity::Length, sigma, 2.0).powi(2);
/// assert!((coarse / (8.0 * epsilon / sigma.powi(2)) - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SakaiKoshizuka;

impl CoarseRule for SakaiKoshizuka {
    fn name(&self) -> &'static str {
        "SakaiKoshizuka"
    }

    fn source(&self) -> &'static str {
        "Sakai2009"
    }

    fn scale(&self, quantity: Quantity, value: f64, lambda: f64) -> f64 {
        let power = match quantity {
            Quantity::Modulus => return value * lambda.powi(2) * lambda.sqrt(),
            Quantity::Length => 1,
            Quantity::Mass | Quantity::Stiffness | Quantity::Damping => 3,
            Quantity::Energy => 5,
            Quantity::Restitution | Quantity::Number => 0,
        };
        value * lambda.powi(power)
    }

    fn step_factor(&self, _lambda: f64) -> f64 {
        1.0
    }
}
