//! What a run writes while it goes: rows, frames and the pictures of the film, each on its cadence, and each cut back to
//! a checkpoint when the run goes on from there.

use crate::clock::Clock;
use crate::film::{Film, write_frame};
use crate::rows::Rows;
use crate::trouble::Trouble;
use tsubu::assemble::{Machine, Plan, Simulation};
use tsubu::model::{Damaged, Words};
use tsubu::record::{FrameWriter, RunFolder};
use tsubu::scene::Output;

/// Rows, frames and film of one run.
pub struct Outputs {
    clock: Clock,
    rows: Rows,
    frames: Option<FrameWriter>,
    film: Option<Film>,
}

impl Outputs {
    /// The first row and the first frame.
    pub fn start(
        folder: &RunFolder,
        output: &Output,
        plan: &Plan,
        run: &mut dyn Simulation,
    ) -> Result<Self, Trouble> {
        let mut outputs = Self {
            clock: Clock::of(output, plan),
            rows: Rows::start(folder, run)?,
            frames: output
                .frames
                .then(|| FrameWriter::new(folder))
                .transpose()?,
            film: output.animation.then(Film::new),
        };
        outputs.shoot(run)?;
        Ok(outputs)
    }

    /// Where a checkpoint left them: what was written after it is taken back. `machines` are the bodies of the scene
    /// before any was taken away.
    pub fn resume(
        folder: &RunFolder,
        output: &Output,
        machines: &[Machine],
        words: &mut Words,
    ) -> Result<Self, Trouble> {
        words.take_part("outputs")?;
        let clock = Clock {
            row: words.take_whole()?.max(1),
            frame: words.take_whole()?.max(1),
        };
        let rows = Rows::resume(folder, words)?;
        let count = words.take_flag()?.then_some(words.take_whole()?);
        let frames = count
            .map(|count| FrameWriter::resume(folder, count as usize))
            .transpose()?;
        let film = if words.take_flag()? {
            Some(Film::resume(folder, machines, words)?)
        } else {
            None
        };
        if frames.is_some() != output.frames || film.is_some() != output.animation {
            let what = "the checkpoint has other outputs than its scene asks for";
            return Err(Damaged(what.into()).into());
        }
        Ok(Self {
            clock,
            rows,
            frames,
            film,
        })
    }

    /// Where they are, for a checkpoint; what they wrote is forced to the disk first.
    pub fn save(&self, words: &mut Words) -> Result<(), Trouble> {
        words.put_part("outputs");
        words.put_whole(self.clock.row);
        words.put_whole(self.clock.frame);
        self.rows.save(words)?;
        words.put_flag(self.frames.is_some());
        words.put_whole(self.frames.as_ref().map_or(0, |f| f.count() as u64));
        words.put_flag(self.film.is_some());
        if let Some(film) = &self.film {
            film.save(words);
        }
        Ok(())
    }

    /// Steps from `now` to the next row or frame.
    pub fn to_next(&self, now: u64) -> u64 {
        self.clock.to_next(now)
    }

    /// The row and the frame that are due at this step, if any.
    pub fn at(&mut self, run: &mut dyn Simulation) -> Result<(), Trouble> {
        let now = run.steps();
        if now.is_multiple_of(self.clock.row) {
            self.rows.add(run)?;
        }
        if now.is_multiple_of(self.clock.frame) {
            self.shoot(run)?;
        }
        Ok(())
    }

    /// A row and a frame of the last moment, where none is due: a checkpoint comes before them.
    pub fn last(&mut self, run: &mut dyn Simulation) -> Result<(), Trouble> {
        let now = run.steps();
        if !now.is_multiple_of(self.clock.row) {
            self.rows.add(run)?;
        }
        if !now.is_multiple_of(self.clock.frame) {
            self.shoot(run)?;
        }
        Ok(())
    }

    /// A row and a frame, whatever the step: of a moment that another engine computed.
    pub fn moment(&mut self, run: &mut dyn Simulation) -> Result<(), Trouble> {
        self.rows.add(run)?;
        self.shoot(run)
    }

    fn shoot(&mut self, run: &dyn Simulation) -> Result<(), Trouble> {
        if self.frames.is_none() && self.film.is_none() {
            return Ok(());
        }
        let snapshot = run.snapshot();
        let mut number = None;
        if let Some(frames) = &mut self.frames {
            number = Some(frames.count());
            write_frame(frames, &snapshot, &run.machines())?;
        }
        if let Some(film) = &mut self.film {
            film.add(run, &snapshot, number);
        }
        Ok(())
    }

    /// The rows so far.
    pub fn rows(&self) -> &Rows {
        &self.rows
    }

    /// The film so far.
    pub fn film(&self) -> Option<&Film> {
        self.film.as_ref()
    }

    /// Closes the files.
    pub fn finish(self) -> Result<(), Trouble> {
        self.rows.finish()
    }
}
