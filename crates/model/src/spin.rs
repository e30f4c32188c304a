//! Whether grains turn: [`Still`] grains store no spin at all. Spinning grains come with the first law that has torque.

use crate::Dim;
use std::fmt::Debug;

/// Nothing, as a value: what a still grain stores of its spin and feels as torque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nothing;

/// Whether grains turn, as a type. One shape serves angular velocity and torque.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say whether grains turn",
    note = "use `Still` for grains without spin"
)]
pub trait SpinState: Copy + Debug + Default + Send + Sync + 'static {
    /// Angular velocity (rad/s) or torque (N m) of one grain.
    type Turn<D: Dim>: Copy + Debug + Default + Send + Sync + 'static;
}

/// Grains without spin: they store none and a law that needs torque does not accept them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Still;

impl SpinState for Still {
    type Turn<D: Dim> = Nothing;
}
