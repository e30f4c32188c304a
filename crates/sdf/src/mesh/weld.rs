//! Welding: corners that are meant to be one become one, and faces that mean nothing go.

use super::{Mesh, double_area};
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// What [`Mesh::weld`] and [`Mesh::orient`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Welded {
    /// Vertices that were merged into another.
    pub merged: usize,
    /// Faces removed because two corners are one or all three lie on a line.
    pub degenerate: usize,
    /// Faces removed because the same face, seen from the same side, came before.
    pub duplicate: usize,
    /// Faces turned round to agree with their neighbours, or with the outside of a closed body.
    pub turned: usize,
}

impl Welded {
    /// True if nothing had to be done.
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

impl Mesh {
    /// Merges vertices within `tolerance` m of each other and removes faces without area and
    /// repeated faces. Vertices that no face uses are dropped and not counted.
    ///
    /// Of vertices close together the first one in the file stays where it is. Two equal faces seen
    /// from opposite sides both stay: they bound nothing, and winding numbers see just that.
    pub fn weld(&mut self, tolerance: f64) -> Welded {
        let mut done = Welded::default();
        // A tolerance below the rounding of the coordinates is none.
        let furthest = self
            .vertices
            .iter()
            .fold(0.0, |m, v| v.abs().max_element().max(m));
        let tolerance = if tolerance > 1e-15 * furthest {
            tolerance
        } else {
            0.0
        };
        let joined = self.join_vertices(tolerance, &mut done);
        let mut seen = HashSet::with_capacity(self.triangles.len());
        let mut kept = Vec::with_capacity(self.triangles.len());
        let mut part_of_old = 0;
        let mut counts = vec![0; self.parts.len()];
        for (t, triangle) in self.triangles.iter().enumerate() {
            while self
                .parts
                .get(part_of_old)
                .is_some_and(|p| t >= p.first + p.count)
            {
                part_of_old += 1;
            }
            let [a, b, c] = triangle.map(|v| joined[v as usize]);
            if a == b || b == c || c == a || self.is_flat([a, b, c]) {
                done.degenerate += 1;
                continue;
            }
            // The same corners in the same turn, whichever comes first.
            let least = a.min(b).min(c);
            let turn = if least == a {
                [a, b, c]
            } else if least == b {
                [b, c, a]
            } else {
                [c, a, b]
            };
            if !seen.insert(turn) {
                done.duplicate += 1;
                continue;
            }
            kept.push([a, b, c]);
            if let Some(count) = counts.get_mut(part_of_old) {
                *count += 1;
            }
        }
        self.triangles = kept;
        let mut first = 0;
        for (part, count) in self.parts.iter_mut().zip(counts) {
            (part.first, part.count) = (first, count);
            first += count;
        }
        self.parts.retain(|part| part.count > 0);
        self.drop_unused();
        done
    }

    /// Welds within a millionth of the diagonal and orients: what every surface made of a mesh does first.
    pub fn repaired(&self) -> (Self, Welded) {
        let mut mesh = self.clone();
        let mut done = mesh.weld(1e-6 * mesh.diagonal());
        done.turned = mesh.orient();
        (mesh, done)
    }

    /// For each vertex the one that stands for it.
    fn join_vertices(&self, tolerance: f64, done: &mut Welded) -> Vec<u32> {
        // Cells of the tolerance's size: whatever is close enough lies in a cell that touches ours.
        let cell_of = |v: DVec3| {
            if tolerance > 0.0 {
                (v / tolerance).floor().to_array().map(|x| x as i64)
            } else {
                (v + DVec3::ZERO).to_array().map(|x| x.to_bits() as i64)
            }
        };
        let span = if tolerance > 0.0 { -1..=1 } else { 0..=0 };
        let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::with_capacity(self.vertices.len());
        let mut joined = Vec::with_capacity(self.vertices.len());
        for (index, &v) in self.vertices.iter().enumerate() {
            let [i, j, k] = cell_of(v);
            let mut nearest: Option<(f64, u32)> = None;
            for (x, y, z) in span
                .clone()
                .flat_map(|x| span.clone().map(move |y| (x, y)))
                .flat_map(|(x, y)| span.clone().map(move |z| (x, y, z)))
            {
                let key = [
                    i.saturating_add(x),
                    j.saturating_add(y),
                    k.saturating_add(z),
                ];
                for &other in cells.get(&key).into_iter().flatten() {
                    let apart = (self.vertices[other as usize] - v).length();
                    let candidate = (apart, other);
                    if apart <= tolerance && nearest.is_none_or(|n| candidate < n) {
                        nearest = Some(candidate);
                    }
                }
            }
            match nearest {
                Some((_, other)) => {
                    done.merged += 1;
                    joined.push(other);
                }
                None => {
                    cells.entry([i, j, k]).or_default().push(index as u32);
                    joined.push(index as u32);
                }
            }
        }
        joined
    }

