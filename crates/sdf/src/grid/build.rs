//! Filling the grid: distances in the band, signs, bounds beyond.

use super::nodes::Nodes;
use super::{DistanceGrid, GridError, GridOptions, far, sign};
use crate::mesh::{Mesh, MeshError, Report, Verdict};
use crate::tree::Tree;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Share of the progress that the distances in the band take.
const BAND_SHARE: f64 = 0.8;
/// Nodes in a row that are asked together whether the surface is near.
const BLOCK: usize = 8;

impl DistanceGrid {
    /// Builds the grid around a mesh, on the threads of the current rayon pool; the result has the same
    /// bits for any number of threads.
    ///
    /// The mesh is welded and oriented first. Holes are closed by a cone from their rim to its middle,
    /// inside is where the winding number of the closed mesh is not zero. `progress` is called with numbers from 0 to 1, from any thread.
    ///
    /// # Errors
    /// Options that do not fit each other, a grid that is too large (with the cell that fits), an
    /// open sheet without a thickness, and what [`Mesh::check`] refuses.
    pub fn build(
        mesh: &Mesh,
        options: &GridOptions,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, GridError> {
        check(options)?;
        mesh.check()?;
        if options.thickness.is_none() && Report::of(mesh).verdict == Verdict::OpenSheet {
            return Err(GridError::NoInside);
        }
        let (mesh, _) = mesh.repaired();
        Self::fill(mesh, options, progress)
    }

    /// A grid of so many cells along the longest side, for bounds only. The mesh is repaired already.
    pub(crate) fn coarse(
        mesh: &Mesh,
        thickness: Option<f64>,
        cells: f64,
    ) -> Result<Self, GridError> {
        let [low, high] = mesh.bounds();
        let cell = (high - low).max_element() / cells;
        let options = GridOptions {
            thickness,
            ..GridOptions::new(cell, 2.0 * cell)
        };
        Self::fill(mesh.clone(), &options, &|_| ())
    }

    fn fill(
        mesh: Mesh,
        options: &GridOptions,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, GridError> {
        let half_wall = 0.5 * options.thickness.unwrap_or(0.0);
        let band = options.band + half_wall;
        let nodes = Nodes::around(mesh.bounds(), band, options)?;
        progress(0.0);
        let (values, squared) = if options.thickness.is_some() {
            let tree = Tree::new(&mesh).ok_or(MeshError::Empty)?;
            let values = distances(&nodes, &tree, band, progress);
            let squared = far::squared_cells(&nodes, &values);
            (values, squared)
        } else {
            let (winding, closed) = mesh.capped(0.5 * options.cell);
            let tree = Tree::new(&closed).ok_or(MeshError::Empty)?;
            let mut values = distances(&nodes, &tree, band, progress);
            let squared = far::squared_cells(&nodes, &values);
            sign::give_signs(&nodes, &mut values, &winding);
            (values, squared)
        };
        let values = far::bounded(&nodes, values, &squared, band, half_wall);
        let grid = Self::from_parts(nodes, values, *options, mesh);
        progress(1.0);
        grid
    }
}

/// Refuses lengths that are no lengths or do not fit each other.
pub(super) fn check(options: &GridOptions) -> Result<(), GridError> {
    let GridOptions {
        cell,
        band,
        thickness,
        ..
    } = *options;
    if !(cell.is_finite() && cell > 0.0) {
        return Err(GridError::Cell { cell });
    }
    // A user who writes 2 cells means 2 cells, whatever the last digit.
    let least = |cells: f64| cells * cell * (1.0 - 1e-9);
    if !(band.is_finite() && band >= least(2.0)) {
        return Err(GridError::Band { band, cell });
    }
    match thickness {
        Some(thickness) if !(thickness.is_finite() && thickness >= least(4.0)) => {
            Err(GridError::Thickness { thickness, cell })
        }
        _ => Ok(()),
    }
}

/// Unsigned distances up to `band`, infinity beyond. Each row of nodes is one piece of work.
fn distances(nodes: &Nodes, tree: &Tree, band: f64, progress: &(dyn Fn(f64) + Sync)) -> Vec<f32> {
    let mut values = vec![f32::INFINITY; nodes.count()];
    let (nx, ny) = (nodes.counts[0], nodes.counts[1]);
    let rows = values.len() / nx;
    let (done, each) = (AtomicUsize::new(0), (rows / 100).max(1));
    values
        .par_chunks_mut(nx)
        .enumerate()
        .for_each(|(row, values)| {
            for (block, values) in values.chunks_mut(BLOCK).enumerate() {
                let node = |i: usize| nodes.place([block * BLOCK + i, row % ny, row / ny]);
                // Most of the grid is far from the surface: one question settles a whole block.
                let half = 0.5 * (values.len() - 1) as f64 * nodes.cell;
                let middle = 0.5 * (node(0) + node(values.len() - 1));
                let mut most = match tree.closest(middle, (band + half) * (1.0 + 1e-9)) {
                    None => continue,
                    Some(found) => {
                        band.min(((found.point - middle).length() + half) * (1.0 + 1e-9))
                    }
                };
                for (i, value) in values.iter_mut().enumerate() {
                    let x = node(i);
                    let found = tree.closest(x, most).map(|c| (c.point - x).length());
                    if let Some(distance) = found {
                        *value = distance as f32;
                    }
                    // The next node is one cell on, so the surface is at most that much further away.
                    most = found.map_or(band, |d| band.min((d + nodes.cell) * (1.0 + 1e-9)));
                }
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            if done.is_multiple_of(each) {
                progress(BAND_SHARE * done as f64 / rows as f64);
            }
        });
    values
}
