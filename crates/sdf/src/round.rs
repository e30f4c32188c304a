//! Round bodies with straight sides: cylinder, tube, cone and hollow cone.

use crate::axis::Axis;
use crate::profile::Revolved;
use crate::solid::{Misshapen, Solid, demand, demand_length, hits_of};
use glam::DVec3;
use tsubu_model::{HitBuffer, Shell, Space, Surface};

/// A solid round bar with flat ends; distance exact everywhere, at the rims of the ends too.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::Surface;
/// // A shaft of 55 mm diameter: 3 and 4 mm away from the rim of its end is 5 mm away from it.
/// let shaft = tsubu_sdf::Cylinder::new(DVec3::ZERO, DVec3::X * 0.675, 0.0275)?; // m
/// let x = DVec3::new(0.675 + 0.004, 0.0275 + 0.003, 0.0);
/// assert!((shaft.lower_bound(x) - 0.005).abs() < 1e-15);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder(Revolved);

impl Cylinder {
    /// Between two points, with `radius`, all in m. An error if a length is not positive.
    pub fn new(from: DVec3, to: DVec3, radius: f64) -> Result<Self, Misshapen> {
        demand_length("radius of a cylinder", radius)?;
        Cone::frustum(from, to, radius, radius).map(|cone| Self(cone.0))
    }
}

/// A pipe of finite length and wall thickness: the matter between two radii, with flat ends.
/// Distance exact everywhere. Grains may be inside and outside of it.
///
/// An endlessly thick pipe with closed ends is [`Cavity`](crate::Cavity) of a [`Cylinder`].
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::Surface;
/// let casing = tsubu_sdf::Tube::new(DVec3::ZERO, DVec3::X, 0.1148, 0.1248)?;   // m
/// assert!((casing.lower_bound(DVec3::new(0.5, 0.0, 0.1)) - 0.0148).abs() < 1e-15);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Tube(Revolved);

impl Tube {
    /// Between two points, with an `inner` and an `outer` radius, all in m.
    /// An error unless 0 < inner < outer.
    pub fn new(from: DVec3, to: DVec3, inner: f64, outer: f64) -> Result<Self, Misshapen> {
        demand_length("inner radius of a tube", inner)?;
        demand_length("wall of a tube (outer less inner radius)", outer - inner)?;
        let axis = Axis::new(from, to)?;
        let l = axis.length;
        let corners = vec![[0.0, inner], [l, inner], [l, outer], [0.0, outer]];
        Ok(Self(Revolved { axis, corners }))
    }

    /// As [`new`](Tube::new), with a plate of thickness `plate` (m) beyond `to` that closes that end:
    /// a can. A grain in its corner is held by the wall and by the plate.
    pub fn can(
        from: DVec3,
        to: DVec3,
        inner: f64,
        outer: f64,
        plate: f64,
    ) -> Result<Self, Misshapen> {
        demand_length("plate of a can", plate)?;
        let mut tube = Self::new(from, to, inner, outer)?;
        let l = tube.0.axis.length;
        let end = l + plate;
        tube.0.corners = vec![
            [0.0, inner],
            [l, inner],
            [l, 0.0],
            [end, 0.0],
            [end, outer],
            [0.0, outer],
        ];
        Ok(tube)
    }
}

/// A solid cone or frustum with flat ends; distance exact everywhere, at the apex too.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::Surface;
/// let cone = tsubu_sdf::Cone::frustum(DVec3::ZERO, DVec3::Z, 1.0, 0.0)?;       // m, apex up
/// assert!((cone.lower_bound(DVec3::new(1.0, 0.0, 1.0)) - 0.5f64.sqrt()).abs() < 1e-15);
/// assert_eq!(cone.lower_bound(DVec3::new(0.0, 0.0, 3.0)), 2.0);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cone(Revolved);

impl Cone {
    /// From `from` with radius `base` to `to` with radius `top`, all in m; one radius may be zero.
    pub fn frustum(from: DVec3, to: DVec3, base: f64, top: f64) -> Result<Self, Misshapen> {
        demand_radii(base, top)?;
        let axis = Axis::new(from, to)?;
        let l = axis.length;
        let mut corners = vec![[0.0, 0.0], [l, 0.0], [l, top], [0.0, base]];
        // An apex is one corner, not two at one place.
        corners.dedup();
        if base == 0.0 {
            corners.pop();
        }
        Ok(Self(Revolved { axis, corners }))
    }
}

/// The wall of a round hopper: a frustum's mantle of constant thickness, open at both ends.
/// Distance exact everywhere.
///
/// The inner face runs from radius `base` to radius `top`; the outer face lies `thickness` beyond it,
/// measured at right angles; the rims are cut at right angles to the axis.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::Surface;
/// // A hopper opening from 50 mm to 150 mm over 100 mm: a wall at 45°.
/// let hopper = tsubu_sdf::HollowCone::new(DVec3::ZERO, DVec3::Z * 0.1, 0.05, 0.15, 0.005)?; // m
/// let on_axis = DVec3::new(0.0, 0.0, 0.05);
/// assert!((hopper.lower_bound(on_axis) - 0.1 * 0.5f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HollowCone(Revolved);

