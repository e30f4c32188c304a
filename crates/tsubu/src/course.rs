//! The course of one run: from its first step, or from a checkpoint, to its end.

use crate::ending::{self, Pictures};
use crate::figures;
use crate::keep::{Begun, Keeper, Spent};
use crate::outputs::Outputs;
use crate::progress::Progress;
use crate::trouble::Trouble;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use tsubu::assemble::{Built, Choices, Plan, Simulation, Stop, build};
use tsubu::engine::Health;
use tsubu::model::{Curve, Words};
use tsubu::record::{RunFolder, Summary, write_whole};
use tsubu::scene::Checked;

/// Steps between two looks at the clock and at signals: short enough to stop at once, long enough not to matter.
const GLANCE: u64 = 64;
/// Age of the state from which one before trouble is found again: that takes as long.
const RECENT: Duration = Duration::from_secs(2);
/// Steps between two looks for deep overlaps and for energy from nowhere.
const LOOKS: u64 = 1000;

/// How a run ended.
pub enum End {
    /// As the scene says.
    Over,
    /// The physics failed, in words.
    Failed(String),
    /// A signal stopped it.
    Stopped {
        /// When, in s of simulated time.
        time: f64,
        /// The checkpoint that holds its state.
        kept: Option<PathBuf>,
    },
}

/// A run that has ended.
pub struct Ran {
    /// How.
    pub end: End,
    /// What it left in `summary.json`.
    pub summary: Summary,
    /// The curves of its observers.
    pub curves: Vec<Curve>,
    /// What was drawn.
    pub pictures: Pictures,
}

/// Where a run writes, and who may stop it.
pub struct Place<'a> {
    /// Its folder.
    pub folder: &'a RunFolder,
    /// Raised to stop it.
    pub stopped: &'a AtomicBool,
    /// When the command was started.
    pub start: Instant,
    /// Wall time between two checkpoints; `None` writes none.
    pub every: Option<Duration>,
    /// What it was built with: a state before trouble is built again.
    pub choices: &'a Choices,
}

/// A run under way.
pub struct Course<'a> {
    place: Place<'a>,
    checked: &'a Checked,
    run: Box<dyn Simulation>,
    plan: Plan,
    outputs: Outputs,
    keeper: Keeper,
    /// What the parts before the last resume took.
    before: Spent,
    stepping: Duration,
    /// A state of a moment ago, and when it was taken: from there a state just before trouble is found again.
    recent: (Words, Instant),
}

impl<'a> Course<'a> {
    /// At the first step: first outputs, and a checkpoint, so that a kill at any moment leaves one.
    pub fn begin(
        place: Place<'a>,
        checked: &'a Checked,
        built: Built,
        begun: Begun,
    ) -> Result<Self, Trouble> {
        let (mut run, plan) = (built.simulation, built.plan);
        let resolved = checked.scene.to_resolved_ron();
        let path = place.folder.path("scene.resolved.ron");
        write_whole(&path, resolved.as_bytes())?;
        place.folder.make("figures")?;
        let output = &checked.scene.output;
        let outputs = Outputs::start(place.folder, output, &plan, &mut *run)?;
        let keeper = Keeper::new(place.folder, checked, begun, place.every)?;
        let mut course = Self {
            place,
            checked,
            run,
            plan,
            outputs,
            keeper,
            before: Spent::default(),
            stepping: Duration::ZERO,
            recent: (Words::new(), Instant::now()),
        };
        course.remember();
        course.keep()?;
        Ok(course)
    }

    /// At a checkpoint, from what stands in it after [`take_begun`](crate::keep::take_begun).
    pub fn resume(
        place: Place<'a>,
        checked: &'a Checked,
        built: Built,
        (begun, before): (Begun, Spent),
        words: &mut Words,
    ) -> Result<Self, Trouble> {
        let (mut run, plan) = (built.simulation, built.plan);
        place.folder.make("figures")?;
        let output = &checked.scene.output;
        let machines = run.machines();
        let outputs = Outputs::resume(place.folder, output, &machines, words)?;
        run.restore(words)?;
        let keeper = Keeper::new(place.folder, checked, begun, place.every)?;
        let mut course = Self {
            place,
            checked,
            run,
            plan,
            outputs,
            keeper,
            before,
            stepping: Duration::ZERO,
            recent: (Words::new(), Instant::now()),
        };
        course.remember();
        Ok(course)
    }

    /// The run as it is now.
    pub fn simulation(&self) -> &dyn Simulation {
        &*self.run
    }

    fn spent(&self) -> Spent {
        Spent {
            wall: self.before.wall + self.place.start.elapsed(),
            stepping: self.before.stepping + self.stepping,
        }
    }

