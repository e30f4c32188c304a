//! Inside or outside of a mesh that need not be closed: the generalised winding number.

use crate::mesh::{Mesh, double_area};
use crate::triangle::SolidAngle;
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// Triangles in a leaf of the tree.
const LEAF: usize = 8;

/// How often a mesh goes round a point: w(x) = Σ Ωt(x) / 4π over the solid angles of its triangles.
///
/// For a closed mesh w is 1 inside and 0 outside, −1 inside one that is inside out, 2 where two bodies
/// overlap; beside a hole it changes smoothly, and a point counts as inside where |w| ≥ ½.
/// Far clusters of triangles act as the first two terms of their expansion about their centre,
/// at distances over `accuracy` times the cluster's radius. Sources: Jacobson2013 (the number), Barill2018 (the expansion).
#[derive(Clone, Debug)]
pub struct Winding {
    nodes: Vec<Node>,
    corners: Vec<[DVec3; 3]>,
    accuracy: f64,
}

#[derive(Clone, Debug)]
struct Node {
    center: DVec3,
    radius: f64,
    /// Σ area × normal.
    dipole: DVec3,
    /// Σ area × (centroid − center) ⊗ normal, made symmetric.
    spread: DMat3,
    /// First triangle of a leaf, or the second child of a branch (the first stands next to it).
    at: u32,
    /// Triangles of a leaf; 0 for a branch.
    count: u32,
}

impl Winding {
    /// Takes the triangles of a mesh whose [`Mesh::check`] passes, with `accuracy` = 3: errors up to about 0.03
    /// (measured on spheres and tori; they fall as its square), far from the ½ that is asked for.
    pub fn new(mesh: &Mesh) -> Self {
        Self::with_accuracy(mesh, 3.0)
    }

    /// As [`Winding::new`], with a chosen ratio of distance to radius; more is slower and closer.
    pub fn with_accuracy(mesh: &Mesh, accuracy: f64) -> Self {
        let mut corners: Vec<_> = (0..mesh.triangles.len()).map(|t| mesh.corners(t)).collect();
        let mut nodes = Vec::with_capacity(corners.len() / 2 + 1);
        if !corners.is_empty() {
            grow(&mut nodes, &mut corners, 0);
        }
        Self {
            nodes,
            corners,
            accuracy: accuracy.max(1.0),
        }
    }

    /// w(x) with far clusters approximated.
    pub fn at(&self, x: DVec3) -> f64 {
        let (mut far, mut near_by) = (0.0, SolidAngle::none());
        // Halving keeps the tree less than 32 deep, and one node waits per level.
        let mut waiting = [0u32; 64];
        let mut left = usize::from(!self.nodes.is_empty());
        while left > 0 {
            left -= 1;
            let index = waiting[left];
            let node = &self.nodes[index as usize];
            let to = node.center - x;
            let distance2 = to.length_squared();
            let near = self.accuracy * node.radius;
            if distance2 > near * near {
                let over = 1.0 / distance2.sqrt();
                let over3 = over * over * over;
                let trace = node.spread.x_axis.x + node.spread.y_axis.y + node.spread.z_axis.z;
                far += over3
                    * (node.dipole.dot(to) + trace - 3.0 * to.dot(node.spread * to) * over * over);
            } else if node.count > 0 {
                let first = node.at as usize;
                for &triangle in &self.corners[first..first + node.count as usize] {
                    near_by.add(triangle, x);
                }
            } else {
                waiting[left] = node.at;
                waiting[left + 1] = index + 1;
                left += 2;
            }
        }
        (far + near_by.total()) / (4.0 * PI)
    }

    /// w(x) as the sum over every triangle.
    pub fn exact(&self, x: DVec3) -> f64 {
        let mut sum = SolidAngle::none();
        self.corners.iter().for_each(|&t| sum.add(t, x));
        sum.total() / (4.0 * PI)
    }

    /// True where |w| ≥ ½.
    pub fn inside(&self, x: DVec3) -> bool {
        self.at(x).abs() >= 0.5
    }
}

