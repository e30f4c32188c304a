//! The shortest way out of a screw.

use super::{Foot, Part, Query, Screw};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_4, TAU};

/// In how many steps the angle to a face is searched before it is refined.
const STEPS: usize = 16;

/// Keeps the nearest of the places offered.
struct Nearest {
    length: f64,
    /// From the place to the point, and the outward normal there for when the two coincide.
    apart: DVec3,
    flat: DVec3,
    part: Part,
}

impl Nearest {
    fn offer(&mut self, apart: DVec3, flat: DVec3, part: Part) {
        let length = apart.length();
        if length < self.length {
            *self = Self {
                length,
                apart,
                flat,
                part,
            };
        }
    }
}

/// A zero of `f` between two places of different sign, given with their values: chords, with the
/// value of an end that stays put halved (the Illinois rule), so that both ends move in.
fn zero(f: impl Fn(f64) -> f64, low: (f64, f64), high: (f64, f64)) -> f64 {
    let ((mut a, mut fa), (mut b, mut fb)) = (low, high);
    for _ in 0..100 {
        let c = b - fb * (b - a) / (fb - fa);
        let fc = f(c);
        if fc == 0.0 || (c - b).abs() <= 1e-16 * high.0.abs() {
            return c;
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (c, fc);
    }
    b
}

impl Screw {
    /// The nearest place of the surface for a point inside the body, as a foot with a distance ≤ 0.
    pub(super) fn way_out(&self, q: &Query) -> Foot {
        let mut nearest = Nearest {
            length: f64::INFINITY,
            apart: DVec3::ZERO,
            flat: DVec3::X,
            part: Part::Shaft,
        };
        let (rs, ro) = (self.size.shaft, self.size.outer);
        // The ends of the shaft, or their edges.
        let beyond = (q.rho - rs).max(0.0);
        let to_end = q.z - self.axis.length;
        nearest.offer(DVec3::new(beyond, 0.0, q.z), DVec3::NEG_Z, Part::Disc);
        nearest.offer(DVec3::new(beyond, 0.0, to_end), DVec3::Z, Part::OtherDisc);
        if q.covered {
            nearest.offer(DVec3::new(q.rho - ro, 0.0, 0.0), DVec3::X, Part::Rim);
            self.offer_face(q, Part::Front, &mut nearest);
            self.offer_face(q, Part::Back, &mut nearest);
        } else {
            // Every place of the flight is at least this far away.
            nearest.offer(DVec3::new(q.rho - rs, 0.0, 0.0), DVec3::X, Part::Shaft);
        }
        self.offer_end(q, Part::Start, &mut nearest);
        self.offer_end(q, Part::Stop, &mut nearest);
        let normal = if nearest.length > 1e-12 * ro {
            -nearest.apart / nearest.length
        } else {
            nearest.flat
        };
        Foot {
            distance: -nearest.length,
            normal,
            part: nearest.part,
        }
    }

    /// The nearest place of a face of the turn that the point is in: the squared distance
    /// g(ψ) = ρ² + r² − 2ρr cos ψ + (w − cψ)², r = clamp(ρ cos ψ, rs, Ro), is least between 0 and w/c.
    fn offer_face(&self, q: &Query, part: Part, nearest: &mut Nearest) {
        let side = if part == Part::Front { 1.0 } else { -1.0 };
        let (c, half) = (self.rise, 0.5 * self.size.thickness);
        let height = q.height - side * half;
        let angle = q.phi + TAU * q.turn;
        let goal = (height / c).clamp(self.turn[0] - angle, self.turn[1] - angle);
        let radius = |cos: f64| (q.rho * cos).clamp(self.size.shaft, self.size.outer);
        let slope = |psi: f64| {
            let (sin, cos) = psi.sin_cos();
            q.rho * radius(cos) * sin - c * (height - c * psi)
        };
        let mut offer = |psi: f64| {
            let (sin, cos) = psi.sin_cos();
            let r = radius(cos);
            let steep = c / r;
            let apart = DVec3::new(q.rho - r * cos, -r * sin, height - c * psi);
            let flat = DVec3::new(steep * sin, -steep * cos, 1.0) * (side / steep.hypot(1.0));
            nearest.offer(apart, flat, part);
        };
        // Up to an eighth of a turn the slope rises all the way; beyond it may have several zeros.
        let steps = if goal.abs() <= FRAC_PI_4 { 1 } else { STEPS };
        let at = |k: usize| goal * k as f64 / steps as f64;
        offer(0.0);
        offer(goal);
        for k in 0..steps {
            // Along the way from 0 to the goal the distance falls, then rises.
            let (low, high) = ((at(k), slope(at(k))), (at(k + 1), slope(at(k + 1))));
            if low.1 * goal < 0.0 && high.1 * goal > 0.0 {
                offer(zero(slope, low, high));
            }
        }
    }

    /// The nearest place of a flat end of the flight.
    fn offer_end(&self, q: &Query, part: Part, nearest: &mut Nearest) {
        let (theta, outward) = if part == Part::Start {
            (self.turn[0], -1.0)
        } else {
            (self.turn[1], 1.0)
        };
        let (sin, cos) = (theta - q.phi).sin_cos();
        let r = (q.rho * cos).clamp(self.size.shaft, self.size.outer);
        let half = 0.5 * self.size.thickness;
        let over = q.z - self.rise * theta;
        let apart = DVec3::new(q.rho - r * cos, -r * sin, over - over.clamp(-half, half));
        nearest.offer(apart, DVec3::new(-sin * outward, cos * outward, 0.0), part);
    }
}
