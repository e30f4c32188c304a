//! A mesh as a grid of distances: the fast surface, a few nanoseconds per grain.

mod build;
mod cache;
mod error;
mod far;
mod nodes;
mod query;
mod sign;
#[cfg(test)]
mod tests;

pub use error::GridError;
pub(crate) use far::squared_cells;
pub(crate) use nodes::Nodes;

use crate::exact::ExactMesh;
use crate::mesh::Mesh;
use glam::DVec3;

/// How a distance grid is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridOptions {
    /// Edge of a cell in m. [`Report::cell_advice`](crate::mesh::Report::cell_advice) suggests a quarter of the thinnest part.
    pub cell: f64,
    /// Distance in m up to which the surface is resolved on both sides; further nodes hold a bound.
    /// At least the reach of the grains and two cells.
    pub band: f64,
    /// Makes the mesh a two-sided wall of this thickness in m, with no inside: distance = |d| − thickness/2.
    /// At least four cells.
    pub thickness: Option<f64>,
    /// Most bytes that the grid may take; building takes about three times as much for a while.
    pub most_bytes: u64,
    /// Asks the mesh itself for grains in contact, instead of the interpolant: exact at edges, some thirty times slower.
    pub exact_edges: bool,
}

impl GridOptions {
    /// A body, at most 1 GiB, interpolated.
    pub fn new(cell: f64, band: f64) -> Self {
        Self {
            cell,
            band,
            thickness: None,
            most_bytes: 1 << 30,
            exact_edges: false,
        }
    }
}

/// Signed distances from a mesh at the nodes of a regular grid around it, interpolated trilinearly.
///
/// value(x) = Σ over the eight corners of the cell of w dᵢ, positive outside; normal = ∇value/|∇value|.
/// Error: up to h²·κ/4 or so by a smooth surface (h the cell, κ the larger curvature in 1/m), about h/2 at
/// sharp edges and corners, which the interpolant rounds off, and 0.7 h along the middle of a thin body
/// (measured on a box, a screw and a ring; h√3/2 is never passed). Valid within the band; further away a value
/// is a bound, not above the true distance. Nodes are stored as f32 (relative 6e-8), all else is f64.
/// Inside overlapping shells the distance is that of the nearest face, hidden ones included.
#[derive(Clone, Debug)]
pub struct DistanceGrid {
    nodes: Nodes,
    values: Vec<f32>,
    options: GridOptions,
    mesh: Mesh,
    /// The box around the body or wall.
    body_box: [DVec3; 2],
    /// There if `exact_edges` is asked for.
    exact: Option<ExactMesh>,
}

impl DistanceGrid {
    /// Puts the parts together; what follows from them is made here.
    fn from_parts(
        nodes: Nodes,
        values: Vec<f32>,
        options: GridOptions,
        mesh: Mesh,
    ) -> Result<Self, GridError> {
        let [low, high] = mesh.bounds();
        let half = DVec3::splat(0.5 * options.thickness.unwrap_or(0.0));
        let exact = match (options.exact_edges, options.thickness) {
            (false, _) => None,
            (true, None) => Some(ExactMesh::body(&mesh)?),
            (true, Some(thickness)) => Some(ExactMesh::wall(&mesh, thickness)?),
        };
        Ok(Self {
            nodes,
            values,
            options,
            body_box: [low - half, high + half],
            mesh,
            exact,
        })
    }
}
