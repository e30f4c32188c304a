//! A grid of cells no narrower than the reach, and the counting sort that puts grains in its order.
//!
//! Cells follow each other brick by brick, not row by row: a run of grains is then a lump in space, whose neighbours fit into
//! a near cache however wide the scene is.

use std::ops::Range;
use tsubu_model::{Dim, Domain, Vector};

/// Cells along each edge of a brick, in the plane and in space: some five hundred grains in a dense scene.
const EDGE: [usize; 2] = [22, 8];

/// Grains sorted into cells. Cells along the first axis of a brick follow each other in memory.
pub struct CellGrid<D: Dim> {
    low: D::V,
    per_width: D::V,
    count: [usize; 3],
    periodic: [bool; 3],
    starts: Vec<u32>,
    /// `order[new] = old`: the order of the grains by cell, stable within a cell.
    pub order: Vec<u32>,
}

impl<D: Dim> CellGrid<D> {
    /// Sorts `n` grains at `position` (wrapped into the box) into cells at least `width` wide.
    /// A non-finite position counts as lying at the low corner; the engine's health check names it.
    pub fn new(domain: &Domain<D>, n: usize, position: impl Fn(usize) -> D::V, width: f64) -> Self {
        let axes = D::V::AXES;
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for i in 0..n {
            let x = position(i);
            for a in 0..axes {
                low[a] = low[a].min(x.axis(a));
                high[a] = high[a].max(x.axis(a));
            }
        }
        let mut periodic = [false; 3];
        for a in 0..axes {
            periodic[a] = domain.is_periodic(a);
            if periodic[a] {
                (low[a], high[a]) = (0.0, domain.period.axis(a));
            } else if !(low[a].is_finite() && high[a].is_finite()) {
                (low[a], high[a]) = (0.0, 0.0);
            }
        }
        // A grain that flies far away must not make the grid huge: wider cells, never more than a few per grain.
        let most = 4 * n + 64;
        let mut width = width;
        let mut count = [1usize; 3];
        loop {
            for a in 0..axes {
                count[a] = (((high[a] - low[a]) / width).floor().min(1e9) as usize).max(1);
            }
            if count.iter().map(|&c| c as f64).product::<f64>() <= most as f64 {
                break;
            }
            width *= 1.25;
        }
        let low = D::V::from_axes(|a| low[a]);
        let per_width = D::V::from_axes(|a| {
            let length = high[a] - low.axis(a);
            if length > 0.0 {
                count[a] as f64 / length
            } else {
                0.0
            }
        });
        let mut grid = Self {
            low,
            per_width,
            count,
            periodic,
            starts: Vec::new(),
            order: vec![0; n],
        };
        let cells = count.iter().product::<usize>();
        // Counted two places on, a sum gives where each cell begins one place on, and filling the cells moves that to where it
        // ends, which is where the next begins: no second copy is needed.
        let mut starts = vec![0u32; cells + 2];
        for i in 0..n {
            starts[grid.index(grid.cell(position(i))) + 2] += 1;
        }
        for c in 1..=cells {
            starts[c + 1] += starts[c];
        }
        for i in 0..n {
            let slot = &mut starts[grid.index(grid.cell(position(i))) + 1];
            grid.order[*slot as usize] = i as u32;
            *slot += 1;
        }
        grid.starts = starts;
        grid
    }

    /// The cell in which a point lies.
    pub(crate) fn cell(&self, x: D::V) -> [usize; 3] {
        let mut cell = [0; 3];
        for (a, c) in cell.iter_mut().enumerate().take(D::V::AXES) {
            // Saturating: NaN and negative rounding give cell 0.
            *c = (((x.axis(a) - self.low.axis(a)) * self.per_width.axis(a)) as usize)
                .min(self.count[a] - 1);
        }
        cell
    }

    /// The place of a cell in the order: bricks row by row, the last of a row perhaps narrower, and the cells of a brick
    /// row by row.
    fn index(&self, cell: [usize; 3]) -> usize {
        let [nx, ny, _] = self.count;
        let (corner, [wide, deep, high]) = self.brick(cell);
        let before = nx * ny * corner[2] + high * (nx * corner[1] + deep * corner[0]);
        let [x, y, z] = [0, 1, 2].map(|a| cell[a] - corner[a]);
        before + (z * deep + y) * wide + x
    }

    /// First cell and size of the brick of a cell.
    pub(crate) fn brick(&self, cell: [usize; 3]) -> ([usize; 3], [usize; 3]) {
        let edge = EDGE[usize::from(D::V::AXES > 2)];
        let corner = cell.map(|c| c / edge * edge);
        (
            corner,
            [0, 1, 2].map(|a| edge.min(self.count[a] - corner[a])),
        )
    }

    /// True if cells are so many on every periodic axis that none is met twice around a brick's cell, and that of two grains
    /// that are near each other only those across a face need an image.
    pub(crate) fn is_wide(&self) -> bool {
        (0..3).all(|a| !self.periodic[a] || self.count[a] >= 5)
    }

    /// The cell at place `c` of an axis, one before the first and one after the last allowed, and by how many periods its
    /// grains have to be shifted to lie there; none where the scene ends.
    pub(crate) fn around_brick(&self, axis: usize, c: usize) -> Option<(usize, f64)> {
        let n = self.count[axis];
        if c < n {
            Some((c, 0.0))
        } else if !self.periodic[axis] {
            None
        } else if c == n {
            Some((0, 1.0))
        } else {
            Some((n - 1, -1.0))
        }
    }

    /// The sorted grains of a cell.
    pub(crate) fn grains_of(&self, cell: [usize; 3]) -> Range<usize> {
        let c = self.index(cell);
        self.starts[c] as usize..self.starts[c + 1] as usize
    }

    /// Cells to look at along one axis around cell `c`: each once, also where the box is narrow.
    fn around(&self, axis: usize, c: usize) -> ([usize; 3], usize) {
        let n = self.count[axis];
        if self.periodic[axis] {
            match n {
                1 => ([0; 3], 1),
                2 => ([0, 1, 0], 2),
                _ => ([(c + n - 1) % n, c, (c + 1) % n], 3),
            }
        } else {
            let (from, to) = (c.saturating_sub(1), (c + 1).min(n - 1));
            ([from, from + 1, from + 2], to - from + 1)
        }
    }

    /// Ranges of sorted grains that may be near `x`, in a fixed order.
    pub fn near(&self, x: D::V, mut visit: impl FnMut(Range<usize>)) {
        let cell = self.cell(x);
        let (zs, nz) = self.around(2, cell[2]);
        let (ys, ny) = self.around(1, cell[1]);
        let (xs, nx) = self.around(0, cell[0]);
        for &z in &zs[..nz] {
            for &y in &ys[..ny] {
                // Cells of a row that follow each other are one range.
                let mut run = 0..0;
                for &x in &xs[..nx] {
                    let c = self.index([x, y, z]);
                    if run.end == c {
                        run.end += 1;
                    } else {
                        visit(self.starts[run.start] as usize..self.starts[run.end] as usize);
                        run = c..c + 1;
                    }
                }
                visit(self.starts[run.start] as usize..self.starts[run.end] as usize);
            }
        }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        4 * (self.starts.capacity() + self.order.capacity())
    }
}
