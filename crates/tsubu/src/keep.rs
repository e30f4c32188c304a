//! When a run writes checkpoints, and what stands in them.

use crate::film::write_alone;
use crate::outputs::Outputs;
use crate::trouble::Trouble;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tsubu::assemble::Simulation;
use tsubu::model::{Damaged, Words};
use tsubu::record::{Checkpoint, Checkpoints, RunFolder, checksum};
use tsubu::scene::Checked;

/// What a run that goes on has to know of how it was begun.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Begun {
    /// The scene file, for the closing words.
    pub scene_file: PathBuf,
    /// The command as it was typed, for the captions of figures.
    pub command: String,
    /// Whether a step over its limit was asked for.
    pub allow_unstable: bool,
}

/// How long a run took so far: in all, and in steps alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spent {
    /// From start to end, without the time between a stop and a resume.
    pub wall: Duration,
    /// In steps and list builds, without looking, writing and drawing.
    pub stepping: Duration,
}

impl Spent {
    /// Grain-steps per second of stepping.
    pub fn rate(&self, run: &dyn Simulation) -> f64 {
        run.grains() as f64 * run.steps() as f64 / self.stepping.as_secs_f64().max(1e-9)
    }
}

/// Writes the checkpoints of a run. That changes no bit of it.
pub struct Keeper {
    checkpoints: Checkpoints,
    /// Wall time between two; `None` writes none.
    every: Option<Duration>,
    last: Instant,
    begun: Begun,
    scene: String,
    files: Vec<(String, String)>,
    newest: Option<PathBuf>,
}

impl Keeper {
    /// Of a run in this folder.
    pub fn new(
        folder: &RunFolder,
        checked: &Checked,
        begun: Begun,
        every: Option<Duration>,
    ) -> Result<Self, Trouble> {
        let mut files = Vec::new();
        // Those of a run that keeps nothing are not asked for.
        for path in checked.scene.files().filter(|_| every.is_some()) {
            files.push((path.display().to_string(), checksum(path)?));
        }
        Ok(Self {
            checkpoints: Checkpoints::of(folder)?,
            every,
            last: Instant::now(),
            begun,
            scene: checked.scene.to_resolved_ron(),
            files,
            newest: None,
        })
    }

    /// True if it is time for one.
    pub fn is_due(&self) -> bool {
        self.every.is_some_and(|every| self.last.elapsed() >= every)
    }

    /// How the run was begun.
    pub fn begun(&self) -> &Begun {
        &self.begun
    }

    /// Writes one, and gives its file, unless the run is to have none.
    pub fn keep(
        &mut self,
        run: &dyn Simulation,
        outputs: &Outputs,
        spent: Spent,
    ) -> Result<Option<PathBuf>, Trouble> {
        if self.every.is_none() {
            return Ok(None);
        }
        self.last = Instant::now();
        let mut state = Words::new();
        state.put_part("begun");
        state.put_text(&self.begun.scene_file.display().to_string());
        state.put_text(&self.begun.command);
        state.put_flag(self.begun.allow_unstable);
        for time in [spent.wall, spent.stepping] {
            state.put_number(time.as_secs_f64());
        }
        outputs.save(&mut state)?;
        run.save(&mut state);
        let checkpoint = self.checkpoint(state);
        let file = self.checkpoints.write(run.steps(), &checkpoint)?;
        self.newest = Some(file.clone());
        Ok(Some(file))
    }

    /// True if the run is to have checkpoints.
    pub fn keeps(&self) -> bool {
        self.every.is_some()
    }

    /// The last one written.
    pub fn newest(&self) -> Option<&Path> {
        self.newest.as_deref()
    }

    /// Keeps a state for study, as a checkpoint and as a frame; gives the path of both without its ending.
    pub fn keep_for_study(&self, run: &dyn Simulation) -> Result<PathBuf, Trouble> {
        const NAME: &str = "before_trouble";
        let mut state = Words::new();
        run.save(&mut state);
        self.checkpoints
            .write_for_study(NAME, &self.checkpoint(state))?;
        let path = self.checkpoints.path(NAME);
        write_alone(&path.with_extension("vtp"), &run.snapshot())?;
        Ok(path)
    }

    fn checkpoint(&self, state: Words) -> Checkpoint {
        Checkpoint {
            program: env!("CARGO_PKG_VERSION").into(),
            scene: self.scene.clone(),
            files: self.files.clone(),
            state,
        }
    }
}

/// The beginning of a saved state: how the run was begun, and what it has taken.
pub fn take_begun(words: &mut Words) -> Result<(Begun, Spent), Damaged> {
    words.take_part("begun")?;
    let begun = Begun {
        scene_file: words.take_text()?.into(),
        command: words.take_text()?,
        allow_unstable: words.take_flag()?,
    };
    let mut time = || -> Result<Duration, Damaged> {
        let seconds = words.take_number()?;
        Duration::try_from_secs_f64(seconds)
            .map_err(|_| Damaged(format!("a time spent is {seconds} s")))
    };
    let (wall, stepping) = (time()?, time()?);
    Ok((begun, Spent { wall, stepping }))
}
