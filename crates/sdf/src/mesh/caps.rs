//! Closing a mesh by cones over the rims of its holes, so that inside and outside are definite.

use super::Mesh;
use super::edges::{Edges, Groups};
use crate::winding::Winding;
use glam::DVec3;
use std::collections::BTreeMap;

/// Accuracy of winding numbers that are whole: an error of 0.07 is far from ½.
const WHOLE: f64 = 2.0;

impl Mesh {
    /// Triangles that make every edge run as often one way as the other: from each rim a cone to its middle.
    ///
    /// Edges that run once too often one way form closed lines, and a cone over a closed line has
    /// no other edge. So this closes any mesh, also where three faces meet or a face looks the wrong way
    /// (the cone then doubles it the right way round). Returns an empty list for a closed mesh.
    pub(crate) fn caps(&self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        // Each edge as many times as it is in excess, against the way it runs in excess.
        let mut wanted: Vec<(u32, u32)> = Vec::new();
        let mut rims = Groups::new(self.vertices.len());
        for sides in Edges::of(self).each() {
            let (a, b) = sides[0].edge;
            let forward = sides.iter().filter(|s| s.forward).count();
            let backward = sides.len() - forward;
            for _ in backward..forward {
                wanted.push((b, a));
            }
            for _ in forward..backward {
                wanted.push((a, b));
            }
            if forward != backward {
                rims.join(a, b);
            }
        }
        // The middle of a rim is that of its edges' middles, weighted by length.
        let mut middles: BTreeMap<u32, (DVec3, f64)> = BTreeMap::new();
        for &(a, b) in &wanted {
            let (p, q) = (self.vertices[a as usize], self.vertices[b as usize]);
            let length = (q - p).length();
            let (sum, weight) = middles.entry(rims.of(a)).or_default();
            *sum += 0.5 * length * (p + q);
            *weight += length;
        }
        let mut tips = Vec::new();
        let mut tip_of = BTreeMap::new();
        for (rim, (sum, weight)) in middles {
            tip_of.insert(rim, (self.vertices.len() + tips.len()) as u32);
            tips.push(sum / weight);
        }
        let cones = wanted
            .into_iter()
            .map(|(a, b)| [a, b, tip_of[&rims.of(a)]])
            .collect();
        (tips, cones)
    }

    /// The mesh closed by [`Mesh::caps`]: first with all caps, for the winding number, then with those
    /// that separate inside from outside at a distance of `off` m, for distances.
    ///
    /// The other caps stand inside the body, as where two rims face each other across a crack.
    pub(crate) fn capped(&self, off: f64) -> (Winding, Self) {
        let (tips, cones) = self.caps();
        if cones.is_empty() {
            return (Winding::with_accuracy(self, WHOLE), self.clone());
        }
        let mut closed = self.clone();
        closed.vertices.extend(tips);
        let first = closed.triangles.len();
        closed.triangles.extend(cones);
        let winding = Winding::with_accuracy(&closed, WHOLE);
        let keeps = |t: usize| {
            let corners = closed.corners(t);
            let Some(normal) = super::double_area(corners).try_normalize() else {
                return false;
            };
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            winding.inside(middle + normal * off) != winding.inside(middle - normal * off)
        };
        let kept: Vec<_> = (first..closed.triangles.len())
            .filter(|&t| keeps(t))
            .map(|t| closed.triangles[t])
            .collect();
        closed.triangles.truncate(first);
        closed.triangles.extend(kept);
        (winding, closed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples;

    #[test]
    fn caps_close_any_mesh() {
        let mut mixed = samples::with_holes(samples::ball(1.0, 20), 0.05);
        for t in (0..mixed.triangles.len()).step_by(17) {
            mixed.triangles[t].swap(1, 2);
        }
        for mesh in [
            mixed,
            samples::moebius(20),
            samples::sheet(3, 3, |i, j| DVec3::new(i as f64, j as f64, 0.0)),
        ] {
            assert!(!Edges::of(&mesh).balanced());
            let (tips, cones) = mesh.caps();
            let mut closed = mesh.clone();
            closed.vertices.extend(tips);
            closed.triangles.extend(cones);
            assert!(Edges::of(&closed).balanced());
        }
    }

    #[test]
    fn a_hole_is_covered_and_a_crack_is_not() {
        let mut holed = samples::cuboid(DVec3::ONE, 4);
        let full = holed.triangles.len();
        holed.triangles.remove(20);
        assert_eq!(holed.capped(0.01).1.triangles.len(), full + 2);
        // Two halves of a box, open to each other, a hair apart.
        let half = |side: f64| {
            let mut half = samples::moved(
                samples::cuboid(DVec3::new(1.0, 1.0, 1.0), 2),
                DVec3::new(0.5 * side + 1e-5 * side, 0.0, 0.0),
            );
            let at = |t: &[u32; 3]| t.iter().all(|&v| half.vertices[v as usize].x.abs() < 1e-3);
            let keep: Vec<_> = half.triangles.iter().filter(|t| !at(t)).copied().collect();
            half.triangles = keep;
            half
        };
        let mut cracked = half(1.0);
        samples::append(&mut cracked, &half(-1.0));
        assert_eq!(
            cracked.capped(0.01).1.triangles.len(),
            cracked.triangles.len()
        );
    }
}
