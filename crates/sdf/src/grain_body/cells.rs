//! Wall grains sorted into cells, to find those near a point.

use crate::grid::{Nodes, squared_cells};
use glam::DVec3;
use rayon::prelude::*;

/// Half the diagonal of a cell, in cells, √3/2 and a little for rounding.
const DIAGONAL: f64 = 0.8661;
/// A cell this near to the nearest wall grain, in cells, knows its distance exactly.
const EXACT: f64 = 8.0;

/// The centres of wall grains in cells of one grid.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    /// The nodes are the middles of the cells; x runs fastest.
    nodes: Nodes,
    /// In the order of the cells.
    centres: Vec<DVec3>,
    /// For each cell the number of its first centre, and the number of centres at the end.
    starts: Vec<u32>,
    /// For each cell a distance in m that none of the centres is nearer to its middle than.
    least: Vec<f32>,
    /// The box around the centres.
    bounds: [DVec3; 2],
}

/// Edge of a cell in m: some two wall grains, or a part of the reach if that is more.
pub(super) fn cell_edge(radius: f64, reach: f64) -> f64 {
    (2.0 * radius).max((reach + radius) / 8.0)
}

/// Bytes of so many centres and cells.
pub(super) fn bytes_of(centres: f64, cells: f64) -> f64 {
    24.0 * centres + 8.0 * cells
}

impl Cells {
    /// Sorts the centres; `None` if there are none.
    pub fn new(centres: Vec<DVec3>, radius: f64, reach: f64) -> Option<Self> {
        let first = *centres.first()?;
        let (low, high) = centres
            .iter()
            .fold((first, first), |(low, high), &c| (low.min(c), high.max(c)));
        let cell = cell_edge(radius, reach);
        let margin = reach + radius;
        let counts = ((high - low + 2.0 * margin) / cell).ceil() + DVec3::ONE;
        // What the last cells stick out is shared by both sides.
        let spare = (counts - 1.0) * cell - (high - low + 2.0 * margin);
        let nodes = Nodes {
            low: low - margin - 0.5 * spare,
            cell,
            counts: counts.to_array().map(|n| (n as usize).max(2)),
        };
        let mut cells = Self {
            starts: vec![0; nodes.count() + 1],
            least: Vec::new(),
            bounds: [low, high],
            nodes,
            centres: Vec::new(),
        };
        cells.sort(centres);
        cells.note_least();
        Some(cells)
    }

    fn sort(&mut self, centres: Vec<DVec3>) {
        let of: Vec<usize> = centres
            .iter()
            .map(|&c| {
                let at = (c - self.nodes.low) / self.nodes.cell + 0.5;
                self.nodes.index(at.to_array().map(|a| a as usize))
            })
            .collect();
        for &cell in &of {
            self.starts[cell + 1] += 1;
        }
        for cell in 0..self.starts.len() - 1 {
            self.starts[cell + 1] += self.starts[cell];
        }
        let mut next = self.starts.clone();
        self.centres = vec![DVec3::ZERO; centres.len()];
        for (&cell, centre) in of.iter().zip(centres) {
            self.centres[next[cell] as usize] = centre;
            next[cell] += 1;
        }
    }

    /// A centre is within half a diagonal of the middle of its cell, so a middle that is E cells from
    /// the nearest cell with a centre in it is between (E − √3/2) and (E + √3/2) cells from that centre.
    fn note_least(&mut self) {
        let held: Vec<f32> = self
            .starts
            .windows(2)
            .map(|pair| {
                if pair[0] < pair[1] {
                    0.0
                } else {
                    f32::INFINITY
                }
            })
            .collect();
        let squared = squared_cells(&self.nodes, &held);
        drop(held);
        let (nodes, [nx, ny, nz]) = (&self.nodes, self.nodes.counts);
        let mut least = vec![0.0; nodes.count()];
        least
            .par_chunks_mut(nx * ny)
            .enumerate()
            .for_each(|(k, slab)| {
                for (column, least) in slab.iter_mut().enumerate() {
                    let apart = f64::from(squared[k + nz * column]).sqrt();
                    let bound = if apart <= EXACT {
                        let middle = nodes.place([column % nx, column / nx, k]);
                        let within = nodes.cell * (apart + DIAGONAL);
                        self.nearest(middle, within)
                    } else {
                        nodes.cell * (apart - DIAGONAL)
                    };
                    // Rounding to four bytes may not lift the bound.
                    *least = (bound * (1.0 - 1e-6)) as f32;
                }
            });
        self.least = least;
    }

