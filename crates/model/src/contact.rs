//! What a contact is, what a law makes of it, and the trait every contact law implements.

use crate::{Dim, Kind, Numbers, SpinState, Vector};

/// One contact as a law sees it: what it is, never whose.
/// The other side of a wall contact is the wall; then `apart` points from the wall into the grain.
#[derive(Clone, Copy, Debug)]
pub struct Touch<D: Dim, S: SpinState> {
    /// x_i − x_j in m.
    pub apart: D::V,
    /// v_i − v_j of the centres in m/s.
    pub velocity: D::V,
    /// |apart|² in m².
    pub r2: f64,
    /// Sum of the two radii in m; against a surface the grain's diameter, the wall being its mirror.
    pub reach: f64,
    /// r_i ω_i + r_j ω_j in m/s.
    pub spin: S::Turn<D>,
    /// ω_i − ω_j in rad/s, with which the two roll on each other.
    pub roll: S::Turn<D>,
}

impl<D: Dim, S: SpinState> Touch<D, S> {
    /// Distance of the centres in m. Computed on demand: a law that never asks never pays for the root.
    #[inline(always)]
    pub fn r(&self) -> f64 {
        self.r2.sqrt()
    }

    /// Unit vector from the partner to this grain.
    #[inline(always)]
    pub fn normal(&self) -> D::V {
        self.apart * (1.0 / self.r())
    }
}

/// The force on grain i in its parts; the engine sums them, a tally reads them.
#[derive(Clone, Copy, Debug)]
pub struct Push<D: Dim, S: SpinState> {
    /// Conservative part in N.
    pub elastic: D::V,
    /// Viscous part in N.
    pub viscous: D::V,
    /// Coulomb part in N.
    pub slip: D::V,
    /// Torque about this grain's centre over its radius, in N: a tangential force f at the contact gives −n × f, the
    /// same for both grains. The engine multiplies by the radius of each.
    pub twist: S::Turn<D>,
    /// Torque on this grain in N m that needs no force, against rolling: the partner feels its opposite. Read only of a law
    /// that [`ROLLS`](ContactLaw::ROLLS).
    pub couple: S::Turn<D>,
}

impl<D: Dim, S: SpinState> Push<D, S> {
    /// No force.
    pub fn none() -> Self {
        Self {
            elastic: D::V::ZERO,
            viscous: D::V::ZERO,
            slip: D::V::ZERO,
            twist: Default::default(),
            couple: Default::default(),
        }
    }

    /// The whole force in N.
    #[inline(always)]
    pub fn total(&self) -> D::V {
        self.elastic + self.viscous + self.slip
    }
}

/// Stiffness and damping of a contact linearised at its present state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linear {
    /// Normal stiffness in N/m.
    pub normal_stiffness: f64,
    /// Tangential stiffness in N/m.
    pub tangential_stiffness: f64,
    /// Normal damping in kg/s.
    pub normal_damping: f64,
    /// Tangential damping in kg/s.
    pub tangential_damping: f64,
}

/// A contact law, for grains against grains and against walls alike.
///
/// `force` is a pure, branch-free function: the engine runs it over eight contacts at once. What it remembers it
/// advances by the step; both grains of a contact have their own copy, all zero while they do not touch.
/// It must return exactly zero at and beyond [`range`](ContactLaw::range) (a far-away dummy fills
/// short lists) and must be odd *to the bit* when the two grains are exchanged, because each side
/// computes the contact for itself. `tsubu_contact::testing` checks both and more.
#[diagnostic::on_unimplemented(
    message = "the law `{Self}` is not made for grains of `{D}` that are `{S}`",
    note = "a law with torque needs grains that spin; a law for walls needs its own `ContactLaw`"
)]
pub trait ContactLaw<D: Dim, S: SpinState>: Send + Sync {
    /// Constants of a pair of kinds, mixed once outside the loop. Where all pairs of a scene are equal none is looked up.
    type Pair: Copy + PartialEq + Send + Sync;
    /// What the law remembers of a contact.
    type Memory: Numbers;
    /// True if the law resists rolling: only then is its [`couple`](Push::couple) summed.
    const ROLLS: bool = false;

    /// Constants for a grain of kind `a` against one of kind `b`.
    fn pair(&self, a: &Kind, b: &Kind) -> Self::Pair;
    /// Distance of the centres in m from which on the force is zero.
    fn range(pair: &Self::Pair) -> f64;
    /// Force on grain i; `dt` is the step in s.
    fn force(
        pair: &Self::Pair,
        touch: &Touch<D, S>,
        memory: &mut Self::Memory,
        dt: f64,
    ) -> Push<D, S>;
    /// Elastic energy stored in the contact in J.
    fn stored(pair: &Self::Pair, touch: &Touch<D, S>, memory: &Self::Memory) -> f64;
    /// Stiffness and damping at this state: for limits of the step and for the implicit dashpot.
    fn linear(pair: &Self::Pair, touch: &Touch<D, S>, dt: f64) -> Linear;
}
