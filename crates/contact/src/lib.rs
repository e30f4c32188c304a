//! Contact laws: how two grains, or a grain and a wall, push each other.
//!
//! [`Repulsion`] is the exemplar: read `repulsion.rs` first, copy its shape for a new law, and enrol
//! the law in the conformance suite with one line of [`testing`]. [`SpringDashpot`] is the one to copy for
//! grains that turn and contacts that remember.
//!
//! ```
//! use tsubu_contact::Repulsion;
//! // Paper A's coke: diameter 1.350 mm, E = 3.096 GPa.
//! let coke = Repulsion::from_young_modulus(3.096e9, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
//! assert!((coke.epsilon / 9.434e-2 - 1.0).abs() < 3e-4);   // the paper prints 9.434e-2 J
//! ```

mod body_law;
mod hertz_mindlin;
mod per_pair;
mod repulsion;
pub mod restitution;
mod spring_dashpot;
mod tangential;
pub mod testing;
mod wall;
mod wall_grains;

pub use body_law::{BodyLaw, BodyPair};
pub use hertz_mindlin::{
    Bristle, Elastic, Freely, HertzMindlin, HertzMindlinPair, Resistance, Resisted, Rolling,
    rayleigh_time,
};
pub use per_pair::PerPair;
pub use repulsion::{Damping, Isotropic, PerDirection, Repulsion, RepulsionPair};
pub use spring_dashpot::{Normal, Slip, SpringDashpot, SpringDashpotPair, Stretch, Tension};
pub use wall::{RepulsiveWall, RepulsiveWallPair};
pub use wall_grains::WallGrains;
