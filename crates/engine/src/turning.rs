//! Spins: where they lie, and their kick.

use crate::chunk::CHUNK;
use crate::kinds::{KindSet, pick};
use crate::line::{Layout, Line, has_second_line};
use crate::world::{Tally, World};
use rayon::prelude::*;
use tsubu_model::{ContactLaw, SpinState, Vector};

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// Gives a grain a spin in rad/s; an unknown identity changes nothing.
    pub fn set_spin(&mut self, identity: u32, spin: S::Turn<D>) {
        if let Some(i) = self.identity.iter().position(|&id| id == identity) {
            if const { has_second_line::<D, S>() } {
                self.spins[i].set_spin::<D, S>(spin);
            } else {
                self.lines[i].set_spin::<D, S>(spin);
            }
            self.look_at_forces();
        }
    }

    /// ω += τ h/I for grains that have one.
    pub(crate) fn kick_spins(&mut self, h: f64) {
        if const { <S::Turn<D> as Vector>::AXES == 0 } {
            return;
        }
        let (n, kinds) = (self.identity.len(), self.kinds.all());
        let turn = |line: &mut Line, kind: usize, torque: S::Turn<D>| {
            let inertia = pick::<K, _>(kinds, kind).inertia;
            let spin = line.spin::<D, S>() + torque * (h / inertia);
            line.set_spin::<D, S>(spin);
        };
        if const { has_second_line::<D, S>() } {
            let lines = &self.lines;
            let own = |first: usize, spins: &mut [Line], torque: &[S::Turn<D>]| {
                for (slot, (line, torque)) in spins.iter_mut().zip(torque).enumerate() {
                    turn(line, lines[first + slot].kind::<D>(), *torque);
                }
            };
            if self.pool.is_some() {
                self.spins[..n]
                    .par_chunks_mut(CHUNK)
                    .zip(self.torque.par_chunks(CHUNK))
                    .enumerate()
                    .for_each(|(number, (spins, torque))| own(number * CHUNK, spins, torque));
            } else {
                own(0, &mut self.spins[..n], &self.torque);
            }
        } else {
            for (line, torque) in self.lines[..n].iter_mut().zip(&self.torque) {
                turn(line, line.kind::<D>(), *torque);
            }
        }
    }
}
