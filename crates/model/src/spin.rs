//! Whether grains turn: [`Still`] grains store no spin at all, [`Spins`] those of their dimension.

use crate::{Dim, Vector};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Whether grains turn, as a type. One shape serves angular velocity and torque.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say whether grains turn",
    note = "use `Still` for grains without spin, `Spins` for grains with"
)]
pub trait SpinState: Copy + Debug + Default + Send + Sync + 'static {
    /// Angular velocity (rad/s) or torque (N m) of one grain.
    type Turn<D: Dim>: Vector;
    /// The three-dimensional axial vector of it.
    fn to_space<D: Dim>(turn: Self::Turn<D>) -> glam::DVec3;
    /// The part of an axial vector of space that a grain can have.
    fn from_space<D: Dim>(turn: glam::DVec3) -> Self::Turn<D>;
    /// n × turn: what the spins, r_i ω_i + r_j ω_j in m/s, add to the velocity of the contact; n points to this grain.
    fn at_contact<D: Dim>(n: D::V, turn: Self::Turn<D>) -> D::V;
    /// −n × force: the torque of a force at the contact over the radius, in N.
    fn twist<D: Dim>(n: D::V, force: D::V) -> Self::Turn<D>;
}

/// Grains without spin: they store none and a law that needs torque does not accept them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Still;

/// Grains that turn: one number in the plane, three in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spins;

impl SpinState for Still {
    type Turn<D: Dim> = Nothing;
    fn to_space<D: Dim>(_turn: Nothing) -> glam::DVec3 {
        glam::DVec3::ZERO
    }
    fn from_space<D: Dim>(_turn: glam::DVec3) -> Nothing {
        Nothing
    }
    #[inline(always)]
    fn at_contact<D: Dim>(_n: D::V, _turn: Nothing) -> D::V {
        D::V::ZERO
    }
    #[inline(always)]
    fn twist<D: Dim>(_n: D::V, _force: D::V) -> Nothing {
        Nothing
    }
}

impl SpinState for Spins {
    type Turn<D: Dim> = D::W;
    fn to_space<D: Dim>(turn: D::W) -> glam::DVec3 {
        D::spin_to_space(turn)
    }
    fn from_space<D: Dim>(turn: glam::DVec3) -> D::W {
        D::spin_from_space(turn)
    }
    #[inline(always)]
    fn at_contact<D: Dim>(n: D::V, turn: D::W) -> D::V {
        -D::turned(turn, n)
    }
    #[inline(always)]
    fn twist<D: Dim>(n: D::V, force: D::V) -> D::W {
        -D::moment(n, force)
    }
}

/// Nothing, as a value: what a still grain stores of its spin and feels as torque. It calculates like a vector of no coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nothing;

impl Vector for Nothing {
    const AXES: usize = 0;
    const ZERO: Self = Nothing;
    #[inline(always)]
    fn axis(self, _axis: usize) -> f64 {
        0.0
    }
    #[inline(always)]
    fn from_axes(_coordinate: impl FnMut(usize) -> f64) -> Self {
        Nothing
    }
    #[inline(always)]
    fn dot(self, _other: Self) -> f64 {
        0.0
    }
}

impl Add for Nothing {
    type Output = Self;
    #[inline(always)]
    fn add(self, _other: Self) -> Self {
        Nothing
    }
}

impl Sub for Nothing {
    type Output = Self;
    #[inline(always)]
    fn sub(self, _other: Self) -> Self {
        Nothing
    }
}

impl Neg for Nothing {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Nothing
    }
}

impl Mul<f64> for Nothing {
    type Output = Self;
    #[inline(always)]
    fn mul(self, _factor: f64) -> Self {
        Nothing
    }
}

impl AddAssign for Nothing {
    #[inline(always)]
    fn add_assign(&mut self, _other: Self) {}
}
