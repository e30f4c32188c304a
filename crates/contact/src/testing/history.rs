//! Short histories of a contact: what a law with memory must be driven along before it can be judged.

use super::states::{Case, State, scattered};
use tsubu_model::{ContactLaw, Dim, Numbers, Push, SpinState, Vector};

/// States of one contact, a step apart. It begins with nothing remembered.
pub(super) struct History<D: Dim, S: SpinState> {
    /// The step in s.
    pub dt: f64,
    pub states: Vec<State<D, S>>,
}

/// One step of a history.
pub(super) struct Moment<'h, D: Dim, S: SpinState, M> {
    pub state: State<D, S>,
    pub before: M,
    pub push: Push<D, S>,
    pub after: &'h M,
}

/// Steps in which a history presses, then rubs, then parts.
const PHASES: [usize; 3] = [15, 30, 15];

impl<D: Dim, S: SpinState> History<D, S> {
    fn of_one(state: State<D, S>, dt: f64) -> Self {
        Self {
            dt,
            states: vec![state],
        }
    }

    /// How far rounding of lengths lets a force stray that has been summed up over the history, over k·range.
    /// A force of one state strays by its own rounding only.
    pub(super) fn drift(&self) -> f64 {
        if self.states.len() > 1 { 1e-13 } else { 0.0 }
    }

    /// The history with each state seen otherwise.
    pub(super) fn seen(&self, how: impl Fn(State<D, S>) -> State<D, S>) -> Self {
        Self {
            dt: self.dt,
            states: self.states.iter().copied().map(how).collect(),
        }
    }
}

impl<'a, D: Dim, S: SpinState, L: ContactLaw<D, S>> Case<'a, D, S, L> {
    /// Contacts that have just begun, in every state from this overlap up; and, for a law that remembers, contacts that are
    /// pressed, rubbed this way and that, and parted.
    pub(super) fn histories(&self, least: f64) -> Vec<History<D, S>> {
        let fresh = self.states(least).map(|s| History::of_one(s, self.dt));
        let mut all: Vec<_> = fresh.collect();
        if L::Memory::N == 0 {
            return all;
        }
        for number in 0..4 {
            for overlap in [1e-3, 3e-2] {
                // Sticks, slides.
                for rub in [0.05, 5.0] {
                    // As fast as a collision, and so slowly that no dashpot is felt.
                    for pace in [1.0, 1e4] {
                        all.push(self.rubbed(number, overlap, rub * overlap, pace * self.dt));
                    }
                }
            }
        }
        all
    }

    /// Down to this overlap, along a curved path and with a changing spin, and out again; overlap and rub over the range.
    fn rubbed(&self, number: u64, overlap: f64, rub: f64, dt: f64) -> History<D, S> {
        let n = scattered::<D::V>(30 + number);
        let n = n * (1.0 / n.length());
        let [s, t] = [40, 50].map(|k| scattered::<D::V>(k + number) * rub);
        let [u, w] = [60, 70].map(|k| scattered::<S::Turn<D>>(k + number) * (rub * self.range));
        let total = PHASES.iter().sum::<usize>();
        let place = |step: usize| {
            let depth = if step < PHASES[0] {
                step as f64 / PHASES[0] as f64
            } else {
                ((total - step) as f64 / PHASES[2] as f64).min(1.0)
            };
            let phase = step as f64 / total as f64 * std::f64::consts::TAU;
            let direction = n + s * (2.3 * phase).sin() + t * (1.7 * phase + 0.4).cos();
            // From and to a gap of a fifth of the overlap.
            let r = self.range * (1.0 - overlap * (1.2 * depth - 0.2));
            direction * (r / direction.length())
        };
        let turned = |step: usize| {
            let phase = step as f64 / total as f64 * std::f64::consts::TAU;
            u * (2.9 * phase).sin() + w * (1.3 * phase + 0.9).cos()
        };
        let rolled = |step: usize| {
            let phase = step as f64 / total as f64 * std::f64::consts::TAU;
            (u * (1.9 * phase).sin() + w * (2.3 * phase + 0.2).cos()) * (1.0 / self.range)
        };
        let per_step = 1.0 / dt;
        let states = (1..=total).map(|step| State {
            apart: place(step),
            velocity: (place(step) - place(step - 1)) * per_step,
            spin: (turned(step) - turned(step - 1)) * per_step,
            roll: (rolled(step) - rolled(step - 1)) * per_step,
        });
        History {
            dt,
            states: states.collect(),
        }
    }

    /// Drives the law along a history.
    pub(super) fn walk(
        &self,
        history: &History<D, S>,
        mut each: impl FnMut(Moment<'_, D, S, L::Memory>),
    ) {
        let mut memory = L::Memory::zero();
        for &state in &history.states {
            let before = memory;
            let push = L::force(&self.pair, &self.at(state), &mut memory, history.dt);
            each(Moment {
                state,
                before,
                push,
                after: &memory,
            });
        }
    }

    /// Pressed along n from out of range down to this overlap over the range, and held: the last state, and what is then
    /// remembered. Nothing, for a law that remembers nothing.
    pub(super) fn pressed(&self, n: D::V, overlap: f64) -> (State<D, S>, L::Memory) {
        const STEPS: u32 = 20;
        let mut memory = L::Memory::zero();
        let step = n * (-overlap * self.range / f64::from(STEPS));
        let still = State::at_rest(n * (self.range * (1.0 - overlap)));
        for left in (0..STEPS).rev() {
            let state = State::moving(still.apart - step * f64::from(left), step * (1.0 / self.dt));
            L::force(&self.pair, &self.at(state), &mut memory, self.dt);
        }
        L::force(&self.pair, &self.at(still), &mut memory, self.dt);
        (still, memory)
    }
}

/// True if the two remember the same; a law that resists rolling may hold numbers that are odd under exchange of the grains.
pub(super) fn same<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    one: &L::Memory,
    other: &L::Memory,
) -> bool {
    (0..L::Memory::N).all(|k| {
        let (one, other) = (one.get(k), other.get(k));
        one == other || (L::ROLLS && one == -other)
    })
}

/// What is remembered, in numbers.
pub(super) fn listed<M: Numbers>(memory: &M) -> Vec<f64> {
    (0..M::N).map(|k| memory.get(k)).collect()
}
