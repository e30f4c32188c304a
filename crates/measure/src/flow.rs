//! Grains that came and went, gate by gate, and whether their count closes.

use crate::loads::columns;
use tsubu_model::{Dim, Observer, Reading, SpinState, View};

/// The numbers of grains.
///
/// Rows: `grains` (1; fixed ones are grains too), and for a gate named `outlet`: `came_through_outlet`,
/// `went_through_outlet`, `moved_through_outlet` (1, counted since the start; a grain that is moved has gone and come in one)
/// and `mass_through_outlet` (kg, of those that went or were moved).
/// Report: the last of these, and `grains_missing` (1) = grains at the first look + came − went − grains now,
/// which is zero if none was lost without a word.
///
/// 100 grains, 7 come and 4 go: `grains` = 103, `grains_missing` = 0.
#[derive(Clone, Debug, Default)]
pub struct Flow {
    at_first: Option<usize>,
    last: Vec<Reading>,
}

impl Flow {
    /// An observer that has not looked yet.
    pub fn new() -> Self {
        Self::default()
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Flow {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let passages = view.passages();
        let came: u64 = passages.iter().map(|p| p.came).sum();
        let went: u64 = passages.iter().map(|p| p.went).sum();
        // What came and went before the first look belongs to the number at the start.
        let start = *self
            .at_first
            .get_or_insert((view.len() as u64 + went - came) as usize);
        let missing = start as f64 + came as f64 - went as f64 - view.len() as f64;
        let mut row = vec![Reading::new("grains", view.len() as f64, "1")];
        for (passage, name) in passages
            .iter()
            .zip(columns(passages.iter().map(|p| &*p.name)))
        {
            for (what, count) in [
                ("came", passage.came),
                ("went", passage.went),
                ("moved", passage.moved),
            ] {
                row.push(Reading::new(
                    format!("{what}_through_{name}"),
                    count as f64,
                    "1",
                ));
            }
            row.push(Reading::new(
                format!("mass_through_{name}"),
                passage.mass,
                "kg",
            ));
        }
        // The number of grains stands in every summary already.
        self.last = row[1..].to_vec();
        self.last.push(Reading::new("grains_missing", missing, "1"));
        row
    }

    fn report(&self) -> Vec<Reading> {
        self.last.clone()
    }
}
