//! Scene files: RON text with units in, a checked scene in plain SI numbers out.
//!
//! The way of a scene through this crate:
//!
//! 1. [`Source`] holds the text, and the `--set path=value` overrides laid over it;
//! 2. the raw scene (private, serde) mirrors the text field by field, units already read;
//! 3. [`Source::check`] asks what a single field cannot know and gives a [`Checked`] scene;
//! 4. later stages report their own trouble at a field of the text with [`Checked::problem`].
//!
//! Every trouble is a [`SceneError`] with the file, the line, the column, what is wrong and what to do.
//! Nothing in a scene is silently ignored: a field is used, or it is refused.
//!
//! ```
//! let text = r#"(
//!     title: "Two grains",
//!     grains: (
//!         diameter: "1.35 mm",
//!         density: "1370 kg/m3",
//!         law: Repulsion(stiffness: YoungModulus("3.096 GPa"), damping: Equal("0.1257 kg/s")),
//!     ),
//!     initial: (grains: [(at: ("0 mm", "0 mm", "0 mm")), (at: ("2 mm", "0 mm", "0 mm"))]),
//!     time: (step: PerPeriod(20), until: "1 s"),
//! )"#;
//! let mut source = tsubu_scene::Source::from_text("two.ron", text);
//! source.set("time.until=20 ms")?;
//! let scene = source.check()?.scene;
//! assert_eq!(scene.grains.diameter, 0.00135);
//! assert_eq!(scene.time.end, tsubu_scene::End::Until(0.020));
//! # Ok::<(), tsubu_scene::SceneError>(())
//! ```

mod check;
mod error;
mod grain_file;
mod path;
mod pieces;
mod quantity;
mod raw;
mod resolved;
mod ron_trouble;
mod rules;
mod scan;
mod scene;
mod set;
mod source;
mod start;
pub mod testing;
pub mod units;

pub use check::Checked;
pub use error::SceneError;
pub use grain_file::GrainFile;
pub use scene::{
    Axis, Bed, BedMeasure, Begin, CoarseRule, Conveying, Course, Damping, Datum, Discharge, Domain,
    End, Fate, Fill, Flow, FlowProfile, Grains, Hand, HertzMindlin, Initial, Inlet, Integrator,
    Law, Material, Measures, MeshFile, MeshSurface, Motion, NormalForce, Opening, Outlet, Output,
    PairOf, Population, Region, Removal, Resistance, RollingResistance, Scene, Shape, Shift, Slip,
    SoftenedDamping, Space, SpringConstants, SpringDashpot, StartingGrain, Step, Stiffness, Still,
    Tension, Thin, Time, TouchesAt, Turbulence, Turn, Wall, Water,
};
pub use source::Source;
