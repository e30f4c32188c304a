//! What a contact with springs remembers.

use tsubu_model::{Dim, Numbers, Vector};

/// The springs of a contact as forces: two numbers in the plane, four in space.
///
/// Both are even under exchange of the grains: the two sides of a contact hold the same to the bit.
///
/// ```
/// use tsubu_contact::Stretch;
/// use tsubu_model::{Numbers, Plane, Space};
/// assert_eq!((Stretch::<Plane>::N, Stretch::<Space>::N), (2, 4));
/// let mut stretch = Stretch::<Space>::zero();
/// stretch.set(2, 0.5);                                 // N
/// assert_eq!(stretch.tangential.y, 0.5);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Stretch<D: Dim> {
    /// e_n in N, positive while the grains press; 0 where there is no contact.
    pub normal: f64,
    /// n × e_s in N, n from the partner to this grain.
    pub tangential: D::W,
}

impl<D: Dim> Numbers for Stretch<D> {
    const N: usize = 1 + <D::W as Vector>::AXES;

    #[inline(always)]
    fn zero() -> Self {
        Self {
            normal: 0.0,
            tangential: D::W::ZERO,
        }
    }

    #[inline(always)]
    fn get(&self, k: usize) -> f64 {
        if k == 0 {
            self.normal
        } else {
            self.tangential.axis(k - 1)
        }
    }

    #[inline(always)]
    fn set(&mut self, k: usize, value: f64) {
        if k == 0 {
            self.normal = value;
        } else {
            let former = self.tangential;
            self.tangential = D::W::from_axes(|a| if a == k - 1 { value } else { former.axis(a) });
        }
    }
}
