//! Drawing of shapes: outlines clipped to a box, circles as polygons, shells of revolution.

use crate::axis::Axis;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tsubu_model::Shell;

/// In how many steps a circle of `radius` (m) is cut so that its chords are nowhere farther than
/// `chord` (m) from it: r(1 − cos(π/steps)) ≤ chord. A multiple of four, at least 12.
///
/// ```
/// // A pipe of 114.8 mm radius drawn to 0.05 mm: 108 steps, chords 0.049 mm inside the circle.
/// assert_eq!(tsubu_sdf::steps_for(0.1148, 5e-5), 108);
/// ```
pub fn steps_for(radius: f64, chord: f64) -> usize {
    let half_step = (1.0 - chord / radius).clamp(-1.0, 1.0).acos();
    // A chord of zero asks for infinitely many steps; a thousand is what a drawing can use.
    let steps = (PI / half_step / 4.0).ceil().clamp(3.0, 1024.0);
    4 * steps as usize
}

/// Steps of a circle in outlines.
const OUTLINE_STEPS: usize = 48;

/// The part of each segment that lies in the box; segments without length are dropped.
pub(crate) fn clipped(
    segments: impl IntoIterator<Item = [DVec3; 2]>,
    low: DVec3,
    high: DVec3,
) -> Vec<[DVec3; 2]> {
    segments
        .into_iter()
        .filter_map(|s| clip(s, low, high))
        .collect()
}

/// The part of a segment in the box.
fn clip([a, b]: [DVec3; 2], low: DVec3, high: DVec3) -> Option<[DVec3; 2]> {
    let along = b - a;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..3 {
        if along[axis] == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return None;
            }
            continue;
        }
        let s = (low[axis] - a[axis]) / along[axis];
        let t = (high[axis] - a[axis]) / along[axis];
        (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
    }
    (from < to && along != DVec3::ZERO).then(|| [a + along * from, a + along * to])
}

/// A circle as a polygon.
pub(crate) fn circle(centre: DVec3, u: DVec3, v: DVec3, radius: f64) -> Vec<[DVec3; 2]> {
    let at = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / OUTLINE_STEPS as f64).sin_cos();
        centre + (u * cos + v * sin) * radius
    };
    (0..OUTLINE_STEPS).map(|k| [at(k), at(k + 1)]).collect()
}

/// The closed shell of a profile turned about an axis: `profile` runs through points (along the axis,
/// from the axis) counter-clockwise, so that the body is on its left; points on the axis become poles.
pub(crate) fn revolve(axis: &Axis, profile: &[[f64; 2]], steps: usize) -> Shell {
    let mut shell = Shell::default();
    let ring_of = |shell: &mut Shell, [u, v]: [f64; 2]| -> Vec<u32> {
        let first = shell.vertices.len() as u32;
        let count = if v == 0.0 { 1 } else { steps };
        for k in 0..count {
            let (sin, cos) = (TAU * k as f64 / steps as f64).sin_cos();
            shell.vertices.push(axis.point(u, v * cos, v * sin));
        }
        let place = |k: usize| first + if v == 0.0 { 0 } else { (k % steps) as u32 };
        (0..=steps).map(place).collect()
    };
    let rings: Vec<Vec<u32>> = profile.iter().map(|&p| ring_of(&mut shell, p)).collect();
    for (number, ring) in rings.iter().enumerate() {
        let next = &rings[(number + 1) % rings.len()];
        for k in 0..steps {
            for triangle in [
                [ring[k], next[k + 1], ring[k + 1]],
                [ring[k], next[k], next[k + 1]],
            ] {
                let [a, b, c] = triangle;
                if a != b && b != c && c != a {
                    shell.triangles.push(triangle);
                }
            }
        }
    }
    shell
}

/// A box as twelve triangles; a box without depth keeps the triangles that have an area.
pub(crate) fn box_shell(low: DVec3, high: DVec3) -> Shell {
    let vertices = (0..8).map(|k| corner(k, low, high)).collect::<Vec<_>>();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (b, c) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let a = 1u32 << axis;
        triangles.extend([
            [0, c, b],
            [b, c, b | c],
            [a, a | b, a | c],
            [a | b, a | b | c, a | c],
        ]);
    }
    let area = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|k| vertices[k as usize]);
        (b - a).cross(c - a).length()
    };
    triangles.retain(|&t| area(t) > 0.0);
    Shell {
        vertices,
        triangles,
    }
}

/// The twelve edges of a box.
pub(crate) fn box_edges(low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
    let mut edges = Vec::new();
    for k in 0..8u32 {
        for axis in 0..3 {
            if k & (1 << axis) == 0 {
                edges.push([corner(k, low, high), corner(k | 1 << axis, low, high)]);
            }
        }
    }
    edges
}

/// Corner number `k` of a box: bit a of k is set where the corner is high on axis a.
fn corner(k: u32, low: DVec3, high: DVec3) -> DVec3 {
    let pick = |a: usize| if k & (1 << a) == 0 { low[a] } else { high[a] };
    DVec3::new(pick(0), pick(1), pick(2))
}

/// Volume in m³ that a closed shell encloses, by the divergence theorem; negative if it is inside out.
pub fn volume(shell: &Shell) -> f64 {
    let at = |k: u32| shell.vertices[k as usize];
    let part = |&[a, b, c]: &[u32; 3]| at(a).dot(at(b).cross(at(c)));
    shell.triangles.iter().map(part).sum::<f64>() / 6.0
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Panics unless every edge belongs to exactly two triangles that run through it oppositely.
    pub(crate) fn assert_closed(shell: &Shell) {
        let mut edges = HashMap::<(u32, u32), i32>::new();
        for t in &shell.triangles {
            for k in 0..3 {
                *edges.entry((t[k], t[(k + 1) % 3])).or_default() += 1;
            }
        }
        assert!(!edges.is_empty());
        for (&(a, b), &count) in &edges {
            assert_eq!((count, edges.get(&(b, a))), (1, Some(&1)), "edge {a}-{b}");
        }
    }

    #[test]
    fn a_segment_is_cut_at_the_box_and_one_beside_it_is_dropped() {
        let (low, high) = (DVec3::ZERO, DVec3::ONE);
        let through = [DVec3::new(-1.0, 0.5, 0.5), DVec3::new(3.0, 0.5, 0.5)];
        let beside = through.map(|x| x + DVec3::Y);
        let parts = clipped([through, beside], low, high);
        assert_eq!(parts.len(), 1);
        assert!((parts[0][0] - DVec3::new(0.0, 0.5, 0.5)).length() < 1e-15);
        assert!((parts[0][1] - DVec3::new(1.0, 0.5, 0.5)).length() < 1e-15);
    }

    #[test]
    fn shells_are_closed_and_enclose_what_they_should() {
        let shell = box_shell(DVec3::new(-1.0, 0.0, 2.0), DVec3::new(1.0, 3.0, 6.0));
        assert_closed(&shell);
        assert!((volume(&shell) - 24.0).abs() < 1e-12);
        let axis = Axis::new(DVec3::ZERO, DVec3::new(0.0, 2.0, 0.0)).unwrap();
        let steps = 100;
        let cylinder = revolve(
            &axis,
            &[[0.0, 0.0], [2.0, 0.0], [2.0, 0.5], [0.0, 0.5]],
            steps,
        );
        assert_closed(&cylinder);
        let polygon = 0.5 * steps as f64 * (TAU / steps as f64).sin() * 0.25;
        assert!((volume(&cylinder) - 2.0 * polygon).abs() < 1e-12);
    }
}
