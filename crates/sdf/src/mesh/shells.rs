//! The connected pieces of a mesh and what is wrong at their edges.

use super::edges::{Edges, Groups, balance_is_zero};
use super::{Mesh, volume_of};
use glam::DVec3;

/// One connected piece of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellReport {
    /// Its triangles.
    pub triangles: usize,
    /// True if every edge has as many faces one way as the other.
    pub closed: bool,
    /// Signed volume in m³; only a closed piece has one that means something.
    pub volume: f64,
    /// Lowest and highest corner in m.
    pub bounds: [DVec3; 2],
}

impl ShellReport {
    /// True if it is closed and its faces look inward; right for a cavity, wrong for a body.
    pub fn inside_out(&self) -> bool {
        self.closed && self.volume < 0.0
    }
}

/// Edges that do not join exactly two faces of one orientation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeReport {
    /// Edges of one face only.
    pub open: usize,
    /// Connected lines of open edges: the number of holes of a body.
    pub loops: usize,
    /// The largest extent of such a line in m.
    pub largest_loop: f64,
    /// Edges of three faces or more.
    pub shared: usize,
    /// Edges whose two faces disagree about the outside.
    pub inconsistent: usize,
}

impl EdgeReport {
    /// True if nothing is wrong.
    pub fn is_clean(&self) -> bool {
        self.open + self.shared + self.inconsistent == 0
    }
}

/// Counts the pieces, in order of their first triangle, and the faults of the edges.
pub(crate) fn shells(mesh: &Mesh) -> (Vec<ShellReport>, EdgeReport) {
    let edges = Edges::of(mesh);
    let mut pieces = Groups::new(mesh.triangles.len());
    let mut lines = Groups::new(mesh.vertices.len());
    let mut report = EdgeReport::default();
    let mut unbalanced = Vec::new();
    let mut ends = Vec::new();
    for sides in edges.each() {
        for pair in sides.windows(2) {
            pieces.join(pair[0].triangle, pair[1].triangle);
        }
        match sides {
            [one] => {
                report.open += 1;
                lines.join(one.edge.0, one.edge.1);
                ends.push(one.edge.0);
                ends.push(one.edge.1);
            }
            [a, b] => report.inconsistent += usize::from(a.forward == b.forward),
            _ => report.shared += 1,
        }
        if !balance_is_zero(sides) {
            unbalanced.push(sides[0].triangle);
        }
    }
    loops(mesh, &mut lines, &ends, &mut report);

    let [low, high] = mesh.bounds();
    let middle = 0.5 * (low + high);
    let names = pieces.names();
    // A piece is named by its first triangle, so its place in the list is known when that comes.
    let mut place = vec![0; mesh.triangles.len()];
    let mut found: Vec<ShellReport> = Vec::new();
    for (t, &name) in names.iter().enumerate() {
        if name as usize == t {
            place[t] = found.len();
            found.push(ShellReport {
                triangles: 0,
                closed: true,
                volume: 0.0,
                bounds: [DVec3::INFINITY, DVec3::NEG_INFINITY],
            });
        }
        let shell = &mut found[place[name as usize]];
        let corners = mesh.corners(t);
        shell.triangles += 1;
        shell.volume += volume_of(corners, middle);
        for v in corners {
            shell.bounds = [shell.bounds[0].min(v), shell.bounds[1].max(v)];
        }
    }
    for t in unbalanced {
        found[place[names[t as usize] as usize]].closed = false;
    }
    (found, report)
}

fn loops(mesh: &Mesh, lines: &mut Groups, ends: &[u32], report: &mut EdgeReport) {
    let mut boxes = std::collections::BTreeMap::new();
    for &end in ends {
        let v = mesh.vertices[end as usize];
        let [low, high] = boxes.entry(lines.of(end)).or_insert([v, v]);
        (*low, *high) = (low.min(v), high.max(v));
    }
    report.loops = boxes.len();
    report.largest_loop = boxes
        .values()
        .map(|[low, high]: &[DVec3; 2]| (*high - *low).length())
        .fold(0.0, f64::max);
}

/// True if the normals at the closest point tell inside from outside: closed pieces that face outward,
/// two faces at each edge, and no two pieces whose boxes meet.
pub(crate) fn is_clean(shells: &[ShellReport], edges: &EdgeReport) -> bool {
    // Comparing all boxes costs a square; a body of so many pieces is not worth it.
    edges.is_clean()
        && shells.len() <= 1000
        && shells.iter().all(|s| s.volume > 0.0)
        && shells.iter().enumerate().all(|(i, a)| {
            shells[..i].iter().all(|b| {
                let ([a0, a1], [b0, b1]) = (a.bounds, b.bounds);
                a0.cmpgt(b1).any() || b0.cmpgt(a1).any()
            })
        })
}
