//! One triangle: its closest point, the feature it lies on, its solid angle, what crosses it.

use glam::DVec3;
use std::f64::consts::PI;

/// Where on a triangle a closest point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// Off every side.
    Face,
    /// On the side from this corner (0, 1, 2) to the next.
    Side(usize),
    /// On this corner.
    Corner(usize),
}

/// The point of the triangle closest to x, by the regions of its corners and sides (Ericson 2005, §5.1.5).
pub(crate) fn closest([a, b, c]: [DVec3; 3], x: DVec3) -> (DVec3, Place) {
    let (ab, ac, ax) = (b - a, c - a, x - a);
    let (d1, d2) = (ab.dot(ax), ac.dot(ax));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, Place::Corner(0));
    }
    let bx = x - b;
    let (d3, d4) = (ab.dot(bx), ac.dot(bx));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, Place::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (a + ab * (d1 / (d1 - d3)), Place::Side(0));
    }
    let cx = x - c;
    let (d5, d6) = (ab.dot(cx), ac.dot(cx));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, Place::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (a + ac * (d2 / (d2 - d6)), Place::Side(2));
    }
    let va = d3 * d6 - d5 * d4;
    let (s, t) = (d4 - d3, d5 - d6);
    if va <= 0.0 && s >= 0.0 && t >= 0.0 {
        return (b + (c - b) * (s / (s + t)), Place::Side(1));
    }
    let sum = va + vb + vc;
    (a + ab * (vb / sum) + ac * (vc / sum), Place::Face)
}

/// A sum of solid angles, kept as a product of complex numbers: one arctangent for all triangles.
///
/// tan(Ω/2) = a·(b × c) / (abc + (a·b)c + (b·c)a + (c·a)b), vectors from x to the corners; Ω in sr,
/// positive seen from behind. Source: VanOosterom1983.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolidAngle {
    /// cos and sin of half the sum, up to whole turns.
    cos: f64,
    sin: f64,
    /// Whole turns of half the sum.
    turns: f64,
}

impl SolidAngle {
    pub fn none() -> Self {
        Self {
            cos: 1.0,
            sin: 0.0,
            turns: 0.0,
        }
    }

    #[inline]
    pub fn add(&mut self, corners: [DVec3; 3], x: DVec3) {
        let [a, b, c] = corners.map(|v| v - x);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let sin = a.dot(b.cross(c));
        let cos = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        let size = cos.abs() + sin.abs();
        // On the triangle itself both vanish: no angle, the mean of both sides.
        if size > 0.0 {
            let (cos, sin) = (cos / size, sin / size);
            let product = (
                self.cos * cos - self.sin * sin,
                self.cos * sin + self.sin * cos,
            );
            // Two angles of one sign whose sum has the other have passed ±π.
            if self.sin >= 0.0 && sin >= 0.0 && product.1 < 0.0 {
                self.turns += 1.0;
            } else if self.sin < 0.0 && sin < 0.0 && product.1 >= 0.0 {
                self.turns -= 1.0;
            }
            // The sum of both is at least a half for a unit vector, so nothing shrinks away.
            let size = product.0.abs() + product.1.abs();
            (self.cos, self.sin) = (product.0 / size, product.1 / size);
        }
    }

    /// The sum in sr.
    pub fn total(&self) -> f64 {
        2.0 * (self.sin.atan2(self.cos) + 2.0 * PI * self.turns)
    }
}

/// How far along from `from` the direction `along` meets the triangle, as a multiple of `along`
/// (Möller & Trumbore 1997); misses and grazing sides are `None`.
pub(crate) fn crossing([a, b, c]: [DVec3; 3], from: DVec3, along: DVec3) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = along.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let s = from - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(ab);
    let v = along.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(q) / determinant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0f64).prop_map(DVec3::from)
    }

    proptest! {
        #[test]
        fn no_point_of_the_triangle_is_closer(a in vector(), b in vector(), c in vector(), x in vector()) {
            prop_assume!((b - a).cross(c - a).length() > 1e-3);
            let (p, place) = closest([a, b, c], x);
            let d = (p - x).length();
            let mut least = f64::INFINITY;
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let (s, t) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                    least = least.min((a + (b - a) * s + (c - a) * t - x).length());
                }
            }
            prop_assert!(d <= least + 1e-12);
            prop_assert!(least <= d + 0.2);
            // The point lies where it says.
            match place {
                Place::Corner(k) => prop_assert_eq!(p, [a, b, c][k]),
                Place::Side(k) => {
                    let (s, t) = ([a, b, c][k], [b, c, a][k]);
                    prop_assert!((p - s).cross(t - s).length() < 1e-12);
                }
                Place::Face => prop_assert!((p - x).dot(b - a).abs() + (p - x).dot(c - a).abs() < 1e-10),
            }
        }

        #[test]
        fn a_ray_through_a_point_of_the_triangle_meets_it_there(a in vector(), b in vector(), c in vector(), x in vector(), s in 0.05..0.45f64, t in 0.05..0.45f64) {
            let n = (b - a).cross(c - a);
            let p = a + (b - a) * s + (c - a) * t;
            prop_assume!(n.length() > 1e-2 && (p - x).dot(n).abs() > 1e-2);
            let met = crossing([a, b, c], x, p - x);
            prop_assert!(met.is_some_and(|m| (m - 1.0).abs() < 1e-9));
            prop_assert!(crossing([a, b, c], x, (p + (b - a) * 2.0) - x).is_none());
        }
    }

    #[test]
    fn an_octant_fills_an_eighth_of_the_sphere() {
        let octant = [DVec3::X, DVec3::Y, DVec3::Z];
        assert!((sum(&[octant], DVec3::ZERO) - PI / 2.0).abs() < 1e-14);
        assert!(sum(&[octant], DVec3::ONE) < 0.0);
    }

    fn sum(triangles: &[[DVec3; 3]], x: DVec3) -> f64 {
        let mut sum = SolidAngle::none();
        triangles.iter().for_each(|&t| sum.add(t, x));
        sum.total()
    }

    proptest! {
        #[test]
        fn the_product_is_the_sum_however_many_turns(points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 3..60), twice in any::<bool>()) {
            let mut triangles: Vec<[DVec3; 3]> = points.windows(3).map(|w| [0, 1, 2].map(|k| DVec3::from(w[k]))).collect();
            if twice {
                // All the same way round, so that turns gather.
                let first = triangles[0];
                triangles = vec![first; 20];
            }
            let single: f64 = triangles.iter().map(|&t| sum(&[t], DVec3::splat(0.01))).sum();
            prop_assert!((sum(&triangles, DVec3::splat(0.01)) - single).abs() < 1e-9);
        }
    }
}
