//! The constants of a law with their quantities, so that a coarse-graining rule or a change of units
//! can work on any law without knowing it.

/// What a constant measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// m.
    Length,
    /// kg.
    Mass,
    /// Energy scale of a potential in J: stiffness × length².
    Energy,
    /// N/m.
    Stiffness,
    /// kg/s.
    Damping,
    /// Elastic modulus of a Hertzian contact in Pa, whose force goes with modulus × √R δ^(3/2).
    Modulus,
    /// Ratio of the speeds after and before a collision.
    Restitution,
    /// A pure number: friction, Poisson's ratio.
    Number,
}

impl Quantity {
    /// Exponents of length, mass and time.
    pub fn exponents(self) -> [i32; 3] {
        match self {
            Quantity::Length => [1, 0, 0],
            Quantity::Mass => [0, 1, 0],
            Quantity::Energy => [2, 1, -2],
            Quantity::Stiffness => [0, 1, -2],
            Quantity::Damping => [0, 1, -1],
            Quantity::Modulus => [-1, 1, -2],
            Quantity::Restitution | Quantity::Number => [0, 0, 0],
        }
    }
}

/// Something described by a fixed list of constants.
pub trait Constants: Sized {
    /// Name, quantity and value of each constant, always in the same order.
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)>;
    /// The same with each constant replaced by `f(quantity, value)`.
    fn mapped(&self, f: impl FnMut(Quantity, f64) -> f64) -> Self;
}

impl Constants for crate::Kind {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        vec![
            ("diameter", Quantity::Length, self.diameter()),
            ("mass", Quantity::Mass, self.mass),
            ("weight", Quantity::Mass, self.weight),
        ]
    }

    /// Inertia goes with mass × length².
    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        let (radius, mass, weight) = (
            0.5 * f(Quantity::Length, self.diameter()),
            f(Quantity::Mass, self.mass),
            f(Quantity::Mass, self.weight),
        );
        let inertia = if self.inertia.is_finite() {
            self.inertia * (mass / self.mass) * (radius / self.radius).powi(2)
        } else {
            self.inertia
        };
        Self {
            radius,
            mass,
            inertia,
            weight,
            material: self.material,
        }
    }
}
