//! The words of granular physics that every tsubu crate speaks: dimension, spin, kind of grain,
//! contact, law, surface, observer. No input or output, no threads, no formula of any law.
//!
//! Layout is a type, formula is a value: what changes *what is stored* of a grain (dimension, spin,
//! one kind or several) is a type parameter here, so that a plane scene stores no third coordinate
//! and a scene without friction stores no spin.
//!
//! ```
//! use tsubu_model::{Dim, Kind, Space, Vector};
//! let grain = Kind::sphere(1.350e-3, 1370.0);              // diameter in m, density in kg/m³
//! assert!((grain.mass - 1.765e-6).abs() < 1e-9);           // kg, as physics of paper A's coke
//! let up = <Space as Dim>::from_space(glam::DVec3::Z);
//! assert_eq!(up.axis(2), 1.0);
//! ```

mod constants;
mod contact;
mod dim;
mod kind;
mod load;
mod mean;
mod motion;
mod numbers;
mod random;
mod saved;
mod spin;
mod surface;
mod view;

pub use constants::{Constants, Quantity};
pub use contact::{ContactLaw, Linear, Push, Touch};
pub use dim::{Dim, Domain, Plane, Space, Vector};
pub use kind::Kind;
pub use load::{Load, Seen};
pub use mean::mean_of_runs;
pub use motion::{Course, Motion, Pose, Shift, Span, Turn};
pub use numbers::{MOST_NUMBERS, Numbers};
pub use random::uniform;
pub use saved::{Damaged, Saved, Words};
pub use spin::{Nothing, SpinState, Spins, Still};
pub use surface::{Hit, HitBuffer, Shell, Surface};
pub use view::{
    BodyState, Change, Curve, Energies, Gate, Observer, Passage, Reading, TouchingPair, View,
};
