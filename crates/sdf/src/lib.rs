//! Surfaces as signed distances: positive outside the body, negative inside.
//!
//! ```
//! use glam::DVec3;
//! use tsubu_model::{Space, Surface};
//! use tsubu_sdf::HalfSpace;
//! let floor = HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z);
//! assert_eq!(floor.lower_bound(DVec3::new(5.0, 1.0, 0.25)), 0.25);
//! ```

mod axis;
mod ball;
mod cavity;
mod cuboid;
mod drawing;
mod half_space;
mod lattice;
mod profile;
mod round;
mod screw;
mod solid;
pub mod testing;
mod torus;

pub use ball::Ball;
pub use cavity::Cavity;
pub use cuboid::Cuboid;
pub use drawing::{steps_for, volume};
pub use half_space::HalfSpace;
pub use lattice::{Thin, fill_fcc};
pub use round::{Cone, Cylinder, HollowCone, Tube};
pub use screw::{Hand, Screw, ScrewSize};
pub use solid::{Misshapen, Solid};
pub use torus::Torus;
