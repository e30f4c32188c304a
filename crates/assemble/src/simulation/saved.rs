//! What a checkpoint holds of a run: the world, the gates, the observers, and how far it has come.

use super::{Books, Running};
use tsubu_engine::{KindSet, Layout, Tally};
use tsubu_model::{ContactLaw, Damaged, Saved, SpinState, Words};

/// All that changes what comes after, but not why it stopped: only a run that goes on is saved.
impl<D, S, K, L, W, T> Saved for Running<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    fn save(&self, words: &mut Words) {
        words.put_part("run");
        words.put_flag(self.law_after.is_some());
        for step in [self.release.and_then(|r| r.at_step), self.weigh_at] {
            words.put_flag(step.is_some());
            words.put_whole(step.unwrap_or(0));
        }
        words.put_maybe(self.used);
        words.put_flag(self.books.is_some());
        self.books.unwrap_or_default().save(words);
        self.world.save(words);
        words.put_whole(self.gates.len() as u64);
        self.gates.iter().for_each(|gate| gate.save(words));
        words.put_whole(self.observers.len() as u64);
        self.observers.iter().for_each(|o| o.save(words));
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("run")?;
        let still_settling = words.take_flag()?;
        let mut step = || -> Result<Option<u64>, Damaged> {
            let there = words.take_flag()?;
            let step = words.take_whole()?;
            Ok(there.then_some(step))
        };
        let (released, weigh_at) = (step()?, step()?);
        if let Some(release) = &mut self.release {
            release.at_step = released;
        }
        self.weigh_at = weigh_at;
        self.used = words.take_maybe()?;
        let open = words.take_flag()?;
        let mut books = Books::default();
        books.restore(words)?;
        self.books = open.then_some(books);
        self.trouble = None;
        if !still_settling && let Some(law) = self.law_after.take() {
            self.world.set_law(&law);
        }
        self.world.restore(words)?;
        words.take_same(self.gates.len(), "gates")?;
        for gate in &mut self.gates {
            gate.restore(words)?;
        }
        words.take_same(self.observers.len(), "observers")?;
        for observer in &mut self.observers {
            observer.restore(words)?;
        }
        Ok(())
    }
}
