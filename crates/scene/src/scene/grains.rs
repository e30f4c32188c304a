//! Grains: their size and mass, their law, and how they are softened and coarsened.

use std::f64::consts::PI;

use super::SpringDashpot;

/// The grain at coarse level n = 0, and how it is softened and coarsened.
#[derive(Clone, Debug, PartialEq)]
pub struct Grains {
    /// Diameter, m, at n = 0; of several sizes the largest.
    pub diameter: f64,
    /// Mass of one grain of that diameter, kg, at n = 0 (from the density if the scene gives that).
    pub mass: f64,
    /// The sizes of a mixture in the order of the file; empty for grains of one size.
    pub sizes: Vec<Size>,
    /// The law between grains, constants at n = 0 and before softening.
    pub law: Law,
    /// The stiffness of law `Repulsion` is divided by this, at least 1; 1 with any other law.
    pub soften: f64,
    /// What softening does to the damping.
    pub softened_damping: SoftenedDamping,
    /// Number of renormalisations n, at most 8.
    pub coarse: u32,
    /// What one renormalisation does to the constants.
    pub coarse_rule: CoarseRule,
}

impl Grains {
    /// Volume of one grain at n = 0, m³.
    pub fn volume(&self) -> f64 {
        PI / 6.0 * self.diameter.powi(3)
    }

    /// Density, kg/m³; the same at every coarse level.
    pub fn density(&self) -> f64 {
        self.mass / self.volume()
    }

    /// λ = 2ⁿ, by which the coarse grain's diameter exceeds the real one's.
    pub fn lambda(&self) -> f64 {
        f64::from(1_u32 << self.coarse.min(31))
    }
}

/// One of the sizes of a mixture; all have the density of the grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Diameter, m, no two alike and the largest that of the grains.
    pub diameter: f64,
    /// Share of the mass of all grains, above zero; they add up to 1 within 1e-6.
    pub share: f64,
}

/// A contact law with its constants.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Lennard-Jones repulsion with viscous damping.
    Repulsion {
        /// How stiff a contact is.
        stiffness: Stiffness,
        /// How a contact damps.
        damping: Damping,
    },
    /// Springs and dashpots with friction, for grains that turn.
    SpringDashpot(SpringDashpot),
}

/// The stiffness of law `Repulsion`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stiffness {
    /// Young's modulus, Pa; the law derives ε and σ from it and from the diameter.
    YoungModulus(f64),
    /// The law's own constants.
    Energy {
        /// ε, J.
        epsilon: f64,
        /// σ, m; the reach 2^(1/6) σ is the diameter within 1 %.
        sigma: f64,
    },
}

/// Viscous damping coefficients of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// γ in every direction, kg/s.
    Equal(f64),
    /// γ along and across the line of centres, kg/s.
    Parts {
        /// γn, kg/s.
        normal: f64,
        /// γt, kg/s.
        tangential: f64,
    },
}

/// What softening the stiffness by s does to the damping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SoftenedDamping {
    /// Nothing: creep stays as it is, the damping ratio grows by √s.
    #[default]
    Kept,
    /// Both parts are divided by √s: the restitution stays as it is, creep runs √s faster.
    Scaled,
    /// The normal part is divided by √s, the tangential part kept.
    NormalScaled,
}

/// The rule of coarse-graining.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoarseRule {
    /// The renormalisation of the paper: ε λ³, σ λ, γ λ², Δt λ.
    #[default]
    Renormalised,
    /// Sakai and Koshizuka: stiffness and damping λ³, Δt not enlarged.
    SakaiKoshizuka,
    /// Radl's corrected restitution.
    RadlRestitution,
}
