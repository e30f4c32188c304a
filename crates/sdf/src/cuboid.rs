//! A solid box along the axes.

use crate::drawing::{box_edges, box_shell, clipped};
use crate::solid::{Misshapen, Solid, demand, hits_of};
use glam::DVec3;
use tsubu_model::{Dim, Hit, HitBuffer, Shell, Surface, Vector};

/// The box low ≤ x ≤ high (a rectangle in the plane); distance exact at faces, edges and corners.
///
/// With q = max(low − x, x − high) for each coordinate:
/// distance = |max(q, 0)| + min(max over coordinates of q, 0).
/// From outside it is convex and gives one hit. Its inside has a foot on every face:
/// [`Cavity`](crate::Cavity) makes a container of it.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::{Space, Surface};
/// let block = tsubu_sdf::Cuboid::<Space>::new(DVec3::ZERO, DVec3::ONE)?; // m
/// assert_eq!(block.lower_bound(DVec3::new(4.0, 5.0, 0.5)), 5.0);         // from an edge
/// assert_eq!(block.lower_bound(DVec3::new(0.5, 0.5, 0.9)), 0.9 - 1.0);
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid<D: Dim> {
    low: D::V,
    high: D::V,
}

impl<D: Dim> Cuboid<D> {
    /// The box between two corners in m. An error unless `low` is below `high` on every axis.
    pub fn new(low: D::V, high: D::V) -> Result<Self, Misshapen> {
        for a in 0..D::V::AXES {
            demand(high.axis(a) - low.axis(a) > 0.0, || {
                format!("a box from {low:?} to {high:?} has no size on axis {a}")
            })?;
        }
        Ok(Self { low, high })
    }

    /// From the nearest point of the box to `x`: zero inside.
    fn excess(&self, x: D::V) -> D::V {
        D::V::from_axes(|a| {
            let c = x.axis(a);
            c - c.max(self.low.axis(a)).min(self.high.axis(a))
        })
    }
}

impl<D: Dim> Solid<D> for Cuboid<D> {
    fn distance(&self, x: D::V) -> f64 {
        let outside = self.excess(x).length();
        if outside > 0.0 {
            return outside;
        }
        let behind = |a: usize| (self.low.axis(a) - x.axis(a)).max(x.axis(a) - self.high.axis(a));
        (0..D::V::AXES)
            .map(behind)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    fn feet(&self, x: D::V, of: u32, out: &mut HitBuffer<D>) {
        let excess = self.excess(x);
        let outside = excess.length();
        if outside > 0.0 {
            out.hits.push(Hit {
                of,
                distance: outside,
                normal: excess * (1.0 / outside),
                feature: 0,
            });
            return;
        }
        for face in 0..2 * D::V::AXES {
            let (axis, sign) = (face / 2, if face % 2 == 0 { -1.0 } else { 1.0 });
            let wall = if face % 2 == 0 { self.low } else { self.high };
            out.hits.push(Hit {
                of,
                distance: (x.axis(axis) - wall.axis(axis)) * sign,
                normal: D::V::from_axes(|a| if a == axis { sign } else { 0.0 }),
                feature: face as u32,
            });
        }
    }
}

impl<D: Dim> Surface<D> for Cuboid<D> {
    fn lower_bound(&self, x: D::V) -> f64 {
        self.distance(x)
    }

    fn hits(&self, x: &[D::V], reach: &[f64], out: &mut HitBuffer<D>) {
        hits_of(self, x, reach, out);
    }

    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        let edges = box_edges(D::to_space(self.low), D::to_space(self.high));
        clipped(edges, low, high)
    }

    fn bounds(&self) -> Option<[DVec3; 2]> {
        Some([D::to_space(self.low), D::to_space(self.high)])
    }

    fn shell(&self) -> Option<Shell> {
        Some(box_shell(D::to_space(self.low), D::to_space(self.high)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use tsubu_model::{Plane, Space};

    #[test]
    fn a_box_without_size_is_refused_and_a_plane_box_is_a_rectangle() {
        assert!(Cuboid::<Space>::new(DVec3::ZERO, DVec3::X).is_err());
        let floor = Cuboid::<Plane>::new(DVec2::new(0.0, -1.0), DVec2::new(3.0, 0.0)).unwrap();
        assert_eq!(floor.lower_bound(DVec2::new(6.0, 4.0)), 5.0);
        // Four sides, each drawn once in front and once behind in a plane without depth.
        let far = DVec3::splat(9.0);
        assert_eq!(floor.outline(-far, far).len(), 8);
    }
}
