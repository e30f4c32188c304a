//! How often a grain was renormalised.

use std::fmt;

/// A coarse level: n renormalisations, each doubling the diameter. n = 0 is the real grain.
///
/// ```
/// assert_eq!(tsubu_coarsen::Level::new(3).lambda(), 8.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Level {
    n: u32,
}

impl Level {
    /// n renormalisations.
    pub fn new(n: u32) -> Self {
        Self { n }
    }

    /// n.
    pub fn n(self) -> u32 {
        self.n
    }

    /// λ = 2ⁿ: diameter of the coarse grain over that of the real one.
    pub fn lambda(self) -> f64 {
        f64::from(self.n).exp2()
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "n = {}", self.n)
    }
}
