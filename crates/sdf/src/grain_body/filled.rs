//! The mesh as the lattice asks it: one place per point, bounds that cost nothing.

use crate::exact::ExactMesh;
use crate::grid::{DistanceGrid, GridError};
use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Space, Surface};

/// Cells of the grid of bounds along the longest side of the mesh.
const CELLS: f64 = 250.0;

/// A mesh to be filled. The lattice asks mostly where nothing is near, so a grid answers there.
pub(super) struct Filled<'a> {
    exact: &'a ExactMesh,
    bounds: DistanceGrid,
}

impl<'a> Filled<'a> {
    pub fn new(exact: &'a ExactMesh, thickness: Option<f64>) -> Result<Self, GridError> {
        let bounds = DistanceGrid::coarse(exact.mesh(), thickness, CELLS)?;
        Ok(Self { exact, bounds })
    }

    /// The nearest place, if the point is inside or that place is within `reach`.
    fn nearest(&self, x: DVec3, reach: f64) -> Option<(f64, DVec3, u32)> {
        let bound = self.bounds.lower_bound(x);
        if bound >= reach {
            return None;
        }
        let found = self.exact.closest(x, reach.max(0.0));
        let found = match found {
            None if bound < 0.0 => self.exact.closest(x, f64::MAX),
            found => found,
        };
        found.filter(|(distance, ..)| *distance < reach)
    }
}

impl Surface<Space> for Filled<'_> {
    fn lower_bound(&self, x: DVec3) -> f64 {
        self.bounds.lower_bound(x)
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            out.hits.extend(
                self.nearest(x, reach)
                    .map(|(distance, normal, feature)| Hit {
                        of: of as u32,
                        distance,
                        normal,
                        feature,
                    }),
            );
        }
    }

    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        self.exact.outline(low, high)
    }
}
