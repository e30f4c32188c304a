//! The raw scene: the text field by field, as serde reads it.
//!
//! The names of the types are what `ron` puts into its messages.

mod flow;
mod grains;
mod wall;
mod water;

use serde::Deserialize;

pub(crate) use flow::{
    RawBedMeasure, RawConveying, RawDischarge, RawFate, RawInlet, RawMeasures, RawOpening,
    RawOutlet,
};
pub(crate) use grains::{
    RawCoarseRule, RawConstants, RawDamping, RawGrains, RawLaw, RawMaterial, RawNormalForce,
    RawPairOf, RawPopulation, RawResistance, RawRolling, RawSlip, RawSoftenedDamping, RawStiffness,
    RawTension,
};
pub(crate) use wall::{
    MESH_UNITS, MeshUnit, RawBegin, RawHand, RawMeshFile, RawMotion, RawRemoval, RawShape,
    RawShift, RawSurface, RawThin, RawTouchesAt, RawTurn, RawWall,
};
pub(crate) use water::{RawDatum, RawTurbulence, RawWater};

use crate::quantity::{Acceleration, Length, Number, Quantity, Time, Triple, Velocity, Whole};

/// Fields of the whole scene that no inner block has: they give an unclosed bracket away.
pub(crate) const TOP: &[&str] = &[
    "title",
    "space",
    "gravity",
    "domain",
    "walls",
    "initial",
    "outlets",
    "inlets",
    "water",
    "still",
    "time",
    "neighbours",
    "measures",
    "output",
];

/// Groups of fields of which exactly one is given: the path of the block, and the fields.
pub(crate) const ONE_OF: &[(&str, &[&str])] = &[
    ("grains", &["density", "mass"]),
    ("initial", &["file", "fill", "grains", "bed"]),
    ("time", &["until", "steps"]),
    (
        "water",
        &[
            "shields",
            "friction_velocity",
            "friction_velocity_over_time",
        ],
    ),
];

/// The choices of each field that has some, for the message when something else stands there.
pub(crate) const CHOICES: &[(&str, &[&str])] = &[
    ("space", &["Space", "Plane"]),
    ("law", &["Repulsion", "SpringDashpot", "HertzMindlin"]),
    ("by", &["ElasticPlastic", "Constant"]),
    ("constants", &["FromTimeStep", "Given", "FromRestitution"]),
    ("tension", &["NoPull", "AsPrinted"]),
    ("slip", &["Total", "AsPrinted"]),
    ("normal_force", &["Closed", "Incremental"]),
    ("stiffness", &["YoungModulus", "Energy"]),
    ("damping", &["Equal", "Parts"]),
    ("softened_damping", &["Kept", "Scaled", "NormalScaled"]),
    (
        "coarse_rule",
        &["Renormalised", "SakaiKoshizuka", "RadlRestitution"],
    ),
    ("x", &["Open", "Periodic"]),
    ("y", &["Open", "Periodic"]),
    ("z", &["Open", "Periodic"]),
    (
        "shape",
        &[
            "HalfSpace",
            "Ball",
            "Cuboid",
            "Cylinder",
            "Tube",
            "Cone",
            "Screw",
            "Mesh",
        ],
    ),
    ("hand", &["Right", "Left"]),
    ("surface", &["Grid", "Exact", "Grains"]),
    ("thin", &["Leave", "OneLayer"]),
    ("touches_at", &["Surface", "Centre"]),
    ("removed", &["Never", "WhenStill", "At"]),
    ("begins", &["WhenStill", "At"]),
    ("then", &["Delete", "Recycle"]),
    ("opening", &["Circle", "Slot"]),
    ("turbulence", &["Off", "Switched"]),
    ("datum", &["Renewed", "Frozen", "Given"]),
    ("coarse_drag", &["ByVolume"]),
    ("step", &["Automatic", "PerPeriod", "Seconds", "Exactly"]),
    (
        "integrator",
        &[
            "ExplicitEuler",
            "SymplecticEuler",
            "VerletOld",
            "VerletAveraged",
            "DashpotImplicit",
        ],
    ),
];

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Scene")]
pub(crate) struct RawScene {
    pub title: String,
    pub space: Option<RawSpace>,
    pub gravity: Option<Quantity<Acceleration>>,
    pub grains: RawGrains,
    pub domain: Option<RawDomain>,
    pub walls: Option<Vec<RawWall>>,
    pub initial: RawInitial,
    pub outlets: Option<Vec<RawOutlet>>,
    pub inlets: Option<Vec<RawInlet>>,
    pub water: Option<RawWater>,
    pub still: Option<RawStill>,
    pub time: RawTime,
    pub neighbours: Option<RawNeighbours>,
    pub measures: Option<RawMeasures>,
    pub output: Option<RawOutput>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "Space")]
