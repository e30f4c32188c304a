//! A kind of grain: the constants that grains of one sort share.

use std::f64::consts::PI;

/// Constants of one kind of grain. Mass, inertia and weight are apart because they part in water:
/// added mass moves inertia, buoyancy moves weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Radius in m.
    pub radius: f64,
    /// Inertial mass in kg.
    pub mass: f64,
    /// Moment of inertia in kg m².
    pub inertia: f64,
    /// The mass that gravity pulls, in kg.
    pub weight: f64,
    /// Number of its material, for laws that hold several: see `tsubu_contact::PerPair`.
    pub material: usize,
}

impl Kind {
    /// A dry solid sphere: m = ρ π d³/6, I = m d²/10. Diameter in m, density in kg/m³.
    ///
    /// ```
    /// let coke = tsubu_model::Kind::sphere(1.350e-3, 1370.0);
    /// assert!((coke.mass / 1.7649e-6 - 1.0).abs() < 1e-4);
    /// ```
    pub fn sphere(diameter: f64, density: f64) -> Self {
        Self::with_mass(diameter, density * PI / 6.0 * diameter.powi(3))
    }

    /// A solid sphere of given mass in kg.
    pub fn with_mass(diameter: f64, mass: f64) -> Self {
        Self {
            radius: 0.5 * diameter,
            mass,
            inertia: mass * diameter * diameter / 10.0,
            weight: mass,
            material: 0,
        }
    }

    /// The same of another material.
    pub fn of(self, material: usize) -> Self {
        Self { material, ..self }
    }

    /// A body that no contact moves: infinite mass. Walls pair with grains through this kind.
    pub fn immovable() -> Self {
        Self {
            radius: 0.0,
            mass: f64::INFINITY,
            inertia: f64::INFINITY,
            weight: 0.0,
            material: 0,
        }
    }

    /// Diameter in m.
    pub fn diameter(&self) -> f64 {
        2.0 * self.radius
    }
}
