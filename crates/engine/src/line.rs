//! The line: the 64 bytes that the force loop reads of a grain.

use tsubu_model::{Dim, Plane, Space, SpinState, Vector};

/// One grain as the force loop sees it, one cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Line(pub [f64; 8]);

/// Where a dimension keeps what in a [`Line`].
/// Space: x y z radius, vx vy vz kind; a spin there has a line of its own. Plane: x z vx vz, ω radius kind –.
pub trait Layout: Dim {
    /// First coordinate.
    const POSITION: usize;
    /// First component of the velocity.
    const VELOCITY: usize;
    /// Radius.
    const RADIUS: usize;
    /// Number of the kind.
    const KIND: usize;
    /// The spin, in the line of the grain if it is one number, else in a second line.
    const SPIN: usize;
}

/// True if the spin does not fit into the grain's line and has a second one.
pub(crate) const fn has_second_line<D: Layout, S: SpinState>() -> bool {
    <S::Turn<D> as Vector>::AXES > 1
}

impl Layout for Space {
    const POSITION: usize = 0;
    const VELOCITY: usize = 4;
    const RADIUS: usize = 3;
    const KIND: usize = 7;
    const SPIN: usize = 0;
}

impl Layout for Plane {
    const POSITION: usize = 0;
    const VELOCITY: usize = 2;
    const RADIUS: usize = 5;
    const KIND: usize = 6;
    const SPIN: usize = 4;
}

impl Line {
    /// A grain that touches nothing: it fills short lists. Far enough that no law reaches it,
    /// near enough that its squared distance is an ordinary number.
    pub(crate) fn dummy<D: Layout>() -> Self {
        let mut line = Line([0.0; 8]);
        line.set_position::<D>(D::V::from_axes(|_| 1e30));
        line
    }

    pub(crate) fn new<D: Layout>(position: D::V, velocity: D::V, radius: f64, kind: usize) -> Self {
        let mut line = Line([0.0; 8]);
        line.set_position::<D>(position);
        line.set_velocity::<D>(velocity);
        line.0[D::RADIUS] = radius;
        line.0[D::KIND] = kind as f64;
        line
    }

    #[inline(always)]
    pub(crate) fn position<D: Layout>(&self) -> D::V {
        D::V::from_axes(|a| self.0[D::POSITION + a])
    }

    #[inline(always)]
    pub(crate) fn velocity<D: Layout>(&self) -> D::V {
        D::V::from_axes(|a| self.0[D::VELOCITY + a])
    }

    #[inline(always)]
    pub(crate) fn kind<D: Layout>(&self) -> usize {
        self.0[D::KIND] as usize
    }

    #[inline(always)]
    pub(crate) fn set_position<D: Layout>(&mut self, x: D::V) {
        for a in 0..D::V::AXES {
            self.0[D::POSITION + a] = x.axis(a);
        }
    }

    #[inline(always)]
    pub(crate) fn set_velocity<D: Layout>(&mut self, v: D::V) {
        for a in 0..D::V::AXES {
            self.0[D::VELOCITY + a] = v.axis(a);
        }
    }

    /// Of the line that has it.
    #[inline(always)]
    pub(crate) fn spin<D: Layout, S: SpinState>(&self) -> S::Turn<D> {
        S::Turn::<D>::from_axes(|a| self.0[D::SPIN + a])
    }

    #[inline(always)]
    pub(crate) fn set_spin<D: Layout, S: SpinState>(&mut self, w: S::Turn<D>) {
        for a in 0..<S::Turn<D> as Vector>::AXES {
            self.0[D::SPIN + a] = w.axis(a);
        }
    }
}
