//! `tsubu resume`: a run that was stopped goes on from its newest whole checkpoint, to the bits of one never stopped.

use crate::arguments::ResumeWish;
use crate::course::{Course, Place};
use crate::keep::take_begun;
use crate::progress::Progress;
use crate::run::{choices_of, closing, until_signal};
use crate::trouble::Trouble;
use std::path::Path;
use std::time::Instant;
use tsubu::assemble::build;
use tsubu::record::{Checkpoint, Checkpoints, RunFolder, checksum};
use tsubu::scene::Source;

/// `tsubu resume`.
pub fn resume(wish: &ResumeWish) -> Result<u8, Trouble> {
    let start = Instant::now();
    let folder = RunFolder::reopen(&wish.folder)?;
    if let Some(seed) = folder.seeds()?.first() {
        return Err(Trouble::Arguments(format!(
            "{} holds the runs of several seeds\nhelp: go on with each: tsubu resume {}",
            folder.root().display(),
            folder.path(seed).display()
        )));
    }
    let newest = Checkpoints::of(&folder)?.newest()?;
    for damaged in &newest.damaged {
        tell!("warning: {damaged}; it is set aside, and the one before is taken");
    }
    let checkpoint = newest.checkpoint;
    same_files(&checkpoint)?;
    let here = env!("CARGO_PKG_VERSION");
    if checkpoint.program != here {
        tell!(
            "note: tsubu {} wrote the checkpoint and {here} goes on: from here on the last bits may differ",
            checkpoint.program
        );
    }
    let mut source = Source::from_text(&newest.path.display().to_string(), &checkpoint.scene);
    if let Some(until) = &wish.until {
        source.set(&format!("time.until={until}"))?;
    }
    let checked = source.check()?;
    let mut words = checkpoint.state;
    let (begun, before) = take_begun(&mut words)?;
    let machine = &wish.machine;
    let choices = choices_of(machine, begun.allow_unstable, Some(&wish.folder));
    let built = build(&checked, &choices)?;
    let (lambda, threads) = (built.plan.constants.lambda, built.plan.threads);
    let stopped = until_signal();
    let place = Place {
        folder: &folder,
        stopped: &stopped,
        start,
        every: wish.keep.every(),
        choices: &choices,
    };
    let scene_file = begun.scene_file.clone();
    let course = Course::resume(place, &checked, built, (begun, before), &mut words)?;
    let run = course.simulation();
    tell!(
        "{}: goes on at t = {:.6} s, step {}, with {} grains, {threads} thread(s), in {}",
        checked.scene.title,
        run.time(),
        run.steps(),
        run.grains(),
        folder.root().display()
    );
    let ran = course.go(Progress::new())?;
    let wall = start.elapsed().as_secs_f64();
    closing(&ran, wall, lambda, &folder, &scene_file)
}

/// The files that the scene names must be what they were.
fn same_files(checkpoint: &Checkpoint) -> Result<(), Trouble> {
    for (name, sum) in &checkpoint.files {
        if checksum(Path::new(name))? != *sum {
            return Err(Trouble::Arguments(format!(
                "{name} has changed since the checkpoint was written, so the run would go on as another one\n\
                 help: put the old file back, or run the scene again"
            )));
        }
    }
    Ok(())
}
