//! `tsubu run --seeds`: one scene with several seeds, each in a folder of its own, and their means.

mod figures;
mod wish;

pub use wish::Seeds;

use crate::arguments::RunWish;
use crate::course::{Course, End, Place, Ran};
use crate::ending::{self, Pictures};
use crate::keep::Begun;
use crate::progress::Progress;
use crate::run::{begun, choices, command_line, stem, until_signal};
use crate::trouble::Trouble;
use indicatif::MultiProgress;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};
use tsubu::assemble::{Choices, build, threads_that_pay};
use tsubu::record::{RunFolder, Summary};
use tsubu::scene::Checked;

/// What every run of a seed needs.
struct Job<'a> {
    checked: &'a Checked,
    choices: Choices,
    folder: &'a RunFolder,
    stopped: &'a AtomicBool,
    bars: MultiProgress,
    begun: Begun,
    every: Option<Duration>,
}

impl Job<'_> {
    fn run(&self, seed: u64) -> Result<Ran, Trouble> {
        let start = Instant::now();
        let mut checked = self.checked.clone();
        checked.scene.reseed(seed);
        let built = build(&checked, &self.choices)?;
        let folder = self.folder.of_seed(seed)?;
        let progress = Progress::among(&self.bars, &format!("seed {seed}: "));
        let place = Place {
            folder: &folder,
            stopped: self.stopped,
            start,
            every: self.every,
            choices: &self.choices,
        };
        let ran = Course::begin(place, &checked, built, self.begun.clone())?.go(progress)?;
        let words = match &ran.end {
            End::Over => ending::result(&ran.summary),
            End::Failed(words) => format!("failed: {words}"),
            End::Stopped { time, .. } => format!("stopped by a signal at t = {time:.6} s"),
        };
        self.bars.suspend(|| tell!("seed {seed}: {words}"));
        Ok(ran)
    }

    /// Runs all seeds, so many at once; in their order, without those that a signal or a fault of the machine kept from
    /// starting.
    fn run_all(&self, seeds: &[u64], at_once: usize) -> Result<Vec<(u64, Ran)>, Trouble> {
        let (next, broken) = (AtomicUsize::new(0), AtomicBool::new(false));
        let ended = Mutex::new(Vec::new());
        let work = || {
            while !self.stopped.load(Ordering::SeqCst) && !broken.load(Ordering::SeqCst) {
                let number = next.fetch_add(1, Ordering::SeqCst);
                let Some(&seed) = seeds.get(number) else {
                    break;
                };
                let ran = self.run(seed);
                broken.fetch_or(ran.is_err(), Ordering::SeqCst);
                if let Ok(mut ended) = ended.lock() {
                    ended.push((number, ran));
                }
            }
        };
        thread::scope(|scope| {
            for _ in 0..at_once {
                scope.spawn(work);
            }
        });
        let mut ended = ended
            .into_inner()
            .unwrap_or_else(|poison| poison.into_inner());
        ended.sort_by_key(|(number, _)| *number);
        ended
            .into_iter()
            .map(|(number, ran)| Ok((seeds[number], ran?)))
            .collect()
    }
}

/// `tsubu run --seeds`.
pub fn run(wish: &RunWish, seeds: &Seeds, checked: &Checked) -> Result<u8, Trouble> {
    let start = Instant::now();
    let seeds = &seeds.0;
    let mut checked = checked.clone();
    if !checked.scene.reseed(seeds[0]) {
        return Err(Trouble::Arguments(
            "nothing in this scene is random, so every seed would be the same run\n\
             help: leave out --seeds, or start from a fill or a bed, or let the water be turbulent"
                .into(),
        ));
    }
    let total = wish.scene.machine.threads.map_or_else(
        || thread::available_parallelism().map_or(1, |n| n.get()),
        usize::from,
    );
    let mut choices = choices(&wish.scene, wish.out.as_deref());
    choices.threads = Some(1);
    // Built once to see that it can be, before there is a folder.
    let plan = build(&checked, &choices)?.plan;
    let threads = threads_that_pay(plan.grains).min(total);
    choices.threads = Some(threads);
    let at_once = (total / threads).clamp(1, seeds.len());
    let folder = RunFolder::create(wish.out.as_deref(), &stem(&wish.scene), wish.force)?;
    folder.make("figures")?;
    tell!(
        "{}: {} seeds, {at_once} at once on {threads} thread(s) each, {} grains, step {:.3e} s, into {}",
        checked.scene.title,
        seeds.len(),
        plan.grains,
        plan.constants.dt,
        folder.root().display()
    );
    let stopped = until_signal();
    let job = Job {
        checked: &checked,
        choices,
        folder: &folder,
        stopped: &stopped,
        bars: MultiProgress::new(),
        begun: begun(&wish.scene),
        every: wish.keep.every(),
    };
    let ended = job.run_all(seeds, at_once)?;
    let over: Vec<(u64, &Ran)> = ended
        .iter()
        .filter(|(_, ran)| matches!(ran.end, End::Over))
        .map(|(seed, ran)| (*seed, ran))
        .collect();
    let mut mean = Summary::over(&over.iter().map(|(_, ran)| &ran.summary).collect::<Vec<_>>());
    let failed = ended.iter().find_map(|(seed, ran)| match &ran.end {
        End::Failed(words) => Some((seed, words)),
        _ => None,
    });
    let stopped = over.len() < seeds.len() && failed.is_none();
    mean.text("title", &checked.scene.title);
    mean.text(
        "ended",
        match (&failed, stopped) {
            (Some(_), _) => "trouble",
            (None, true) => "stopped by a signal",
            (None, false) => "over",
        },
    );
    mean.whole("runs_in_mean", over.len() as u64);
    mean.table("runs", &runs(seeds, &ended));
    mean.write(&folder)?;
    let figures = figures::draw(&folder, &over, &mean, &command_line())?;
    let wall = start.elapsed().as_secs_f64();
    mean.plain("wall_time_of_all", wall, "s").write(&folder)?;
    if let Some((seed, words)) = failed {
        return Err(Trouble::Physics(format!(
            "seed {seed}: {words}\nnote: {} of {} runs came to their end; their means are in {}",
            over.len(),
            seeds.len(),
            folder.root().display()
        )));
    }
    if stopped {
        tell!(
            "stopped by a signal; {} of {} runs came to their end; their means are in {}",
            over.len(),
            seeds.len(),
            folder.root().display()
        );
        return Ok(130);
    }
    let result = format!("Mean of {} seeds: {}", over.len(), ending::result(&mean));
    let pictures = Pictures {
        film: None,
        figures,
    };
    let lambda = plan.constants.lambda;
    let scene = &wish.scene.scene;
    say!(
        "{}",
        ending::words(
            &result,
            &mean,
            wall,
            lambda,
            folder.root(),
            &pictures,
            scene
        )
    );
    Ok(0)
}

/// The folder of every seed, and how its run ended.
fn runs(seeds: &[u64], ended: &[(u64, Ran)]) -> Vec<(String, String)> {
    let how = |seed: &u64| match ended.iter().find(|(of, _)| of == seed) {
        None => "not started",
        Some((_, ran)) => match ran.end {
            End::Over => "over",
            End::Failed(_) => "failed",
            End::Stopped { .. } => "stopped by a signal",
        },
    };
    seeds
        .iter()
        .map(|seed| (format!("seed-{seed}"), how(seed).to_owned()))
        .collect()
}
