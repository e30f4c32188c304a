//! Why a distance grid is not built or not loaded.

use crate::mesh::MeshError;
use std::fmt;

/// What is wrong with the wish for a grid, or with a stored one.
#[derive(Clone, Debug, PartialEq)]
pub enum GridError {
    /// The mesh itself.
    Mesh(MeshError),
    /// The cell is not a positive finite length.
    Cell {
        /// The value given, in m.
        cell: f64,
    },
    /// The band is under two cells.
    Band {
        /// The value given, in m.
        band: f64,
        /// The cell in m.
        cell: f64,
    },
    /// The wall is under four cells thick.
    Thickness {
        /// The value given, in m.
        thickness: f64,
        /// The cell in m.
        cell: f64,
    },
    /// The mesh is an open sheet and no thickness is given.
    NoInside,
    /// The grid would be larger than allowed.
    TooLarge {
        /// Bytes it would take.
        bytes: f64,
        /// Bytes allowed.
        most_bytes: u64,
        /// A cell in m with which it fits.
        cell: f64,
    },
    /// A stored grid is damaged, foreign or of another version.
    Stored {
        /// What does not fit.
        reason: &'static str,
    },
}

impl fmt::Display for GridError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mesh(error) => write!(f, "{error}"),
            Self::Cell { cell } => write!(
                f,
                "the grid cell is {cell} m; give a positive length, a quarter of the thinnest part"
            ),
            Self::Band { band, cell } => write!(
                f,
                "the band is {band} m, under two cells of {cell} m; give the reach of the grains and two cells, or a smaller cell"
            ),
            Self::Thickness { thickness, cell } => write!(
                f,
                "a wall of {thickness} m is under four cells of {cell} m thick; give a cell of {} m or a thicker wall",
                0.25 * thickness
            ),
            Self::NoInside => write!(
                f,
                "the mesh is an open sheet: it has no inside; give it a thickness to make it a wall"
            ),
            Self::TooLarge {
                bytes,
                most_bytes,
                cell,
            } => write!(
                f,
                "the grid would take {:.3} GB, {:.3} GB are allowed; a cell of {:.4} mm fits",
                bytes * 1e-9,
                *most_bytes as f64 * 1e-9,
                cell * 1e3
            ),
            Self::Stored { reason } => write!(
                f,
                "the stored distance grid cannot be used: {reason}; delete it, it is built again"
            ),
        }
    }
}

impl std::error::Error for GridError {}

impl From<MeshError> for GridError {
    fn from(error: MeshError) -> Self {
        Self::Mesh(error)
    }
}
