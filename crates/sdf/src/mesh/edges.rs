//! Which triangles meet at which edge: the base of the doctor, of orientation and of feature lines.

use super::{Mesh, double_area};

/// One side of a triangle, listed under its edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    /// The edge: its two vertices, the smaller first.
    pub edge: (u32, u32),
    /// The triangle.
    pub triangle: u32,
    /// True if the triangle runs from the smaller to the larger vertex.
    pub forward: bool,
}

/// All sides, sorted by edge, so that those of one edge stand together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Edges {
    sides: Vec<Side>,
}

impl Edges {
    pub fn of(mesh: &Mesh) -> Self {
        let mut sides: Vec<Side> = mesh
            .triangles
            .iter()
            .enumerate()
            .flat_map(|(t, &[a, b, c])| {
                [(a, b), (b, c), (c, a)].map(|(p, q)| Side {
                    edge: (p.min(q), p.max(q)),
                    triangle: t as u32,
                    forward: p < q,
                })
            })
            .collect();
        sides.sort_unstable_by_key(|s| (s.edge, s.triangle, s.forward));
        Self { sides }
    }

    /// The sides of each edge in turn.
    pub fn each(&self) -> impl Iterator<Item = &[Side]> {
        self.sides.chunk_by(|a, b| a.edge == b.edge)
    }

    /// True if every edge is run as often one way as the other.
    ///
    /// Then the winding number is a whole number everywhere off the surface, and jumps only at it.
    pub fn balanced(&self) -> bool {
        self.each().all(balance_is_zero)
    }
}

/// As many sides run forward as backward.
pub(crate) fn balance_is_zero(sides: &[Side]) -> bool {
    2 * sides.iter().filter(|s| s.forward).count() == sides.len()
}

/// Sets that grow together; the smallest member names a set.
#[derive(Clone, Debug)]
pub(crate) struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    pub fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    pub fn of(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            // Halving the path keeps later searches short.
            let above = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = above;
            member = above;
        }
        member
    }

    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.of(a), self.of(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// The name of each member's set.
    pub fn names(mut self) -> Vec<u32> {
        (0..self.parent.len() as u32).map(|m| self.of(m)).collect()
    }
}

/// Triangles that meet at an angle below this belong to one smooth face: cosine of 30°.
///
/// A round part drawn with a dozen strips or more is one face; the corner of a box, or the one
/// between a flight and its shaft, is not.
pub(crate) const SMOOTH: f64 = 0.866_025_403_784_438_6;

/// For each triangle the smallest triangle of its smooth face; and the sharp or open edges.
pub(crate) fn smooth_faces(mesh: &Mesh) -> (Vec<u32>, Vec<(u32, u32)>) {
    let normal = |t: u32| double_area(mesh.corners(t as usize)).normalize_or_zero();
    let mut groups = Groups::new(mesh.triangles.len());
    let mut sharp = Vec::new();
    for sides in Edges::of(mesh).each() {
        match *sides {
            [a, b] => {
                let turned = if a.forward == b.forward { -1.0 } else { 1.0 };
                if normal(a.triangle).dot(normal(b.triangle)) * turned > SMOOTH {
                    groups.join(a.triangle, b.triangle);
                } else {
                    sharp.push(a.edge);
                }
            }
            _ => sharp.push(sides[0].edge),
        }
    }
    (groups.names(), sharp)
}
