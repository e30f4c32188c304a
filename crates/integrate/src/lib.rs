//! One step of time: five schemes, what each does with the damping, and where each is stable.
//!
//! A step is the same for all of them: perhaps a half kick and a drift, the forces, perhaps a few
//! sweeps of a linear solve, a kick, perhaps a drift. [`Scheme`] says which parts are there and
//! how long; the engine walks through them, so nothing here knows about neighbours or threads.
//!
//! ```
//! use tsubu_integrate::Scheme;
//! let limit = Scheme::SymplecticEuler.limit();
//! // One contact with K = kΔt²/m and C = ηΔt/m is stable while K + 2C < 4.
//! assert!(limit.is_stable(3.9, 0.0) && !limit.is_stable(3.0, 0.6));
//! ```

mod limit;
mod scheme;
mod solve;

pub use limit::{Limit, Packing};
pub use scheme::{Drift, Scheme};
pub use solve::{correction, relative_mode_gain};