impl HollowCone {
    /// From `from` with inner radius `base` to `to` with inner radius `top`, all in m; one radius may
    /// be zero (a funnel with a closed tip).
    pub fn new(
        from: DVec3,
        to: DVec3,
        base: f64,
        top: f64,
        thickness: f64,
    ) -> Result<Self, Misshapen> {
        demand_radii(base, top)?;
        demand_length("thickness of a hollow cone", thickness)?;
        let axis = Axis::new(from, to)?;
        let l = axis.length;
        // At right angles to the axis the wall is thicker by the length of its slope.
        let wide = thickness * (top - base).hypot(l) / l;
        let corners = vec![[0.0, base], [l, top], [l, top + wide], [0.0, base + wide]];
        Ok(Self(Revolved { axis, corners }))
    }
}

fn demand_radii(base: f64, top: f64) -> Result<(), Misshapen> {
    let sound = |r: f64| r >= 0.0 && r.is_finite();
    demand(sound(base) && sound(top) && base + top > 0.0, || {
        format!("the radii of a cone must not be negative nor both zero: {base} m and {top} m")
    })
}

macro_rules! is_revolved {
    ($($shape:ident),*) => {$(
        impl $shape {
            /// A closed mesh whose chords are nowhere farther than `chord` (m) from the surface.
            pub fn mesh(&self, chord: f64) -> Shell {
                self.0.mesh(chord)
            }
        }

        impl Solid<Space> for $shape {
            fn distance(&self, x: DVec3) -> f64 {
                self.0.distance(x)
            }

            fn feet(&self, x: DVec3, of: u32, out: &mut HitBuffer<Space>) {
                self.0.feet(x, of, out);
            }
        }

        impl Surface<Space> for $shape {
            fn lower_bound(&self, x: DVec3) -> f64 {
                self.0.distance(x)
            }

            fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
                hits_of(&self.0, x, reach, out);
            }

            fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
                self.0.outline(low, high)
            }

            fn bounds(&self) -> Option<[DVec3; 2]> {
                Some(self.0.bounds())
            }

            fn shell(&self) -> Option<Shell> {
                Some(self.0.shell())
            }
        }
    )*};
}
is_revolved!(Cylinder, Tube, Cone, HollowCone);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{tests::assert_closed, volume};
    use std::f64::consts::PI;

    fn ends() -> (DVec3, DVec3) {
        (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.1, 1.2, 0.3))
    }

    #[test]
    fn meshes_are_closed_and_have_the_volume_of_the_formula() {
        let (a, b) = ends();
        for (mesh, expected) in [
            (Cylinder::new(a, b, 0.3).unwrap().mesh(1e-5), PI * 0.09),
            (
                Tube::new(a, b, 0.3, 0.4).unwrap().mesh(1e-5),
                PI * (0.16 - 0.09),
            ),
            (
                Tube::can(a, b, 0.3, 0.4, 0.1).unwrap().mesh(1e-5),
                PI * (0.16 - 0.09 + 0.016),
            ),
            (
                Cone::frustum(a, b, 0.3, 0.1).unwrap().mesh(1e-5),
                PI * (0.09 + 0.03 + 0.01) / 3.0,
            ),
            (
                Cone::frustum(a, b, 0.0, 0.3).unwrap().mesh(1e-5),
                PI * 0.09 / 3.0,
            ),
            (
                Cone::frustum(a, b, 0.3, 0.0).unwrap().mesh(1e-5),
                PI * 0.09 / 3.0,
            ),
        ] {
            assert_closed(&mesh);
            assert!((volume(&mesh) / expected - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn a_grain_in_the_corner_of_a_can_meets_the_wall_and_the_plate() {
        let (a, b) = ends();
        let can = Tube::can(a, b, 0.3, 0.4, 0.1).unwrap();
        let mut out = HitBuffer::default();
        let x = DVec3::new(0.1 + 0.25, 1.2 - 0.04, 0.3);
        can.hits(&[x, x], &[0.06, 0.045], &mut out);
        let found: Vec<_> = out.hits.iter().map(|h| (h.of, h.normal)).collect();
        assert_eq!(found.len(), 3);
        assert!((found[0].1 + DVec3::X).length() < 1e-12 && found[0].0 == 0);
        assert!((found[1].1 + DVec3::Y).length() < 1e-12 && found[1].0 == 0);
        assert!((found[2].1 + DVec3::Y).length() < 1e-12 && found[2].0 == 1);
    }

    #[test]
    fn impossible_lengths_are_refused_with_a_sentence() {
        let (a, b) = ends();
        assert!(Cylinder::new(a, a, 0.1).is_err());
        assert!(Cylinder::new(a, b, f64::NAN).is_err());
        assert!(Cone::frustum(a, b, 0.0, 0.0).is_err());
        let error = Tube::new(a, b, 0.4, 0.3).unwrap_err().to_string();
        assert!(error.contains("wall of a tube"), "{error}");
    }
}
