//! What gates ask for: grains that come, go or are put elsewhere, bodies that go or start.

use crate::chunk::{CHUNK, Chunk};
use crate::kinds::KindSet;
use crate::line::{Layout, Line, has_second_line};
use crate::world::{Tally, World};
use tsubu_model::{Change, ContactLaw, SpinState, Vector, View};

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// Makes the changes, between two steps: bodies in the order asked, then grains in order of
    /// identity, new ones last in the order asked. Identities are never reused. An unknown number or
    /// identity changes nothing.
    pub fn apply(&mut self, changes: &[Change]) {
        let mut fates: Vec<(u32, Option<D::V>, usize)> = Vec::new();
        let mut arrivals = Vec::new();
        for change in changes {
            match *change {
                Change::RemoveBody(number) => self.remove_body(number),
                Change::StartBody(number) => self.start_body(number),
                Change::Remove { identity, gate } => fates.push((identity, None, gate)),
                Change::Move {
                    identity,
                    position,
                    gate,
                } => fates.push((identity, Some(D::from_space(position)), gate)),
                Change::Add {
                    position,
                    kind,
                    gate,
                } => arrivals.push((D::from_space(position), kind, gate)),
            }
        }
        if fates.is_empty() && arrivals.is_empty() {
            return;
        }
        fates.sort_by_key(|fate| fate.0);
        fates.dedup_by_key(|fate| fate.0);
        let held = |world: &Self| if T::ON { world.energies().held() } else { 0.0 };
        let before = held(self);
        // Contacts of grains that go or are put elsewhere are forgotten, by their partners too.
        self.take_memory(|identity| fates.binary_search_by_key(&identity, |fate| fate.0).is_ok());
        self.let_go(&fates);
        self.let_in(&arrivals);
        self.in_pool(|world| {
            world.build_lists();
            world.forces(false);
        });
        self.brought_by_grains += held(self) - before;
    }

    fn let_go(&mut self, fates: &[(u32, Option<D::V>, usize)]) {
        let n = self.identity.len();
        let mut kept = 0;
        for i in 0..n {
            let fate = fates
                .binary_search_by_key(&self.identity[i], |fate| fate.0)
                .ok()
                .map(|at| fates[at]);
            // What no force moves has no mass to weigh.
            let mass = Some(self.kind_of(i).mass).filter(|m| m.is_finite());
            if let Some((_, place, gate)) = fate {
                if let Some(passage) = self.passages.get_mut(gate) {
                    passage.mass += mass.unwrap_or(0.0);
                    if place.is_some() {
                        passage.moved += 1;
                    } else {
                        passage.went += 1;
                    }
                }
                let Some(place) = place else { continue };
                self.lines[i].set_position::<D>(self.domain.wrap(place));
                self.lines[i].set_velocity::<D>(D::V::ZERO);
                if const { has_second_line::<D, S>() } {
                    self.spins[i] = Line([0.0; 8]);
                } else {
                    self.lines[i].set_spin::<D, S>(S::Turn::<D>::ZERO);
                }
            }
            if const { has_second_line::<D, S>() } {
                self.spins[kept] = self.spins[i];
            }
            if self.memory_is_taken {
                self.origin[kept] = i as u32;
            }
            self.lines[kept] = self.lines[i];
            self.identity[kept] = self.identity[i];
            kept += 1;
        }
        self.identity.truncate(kept);
        self.origin.truncate(kept);
        self.spins.truncate(kept);
        self.lines.truncate(kept);
        self.lines.push(Line::dummy::<D>());
    }

    fn let_in(&mut self, arrivals: &[(D::V, usize, usize)]) {
        self.lines.pop();
        for &(place, kind, gate) in arrivals {
            let radius = self.kinds.all()[kind].radius;
            let place = self.domain.wrap(place);
            self.lines
                .push(Line::new::<D>(place, D::V::ZERO, radius, kind));
            self.identity.push(self.next_identity);
            if self.memory_is_taken {
                self.origin.push(u32::MAX);
            }
            self.next_identity += 1;
            if let Some(passage) = self.passages.get_mut(gate) {
                passage.came += 1;
            }
        }
        self.lines.push(Line::dummy::<D>());
        if const { has_second_line::<D, S>() } {
            // Who comes does not turn; the last is the dummy's.
            self.spins.resize(self.lines.len(), Line([0.0; 8]));
        }
    }

    /// Arrays and chunks for as many grains as there are; the books of a chunk that goes are kept.
    pub(crate) fn fit_chunks(&mut self) {
        let n = self.identity.len();
        let chunks = n.div_ceil(CHUNK);
        if self.home.len() == n && self.chunks.len() == chunks {
            return;
        }
        self.home.resize(n, D::V::ZERO);
        self.force.resize(n, D::V::ZERO);
        self.torque.resize(n, S::Turn::<D>::ZERO);
        if T::ON {
            self.viscous.resize(n, D::V::ZERO);
        }
        if self.scheme.sweeps() > 0 {
            self.base.resize(n, D::V::ZERO);
            self.damping.resize(n, 0.0);
        }
        for chunk in self.chunks.drain(chunks.min(self.chunks.len())..) {
            for (sum, part) in self.closed_books.iter_mut().zip(chunk.books) {
                *sum += part;
            }
        }
        let bodies = self.bodies.len();
        self.chunks.resize_with(chunks, || Chunk::new(bodies));
    }
}
