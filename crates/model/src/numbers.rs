//! A fixed count of numbers: what a law remembers of a contact.

use std::fmt::Debug;

/// A fixed count of `f64`. A law without memory uses `[f64; 0]`, which stores nothing.
pub trait Numbers: Copy + Debug + Send + Sync + 'static {
    /// How many.
    const N: usize;
    /// All zero: a contact that has just begun.
    fn zero() -> Self;
    /// As a slice.
    fn values(&self) -> &[f64];
    /// As a slice to write.
    fn values_mut(&mut self) -> &mut [f64];
}

impl<const M: usize> Numbers for [f64; M] {
    const N: usize = M;
    fn zero() -> Self {
        [0.0; M]
    }
    fn values(&self) -> &[f64] {
        self
    }
    fn values_mut(&mut self) -> &mut [f64] {
        self
    }
}
