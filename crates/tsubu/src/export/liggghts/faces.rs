//! Triangles that LIGGGHTS bears: it stops at needles, and at faces that lie back to back within a body.

use glam::DVec3;
use std::collections::BTreeMap;
use tsubu_model::Shell;

/// The smallest angle that a triangle may have, in degrees: LIGGGHTS 3.8 stops below 0.0573.
const NEEDLE: f64 = 0.06;

/// The triangles of a body for LIGGGHTS, and how many were left out.
pub struct Faces {
    pub triangles: Vec<[DVec3; 3]>,
    /// Narrower than a thousandth of their length: what they leave open no grain notices.
    pub needles: usize,
    /// Covered by faces that look the other way: walls between parts of one body, which no grain reaches.
    pub inner: usize,
}

impl Faces {
    pub fn of(shell: &Shell) -> Self {
        let corners = |t: &[u32; 3]| t.map(|k| shell.vertices[k as usize]);
        let all: Vec<[DVec3; 3]> = shell.triangles.iter().map(corners).collect();
        let count = all.len();
        let sound: Vec<[DVec3; 3]> = all.into_iter().filter(|t| !is_needle(t)).collect();
        let needles = count - sound.len();
        let inner = covered(&sound);
        let triangles = sound.iter().zip(&inner).filter(|(_, inner)| !**inner);
        Self {
            triangles: triangles.map(|(t, _)| *t).collect(),
            needles,
            inner: inner.iter().filter(|inner| **inner).count(),
        }
    }
}

/// True if the smallest angle, opposite the shortest side, is too small.
fn is_needle([a, b, c]: &[DVec3; 3]) -> bool {
    let mut sides = [(*b - *a).length(), (*c - *b).length(), (*a - *c).length()];
    sides.sort_unstable_by(f64::total_cmp);
    let twice_area = (*b - *a).cross(*c - *a).length();
    let room = sides[1] * sides[2];
    room <= 0.0 || (twice_area / room).min(1.0).asin() < NEEDLE.to_radians()
}

/// Which triangles lie on triangles of the same plane that look the other way.
fn covered(triangles: &[[DVec3; 3]]) -> Vec<bool> {
    let size = triangles
        .iter()
        .flatten()
        .fold(0.0_f64, |s, x| s.max(x.abs().max_element()));
    // Planes by their rounded normal and offset, without the sign; neighbours in rounding are looked at too.
    let (turn, step) = (1e-4, (1e-6 * size).max(f64::MIN_POSITIVE));
    let plane = |[a, b, c]: &[DVec3; 3]| {
        let n = (*b - *a).cross(*c - *a).normalize_or_zero();
        let first = n
            .to_array()
            .into_iter()
            .find(|x| x.abs() > 1e-3)
            .unwrap_or(1.0);
        let (n, front) = (n * first.signum(), first > 0.0);
        (n, n.dot(*a), front)
    };
    let key = |n: DVec3, offset: f64, shift: i64| {
        let [x, y, z] = n.to_array().map(|x| (x / turn).round() as i64);
        ([x, y, z], (offset / step).round() as i64 + shift)
    };
    let mut by_plane: BTreeMap<([i64; 3], i64), Vec<usize>> = BTreeMap::new();
    for (k, t) in triangles.iter().enumerate() {
        let (n, offset, _) = plane(t);
        by_plane.entry(key(n, offset, 0)).or_default().push(k);
    }
    let is_covered = |t: &[DVec3; 3]| {
        let (n, offset, front) = plane(t);
        let near: Vec<&[DVec3; 3]> = (-1..=1)
            .filter_map(|shift| by_plane.get(&key(n, offset, shift)))
            .flatten()
            .map(|k| &triangles[*k])
            .filter(|other| plane(other).2 != front)
            .collect();
        let middle = (t[0] + t[1] + t[2]) / 3.0;
        // Points well inside: the middle and one towards each corner.
        let points = t.map(|corner| middle.lerp(corner, 0.8));
        let on = |x: DVec3| near.iter().any(|other| holds(other, n, x));
        !near.is_empty() && on(middle) && points.into_iter().all(on)
    };
    triangles.iter().map(is_covered).collect()
}

/// True if a point of its plane is in the triangle.
fn holds(triangle: &[DVec3; 3], n: DVec3, x: DVec3) -> bool {
    let [a, b, c] = *triangle;
    let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| (q - p).cross(x - p).dot(n));
    sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a block from its lower to its upper corner, its sides as triangles that look outward.
    fn block(low: DVec3, high: DVec3, diagonal: bool) -> Vec<[DVec3; 3]> {
        let mut all = Vec::new();
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for up in [false, true] {
                let corner = |a: bool, b: bool| {
                    let mut x = low;
                    x[axis] = if up { high[axis] } else { low[axis] };
                    x[u] = if a { high[u] } else { low[u] };
                    x[v] = if b { high[v] } else { low[v] };
                    x
                };
                let [p, q, r, s] = [
                    corner(false, false),
                    corner(true, false),
                    corner(true, true),
                    corner(false, true),
                ];
                let mut two = if diagonal {
                    [[p, q, r], [p, r, s]]
                } else {
                    [[q, r, s], [q, s, p]]
                };
                if !up {
                    two.iter_mut().for_each(|t| t.swap(1, 2));
                }
                all.extend(two);
            }
        }
        all
    }

    fn shell(triangles: &[[DVec3; 3]]) -> Shell {
        Shell {
            vertices: triangles.iter().flatten().copied().collect(),
            triangles: (0..triangles.len() as u32)
                .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
                .collect(),
        }
    }

    #[test]
    fn a_block_is_left_whole_and_the_wall_between_two_blocks_goes() {
        let one = block(DVec3::ZERO, DVec3::ONE, true);
        let alone = Faces::of(&shell(&one));
        assert_eq!(
            (alone.triangles.len(), alone.needles, alone.inner),
            (12, 0, 0)
        );
        // A second block against its side, cut along other diagonals: four triangles lie back to back.
        let mut two = one.clone();
        two.extend(block(
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::new(2.0, 1.0, 1.0),
            false,
        ));
        assert_eq!(Faces::of(&shell(&two)).inner, 4);
        // A smaller one covers no whole triangle of the large side, and its own two are covered.
        let mut small = one;
        small.extend(block(
            DVec3::new(1.0, 0.2, 0.2),
            DVec3::new(2.0, 0.4, 0.4),
            false,
        ));
        assert_eq!(Faces::of(&shell(&small)).inner, 2);
    }

    #[test]
    fn a_needle_is_left_out() {
        let thin = |height: f64| shell(&[[DVec3::ZERO, DVec3::X, DVec3::new(0.5, height, 0.0)]]);
        // atan(2 h) on either side: 0.055° and 0.069°.
        assert_eq!(Faces::of(&thin(0.00048)).needles, 1);
        assert_eq!(Faces::of(&thin(0.0006)).needles, 0);
    }
}
