//! Why a body of grains is not built.

use super::GrainBodyOptions;
use super::cells::{bytes_of, cell_edge};
use crate::mesh::MeshError;
use crate::solid::Misshapen;
use glam::DVec3;
use std::fmt;

/// What is wrong with the wish for a body of grains.
#[derive(Clone, Debug, PartialEq)]
pub enum GrainBodyError {
    /// The mesh itself.
    Mesh(MeshError),
    /// A length that is none, or more places than can be tried.
    Fill(Misshapen),
    /// The mesh holds no grain of this radius.
    NoGrain {
        /// Radius of a wall grain in m.
        radius: f64,
        /// The sides of the mesh's box in m.
        size: DVec3,
    },
    /// Wall grains and cells would take more memory than allowed.
    TooLarge {
        /// Radius of a wall grain in m.
        radius: f64,
        /// Bytes that they would take.
        bytes: f64,
        /// Bytes allowed.
        most_bytes: u64,
        /// A radius in m with which they fit.
        fits: f64,
    },
}

impl fmt::Display for GrainBodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mesh(error) => write!(f, "{error}"),
            Self::Fill(error) => write!(f, "{error}"),
            Self::NoGrain { radius, size } => {
                let [x, y, z] = (*size * 1e3).to_array();
                write!(
                    f,
                    "the mesh of {x:.1} × {y:.1} × {z:.1} mm holds no grain of {:.4} mm radius",
                    radius * 1e3
                )
            }
            Self::TooLarge {
                radius,
                bytes,
                most_bytes,
                fits,
            } => write!(
                f,
                "wall grains of {:.4} mm radius would take {:.3} GB, {:.3} GB are allowed; {:.4} mm fits",
                radius * 1e3,
                bytes * 1e-9,
                *most_bytes as f64 * 1e-9,
                fits * 1e3
            ),
        }
    }
}

impl std::error::Error for GrainBodyError {}

impl From<MeshError> for GrainBodyError {
    fn from(error: MeshError) -> Self {
        Self::Mesh(error)
    }
}

impl From<Misshapen> for GrainBodyError {
    fn from(error: Misshapen) -> Self {
        Self::Fill(error)
    }
}

/// Refuses what would not fit into memory before anything is built.
///
/// A body of volume V (m³) holds V/(4√2 rs³) wall grains if it is much larger than one, fewer else.
pub(super) fn refuse_too_large(
    [low, high]: [DVec3; 2],
    volume: f64,
    options: &GrainBodyOptions,
) -> Result<(), GrainBodyError> {
    let bytes = |radius: f64| {
        let grains = volume / (4.0 * std::f64::consts::SQRT_2 * radius.powi(3));
        let margin = 2.0 * (options.reach + radius);
        let cells = ((high - low + margin) / cell_edge(radius, options.reach)).ceil() + DVec3::ONE;
        bytes_of(grains, cells.element_product())
    };
    let most = (options.most_bytes as f64).min(bytes_of(0.0, u32::MAX as f64));
    let wanted = bytes(options.radius);
    if wanted <= most {
        return Ok(());
    }
    let mut fits = options.radius;
    while bytes(fits) > most && fits.is_finite() {
        fits *= 1.01;
    }
    Err(GrainBodyError::TooLarge {
        radius: options.radius,
        bytes: wanted,
        most_bytes: options.most_bytes,
        fits,
    })
}
