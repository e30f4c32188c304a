//! A screw: a shaft with a helicoidal flight, its distance solved for the nearest point of the helix.

mod inside;
mod mesh;
mod outside;

use crate::axis::Axis;
use crate::drawing::clipped;
use crate::solid::{Misshapen, Solid, demand, demand_length, hits_of};
use glam::DVec3;
use std::f64::consts::TAU;
use tsubu_model::{Hit, HitBuffer, Shell, Space, Surface};

/// Which way the flight winds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hand {
    /// Along its axis the flight turns counter-clockwise seen against the axis, as a common bolt.
    /// It carries along its axis when it turns by a *negative* angle about it.
    #[default]
    Right,
    /// The mirror image.
    Left,
}

/// The measures of a screw in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewSize {
    /// Radius of the shaft.
    pub shaft: f64,
    /// Radius of the flight's rim.
    pub outer: f64,
    /// Advance of the flight per turn.
    pub pitch: f64,
    /// Thickness of the flight along the axis, the same at every radius.
    pub thickness: f64,
}

/// A shaft and the flight swept by the rectangle (shaft ≤ ρ ≤ outer) × (thickness along the axis)
/// moving along a helix, with flat ends.
///
/// With s along the axis and φ about it, the middle of the flight is s = ± pitch·φ/2π (+ right-handed,
/// φ = 0 at s = 0 in the direction [`zero`](Screw::zero)). It runs from s = thickness to
/// s = length − thickness, so that half a thickness of bare shaft remains at each end.
///
/// # Accuracy
/// [`hits`](Surface::hits) solves (ρ² sin 2ψ)/2 + c²ψ = c·w for the angle ψ to the foot on a face
/// (c = pitch/2π, w the height over the face) to rounding, so distances are exact to about 1e-14 of
/// the largest length at any reach. The nearest hit is always found; from outside also the nearest
/// face on the other side, the shaft and the ends. Places hidden behind a whole turn of the flight are
/// not reported. [`lower_bound`](Surface::lower_bound) is exact inside the body, outside only a bound:
/// the larger of the distances from the cylinder around it and, within, from shaft and endless flight.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::{HitBuffer, Surface};
/// use tsubu_sdf::{Hand, Screw, ScrewSize};
/// // The screw of a feeder: 205 mm on a 55 mm shaft, pitch 150 mm, 4.5 pitches, flight 6 mm.
/// let size = ScrewSize { shaft: 0.0275, outer: 0.1025, pitch: 0.150, thickness: 0.006 };
/// let screw = Screw::new(DVec3::ZERO, DVec3::X * 0.675, size, Hand::Right)?;
/// // Over a face the distance is the height times the cosine of the flight's slope, to first order.
/// let (mut out, height, rho) = (HitBuffer::default(), 1e-4, 0.07);
/// let x = DVec3::new(0.15 + 0.003 + height, rho, 0.0);
/// screw.hits(&[x], &[0.01], &mut out);
/// let slope = 0.150 / std::f64::consts::TAU / rho;
/// assert!((out.hits[0].distance - height / (1.0 + slope * slope).sqrt()).abs() < 1e-8);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    axis: Axis,
    size: ScrewSize,
    hand: Hand,
    /// c = pitch/2π: advance of the flight per radian.
    rise: f64,
    /// Angles at which the flight begins and ends, c·θ = its middle along the axis.
    turn: [f64; 2],
}

/// A point in the screw's coordinates, in which every screw is right-handed.
#[derive(Clone, Copy, Debug)]
struct Query {
    rho: f64,
    phi: f64,
    z: f64,
    /// Number of the turn whose middle is nearest along the axis.
    turn: f64,
    /// Unrolled angle of the point on that turn.
    angle: f64,
    /// Height over the middle of that turn.
    height: f64,
    /// Whether the flight's angle and height range holds the point (whatever its radius).
    covered: bool,
}

/// What a foot is on; the number that its hits carry as `feature`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Shaft = 0,
    /// The face towards the end of the axis, and its outer edge.
    Front = 1,
    /// The face towards the beginning, and its outer edge.
    Back = 2,
    Rim = 3,
    /// The ends of the shaft.
    Disc = 4,
    OtherDisc = 5,
    /// The ends of the flight.
    Start = 6,
    Stop = 7,
}

/// A foot in the query's own cylindrical frame: components away from the axis, around it, along it.
#[derive(Clone, Copy, Debug)]
struct Foot {
    distance: f64,
    normal: DVec3,
    part: Part,
}

impl Screw {
    /// Between two points in m.
    /// An error unless 0 < shaft < outer, and the flight is thinner than half a pitch and fits.
    pub fn new(from: DVec3, to: DVec3, size: ScrewSize, hand: Hand) -> Result<Self, Misshapen> {
        demand_length("shaft radius of a screw", size.shaft)?;
        demand_length("height of a flight over its shaft", size.outer - size.shaft)?;
        demand_length("pitch of a screw", size.pitch)?;
        demand_length("thickness of a flight", size.thickness)?;
        demand(size.thickness < 0.5 * size.pitch, || {
            format!(
                "a flight must be thinner than half its pitch: {} m against {} m",
                size.thickness, size.pitch
            )
        })?;
        let axis = Axis::new(from, to)?;
        demand(axis.length > 2.0 * size.thickness, || {
            format!(
                "a screw of {} m has no room for its flight of {} m",
                axis.length, size.thickness
            )
        })?;
        let rise = size.pitch / TAU;
        let turn = [size.thickness, axis.length - size.thickness].map(|s| s / rise);
        Ok(Self {
            axis,
            size,
            hand,
            rise,
            turn,
        })
    }

