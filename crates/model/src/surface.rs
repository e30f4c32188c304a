//! Surfaces that grains touch: planes, distance grids, meshes.

use crate::{Dim, Vector};

/// One place where a grain is near a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit<D: Dim> {
    /// Which of the queried points.
    pub of: u32,
    /// Distance of the grain's centre from the surface in m, negative inside.
    pub distance: f64,
    /// Unit normal out of the body.
    pub normal: D::V,
    /// Which part of the surface, so that contact memory finds it again.
    pub feature: u32,
}

/// Hits of one query; kept and cleared by the caller so that a step allocates nothing.
#[derive(Clone, Debug)]
pub struct HitBuffer<D: Dim> {
    /// The hits found.
    pub hits: Vec<Hit<D>>,
}

impl<D: Dim> Default for HitBuffer<D> {
    fn default() -> Self {
        Self { hits: Vec::new() }
    }
}

/// Triangles to draw: what a frame and a picture show of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shell {
    /// Corners in m.
    pub vertices: Vec<glam::DVec3>,
    /// Three corners each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// A surface in its own frame. Distances are signed: positive outside.
pub trait Surface<D: Dim>: Send + Sync {
    /// A distance that the true one is not below; cheap. Far grains are skipped by it.
    fn lower_bound(&self, x: D::V) -> f64;
    /// How far in m the point may move before [`hits`](Self::hits) can find it within `reach`: at most what
    /// it may, and negative if it may not move at all. A grain sleeps so long.
    fn room(&self, x: D::V, reach: f64) -> f64 {
        self.lower_bound(x) - reach
    }
    /// Every place within `reach[i]` of point `x[i]`, appended to `out` in the order of the points.
    fn hits(&self, x: &[D::V], reach: &[f64], out: &mut HitBuffer<D>);
    /// Outline to draw, as three-dimensional line segments within the box `low`–`high`.
    fn outline(&self, low: glam::DVec3, high: glam::DVec3) -> Vec<[glam::DVec3; 2]>;
    /// The corners of a box that holds the whole surface; `None` if it has no end.
    fn bounds(&self) -> Option<[glam::DVec3; 2]> {
        None
    }
    /// Triangles to draw; `None` for surfaces that are drawn by their outline.
    fn shell(&self) -> Option<Shell> {
        None
    }
}

impl<D: Dim> Hit<D> {
    /// True if every number is finite.
    pub fn is_finite(&self) -> bool {
        self.distance.is_finite() && self.normal.is_finite()
    }
}
