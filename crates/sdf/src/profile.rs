//! A polygon turned about an axis: what cylinders, tubes and cones have in common.

use crate::axis::Axis;
use crate::drawing::{circle, clipped, revolve, steps_for};
use crate::solid::Solid;
use glam::{DVec2, DVec3};
use tsubu_model::{Hit, HitBuffer, Shell, Space};

/// A body of revolution. The distance of a point is that of (along, radius) from the polygon: of all
/// points of a circle about the axis the nearest one lies in the half plane of the query.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Revolved {
    pub axis: Axis,
    /// Corners (along, radius) in m with the body on the left when walked in order; sides along the
    /// axis are not part of the surface.
    pub corners: Vec<[f64; 2]>,
}

/// A side of the polygon that is surface.
struct Side {
    from: DVec2,
    to: DVec2,
}

impl Side {
    fn along(&self) -> DVec2 {
        (self.to - self.from).normalize()
    }

    /// Out of the body: the body is on the left, so this is the right.
    fn normal(&self) -> DVec2 {
        let along = self.along();
        DVec2::new(along.y, -along.x)
    }

    /// Where the foot of `q` lies, as a share of the side: below 0 before it, above 1 behind it.
    fn share(&self, q: DVec2) -> f64 {
        let along = self.to - self.from;
        (q - self.from).dot(along) / along.length_squared()
    }
}

impl Revolved {
    fn side(&self, number: usize) -> Option<Side> {
        let count = self.corners.len();
        let (a, b) = (
            self.corners[number % count],
            self.corners[(number + 1) % count],
        );
        let on_axis = a[1] == 0.0 && b[1] == 0.0;
        (!on_axis).then(|| Side {
            from: DVec2::from(a),
            to: DVec2::from(b),
        })
    }

    /// Feet of (along, radius) on the polygon: signed distance, outward normal, feature.
    fn flat_feet(&self, q: DVec2, mut see: impl FnMut(f64, DVec2, u32)) {
        let count = self.corners.len();
        for number in 0..count {
            let here = self.side(number);
            if let Some(side) = &here {
                let share = side.share(q);
                if (0.0..=1.0).contains(&share) {
                    let normal = side.normal();
                    see((q - side.from).dot(normal), normal, number as u32);
                }
            }
            // The corner at the beginning of the side counts where both its sides see it as their end.
            // At a corner on the axis the second side is the mirror image of the first.
            let before = self.side(number + count - 1);
            let beyond_before = before.as_ref().is_none_or(|s| s.share(q) > 1.0);
            let beyond_here = here.as_ref().is_none_or(|s| s.share(q) < 0.0);
            if !(beyond_before && beyond_here) || (before.is_none() && here.is_none()) {
                continue;
            }
            let corner = DVec2::from(self.corners[number]);
            let apart = q - corner;
            let length = apart.length();
            let turn = match (&before, &here) {
                (Some(a), Some(b)) => a.along().perp_dot(b.along()),
                // The mirror image of a direction (a, b) walked the other way is (−a, b).
                (Some(a), None) => 2.0 * a.along().x * a.along().y,
                (None, Some(b)) => -2.0 * b.along().x * b.along().y,
                (None, None) => continue,
            };
            let sign = if turn >= 0.0 { 1.0 } else { -1.0 };
            if length > 0.0 {
                see(sign * length, apart * (sign / length), number as u32);
            }
        }
    }

    pub fn bounds(&self) -> [DVec3; 2] {
        let along = |pick: fn(f64, f64) -> f64| self.corners.iter().map(|c| c[0]).reduce(pick);
        let (low, high) = (along(f64::min), along(f64::max));
        let radius = self.corners.iter().map(|c| c[1]).fold(0.0, f64::max);
        self.axis
            .bounds(low.unwrap_or(0.0), high.unwrap_or(0.0), radius)
    }

    /// Circles at the corners and four lines along each side, clipped to the box.
    pub fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        let [u, v] = self.axis.across;
        let mut segments = Vec::new();
        for &[along, radius] in self.corners.iter().filter(|c| c[1] > 0.0) {
            segments.extend(circle(self.axis.point(along, 0.0, 0.0), u, v, radius));
        }
        for side in (0..self.corners.len()).filter_map(|k| self.side(k)) {
            for (cos, sin) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                let at = |c: DVec2| self.axis.point(c.x, c.y * cos, c.y * sin);
                segments.push([at(side.from), at(side.to)]);
            }
        }
        clipped(segments, low, high)
    }

    /// Triangles that are nowhere farther than `chord` (m) from the surface.
    pub fn mesh(&self, chord: f64) -> Shell {
        let radius = self.corners.iter().map(|c| c[1]).fold(0.0, f64::max);
        revolve(&self.axis, &self.corners, steps_for(radius, chord))
    }

    /// A mesh that is fine enough for a picture: chords within 0.5 % of the largest radius.
    pub fn shell(&self) -> Shell {
        let radius = self.corners.iter().map(|c| c[1]).fold(0.0, f64::max);
        self.mesh(0.005 * radius)
    }
}

impl Solid<Space> for Revolved {
    fn distance(&self, x: DVec3) -> f64 {
        let place = self.axis.place(x);
        let mut nearest = f64::INFINITY;
        self.flat_feet(DVec2::new(place.along, place.radius), |distance, _, _| {
            if distance.abs() < nearest.abs() {
                nearest = distance;
            }
        });
        nearest
    }

    fn feet(&self, x: DVec3, of: u32, out: &mut HitBuffer<Space>) {
        let place = self.axis.place(x);
        let q = DVec2::new(place.along, place.radius);
        self.flat_feet(q, |distance, normal, feature| {
            out.hits.push(Hit {
                of,
                distance,
                normal: self.axis.along * normal.x + place.outward * normal.y,
                feature,
            });
        });
    }
}
