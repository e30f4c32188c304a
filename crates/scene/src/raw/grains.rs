//! The raw grains and their laws.

use serde::Deserialize;

use crate::quantity::{
    Damping, Density, Energy, Length, Mass, Number, Pressure, Quantity, Stiffness, Time, Whole,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "grains")]
pub(crate) struct RawGrains {
    pub diameter: Quantity<Length>,
    pub density: Option<Quantity<Density>>,
    pub mass: Option<Quantity<Mass>>,
    pub sizes: Option<Vec<RawSize>>,
    pub law: RawLaw,
    pub soften: Option<Number>,
    pub softened_damping: Option<RawSoftenedDamping>,
    pub coarse: Option<Whole>,
    pub coarse_rule: Option<RawCoarseRule>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "size")]
pub(crate) struct RawSize {
    pub diameter: Quantity<Length>,
    pub share: Number,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "law")]
pub(crate) enum RawLaw {
    Repulsion {
        stiffness: RawStiffness,
        damping: RawDamping,
    },
    SpringDashpot {
        constants: RawConstants,
        poisson: Option<Number>,
        friction: Number,
        tension: Option<RawTension>,
        slip: Option<RawSlip>,
        normal_force: Option<RawNormalForce>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "stiffness")]
pub(crate) enum RawStiffness {
    YoungModulus(Quantity<Pressure>),
    Energy {
        epsilon: Quantity<Energy>,
        sigma: Quantity<Length>,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "damping")]
pub(crate) enum RawDamping {
    Equal(Quantity<Damping>),
    Parts {
        normal: Quantity<Damping>,
        tangential: Quantity<Damping>,
    },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "softened_damping")]
pub(crate) enum RawSoftenedDamping {
    Kept,
    Scaled,
    NormalScaled,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "coarse_rule")]
pub(crate) enum RawCoarseRule {
    Renormalised,
    SakaiKoshizuka,
    RadlRestitution,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "constants")]
pub(crate) enum RawConstants {
    FromTimeStep {
        step: Quantity<Time>,
        tn: Number,
        cn: Number,
        beta: Option<Number>,
    },
    Given {
        normal_stiffness: Quantity<Stiffness>,
        normal_damping: Quantity<Damping>,
        tangential_stiffness: Option<Quantity<Stiffness>>,
        tangential_damping: Option<Quantity<Damping>>,
    },
    FromRestitution {
        normal_stiffness: Quantity<Stiffness>,
        restitution: Number,
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
