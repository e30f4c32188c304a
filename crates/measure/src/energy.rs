//! The energy budget.

use tsubu_model::{Damaged, Dim, Energies, Observer, Reading, Saved, SpinState, View, Words};

/// Where the energy is and where it went, and whether the books close.
///
/// Rows, all in J: the entries of [`Energies`] and their `total`.
///
/// Report: `energy_budget_error` = max |E − E₀| / E_through, a share, where E is the total (held, lost and
/// taken), E₀ that of the first look, the maximum is over all looks, and
/// E_through = K₀ + elastic₀ + max (G₀ − G) is the energy that went through the books: what was moving or
/// strained at the first look and the largest fall of gravitational energy since.
/// The denominator is never taken under 1e-6 of the largest entry seen, so that rounding is not divided by
/// nothing where nothing has moved; all zero gives 0.
/// Not for scenes in which moving bodies or driven grains do work on the grains: that work is in no entry.
/// Grains that no force moves (infinite mass) have no kinetic energy in the books that the view keeps.
///
/// A ball dropped by 1 m that has lost 0.1 % of its energy to nowhere has an error of 0.001.
#[derive(Clone, Debug, Default)]
pub struct Energy {
    first: Option<Energies>,
    largest_error: f64,
    largest_fall: f64,
    largest_entry: f64,
}

impl Energy {
    /// An observer that has not looked yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes one look at the books.
    fn note(&mut self, now: &Energies) {
        let first = *self.first.get_or_insert(*now);
        self.largest_error = worse(self.largest_error, (now.total() - first.total()).abs());
        self.largest_fall = self
            .largest_fall
            .max(first.gravitational - now.gravitational);
        for (_, value) in entries(now) {
            self.largest_entry = self.largest_entry.max(value.abs());
        }
    }

    /// Share of the energy that went through the books by which they do not close; NaN before the
    /// first look and once an energy is not a number.
    fn error(&self) -> f64 {
        let Some(first) = self.first else {
            return f64::NAN;
        };
        let through = first.kinetic + first.elastic + first.elastic_walls + self.largest_fall;
        let denominator = through.max(1e-6 * self.largest_entry);
        if self.largest_error == 0.0 {
            0.0
        } else {
            self.largest_error / denominator
        }
    }
}

/// The larger of the two; NaN is the largest of all and stays.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

fn entries(e: &Energies) -> [(&'static str, f64); 8] {
    [
        ("kinetic", e.kinetic),
        ("gravitational", e.gravitational),
        ("elastic", e.elastic),
        ("elastic_walls", e.elastic_walls),
        ("lost_damping", e.lost_damping),
        ("lost_wall_damping", e.lost_wall_damping),
        ("lost_wall_friction", e.lost_wall_friction),
        ("taken_by_removal", e.taken_by_removal),
    ]
}

impl Saved for Energy {
    fn save(&self, words: &mut Words) {
        words.put_part("energy");
        words.put_flag(self.first.is_some());
        self.first.unwrap_or_default().save(words);
        for value in [self.largest_error, self.largest_fall, self.largest_entry] {
            words.put_number(value);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("energy")?;
        let looked = words.take_flag()?;
        let mut first = Energies::default();
        first.restore(words)?;
        self.first = looked.then_some(first);
        for value in [
            &mut self.largest_error,
            &mut self.largest_fall,
            &mut self.largest_entry,
        ] {
            *value = words.take_number()?;
        }
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Energy {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let now = view.energies();
        self.note(&now);
        let mut row: Vec<Reading> = entries(&now)
            .into_iter()
            .map(|(name, value)| Reading::new(name, value, "J"))
            .collect();
        row.push(Reading::new("total", now.total(), "J"));
        row
    }

    fn report(&self) -> Vec<Reading> {
        vec![Reading::new("energy_budget_error", self.error(), "share")]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(looks: &[Energies]) -> f64 {
        let mut energy = Energy::new();
        looks.iter().for_each(|e| energy.note(e));
        energy.error()
    }

    #[test]
    fn a_falling_ball_that_loses_a_thousandth() {
        // m g h = 2 J falls; 1.998 J arrive.
        let start = Energies {
            gravitational: 7.0,
            ..Default::default()
        };
        let end = Energies {
            gravitational: 5.0,
            kinetic: 1.998,
            ..Default::default()
        };
        assert!((seen(&[start, end]) - 0.001).abs() < 1e-12);
        // The worst moment counts, not the last, and the books stay open.
        let closed = Energies {
            gravitational: 5.0,
            lost_damping: 2.0,
            ..Default::default()
        };
        assert!((seen(&[start, end, closed]) - 0.001).abs() < 1e-12);
    }

    #[test]
    fn without_gravity_the_motion_at_the_start_is_the_measure() {
        let start = Energies {
            kinetic: 4.0,
            ..Default::default()
        };
        let end = Energies {
            kinetic: 3.0,
            lost_damping: 0.96,
            ..Default::default()
        };
        assert!((seen(&[start, end]) - 0.01).abs() < 1e-12);
    }

    #[test]
    fn nothing_moved_is_no_error() {
        assert_eq!(seen(&[Energies::default(); 2]), 0.0);
        let rest = Energies {
            gravitational: 1.0,
            ..Default::default()
        };
        let rounded = Energies {
            gravitational: 1.0 - 2e-16,
            ..Default::default()
        };
        assert!(seen(&[rest, rounded]) < 1e-9);
        assert!(Energy::new().error().is_nan());
    }

    #[test]
    fn not_a_number_is_not_hidden() {
        let bad = Energies {
            kinetic: f64::NAN,
            ..Default::default()
        };
        assert!(seen(&[Energies::default(), bad, Energies::default()]).is_nan());
    }
}
