//! Pictures without a display, a GPU or a system font: plots, shaded grains, animations.
//!
//! The crate knows nothing of the other crates of the workspace: plain slices go in, files come out.
//! [`plot`] draws measured values beside theory, [`grains`] draws spheres and walls, [`animation`] strings such images together.
//!
//! ```
//! use tsubu_picture::Figure;
//!
//! let impact_speed = [0.1, 0.2, 0.3];
//! let figure = Figure::new("Rebound", "impact speed (m/s)", "restitution (–)")
//!     .theory("theory", &impact_speed, &[0.9, 0.9, 0.9])
//!     .points("simulation", &impact_speed, &[0.899, 0.901, 0.9], Some(&[0.002; 3]))
//!     .caption("tsubu run rebound.ron");
//! assert!(figure.svg().contains("impact speed (m/s)"));
//! ```
#![forbid(unsafe_code)]

pub mod animation;
pub mod colour;
pub mod error;
pub mod grains;
pub mod image;
pub mod plot;
mod text;
mod whole;

pub use animation::Animation;
pub use error::PictureError;
pub use grains::{Camera, Quad, Radii, Scene3, Segment, View};
pub use image::Image;
pub use plot::Figure;
