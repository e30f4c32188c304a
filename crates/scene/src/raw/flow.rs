//! The raw outlets, inlets and measures.

use serde::Deserialize;

use super::RawRegion;
use crate::quantity::{Length, Number, Pair, Quantity, Triple, Whole};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "outlet")]
pub(crate) struct RawOutlet {
    pub name: String,
    pub region: RawRegion,
    pub then: Option<RawFate>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "then")]
pub(crate) enum RawFate {
    Delete,
    Recycle {
        min: Triple<Quantity<Length>>,
        max: Triple<Quantity<Length>>,
        seed: Option<Whole>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "inlet")]
pub(crate) struct RawInlet {
    pub name: String,
    pub region: RawRegion,
    pub solid_fraction: Number,
    pub seed: Whole,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "measures")]
pub(crate) struct RawMeasures {
    pub conveying: Option<RawConveying>,
    pub bed: Option<RawBedMeasure>,
    pub discharge: Option<RawDischarge>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "discharge")]
pub(crate) struct RawDischarge {
    pub outlet: String,
    pub opening: RawOpening,
    pub bin: RawRegion,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "opening")]
pub(crate) enum RawOpening {
    Circle(Quantity<Length>),
    Slot(Quantity<Length>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "conveying")]
pub(crate) struct RawConveying {
    pub screw: String,
    pub pitch: Quantity<Length>,
    pub outer: Quantity<Length>,
    pub shaft: Quantity<Length>,
    pub section: Pair<Quantity<Length>>,
    pub casing: Quantity<Length>,
    pub hopper: Option<RawRegion>,
    pub outlet: Option<String>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "bed")]
pub(crate) struct RawBedMeasure {
    pub skip: Option<Number>,
}
