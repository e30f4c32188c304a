//! What a run writes: its folder, frames for ParaView, `series.csv`, `summary.json` and checkpoints.
//!
//! The crate takes plain slices and knows nothing of grains, laws or scenes.
//! Whatever it writes is whole: a file appears under its name only when all of it is on the disk,
//! and the one file that grows, `series.csv`, grows by one whole row at a time.
//!
//! ```
//! use tsubu_record::{Column, Frame, FrameWriter, RunFolder, SeriesWriter, Summary};
//!
//! # let place = std::env::temp_dir().join(format!("tsubu-record-doc-{}", std::process::id()));
//! let folder = RunFolder::create(Some(&place), "two_grains", false)?;
//!
//! let mut frames = FrameWriter::new(&folder)?;
//! frames.write(0.0, &Frame {
//!     points: &[[0.0, 0.0, 0.0], [0.002, 0.0, 0.0]],
//!     columns: &[
//!         ("radius", Column::Scalar(&[0.001, 0.001])),
//!         ("velocity", Column::Vector(&[[0.1, 0.0, 0.0], [-0.1, 0.0, 0.0]])),
//!         ("id", Column::Id(&[0, 1])),
//!     ],
//! })?;
//!
//! let mut series = SeriesWriter::create(&folder, &[("time", "s"), ("kinetic_energy", "J")])?;
//! series.row(&[0.0, 1.1e-7])?;
//!
//! let mut summary = Summary::new();
//! summary.text("scene", "two_grains");
//! summary.measured("angle_of_repose", 23.5, Some(0.4), "deg");
//! summary.table("series_units", series.units());
//! summary.write(&folder)?;
//!
//! assert!(folder.path("frames.pvd").exists());
//! # std::fs::remove_dir_all(&place).ok();
//! # Ok::<(), tsubu_record::RecordError>(())
//! ```

pub mod checkpoint;
pub mod error;
pub mod faces;
pub mod folder;
pub mod frames;
pub mod series;
pub mod summary;
pub mod unpack;
pub mod vtp;
pub mod whole;

#[cfg(test)]
mod scratch;

pub use checkpoint::{Checkpoint, Checkpoints, Newest, checksum};
pub use error::{Fault, RecordError};
pub use faces::Faces;
pub use folder::RunFolder;
pub use frames::{FrameWriter, frame_name};
pub use series::SeriesWriter;
pub use summary::Summary;
pub use unpack::{array_in, read_array};
pub use vtp::{Column, Frame};
pub use whole::write_whole;
