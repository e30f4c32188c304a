//! Water over a bed of grains: how it flows, how it pushes a grain, and how much it carries.
//!
//! One way and clear: the water acts on grains by drag, and grains do not act on the water. Mean flow, turbulence and
//! sheltering are functions of the height above the bed alone, so the water costs no grid and no equation to solve.
//!
//! ```
//! use glam::DVec2;
//! use tsubu_model::Plane;
//! use tsubu_stream::{Grains, Sediment, Setting, Stream, Turbulence};
//! // Paper B's grain, 0.5 mm of quartz, at τ* = 0.05 in the mean flow.
//! let sand = Sediment::quartz(0.5e-3);
//! let mut setting = Setting::over_grains(sand.diameter, 0.0, 1);
//! let u = setting.water.friction_velocity(&sand, 0.05)?;
//! setting.friction_velocity = tsubu_stream::Table::constant(u);
//! setting.turbulence = Turbulence::none();
//! let grain = setting.water.grain(&sand)?;                    // mass with added mass, weight under water
//! let mut water = Stream::new(setting)?;
//!
//! // A level bed whose centres lie at 5 mm: height and number of contacts of each grain.
//! water.renew(0.0, [(5e-3, 3), (5e-3, 4)].into_iter())?;
//! // A grain that lies half a diameter higher feels 12.0 τ* = 0.60 of its submerged weight and moves if μ = 0.577.
//! let mut force = [DVec2::ZERO];
//! let exposed = Grains::<Plane> {
//!     position: &[DVec2::new(0.0, 5.25e-3)], velocity: &[DVec2::ZERO], identity: &[0], diameter: &[sand.diameter],
//! };
//! water.push(0.0, exposed, &mut force)?;
//! assert!((force[0].x / (grain.weight * 9.80665) - 12.0 * 0.05).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What can be chosen, and what the paper is silent about
//!
//! | choice | where | default |
//! |---|---|---|
//! | mean flow: rough-wall law or measured rows | [`Profile`] | the law, κ = 0.40, ksr = d, zero where its logarithm is |
//! | drive: u* steady or over time | [`Setting::friction_velocity`] | steady |
//! | fluctuations below the datum | [`FluctuationsBelow`] | none where the mean flow is zero, max(y, 0) in the exponential |
//! | who shares a draw | [`Draw`] | each grain its own |
//! | how often it is drawn | [`Turbulence::frequency`] | 50 Hz |
//! | shelter deep in the bed | [`ShelterBelow`] | ε0 |
//! | what belongs to the bed | [`Setting::bed_contacts`] | two contacts |
//! | when the datum is found | [`Datum`] | at every switch |
//! | mixtures | [`Setting::largest_diameter`], [`LogLaw`], [`Shelter`] | ksr and the datum's layer from the largest |
//!
//! # What is not here
//!
//! - *A tilt of gravity.* On a slope the engine's gravity is a tilted vector, and the bed stays level in the scene. The
//!   water's drive then is [`Water::friction_velocity_of_slope`]. How much of the weight's part along the slope
//!   buoyancy takes away is a question to settle where gravity is set, not here.
//! - *Coarse grains.* Drag grows as λ² and weight as λ³, so a coarse grain in water is lighter to move than the
//!   real ones it stands for. No rule is applied here.
//! - Lift, history forces, the water's own acceleration, viscosity (CD is one number), a free surface, turbulence that
//!   is correlated in space, and grains slowing the water down.
//!
//! # Cost
//!
//! `cargo run --release -p tsubu-stream --example cost` prints the time per grain: most of it is the draw, which grains
//! in standing water do not make.

mod bed;
mod current;
mod profile;
mod shelter;
mod stream;
mod table;
mod transport;
mod turbulence;
mod unphysical;
mod water;

pub use bed::{BED_CONTACTS, Bed, Datum, NoBed, bed_level};
pub use current::{Current, Grains};
pub use profile::{LogLaw, Profile};
pub use shelter::{Shelter, ShelterBelow};
pub use stream::{Setting, Stream};
pub use table::Table;
pub use transport::{TransportCurve, bed_load_rate};
pub use turbulence::{Draw, FluctuationsBelow, Turbulence};
pub use unphysical::Unphysical;
pub use water::{Sediment, Water};
