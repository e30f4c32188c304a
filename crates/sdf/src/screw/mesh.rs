//! A screw as one closed shell: shaft and flight joined along the two helices of the flight's root.

use super::Screw;
use crate::drawing::{circle, steps_for};
use glam::DVec3;
use std::f64::consts::TAU;
use tsubu_model::Shell;

/// Steps per turn in outlines.
const OUTLINE_STEPS: usize = 48;

/// The lines on the shaft, parallel to the axis, through which all corners of the shell go.
struct Lines {
    /// Where they lie, as shares of a turn from the beginning of the flight, rising from 0.
    shares: Vec<f64>,
    /// The number of the last section of the flight; section i lies on line i modulo their number.
    last: usize,
}

impl Lines {
    /// `steps` lines and, unless one of them is there, one through the end of the flight.
    fn new(turns: f64, steps: usize) -> Self {
        let mut shares: Vec<f64> = (0..steps).map(|k| k as f64 / steps as f64).collect();
        let end = turns * steps as f64;
        if (end - end.round()).abs() < 1e-6 {
            let last = end.round() as usize;
            return Self { shares, last };
        }
        let share = turns.fract();
        let place = shares.partition_point(|&s| s < share);
        shares.insert(place, share);
        let last = turns.floor() as usize * shares.len() + place;
        Self { shares, last }
    }

    fn count(&self) -> usize {
        self.shares.len()
    }

    /// Turns from the beginning of the flight to section `i`.
    fn turns(&self, i: usize) -> f64 {
        (i / self.count()) as f64 + self.shares[i % self.count()]
    }

    /// The sections that lie on line `j`, from the beginning on.
    fn sections(&self, j: usize) -> impl Iterator<Item = usize> {
        (j..=self.last).step_by(self.count())
    }
}

/// The shell while it grows, in the right-handed frame of the screw.
struct Growth<'a> {
    screw: &'a Screw,
    lines: Lines,
    /// Radial strips of a face.
    strips: usize,
    shell: Shell,
}

impl Screw {
    /// A closed mesh of one piece that is nowhere farther than `chord` (m) from the surface.
    ///
    /// A turn is cut so that chords of the rim keep the bound, r(1 − cos(π/steps)) ≤ chord, and a face
    /// into radial strips so that the triangles of a twisted quad do, Δr Δφ c/(4√(rs² + c²)) ≤ chord.
    pub fn mesh(&self, chord: f64) -> Shell {
        let steps = steps_for(self.size.outer, chord);
        let step = TAU / steps as f64;
        let wide = self.size.outer - self.size.shaft;
        let twist = 0.25 * wide * step * self.rise / self.size.shaft.hypot(self.rise);
        let mut growth = Growth {
            screw: self,
            lines: Lines::new((self.turn[1] - self.turn[0]) / TAU, steps),
            strips: (twist / chord).ceil().clamp(1.0, 1024.0) as usize,
            shell: Shell::default(),
        };
        growth.corners();
        growth.flight();
        growth.shaft();
        let mut shell = growth.shell;
        if self.mirror() < 0.0 {
            for triangle in &mut shell.triangles {
                triangle.swap(1, 2);
            }
        }
        shell
    }

    /// What [`outline`](tsubu_model::Surface::outline) draws before it is clipped.
    pub(super) fn outline_segments(&self) -> Vec<[DVec3; 2]> {
        let (rs, ro, l) = (self.size.shaft, self.size.outer, self.axis.length);
        let [u, v] = self.axis.across;
        let mut segments = Vec::new();
        for along in [0.0, l] {
            segments.extend(circle(self.axis.point(along, 0.0, 0.0), u, v, rs));
        }
        for (cos, sin) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
            let at = |along| self.axis.point(along, rs * cos, rs * sin);
            segments.push([at(0.0), at(l)]);
        }
        let [first, last] = self.turn;
        let count = ((last - first) / TAU * OUTLINE_STEPS as f64).ceil() as usize;
        let angle = |k: usize| first + (last - first) * k as f64 / count as f64;
        for half in [-0.5, 0.5].map(|side| side * self.size.thickness) {
            let at = |k: usize| self.corner(ro, angle(k), half);
            segments.extend((0..count).map(|k| [at(k), at(k + 1)]));
            for end in [0, count] {
                segments.push([self.corner(rs, angle(end), half), at(end)]);
            }
        }
        segments
    }

    /// The point at radius `r` and unrolled angle, `over` the middle of the flight.
    pub(super) fn corner(&self, r: f64, angle: f64, over: f64) -> DVec3 {
        let (sin, cos) = angle.sin_cos();
        self.axis
            .point(self.rise * angle + over, r * cos, r * sin * self.mirror())
    }
}

