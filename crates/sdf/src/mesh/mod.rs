//! Triangle meshes in metres: read from STL and OBJ, welded, examined.
//!
//! A mesh from a CAD program is seldom perfect. [`Mesh::weld`] and [`Mesh::orient`] repair what has one
//! right repair, [`Report`] says what remains, and the surfaces built from meshes
//! ([`DistanceGrid`](crate::DistanceGrid), [`ExactMesh`](crate::ExactMesh)) find the inside by winding
//! numbers, which bear holes, overlaps and a wrong orientation.

use glam::DVec3;
use std::io::Read;
use std::path::Path;
use tsubu_model::Shell;

mod caps;
pub mod doctor;
pub(crate) mod edges;
mod error;
mod obj;
mod orient;
mod outline;
#[cfg(test)]
pub(crate) mod samples;
pub(crate) mod shells;
mod stl;
mod text;
mod weld;

pub use doctor::{Report, Verdict};
pub use error::MeshError;
pub use obj::parse_obj;
pub use shells::{EdgeReport, ShellReport};
pub use stl::{parse_stl, write_stl};
pub use weld::Welded;

/// Largest mesh file that is read, in bytes.
pub const MOST_BYTES: u64 = 2 << 30;
/// Largest number of facets that is accepted.
pub const MOST_FACETS: u64 = 20_000_000;
/// Furthest coordinate that is accepted, in m: beyond it the wrong unit is the likelier explanation.
pub const FURTHEST: f64 = 1e6;

/// A named run of triangles: one `solid` of an STL, one object of an OBJ file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// Its name, empty if the file gives none.
    pub name: String,
    /// The first triangle.
    pub first: usize,
    /// How many triangles.
    pub count: usize,
}

/// Triangles that share vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners in m.
    pub vertices: Vec<DVec3>,
    /// Three corners each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The parts, in order of their triangles.
    pub parts: Vec<Part>,
}

/// The triangles that a surface is drawn with, as a mesh of one part without a name.
impl From<Shell> for Mesh {
    fn from(shell: Shell) -> Self {
        Self {
            vertices: shell.vertices,
            triangles: shell.triangles,
            parts: Vec::new(),
        }
    }
}

impl Mesh {
    /// Its triangles, to draw.
    pub fn shell(&self) -> Shell {
        Shell {
            vertices: self.vertices.clone(),
            triangles: self.triangles.clone(),
        }
    }

