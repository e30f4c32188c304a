//! The raw walls: shapes and motions.

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use crate::quantity::{
    AngularVelocity, Frequency, Length, Number, Pair, Quantity, Time, Triple, Velocity, two_lines,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "wall")]
pub(crate) struct RawWall {
    pub name: String,
    pub shape: RawShape,
    pub material: Option<String>,
    pub restitution: Option<Number>,
    pub friction: Option<Number>,
    pub touches_at: Option<RawTouchesAt>,
    pub removed: Option<RawRemoval>,
    pub motion: Option<RawMotion>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "shape")]
pub(crate) enum RawShape {
    HalfSpace {
        point: Triple<Quantity<Length>>,
        outward: Triple<Number>,
    },
    Ball {
        centre: Triple<Quantity<Length>>,
        radius: Quantity<Length>,
    },
    Cuboid {
        min: Triple<Quantity<Length>>,
        max: Triple<Quantity<Length>>,
    },
    Cylinder {
        from: Triple<Quantity<Length>>,
        to: Triple<Quantity<Length>>,
        radius: Quantity<Length>,
    },
    Tube {
        from: Triple<Quantity<Length>>,
        to: Triple<Quantity<Length>>,
        inner: Quantity<Length>,
        outer: Quantity<Length>,
    },
    Cone {
        from: Triple<Quantity<Length>>,
        to: Triple<Quantity<Length>>,
        radii: Pair<Quantity<Length>>,
        thickness: Quantity<Length>,
    },
    Screw {
        from: Triple<Quantity<Length>>,
        to: Triple<Quantity<Length>>,
        shaft: Quantity<Length>,
        outer: Quantity<Length>,
        pitch: Quantity<Length>,
        thickness: Quantity<Length>,
        hand: Option<RawHand>,
    },
    Mesh {
        file: String,
        unit: MeshUnit,
        surface: Option<RawSurface>,
        thickness: Option<Quantity<Length>>,
    },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "hand")]
pub(crate) enum RawHand {
    Right,
    Left,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename = "surface")]
pub(crate) enum RawSurface {
    Grid {
        cell: Option<Quantity<Length>>,
        exact_edges: Option<bool>,
    },
    Exact,
    Grains {
        radius: Quantity<Length>,
        thin: Option<RawThin>,
    },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "thin")]
pub(crate) enum RawThin {
    Leave,
    OneLayer,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "within")]
pub(crate) struct RawMeshFile {
    pub file: String,
    pub unit: MeshUnit,
}

/// The unit of a mesh's coordinates, in metres; files of triangles do not say theirs.
#[derive(Clone, Copy)]
pub(crate) struct MeshUnit(pub f64);

/// The units of meshes and their metres.
pub(crate) const MESH_UNITS: &[(&str, f64)] =
    &[("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("inch", 0.0254)];

impl<'de> Deserialize<'de> for MeshUnit {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let text = String::deserialize(reader)?;
        let unit = MESH_UNITS.iter().find(|(symbol, _)| *symbol == text.trim());
        unit.map(|(_, metres)| MeshUnit(*metres)).ok_or_else(|| {
            let known: Vec<_> = MESH_UNITS.iter().map(|(symbol, _)| *symbol).collect();
            R::Error::custom(two_lines(
                format!("“{text}” is no unit of a mesh"),
                format!(
                    "write the unit of its coordinates: one of {}",
                    known.join(", ")
                ),
            ))
        })
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "touches_at")]
pub(crate) enum RawTouchesAt {
    Surface,
    Centre,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "removed")]
pub(crate) enum RawRemoval {
    Never,
    WhenStill,
    At(Quantity<Time>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "motion")]
pub(crate) struct RawMotion {
    pub turn: Option<RawTurn>,
    pub shifts: Option<Vec<RawShift>>,
    pub begins: Option<RawBegin>,
    pub lasts: Option<Quantity<Time>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "turn")]
pub(crate) struct RawTurn {
    pub point: Triple<Quantity<Length>>,
    pub axis: Triple<Number>,
    pub rate: Quantity<AngularVelocity>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "shift")]
pub(crate) struct RawShift {
    pub direction: Triple<Number>,
    pub speed: Option<Quantity<Velocity>>,
    pub amplitude: Option<Quantity<Length>>,
    pub frequency: Option<Quantity<Frequency>>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename = "begins")]
pub(crate) enum RawBegin {
    WhenStill,
    At(Quantity<Time>),
}
