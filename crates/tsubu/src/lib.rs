//! tsubu (粒, a grain): granular physics for people who design machines and study rivers.
//!
//! The command `tsubu` runs scene files; this library is one door to the crates behind it.
//! Each crate is usable alone: take `tsubu-contact` for the laws, `tsubu-engine` to step them.
//!
//! A scene, run from a program:
//!
//! ```
//! use tsubu::assemble::{Choices, build};
//! use tsubu::scene::Source;
//!
//! let text = r#"(
//!     title: "A grain falls on a floor",
//!     grains: (
//!         diameter: "1.35 mm", density: "1370 kg/m3",
//!         law: Repulsion(stiffness: YoungModulus("31 MPa"), damping: Equal("0.0126 kg/s")),
//!     ),
//!     walls: [(name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (0, 0, 1)), restitution: 0.5)],
//!     initial: (grains: [(at: ("0 mm", "0 mm", "10 mm"))]),
//!     time: (step: PerPeriod(40), until: "60 ms"),
//! )"#;
//! let scene = Source::from_text("fall.ron", text).check()?;
//! let mut run = build(&scene, &Choices::default())?.simulation;
//! let mut highest_speed = 0.0f32;
//! while !run.is_over() {
//!     run.advance(50);
//!     highest_speed = highest_speed.max(run.snapshot().grains[0].velocity[2].abs());
//! }
//! // v = √(2 g h) with h = 10 mm − d/2.
//! assert!((highest_speed - (2.0f32 * 9.80665 * (0.010 - 0.000675)).sqrt()).abs() < 0.01);
//! # Ok::<(), tsubu::scene::SceneError>(())
//! ```

pub mod dump;
pub mod export;

pub use tsubu_assemble as assemble;
pub use tsubu_coarsen as coarsen;
pub use tsubu_contact as contact;
pub use tsubu_engine as engine;
pub use tsubu_integrate as integrate;
pub use tsubu_measure as measure;
pub use tsubu_model as model;
pub use tsubu_picture as picture;
pub use tsubu_record as record;
pub use tsubu_scene as scene;
pub use tsubu_sdf as sdf;
