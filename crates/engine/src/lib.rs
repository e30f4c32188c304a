//! The engine: it owns the grains, their lists and the bodies, and takes one step after another.
//!
//! It names no law, no water, no mesh and no file format: those meet it through the traits of
//! `tsubu-model`. A step cannot fail; trouble is a [`Health`] read outside the loop.
//!
//! Read in this order: `line` (what the force loop reads of a grain), `pass` (the force loop),
//! `lanes` (the fenced vector module), `walls`, `near`, `forces`, `kick`, `turning`, `world` (one step), `sweeps`,
//! `rebuild`, `changes`, `elsewhere`, `pairs`, `look`, `modes`, `saved`.

mod changes;
mod chunk;
mod elsewhere;
mod forces;
mod health;
mod kick;
mod kinds;
mod lanes;
mod line;
mod look;
mod modes;
mod near;
mod pairs;
mod pass;
mod rebuild;
mod saved;
mod sweeps;
mod turning;
mod walls;
mod world;

pub use health::Health;
pub use kinds::{KindSet, ManyKinds, OneKind};
pub use lanes::Lanes;
pub use line::{Layout, Line};
pub use modes::Modes;
pub use walls::{Body, TouchesAt};
pub use world::{NoTally, Placed, Setup, Tally, WithTally, World};