    /// A triangle without height: its area is rounding beside its longest side.
    fn is_flat(&self, triangle: [u32; 3]) -> bool {
        let [a, b, c] = triangle.map(|v| self.vertices[v as usize]);
        let longest = (b - a)
            .length_squared()
            .max((c - b).length_squared())
            .max((a - c).length_squared());
        double_area([a, b, c]).length() <= 1e-12 * longest
    }

    fn drop_unused(&mut self) {
        let mut new = vec![u32::MAX; self.vertices.len()];
        let mut vertices = Vec::with_capacity(self.vertices.len());
        for v in self.triangles.iter_mut().flatten() {
            let slot = &mut new[*v as usize];
            if *slot == u32::MAX {
                *slot = vertices.len() as u32;
                vertices.push(self.vertices[*v as usize]);
            }
            *v = *slot;
        }
        self.vertices = vertices;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Part, samples};
    use proptest::prelude::*;

    #[test]
    fn a_soup_with_jitter_becomes_the_closed_body_again() {
        let ball = samples::ball(1.0, 16);
        let mut random = samples::Random::new(7);
        let mut soup = Mesh::default();
        for t in 0..ball.triangles.len() {
            let first = soup.vertices.len() as u32;
            soup.vertices
                .extend(ball.corners(t).map(|v| v + random.vector() * 1e-7));
            soup.triangles.push([first, first + 1, first + 2]);
        }
        let done = soup.weld(1e-6);
        assert_eq!(soup.vertices.len(), ball.vertices.len());
        assert_eq!(soup.triangles.len(), ball.triangles.len());
        assert_eq!(done.merged, 3 * ball.triangles.len() - ball.vertices.len());
        assert!(crate::mesh::edges::Edges::of(&soup).balanced());
    }

    #[test]
    fn useless_faces_go_and_parts_follow() {
        let mut mesh = samples::cuboid(DVec3::ONE, 1);
        let [a, b, c] = mesh.triangles[0];
        // In front: a repeated face (turned by one corner, not round), a needle, a point.
        mesh.triangles.push([b, c, a]);
        mesh.triangles.push([a, b, b]);
        mesh.triangles.push([c, b, a]);
        mesh.parts = vec![
            Part {
                name: "box".into(),
                first: 0,
                count: 12,
            },
            Part {
                name: "dirt".into(),
                first: 12,
                count: 2,
            },
            Part {
                name: "back".into(),
                first: 14,
                count: 1,
            },
        ];
        let done = mesh.weld(0.0);
        assert_eq!((done.merged, done.degenerate, done.duplicate), (0, 1, 1));
        assert_eq!(mesh.triangles.len(), 13);
        let names: Vec<_> = mesh
            .parts
            .iter()
            .map(|p| (&*p.name, p.first, p.count))
            .collect();
        assert_eq!(names, [("box", 0, 12), ("back", 12, 1)]);
    }

    proptest! {
        #[test]
        fn welding_twice_does_nothing_more_and_moves_nothing_far(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 3..40), tolerance in 0.0..0.5f64,
        ) {
            let count = points.len() as u32;
            let before = Mesh {
                vertices: points.into_iter().map(DVec3::from).collect(),
                triangles: (0..count - 2).map(|i| [i, i + 1, i + 2]).collect(),
                parts: Vec::new(),
            };
            let mut mesh = before.clone();
            mesh.weld(tolerance);
            for &v in mesh.triangles.iter().flatten() {
                prop_assert!(before.vertices.contains(&mesh.vertices[v as usize]));
            }
            let again = mesh.weld(tolerance);
            prop_assert_eq!(again.merged, 0);
            prop_assert!(again.is_nothing());
        }
    }
}
