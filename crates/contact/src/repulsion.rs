//! The exemplar of a contact law: Lennard-Jones repulsion and viscous damping. New laws copy its shape.

use std::marker::PhantomData;
use tsubu_model::{
    Constants, ContactLaw, Dim, Kind, Linear, Push, Quantity, SpinState, Touch, Vector,
};

/// 2^(1/6): range of the repulsion over σ.
const RANGE_OVER_SIGMA: f64 = 1.122_462_048_309_373;
/// 72·2^(−1/3): contact stiffness φ''(r_c) over ε/σ².
const STIFFNESS_FACTOR: f64 = 57.146_437_870_855;

/// Repulsion of Lennard-Jones form (Weeks–Chandler–Andersen) with viscous damping: paper A's law for coke.
///
/// ```text
/// F = −φ'(r) n − γn vn − γt vt     for r < r_c = 2^(1/6) σ,  0 otherwise
/// φ(r) = 4ε[(σ/r)^12 − (σ/r)^6] + ε,    −φ'(r) = (24ε/r)[2(σ/r)^12 − (σ/r)^6]
/// ```
///
/// | symbol | field | unit |
/// |---|---|---|
/// | ε | `epsilon` | J |
/// | σ | `sigma` | m |
/// | γn, γt | `normal_damping`, `tangential_damping` | kg/s |
///
/// n points from the partner to the grain, v is the relative velocity. The contact stiffness is
/// k = φ''(r_c) = 72·2^(−1/3) ε/σ², so the law is nearly a linear spring.
///
/// What it is *not*: there is no spin, no static friction and no memory of the contact. Grains in a
/// heap slide past each other at a speed set by γt, so a heap of this law creeps and its angle of
/// repose is a function of time. Small overlaps only: the potential is singular at r = 0.
///
/// With [`Isotropic`] damping (γn = γt, the paper's own case) the force is −φ'(r) n − γ v: neither a
/// root nor a projection is compiled. [`PerDirection`] pays for both.
///
/// Source: `Sumitomo2024`, section 2.1; potential `Weeks1971`.
///
/// ```
/// use tsubu_contact::Repulsion;
/// let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
/// assert!((coke.stiffness() / 3.72524e6 - 1.0).abs() < 1e-5);       // N/m
/// let zeta = coke.damping_ratio(0.5 * 1.7649e-6);                    // a pair of equal grains
/// assert!((zeta - 0.0347).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repulsion<G: Damping = Isotropic> {
    /// ε in J.
    pub epsilon: f64,
    /// σ in m.
    pub sigma: f64,
    /// γn in kg/s.
    pub normal_damping: f64,
    /// γt in kg/s.
    pub tangential_damping: f64,
    /// Diameter in m of the grain that these constants belong to; other sizes scale from it
    /// (σ ∝ d, ε ∝ d³, γ ∝ d²: the same material).
    pub diameter: f64,
    damping: PhantomData<G>,
}

/// Damping −γ v, without projection: γ = γn whatever γt says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Isotropic;
/// Damping −γn vn − γt vt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerDirection;

/// How the damping acts, as a type: the isotropic one removes work from the inner loop.
pub trait Damping: Copy + Default + Send + Sync + 'static {
    /// γt as the force has it.
    fn tangential(pair: &RepulsionPair) -> f64;
    /// The viscous force.
    fn force<D: Dim>(pair: &RepulsionPair, apart: D::V, velocity: D::V, r2: f64) -> D::V;
}

impl Damping for Isotropic {
    fn tangential(pair: &RepulsionPair) -> f64 {
        pair.normal_damping
    }

    #[inline(always)]
    fn force<D: Dim>(pair: &RepulsionPair, _apart: D::V, velocity: D::V, _r2: f64) -> D::V {
        velocity * -pair.normal_damping
    }
}

impl Damping for PerDirection {
    fn tangential(pair: &RepulsionPair) -> f64 {
        pair.tangential_damping
    }

    #[inline(always)]
    fn force<D: Dim>(pair: &RepulsionPair, apart: D::V, velocity: D::V, r2: f64) -> D::V {
        // n (n·v) = apart (apart·v)/r²: the projection needs no root.
        let along = apart * (apart.dot(velocity) / r2);
        (along * (pair.tangential_damping - pair.normal_damping))
            + velocity * -pair.tangential_damping
    }
}

/// Constants of [`Repulsion`] for one pair of kinds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepulsionPair {
    /// 24 ε in J.
    pub epsilon24: f64,
    /// σ² in m².
    pub sigma2: f64,
    /// r_c² in m².
    pub range2: f64,
    /// γn in kg/s.
    pub normal_damping: f64,
    /// γt in kg/s.
    pub tangential_damping: f64,
}

