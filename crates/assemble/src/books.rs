//! Whether energy grows that no work explains: the sign of a step that is too long, long before a grain runs away.

use tsubu_model::{Damaged, Dim, Energies, Saved, SpinState, View, Words};

/// Share of the energy that has moved by which the energy held may grow. A sound scheme swings by a few hundredths while
/// grains touch; a step over its limit doubles the energy in some periods.
const MOST: f64 = 0.5;
/// Energy in m g d per grain that counts as moved from the start: a bed at rest may settle.
const AT_REST: f64 = 0.1;

/// The energy at the start, and how far the grains have fallen since.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Books {
    first: Energies,
    fall: f64,
    at_rest: f64,
}

impl Books {
    /// Opened at this moment. Only where nothing works on the grains: no body that moves, no water, no gate that lets
    /// grains come or go.
    pub fn open<D: Dim, S: SpinState>(view: &dyn View<D, S>) -> Self {
        let g = tsubu_model::Vector::length(view.gravity());
        let scale = |i: usize| view.kind(i).weight * g * view.kind(i).diameter();
        Self {
            first: view.energies(),
            fall: 0.0,
            at_rest: AT_REST * (0..view.len()).map(scale).sum::<f64>(),
        }
    }

    /// Energy gained so far and the energy that has moved, in J, if the gain is more than that explains.
    pub fn grown<D: Dim, S: SpinState>(&mut self, view: &dyn View<D, S>) -> Option<(f64, f64)> {
        let (first, now) = (self.first, view.energies());
        self.fall = self.fall.max(first.gravitational - now.gravitational);
        let moved = first.kinetic + first.elastic + first.elastic_walls + self.fall + self.at_rest;
        let gained = now.held() - first.held();
        (gained > MOST * moved).then_some((gained, moved))
    }
}

impl Saved for Books {
    fn save(&self, words: &mut Words) {
        self.first.save(words);
        words.put_number(self.fall);
        words.put_number(self.at_rest);
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        self.first.restore(words)?;
        self.fall = words.take_number()?;
        self.at_rest = words.take_number()?;
        Ok(())
    }
}
