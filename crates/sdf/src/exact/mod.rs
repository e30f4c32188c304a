//! A mesh as a surface with no grid between: exact distances, several contacts per grain.

mod contacts;
#[cfg(test)]
mod tests;

use crate::grid::{DistanceGrid, GridError};
use crate::mesh::edges::smooth_faces;
use crate::mesh::shells::{is_clean, shells};
use crate::mesh::{Mesh, MeshError, double_area};
use crate::tree::{Closest, Tree};
use crate::winding::Winding;
use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Shell, Space, Surface};

/// A triangle mesh that grains touch exactly.
///
/// A grain touches wherever its distance from the mesh has a minimum: the foot on a face, one point
/// of a convex edge or corner, both faces of a concave corner. Contacts less than 30° apart are one,
/// the nearer, so that a round wall drawn with strips acts as one wall. What lies behind another
/// face is not touched. A grain whose centre is inside is pushed to the closest point.
/// About 1 µs per grain near the mesh; [`DistanceGrid`](crate::DistanceGrid) is some thirty times faster.
#[derive(Clone)]
pub struct ExactMesh {
    mesh: Mesh,
    tree: Tree,
    /// Of the mesh with its holes closed.
    winding: Winding,
    /// Cheap bounds; `exact_edges` is off in it.
    coarse: Box<DistanceGrid>,
    /// For each triangle the name of its smooth face.
    faces: Vec<u32>,
    /// Normals tell the inside; else winding numbers do.
    clean: bool,
    /// No hole had to be closed.
    whole: bool,
    /// Half the thickness of a two-sided wall; `None` for a body.
    half_wall: Option<f64>,
    bounds: [DVec3; 2],
}

impl std::fmt::Debug for ExactMesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ExactMesh")
            .field("triangles", &self.mesh.triangles.len())
            .field("clean", &self.clean)
            .field("half_wall", &self.half_wall)
            .finish_non_exhaustive()
    }
}

impl ExactMesh {
    /// The body that the mesh bounds. The mesh is welded and oriented first; holes are bridged
    /// where the inside is asked for, but not touched.
    ///
    /// # Errors
    /// What [`Mesh::check`] refuses.
    pub fn body(mesh: &Mesh) -> Result<Self, MeshError> {
        Self::new(mesh, None)
    }

    /// A wall of `thickness` m, zero allowed, whose middle is the mesh; it has two outsides and no inside.
    ///
    /// # Errors
    /// What [`Mesh::check`] refuses.
    pub fn wall(mesh: &Mesh, thickness: f64) -> Result<Self, MeshError> {
        Self::new(mesh, Some(0.5 * thickness.max(0.0)))
    }

    fn new(mesh: &Mesh, half_wall: Option<f64>) -> Result<Self, MeshError> {
        mesh.check()?;
        let (mesh, _) = mesh.repaired();
        let tree = Tree::new(&mesh).ok_or(MeshError::Empty)?;
        let (pieces, edges) = shells(&mesh);
        let off = 1e-4 * mesh.diagonal();
        let coarse =
            DistanceGrid::coarse(&mesh, half_wall.map(|h| 2.0 * h), 48.0).map_err(|error| {
                match error {
                    GridError::Mesh(error) => error,
                    // The options are ours and fit; a mesh too flat for a grid has no area either.
                    _ => MeshError::NoArea,
                }
            })?;
        let [low, high] = mesh.bounds();
        let margin = DVec3::splat(half_wall.unwrap_or(0.0));
        Ok(Self {
            tree,
            winding: mesh.capped(off).0,
            coarse: Box::new(coarse),
            faces: smooth_faces(&mesh).0,
            clean: is_clean(&pieces, &edges),
            whole: pieces.iter().all(|piece| piece.closed),
            half_wall,
            bounds: [low - margin, high + margin],
            mesh,
        })
    }

    /// The mesh as it is used, welded and oriented.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The single closest place within `reach` of x: distance in m, outward unit normal, feature.
    pub fn closest(&self, x: DVec3, reach: f64) -> Option<(f64, DVec3, u32)> {
        self.closest_on(x, reach, None)
    }

    /// As [`ExactMesh::closest`], with the side if it is known.
    pub(crate) fn closest_on(
        &self,
        x: DVec3,
        reach: f64,
        inside: Option<bool>,
    ) -> Option<(f64, DVec3, u32)> {
        let half = self.half_wall.unwrap_or(0.0);
        let found = self.tree.closest(x, reach + half)?;
        let inside = self.half_wall.is_none() && inside.unwrap_or_else(|| self.is_inside(x, found));
        let (distance, normal) = self.seen(x, found.point, found.triangle, inside);
        Some((distance - half, normal, self.faces[found.triangle as usize]))
    }

    fn is_inside(&self, x: DVec3, found: Closest) -> bool {
        if self.clean {
            return found.behind;
        }
        // A mesh with holes has faces in the coarse grid that the tree has not: then only the number tells.
        let told = self
            .whole
            .then(|| self.coarse.side(x, (found.point - x).length()));
        told.flatten().unwrap_or_else(|| self.winding.inside(x))
    }

    /// Signed distance from the mesh and the outward direction.
    fn seen(&self, x: DVec3, point: DVec3, triangle: u32, inside: bool) -> (f64, DVec3) {
        let away = x - point;
        let distance = away.length();
        if distance <= 1e-12 * point.abs().max_element() {
            // On the surface the direction is rounding: the face knows better.
            let face = double_area(self.tree.corners(triangle));
            return (0.0, face.try_normalize().unwrap_or(DVec3::Z));
        }
        let sign = if inside { -1.0 } else { 1.0 };
        (sign * distance, away * (sign / distance))
    }
}

impl Surface<Space> for ExactMesh {
    /// The distance from the box outside it, the true signed distance inside it.
    fn lower_bound(&self, x: DVec3) -> f64 {
        let beyond = crate::distance_to_box(x, self.bounds);
        if beyond > 0.0 {
            return beyond;
        }
        self.closest(x, f64::MAX)
            .map_or(0.0, |(distance, ..)| distance)
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        let mut scratch = Vec::new();
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            let bound = self.coarse.lower_bound(x);
            // NaN is near nothing.
            if bound >= reach || bound.is_nan() {
                continue;
            }
            let of = of as u32;
            let half = self.half_wall.unwrap_or(0.0);
            let found = match self.tree.closest(x, reach + half) {
                Some(found) => found,
                // No face within reach: either free, or so deep inside that the way out is longer.
                None if self.half_wall.is_none() && bound < 0.0 && self.winding.inside(x) => {
                    match self.tree.closest(x, f64::MAX) {
                        Some(found) => found,
                        None => continue,
                    }
                }
                None => continue,
            };
            if self.half_wall.is_none() && self.is_inside(x, found) {
                let (distance, normal) = self.seen(x, found.point, found.triangle, true);
                out.hits.push(Hit {
                    of,
                    distance,
                    normal,
                    feature: self.faces[found.triangle as usize],
                });
            } else {
                self.minima(of, x, reach, &mut scratch, out);
            }
        }
    }

    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        self.mesh.outline(low, high)
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some(self.bounds)
    }

    fn shell(&self) -> Option<Shell> {
        Some(self.mesh.shell())
    }
}
