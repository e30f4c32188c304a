//! The raw water.

use serde::Deserialize;

use crate::quantity::{Density, Frequency, Length, Number, Quantity, Row, Time, Velocity, Whole};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "water")]
pub(crate) struct RawWater {
    pub shields: Option<Number>,
    pub friction_velocity: Option<Quantity<Velocity>>,
    pub friction_velocity_over_time: Option<Vec<Row<Quantity<Time>, Quantity<Velocity>>>>,
    pub begins: Option<Quantity<Time>>,
    pub density: Option<Quantity<Density>>,
    pub added_mass: Option<Number>,
    pub drag: Option<Number>,
    pub karman: Option<Number>,
    pub profile: Option<Vec<Row<Quantity<Length>, Quantity<Velocity>>>>,
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
