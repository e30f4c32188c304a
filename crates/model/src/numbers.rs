//! A fixed count of numbers: what a law remembers of a contact.

use std::fmt::Debug;

/// A fixed count of `f64`. A law without memory uses `[f64; 0]`, which stores nothing.
pub trait Numbers: Copy + Debug + Send + Sync + 'static {
    /// How many, at most [`MOST_NUMBERS`].
    const N: usize;
    /// All zero: a contact that has just begun.
    fn zero() -> Self;
    /// Number `k`.
    fn get(&self, k: usize) -> f64;
    /// Sets number `k`.
    fn set(&mut self, k: usize, value: f64);
}

/// The most that a law may remember of a contact.
pub const MOST_NUMBERS: usize = 8;

impl<const M: usize> Numbers for [f64; M] {
    const N: usize = M;
    #[inline(always)]
    fn zero() -> Self {
        [0.0; M]
    }
    #[inline(always)]
    fn get(&self, k: usize) -> f64 {
        self[k]
    }
    #[inline(always)]
    fn set(&mut self, k: usize, value: f64) {
        self[k] = value;
    }
}
