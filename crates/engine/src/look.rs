//! The view that observers and gates get.

use crate::chunk::CHUNK;
use crate::health::Health;
use crate::kinds::KindSet;
use crate::line::Layout;
use crate::line::has_second_line;
use crate::world::{Tally, World};
use glam::DVec3;
use tsubu_model::{
    BodyState, ContactLaw, Energies, Kind, Numbers, Passage, SpinState, TouchingPair, Vector, View,
};

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// Every listed pair once, in the order of the lists, with what its contact remembers.
    pub(crate) fn pairs_once(&self, mut each: impl FnMut(usize, usize, L::Memory)) {
        for (number, chunk) in self.chunks.iter().enumerate() {
            for (block, lane, slot, j) in chunk.list.entries_in_blocks() {
                let i = number * CHUNK + slot;
                if i < j {
                    let mut memory = L::Memory::zero();
                    for m in 0..L::Memory::N {
                        memory.set(m, chunk.memory.get(block, lane, m));
                    }
                    each(i, j, memory);
                }
            }
        }
    }

    /// The deepest contact, if it is deeper than `share` of the law's range.
    pub fn overlap_health(&self, share: f64) -> Health {
        let mut worst = Health::Fine;
        let mut deepest = share;
        self.touching(&mut |pair| {
            let now = pair.overlap / self.range;
            if now > deepest {
                deepest = now;
                worst = Health::DeepOverlap {
                    grain: self.identity[pair.i],
                    partner: self.identity[pair.j],
                    place: D::to_space(self.position(pair.i)).to_array(),
                    share: now,
                    time: self.now(),
                };
            }
        });
        worst
    }
}

impl<D, S, K, L, W, T> View<D, S> for World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    fn time(&self) -> f64 {
        self.now()
    }

    fn len(&self) -> usize {
        self.identity.len()
    }

    fn position(&self, i: usize) -> D::V {
        self.lines[i].position::<D>()
    }

    fn velocity(&self, i: usize) -> D::V {
        self.lines[i].velocity::<D>()
    }

    fn spin(&self, i: usize) -> S::Turn<D> {
        if const { has_second_line::<D, S>() } {
            self.spins[i].spin::<D, S>()
        } else {
            self.lines[i].spin::<D, S>()
        }
    }

    fn kind(&self, i: usize) -> &Kind {
        self.kind_of(i)
    }

    fn identity(&self, i: usize) -> u32 {
        self.identity[i]
    }

    fn bodies(&self) -> Vec<BodyState<D>> {
        let load = |k: usize| {
            self.chunks
                .iter()
                .fold((D::V::ZERO, DVec3::ZERO), |sum, c| {
                    (sum.0 + c.on_bodies[k].force, sum.1 + c.on_bodies[k].torque)
                })
        };
        self.bodies
            .iter()
            .enumerate()
            .map(|(k, b)| {
                let (force, torque) = load(k);
                BodyState {
                    name: b.name.clone(),
                    removed_at: b.removed_at,
                    force,
                    torque,
                    pose: self.poses[k],
                }
            })
            .collect()
    }

    fn passages(&self) -> Vec<Passage> {
        self.passages.clone()
    }

    fn gravity(&self) -> D::V {
        self.gravity
    }

    fn energies(&self) -> Energies {
        let mut e = Energies::default();
        for i in 0..self.len() {
            let kind = self.kind_of(i);
            let spin = View::spin(self, i);
            // What no force moves has no energy to give.
            if kind.mass.is_finite() {
                e.kinetic += 0.5 * kind.mass * self.velocity(i).length_squared();
            }
            if <S::Turn<D> as Vector>::AXES > 0 && kind.inertia.is_finite() {
                e.kinetic += 0.5 * kind.inertia * spin.length_squared();
            }
            e.gravitational -= kind.weight * self.gravity.dot(self.position(i));
        }
        let pairs = self.pairs();
        self.pairs_once(|i, j, memory| {
            let (pair, touch) = pairs.touch::<S, K>(i, j);
            e.elastic += L::stored(pair, &touch, &memory);
        });
        e.elastic_walls = self.stored_in_walls().iter().sum();
        [
            e.lost_damping,
            e.lost_wall_damping,
            e.lost_wall_friction,
            e.work_of_bodies,
        ] = self.books();
        e.brought_by_grains = self.brought_by_grains;
        e.taken_by_removal = self.taken();
        e
    }

    fn touching(&self, each: &mut dyn FnMut(TouchingPair)) {
        let pairs = self.pairs();
        self.pairs_once(|i, j, _| {
            let (pair, touch) = pairs.touch::<S, K>(i, j);
            let overlap = L::range(pair) - touch.r();
            if overlap > 0.0 {
                each(TouchingPair { i, j, overlap });
            }
        });
    }
}
