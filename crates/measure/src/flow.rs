//! Grains that came and went, gate by gate, and whether their count closes.

use crate::loads::columns;
use tsubu_model::{Damaged, Dim, Observer, Passage, Reading, Saved, SpinState, View, Words};

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
    /// The last look: how many grains there were, and what had come and gone.
    last: Option<(usize, Vec<Passage>)>,
}

impl Flow {
    /// An observer that has not looked yet.
    pub fn new() -> Self {
        Self::default()
    }
}

/// How many came and went in all.
fn sums(passages: &[Passage]) -> (u64, u64) {
    let came = passages.iter().map(|p| p.came).sum();
    (came, passages.iter().map(|p| p.went).sum())
}

/// Gate by gate.
fn rows(passages: &[Passage]) -> Vec<Reading> {
    let mut row = Vec::new();
    let names = columns(passages.iter().map(|p| &*p.name));
    for (passage, name) in passages.iter().zip(names) {
        for (what, count) in [
            ("came", passage.came),
            ("went", passage.went),
            ("moved", passage.moved),
        ] {
            let name = format!("{what}_through_{name}");
            row.push(Reading::new(name, count as f64, "1"));
        }
        let name = format!("mass_through_{name}");
        row.push(Reading::new(name, passage.mass, "kg"));
    }
    row
}

impl Saved for Flow {
    fn save(&self, words: &mut Words) {
        words.put_part("flow");
        words.put_maybe(self.at_first.map(|count| count as f64));
        words.put_flag(self.last.is_some());
        if let Some((grains, passages)) = &self.last {
            words.put_whole(*grains as u64);
            words.put_whole(passages.len() as u64);
            for passage in passages {
                words.put_text(&passage.name);
                passage.save(words);
            }
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("flow")?;
        self.at_first = words.take_maybe()?.map(|count| count as usize);
        self.last = None;
        if words.take_flag()? {
            let grains = words.take_whole()? as usize;
            let mut passages = Vec::new();
            for _ in 0..words.take_count(5)? {
                let mut passage = Passage::of(words.take_text()?);
                passage.restore(words)?;
                passages.push(passage);
            }
            self.last = Some((grains, passages));
        }
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Flow {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let (grains, passages) = (view.len(), view.passages());
        let (came, went) = sums(&passages);
        // What came and went before the first look belongs to the number at the start.
        self.at_first
            .get_or_insert((grains as u64 + went - came) as usize);
        let mut row = vec![Reading::new("grains", grains as f64, "1")];
        row.extend(rows(&passages));
        self.last = Some((grains, passages));
        row
    }

    fn report(&self) -> Vec<Reading> {
        let (Some(start), Some((grains, passages))) = (self.at_first, &self.last) else {
            return Vec::new();
        };
        let (came, went) = sums(passages);
        let missing = start as f64 + came as f64 - went as f64 - *grains as f64;
        // The number of grains stands in every summary already.
        let mut report = rows(passages);
        report.push(Reading::new("grains_missing", missing, "1"));
        report
    }
}
