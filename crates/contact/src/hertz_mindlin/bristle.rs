//! What a Hertz–Mindlin contact remembers.

use super::Rolling;
use tsubu_model::{Dim, Numbers, Vector};

/// The tangential spring, the overlap to which it belongs, and the rolling spring if there is one: two numbers in the plane and
/// four in space, with rolling resistance three and seven.
///
/// The tangential part and the overlap are even under exchange of the grains, the rolling part odd.
///
/// ```
/// use tsubu_contact::{Bristle, Freely, Resisted};
/// use tsubu_model::{Numbers, Plane, Space};
/// assert_eq!((Bristle::<Plane, Freely>::N, Bristle::<Space, Freely>::N), (2, 4));
/// assert_eq!((Bristle::<Plane, Resisted>::N, Bristle::<Space, Resisted>::N), (3, 7));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Bristle<D: Dim, R: Rolling> {
    /// √δ at the last step in √m; 0 where there is no contact.
    pub root: f64,
    /// n × e_s in N, n from the partner to this grain.
    pub tangential: D::W,
    /// Couple of the rolling spring on this grain in N m.
    pub couple: R::Couple<D>,
}

/// Coordinate `k` replaced.
#[inline(always)]
fn with<V: Vector>(v: V, k: usize, value: f64) -> V {
    V::from_axes(|a| if a == k { value } else { v.axis(a) })
}

impl<D: Dim, R: Rolling> Numbers for Bristle<D, R> {
    const N: usize = 1 + <D::W as Vector>::AXES + <R::Couple<D> as Vector>::AXES;

    #[inline(always)]
    fn zero() -> Self {
        Self {
            root: 0.0,
            tangential: D::W::ZERO,
            couple: <R::Couple<D> as Vector>::ZERO,
        }
    }

    #[inline(always)]
    fn get(&self, k: usize) -> f64 {
        let axes = <D::W as Vector>::AXES;
        if k == 0 {
            self.root
        } else if k <= axes {
            self.tangential.axis(k - 1)
        } else {
            self.couple.axis(k - 1 - axes)
        }
    }

    #[inline(always)]
    fn set(&mut self, k: usize, value: f64) {
        let axes = <D::W as Vector>::AXES;
        if k == 0 {
            self.root = value;
        } else if k <= axes {
            self.tangential = with(self.tangential, k - 1, value);
        } else {
            self.couple = with(self.couple, k - 1 - axes, value);
        }
    }
}
