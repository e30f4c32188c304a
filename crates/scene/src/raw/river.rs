//! The raw law of springs and dashpots, the bed, the water over it and its measure.

use serde::Deserialize;

use crate::quantity::{
    Damping, Density, Frequency, Length, Number, Quantity, Stiffness, Time, Velocity, Whole,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "constants")]
pub(crate) enum RawSpringConstants {
    FromTimeStep {
        step: Quantity<Time>,
        tn: Number,
        cn: Number,
        beta: Option<Number>,
    },
    FromRestitution {
        normal_stiffness: Quantity<Stiffness>,
        restitution: Number,
    },
    Given {
        normal_stiffness: Quantity<Stiffness>,
        tangential_stiffness: Option<Quantity<Stiffness>>,
        normal_damping: Quantity<Damping>,
        tangential_damping: Option<Quantity<Damping>>,
    },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "tension")]
pub(crate) enum RawTension {
    NoPull,
    AsPrinted,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "slip")]
pub(crate) enum RawSlip {
    Total,
    AsPrinted,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "normal_force")]
pub(crate) enum RawNormalForce {
    Closed,
    Incremental,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "bed")]
pub(crate) struct RawBed {
    pub layers: Whole,
    pub spacing: Option<Number>,
    pub vacancies: Option<Number>,
    pub roughness: Option<Number>,
    pub seed: Option<Whole>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "water")]
pub(crate) struct RawWater {
    pub shields: Option<Number>,
    pub friction_velocity: Option<Quantity<Velocity>>,
    pub friction_velocity_over_time: Option<Vec<(Quantity<Time>, Quantity<Velocity>)>>,
    pub begins: Option<Quantity<Time>>,
    pub density: Option<Quantity<Density>>,
    pub added_mass: Option<Number>,
    pub drag: Option<Number>,
    pub karman: Option<Number>,
    pub profile: Option<Vec<(Quantity<Length>, Quantity<Velocity>)>>,
    pub turbulence: Option<RawTurbulence>,
    pub shelter: Option<Number>,
    pub datum: Option<RawDatum>,
    pub bed_contacts: Option<Whole>,
    pub slope: Option<Number>,
    pub coarse_drag: Option<RawCoarseDrag>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "turbulence")]
pub(crate) enum RawTurbulence {
    Off,
    Switched {
        frequency: Option<Quantity<Frequency>>,
        depth: Option<Quantity<Length>>,
        seed: Option<Whole>,
    },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "datum")]
pub(crate) enum RawDatum {
    Renewed,
    Frozen,
    Given(Quantity<Length>),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "coarse_drag")]
pub(crate) enum RawCoarseDrag {
    ByVolume,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "bed")]
pub(crate) struct RawBedMeasure {
    pub skip: Option<Number>,
}
