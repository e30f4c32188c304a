//! The law of elastic spheres: what a scene says of it.

/// Constants of law `HertzMindlin` of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzMindlin {
    /// Young's modulus, Pa, above zero.
    pub young: f64,
    /// Poisson's ratio, above −1 and at most 0.5.
    pub poisson: f64,
    /// Restitution of two grains of this material, in (0, 1].
    pub restitution: f64,
    /// Friction between two grains of this material, not negative.
    pub friction: f64,
    /// What resists rolling; `None`: grains roll freely.
    pub rolling: Option<RollingResistance>,
}

/// What resists rolling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingResistance {
    /// Rolling friction, above zero.
    pub friction: f64,
    /// Damping ratio of rolling, not negative.
    pub damping: f64,
    /// How.
    pub by: Resistance,
}

/// How rolling is resisted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resistance {
    /// A spring with a limit, and a dashpot.
    #[default]
    ElasticPlastic,
    /// A couple of constant size.
    Constant,
}
