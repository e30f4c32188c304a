//! Feet of a point outside a screw.

use super::{Foot, Part, Query, Screw};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Feet on a face that are past its end by less than this angle count as on it: rather a hit twice
/// than none.
const ROUNDING: f64 = 1e-12;

impl Screw {
    /// Every foot that a point outside the body is on the outer side of.
    pub(super) fn feet_outside(&self, q: &Query, mut see: impl FnMut(Foot)) {
        self.shaft_feet(q, &mut see);
        if q.rho <= self.size.shaft {
            // Within the radius of the shaft the flight hides behind the shaft's edge.
            return;
        }
        if q.covered {
            see(Foot {
                distance: q.rho - self.size.outer,
                normal: DVec3::X,
                part: Part::Rim,
            });
        }
        self.face_feet(q, Part::Front, &mut see);
        self.face_feet(q, Part::Back, &mut see);
        self.end_foot(q, Part::Start, &mut see);
        self.end_foot(q, Part::Stop, &mut see);
    }

    /// The side of the shaft where no flight covers it, its ends and their edges.
    fn shaft_feet(&self, q: &Query, see: &mut impl FnMut(Foot)) {
        let beyond = (q.rho - self.size.shaft).max(0.0);
        let (over, part) = if q.z < 0.0 {
            (q.z, Part::Disc)
        } else if q.z > self.axis.length {
            (q.z - self.axis.length, Part::OtherDisc)
        } else {
            if !q.covered {
                see(Foot {
                    distance: q.rho - self.size.shaft,
                    normal: DVec3::X,
                    part: Part::Shaft,
                });
            }
            return;
        };
        let distance = beyond.hypot(over);
        see(Foot {
            distance,
            normal: DVec3::new(beyond, 0.0, over) / distance,
            part,
        });
    }

    /// The feet on one face or its outer edge, from the turn nearest to the point on.
    fn face_feet(&self, q: &Query, part: Part, see: &mut impl FnMut(Foot)) {
        let half = 0.5 * self.size.thickness;
        // Seen from the other side the back face is a front face: angles and heights change sign.
        let side = if part == Part::Front { 1.0 } else { -1.0 };
        let [first, last] = self.turn;
        let over = side * q.height;
        let mut number = if over > half { q.turn } else { q.turn - side };
        // No foot lies more than a quarter turn away: skip the turns that do not exist so near.
        let limit = if side > 0.0 {
            ((last + FRAC_PI_2 - q.phi) / TAU).floor()
        } else {
            ((first - FRAC_PI_2 - q.phi) / TAU).ceil()
        };
        number = side * (side * number).min(side * limit);
        loop {
            let angle = q.phi + TAU * number;
            if angle < first - FRAC_PI_2 || angle > last + FRAC_PI_2 {
                return;
            }
            // Never below the face: there the point would be inside, or it is rounding on the face.
            let height = (side * (q.z - self.rise * angle) - half).max(0.0);
            if let Some(psi) = self.psi(q.rho, height) {
                let theta = angle + side * psi;
                if first - ROUNDING <= theta && theta <= last + ROUNDING {
                    see(self.face_foot(q.rho, psi, height, side, part));
                }
            }
            // A turn that passes over the point hides all that lie behind it.
            if first <= angle && angle <= last {
                return;
            }
            number -= side;
        }
    }

    /// The foot at angle `side`·ψ from the point that is `height` over the face.
    fn face_foot(&self, rho: f64, psi: f64, height: f64, side: f64, part: Part) -> Foot {
        let (sin, cos) = psi.sin_cos();
        let (c, r) = (self.rise, (rho * cos).min(self.size.outer));
        let apart = DVec3::new(rho - r * cos, -r * sin, height - c * psi);
        let on_face = rho * cos <= self.size.outer;
        let distance = apart.length();
        let normal = if on_face || distance < 1e-12 * self.size.outer {
            // The normal of the helicoid itself, so that it stays exact when the distance vanishes.
            let slope = c / r;
            DVec3::new(slope * sin, -slope * cos, 1.0) / slope.hypot(1.0)
        } else {
            apart / distance
        };
        let distance = if on_face { apart.dot(normal) } else { distance };
        Foot {
            distance,
            normal: DVec3::new(normal.x, side * normal.y, side * normal.z),
            part,
        }
    }

    /// The angle ψ ≥ 0 from a point at radius ρ and `height` ≥ 0 over a front face to its foot:
    /// the root of F(ψ) = ρ sin ψ · min(ρ cos ψ, Ro) + c²ψ − c·height on the branch where F rises.
    /// None if the nearest place is at the root of the flight, where the shaft is nearer.
    fn psi(&self, rho: f64, height: f64) -> Option<f64> {
        let (c, outer) = (self.rise, self.size.outer);
        let steep = if rho > c {
            0.5 * (-(c / rho) * (c / rho)).acos()
        } else {
            FRAC_PI_2
        };
        let edge = if rho > outer {
            (outer / rho).acos()
        } else {
            0.0
        };
        let horizon = (self.size.shaft / rho).acos();
        let highest = steep.max(edge).min(horizon).min(height / c);
        let both = |psi: f64| {
            let (sin, cos) = psi.sin_cos();
            if rho * cos > outer {
                (
                    rho * outer * sin + c * (c * psi - height),
                    rho * outer * cos + c * c,
                )
            } else {
                (
                    rho * rho * sin * cos + c * (c * psi - height),
                    rho * rho * (2.0 * cos * cos - 1.0) + c * c,
                )
            }
        };
        if both(highest).0 < 0.0 {
            return None;
        }
        let (mut low, mut high) = (0.0, highest);
        let mut psi = (c * height / (c * c + rho * rho.min(outer))).min(highest);
        // Newton from the linear guess takes three to five rounds; halving keeps it in the bracket.
        for _ in 0..64 {
            let (value, slope) = both(psi);
            if value < 0.0 {
                low = psi;
            } else {
                high = psi;
            }
            let newton = psi - value / slope;
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            let done = (next - psi).abs() <= 1e-16 * highest;
            psi = next;
            if done {
                break;
            }
        }
        Some(psi)
    }

    /// The flat end of the flight, its edges and corners.
    fn end_foot(&self, q: &Query, part: Part, see: &mut impl FnMut(Foot)) {
        let (theta, outward) = if part == Part::Start {
            (self.turn[0], -1.0)
        } else {
            (self.turn[1], 1.0)
        };
        // From the same unrolled angle that decides about the rim, so that no gap opens between them.
        let (sin, cos) = (theta - q.angle).sin_cos();
        if q.rho * cos <= self.size.shaft {
            return;
        }
        let r = (q.rho * cos).min(self.size.outer);
        let over = q.z - self.rise * theta;
        let half = 0.5 * self.size.thickness;
        let beside = over - over.clamp(-half, half);
        // Half the slope of the squared distance along the sweep: it must not fall into the flight.
        let falls = outward * (q.rho * r * sin - self.rise * beside) > 0.0;
        if falls || (q.covered && beside == 0.0) {
            return;
        }
        let apart = DVec3::new(q.rho - r * cos, -r * sin, beside);
        let distance = apart.length();
        let normal = if distance > 0.0 {
            apart / distance
        } else {
            DVec3::new(0.0, outward, 0.0)
        };
        see(Foot {
            distance,
            normal,
            part,
        });
    }
}
