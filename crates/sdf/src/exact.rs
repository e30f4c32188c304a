//! A mesh as a surface with no grid between: exact distances, several contacts per grain.

use crate::grid::{DistanceGrid, GridError};
use crate::mesh::edges::smooth_faces;
use crate::mesh::shells::{is_clean, shells};
use crate::mesh::{Mesh, MeshError, double_area};
use crate::tree::{Closest, Tree};
use crate::triangle::{Place, closest, crossing};
use crate::winding::Winding;
use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Shell, Space, Surface};

/// Contacts whose normals are closer than this are one contact: cosine of 30°, as for smooth faces.
const SAME_DIRECTION: f64 = crate::mesh::edges::SMOOTH;

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
            DistanceGrid::coarse(&mesh, half_wall.map(|h| 2.0 * h)).map_err(
                |error| match error {
                    GridError::Mesh(error) => error,
                    // The options are ours and fit; a mesh too flat for a grid has no area either.
                    _ => MeshError::NoArea,
                },
            )?;
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

    /// Every minimum of the distance from x within `reach`, x being outside; `scratch` is kept by the caller.
    fn minima(
        &self,
        of: u32,
        x: DVec3,
        reach: f64,
        scratch: &mut Vec<Candidate>,
        out: &mut HitBuffer<Space>,
    ) {
        let half = self.half_wall.unwrap_or(0.0);
        scratch.clear();
        self.tree.near(x, reach + half, |triangle| {
            let (point, place) = closest(self.tree.corners(triangle), x);
            let distance = (point - x).length();
            if distance < reach + half {
                scratch.push(Candidate {
                    distance,
                    triangle,
                    point,
                    place,
                });
            }
        });
        scratch.sort_unstable_by(|a, b| {
            (a.distance.total_cmp(&b.distance)).then(a.triangle.cmp(&b.triangle))
        });
        let first = out.hits.len();
        for (rank, candidate) in scratch.iter().enumerate() {
            let (distance, normal) = self.seen(x, candidate.point, candidate.triangle, false);
            let known = out.hits[first..]
                .iter()
                .any(|hit| hit.normal.dot(normal) > SAME_DIRECTION);
            if known
                || !self.is_minimum(candidate, &scratch[..rank])
                || self.is_hidden(x, candidate, &scratch[..rank])
            {
                continue;
            }
            let mut feature = self.feature(candidate, scratch);
            // Both sides of a bend of one smooth face are two contacts and need two names.
            if out.hits[first..].iter().any(|hit| hit.feature == feature) {
                feature = candidate.triangle;
            }
            while out.hits[first..].iter().any(|hit| hit.feature == feature) {
                feature = feature.wrapping_add(1);
            }
            out.hits.push(Hit {
                of,
                distance: distance - half,
                normal,
                feature,
            });
        }
    }

    /// The smallest name among the faces that meet at the point, whichever of them rounding puts first.
    fn feature(&self, candidate: &Candidate, all: &[Candidate]) -> u32 {
        let meets = |c: &&Candidate| {
            c.distance <= candidate.distance * (1.0 + 1e-9)
                && (c.point - candidate.point).length() <= 1e-9 * candidate.distance
        };
        let own = self.faces[candidate.triangle as usize];
        all.iter()
            .filter(meets)
            .map(|c| self.faces[c.triangle as usize])
            .fold(own, u32::min)
    }

    /// True if no closer triangle shares the side or corner on which the point lies.
    fn is_minimum(&self, candidate: &Candidate, closer: &[Candidate]) -> bool {
        let corners = self.mesh.triangles[candidate.triangle as usize];
        let holds =
            |other: &Candidate, v: u32| self.mesh.triangles[other.triangle as usize].contains(&v);
        // Equal up to rounding is the same point seen from the neighbour.
        let beats = |other: &&Candidate| other.distance < candidate.distance * (1.0 - 1e-9);
        match candidate.place {
            Place::Face => true,
            Place::Corner(k) => !closer.iter().filter(beats).any(|c| holds(c, corners[k])),
            Place::Side(k) => {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                !closer
                    .iter()
                    .filter(beats)
                    .any(|c| holds(c, a) && holds(c, b))
            }
        }
    }

    /// True if a closer triangle stands between x and the point.
    fn is_hidden(&self, x: DVec3, candidate: &Candidate, closer: &[Candidate]) -> bool {
        closer.iter().any(|c| {
            crossing(self.tree.corners(c.triangle), x, candidate.point - x)
                .is_some_and(|at| at > 0.0 && at < 1.0 - 1e-9)
        })
    }
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    distance: f64,
    triangle: u32,
    point: DVec3,
    place: Place,
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
        Some(Shell {
            vertices: self.mesh.vertices.clone(),
            triangles: self.mesh.triangles.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{self, Random};
    use proptest::prelude::*;
    use std::sync::OnceLock;

    fn hits(surface: &ExactMesh, x: DVec3, reach: f64) -> Vec<Hit<Space>> {
        let mut out = HitBuffer::default();
        surface.hits(&[x], &[reach], &mut out);
        out.hits
    }

    /// An L: a plate with a block on it, two overlapping boxes whose concave corner runs along y at x = 0, z = 0.
    fn step() -> Mesh {
        let mut mesh = samples::moved(
            samples::cuboid(DVec3::new(4.0, 4.0, 1.0), 5),
            DVec3::new(0.0, 0.0, -0.5),
        );
        samples::append(
            &mut mesh,
            &samples::moved(
                samples::cuboid(DVec3::new(2.0, 4.0, 2.0), 4),
                DVec3::new(-1.0, 0.0, 0.5),
            ),
        );
        mesh
    }

    #[test]
    fn one_flat_face_of_many_triangles_is_one_contact() {
        let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 8)).unwrap();
        for (x, y) in [(0.01, 0.02), (0.25, 0.25), (0.3, 0.111)] {
            let found = hits(&cube, DVec3::new(x, y, 1.4), 0.5);
            assert_eq!(found.len(), 1, "{found:?}");
            assert!((found[0].distance - 0.4).abs() < 1e-12);
            assert!((found[0].normal - DVec3::Z).length() < 1e-12);
        }
        // The feature is that of the face, wherever on it the grain is.
        let a = hits(&cube, DVec3::new(0.4, 0.3, 1.4), 0.5)[0].feature;
        let b = hits(&cube, DVec3::new(-0.6, 0.1, 1.4), 0.5)[0].feature;
        assert_eq!(a, b);
    }

    #[test]
    fn a_convex_edge_is_one_contact_and_a_concave_corner_two() {
        let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 3)).unwrap();
        let found = hits(&cube, DVec3::new(1.3, 0.1, 1.3), 0.5);
        assert_eq!(found.len(), 1, "{found:?}");
        let towards = DVec3::new(1.0, 0.0, 1.0).normalize();
        assert!((found[0].normal - towards).length() < 1e-12);
        assert!((found[0].distance - 0.3 * 2f64.sqrt()).abs() < 1e-12);
        let corner = hits(&cube, DVec3::splat(1.2), 0.5);
        assert_eq!(corner.len(), 1);

        let step = ExactMesh::body(&step()).unwrap();
        let found = hits(&step, DVec3::new(0.3, 0.1, 0.4), 0.5);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(
            (found[0].normal - DVec3::X).length() < 1e-12
                && (found[0].distance - 0.3).abs() < 1e-12
        );
        assert!(
            (found[1].normal - DVec3::Z).length() < 1e-12
                && (found[1].distance - 0.4).abs() < 1e-12
        );
        assert_ne!(found[0].feature, found[1].feature);
    }

    #[test]
    fn a_deep_grain_is_pushed_outward() {
        let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 3)).unwrap();
        let step = ExactMesh::body(&step()).unwrap();
        for (surface, x, reach, distance) in [
            (&cube, DVec3::new(0.1, 0.2, 0.7), 0.5, -0.3),
            // Deeper than the reach.
            (&cube, DVec3::new(0.1, 0.2, 0.3), 0.1, -0.7),
            // Where two shells overlap the nearest face counts.
            (&step, DVec3::new(1.5, 0.0, -0.2), 0.5, -0.2),
        ] {
            let found = hits(surface, x, reach);
            assert_eq!(found.len(), 1);
            assert!((found[0].distance - distance).abs() < 1e-12, "{found:?}");
            assert!((found[0].normal - DVec3::Z).length() < 1e-12);
            assert!(surface.lower_bound(x) <= distance && surface.lower_bound(x) > distance - 0.2);
        }
    }

    #[test]
    fn the_side_is_right_where_shells_overlap_and_where_holes_are() {
        let step = step();
        for mesh in [step.clone(), samples::with_holes(step.clone(), 0.02)] {
            let surface = ExactMesh::body(&mesh).unwrap();
            assert!(!surface.clean);
            let plate = |x: DVec3| {
                (x - DVec3::new(0.0, 0.0, -0.5))
                    .abs()
                    .cmplt(DVec3::new(2.0, 2.0, 0.5))
                    .all()
            };
            let block = |x: DVec3| {
                (x - DVec3::new(-1.0, 0.0, 0.5))
                    .abs()
                    .cmplt(DVec3::new(1.0, 2.0, 1.0))
                    .all()
            };
            let mut random = Random::new(9);
            for _ in 0..20_000 {
                let x = 2.5 * random.vector();
                let (distance, ..) = surface.closest(x, f64::MAX).unwrap();
                assert_eq!(distance < 0.0, plate(x) || block(x), "{x} {distance}");
            }
        }
    }

    #[test]
    fn the_back_of_a_thin_plate_is_not_touched_from_the_front() {
        let plate = ExactMesh::body(&samples::cuboid(DVec3::new(2.0, 2.0, 0.1), 4)).unwrap();
        assert_eq!(hits(&plate, DVec3::new(0.1, 0.2, 0.3), 0.5).len(), 1);
        let sheet = samples::sheet(4, 4, |i, j| DVec3::new(i as f64, j as f64, 0.0));
        let wall = ExactMesh::wall(&sheet, 0.2).unwrap();
        for side in [-1.0, 1.0] {
            let found = hits(&wall, DVec3::new(2.1, 1.8, 0.5 * side), 0.5);
            assert_eq!(found.len(), 1);
            assert!((found[0].distance - 0.4).abs() < 1e-12);
            assert!((found[0].normal - DVec3::Z * side).length() < 1e-12);
        }
    }

    #[test]
    fn a_round_wall_seen_from_within_is_one_contact() {
        // A pipe seen from inside; facets of 6°.
        let pipe = samples::sheet(60, 4, |i, j| {
            let u = std::f64::consts::TAU * (i % 60) as f64 / 60.0;
            DVec3::new(u.cos(), u.sin(), j as f64)
        });
        let pipe = ExactMesh::wall(&pipe, 0.0).unwrap();
        let mut random = Random::new(5);
        for _ in 0..500 {
            let u = random.unit() * 6.0;
            let x = DVec3::new(0.9 * u.cos(), 0.9 * u.sin(), 1.0 + 2.0 * random.unit());
            assert_eq!(hits(&pipe, x, 0.2).len(), 1);
        }
    }

    #[test]
    fn an_edge_has_one_name_all_along() {
        let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 7)).unwrap();
        let mut names: Vec<u32> = (0..500)
            .map(|k| hits(&cube, DVec3::new(1.2, -0.99 + 0.00396 * k as f64, 1.3), 0.5)[0].feature)
            .collect();
        names.dedup();
        assert_eq!(names.len(), 1, "{names:?}");
    }

    /// Made once: it is asked hundreds of times.
    fn cube() -> &'static ExactMesh {
        static CUBE: OnceLock<ExactMesh> = OnceLock::new();
        CUBE.get_or_init(|| ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 2)).unwrap())
    }

    proptest! {
        #[test]
        fn any_triangles_give_finite_hits_or_an_error(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 3..12), scale in -40..7i32, wall in any::<bool>(),
        ) {
            let scale = 10f64.powi(scale);
            let mesh = Mesh {
                triangles: (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect(),
                vertices: points.iter().map(|&p| DVec3::from(p) * scale).collect(),
                parts: Vec::new(),
            };
            prop_assert!(!crate::mesh::Report::of(&mesh).to_string().is_empty());
            let made = if wall { ExactMesh::wall(&mesh, 0.0) } else { ExactMesh::body(&mesh) };
            if let Ok(surface) = made {
                for &x in &[DVec3::ZERO, mesh.vertices[0], DVec3::ONE * scale, DVec3::NAN, DVec3::INFINITY] {
                    let bound = surface.lower_bound(x);
                    prop_assert!(bound.is_finite() || !x.is_finite());
                    for hit in hits(&surface, x, scale) {
                        prop_assert!(hit.is_finite() && (hit.normal.length() - 1.0).abs() < 1e-9, "{:?}", hit);
                    }
                }
            }
        }

        #[test]
        fn the_nearest_hit_is_the_distance_and_the_bound_is_below(x in prop::array::uniform3(-2.5..2.5f64), reach in 0.05..1.0f64) {
            let x = DVec3::from(x);
            let out = (x.abs() - DVec3::ONE).max(DVec3::ZERO).length();
            let distance = if out > 0.0 { out } else { (x.abs() - DVec3::ONE).max_element() };
            let cube = cube();
            prop_assert!(cube.lower_bound(x) <= distance + 1e-12);
            let found = hits(cube, x, reach);
            prop_assert_eq!(found.is_empty(), distance >= reach);
            for hit in &found {
                prop_assert!(hit.is_finite() && (hit.normal.length() - 1.0).abs() < 1e-12);
            }
            if let Some(first) = found.first() {
                prop_assert!((first.distance - distance).abs() < 1e-12);
                prop_assert_eq!(found.len(), 1);
            }
        }
    }
}