pub(crate) enum RawSpace {
    Space,
    Plane,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "domain")]
pub(crate) struct RawDomain {
    pub x: Option<RawAxis>,
    pub y: Option<RawAxis>,
    pub z: Option<RawAxis>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "axis")]
pub(crate) enum RawAxis {
    Open,
    Periodic(Quantity<Length>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "initial")]
pub(crate) struct RawInitial {
    pub file: Option<String>,
    pub fill: Option<RawFill>,
    pub grains: Option<Vec<RawGrain>>,
    pub bed: Option<RawBed>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "fill")]
pub(crate) struct RawFill {
    pub region: Option<RawRegion>,
    pub within: Option<RawMeshFile>,
    pub solid_fraction: Number,
    pub seed: Whole,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "region")]
pub(crate) struct RawRegion {
    pub min: Triple<Quantity<Length>>,
    pub max: Triple<Quantity<Length>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "grain")]
pub(crate) struct RawGrain {
    pub at: Triple<Quantity<Length>>,
    pub velocity: Option<Triple<Quantity<Velocity>>>,
    pub population: Option<Whole>,
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
#[serde(deny_unknown_fields, rename = "still")]
pub(crate) struct RawStill {
    pub kinetic_energy: Number,
    pub for_at_least: Quantity<Time>,
    pub at_most: Quantity<Time>,
    pub damping: Option<Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "time")]
pub(crate) struct RawTime {
    pub step: Option<RawStep>,
    pub integrator: Option<RawIntegrator>,
    pub until: Option<Quantity<Time>>,
    pub steps: Option<Whole>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "step")]
pub(crate) enum RawStep {
    Automatic,
    PerPeriod(Number),
    Seconds(Quantity<Time>),
    Exactly(Quantity<Time>),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "integrator")]
pub(crate) enum RawIntegrator {
    ExplicitEuler,
    SymplecticEuler,
    VerletOld,
    VerletAveraged { sweeps: Option<Whole> },
    DashpotImplicit { sweeps: Option<Whole> },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "neighbours")]
pub(crate) struct RawNeighbours {
    pub skin: Option<Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "output")]
pub(crate) struct RawOutput {
    pub every: Option<Quantity<Time>>,
    pub frames: Option<bool>,
    pub frames_every: Option<Quantity<Time>>,
    pub energies: Option<bool>,
    pub animation: Option<bool>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names that serde accepts.
    fn accepted<T: serde::de::DeserializeOwned>() -> &'static [&'static str] {
        match ron::from_str::<T>("Nonsense").map_err(|error| error.code) {
            Err(ron::Error::NoSuchEnumVariant { expected, .. }) => expected,
            _ => &[],
        }
    }

    #[test]
    fn the_choices_are_those_that_are_read() {
        let read = [
            accepted::<RawSpace>(),
            accepted::<RawLaw>(),
            accepted::<RawResistance>(),
            accepted::<RawConstants>(),
            accepted::<RawTension>(),
            accepted::<RawSlip>(),
            accepted::<RawNormalForce>(),
            accepted::<RawStiffness>(),
            accepted::<RawDamping>(),
            accepted::<RawSoftenedDamping>(),
            accepted::<RawCoarseRule>(),
            accepted::<RawAxis>(),
            accepted::<RawAxis>(),
            accepted::<RawAxis>(),
            accepted::<RawShape>(),
            accepted::<RawHand>(),
            accepted::<RawSurface>(),
            accepted::<RawThin>(),
            accepted::<RawTouchesAt>(),
            accepted::<RawRemoval>(),
            accepted::<RawBegin>(),
            accepted::<RawFate>(),
            accepted::<RawOpening>(),
            accepted::<RawTurbulence>(),
            accepted::<RawDatum>(),
            accepted::<water::RawCoarseDrag>(),
            accepted::<RawStep>(),
            accepted::<RawIntegrator>(),
        ];
        assert_eq!(
            CHOICES
                .iter()
                .map(|(_, choices)| *choices)
                .collect::<Vec<_>>(),
            read
        );
    }
}
