//! The sharp edges of a mesh as line segments within a box.

use super::{Mesh, edges::smooth_faces};
use glam::DVec3;

impl Mesh {
    /// Edges where faces meet at 30° or more, or that only one face has, clipped to the box `low`–`high`.
    pub fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        smooth_faces(self)
            .1
            .into_iter()
            .filter_map(|(a, b)| {
                clip(
                    self.vertices[a as usize],
                    self.vertices[b as usize],
                    low,
                    high,
                )
            })
            .collect()
    }
}

/// The part of a segment within a box.
fn clip(a: DVec3, b: DVec3, low: DVec3, high: DVec3) -> Option<[DVec3; 2]> {
    let along = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..3 {
        if along[axis] == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return None;
            }
        } else {
            let s = (low[axis] - a[axis]) / along[axis];
            let t = (high[axis] - a[axis]) / along[axis];
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        }
    }
    (from < to).then(|| [a + along * from, a + along * to])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples;

    #[test]
    fn a_box_is_drawn_by_its_twelve_edges() {
        let lines = samples::cuboid(DVec3::ONE, 1).outline(DVec3::splat(-9.0), DVec3::splat(9.0));
        assert_eq!(lines.len(), 12);
        let half = samples::cuboid(DVec3::ONE, 1).outline(DVec3::ZERO, DVec3::splat(9.0));
        assert_eq!(half.len(), 3);
        let length: f64 = half.iter().map(|[a, b]| (*b - *a).length()).sum();
        assert!((length - 1.5).abs() < 1e-12);
        assert!(
            samples::ball(1.0, 24)
                .outline(DVec3::splat(-2.0), DVec3::splat(2.0))
                .is_empty()
        );
    }
}