/// Builds the tree over these triangles, halving them along their longest axis; `first` is their place.
fn grow(nodes: &mut Vec<Node>, corners: &mut [[DVec3; 3]], first: usize) {
    let index = nodes.len();
    nodes.push(summed(corners));
    if corners.len() <= LEAF {
        nodes[index].at = first as u32;
        nodes[index].count = corners.len() as u32;
        return;
    }
    let centroid = |t: &[DVec3; 3]| t[0] + t[1] + t[2];
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for t in corners.iter() {
        low = low.min(centroid(t));
        high = high.max(centroid(t));
    }
    let size = (high - low).to_array();
    let axis = (0..3).fold(0, |best, a| if size[a] > size[best] { a } else { best });
    let half = corners.len() / 2;
    corners.select_nth_unstable_by(half, |a, b| centroid(a)[axis].total_cmp(&centroid(b)[axis]));
    let (left, right) = corners.split_at_mut(half);
    grow(nodes, left, first);
    nodes[index].at = nodes.len() as u32;
    grow(nodes, right, first + half);
}

fn summed(corners: &[[DVec3; 3]]) -> Node {
    let (mut weight, mut center) = (0.0, DVec3::ZERO);
    for &t in corners {
        let area = 0.5 * double_area(t).length();
        weight += area;
        center += area * (t[0] + t[1] + t[2]) / 3.0;
    }
    center = if weight > 0.0 {
        center / weight
    } else {
        corners[0][0]
    };
    let mut node = Node {
        center,
        radius: 0.0,
        dipole: DVec3::ZERO,
        spread: DMat3::ZERO,
        at: 0,
        count: 0,
    };
    for &t in corners {
        let normal = 0.5 * double_area(t);
        let arm = (t[0] + t[1] + t[2]) / 3.0 - center;
        node.dipole += normal;
        // Symmetric, because only the symmetric part acts.
        node.spread += DMat3::from_cols(
            arm * normal.x + normal * arm.x,
            arm * normal.y + normal * arm.y,
            arm * normal.z + normal * arm.z,
        ) * 0.5;
        for v in t {
            node.radius = node.radius.max((v - center).length());
        }
    }
    node
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples::{self, Random};

    /// Largest difference from the exact sum, and from the nearest whole number, over random points.
    fn errors(mesh: &Mesh, accuracy: f64) -> (f64, f64) {
        let winding = Winding::with_accuracy(mesh, accuracy);
        let [low, high] = mesh.bounds();
        let margin = 0.2 * (high - low);
        let mut random = Random::new(3);
        let (mut from_exact, mut from_whole) = (0.0f64, 0.0f64);
        for _ in 0..2000 {
            let x = random.within(low - margin, high + margin);
            let (fast, exact) = (winding.at(x), winding.exact(x));
            from_exact = from_exact.max((fast - exact).abs());
            from_whole = from_whole.max((exact - exact.round()).abs());
        }
        (from_exact, from_whole)
    }

    #[test]
    fn the_fast_sum_is_close_to_the_exact_one() {
        let mut overlapping = samples::ball(1.0, 24);
        samples::append(
            &mut overlapping,
            &samples::moved(samples::torus(1.0, 0.3, 40), DVec3::X),
        );
        let mut flipped = samples::torus(1.0, 0.3, 40);
        flipped
            .triangles
            .iter_mut()
            .step_by(20)
            .for_each(|t| t.swap(1, 2));
        for mesh in [&samples::ball(1.0, 40), &overlapping] {
            let (from_exact, from_whole) = errors(mesh, 3.0);
            assert!(from_exact < 0.05, "{from_exact}");
            assert!(from_whole < 1e-9, "{from_whole}");
        }
        assert!(errors(&flipped, 3.0).0 < 0.05);
        assert!(errors(&flipped, 6.0).0 < 0.0125);
    }

    #[test]
    fn it_counts_how_often_the_mesh_goes_round() {
        let mut two = samples::cuboid(DVec3::splat(2.0), 4);
        samples::append(
            &mut two,
            &samples::moved(samples::cuboid(DVec3::splat(2.0), 4), DVec3::X),
        );
        let winding = Winding::new(&two);
        for (x, w) in [(-0.5, 1.0), (0.5, 2.0), (1.5, 1.0), (2.5, 0.0)] {
            let got = winding.at(DVec3::new(x, 0.1, 0.2));
            assert!((got - w).abs() < 0.05, "{x}: {got}");
        }
        two.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        assert!((Winding::new(&two).at(DVec3::new(-0.5, 0.1, 0.2)) + 1.0).abs() < 0.05);
        assert!(Winding::new(&two).inside(DVec3::new(-0.5, 0.0, 0.0)));
        assert_eq!(Winding::new(&Mesh::default()).at(DVec3::ZERO), 0.0);
    }
}
