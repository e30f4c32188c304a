//! What acts on every grain once a step, whatever it touches: water.

use crate::{Dim, Saved, SpinState, View};

/// A grain as a [`Load`] sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<D: Dim> {
    /// Centre in m.
    pub position: D::V,
    /// Velocity in m/s.
    pub velocity: D::V,
    /// Radius in m.
    pub radius: f64,
    /// Identity.
    pub identity: u32,
}

/// A force on every grain that no contact gives. Weight is not one: kinds carry it.
pub trait Load<D: Dim, S: SpinState>: Saved + Send + Sync {
    /// True if it has to look at the whole scene before the forces of time `t` in s.
    fn is_due(&self, t: f64) -> bool;
    /// Looks at the whole scene.
    fn renew(&mut self, view: &dyn View<D, S>, t: f64);
    /// Adds the force in N at time `t` on each of these grains, a run of them after the other.
    fn push(&self, t: f64, grains: &[Seen<D>], force: &mut [D::V]);
}
