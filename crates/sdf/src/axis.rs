//! A line between two points and the cylindrical coordinates about it.

use crate::solid::{Misshapen, demand};
use glam::DVec3;

/// From one point along a direction over a length, with two directions across.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    /// Where it begins, in m.
    pub from: DVec3,
    /// Unit direction.
    pub along: DVec3,
    /// Two unit directions across it, right-handed with it: across\[0\] × across\[1\] = along.
    pub across: [DVec3; 2],
    /// Length in m.
    pub length: f64,
}

/// A point in cylindrical coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Along the axis from its beginning, in m.
    pub along: f64,
    /// Distance from the axis in m.
    pub radius: f64,
    /// Unit vector away from the axis; on the axis itself a fixed direction across.
    pub outward: DVec3,
}

impl Axis {
    /// Between two points that are apart.
    pub fn new(from: DVec3, to: DVec3) -> Result<Self, Misshapen> {
        let length = (to - from).length();
        demand(length > 0.0 && length.is_finite(), || {
            format!("an axis needs two end points apart, not {from} and {to}")
        })?;
        let along = (to - from) / length;
        // The coordinate axis that is most across, the first of equals: y for an axis along x.
        let mut most = 0;
        for a in 1..3 {
            if along[a].abs() < along[most].abs() {
                most = a;
            }
        }
        let mut side = DVec3::ZERO;
        side[most] = 1.0;
        let u = (side - along * along.dot(side)).normalize();
        Ok(Self {
            from,
            along,
            across: [u, along.cross(u)],
            length,
        })
    }

    /// Coordinates of `x`.
    pub fn place(&self, x: DVec3) -> Place {
        let apart = x - self.from;
        let along = apart.dot(self.along);
        let (u, v) = (apart.dot(self.across[0]), apart.dot(self.across[1]));
        let radius = u.hypot(v);
        let outward = if radius > 0.0 {
            self.across[0] * (u / radius) + self.across[1] * (v / radius)
        } else {
            self.across[0]
        };
        Place {
            along,
            radius,
            outward,
        }
    }

    /// The point `along` the axis and (`u`, `v`) across it.
    pub fn point(&self, along: f64, u: f64, v: f64) -> DVec3 {
        self.from + self.along * along + self.across[0] * u + self.across[1] * v
    }

    /// The corners of a box around a cylinder of `radius` from `low` to `high` along the axis.
    pub fn bounds(&self, low: f64, high: f64, radius: f64) -> [DVec3; 2] {
        let (a, b) = (self.point(low, 0.0, 0.0), self.point(high, 0.0, 0.0));
        let part = |k: usize| radius * (1.0 - self.along[k] * self.along[k]).max(0.0).sqrt();
        let wide = DVec3::new(part(0), part(1), part(2));
        [a.min(b) - wide, a.max(b) + wide]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn coordinates_go_there_and_back_and_the_frame_is_right_handed(
            a in prop::array::uniform3(-1.0..1.0f64), b in prop::array::uniform3(-1.0..1.0f64), x in prop::array::uniform3(-2.0..2.0f64),
        ) {
            let (a, b, x) = (DVec3::from(a), DVec3::from(b), DVec3::from(x));
            prop_assume!((a - b).length() > 0.1);
            let axis = Axis::new(a, b).unwrap();
            let place = axis.place(x);
            let back = axis.point(place.along, 0.0, 0.0) + place.outward * place.radius;
            prop_assert!((back - x).length() < 1e-13);
            prop_assert!((axis.across[0].cross(axis.across[1]) - axis.along).length() < 1e-14);
        }
    }

    #[test]
    fn two_equal_points_are_no_axis_and_an_axis_along_x_has_y_and_z_across() {
        assert!(Axis::new(DVec3::ONE, DVec3::ONE).is_err());
        let axis = Axis::new(DVec3::ZERO, DVec3::X * 3.0).unwrap();
        assert_eq!(axis.across, [DVec3::Y, DVec3::Z]);
    }
}