    /// Reads an STL or OBJ file whose numbers are in units of `metres_per_unit` m (0.001 for mm).
    ///
    /// Corners with equal coordinates become one vertex; nothing else is changed.
    ///
    /// # Errors
    /// Everything that [`MeshError`] lists; nothing is allocated for a file that is too large.
    pub fn read(path: impl AsRef<Path>, metres_per_unit: f64) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let shown = || path.display().to_string();
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        let stl = extension.eq_ignore_ascii_case("stl");
        if !stl && !extension.eq_ignore_ascii_case("obj") {
            return Err(MeshError::Format { path: shown() });
        }
        let unreadable = |reason: String| MeshError::Unreadable {
            path: shown(),
            reason,
        };
        let found = std::fs::metadata(path).map_err(|e| unreadable(e.to_string()))?;
        if !found.is_file() {
            return Err(unreadable("it is not a file".into()));
        }
        if found.len() > MOST_BYTES {
            return Err(MeshError::TooLarge { bytes: found.len() });
        }
        let mut bytes = Vec::new();
        // The file may grow while it is read: take no more than the limit.
        std::fs::File::open(path)
            .and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes))
            .map_err(|e| unreadable(e.to_string()))?;
        if stl {
            parse_stl(&bytes, metres_per_unit)
        } else {
            parse_obj(&bytes, metres_per_unit)
        }
    }

    /// Joins corners of equal coordinates into shared vertices. Three corners in m per facet.
    pub(crate) fn from_soup(soup: &[[DVec3; 3]], mut parts: Vec<Part>) -> Result<Self, MeshError> {
        if soup.is_empty() {
            return Err(MeshError::Empty);
        }
        parts.retain(|part| part.count > 0);
        let mut known = std::collections::HashMap::with_capacity(soup.len());
        let mut mesh = Self {
            vertices: Vec::with_capacity(soup.len() / 2 + 2),
            triangles: Vec::with_capacity(soup.len()),
            parts,
        };
        for corners in soup {
            let triangle = corners.map(|v| {
                // Adding zero turns −0 into 0, so that both are the same vertex.
                let key = (v + DVec3::ZERO).to_array().map(f64::to_bits);
                *known.entry(key).or_insert_with(|| {
                    mesh.vertices.push(v);
                    mesh.vertices.len() as u32 - 1
                })
            });
            mesh.triangles.push(triangle);
        }
        Ok(mesh)
    }

    /// Checks every index, every coordinate and the limits: what a mesh made by hand may have wrong.
    ///
    /// # Errors
    /// [`MeshError::Empty`], [`TooManyFacets`](MeshError::TooManyFacets), [`Index`](MeshError::Index),
    /// [`NotFinite`](MeshError::NotFinite), [`Huge`](MeshError::Huge), [`NoArea`](MeshError::NoArea).
    pub fn check(&self) -> Result<(), MeshError> {
        if self.triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if self.triangles.len() as u64 > MOST_FACETS {
            return Err(MeshError::TooManyFacets {
                facets: self.triangles.len() as u64,
            });
        }
        for (t, triangle) in self.triangles.iter().enumerate() {
            for &index in triangle {
                let vertex = self.vertices.get(index as usize).ok_or(MeshError::Index {
                    facet: t + 1,
                    index,
                    vertices: self.vertices.len(),
                })?;
                check_corner(*vertex, t + 1)?;
            }
        }
        if self.area() > 0.0 {
            Ok(())
        } else {
            Err(MeshError::NoArea)
        }
    }

    /// The corners of triangle `t`.
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }

    /// Lowest and highest corner of the box around all triangles, in m.
    pub fn bounds(&self) -> [DVec3; 2] {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for v in self.triangles.iter().flatten() {
            low = low.min(self.vertices[*v as usize]);
            high = high.max(self.vertices[*v as usize]);
        }
        [low, high]
    }

    /// Length of the diagonal of [`Mesh::bounds`] in m, zero for a mesh without triangles.
    pub fn diagonal(&self) -> f64 {
        let [low, high] = self.bounds();
        if low.x > high.x {
            0.0
        } else {
            (high - low).length()
        }
    }

    /// Sum of the triangles' areas in m².
    pub fn area(&self) -> f64 {
        (0..self.triangles.len())
            .map(|t| 0.5 * double_area(self.corners(t)).length())
            .sum()
    }

    /// V = ⅙ Σ a·(b × c) in m³, corners taken from the middle of the box.
    ///
    /// The volume enclosed if the mesh is closed and oriented; negative if it is inside out.
    pub fn volume(&self) -> f64 {
        let [low, high] = self.bounds();
        let middle = 0.5 * (low + high);
        (0..self.triangles.len())
            .map(|t| volume_of(self.corners(t), middle))
            .sum()
    }
}

/// Twice the area, as a vector along the normal.
pub(crate) fn double_area([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Signed volume of the tetrahedron under a triangle, seen from `origin`.
pub(crate) fn volume_of(corners: [DVec3; 3], origin: DVec3) -> f64 {
    let [a, b, c] = corners.map(|v| v - origin);
    a.dot(b.cross(c)) / 6.0
}

fn check_corner(corner: DVec3, facet: usize) -> Result<(), MeshError> {
    if !corner.is_finite() {
        return Err(MeshError::NotFinite { facet });
    }
    let metres = corner.abs().max_element();
    if metres > FURTHEST {
        return Err(MeshError::Huge { facet, metres });
    }
    Ok(())
}

fn check_unit(metres_per_unit: f64) -> Result<(), MeshError> {
    if metres_per_unit.is_finite() && metres_per_unit > 0.0 {
        Ok(())
    } else {
        Err(MeshError::Unit { metres_per_unit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_has_its_area_volume_and_box() {
        let cube = samples::cuboid(DVec3::splat(2.0), 3);
        cube.check().unwrap();
        assert!((cube.area() - 24.0).abs() < 1e-12);
        assert!((cube.volume() - 8.0).abs() < 1e-12);
        assert_eq!(cube.bounds(), [DVec3::splat(-1.0), DVec3::splat(1.0)]);
    }

    #[test]
    fn a_mesh_made_by_hand_is_checked() {
        let mut mesh = samples::cuboid(DVec3::ONE, 1);
        mesh.triangles[4][1] = 99;
        let text = mesh.check().unwrap_err().to_string();
        assert!(text.contains("facet 5") && text.contains("99"), "{text}");
        mesh.triangles[4] = [0, 0, 0];
        mesh.vertices[0].x = f64::NAN;
        assert!(matches!(mesh.check(), Err(MeshError::NotFinite { .. })));
        assert_eq!(Mesh::default().check(), Err(MeshError::Empty));
    }

    #[test]
    fn a_path_without_a_mesh_says_so() {
        let error = Mesh::read("no/such/body.stl", 1.0).unwrap_err().to_string();
        assert!(error.contains("no/such/body.stl"), "{error}");
        let error = Mesh::read("body.step", 1.0).unwrap_err().to_string();
        assert!(error.contains("STL"), "{error}");
    }
}
