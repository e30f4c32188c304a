//! Who may touch whom: grains sorted into cells, and full lists of the partners within reach plus a skin.
//!
//! A list holds each pair from both sides, in blocks of eight that hold one partner each of eight grains, so that the
//! force loop gathers, never scatters, and gives the same bits for any number of threads.
//! The lists stay right until some grain has moved by half the skin. What contacts remember lies beside a list in the
//! same blocks and is carried into the next one by the identity of the partner.
//!
//! ```
//! use glam::DVec3;
//! use tsubu_model::{Domain, Space};
//! use tsubu_neighbors::{CellGrid, ChunkList};
//! let x = [DVec3::ZERO, DVec3::X, DVec3::new(9.0, 0.0, 0.0)];
//! let domain = Domain::<Space> { period: DVec3::new(10.0, f64::INFINITY, f64::INFINITY) };
//! let grid = CellGrid::new(&domain, x.len(), |i| x[i], 1.5);
//! let mut list = ChunkList::default();
//! list.build(&grid, &domain, 0..3, |i| x[i], 1.5, 3);
//! let mut of_first: Vec<usize> = list.iter().filter(|e| e.0 == 0).map(|e| e.1).collect();
//! of_first.sort();
//! assert_eq!(of_first, [1, 2]);   // the third through the periodic boundary
//! ```

mod cells;
mod halo;
mod list;
mod memory;
mod reorder;

pub use cells::CellGrid;
pub use list::{ChunkList, Group, LANES};
pub use memory::{ChunkMemory, Eight, Kept};
pub use reorder::Reorder;
