//! Springs and dashpots, a bed of grains, and the water over it.

/// The constants and readings of law `SpringDashpot`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDashpot {
    /// Where its constants come from.
    pub constants: SpringConstants,
    /// Poisson's ratio, which gives the tangential constants that are not given.
    pub poisson: f64,
    /// Coefficient of friction between grains.
    pub friction: f64,
    /// When the normal force ends.
    pub tension: Tension,
    /// How friction limits the tangential force.
    pub slip: Slip,
    /// How the normal spring is counted.
    pub normal_force: NormalForce,
}

/// Where the constants of law `SpringDashpot` come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpringConstants {
    /// From a time step that resolves them.
    FromTimeStep {
        /// The step they are made for, s; the run's own step may be another.
        step: f64,
        /// αtn, steps in a period.
        tn: f64,
        /// αcn, damping over the critical one.
        cn: f64,
        /// β, by which both are multiplied.
        beta: f64,
    },
    /// From the restitution of two grains.
    FromRestitution {
        /// kn, N/m.
        normal_stiffness: f64,
        /// In (0, 1].
        restitution: f64,
    },
    /// As they are.
    Given {
        /// kn, N/m.
        normal_stiffness: f64,
        /// ks, N/m; `None`: from Poisson's ratio.
        tangential_stiffness: Option<f64>,
        /// ηn, kg/s.
        normal_damping: f64,
        /// ηs, kg/s; `None`: from Poisson's ratio.
        tangential_damping: Option<f64>,
    },
}

/// When the normal force of a contact ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tension {
    /// It never pulls.
    #[default]
    NoPull,
    /// Only the spring decides; the dashpot may pull.
    AsPrinted,
}

/// How friction limits the tangential force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slip {
    /// Spring and dashpot together.
    #[default]
    Total,
    /// The spring alone.
    AsPrinted,
}

/// How the normal spring is counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NormalForce {
    /// From the overlap.
    #[default]
    Closed,
    /// Summed up step by step.
    Incremental,
}

/// A bed that falls together from a lattice on a fixed row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Layers above the fixed row, at least 1.
    pub layers: usize,
    /// Distance of the lattice over the diameter, in [1, 2].
    pub spacing: f64,
    /// Share of the lattice that is left empty, in [0, 0.5].
    pub vacancies: f64,
    /// Standard deviation of the heights of the fixed row over the diameter, in [0, 1].
    pub roughness: f64,
    /// Seed of heights, vacancies and shifts.
    pub seed: u64,
}

/// Water over a bed, flowing along +x.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// How strong it is.
    pub flow: Flow,
    /// When it begins to flow, s.
    pub begins: f64,
    /// ρ, kg/m³, below the grains' density.
    pub density: f64,
    /// CM.
    pub added_mass: f64,
    /// CD.
    pub drag: f64,
    /// The mean flow over height.
    pub profile: FlowProfile,
    /// The fluctuations.
    pub turbulence: Turbulence,
    /// ε0 of the shelter, in [0, 1]; 1 is none.
    pub shelter: f64,
    /// When y = 0 is found.
    pub datum: Datum,
    /// Contacts from which on a grain belongs to the bed.
    pub bed_contacts: u32,
    /// Tangent of the downward slope of the bed along +x, |slope| < 1: gravity leans by it.
    pub slope: f64,
    /// The drag of a coarse grain is that of the grains it stands for: named exactly if the grains are coarse.
    pub drag_by_volume: bool,
}

/// How strong the water is.
#[derive(Clone, Debug, PartialEq)]
pub enum Flow {
    /// τ* of the largest grain.
    Shields(f64),
    /// u*, m/s.
    FrictionVelocity(f64),
    /// u* in m/s over the time since it began in s.
    OverTime(Vec<[f64; 2]>),
}

/// The mean flow over the height above the datum.
#[derive(Clone, Debug, PartialEq)]
pub enum FlowProfile {
    /// The rough-wall law with this κ.
    Log {
        /// von Kármán's constant.
        karman: f64,
    },
    /// Rows of height in m and speed in m/s; it scales with u* if u* changes.
    Given(Vec<[f64; 2]>),
}

/// The fluctuations of the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turbulence {
    /// Mean flow only.
    Off,
    /// Drawn anew so many times a second.
    Switched {
        /// Hz.
        frequency: f64,
        /// Depth of the water, m.
        depth: f64,
        /// Seed of the draws.
        seed: u64,
    },
}

/// When the datum y = 0 is found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Datum {
    /// At every switch of the turbulence.
    #[default]
    Renewed,
    /// Once, when the water begins.
    Frozen,
    /// It is this height, m.
    Given(f64),
}

/// How the transport of a bed is averaged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedMeasure {
    /// Share of the flow's time that is dropped first, in [0, 1).
    pub skip: f64,
}