    /// Distance of the nearest centre in m, which must be within `within`.
    fn nearest(&self, x: DVec3, within: f64) -> f64 {
        let mut squared = within * within;
        self.rows(x, within, |centre, _| {
            squared = squared.min((x - centre).length_squared());
        });
        squared.sqrt()
    }

    /// A distance in m that no centre is nearer to x than, if x is in a cell.
    #[inline]
    pub fn bound(&self, x: DVec3) -> Option<f64> {
        let nodes = &self.nodes;
        let at = (x - nodes.low) / nodes.cell + 0.5;
        let [nx, ny, nz] = nodes.counts;
        // NaN is in no cell.
        let within =
            at.cmpge(DVec3::ZERO).all() && at.x < nx as f64 && at.y < ny as f64 && at.z < nz as f64;
        if !within {
            return None;
        }
        let cell = [at.x as usize, at.y as usize, at.z as usize];
        let least = f64::from(self.least[nodes.index(cell)]);
        Some(least - (x - nodes.place(cell)).length())
    }

    /// Calls `each` with number and x − centre for every centre that may be within `reach` of x.
    #[inline]
    pub fn each_within(&self, x: DVec3, reach: f64, mut each: impl FnMut(u32, DVec3)) {
        let bound = self.bound(x);
        let bound = bound.unwrap_or_else(|| crate::distance_to_box(x, self.bounds));
        if bound >= reach || bound.is_nan() {
            return;
        }
        let squared = reach * reach;
        self.rows(x, reach, |centre, number| {
            let away = x - centre;
            if away.length_squared() < squared {
                each(number, away);
            }
        });
    }

    /// Calls `each` with every centre of the cells that a ball reaches into, in the order of their numbers.
    #[inline]
    fn rows(&self, x: DVec3, reach: f64, mut each: impl FnMut(DVec3, u32)) {
        let (cell, counts) = (self.nodes.cell, self.nodes.counts);
        // In cells, the lower corner of cell [0, 0, 0] at zero. Casts of numbers out of range end at it.
        let at = (x - self.nodes.low) / cell + 0.5;
        let reach = reach / cell * (1.0 + 1e-12);
        let range = |at: f64, reach: f64, count: usize| {
            let last = (at + reach) as usize;
            (at - reach) as usize..if at + reach < 0.0 {
                0
            } else {
                last.min(count - 1) + 1
            }
        };
        // How far the point is from the nearer side of cell number i along one axis.
        let beyond = |at: f64, i: usize| (i as f64 - at).max(at - (i + 1) as f64).max(0.0);
        for k in range(at.z, reach, counts[2]) {
            let left = reach * reach - beyond(at.z, k).powi(2);
            for j in range(at.y, left.max(0.0).sqrt(), counts[1]) {
                let left = left - beyond(at.y, j).powi(2);
                if left.is_nan() || left < 0.0 {
                    continue;
                }
                let along = range(at.x, left.sqrt(), counts[0]);
                if along.is_empty() {
                    continue;
                }
                let row = counts[0] * (j + counts[1] * k);
                let first = self.starts[row + along.start];
                let end = self.starts[row + along.end];
                for number in first..end {
                    each(self.centres[number as usize], number);
                }
            }
        }
    }

    pub fn centres(&self) -> &[DVec3] {
        &self.centres
    }

    /// The box around the centres.
    pub fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    pub fn bytes(&self) -> u64 {
        bytes_of(self.centres.len() as f64, self.least.len() as f64) as u64
    }
}