impl Growth<'_> {
    /// Corner `m` from the shaft of section `i` of the flight, on its front or back face.
    fn on_flight(&self, i: usize, m: usize, front: bool) -> u32 {
        ((2 * i + usize::from(front)) * (self.strips + 1) + m) as u32
    }

    /// Corner of line `j` at the beginning or the end of the shaft.
    fn on_end(&self, j: usize, end: bool) -> u32 {
        let first = 2 * (self.lines.last + 1) * (self.strips + 1);
        (first + 2 * j + usize::from(end)) as u32
    }

    fn corners(&mut self) {
        let screw = self.screw;
        let (rs, ro) = (screw.size.shaft, screw.size.outer);
        let half = 0.5 * screw.size.thickness;
        for i in 0..=self.lines.last {
            let angle = screw.turn[0] + TAU * self.lines.turns(i);
            for over in [-half, half] {
                for m in 0..=self.strips {
                    let r = rs + (ro - rs) * m as f64 / self.strips as f64;
                    self.shell.vertices.push(screw.corner(r, angle, over));
                }
            }
        }
        for &share in &self.lines.shares {
            let angle = screw.turn[0] + TAU * share;
            for along in [0.0, screw.axis.length] {
                let over = along - screw.rise * angle;
                self.shell.vertices.push(screw.corner(rs, angle, over));
            }
        }
        for along in [0.0, screw.axis.length] {
            self.shell.vertices.push(screw.axis.point(along, 0.0, 0.0));
        }
    }

    /// Two triangles of a quad, counter-clockwise from outside.
    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.shell.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// Both faces, the rim and the flat ends.
    fn flight(&mut self) {
        let (last, strips) = (self.lines.last, self.strips);
        for i in 0..last {
            for m in 0..strips {
                let face = |s: &Self, front| {
                    [(i, m), (i, m + 1), (i + 1, m + 1), (i + 1, m)]
                        .map(|(i, m)| s.on_flight(i, m, front))
                };
                let [a, b, c, d] = face(self, true);
                self.quad([a, b, c, d]);
                let [a, b, c, d] = face(self, false);
                self.quad([d, c, b, a]);
            }
            let at = |i, front| self.on_flight(i, strips, front);
            self.quad([at(i, false), at(i + 1, false), at(i + 1, true), at(i, true)]);
        }
        for m in 0..strips {
            for i in [0, last] {
                let at = |m, front| self.on_flight(i, m, front);
                let [a, b, c, d] = [at(m, false), at(m + 1, false), at(m + 1, true), at(m, true)];
                self.quad(if i == 0 { [a, b, c, d] } else { [d, c, b, a] });
            }
        }
    }

    /// The bare strips of the shaft between its lines, and its ends.
    fn shaft(&mut self) {
        let count = self.lines.count();
        let centre = self.on_end(count, false);
        for j in 0..count {
            let next = (j + 1) % count;
            let (left, right) = (self.line(j), self.line(next));
            let mut from = [self.on_end(j, false), self.on_end(next, false)];
            let last = self.lines.last;
            let covering: Vec<usize> = self.lines.sections(j).filter(|&i| i < last).collect();
            for i in covering {
                let root = |front| [self.on_flight(i, 0, front), self.on_flight(i + 1, 0, front)];
                let (to, after) = (root(false), root(true));
                self.zip(&left, &right, from, to);
                from = after;
            }
            let end = [self.on_end(j, true), self.on_end(next, true)];
            self.zip(&left, &right, from, end);
            let [a, b] = [self.on_end(j, false), self.on_end(next, false)];
            self.shell.triangles.push([centre, b, a]);
            self.shell.triangles.push([centre + 1, end[0], end[1]]);
        }
    }

    /// All corners on line `j`, from the beginning of the shaft to its end.
    fn line(&self, j: usize) -> Vec<u32> {
        let mut line = vec![self.on_end(j, false)];
        for i in self.lines.sections(j) {
            line.extend([self.on_flight(i, 0, false), self.on_flight(i, 0, true)]);
        }
        line.push(self.on_end(j, true));
        line
    }

    /// Triangles between two neighbouring lines, `from` a corner of each `to` a corner of each.
    /// The lines are parallel, so every triangle lies in their common plane.
    fn zip(&mut self, left: &[u32], right: &[u32], from: [u32; 2], to: [u32; 2]) {
        let part = |line: &[u32], from: u32, to: u32| -> Vec<u32> {
            let place = |corner| line.iter().position(|&c| c == corner).unwrap_or(0);
            line[place(from)..=place(to)].to_vec()
        };
        let (left, right) = (part(left, from[0], to[0]), part(right, from[1], to[1]));
        let along = |corner: u32| {
            let apart = self.shell.vertices[corner as usize] - self.screw.axis.from;
            apart.dot(self.screw.axis.along)
        };
        let (mut a, mut b) = (0, 0);
        let mut triangles = Vec::new();
        while a + 1 < left.len() || b + 1 < right.len() {
            let left_first = b + 1 == right.len()
                || a + 1 < left.len() && along(left[a + 1]) <= along(right[b + 1]);
            if left_first {
                triangles.push([left[a], right[b], left[a + 1]]);
                a += 1;
            } else {
                triangles.push([left[a], right[b], right[b + 1]]);
                b += 1;
            }
        }
        self.shell.triangles.extend(triangles);
    }
}
