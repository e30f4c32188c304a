//! An elastic material.

/// Young's modulus and Poisson's ratio of an isotropic elastic material.
///
/// Source: `Johnson1985`.
///
/// ```
/// let steel = tsubu_contact::Elastic { young: 2.1e11, poisson: 0.3 };
/// assert!((steel.shear() / 8.077e10 - 1.0).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// E in Pa; infinite for a rigid body.
    pub young: f64,
    /// ν, above −1 and at most 0.5.
    pub poisson: f64,
}

impl Elastic {
    /// A body that does not yield, such as the rigid wall of a benchmark.
    pub const RIGID: Elastic = Elastic {
        young: f64::INFINITY,
        poisson: 0.3,
    };

    /// Shear modulus G = E/(2(1 + ν)) in Pa.
    pub fn shear(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// (1 − ν²)/E in 1/Pa: what it adds to 1/E*.
    pub fn compliance(&self) -> f64 {
        (1.0 - self.poisson * self.poisson) / self.young
    }

    /// 2(2 − ν)(1 + ν)/E in 1/Pa: what it adds to 1/G*.
    pub fn shear_compliance(&self) -> f64 {
        2.0 * (2.0 - self.poisson) * (1.0 + self.poisson) / self.young
    }
}
