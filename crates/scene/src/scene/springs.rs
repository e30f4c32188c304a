//! Law `SpringDashpot`: where its constants come from, and how its words are read.

/// The constants of law `SpringDashpot` and its readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDashpot {
    /// Where the constants come from.
    pub constants: SpringConstants,
    /// Poisson's ratio, in [0, 0.5]: the tangential constants that are not given follow from it.
    pub poisson: f64,
    /// Coefficient of friction between grains, not negative; also of a wall that has none of its own.
    pub friction: f64,
    /// When the normal force ends.
    pub tension: Tension,
    /// How friction limits the tangential force.
    pub slip: Slip,
    /// How the normal spring is counted.
    pub normal_force: NormalForce,
}

/// Where the constants of law `SpringDashpot` come from, at coarse level 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpringConstants {
    /// From a time step that resolves them: kn = 2π² m/(β αtn Δt)², ηn = αcn 2√(m kn) at β = 1.
    FromTimeStep {
        /// Δt they are made for, s, above zero; the step of the run may be another.
        step: f64,
        /// αtn, steps per period, above zero.
        tn: f64,
        /// αcn, the damping over the critical one, not negative.
        cn: f64,
        /// β, above zero: αtn and αcn multiplied together, so the stiffness is over β² and the damping as it was.
        beta: f64,
    },
    /// As they are.
    Given {
        /// kn, N/m, above zero.
        normal_stiffness: f64,
        /// ηn, kg/s, not negative.
        normal_damping: f64,
        /// ks, N/m, not negative; `None`: kn/(2(1 + ν)).
        tangential_stiffness: Option<f64>,
        /// ηs, kg/s, not negative; `None`: ηn/√(2(1 + ν)).
        tangential_damping: Option<f64>,
    },
    /// From the restitution of two grains that collide head-on.
    FromRestitution {
        /// kn, N/m, above zero.
        normal_stiffness: f64,
        /// In (0, 1].
        restitution: f64,
    },
}

/// When the normal force of a contact ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tension {
    /// The force never pulls.
    #[default]
    NoPull,
    /// Only the spring decides: the dashpot pulls while grains part.
    AsPrinted,
}

/// How friction limits the tangential force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slip {
    /// Spring and dashpot are limited together.
    #[default]
    Total,
    /// The spring alone is limited; while it is, the dashpot is silent.
    AsPrinted,
}

/// How the normal spring is counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NormalForce {
    /// From the overlap.
    #[default]
    Closed,
    /// Summed up over the steps.
    Incremental,
}
