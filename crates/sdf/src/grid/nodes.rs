//! Where the nodes of a grid lie.

use super::{GridError, GridOptions};
use glam::DVec3;

/// A regular grid; x runs fastest, then y, then z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nodes {
    pub low: DVec3,
    pub cell: f64,
    pub counts: [usize; 3],
}

/// The most nodes of any grid: they are numbered by u32.
pub(super) const MOST_NODES: f64 = u32::MAX as f64;

impl Nodes {
    /// Nodes around a box so that `margin` m on each side are inside the grid.
    pub fn around(
        [low, high]: [DVec3; 2],
        margin: f64,
        options: &GridOptions,
    ) -> Result<Self, GridError> {
        let size = high - low + DVec3::splat(2.0 * margin);
        let most = (options.most_bytes as f64 / 4.0).min(MOST_NODES);
        let counts = |cell: f64| (size / cell).ceil() + DVec3::ONE;
        let nodes = |cell: f64| counts(cell).element_product();
        let cell = options.cell;
        if nodes(cell) > most {
            let mut fits = cell;
            // Two nodes along each axis are the least there can be.
            while nodes(fits) > most.max(8.0) {
                fits *= 1.01;
            }
            return Err(GridError::TooLarge {
                bytes: 4.0 * nodes(cell),
                most_bytes: options.most_bytes,
                cell: fits,
            });
        }
        let counts = counts(cell);
        // What the last cells stick out is shared by both sides.
        let spare = (counts - DVec3::ONE) * cell - size;
        Ok(Self {
            low: low - DVec3::splat(margin) - 0.5 * spare,
            cell,
            counts: counts.to_array().map(|n| (n as usize).max(2)),
        })
    }

    pub fn count(&self) -> usize {
        self.counts.iter().product()
    }

    pub fn place(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        self.low + self.cell * DVec3::new(i as f64, j as f64, k as f64)
    }

    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.counts[0] * (j + self.counts[1] * k)
    }

    pub fn coordinates(&self, index: usize) -> [usize; 3] {
        let [nx, ny, _] = self.counts;
        [index % nx, index / nx % ny, index / (nx * ny)]
    }
}
