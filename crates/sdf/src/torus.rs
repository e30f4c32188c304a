//! A ring with a round section.

use crate::axis::Axis;
use crate::drawing::{circle, clipped, revolve, steps_for};
use crate::solid::{Misshapen, Solid, demand, demand_length, hits_of};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use tsubu_model::{Hit, HitBuffer, Shell, Space, Surface};

/// A ring: all points within `section` of a circle of radius `ring`;
/// distance = √((ρ − ring)² + s²) − section with ρ from and s along the axis, exact everywhere.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::Surface;
/// let torus = tsubu_sdf::Torus::new(DVec3::ZERO, DVec3::Z, 1.0, 0.25)?;        // m
/// assert_eq!(torus.lower_bound(DVec3::ZERO), 0.75);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    axis: Axis,
    ring: f64,
    section: f64,
}

impl Torus {
    /// About `centre` with its axis along `axis` (any length but zero); radii in m, section < ring.
    pub fn new(centre: DVec3, axis: DVec3, ring: f64, section: f64) -> Result<Self, Misshapen> {
        demand_length("section of a torus", section)?;
        demand(ring > section && ring.is_finite(), || {
            format!("a torus needs a ring ({ring} m) wider than its section ({section} m)")
        })?;
        Ok(Self {
            axis: Axis::new(centre, centre + axis)?,
            ring,
            section,
        })
    }
}

impl Solid<Space> for Torus {
    fn distance(&self, x: DVec3) -> f64 {
        let place = self.axis.place(x);
        (place.radius - self.ring).hypot(place.along) - self.section
    }

    fn feet(&self, x: DVec3, of: u32, out: &mut HitBuffer<Space>) {
        let place = self.axis.place(x);
        let apart = DVec2::new(place.along, place.radius - self.ring);
        let length = apart.length();
        let flat = if length > 0.0 {
            apart / length
        } else {
            DVec2::Y
        };
        out.hits.push(Hit {
            of,
            distance: length - self.section,
            normal: self.axis.along * flat.x + place.outward * flat.y,
            feature: 0,
        });
    }
}

impl Surface<Space> for Torus {
    fn lower_bound(&self, x: DVec3) -> f64 {
        self.distance(x)
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        hits_of(self, x, reach, out);
    }

    /// The widest and the narrowest circle.
    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        let [u, v] = self.axis.across;
        let mut segments = circle(self.axis.from, u, v, self.ring + self.section);
        segments.extend(circle(self.axis.from, u, v, self.ring - self.section));
        clipped(segments, low, high)
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        let wide = self.ring + self.section;
        Some(self.axis.bounds(-self.section, self.section, wide))
    }

    fn shell(&self) -> Option<Shell> {
        let steps = steps_for(self.ring, 0.005 * self.ring);
        let section = (0..24).map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / 24.0).sin_cos();
            [self.section * cos, self.ring + self.section * sin]
        });
        Some(revolve(&self.axis, &section.collect::<Vec<_>>(), steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{tests::assert_closed, volume};

    #[test]
    fn the_shell_is_closed_and_a_thick_section_is_refused() {
        let torus = Torus::new(DVec3::ONE, DVec3::X, 1.0, 0.25).unwrap();
        let shell = torus.shell().unwrap();
        assert_closed(&shell);
        let exact = TAU * std::f64::consts::PI * 0.0625;
        assert!((volume(&shell) / exact - 1.0).abs() < 0.03);
        assert!(Torus::new(DVec3::ONE, DVec3::X, 0.2, 0.25).is_err());
    }
}