    /// The direction across the axis in which the middle of the flight would pass the beginning.
    pub fn zero(&self) -> DVec3 {
        self.axis.across[0]
    }

    /// The measures.
    pub fn size(&self) -> ScrewSize {
        self.size
    }

    /// How far a plug that cannot turn is carried along the axis, in m, when the screw turns by
    /// `angle` (rad) about its axis: −pitch·angle/2π if right-handed.
    ///
    /// ```
    /// # use glam::DVec3;
    /// # use tsubu_sdf::{Hand, Screw, ScrewSize};
    /// # let size = ScrewSize { shaft: 0.0275, outer: 0.1025, pitch: 0.150, thickness: 0.006 };
    /// let screw = Screw::new(DVec3::ZERO, DVec3::X * 0.675, size, Hand::Right)?;
    /// assert!((screw.advance(-std::f64::consts::TAU) - 0.150).abs() < 1e-15);
    /// # Ok::<(), tsubu_sdf::Misshapen>(())
    /// ```
    pub fn advance(&self, angle: f64) -> f64 {
        -self.mirror() * self.rise * angle
    }

    /// Volume in m³: shaft plus flight, π rs² L + t (Ro² − rs²)/2 · (angle of the flight).
    pub fn volume(&self) -> f64 {
        let ScrewSize {
            shaft,
            outer,
            thickness,
            ..
        } = self.size;
        0.5 * TAU * shaft * shaft * self.axis.length
            + 0.5 * thickness * (outer * outer - shaft * shaft) * (self.turn[1] - self.turn[0])
    }

    fn mirror(&self) -> f64 {
        match self.hand {
            Hand::Right => 1.0,
            Hand::Left => -1.0,
        }
    }

    fn query(&self, x: DVec3) -> Query {
        let apart = x - self.axis.from;
        let (u, v) = (
            apart.dot(self.axis.across[0]),
            apart.dot(self.axis.across[1]) * self.mirror(),
        );
        let (rho, phi, z) = (u.hypot(v), v.atan2(u), apart.dot(self.axis.along));
        let over = z - self.rise * phi;
        let turn = (over / self.size.pitch).round();
        let height = over - turn * self.size.pitch;
        let angle = phi + TAU * turn;
        let covered = height.abs() <= 0.5 * self.size.thickness
            && self.turn[0] <= angle
            && angle <= self.turn[1];
        Query {
            rho,
            phi,
            z,
            turn,
            angle,
            height,
            covered,
        }
    }

    fn is_inside(&self, q: &Query) -> bool {
        let in_shaft = q.rho <= self.size.shaft && q.z >= 0.0 && q.z <= self.axis.length;
        in_shaft || q.rho <= self.size.outer && q.covered
    }

    /// A vector of the query's cylindrical frame in space.
    fn turned_back(&self, q: &Query, v: DVec3) -> DVec3 {
        let (sin, cos) = q.phi.sin_cos();
        self.axis.across[0] * (v.x * cos - v.y * sin)
            + self.axis.across[1] * (self.mirror() * (v.x * sin + v.y * cos))
            + self.axis.along * v.z
    }

    fn each_foot(&self, q: &Query, mut see: impl FnMut(Foot)) {
        if self.is_inside(q) {
            see(self.way_out(q));
        } else {
            self.feet_outside(q, see);
        }
    }
}

impl Solid<Space> for Screw {
    fn distance(&self, x: DVec3) -> f64 {
        let mut nearest = f64::INFINITY;
        self.each_foot(&self.query(x), |foot| {
            if foot.distance.abs() < nearest.abs() {
                nearest = foot.distance;
            }
        });
        nearest
    }

    fn feet(&self, x: DVec3, of: u32, out: &mut HitBuffer<Space>) {
        let q = self.query(x);
        self.each_foot(&q, |foot| {
            out.hits.push(Hit {
                of,
                distance: foot.distance,
                normal: self.turned_back(&q, foot.normal),
                feature: foot.part as u32,
            });
        });
    }
}

impl Surface<Space> for Screw {
    fn lower_bound(&self, x: DVec3) -> f64 {
        let q = self.query(x);
        if self.is_inside(&q) {
            return self.way_out(&q).distance;
        }
        let around = DVec3::new(
            (q.rho - self.size.outer).max(0.0),
            0.0,
            (q.z - self.axis.length).max(-q.z).max(0.0),
        )
        .length();
        // A way to the endless flight either crosses the shaft or stays where the height over the
        // flight changes by at most √(1 + (c/rs)²) per length of way.
        let steepest = (self.rise / self.size.shaft).hypot(1.0);
        let flight = (q.height.abs() - 0.5 * self.size.thickness).max(0.0) / steepest;
        around.max(flight.min(q.rho - self.size.shaft))
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        hits_of(self, x, reach, out);
    }

    /// The two helices of the rim, the ends of the shaft and four lines along it.
    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        clipped(self.outline_segments(), low, high)
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some(self.axis.bounds(0.0, self.axis.length, self.size.outer))
    }

    fn shell(&self) -> Option<Shell> {
        Some(self.mesh(0.005 * self.size.outer))
    }
}

#[cfg(test)]
mod tests;
