//! Paper A's rule: an exactly similar grain of the same material.

use crate::CoarseRule;
use tsubu_model::Quantity;

/// Renormalisation: all lengths of a contact × λ at equal Young's modulus, density and speed.
///
/// ```text
/// d' = λ d,  m' = λ³ m,  φ'(r) = λ³ φ(r/λ)  (ε' = λ³ ε, σ' = λ σ, k' = λ k),  γ' = λ² γ,  Δt' = λ Δt
/// ```
///
/// λ: ratio of diameters (pure number); d, σ in m; m in kg; ε in J; k in N/m; γ in kg/s; Δt in s.
/// Kept: density, E = k/d, stress, ζ and e, overlap ratio. Not kept: inertial number (× λ), collision
/// rate (1/λ), creep viscosity of viscous contacts (× λ), and whatever depends on d (crate page).
/// Validity: dense, slow flow in openings of 8 d' and more.
///
/// Sources: `Sumitomo2024` sections 2.2–2.3; the same contact scaling in `Bierwisch2009`; claimed by
/// `Hirose2018` (crate page).
///
/// ```
/// use tsubu_coarsen::{CoarseRule, Renormalised};
/// use tsubu_model::Quantity;
/// // Coke at λ = 8: 0.1257 kg/s becomes 8.045 kg/s, a contact of 1.529 µs lasts 12.23 µs.
/// assert!((Renormalised.scale(Quantity::Damping, 0.1257, 8.0) - 8.0448).abs() < 1e-9);
/// assert!((Renormalised.step_factor(8.0) * 1.529e-6 - 12.232e-6).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Renormalised;

impl CoarseRule for Renormalised {
    fn name(&self) -> &'static str {
        "Renormalised"
    }

    fn source(&self) -> &'static str {
        "Sumitomo2024, Bierwisch2009, Hirose2018"
    }

    fn scale(&self, quantity: Quantity, value: f64, lambda: f64) -> f64 {
        let power = match quantity {
            Quantity::Length | Quantity::Stiffness => 1,
            Quantity::Damping => 2,
            Quantity::Mass | Quantity::Energy => 3,
            Quantity::Modulus | Quantity::Restitution | Quantity::Number => 0,
        };
        value * lambda.powi(power)
    }

    fn step_factor(&self, lambda: f64) -> f64 {
        lambda
    }
}
