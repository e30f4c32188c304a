//! The raw grains and their laws.

use serde::Deserialize;

use crate::quantity::{
    Damping, Density, Energy, Length, Mass, Number, Pair, Pressure, Quantity, Stiffness, Time,
    Whole,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "grains")]
pub(crate) struct RawGrains {
    pub diameter: Quantity<Length>,
    pub density: Option<Quantity<Density>>,
    pub mass: Option<Quantity<Mass>>,
    pub material: Option<String>,
    pub populations: Option<Vec<RawPopulation>>,
    pub law: RawLaw,
    pub materials: Option<Vec<RawMaterial>>,
    pub pairs: Option<Vec<RawPairOf>>,
    pub soften: Option<Number>,
    pub softened_damping: Option<RawSoftenedDamping>,
    pub coarse: Option<Whole>,
    pub coarse_rule: Option<RawCoarseRule>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "population")]
pub(crate) struct RawPopulation {
    pub diameter: Quantity<Length>,
    pub share: Number,
    pub density: Option<Quantity<Density>>,
    pub material: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "material")]
pub(crate) struct RawMaterial {
    pub name: String,
    pub law: RawLaw,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "pair")]
pub(crate) struct RawPairOf {
    pub of: Pair<String>,
    pub restitution: Option<Number>,
    pub friction: Option<Number>,
    pub rolling_friction: Option<Number>,
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
    HertzMindlin {
        young: Quantity<Pressure>,
        poisson: Number,
        restitution: Number,
        friction: Number,
        rolling: Option<RawRolling>,
    },
}

impl RawLaw {
    /// Its name in a scene.
    pub fn name(&self) -> &'static str {
        match self {
            RawLaw::Repulsion { .. } => "Repulsion",
            RawLaw::SpringDashpot { .. } => "SpringDashpot",
            RawLaw::HertzMindlin { .. } => "HertzMindlin",
        }
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "rolling")]
pub(crate) struct RawRolling {
    pub friction: Number,
    pub damping: Option<Number>,
    pub by: Option<RawResistance>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "by")]
pub(crate) enum RawResistance {
    ElasticPlastic,
    Constant,
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
