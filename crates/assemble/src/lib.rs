//! Checked scene in, running simulation out: the one place where a run-time choice becomes a type.
//!
//! [`constants`](Constants) turns the scene's grains into the law, the kind and the step that run
//! (softened, coarsened); [`build`] places the grains, picks the types and returns a
//! [`Simulation`]; [`Plan`] says what is modelled, what is not and how far Δt is from its limits.
//!
//! ```
//! let text = r#"(
//!     title: "Two grains meet",
//!     gravity: "0 m/s2",
//!     grains: (
//!         diameter: "1.35 mm", density: "1370 kg/m3",
//!         law: Repulsion(stiffness: YoungModulus("3.096 GPa"), damping: Equal("0.1257 kg/s")),
//!     ),
//!     initial: (grains: [
//!         (at: ("0 mm", "0 mm", "0 mm"), velocity: ("1 m/s", "0 m/s", "0 m/s")),
//!         (at: ("1.4 mm", "0 mm", "0 mm")),
//!     ]),
//!     time: (step: PerPeriod(200), until: "0.2 ms"),
//! )"#;
//! let scene = tsubu_scene::Source::from_text("two.ron", text).check()?;
//! let mut run = tsubu_assemble::build(&scene, &Default::default())?.simulation;
//! while !run.is_over() {
//!     run.advance(u64::MAX);
//! }
//! let velocities: Vec<f32> = run.snapshot().grains.iter().map(|g| g.velocity[0]).collect();
//! // Equal masses, restitution 0.897: (1 − e)/2 and (1 + e)/2.
//! assert!((velocities[0] - 0.0515).abs() < 2e-3 && (velocities[1] - 0.9485).abs() < 2e-3);
//! # Ok::<(), tsubu_scene::SceneError>(())
//! ```

mod bed;
mod books;
mod build;
mod constants;
mod fill;
mod flow;
mod gate;
mod grain;
mod in_box;
mod law;
mod observers;
mod plan;
mod simulation;
mod start;
mod surfaces;
mod wall_grains;
mod water;

pub use build::{Built, Choices, Hearer, Watch, build, threads_that_pay};
pub use constants::Constants;
pub use law::{Law, OfHertz, OfRepulsion, OfSprings};
pub use plan::{LimitLine, Plan};
pub use simulation::{Count, Grain, Machine, Moment, Simulation, Snapshot, Stop};
pub use wall_grains::wall_grains;
