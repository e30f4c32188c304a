//! The rules of time, of stillness and of output.

use super::Rules;
use crate::raw::{RawIntegrator, RawOutput, RawStep, RawStill, RawTime};
use crate::scene::{End, Integrator, Output, Step, Still, Time};

/// Sweeps of the pairwise solution of the averaged and implicit schemes, when the scene does not say.
const SWEEPS: u32 = 4;

impl Rules<'_> {
    pub(super) fn still(&mut self, raw: &RawStill) -> Still {
        let still = Still {
            kinetic_energy: self.above_zero(
                "still.kinetic_energy",
                "the kinetic energy",
                raw.kinetic_energy.0,
            ),
            for_at_least: self.not_negative("still.for_at_least", "the time", raw.for_at_least.0),
            at_most: self.above_zero("still.at_most", "the time", raw.at_most.0),
            damping: raw.damping.as_ref().map_or(1.0, |share| {
                self.above_zero("still.damping", "the share of the damping", share.0)
            }),
        };
        if still.damping > 1.0 {
            self.refuse(
                "still.damping",
                "the damping while the grains settle is more than all of it",
                "give a share of the law's damping, at most 1",
            );
        }
        if still.at_most > 0.0 && still.at_most < still.for_at_least {
            self.refuse(
                "still.at_most",
                "at_most is shorter than for_at_least",
                "grains cannot be still for longer than the run waits",
            );
        }
        still
    }

    pub(super) fn time(&mut self, raw: &RawTime) -> Option<Time> {
        let step = match raw.step {
            None | Some(RawStep::Automatic) => Step::Automatic,
            Some(RawStep::PerPeriod(count)) => Step::PerPeriod(self.above_zero(
                "time.step[0]",
                "the number of steps per period",
                count.0,
            )),
            Some(RawStep::Seconds(step)) => {
                Step::Seconds(self.above_zero("time.step[0]", "the time step", step.0))
            }
            Some(RawStep::Exactly(step)) => {
                Step::Exactly(self.above_zero("time.step[0]", "the time step", step.0))
            }
        };
        let sweeps = match raw.integrator {
            Some(
                RawIntegrator::VerletAveraged { sweeps }
                | RawIntegrator::DashpotImplicit { sweeps },
            ) => sweeps,
            _ => None,
        };
        let sweeps = sweeps.map_or(u64::from(SWEEPS), |sweeps| sweeps.0);
        if !(1..=100).contains(&sweeps) {
            self.refuse(
                "time.integrator.sweeps",
                "sweeps is outside 1 to 100",
                "4 are usual",
            );
        }
        let sweeps = sweeps.min(100) as u32;
        self.exactly_one("time", &[raw.until.is_some(), raw.steps.is_some()]);
        let end = match (raw.until, raw.steps) {
            (Some(until), _) => {
                End::Until(self.above_zero("time.until", "the end of the run", until.0))
            }
            (None, Some(steps)) => {
                self.above_zero("time.steps", "the number of steps", steps.0 as f64);
                End::Steps(steps.0)
            }
            (None, None) => return None,
        };
        let integrator = match raw.integrator {
            None | Some(RawIntegrator::SymplecticEuler) => Integrator::SymplecticEuler,
            Some(RawIntegrator::ExplicitEuler) => Integrator::ExplicitEuler,
            Some(RawIntegrator::VerletOld) => Integrator::VerletOld,
            Some(RawIntegrator::VerletAveraged { .. }) => Integrator::VerletAveraged { sweeps },
            Some(RawIntegrator::DashpotImplicit { .. }) => Integrator::DashpotImplicit { sweeps },
        };
        let solves = matches!(
            integrator,
            Integrator::VerletAveraged { .. } | Integrator::DashpotImplicit { .. }
        );
        if solves && self.spins() {
            self.refuse(
                "time.integrator",
                format!(
                    "this scheme solves for velocities, not for spins, so it is not for law {}",
                    self.law
                ),
                "write SymplecticEuler, VerletOld or ExplicitEuler",
            );
        }
        Some(Time {
            step,
            integrator,
            end,
        })
    }

    pub(super) fn output(&mut self, raw: &RawOutput) -> Output {
        let usual = Output::default();
        let output = Output {
            every: raw
                .every
                .map(|every| self.above_zero("output.every", "the interval", every.0)),
            frames: raw.frames.unwrap_or(usual.frames),
            frames_every: raw
                .frames_every
                .map(|every| self.above_zero("output.frames_every", "the interval", every.0)),
            energies: raw.energies.unwrap_or(usual.energies),
            animation: raw.animation.unwrap_or(usual.animation),
        };
        if output.frames_every.is_some() && !output.frames && !output.animation {
            self.refuse(
                "output.frames_every",
                "frames_every would be ignored without frames and animation",
                "remove it, or write frames: true",
            );
        }
        if output.energies && self.spins() {
            self.refuse(
                "output.energies",
                "the energies of springs that slip are not tallied yet: their books are not kept",
                "write energies: false, or leave it out",
            );
        }
        output
    }
}
