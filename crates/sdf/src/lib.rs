//! Surfaces as signed distances: positive outside the body, negative inside.
//!
//! ```
//! use glam::DVec3;
//! use tsubu_model::{Space, Surface};
//! use tsubu_sdf::HalfSpace;
//! let floor = HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z);
//! assert_eq!(floor.lower_bound(DVec3::new(5.0, 1.0, 0.25)), 0.25);
//! ```

mod half_space;

pub use half_space::HalfSpace;
