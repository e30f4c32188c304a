//! The linear solve of the averaged and the implicit dashpot: sweeps over all grains (see `tsubu_integrate::correction`).

use crate::chunk::CHUNK;
use crate::kick::Kick;
use crate::kinds::KindSet;
use crate::line::Layout;
use crate::pairs::Pairs;
use crate::walls::{Own, WallJob, strongest, wall_linear};
use crate::world::{Tally, World};
use tsubu_integrate::Drift;
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
    /// The linear solve of the averaged and the implicit dashpot: sweeps, then kick and drift.
    /// Forces run in parallel; the light passes between them are serial.
    pub(crate) fn solve(&mut self, h: f64, sweeps: u32, drift: Option<Drift>) {
        let n = self.identity.len();
        for (base, line) in self.base.iter_mut().zip(&self.lines) {
            *base = line.velocity::<D>();
        }
        self.diagonal_damping();
        for sweep in 0..sweeps {
            if sweep > 0 {
                self.forces(sweep + 1 == sweeps);
            }
            let kick = Kick {
                kinds: self.kinds.all(),
                h,
                dt: self.dt,
                drift,
                too_fast2: self.too_fast2(),
            };
            let at = |number: usize| number * CHUNK..((number + 1) * CHUNK).min(n);
            let (base, damping) = (&self.base, &self.damping);
            let chunks = self
                .chunks
                .iter_mut()
                .zip(self.lines[..n].chunks_mut(CHUNK))
                .zip(self.force.chunks(CHUNK));
            for (number, ((chunk, lines), force)) in chunks.enumerate() {
                kick.sweep::<D, K>(chunk, lines, force, &base[at(number)], &damping[at(number)]);
            }
        }
        let kick = Kick {
            kinds: self.kinds.all(),
            h,
            dt: self.dt,
            drift,
            too_fast2: self.too_fast2(),
        };
        let mut viscous = self.viscous.chunks_mut(CHUNK);
        let chunks = self
            .chunks
            .iter_mut()
            .zip(self.lines[..n].chunks_mut(CHUNK))
            .zip(self.force.chunks_mut(CHUNK))
            .zip(self.base.chunks(CHUNK));
        for (((chunk, lines), force), base) in chunks {
            kick.finish_solve::<D, K, T>(
                chunk,
                lines,
                force,
                viscous.next().unwrap_or(&mut []),
                base,
            );
        }
        self.kick_spins(h);
    }

    /// Sum of the dampings of each grain's contacts at the present positions.
    fn diagonal_damping(&mut self) {
        let walls = WallJob::<D, S, W> {
            bodies: &self.bodies,
            pairs: &self.wall_pairs,
            poses: &self.poses,
            moved: &self.body_moved,
            dt: self.dt,
            keep: false,
        };
        let pairs = Pairs {
            lines: &self.lines,
            spins: &self.spins,
            pairs: &self.pairs,
            kinds: self.kinds.all().len(),
            domain: &self.domain,
        };
        for (number, (chunk, damping)) in self
            .chunks
            .iter_mut()
            .zip(self.damping.chunks_mut(CHUNK))
            .enumerate()
        {
            let first = number * CHUNK;
            damping.fill(0.0);
            for (slot, j) in chunk.list.iter() {
                let (pair, touch) = pairs.touch::<S, K>(first + slot, j);
                damping[slot] += strongest(&L::linear(pair, &touch, self.dt));
            }
            let own = Own::of_chunk::<D, S>(
                number,
                damping.len(),
                &self.lines,
                &self.spins,
                &self.identity,
            );
            wall_linear::<D, S, K, W>(&walls, own, chunk, |slot, _, linear| {
                damping[slot] += strongest(linear);
            });
        }
    }
}