impl RepulsionPair {
    /// Contact stiffness k = φ''(r_c) in N/m: 72·2^(−1/3) ε/σ².
    pub fn contact_stiffness(&self) -> f64 {
        STIFFNESS_FACTOR * (self.epsilon24 / 24.0) / self.sigma2
    }

    /// −φ'(r)/r in N/m.
    #[inline(always)]
    pub(crate) fn push_over_r(&self, r2: f64) -> f64 {
        let inverse = 1.0 / r2;
        let s2 = self.sigma2 * inverse;
        let s6 = s2 * s2 * s2;
        self.epsilon24 * inverse * (s6 * (s6 + s6 - 1.0))
    }

    /// φ(r) in J, zero beyond the range.
    pub(crate) fn potential(&self, r2: f64) -> f64 {
        if r2 >= self.range2 {
            return 0.0;
        }
        let s6 = (self.sigma2 / r2).powi(3);
        self.epsilon24 / 24.0 * (4.0 * (s6 * s6 - s6) + 1.0)
    }

    /// φ''(r) in N/m, zero beyond the range.
    pub(crate) fn stiffness(&self, r2: f64) -> f64 {
        if r2 >= self.range2 {
            return 0.0;
        }
        let s6 = (self.sigma2 / r2).powi(3);
        self.epsilon24 / r2 * (26.0 * s6 * s6 - 7.0 * s6)
    }
}

impl Repulsion<Isotropic> {
    /// From ε (J), σ (m), γn and γt (kg/s) of a grain of this diameter (m).
    /// Use [`per_direction`](Repulsion::per_direction) when γn and γt differ.
    pub fn new(
        epsilon: f64,
        sigma: f64,
        normal_damping: f64,
        tangential_damping: f64,
        diameter: f64,
    ) -> Self {
        Self {
            epsilon,
            sigma,
            normal_damping,
            tangential_damping,
            diameter,
            damping: PhantomData,
        }
    }

    /// From Young's modulus E (Pa): contact stiffness k = E σ, so ε = E σ³ / (72·2^(−1/3)).
    pub fn from_young_modulus(
        young: f64,
        sigma: f64,
        normal_damping: f64,
        tangential_damping: f64,
        diameter: f64,
    ) -> Self {
        Self::new(
            young * sigma.powi(3) / STIFFNESS_FACTOR,
            sigma,
            normal_damping,
            tangential_damping,
            diameter,
        )
    }

    /// The same constants with the damping taken direction by direction.
    pub fn per_direction(self) -> Repulsion<PerDirection> {
        let Self {
            epsilon,
            sigma,
            normal_damping,
            tangential_damping,
            diameter,
            ..
        } = self;
        Repulsion {
            epsilon,
            sigma,
            normal_damping,
            tangential_damping,
            diameter,
            damping: PhantomData,
        }
    }

    /// σ in m of a grain that touches at its diameter: d / 2^(1/6).
    pub fn sigma_for_diameter(diameter: f64) -> f64 {
        diameter / RANGE_OVER_SIGMA
    }
}

impl<G: Damping> Repulsion<G> {
    /// Contact stiffness k = φ''(r_c) in N/m.
    pub fn stiffness(&self) -> f64 {
        STIFFNESS_FACTOR * self.epsilon / (self.sigma * self.sigma)
    }

    /// ζ = γn / (2√(k m*)), m* the reduced mass in kg (half the mass for equal grains).
    pub fn damping_ratio(&self, reduced_mass: f64) -> f64 {
        self.normal_damping / (2.0 * (self.stiffness() * reduced_mass).sqrt())
    }

    /// The stiffness divided by `soften`; γn and γt multiplied by the two factors.
    pub fn softened(self, soften: f64, normal_factor: f64, tangential_factor: f64) -> Self {
        Self {
            epsilon: self.epsilon / soften,
            normal_damping: self.normal_damping * normal_factor,
            tangential_damping: self.tangential_damping * tangential_factor,
            ..self
        }
    }

    /// Constants of the same material at another diameter (m): with q the new diameter over the old,
    /// σ' = qσ, ε' = q³ε, γ' = q²γ, so k' = qk while E = k/σ, ζ and the restitution stay.
    pub fn at_diameter(&self, diameter: f64) -> Self {
        let scale = diameter / self.diameter;
        if scale == 1.0 {
            return *self;
        }
        Self {
            epsilon: self.epsilon * scale.powi(3),
            sigma: self.sigma * scale,
            normal_damping: self.normal_damping * scale * scale,
            tangential_damping: self.tangential_damping * scale * scale,
            diameter,
            damping: PhantomData,
        }
    }

