//! The grains of one brick of cells and of the cells around it, copied out in rows, so that who is near whom is found without
//! asking for bricks, edges and images again.

use crate::CellGrid;
use tsubu_model::{Dim, Domain, Vector};

/// Marks a grain that was taken from beyond a periodic face.
const IMAGE: u32 = 1 << 31;

/// A brick of cells with one cell more all round, row by row along the first axis.
#[derive(Debug, Default)]
pub(crate) struct Halo {
    /// First cell of the brick; `usize::MAX` before the first is taken.
    corner: [usize; 3],
    /// Cells along each axis, those around included.
    size: [usize; 3],
    /// How many cells lie before the brick's first on each axis: one, or none on an axis that a dimension lacks.
    margin: [usize; 3],
    /// Where the grains of each cell begin, and the end.
    starts: Vec<u32>,
    /// Coordinates of the grains' nearest images.
    at: [Vec<f64>; 3],
    /// Their indices, marked if that image is another than the grain itself.
    index: Vec<u32>,
    /// Room for as many partners, and one more.
    found: Vec<u32>,
}

impl Halo {
    /// Before anything is taken.
    pub fn new() -> Self {
        Self {
            corner: [usize::MAX; 3],
            ..Self::default()
        }
    }

    /// Takes the brick in which the cell lies, unless it is there already.
    pub fn take<D: Dim>(
        &mut self,
        grid: &CellGrid<D>,
        domain: &Domain<D>,
        cell: [usize; 3],
        position: &impl Fn(usize) -> D::V,
    ) {
        let (corner, brick) = grid.brick(cell);
        if corner == self.corner {
            return;
        }
        self.corner = corner;
        self.margin = std::array::from_fn(|a| usize::from(a < D::V::AXES));
        self.size = std::array::from_fn(|a| brick[a] + 2 * self.margin[a]);
        self.starts.clear();
        self.index.clear();
        for coordinates in &mut self.at {
            coordinates.clear();
        }
        // The cell on each axis, and by how many periods its grains have to be shifted.
        let place =
            |a: usize, k: usize| grid.around_brick(a, (corner[a] + k).wrapping_sub(self.margin[a]));
        for z in 0..self.size[2] {
            for y in 0..self.size[1] {
                for x in 0..self.size[0] {
                    self.starts.push(self.index.len() as u32);
                    let (Some(x), Some(y), Some(z)) = (place(0, x), place(1, y), place(2, z))
                    else {
                        continue;
                    };
                    let shifts = [x.1, y.1, z.1];
                    let mark = if shifts == [0.0; 3] { 0 } else { IMAGE };
                    for j in grid.grains_of([x.0, y.0, z.0]) {
                        let at = position(j);
                        self.index.push(j as u32 | mark);
                        for (a, coordinates) in self.at.iter_mut().enumerate() {
                            // An axis that the dimension lacks is at 0; one that does not repeat has no shift.
                            let mut place = if a < D::V::AXES { at.axis(a) } else { 0.0 };
                            if shifts[a] != 0.0 {
                                place += shifts[a] * domain.period.axis(a);
                            }
                            coordinates.push(place);
                        }
                    }
                }
            }
        }
        self.starts.push(self.index.len() as u32);
        self.found.resize(self.index.len() + 1, 0);
    }

    /// Adds every grain within the root of `cut2` of grain `i`, which lies at `x` in this cell of the brick, to `partners`;
    /// true if one of them is beyond a periodic face.
    pub fn partners<D: Dim>(
        &mut self,
        (i, cell, x): (usize, [usize; 3], D::V),
        cut2: f64,
        partners: &mut Vec<u32>,
    ) -> bool {
        // The first cell to look at on each axis, and how many.
        let from: [usize; 3] = std::array::from_fn(|a| cell[a] - self.corner[a]);
        let many = self.margin.map(|margin| 1 + 2 * margin);
        let found = &mut self.found[..];
        let (mut count, mut images) = (0, 0);
        for z in from[2]..from[2] + many[2] {
            for y in from[1]..from[1] + many[1] {
                let row = (z * self.size[1] + y) * self.size[0] + from[0];
                let row = self.starts[row] as usize..self.starts[row + many[0]] as usize;
                let [xs, ys, zs] = [0, 1, 2].map(|a| &self.at[a][row.clone()]);
                let places = xs.iter().zip(ys).zip(zs);
                // Written where the next goes and kept only if it is near: no branch to guess wrong.
                for (((&at_x, &at_y), &at_z), &index) in places.zip(&self.index[row]) {
                    let at = [at_x, at_y, at_z];
                    let apart = D::V::from_axes(|a| x.axis(a) - at[a]);
                    let near = (apart.length_squared() < cut2) & (index != i as u32);
                    found[count] = index & !IMAGE;
                    count += usize::from(near);
                    images |= if near { index } else { 0 };
                }
            }
        }
        partners.extend_from_slice(&found[..count]);
        images & IMAGE != 0
    }
}
