//! Which places of a mesh one grain touches: the minima of the distance that it can see.

use super::ExactMesh;
use crate::triangle::{Place, closest, crossing};
use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Space};

/// Contacts whose normals are closer than this are one contact: cosine of 30°, as for smooth faces.
const SAME_DIRECTION: f64 = crate::mesh::edges::SMOOTH;

/// The closest point of one triangle near a grain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    distance: f64,
    triangle: u32,
    point: DVec3,
    place: Place,
}

impl ExactMesh {
    /// Every minimum of the distance from x within `reach`, x being outside; `scratch` is kept by the caller.
    pub(super) fn minima(
        &self,
        of: u32,
        x: DVec3,
        reach: f64,
        scratch: &mut Vec<Candidate>,
        out: &mut HitBuffer<Space>,
    ) {
        let half = self.half_wall.unwrap_or(0.0);
        scratch.clear();
        self.tree.near(x, reach + half, |triangle| {
            let (point, place) = closest(self.tree.corners(triangle), x);
            let distance = (point - x).length();
            if distance < reach + half {
                scratch.push(Candidate {
                    distance,
                    triangle,
                    point,
                    place,
                });
            }
        });
        scratch.sort_unstable_by(|a, b| {
            (a.distance.total_cmp(&b.distance)).then(a.triangle.cmp(&b.triangle))
        });
        let first = out.hits.len();
        for (rank, candidate) in scratch.iter().enumerate() {
            let (distance, normal) = self.seen(x, candidate.point, candidate.triangle, false);
            let known = out.hits[first..]
                .iter()
                .any(|hit| hit.normal.dot(normal) > SAME_DIRECTION);
            if known
                || !self.is_minimum(candidate, &scratch[..rank])
                || self.is_hidden(x, candidate, &scratch[..rank])
            {
                continue;
            }
            let mut feature = self.feature(candidate, scratch);
            // Both sides of a bend of one smooth face are two contacts and need two names.
            if out.hits[first..].iter().any(|hit| hit.feature == feature) {
                feature = candidate.triangle;
            }
            while out.hits[first..].iter().any(|hit| hit.feature == feature) {
                feature = feature.wrapping_add(1);
            }
            out.hits.push(Hit {
                of,
                distance: distance - half,
                normal,
                feature,
            });
        }
    }

    /// The smallest name among the faces that meet at the point, whichever of them rounding puts first.
    fn feature(&self, candidate: &Candidate, all: &[Candidate]) -> u32 {
        let meets = |c: &&Candidate| {
            c.distance <= candidate.distance * (1.0 + 1e-9)
                && (c.point - candidate.point).length() <= 1e-9 * candidate.distance
        };
        let own = self.faces[candidate.triangle as usize];
        all.iter()
            .filter(meets)
            .map(|c| self.faces[c.triangle as usize])
            .fold(own, u32::min)
    }

    /// True if no closer triangle shares the side or corner on which the point lies.
    fn is_minimum(&self, candidate: &Candidate, closer: &[Candidate]) -> bool {
        let corners = self.mesh.triangles[candidate.triangle as usize];
        let holds =
            |other: &Candidate, v: u32| self.mesh.triangles[other.triangle as usize].contains(&v);
        // Equal up to rounding is the same point seen from the neighbour.
        let beats = |other: &&Candidate| other.distance < candidate.distance * (1.0 - 1e-9);
        match candidate.place {
            Place::Face => true,
            Place::Corner(k) => !closer.iter().filter(beats).any(|c| holds(c, corners[k])),
            Place::Side(k) => {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                !closer
                    .iter()
                    .filter(beats)
                    .any(|c| holds(c, a) && holds(c, b))
            }
        }
    }

    /// True if a closer triangle stands between x and the point.
    fn is_hidden(&self, x: DVec3, candidate: &Candidate, closer: &[Candidate]) -> bool {
        closer.iter().any(|c| {
            crossing(self.tree.corners(c.triangle), x, candidate.point - x)
                .is_some_and(|at| at > 0.0 && at < 1.0 - 1e-9)
        })
    }
}
