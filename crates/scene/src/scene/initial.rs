//! Where the grains are at the start.

use std::f64::consts::PI;
use std::path::PathBuf;

use glam::DVec3;

use super::{MeshFile, Region, Space};

/// Where the grains are at the start.
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// Read from this file (an absolute path), see [`GrainFile`](crate::GrainFile).
    File(PathBuf),
    /// Placed at random in a box or in a mesh.
    Fill(Fill),
    /// Laid in layers on a fixed row.
    Bed(Bed),
    /// Listed in the scene.
    Grains(Vec<StartingGrain>),
}

/// Room to be filled with grains at random: a box, the inside of a mesh, or what both have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Fill {
    /// The box; `None` only with a mesh: the box around it.
    pub region: Option<Region>,
    /// Grains are only placed inside this closed mesh; `None`: anywhere in the box.
    pub within: Option<MeshFile>,
    /// Share of that room (in the plane: of its area) taken by grains.
    pub solid_fraction: f64,
    /// Seed of the random places.
    pub seed: u64,
}

impl Fill {
    /// Number of grains of this diameter (m) that the fill asks for in its box, see [`count_in`](Fill::count_in).
    /// Without a box it is 0: the room inside the mesh is known only once the mesh is read.
    pub fn count(&self, diameter: f64, space: Space) -> usize {
        let size = self
            .region
            .map_or(DVec3::ZERO, |region| region.max - region.min);
        let room = match space {
            Space::Space => size.x * size.y * size.z,
            Space::Plane => size.x * size.z,
        };
        self.count_in(room, diameter, space)
    }

    /// Number of grains of this diameter (m) that the fill asks for in so much room (m³, in the plane m²),
    /// rounded to the nearest; huge rooms saturate.
    pub fn count_in(&self, room: f64, diameter: f64, space: Space) -> usize {
        let grain = match space {
            Space::Space => PI / 6.0 * diameter.powi(3),
            Space::Plane => PI / 4.0 * diameter.powi(2),
        };
        (self.solid_fraction * (room / grain)).round() as usize
    }
}

/// A grain at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartingGrain {
    /// Its centre, m.
    pub at: DVec3,
    /// Its velocity, m/s.
    pub velocity: DVec3,
    /// Number of its population, 0 if there is but one.
    pub population: usize,
}

/// A bed that falls together from a lattice above a fixed row; it fills the periodic x, and in space the periodic y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Layers above the fixed row, 1 to 10 000.
    pub layers: usize,
    /// Distance of two places of the lattice over the diameter, in [1, 2].
    pub spacing: f64,
    /// Share of the places that is left empty, in [0, 0.5].
    pub vacancies: f64,
    /// Standard deviation of the heights of the fixed row over the diameter, in [0, 1].
    pub roughness: f64,
    /// Seed of the heights and of the empty places.
    pub seed: u64,
}
