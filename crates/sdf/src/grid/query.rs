//! Asking the grid: value, gradient, bound, hits.

use super::{DistanceGrid, GridOptions};
use crate::mesh::Mesh;
use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Shell, Space, Surface};

/// Where the gradient is shorter than this the interpolant has a ridge there, and the normal is arbitrary.
const FLAT: f64 = 1e-9;
/// Half the diagonal of a cell, in cells: the most that an interpolated distance may be off.
const DIAGONAL: f64 = 0.866_025_403_784_438_6;

/// A point's cell: the corners' values and where in the cell it lies, 0 to 1.
struct Cell {
    corners: [f64; 8],
    at: DVec3,
}

impl Cell {
    /// The trilinear interpolant and its gradient times the cell.
    #[inline]
    fn value_and_slope(&self) -> (f64, DVec3) {
        let [a, b, c, d, e, f, g, h] = self.corners;
        let t = self.at;
        let mix = |from: f64, to: f64, t: f64| from + (to - from) * t;
        // Along x at the four edges, then y, then z.
        let (ab, cd, ef, gh) = (
            mix(a, b, t.x),
            mix(c, d, t.x),
            mix(e, f, t.x),
            mix(g, h, t.x),
        );
        let (low, high) = (mix(ab, cd, t.y), mix(ef, gh, t.y));
        let dx = mix(mix(b - a, d - c, t.y), mix(f - e, h - g, t.y), t.z);
        let dy = mix(cd - ab, gh - ef, t.z);
        (mix(low, high, t.z), DVec3::new(dx, dy, high - low))
    }

    /// How far the interpolant of any distance may be from the distance itself, in cells.
    ///
    /// A distance changes by at most the way gone, so |Σ w dᵢ − d(x)| ≤ Σ w |xᵢ − x| ≤ √Σ w |xᵢ − x|² = √Σ t(1 − t) over the axes.
    #[inline]
    fn doubt(&self) -> f64 {
        (self.at * (DVec3::ONE - self.at)).element_sum().sqrt()
    }
}

impl DistanceGrid {
    /// The interpolated distance in m and its gradient, or `None` outside the grid.
    #[inline]
    pub fn value_and_gradient(&self, x: DVec3) -> Option<(f64, DVec3)> {
        let (value, slope) = self.cell_of(x)?.value_and_slope();
        Some((value, slope / self.nodes.cell))
    }

    /// The interpolated distance in m and the outward unit normal, or `None` outside the grid.
    #[inline]
    pub fn distance_and_normal(&self, x: DVec3) -> Option<(f64, DVec3)> {
        let (value, slope) = self.value_and_gradient(x)?;
        let length = slope.length();
        // In the middle of a wall every way out is as long.
        let normal = if length > FLAT {
            slope / length
        } else {
            DVec3::Z
        };
        Some((value, normal))
    }

    /// The mesh that the grid was made of, welded and oriented.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// How the grid was made.
    pub fn options(&self) -> &GridOptions {
        &self.options
    }

    /// Number of nodes along x, y, z.
    pub fn counts(&self) -> [usize; 3] {
        self.nodes.counts
    }

    /// Bytes of the nodes' values.
    pub fn bytes(&self) -> u64 {
        4 * self.values.len() as u64
    }

    /// Whether x, whose distance from the closed surface is `distance`, is inside, if a corner of its cell tells.
    ///
    /// The balls around x and around a corner that reach to the surface hold none of it. Where they
    /// meet, the line between is free of the surface and both are on one side.
    pub(crate) fn side(&self, x: DVec3, distance: f64) -> Option<bool> {
        let cell = self.cell_of(x)?;
        // Beyond the band a value is a bound, and the band itself is the free way.
        let most = self.options.band;
        let slack = 1e-6 * self.nodes.cell;
        (0..8).find_map(|k| {
            let corner = DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
            let apart = (corner - cell.at).length() * self.nodes.cell;
            let value = cell.corners[k];
            (distance + value.abs().min(most) > apart + slack).then_some(value < 0.0)
        })
    }