    /// Constants of a contact between a grain of this law and one of another.
    ///
    /// ```text
    /// σ = (σa + σb)/2,   k = 2 ka kb/(ka + kb),   γ = 2 γa γb/(γa + γb),   ε = k σ²/(72·2^(−1/3))
    /// ```
    ///
    /// Ranges r_c = 2^(1/6) σ add up as radii do; two half-contacts act as springs and dashpots in
    /// series, each twice as stiff as the contact of two equal grains. Symmetric to the bit, and the
    /// grain's own constants when the two are equal. Of one material with sizes in the ratio q
    /// ([`at_diameter`](Self::at_diameter)): σ = (1 + q)/2 σa, k = 2q/(1 + q) ka, γ = 2q²/(1 + q²) γa.
    ///
    /// Source: a choice; `Sumitomo2024` does not say how kinds mix.
    ///
    /// ```
    /// use tsubu_contact::Repulsion;
    /// let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
    /// let pair = coke.mixed(&coke.at_diameter(0.5 * 1.350e-3));        // q = 1/2
    /// assert!((pair.normal_damping / (0.4 * 0.1257) - 1.0).abs() < 1e-12);
    /// assert_eq!(coke.mixed(&coke).normal_damping, 0.1257);
    /// ```
    pub fn mixed(&self, other: &Self) -> RepulsionPair {
        let sigma = 0.5 * (self.sigma + other.sigma);
        let epsilon = if self.epsilon == other.epsilon && self.sigma == other.sigma {
            self.epsilon
        } else {
            harmonic_mean(self.stiffness(), other.stiffness()) * sigma * sigma / STIFFNESS_FACTOR
        };
        let range = RANGE_OVER_SIGMA * sigma;
        RepulsionPair {
            epsilon24: 24.0 * epsilon,
            sigma2: sigma * sigma,
            range2: range * range,
            normal_damping: harmonic_mean(self.normal_damping, other.normal_damping),
            tangential_damping: harmonic_mean(self.tangential_damping, other.tangential_damping),
        }
    }
}

/// Mean of two series springs or dashpots: 2ab/(a + b), and exactly a when a = b.
fn harmonic_mean(a: f64, b: f64) -> f64 {
    if a == b {
        a
    } else if a + b == 0.0 {
        0.0
    } else {
        2.0 * a * b / (a + b)
    }
}

impl<G: Damping, D: Dim, S: SpinState> ContactLaw<D, S> for Repulsion<G> {
    type Pair = RepulsionPair;
    type Memory = [f64; 0];

    /// The material at the two sizes, mixed: see [`Repulsion::mixed`].
    fn pair(&self, a: &Kind, b: &Kind) -> RepulsionPair {
        let (a, b) = (a.diameter(), b.diameter());
        self.at_diameter(a).mixed(&self.at_diameter(b))
    }

    fn range(pair: &RepulsionPair) -> f64 {
        pair.range2.sqrt()
    }

    #[inline(always)]
    fn force(
        pair: &RepulsionPair,
        touch: &Touch<D, S>,
        _memory: &mut [f64; 0],
        _dt: f64,
    ) -> Push<D, S> {
        let touching = if touch.r2 < pair.range2 { 1.0 } else { 0.0 };
        let elastic = touch.apart * (pair.push_over_r(touch.r2) * touching);
        let viscous = G::force::<D>(pair, touch.apart, touch.velocity, touch.r2) * touching;
        Push {
            elastic,
            viscous,
            slip: D::V::ZERO,
            twist: Default::default(),
            couple: Default::default(),
        }
    }

    fn stored(pair: &RepulsionPair, touch: &Touch<D, S>, _memory: &[f64; 0]) -> f64 {
        pair.potential(touch.r2)
    }

    fn linear(pair: &RepulsionPair, touch: &Touch<D, S>, _dt: f64) -> Linear {
        if touch.r2 >= pair.range2 {
            return Linear::default();
        }
        Linear {
            normal_stiffness: pair.stiffness(touch.r2),
            tangential_stiffness: 0.0,
            normal_damping: pair.normal_damping,
            tangential_damping: G::tangential(pair),
        }
    }
}

impl<G: Damping> Constants for Repulsion<G> {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        vec![
            ("epsilon", Quantity::Energy, self.epsilon),
            ("sigma", Quantity::Length, self.sigma),
            ("normal_damping", Quantity::Damping, self.normal_damping),
            (
                "tangential_damping",
                Quantity::Damping,
                self.tangential_damping,
            ),
            ("diameter", Quantity::Length, self.diameter),
        ]
    }

    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            epsilon: f(Quantity::Energy, self.epsilon),
            sigma: f(Quantity::Length, self.sigma),
            normal_damping: f(Quantity::Damping, self.normal_damping),
            tangential_damping: f(Quantity::Damping, self.tangential_damping),
            diameter: f(Quantity::Length, self.diameter),
            damping: PhantomData,
        }
    }
}
