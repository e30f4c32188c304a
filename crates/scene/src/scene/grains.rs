//! Grains: their size and mass, their law, and how they are softened and coarsened.

use std::f64::consts::PI;

use super::{HertzMindlin, SpringDashpot};

/// The grain at coarse level n = 0, and how it is softened and coarsened.
#[derive(Clone, Debug, PartialEq)]
pub struct Grains {
    /// Diameter, m, at n = 0; of several populations the largest.
    pub diameter: f64,
    /// Mass of one grain of that diameter, kg, at n = 0 (from the density if the scene gives that).
    pub mass: f64,
    /// Name of their material, number 0 of all.
    pub material: String,
    /// The populations of a mixture in the order of the file; empty for grains all alike.
    pub populations: Vec<Population>,
    /// The law between grains, constants at n = 0 and before softening.
    pub law: Law,
    /// Further materials, numbers 1 and up, with the law between grains of each; all laws are the same but for constants.
    pub materials: Vec<Material>,
    /// What unlike materials make of each other; every pair that can meet is there.
    pub pairs: Vec<PairOf>,
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
    /// Name of a material by its number.
    pub fn material_name(&self, number: usize) -> &str {
        match number {
            0 => &self.material,
            more => self.materials.get(more - 1).map_or("", |m| &m.name),
        }
    }

    /// Law between two grains of a material.
    pub fn law_of(&self, material: usize) -> &Law {
        match material {
            0 => &self.law,
            more => self.materials.get(more - 1).map_or(&self.law, |m| &m.law),
        }
    }

    /// What two unlike materials make of each other, in either order.
    pub fn pair_of(&self, a: usize, b: usize) -> Option<&PairOf> {
        let of = [a.min(b), a.max(b)];
        self.pairs.iter().find(|pair| pair.of == of)
    }

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

/// One of the populations of a mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Population {
    /// Diameter, m, at n = 0; the largest is that of the grains.
    pub diameter: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Share of the mass of all grains, above zero; they add up to 1 within 1e-6.
    pub share: f64,
    /// Number of its material.
    pub material: usize,
}

/// A material beside that of the grains.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, unlike any other.
    pub name: String,
    /// The law between two grains of it.
    pub law: Law,
}

/// A pair of unlike materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairOf {
    /// Numbers of the materials, the smaller first.
    pub of: [usize; 2],
    /// Restitution in (0, 1]; `None` only with law `SpringDashpot`: the mean of their dampings in series.
    pub restitution: Option<f64>,
    /// Friction, not negative; 0 with law `Repulsion`, which has none.
    pub friction: f64,
    /// Rolling friction, not negative; present exactly if the laws resist rolling.
    pub rolling_friction: Option<f64>,
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
    /// Elastic spheres with friction, for grains that turn.
    HertzMindlin(HertzMindlin),
}

impl Law {
    /// Its name in a scene.
    pub fn name(&self) -> &'static str {
        match self {
            Law::Repulsion { .. } => "Repulsion",
            Law::SpringDashpot(_) => "SpringDashpot",
            Law::HertzMindlin(_) => "HertzMindlin",
        }
    }
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
