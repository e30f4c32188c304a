//! A solid ball.

use crate::axis::Axis;
use crate::drawing::{circle, clipped, revolve, steps_for};
use crate::solid::{Misshapen, Solid, demand_length, hits_of};
use glam::DVec3;
use std::f64::consts::PI;
use tsubu_model::{Dim, Hit, HitBuffer, Shell, Surface, Vector};

/// The ball |x − centre| ≤ radius (a disc in the plane); distance = |x − centre| − radius, exact everywhere.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::{Space, Surface};
/// let ball = tsubu_sdf::Ball::<Space>::new(DVec3::ZERO, 0.5)?;          // m
/// assert_eq!(ball.lower_bound(DVec3::new(0.0, 3.0, 4.0)), 4.5);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball<D: Dim> {
    centre: D::V,
    radius: f64,
}

impl<D: Dim> Ball<D> {
    /// A ball of `radius` (m) about `centre` (m). An error if the radius is not positive.
    pub fn new(centre: D::V, radius: f64) -> Result<Self, Misshapen> {
        demand_length("radius of a ball", radius)?;
        Ok(Self { centre, radius })
    }
}

impl<D: Dim> Solid<D> for Ball<D> {
    fn distance(&self, x: D::V) -> f64 {
        (x - self.centre).length() - self.radius
    }

    fn feet(&self, x: D::V, of: u32, out: &mut HitBuffer<D>) {
        let apart = x - self.centre;
        let length = apart.length();
        // At the very centre every direction is as good; up is the one that a reader expects.
        let normal = if length > 0.0 {
            apart * (1.0 / length)
        } else {
            D::V::from_axes(|a| if a == D::UP { 1.0 } else { 0.0 })
        };
        out.hits.push(Hit {
            of,
            distance: length - self.radius,
            normal,
            feature: 0,
        });
    }
}

impl<D: Dim> Surface<D> for Ball<D> {
    fn lower_bound(&self, x: D::V) -> f64 {
        self.distance(x)
    }

    fn hits(&self, x: &[D::V], reach: &[f64], out: &mut HitBuffer<D>) {
        hits_of(self, x, reach, out);
    }

    /// The great circle in the plane x–z.
    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        let centre = D::to_space(self.centre);
        clipped(circle(centre, DVec3::X, DVec3::Z, self.radius), low, high)
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        let centre = D::to_space(self.centre);
        Some([centre - self.radius, centre + self.radius])
    }

    fn shell(&self) -> Option<Shell> {
        let centre = D::to_space(self.centre);
        let r = self.radius;
        let axis = Axis::new(centre, centre + DVec3::Z * r).ok()?;
        let steps = steps_for(r, 0.01 * r);
        let half = steps / 2;
        let arc = (0..=half).map(|k| {
            let (sin, cos) = (PI * k as f64 / half as f64).sin_cos();
            // The poles exactly on the axis, so that they become one corner each.
            [r * cos, if k == 0 || k == half { 0.0 } else { r * sin }]
        });
        Some(revolve(&axis, &arc.collect::<Vec<_>>(), steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{tests::assert_closed, volume};
    use tsubu_model::Space;

    #[test]
    fn the_shell_is_closed_and_a_little_smaller_than_the_ball() {
        let shell = Ball::<Space>::new(DVec3::ONE, 0.5)
            .unwrap()
            .shell()
            .unwrap();
        assert_closed(&shell);
        let share = volume(&shell) / (PI / 6.0);
        assert!(share > 0.95 && share < 1.0, "{share}");
        assert!(Ball::<Space>::new(DVec3::ONE, -0.5).is_err());
    }
}
