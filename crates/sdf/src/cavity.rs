//! Everything but a solid: the container that a shape leaves when it is taken out of endless matter.

use crate::solid::{Solid, hits_of};
use glam::DVec3;
use tsubu_model::{Dim, HitBuffer, Shell, Surface};

/// The body around the hole of shape `S`; distance = −(distance of S), exact everywhere.
///
/// Grains live inside the hole: `Cavity` of a cuboid is a closed container, of a cylinder an endlessly
/// thick pipe with both ends closed. A grain in a corner is held by every wall that it reaches.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::{HitBuffer, Space, Surface};
/// use tsubu_sdf::{Cavity, Cuboid};
/// let container = Cavity(Cuboid::<Space>::new(DVec3::ZERO, DVec3::ONE)?);
/// let mut out = HitBuffer::default();
/// container.hits(&[DVec3::new(0.1, 0.2, 0.5)], &[0.3], &mut out);
/// let distances: Vec<f64> = out.hits.iter().map(|hit| hit.distance).collect();
/// assert_eq!(distances, [0.1, 0.2]);                                    // two walls, m
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cavity<S>(pub S);

impl<D: Dim, S: Solid<D>> Solid<D> for Cavity<S> {
    fn distance(&self, x: D::V) -> f64 {
        -self.0.distance(x)
    }

    fn feet(&self, x: D::V, of: u32, out: &mut HitBuffer<D>) {
        let start = out.hits.len();
        self.0.feet(x, of, out);
        for foot in &mut out.hits[start..] {
            foot.distance = -foot.distance;
            foot.normal = -foot.normal;
        }
    }
}

impl<D: Dim, S: Solid<D> + Surface<D>> Surface<D> for Cavity<S> {
    fn lower_bound(&self, x: D::V) -> f64 {
        self.distance(x)
    }

    fn hits(&self, x: &[D::V], reach: &[f64], out: &mut HitBuffer<D>) {
        hits_of(self, x, reach, out);
    }

    fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        self.0.outline(low, high)
    }

    /// The walls of the hole. The body itself has no end, its surface has.
    fn bounds(&self) -> Option<[DVec3; 2]> {
        self.0.bounds()
    }

    fn shell(&self) -> Option<Shell> {
        let mut shell = self.0.shell()?;
        for triangle in &mut shell.triangles {
            triangle.swap(1, 2);
        }
        Some(shell)
    }
}
