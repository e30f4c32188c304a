//! A moment that was computed elsewhere takes the place of this one, to be looked at.

use crate::kinds::KindSet;
use crate::line::{Layout, Line, has_second_line};
use crate::world::{Tally, World};
use std::collections::BTreeSet;
use tsubu_model::{ContactLaw, SpinState};

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// Puts these grains (identity, place, velocity) of the first kind in the place of those that are here, at step
    /// `steps`. Bodies stand where they stand then, and forces are those of the moment. Grains do not turn, and contacts
    /// remember nothing: who computed them does not say. Grains that are not here any more count as gone through the
    /// first gate, if there is one.
    pub fn replace(&mut self, steps: u64, grains: &[(u32, D::V, D::V)]) {
        self.take_memory(|_| true);
        self.steps = steps;
        let there: BTreeSet<u32> = grains.iter().map(|g| g.0).collect();
        let kind = self.kinds.all()[0];
        let gone = self.identity.iter().filter(|i| !there.contains(i)).count();
        if let Some(gate) = self.passages.first_mut() {
            gate.went += gone as u64;
            gate.mass += gone as f64 * kind.mass;
        }
        self.identity.clear();
        self.identity.extend(grains.iter().map(|g| g.0));
        self.lines.clear();
        self.lines.extend(
            grains
                .iter()
                .map(|&(_, x, v)| Line::new::<D>(self.domain.wrap(x), v, kind.radius, 0)),
        );
        self.lines.push(Line::dummy::<D>());
        if const { has_second_line::<D, S>() } {
            self.spins.clear();
            self.spins.resize(self.lines.len(), Line([0.0; 8]));
        }
        if self.memory_is_taken {
            self.origin.clear();
            self.origin.resize(grains.len(), u32::MAX);
        }
        self.in_pool(|world| {
            world.build_lists();
            world.forces(false);
        });
    }
}
