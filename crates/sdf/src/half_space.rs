//! A flat wall: everything behind a plane is body.

use glam::DVec3;
use tsubu_model::{Dim, Hit, HitBuffer, Surface, Vector};

/// The body behind a plane through `point`; distance = (x − point)·outward, exact everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace<D: Dim> {
    point: D::V,
    outward: D::V,
}

impl<D: Dim> HalfSpace<D> {
    /// A wall through `point` (m) whose outer side is where `outward` points; any length but zero.
    pub fn new(point: D::V, outward: D::V) -> Self {
        Self {
            point,
            outward: outward * (1.0 / outward.length()),
        }
    }
}

impl<D: Dim> Surface<D> for HalfSpace<D> {
    fn lower_bound(&self, x: D::V) -> f64 {
        (x - self.point).dot(self.outward)
    }

    fn hits(&self, x: &[D::V], reach: &[f64], out: &mut HitBuffer<D>) {
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            let distance = self.lower_bound(x);
            if distance < reach {
                out.hits.push(Hit {
                    of: of as u32,
                    distance,
                    normal: self.outward,
                    feature: 0,
                });
            }
        }
    }

    /// The rectangle in which the plane crosses the box, if it lies along axes; else nothing.
    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        let (n, p) = (D::to_space(self.outward), D::to_space(self.point));
        let axis = (0..3).find(|&a| n[a].abs() > 1.0 - 1e-9);
        let Some(axis) = axis else { return Vec::new() };
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |s: bool, t: bool| {
            let mut x = p;
            x[b] = if s { high[b] } else { low[b] };
            x[c] = if t { high[c] } else { low[c] };
            x
        };
        let ring = [
            corner(false, false),
            corner(true, false),
            corner(true, true),
            corner(false, true),
        ];
        (0..4).map(|k| [ring[k], ring[(k + 1) % 4]]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use tsubu_model::Space;

    proptest! {
        #[test]
        fn distance_is_1_lipschitz_and_the_normal_is_its_gradient(
            n in prop::array::uniform3(-1.0..1.0f64), p in prop::array::uniform3(-1.0..1.0f64), x in prop::array::uniform3(-2.0..2.0f64),
        ) {
            let n = DVec3::from(n);
            prop_assume!(n.length() > 0.1);
            let wall = HalfSpace::<Space>::new(DVec3::from(p), n);
            let x = DVec3::from(x);
            let mut out = HitBuffer::default();
            wall.hits(&[x], &[f64::INFINITY], &mut out);
            let hit = out.hits[0];
            for a in 0..3 {
                let mut step = DVec3::ZERO;
                step[a] = 1e-6;
                let slope = (wall.lower_bound(x + step) - wall.lower_bound(x - step)) / 2e-6;
                prop_assert!((slope - hit.normal[a]).abs() < 1e-8);
            }
            // The closest point lies on the surface.
            prop_assert!(wall.lower_bound(x - hit.normal * hit.distance).abs() < 1e-12);
        }
    }
}
