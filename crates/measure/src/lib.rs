//! Measures: what a running simulation is asked, and how the answer is computed.
//!
//! Read in this order: [`Deposit`] (which grains count, and how densely they lie), [`Profile`] (the
//! height of a deposit along x), [`slope`] (crest, front, two angles of repose), and the observers
//! [`Heap`], [`Energy`], [`Structure`], [`Balance`]. For conveying: [`Blocked`] and [`Steady`] (the mean of a
//! correlated series and where it becomes steady), [`screw`] (the theory), [`Conveying`]. For a bed
//! under water: [`BedLoad`]. Nothing here changes a simulation.
//!
//! Grains that no force moves (infinite mass: a fixed row, driven grains) are in no sum of mass, momentum, weight or
//! energy, and no part of a deposit.
//!
//! Lengths in m, angles in degrees, uncertainties one standard deviation. The x axis is level, z is up.
//!
//! ```
//! use tsubu_measure::{Profile, slope::{Stand, flank_angle}};
//! // A flank that falls 4 m over 10 m: atan 0.4 = 21.80°.
//! let x: Vec<f64> = (0..30).map(|i| i as f64 + 0.5).collect();
//! let height: Vec<f64> = x.iter().map(|x| (10.0 - 0.4 * x).max(0.0)).collect();
//! let profile = Profile { x, height, bin: 1.0, bulk_fraction: 0.6, bulk_uncertainty: 0.0 };
//! let stand = Stand { diameter: 1.0, back: 0.0, far: None };
//! assert!((flank_angle(&profile, &stand).value - 21.80).abs() < 0.01);
//! ```

mod balance;
mod bed_carried;
mod bed_load;
mod blocks;
mod conveyed;
mod conveying;
mod deposit;
mod discharge;
mod energy;
mod fit;
mod flow;
mod free;
mod heap;
mod loads;
mod profile;
pub mod screw;
mod section;
mod slices;
pub mod slope;
mod structure;

pub use balance::Balance;
pub use bed_load::{BedLoad, BedLoadOptions};
pub use blocks::{Blocked, Steady};
pub use conveying::{Conveying, ConveyingOptions};
pub use deposit::Deposit;
pub use discharge::{Discharge, DischargeOptions, Opening};
pub use energy::Energy;
pub use fit::Line;
pub use flow::Flow;
pub use heap::{Heap, HeapOptions};
pub use loads::Loads;
pub use profile::{Profile, ProfileOptions};
pub use slices::Slices;
pub use structure::Structure;
