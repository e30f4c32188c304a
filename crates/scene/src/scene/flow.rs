//! Grains that come and go, and what is measured of their flow.

use super::{Axis, Domain, Wall};
use glam::DVec3;

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Lower corner, m.
    pub min: DVec3,
    /// Upper corner, m, above the lower one on every axis; in the plane the y of both is zero.
    pub max: DVec3,
}

impl Region {
    /// Whether two boxes have room in common; the y of a plane scene, zero everywhere, keeps none apart.
    pub fn overlaps(&self, other: &Region) -> bool {
        let apart = |a: f64, b: f64, c: f64, d: f64| (a >= d || c >= b) && (a < b || c < d);
        (0..3).all(|i| !apart(self.min[i], self.max[i], other.min[i], other.max[i]))
    }
}

/// Where grains leave.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlet {
    /// Unique among outlets and inlets.
    pub name: String,
    /// A grain whose centre is in here leaves, and is counted.
    pub region: Region,
    /// What becomes of it.
    pub then: Fate,
}

/// What becomes of a grain that has reached an outlet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Fate {
    /// It is gone.
    #[default]
    Delete,
    /// It is put back at a random place.
    Recycle {
        /// In this box.
        into: Region,
        /// Seed of the random places.
        seed: u64,
    },
}

/// Where grains come in, from the start on.
#[derive(Clone, Debug, PartialEq)]
pub struct Inlet {
    /// Unique among outlets and inlets.
    pub name: String,
    /// Kept filled by grains that are added at random places where there is room.
    pub region: Region,
    /// Share of the box (in the plane: of its area) that is kept filled.
    pub solid_fraction: f64,
    /// Seed of the random places.
    pub seed: u64,
}

/// Measures that a scene asks for beside those that are always taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measures {
    /// How a screw conveys.
    pub conveying: Option<Conveying>,
    /// How the transport of a bed is measured; present exactly when there is water.
    pub bed: Option<BedMeasure>,
    /// How a hopper empties.
    pub discharge: Option<Discharge>,
}

/// What the measure of a hopper needs to know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discharge {
    /// The place in [`Scene::outlets`](super::Scene::outlets) of the outlet under the opening.
    pub outlet: usize,
    /// The opening.
    pub opening: Opening,
    /// A box over the opening inside the bin, which counts as full at the start of the flow.
    pub bin: Region,
}

/// The opening of a hopper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opening {
    /// A circle of this diameter, m, above zero.
    Circle(f64),
    /// A slot of this width, m, above zero, as deep as the scene: y is periodic, or the scene is plane.
    Slot(f64),
}

/// How the transport of a bed is averaged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedMeasure {
    /// Share of the time since the water began that is dropped before means are taken, in [0, 1).
    pub skip: f64,
}

/// What the measures of a screw conveyor need to know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conveying {
    /// The place in [`Scene::walls`](super::Scene::walls) of the screw; that wall turns.
    pub screw: usize,
    /// Pitch of its flight, m.
    pub pitch: f64,
    /// Diameter over its flight, m.
    pub outer: f64,
    /// Diameter of its shaft, m, not negative, below the outer one.
    pub shaft: f64,
    /// The measured stretch, from the first value to the second, m along the axis of its turn from the turn's point.
    pub section: [f64; 2],
    /// Inner diameter of the casing, m, above the outer diameter of the screw.
    pub casing: f64,
    /// Where the bulk density before the screw is measured; a stretch of tube has no such place.
    pub hopper: Option<Region>,
    /// The place in [`Scene::outlets`](super::Scene::outlets) of the outlet that the screw feeds, if it feeds one.
    pub outlet: Option<usize>,
}

impl Conveying {
    /// The length after which the scene repeats along the axis of the screw, m, if it does.
    pub fn period(&self, screw: &Wall, domain: &Domain) -> Option<f64> {
        let axis = screw.motion.as_ref()?.turn?.axis;
        let along = |x: f64| x.abs() > 1.0 - 1e-9;
        [(axis.x, domain.x), (axis.y, domain.y), (axis.z, domain.z)]
            .into_iter()
            .find_map(|(share, axis)| match axis {
                Axis::Periodic(length) if along(share) => Some(length),
                _ => None,
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_overlap_in_their_room_not_at_their_sides() {
        let region = |min: [f64; 3], max: [f64; 3]| Region {
            min: min.into(),
            max: max.into(),
        };
        let one = region([0.0; 3], [1.0; 3]);
        assert!(one.overlaps(&one));
        assert!(one.overlaps(&region([0.5, -1e9, 0.2], [9.0, 1e9, 0.3])));
        assert!(!one.overlaps(&region([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])));
        assert!(!one.overlaps(&region([0.0, 0.0, -1.0], [1.0, 1.0, -0.5])));
        let flat = region([0.0; 3], [1.0, 0.0, 1.0]);
        assert!(flat.overlaps(&flat));
        assert!(!flat.overlaps(&region([1.0, 0.0, 0.0], [2.0, 0.0, 1.0])));
    }
}