    /// The unit vector along a slope.
    #[inline]
    fn direction(&self, slope: DVec3) -> DVec3 {
        let length = slope.length();
        // In the middle of a wall every way out is as long.
        if length > FLAT * self.nodes.cell {
            slope / length
        } else {
            DVec3::Z
        }
    }

    /// What storing nodes in four bytes may add to a value, in m.
    #[inline]
    fn rounding(&self, value: f64) -> f64 {
        2e-7 * (value.abs() + 2.0 * self.nodes.cell)
    }

    #[inline]
    fn cell_of(&self, x: DVec3) -> Option<Cell> {
        let nodes = &self.nodes;
        let at = (x - nodes.low) / nodes.cell;
        let [nx, ny, nz] = nodes.counts;
        // NaN is in no cell.
        let within = at.x >= 0.0
            && at.y >= 0.0
            && at.z >= 0.0
            && at.x <= (nx - 1) as f64
            && at.y <= (ny - 1) as f64
            && at.z <= (nz - 1) as f64;
        if !within {
            return None;
        }
        let i = (at.x as usize).min(nx - 2);
        let j = (at.y as usize).min(ny - 2);
        let k = (at.z as usize).min(nz - 2);
        let first = nodes.index([i, j, k]);
        let row = |from: usize| {
            let pair = &self.values[from..from + 2];
            [f64::from(pair[0]), f64::from(pair[1])]
        };
        let [a, b] = row(first);
        let [c, d] = row(first + nx);
        let [e, f] = row(first + nx * ny);
        let [g, h] = row(first + nx * ny + nx);
        Some(Cell {
            corners: [a, b, c, d, e, f, g, h],
            at: at - DVec3::new(i as f64, j as f64, k as f64),
        })
    }

    /// Distance and normal for a grain within reach; the mesh itself is asked if that is wanted.
    #[inline]
    fn touch(&self, x: DVec3, reach: f64) -> Option<(f64, DVec3)> {
        let cell = self.cell_of(x)?;
        let (value, slope) = cell.value_and_slope();
        let Some(exact) = &self.exact else {
            return (value < reach).then(|| (value, self.direction(slope)));
        };
        // The interpolant is off by half a cell's diagonal at most, so what is further is not touched.
        if value >= reach + DIAGONAL * self.nodes.cell {
            return None;
        }
        // Where the interpolant leaves no doubt about the side, the mesh need not find it out.
        let sure = value.abs() > (cell.doubt() + 1e-3) * self.nodes.cell;
        match exact.closest_on(x, reach, sure.then_some(value < 0.0)) {
            Some((distance, normal, _)) => (distance < reach).then_some((distance, normal)),
            // Deeper than the reach: the grid knows the way out.
            None => (value < 0.0).then(|| (value, self.direction(slope))),
        }
    }
}

impl Surface<Space> for DistanceGrid {
    /// Within the grid the interpolant less what interpolation may be off, outside the distance from the body's box.
    fn lower_bound(&self, x: DVec3) -> f64 {
        match self.cell_of(x) {
            Some(cell) => {
                let value = cell.value_and_slope().0;
                value - self.nodes.cell * cell.doubt() - self.rounding(value)
            }
            None => crate::distance_to_box(x, self.body_box),
        }
    }

    /// What the bound leaves; or, where the interpolant decides, what it does: along each axis it changes by at
    /// most the way gone, so by √3 times the way at most.
    fn room(&self, x: DVec3, reach: f64) -> f64 {
        let Some(cell) = self.cell_of(x) else {
            return self.lower_bound(x) - reach;
        };
        let value = cell.value_and_slope().0;
        let beyond = value - self.rounding(value) - reach;
        let bounded = beyond - self.nodes.cell * cell.doubt();
        if self.exact.is_some() {
            return bounded;
        }
        bounded.max(beyond / 3f64.sqrt())
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            if let Some((distance, normal)) = self.touch(x, reach) {
                out.hits.push(Hit {
                    of: of as u32,
                    distance,
                    normal,
                    feature: 0,
                });
            }
        }
    }

    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        self.mesh.outline(low, high)
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some(self.body_box)
    }

    fn shell(&self) -> Option<Shell> {
        Some(self.mesh.shell())
    }
}
