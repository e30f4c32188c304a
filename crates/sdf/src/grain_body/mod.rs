//! A body built of grains: a lattice of spheres in the place of a surface.

mod cells;
mod error;
mod filled;
#[cfg(test)]
mod tests;

pub use error::GrainBodyError;

use crate::exact::ExactMesh;
use crate::grid::GridError;
use crate::lattice::{Thin, fill_fcc};
use crate::mesh::{Mesh, MeshError};
use crate::solid::demand_length;
use cells::Cells;
use filled::Filled;
use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Shell, Space, Surface};

/// How a body of grains is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainBodyOptions {
    /// Radius of a wall grain rs in m.
    pub radius: f64,
    /// Distance from the wall grains' surfaces in m up to which points are sorted into cells: the
    /// reach of the grains and what they may move before they are sorted anew. Points further away
    /// are judged by the body's box alone.
    pub reach: f64,
    /// What becomes of parts too thin to hold a wall grain.
    pub thin: Thin,
    /// Makes the mesh a two-sided wall of this thickness in m, which is then filled.
    pub thickness: Option<f64>,
    /// Most bytes that wall grains and cells may take.
    pub most_bytes: u64,
}

impl GrainBodyOptions {
    /// A body whose thin parts get one layer; at most 1 GiB.
    pub fn new(radius: f64, reach: f64) -> Self {
        Self {
            radius,
            reach,
            thin: Thin::OneLayer,
            thickness: None,
            most_bytes: 1 << 30,
        }
    }
}

/// The union of equal spheres on a face-centred cubic lattice that fills a mesh ([`fill_fcc`]).
///
/// ```text
/// distance to wall grain k = |x − ck| − rs,    normal = (x − ck)/|x − ck|
/// ```
///
/// Every wall grain within reach is a hit of its own, `feature` being its number, so that a grain
/// touches as many of them as in a packing. The body's distance is the least of them; it is negative
/// in the spheres only: the holes between them count as outside, and what is small enough to pass
/// them does (0.155 rs through the windows of the lattice, about rs/2 through a layer of
/// [`Thin::OneLayer`]).
///
/// Valid for rs from some hundredth of the body's size to half its thickness. Where a part is thicker
/// than one wall grain and thinner than about two, the lattice meets it by chance and leaves holes
/// there; thin parts with one layer become 2 rs thick.
/// A query far from the body costs one look into a cell, near it a few cells of wall grains.
///
/// Source: `Sumitomo2024`, section 4.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::{HitBuffer, Space, Surface};
/// use tsubu_sdf::{Cuboid, GrainBody, GrainBodyOptions, Mesh};
/// let block = Cuboid::<Space>::new(DVec3::ZERO, DVec3::splat(0.040))?;
/// let shell = block.shell().unwrap();
/// let mesh = Mesh::from(shell);
/// // Grains of 2.5 mm radius; the first stands in the corner, at (2.5, 2.5, 2.5) mm.
/// let body = GrainBody::build(&mesh, &GrainBodyOptions::new(0.0025, 0.01))?;
/// assert_eq!(body.count(), 500);
/// let mut out = HitBuffer::<Space>::default();
/// body.hits(&[DVec3::new(0.0025, 0.0025, -0.001)], &[0.0015], &mut out);
/// assert_eq!(out.hits.len(), 1);
/// assert!((out.hits[0].distance - 0.001).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct GrainBody {
    mesh: Mesh,
    options: GrainBodyOptions,
    cells: Cells,
    /// The box that holds every wall grain.
    body_box: [DVec3; 2],
}

impl GrainBody {
    /// Fills the mesh, welded and oriented first, with wall grains.
    ///
    /// # Errors
    /// What [`GrainBodyError`] lists: a mesh that is refused, lengths that are no lengths, a radius for
    /// which the mesh holds no grain, or one so small that memory or time would run out.
    pub fn build(mesh: &Mesh, options: &GrainBodyOptions) -> Result<Self, GrainBodyError> {
        let GrainBodyOptions {
            radius,
            reach,
            thin,
            thickness,
            ..
        } = *options;
        demand_length("radius of wall grains", radius)?;
        demand_length("reach of the grains", reach)?;
        let exact = match thickness {
            Some(thickness) => ExactMesh::wall(mesh, thickness)?,
            None => ExactMesh::body(mesh)?,
        };
        let mesh = exact.mesh().clone();
        let bounds = Surface::bounds(&exact).unwrap_or_else(|| mesh.bounds());
        let volume = match thickness {
            Some(thickness) => mesh.area() * thickness,
            None => mesh.volume().abs(),
        };
        error::refuse_too_large(bounds, volume, options)?;
        let filled = Filled::new(&exact, thickness).map_err(|error| match error {
            GridError::Mesh(error) => error,
            // The options are ours and fit; a mesh too flat for a grid has no area either.
            _ => MeshError::NoArea,
        })?;
        let centres = fill_fcc(&filled, bounds, radius, thin)?;
        let Some(cells) = Cells::new(centres, radius, reach) else {
            return Err(GrainBodyError::NoGrain {
                radius,
                size: bounds[1] - bounds[0],
            });
        };
        let [low, high] = cells.bounds();
        Ok(Self {
            mesh,
            options: *options,
            body_box: [low - radius, high + radius],
            cells,
        })
    }

    /// Number of wall grains.
    pub fn count(&self) -> usize {
        self.cells.centres().len()
    }

    /// Centres of the wall grains in m, by their number.
    pub fn centres(&self) -> &[DVec3] {
        self.cells.centres()
    }

    /// Bytes of the wall grains and their cells.
    pub fn bytes(&self) -> u64 {
        self.cells.bytes()
    }

    /// How the body was made.
    pub fn options(&self) -> &GrainBodyOptions {
        &self.options
    }

    /// The mesh that was filled, welded and oriented.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }
}

impl Surface<Space> for GrainBody {
    /// From the cell's distance to its nearest wall grain, and from the body's box.
    fn lower_bound(&self, x: DVec3) -> f64 {
        let beyond = crate::distance_to_box(x, self.cells.bounds());
        beyond.max(self.cells.bound(x).unwrap_or(0.0)) - self.options.radius
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        let rs = self.options.radius;
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            self.cells.each_within(x, reach + rs, |number, away| {
                let r = away.length();
                let distance = r - rs;
                if distance < reach {
                    out.hits.push(Hit {
                        of: of as u32,
                        distance,
                        // In the middle of a wall grain every way out is as long.
                        normal: if r > 0.0 { away / r } else { DVec3::Z },
                        feature: number,
                    });
                }
            });
        }
    }

    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        self.mesh.outline(low, high)
    }

    /// The box of the wall grains, not that of the mesh.
    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some(self.body_box)
    }

    /// The mesh that was filled; the wall grains lie within it or, in thin parts, stick out of it.
    fn shell(&self) -> Option<Shell> {
        Some(self.mesh.shell())
    }
}
