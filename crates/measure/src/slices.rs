//! How much of a grain lies between two parallel planes, in the plane and in space.

use std::f64::consts::{FRAC_PI_2, PI};
use tsubu_model::{Dim, Plane, Space};

/// A dimension in which the content of a grain can be cut into slices: the area of a disc in the
/// plane (m²), the volume of a sphere in space (m³).
///
/// Cuts are given relative to the grain's centre, `from` < `to`.
pub trait Slices: Dim {
    /// Content of a grain of this radius between x = `from` and x = `to`.
    fn slab(radius: f64, from: f64, to: f64) -> f64;
    /// Content, one dimension lower, of a cut through a grain at fixed x, between two heights;
    /// `radius` is that of the cut.
    fn section(radius: f64, from: f64, to: f64) -> f64;
    /// Extent across the x–z plane: `depth` or else the extent of the grains from `low` to `high`.
    /// In the plane it is the number 1, so that areas take the place of volumes.
    fn across(depth: Option<f64>, low: f64, high: f64) -> f64;

    /// Content of a whole grain.
    ///
    /// ```
    /// use tsubu_measure::Slices;
    /// use tsubu_model::{Plane, Space};
    /// assert!((Plane::content(1.0) - 3.141593).abs() < 1e-6);
    /// assert!((Space::content(1.0) - 4.188790).abs() < 1e-6);
    /// ```
    fn content(radius: f64) -> f64 {
        Self::slab(radius, -radius, radius)
    }

    /// Content of a grain within the rectangle `x` × `z`, both relative to its centre.
    ///
    /// ∫ section(R cos θ) R cos θ dθ with x = R sin θ, by the midpoint rule: within about 1 % of the
    /// grain where a cut passes through it, exact where none does.
    fn part(radius: f64, x: [f64; 2], z: [f64; 2]) -> f64 {
        const STEPS: usize = 16;
        if x[0] <= -radius && x[1] >= radius && z[0] <= -radius && z[1] >= radius {
            return Self::content(radius);
        }
        if x[0] >= radius || x[1] <= -radius || z[0] >= radius || z[1] <= -radius {
            return 0.0;
        }
        let angle = |t: f64| {
            if t <= -radius {
                -FRAC_PI_2
            } else if t >= radius {
                FRAC_PI_2
            } else {
                (t / radius).asin()
            }
        };
        let (low, high) = (angle(x[0]), angle(x[1]));
        let width = (high - low) / STEPS as f64;
        (0..STEPS)
            .map(|k| {
                let cut = radius * (low + (k as f64 + 0.5) * width).cos();
                Self::section(cut, z[0], z[1]) * cut * width
            })
            .sum()
    }
}

impl Slices for Plane {
    fn slab(radius: f64, from: f64, to: f64) -> f64 {
        disc(radius, from, to)
    }
    fn section(radius: f64, from: f64, to: f64) -> f64 {
        chord(radius, from, to)
    }
    fn across(_: Option<f64>, _: f64, _: f64) -> f64 {
        1.0
    }
}

impl Slices for Space {
    fn slab(radius: f64, from: f64, to: f64) -> f64 {
        sphere(radius, from, to)
    }
    fn section(radius: f64, from: f64, to: f64) -> f64 {
        disc(radius, from, to)
    }
    fn across(depth: Option<f64>, low: f64, high: f64) -> f64 {
        depth.unwrap_or((high - low).max(0.0))
    }
}

/// Length of [−r, r] within [from, to].
fn chord(r: f64, from: f64, to: f64) -> f64 {
    (to.min(r) - from.max(-r)).max(0.0)
}

/// Area of a disc between two parallel lines: difference of t √(r² − t²) + r² asin(t/r).
fn disc(r: f64, from: f64, to: f64) -> f64 {
    if r <= 0.0 {
        return 0.0;
    }
    let up_to = |t: f64| {
        let t = t.max(-r).min(r);
        t * (r * r - t * t).max(0.0).sqrt() + r * r * (t / r).asin()
    };
    (up_to(to) - up_to(from)).max(0.0)
}

/// Volume of a sphere between two parallel planes: difference of π (r² t − t³/3).
fn sphere(r: f64, from: f64, to: f64) -> f64 {
    let up_to = |t: f64| {
        let t = t.max(-r).min(r);
        PI * (r * r * t - t * t * t / 3.0)
    };
    (up_to(to) - up_to(from)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_cap_has_the_textbook_volume() {
        // Cap of height h on a sphere: π h² (3r − h)/3; on a unit sphere with h = 0.5: 0.654498.
        assert!((Space::slab(1.0, 0.5, 1.0) - 0.654_498_469).abs() < 1e-9);
        // Circular segment of the unit disc beyond 0.5: π/3 − √3/4 = 0.614185.
        assert!((Plane::slab(1.0, 0.5, 1.0) - 0.614_184_849).abs() < 1e-9);
    }

    #[test]
    fn a_corner_has_an_eighth_or_a_quarter() {
        let big = [0.0, 9.0];
        assert!((Space::part(1.0, big, big) / Space::content(1.0) - 0.25).abs() < 2e-3);
        assert!((Plane::part(1.0, big, big) / Plane::content(1.0) - 0.25).abs() < 2e-3);
    }

    proptest! {
        #[test]
        fn the_four_quarters_make_a_grain(r in 0.1..3.0f64, cx in -3.5..3.5f64, cz in -3.5..3.5f64) {
            let (left, right, below, above) = ([-9.0, cx], [cx, 9.0], [-9.0, cz], [cz, 9.0]);
            for (whole, parts) in [
                (Space::content(r), [Space::part(r, left, below), Space::part(r, left, above), Space::part(r, right, below), Space::part(r, right, above)]),
                (Plane::content(r), [Plane::part(r, left, below), Plane::part(r, left, above), Plane::part(r, right, below), Plane::part(r, right, above)]),
            ] {
                prop_assert!((parts.iter().sum::<f64>() / whole - 1.0).abs() < 0.01);
            }
        }
    }
}
