//! The water that flows over a bed of grains.

/// Water over a bed, flowing along +x. Heights are above the datum.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// How strong it flows.
    pub flow: Flow,
    /// When it begins to flow, s from the start, not negative. Weight and added mass are those under water from the start on.
    pub begins: f64,
    /// ρ, kg/m³, above zero and below the density of the grains.
    pub density: f64,
    /// CM, not negative.
    pub added_mass: f64,
    /// CD, not negative.
    pub drag: f64,
    /// The mean flow over height.
    pub profile: FlowProfile,
    /// The fluctuations.
    pub turbulence: Turbulence,
    /// ε0, the share of the drag that is left deep in the bed, in [0, 1]; 1 is no shelter.
    pub shelter: f64,
    /// When the datum is found.
    pub datum: Datum,
    /// Contacts from which on a grain belongs to the bed, at most 12; 0 counts every grain.
    pub bed_contacts: u32,
    /// Tangent of the bed's downward slope along +x, above −1 and below 1: gravity leans by it.
    pub slope: f64,
    /// The drag of a coarse grain is that of the λ³ grains it stands for; true exactly if the grains are coarse.
    pub drag_by_volume: bool,
}

/// How strong the water flows.
#[derive(Clone, Debug, PartialEq)]
pub enum Flow {
    /// τ* of the largest grain, above zero.
    Shields(f64),
    /// u*, m/s, above zero.
    FrictionVelocity(f64),
    /// Rows of time in s from when the water begins, not negative and rising, and u* in m/s, not negative and not all zero.
    /// Straight between rows; the first and the last u* hold beyond them.
    OverTime(Vec<[f64; 2]>),
}

/// The mean flow over height.
#[derive(Clone, Debug, PartialEq)]
pub enum FlowProfile {
    /// The rough-wall law.
    Log {
        /// von Kármán's constant κ, above zero.
        karman: f64,
    },
    /// Rows of height in m, rising, and speed in m/s, not negative and not all zero, at the (highest) friction velocity
    /// of the flow. Straight between rows; the first and the last speed hold beyond them.
    Given(Vec<[f64; 2]>),
}

/// The fluctuations of the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turbulence {
    /// Mean flow only.
    Off,
    /// Drawn anew at each switch and held between two.
    Switched {
        /// Switches per second, Hz, above zero.
        frequency: f64,
        /// Depth h of the water, m, above zero: the fluctuations decay upwards as exp(−y/h).
        depth: f64,
        /// Seed of the draws.
        seed: u64,
    },
}

/// When the datum is found: the mean height of the uppermost grains of the bed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Datum {
    /// When the water begins, and at every switch of the turbulence.
    #[default]
    Renewed,
    /// Once, when the water begins.
    Frozen,
    /// It is this height, m.
    Given(f64),
}
