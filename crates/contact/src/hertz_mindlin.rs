//! The field's standard law for elastic spheres: Hertz along the normal, Mindlin across it, Coulomb friction, a restitution
//! that is the one asked for, and resistance to rolling if it is wanted.

mod bristle;
mod material;
mod pair;
mod rolling;

pub use bristle::Bristle;
pub use material::Elastic;
pub use pair::HertzMindlinPair;
pub use rolling::{Freely, Resistance, Resisted, Rolling};

use std::f64::consts::PI;
use tsubu_model::{Constants, Quantity};

/// Hertz–Mindlin contact of two elastic spheres that spin, with restitution, Coulomb friction and, as a type, rolling
/// resistance.
///
/// ```text
/// δ = range − r,   R* = r_i r_j/(r_i + r_j),   m* = m_i m_j/(m_i + m_j),   v_n = v·n
/// e_n = (4/3) E* √R* δ^(3/2)                  d_n = −2ζ √(5/4 · (4/3) E* √R* m*) δ^(1/4) v_n
/// f_n = max(e_n + d_n, 0)
/// kt  = 8 G* √R* √δ                           d_s = −2ζ √(5/6 · 8 G* √R* m*) δ^(1/4) v_s
/// e_s ← e_s · min(kt/kt before, 1) − kt v_s Δt,   |e_s| ≤ μ e_n,   |e_s + d_s| ≤ μ f_n
/// 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j,     1/G* = 2(2 − ν_i)(1 + ν_i)/E_i + 2(2 − ν_j)(1 + ν_j)/E_j
/// ```
///
/// | symbol | field | unit |
/// |---|---|---|
/// | E*, G* | `modulus`, `shear` | Pa |
/// | e, from which ζ | `restitution` | – |
/// | μ | `friction` | – |
/// | rolling | `rolling`: [`Freely`] or [`Resisted`] | |
///
/// Signs, the turning of e_s with the normal and the torques are those of [`SpringDashpot`](crate::SpringDashpot); so is
/// Coulomb's limit, on spring and dashpot together. Against `Kind::immovable()` a flat wall is meant: R* = r_i, m* = m_i, and
/// the wall is the grain's mirror for the range.
///
/// *Restitution.* With the damping ∝ δ^(1/4) the collision of a Hertzian contact is that of a linear one in the variable δ^(5/4)
/// and the time ∫δ^(1/4) dt (`Antypov2011`), of ratio ζ; the contact that ends without force maps to the linear one that does.
/// So ζ from e by [`ratio_from_restitution`](crate::restitution::ratio_from_restitution) gives e at any speed, size and mass.
///
/// *Mindlin.* The tangential stiffness is that of the no-slip solution at the present overlap. When the contact is unloaded the
/// spring shrinks with its stiffness, when it is loaded the force stays: so neither gives energy away. The micro-slip of
/// `Mindlin1953` is left out, as most codes do.
///
/// What it is *not*: overlaps above some percent of the radius (Hertz is for small contacts), adhesion, plastic contacts, and
/// resistance to twisting about n. Below gross sliding, where a contact slips in part, the tangential restitution of an impact is up to
/// 0.12 above the measured one (`Kharaz2001`; `cargo xtask validate hertz`).
///
/// Sources: `Hertz1882`, `Mindlin1953`, `Tsuji1992` (the form of the damping), `Antypov2011`, `Schwager2007` (its size),
/// `Thornton2013` (loading and unloading across n), `Ai2011` (rolling).
///
/// ```
/// use tsubu_contact::{Elastic, HertzMindlin};
/// use tsubu_model::{ContactLaw, Kind, Space};
/// // Two spheres of glass, 1 cm in radius, meet at ±10 m/s (Chung and Ooi's first test): they overlap by 274.11 µm.
/// let glass = Elastic { young: 4.8e10, poisson: 0.2 };
/// let law = HertzMindlin::between(&glass, &glass, 1.0, 0.35);
/// let ball = Kind::sphere(2.0e-2, 2800.0);
/// let pair = ContactLaw::<Space, tsubu_model::Spins>::pair(&law, &ball, &ball);
/// let deepest = (5.0 * (0.5 * ball.mass) * 20.0_f64.powi(2) / (4.0 * pair.hertz)).powf(0.4);
/// assert!((deepest / 274.11e-6 - 1.0).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzMindlin<R: Rolling = Freely> {
    /// E* in Pa.
    pub modulus: f64,
    /// G* in Pa.
    pub shear: f64,
    /// e of a head-on collision, in (0, 1].
    pub restitution: f64,
    /// μ.
    pub friction: f64,
    /// What resists rolling.
    pub rolling: R,
}

impl HertzMindlin {
    /// The law between grains of two materials, with the restitution and the friction of this pair; they roll freely.
    ///
    /// ```
    /// use tsubu_contact::{Elastic, HertzMindlin};
    /// let (glass, steel) = (Elastic { young: 7.0e10, poisson: 0.22 }, Elastic { young: 2.1e11, poisson: 0.3 });
    /// let law = HertzMindlin::between(&glass, &steel, 0.9, 0.2);
    /// assert!((law.modulus / 5.578e10 - 1.0).abs() < 1e-3);     // 1/E* = 0.9516/70 GPa + 0.91/210 GPa
    /// assert_eq!(law, HertzMindlin::between(&steel, &glass, 0.9, 0.2));
    /// ```
    pub fn between(a: &Elastic, b: &Elastic, restitution: f64, friction: f64) -> Self {
        Self {
            modulus: 1.0 / (a.compliance() + b.compliance()),
            shear: 1.0 / (a.shear_compliance() + b.shear_compliance()),
            restitution,
            friction,
            rolling: Freely,
        }
    }

    /// The same with a resistance to rolling.
    pub fn resisting(self, rolling: Resisted) -> HertzMindlin<Resisted> {
        HertzMindlin {
            modulus: self.modulus,
            shear: self.shear,
            restitution: self.restitution,
            friction: self.friction,
            rolling,
        }
    }
}

/// Rayleigh's time in s: how long a wave along the surface takes from pole to pole of a sphere.
///
/// ```text
/// T = π R √(ρ/G)/(0.1631 ν + 0.8766)
/// ```
///
/// Users of other codes choose their step as 10 to 40 % of it. Radius in m, density in kg/m³.
///
/// Source: `OSullivan2011`.
///
/// ```
/// use tsubu_contact::{Elastic, rayleigh_time};
/// let coke = Elastic { young: 3.096e9, poisson: 0.3 };
/// assert!((rayleigh_time(&coke, 0.675e-3, 1370.0) / 2.46e-6 - 1.0).abs() < 0.01);
/// ```
pub fn rayleigh_time(material: &Elastic, radius: f64, density: f64) -> f64 {
    PI * radius * (density / material.shear()).sqrt() / (0.1631 * material.poisson + 0.8766)
}

/// The constants of the contact; those of its rolling last.
impl<R: Rolling> Constants for HertzMindlin<R> {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        let mut constants = vec![
            ("modulus", Quantity::Modulus, self.modulus),
            ("shear", Quantity::Modulus, self.shear),
            ("restitution", Quantity::Restitution, self.restitution),
            ("friction", Quantity::Number, self.friction),
        ];
        constants.extend(self.rolling.constants());
        constants
    }

    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            modulus: f(Quantity::Modulus, self.modulus),
            shear: f(Quantity::Modulus, self.shear),
            restitution: f(Quantity::Restitution, self.restitution),
            friction: f(Quantity::Number, self.friction),
            rolling: self.rolling.mapped(f),
        }
    }
}
