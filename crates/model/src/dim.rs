//! How many coordinates a grain has: [`Plane`] or [`Space`], and the box they live in.

use glam::{DVec2, DVec3};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// What the formulas need of a vector. Implemented for glam's `DVec2` and `DVec3`.
pub trait Vector:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
    + AddAssign
    + 'static
{
    /// Number of coordinates.
    const AXES: usize;
    /// The zero vector.
    const ZERO: Self;
    /// Coordinate number `axis`.
    fn axis(self, axis: usize) -> f64;
    /// A vector from its coordinates.
    fn from_axes(coordinate: impl FnMut(usize) -> f64) -> Self;
    /// Scalar product.
    fn dot(self, other: Self) -> f64;
    /// Square of the length.
    #[inline(always)]
    fn length_squared(self) -> f64 {
        self.dot(self)
    }
    /// Length.
    #[inline(always)]
    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
    /// True if no coordinate is NaN or infinite.
    fn is_finite(self) -> bool {
        (0..Self::AXES).all(|a| self.axis(a).is_finite())
    }
}

impl Vector for DVec2 {
    const AXES: usize = 2;
    const ZERO: Self = DVec2::ZERO;
    #[inline(always)]
    fn axis(self, axis: usize) -> f64 {
        if axis == 0 { self.x } else { self.y }
    }
    #[inline(always)]
    fn from_axes(mut coordinate: impl FnMut(usize) -> f64) -> Self {
        DVec2::new(coordinate(0), coordinate(1))
    }
    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }
}

impl Vector for DVec3 {
    const AXES: usize = 3;
    const ZERO: Self = DVec3::ZERO;
    #[inline(always)]
    fn axis(self, axis: usize) -> f64 {
        match axis {
            0 => self.x,
            1 => self.y,
            _ => self.z,
        }
    }
    #[inline(always)]
    fn from_axes(mut coordinate: impl FnMut(usize) -> f64) -> Self {
        DVec3::new(coordinate(0), coordinate(1), coordinate(2))
    }
    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
}

/// The dimension of a scene, as a type.
pub trait Dim: Copy + Debug + Default + Send + Sync + 'static {
    /// Positions, velocities, forces.
    type V: Vector;
    /// Angular velocity and torque: one number in the plane, a vector in space.
    type W: Copy + Debug + Default + Send + Sync + 'static;
    /// The axis that points up.
    const UP: usize;
    /// The three-dimensional place of a point: a plane scene lies in x–z at y = 0.
    fn to_space(v: Self::V) -> DVec3;
    /// The part of a three-dimensional vector that this dimension knows.
    fn from_space(v: DVec3) -> Self::V;
}

/// A vertical plane: coordinates x (level) and z (up), spheres one grain deep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane;

/// Three dimensions, z up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Space;

impl Dim for Plane {
    type V = DVec2;
    type W = f64;
    const UP: usize = 1;
    fn to_space(v: DVec2) -> DVec3 {
        DVec3::new(v.x, 0.0, v.y)
    }
    fn from_space(v: DVec3) -> DVec2 {
        DVec2::new(v.x, v.z)
    }
}

impl Dim for Space {
    type V = DVec3;
    type W = DVec3;
    const UP: usize = 2;
    fn to_space(v: DVec3) -> DVec3 {
        v
    }
    fn from_space(v: DVec3) -> DVec3 {
        v
    }
}

/// The box: for each axis the period in m, or infinity where the scene is open.
/// A periodic axis runs from 0 to its period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain<D: Dim> {
    /// Period of each axis in m; infinite = open.
    pub period: D::V,
}

impl<D: Dim> Domain<D> {
    /// Open in every direction.
    pub fn open() -> Self {
        Self {
            period: D::V::from_axes(|_| f64::INFINITY),
        }
    }

    /// True if the axis repeats.
    pub fn is_periodic(&self, axis: usize) -> bool {
        self.period.axis(axis).is_finite()
    }

    /// The point brought into `[0, period)` on the periodic axes.
    pub fn wrap(&self, x: D::V) -> D::V {
        D::V::from_axes(|a| {
            let (c, l) = (x.axis(a), self.period.axis(a));
            if !l.is_finite() {
                return c;
            }
            let w = c.rem_euclid(l);
            if w < l { w } else { 0.0 }
        })
    }

    /// The nearest image of a difference of two wrapped points (|component| < period):
    /// odd to the bit, `nearest(-d) == -nearest(d)`.
    #[inline(always)]
    pub fn nearest(&self, d: D::V) -> D::V {
        D::V::from_axes(|a| {
            let (c, l) = (d.axis(a), self.period.axis(a));
            let half = 0.5 * l;
            // Two selects and no branch, so that the force loop stays vector code.
            let above = if c > half { l } else { 0.0 };
            let below = if c < -half { l } else { 0.0 };
            c - (above - below)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn wrapping_stays_in_the_box_and_nearest_is_odd(x in -1e3..1e3f64, y in -1e3..1e3f64, l in 0.1..50.0f64) {
            let domain = Domain::<Plane> { period: DVec2::new(l, f64::INFINITY) };
            let (p, q) = (domain.wrap(DVec2::new(x, y)), domain.wrap(DVec2::new(y, x)));
            prop_assert!(p.x >= 0.0 && p.x < l && p.y == y);
            let d = domain.nearest(p - q);
            prop_assert!(d.x.abs() <= 0.5 * l * (1.0 + 1e-12));
            prop_assert_eq!(domain.nearest(q - p), -d);
        }
    }
}
