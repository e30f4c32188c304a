//! The structure of a packing: contacts, solid fraction, overlaps.

use crate::free::is_free;
use crate::{Deposit, Slices};
use tsubu_model::{Damaged, Observer, Reading, Saved, SpinState, View, Words};

/// Coordination, packing fraction and overlaps.
///
/// Rows and report (of the last look):
/// * `coordination`: Z = mean number of contacts with grains of a grain well inside the deposit
///   ([`Deposit::inside`]; all grains of the deposit if it has no inside). Contacts with walls are not counted,
///   which is why grains near walls are not asked.
/// * `coordination_bearing`: the mechanical coordination number Z_m = (2 N_c − N₁)/(N − N₀ − N₁), the mean over grains with at least two
///   contacts, N₀ and N₁ being the numbers of grains with none and one (`Thornton2000`, formula checked in later works that quote
///   it). The same for plane and space; grains with two or three contacts that carry nothing are not looked for. NaN if there is no such grain.
/// * `packing_fraction`: [`Deposit::bulk_fraction`], with its uncertainty where it is known.
/// * `overlap_max`, `overlap_mean`: overlap δ over the sum of radii of the pair, largest and mean over
///   all touching pairs; 0 without contact.
///
/// Of grains that no force moves (infinite mass) none is asked for its contacts. A contact with one of them counts for the
/// other grain and among the overlaps; one between two of them counts nowhere.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    depth: Option<f64>,
    last: Vec<Reading>,
}

impl Structure {
    /// `depth` is the period along y in m, or `None` for a walled or open scene: the extent of the grains.
    pub fn new(depth: Option<f64>) -> Self {
        Self {
            depth,
            last: Vec::new(),
        }
    }
}

/// The values of a look, in the order of the row, and their uncertainties.
fn row(values: [(f64, Option<f64>); 5]) -> Vec<Reading> {
    const NAMES: [&str; 5] = [
        "coordination",
        "coordination_bearing",
        "packing_fraction",
        "overlap_max",
        "overlap_mean",
    ];
    let named = NAMES.into_iter().zip(values);
    named
        .map(|(name, (value, uncertainty))| Reading {
            uncertainty,
            ..Reading::new(name, value, "1")
        })
        .collect()
}

impl Saved for Structure {
    fn save(&self, words: &mut Words) {
        words.put_part("structure");
        words.put_whole(self.last.len() as u64);
        for reading in &self.last {
            words.put_number(reading.value);
            words.put_maybe(reading.uncertainty);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("structure")?;
        let mut values = [(0.0, None); 5];
        let count = words.take_whole()?;
        if count > 0 {
            for (value, uncertainty) in &mut values {
                (*value, *uncertainty) = (words.take_number()?, words.take_maybe()?);
            }
        }
        self.last = if count > 0 { row(values) } else { Vec::new() };
        Ok(())
    }
}

impl<D: Slices, S: SpinState> Observer<D, S> for Structure {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let mut contacts = vec![0u32; view.len()];
        let (mut pairs, mut sum, mut largest) = (0u64, 0.0, 0.0f64);
        view.touching(&mut |pair| {
            contacts[pair.i] += 1;
            contacts[pair.j] += 1;
            // Fixed grains may overlap as they like: nothing is pressed together there.
            if !is_free(view.kind(pair.i)) && !is_free(view.kind(pair.j)) {
                return;
            }
            let share = pair.overlap / (view.kind(pair.i).radius + view.kind(pair.j).radius);
            pairs += 1;
            sum += share;
            largest = largest.max(share);
        });
        let deposit = Deposit::of(view, self.depth);
        let asked = if deposit.inside.is_empty() {
            &deposit.grains
        } else {
            &deposit.inside
        };
        let mean = |least: u32| {
            let of: Vec<u32> = asked
                .iter()
                .map(|&i| contacts[i])
                .filter(|c| *c >= least)
                .collect();
            of.iter().map(|c| f64::from(*c)).sum::<f64>() / of.len() as f64
        };
        let known = deposit
            .bulk_uncertainty
            .is_finite()
            .then_some(deposit.bulk_uncertainty);
        let overlap = if pairs > 0 { sum / pairs as f64 } else { 0.0 };
        self.last = row([
            (mean(0), None),
            (mean(2), None),
            (deposit.bulk_fraction, known),
            (largest, None),
            (overlap, None),
        ]);
        self.last.clone()
    }

    fn report(&self) -> Vec<Reading> {
        self.last.clone()
    }
}
