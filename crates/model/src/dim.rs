//! How many coordinates a grain has: [`Plane`] or [`Space`], and the box they live in.

use glam::{DVec2, DVec3};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// What the formulas need of a vector. Implemented for glam's `DVec2` and `DVec3`, for one number and for
/// [`Nothing`](crate::Nothing), the spin of a grain without one.
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

impl Vector for f64 {
    const AXES: usize = 1;
    const ZERO: Self = 0.0;
    #[inline(always)]
    fn axis(self, _axis: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn from_axes(mut coordinate: impl FnMut(usize) -> f64) -> Self {
        coordinate(0)
    }
    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        self * other
    }
    #[inline(always)]
    fn length(self) -> f64 {
        self.abs()
    }
}

/// The dimension of a scene, as a type.
pub trait Dim: Copy + Debug + Default + Send + Sync + 'static {
    /// Positions, velocities, forces.
    type V: Vector;
    /// Axial quantities such as angular velocity and torque: one number in the plane, a vector in space.
    type W: Vector;
    /// The axis that points up.
    const UP: usize;
    /// The three-dimensional place of a point: a plane scene lies in x–z at y = 0.
    fn to_space(v: Self::V) -> DVec3;
    /// The part of a three-dimensional vector that this dimension knows.
    fn from_space(v: DVec3) -> Self::V;
    /// w × arm: the velocity of the end of an arm that turns with w.
    fn turned(w: Self::W, arm: Self::V) -> Self::V;
    /// arm × force: the torque of a force at the end of an arm.
    fn moment(arm: Self::V, force: Self::V) -> Self::W;
    /// What is left of w without its part along the unit vector n, about which nothing rolls: in the plane all of it.
    fn across(w: Self::W, n: Self::V) -> Self::W;
    /// The three-dimensional axial vector of w.
    fn spin_to_space(w: Self::W) -> DVec3;
    /// The part of a three-dimensional axial vector that this dimension knows.
    fn spin_from_space(w: DVec3) -> Self::W;
}

/// A vertical plane: coordinates x (level) and z (up), spheres one grain deep. Spin is positive from x to z: counter-clockwise
/// in a picture with x to the right and z up, and so about −y.
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
    #[inline(always)]
    fn turned(w: f64, arm: DVec2) -> DVec2 {
        DVec2::new(-w * arm.y, w * arm.x)
    }
    #[inline(always)]
    fn moment(arm: DVec2, force: DVec2) -> f64 {
        arm.x * force.y - arm.y * force.x
    }
    #[inline(always)]
    fn across(w: f64, _n: DVec2) -> f64 {
        w
    }
    fn spin_to_space(w: f64) -> DVec3 {
        DVec3::new(0.0, -w, 0.0)
    }
    fn spin_from_space(w: DVec3) -> f64 {
        -w.y
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
    #[inline(always)]
    fn turned(w: DVec3, arm: DVec3) -> DVec3 {
        w.cross(arm)
    }
    #[inline(always)]
    fn moment(arm: DVec3, force: DVec3) -> DVec3 {
        arm.cross(force)
    }
    #[inline(always)]
    fn across(w: DVec3, n: DVec3) -> DVec3 {
        w - n * Vector::dot(w, n)
    }
    fn spin_to_space(w: DVec3) -> DVec3 {
        w
    }
    fn spin_from_space(w: DVec3) -> DVec3 {
        w
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

        #[test]
        fn the_plane_turns_as_space_does(w in -9.0..9.0f64, a in -9.0..9.0f64, b in -9.0..9.0f64, c in -9.0..9.0f64, e in -9.0..9.0f64) {
            let (arm, force) = (DVec2::new(a, b), DVec2::new(c, e));
            let spin = Plane::spin_to_space(w);
            prop_assert_eq!(Plane::to_space(Plane::turned(w, arm)), Space::turned(spin, Plane::to_space(arm)));
            let torque = Space::moment(Plane::to_space(arm), Plane::to_space(force));
            prop_assert_eq!(Plane::spin_to_space(Plane::moment(arm, force)).y, torque.y);
            // A vector across n: n × (w × n) gives it back.
            let n = DVec3::new(a, b, c).normalize_or(DVec3::X);
            let across = Space::across(DVec3::new(w, e, a), n);
            prop_assert!(Vector::dot(across, n).abs() < 1e-12);
            prop_assert!((Space::moment(n, Space::turned(across, n)) - across).length() < 1e-12);
        }
    }
}