    /// Takes the state of this moment, unless the run keeps nothing.
    fn remember(&mut self) {
        if self.keeper.keeps() {
            let mut words = Words::new();
            self.run.save(&mut words);
            self.recent = (words, Instant::now());
        }
    }

    /// The state just before trouble, found by running on from the recent one, which takes the same steps; where trouble is
    /// looked for at times only, that of the look before. In words where it is.
    fn keep_before(&mut self, stop: &Stop) -> Result<String, Trouble> {
        let last = self.run.steps();
        let before = match stop {
            Stop::Trouble(Health::Runaway { .. }) => last.saturating_sub(1),
            Stop::Trouble(Health::DeepOverlap { .. }) | Stop::EnergyGrows { .. } => {
                last.saturating_sub(1) / LOOKS * LOOKS
            }
            _ => return Ok(String::new()),
        };
        if !self.keeper.keeps() {
            return Ok(String::new());
        }
        let mut again = build(self.checked, self.place.choices)?.simulation;
        again.restore(&mut std::mem::take(&mut self.recent.0))?;
        again.advance(before.saturating_sub(again.steps()));
        let study = self.keeper.keep_for_study(&*again)?;
        let mut words = format!(
            "\nnote: the grains at t = {:.6} s, before it, are in {}.vtp for ParaView, and in full beside it",
            again.time(),
            study.display()
        );
        if let Some(newest) = self.keeper.newest() {
            words += &format!("\nnote: the last checkpoint is {}", newest.display());
        }
        Ok(words)
    }

    fn keep(&mut self) -> Result<Option<PathBuf>, Trouble> {
        let spent = self.spent();
        self.keeper.keep(&*self.run, &self.outputs, spent)
    }

    fn goes_on(&self) -> bool {
        !self.run.is_over() && !self.place.stopped.load(Ordering::SeqCst)
    }

    /// To the end, or until it is stopped; then the summary, the figures and the film.
    pub fn go(mut self, mut progress: Progress) -> Result<Ran, Trouble> {
        while self.goes_on() {
            let mut due = self.outputs.to_next(self.run.steps());
            while due > 0 && self.goes_on() {
                let glance = Instant::now();
                due -= self.run.advance(due.min(GLANCE)).min(due);
                self.stepping += glance.elapsed();
                progress.show(&*self.run, self.spent().stepping);
                if self.recent.1.elapsed() > RECENT && self.goes_on() {
                    self.remember();
                }
                // Not where outputs are still to come: those of a checkpoint are those up to its step.
                if due > 0 && self.keeper.is_due() && self.goes_on() {
                    self.keep()?;
                }
            }
            self.outputs.at(&mut *self.run)?;
            if self.keeper.is_due() && self.goes_on() {
                self.keep()?;
            }
        }
        let stop = self.run.stop();
        let sound = matches!(stop, None | Some(Stop::Over));
        let kept = if sound { self.keep()? } else { None };
        let study = match &stop {
            Some(stop) => self.keep_before(stop)?,
            None => String::new(),
        };
        self.outputs.last(&mut *self.run)?;
        let ended = match &stop {
            Some(Stop::Over) => "over",
            Some(Stop::NeverStill { .. }) => "never still",
            Some(Stop::NoBed { .. }) => "no bed",
            Some(Stop::UnstablePacking { .. }) => "unstable step",
            Some(Stop::Trouble(_) | Stop::EnergyGrows { .. }) => "trouble",
            None => "stopped by a signal",
        };
        // Before the pictures, which may fail, and again with the time that they took.
        self.summarise(ended)?;
        progress.say("drawing");
        let film = match self.outputs.film() {
            Some(film) => film.draw(self.place.folder, self.run.released_at())?,
            None => None,
        };
        let command = &self.keeper.begun().command;
        let figures = figures::draw(self.place.folder, &*self.run, self.outputs.rows(), command)?;
        progress.finish();
        let summary = self.summarise(ended)?;
        self.outputs.finish()?;
        Ok(Ran {
            end: match stop {
                Some(Stop::Over) => End::Over,
                Some(stop) => End::Failed(ending::failure(&stop, &self.plan) + &study),
                None => End::Stopped {
                    time: self.run.time(),
                    kept,
                },
            },
            summary,
            curves: self.run.curves(),
            pictures: Pictures {
                film: film.map(|drawn| drawn.0),
                figures,
            },
        })
    }

    fn summarise(&self, ended: &str) -> Result<Summary, Trouble> {
        let (folder, scene) = (self.place.folder, &self.checked.scene);
        let (run, rows) = (&*self.run, self.outputs.rows());
        let spent = Some(self.spent());
        ending::summary(folder, scene, &self.plan, run, rows, spent, ended)
    }
}
