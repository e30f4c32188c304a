//! The points that the suite tries, and the questions that it asks there.

use super::Options;
use glam::DVec3;
use tsubu_model::{Dim, Hit, HitBuffer, Surface, Vector};

/// A surface on trial.
pub(super) struct Trial<'a, D: Dim> {
    pub surface: &'a dyn Surface<D>,
    pub options: &'a Options<'a, D>,
    pub points: Vec<D::V>,
    /// Diagonal of the region in m: the scale of every length.
    pub size: f64,
    /// Allowed error of a distance in m.
    pub slack: f64,
    low: D::V,
    high: D::V,
}

impl<'a, D: Dim> Trial<'a, D> {
    pub(super) fn new(
        surface: &'a dyn Surface<D>,
        [low, high]: [D::V; 2],
        options: &'a Options<'a, D>,
    ) -> Self {
        let size = (high - low).length();
        let mut trial = Self {
            surface,
            options,
            points: options.special.clone(),
            size,
            slack: options.tolerance * size,
            low,
            high,
        };
        // A third of the points is spread evenly, the rest lies near the surface, where contacts are.
        for k in 0..options.samples {
            let x = trial.spread(k as u64);
            let near = trial.nearest(x).filter(|_| k % 3 != 0);
            let moved = near.map(|hit| {
                let over = 0.05 * size * (2.0 * chance(k as u64, 7) - 1.0);
                x - hit.normal * (hit.distance - over)
            });
            trial.points.push(moved.unwrap_or(x));
        }
        trial
    }

    /// Point number `k` of those spread over the region.
    pub(super) fn spread(&self, k: u64) -> D::V {
        D::V::from_axes(|a| {
            let (low, high) = (self.low.axis(a), self.high.axis(a));
            low + (high - low) * chance(k, a as u64)
        })
    }

    /// A direction of length one.
    pub(super) fn direction(&self, k: u64) -> D::V {
        for again in 0..64 {
            let v = D::V::from_axes(|a| 2.0 * chance(k, 16 + 8 * again + a as u64) - 1.0);
            let length = v.length();
            if length > 0.1 && length < 1.0 {
                return v * (1.0 / length);
            }
        }
        D::V::from_axes(|a| if a == 0 { 1.0 } else { 0.0 })
    }

    /// A box within the region, so that an outline has to be cut.
    pub(super) fn middle_box(&self) -> (DVec3, DVec3) {
        let (low, high) = (D::to_space(self.low), D::to_space(self.high));
        let size = high - low;
        (low + 0.3 * size, high - 0.3 * size)
    }

    /// The hits of one point.
    pub(super) fn hits(&self, x: D::V, reach: f64) -> Vec<Hit<D>> {
        let mut out = HitBuffer::default();
        self.surface.hits(&[x], &[reach], &mut out);
        out.hits
    }

    /// The nearest hit within the reach at which the surface knows itself.
    pub(super) fn nearest(&self, x: D::V) -> Option<Hit<D>> {
        let hits = self.hits(x, self.options.reach);
        // Inside one part of a union the surface of another may be nearer than the union's own.
        let size = |hit: &Hit<D>| match self.options.union {
            true => hit.distance,
            false => hit.distance.abs(),
        };
        hits.into_iter().min_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// The distance of a point, if the surface knows it.
    pub(super) fn distance(&self, x: D::V) -> Option<f64> {
        self.nearest(x).map(|hit| hit.distance)
    }
}

/// A number in [0, 1) that depends on `k` and `stream` only (splitmix64).
pub(super) fn chance(k: u64, stream: u64) -> f64 {
    let mut z = k
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .wrapping_add(stream.wrapping_mul(0xD1B5_4A32_D192_ED03))
        .wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}
