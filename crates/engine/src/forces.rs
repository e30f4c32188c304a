//! All forces of one moment: contacts, bodies, loads and weight, chunk by chunk.

use crate::chunk::{CHUNK, Chunk};
use crate::kinds::KindSet;
use crate::lanes;
use crate::line::{Layout, Line};
use crate::pass::{Job, Out};
use crate::walls::{Own, WallJob, wall_forces};
use crate::world::{Tally, World};
use rayon::prelude::*;
use std::marker::PhantomData;
use tsubu_model::{ContactLaw, Load, Seen, SpinState};

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// Adds a force that acts on every grain from now on, such as water.
    pub fn add_load(&mut self, load: Box<dyn Load<D, S>>) {
        self.loads.push(load);
        self.look_at_forces();
    }

    /// Forces of the present state, which no step has led to: contacts remember nothing of it.
    pub(crate) fn look_at_forces(&mut self) {
        self.in_pool(|world| world.forces(false));
    }

    /// Contact forces, walls, loads and weight at the present positions and velocities. `keep`: this is the step, which
    /// contacts remember.
    pub(crate) fn forces(&mut self, keep: bool) {
        let t = self.time_of_positions();
        self.renew_loads(t);
        for (pose, body) in self.poses.iter_mut().zip(&self.bodies) {
            if body.is_moved() {
                *pose = body.pose(t);
            }
        }
        let (lines, spins, pairs, weights) = (&self.lines, &self.spins, &self.pairs, &self.weights);
        let (identity, loads) = (&self.identity, &self.loads);
        let (domain, dt, path, kinds) = (self.domain, self.dt, self.lanes, self.kinds.all().len());
        let walls = WallJob::<D, S, W> {
            bodies: &self.bodies,
            pairs: &self.wall_pairs,
            poses: &self.poses,
            moved: &self.body_moved,
            dt,
            keep,
        };
        let work = |number: usize,
                    chunk: &mut Chunk<D>,
                    force: &mut [D::V],
                    torque: &mut [S::Turn<D>],
                    viscous: &mut [D::V]| {
            let first = number * CHUNK;
            let job = Job::<D, S, K, L, T> {
                lines,
                spins,
                list: &chunk.list,
                first,
                pairs,
                kinds,
                alike: self.alike,
                weights,
                domain,
                dt,
                keep,
                types: PhantomData,
            };
            let out = Out::<D, S> {
                memory: chunk.memory.values_mut(),
                force: &mut *force,
                viscous,
                torque: &mut *torque,
            };
            fetch(lines, number + 1);
            fetch(spins, number + 1);
            lanes::run(path, &job, out);
            let own = Own::of_chunk::<D, S>(number, force.len(), lines, spins, identity);
            wall_forces::<D, S, K, W, T>(&walls, own, chunk, force, torque);
            if !loads.is_empty() {
                see_grains(own, &mut chunk.seen);
                for load in loads {
                    load.push(t, &chunk.seen, force);
                }
            }
        };
        // An untallied run has no viscous array; an empty slice stands in for each chunk.
        if self.pool.is_some() {
            let chunks = self
                .chunks
                .par_iter_mut()
                .zip(self.force.par_chunks_mut(CHUNK))
                .zip(self.torque.par_chunks_mut(CHUNK))
                .enumerate();
            if T::ON {
                chunks
                    .zip(self.viscous.par_chunks_mut(CHUNK))
                    .for_each(|((n, ((c, f), w)), v)| work(n, c, f, w, v));
            } else {
                chunks.for_each(|(n, ((c, f), w))| work(n, c, f, w, &mut []));
            }
        } else {
            let mut viscous = self.viscous.chunks_mut(CHUNK);
            for (n, ((c, f), w)) in self
                .chunks
                .iter_mut()
                .zip(self.force.chunks_mut(CHUNK))
                .zip(self.torque.chunks_mut(CHUNK))
                .enumerate()
            {
                work(n, c, f, w, viscous.next().unwrap_or(&mut []));
            }
        }
    }

    /// Loads that are due look at the scene.
    fn renew_loads(&mut self, t: f64) {
        if !self.loads.iter().any(|load| load.is_due(t)) {
            return;
        }
        let mut loads = std::mem::take(&mut self.loads);
        for load in loads.iter_mut().filter(|load| load.is_due(t)) {
            load.renew(self, t);
        }
        self.loads = loads;
    }
}

/// Reads a number of every line of a chunk, one after the other, so that the machine fetches them while the chunk before is at
/// work: that one's neighbours, too, and what a list asks for in its own order comes one line at a time.
fn fetch(lines: &[Line], number: usize) {
    let from = (number * CHUNK).min(lines.len());
    let to = (from + CHUNK).min(lines.len());
    std::hint::black_box(lines[from..to].iter().map(|line| line.0[0]).sum::<f64>());
}

/// The grains of a chunk as loads see them.
fn see_grains<D: Layout>(own: Own<'_>, seen: &mut Vec<Seen<D>>) {
    seen.clear();
    let grains = own.lines.iter().zip(own.identity);
    seen.extend(grains.map(|(line, &identity)| Seen {
        position: line.position::<D>(),
        velocity: line.velocity::<D>(),
        radius: line.0[D::RADIUS],
        identity,
    }));
}
