//! Trouble, read outside the loop.

/// x, y, z in m.
pub type Place = [f64; 3];

/// Whether the numbers are still physics.
#[derive(Clone, Debug, PartialEq)]
pub enum Health {
    /// Nothing to report.
    Fine,
    /// A grain's velocity is not a number, or it crosses half a diameter in one step.
    Runaway {
        /// Identity of the grain.
        grain: u32,
        /// Where it is, x y z in m.
        place: Place,
        /// Its speed in m/s (may be NaN).
        speed: f64,
        /// When, in s.
        time: f64,
    },
    /// Two grains overlap by more than the laws are made for.
    DeepOverlap {
        /// Identity of one grain.
        grain: u32,
        /// Identity of the other.
        partner: u32,
        /// Where, x y z in m.
        place: Place,
        /// Overlap over the range of the law.
        share: f64,
        /// When, in s.
        time: f64,
    },
}

impl Health {
    /// True if the run may go on.
    pub fn is_fine(&self) -> bool {
        *self == Health::Fine
    }
}
