//! `tsubu run`: from a scene file to a folder of results.

use crate::arguments::{RunWish, SceneWish};
use crate::clock::Clock;
use crate::ending::{self, Pictures, Spent};
use crate::figures;
use crate::film::{self, Film};
use crate::progress::Progress;
use crate::rows::Rows;
use crate::seeds;
use crate::trouble::Trouble;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tsubu::assemble::{Built, Choices, Stop, Watch, build};
use tsubu::model::Curve;
use tsubu::record::{FrameWriter, RunFolder, Summary, write_whole};
use tsubu::scene::{Checked, Source};

/// Steps between two looks at the clock and at signals: short enough to stop at once, long enough not to matter.
const GLANCE: u64 = 64;

/// Reads a scene with its changes, and checks it.
pub fn read(wish: &SceneWish) -> Result<Checked, Trouble> {
    Ok(read_source(wish)?.check()?)
}

/// Reads a scene with its changes.
pub fn read_source(wish: &SceneWish) -> Result<Source, Trouble> {
    let mut source = Source::read(&wish.scene)?;
    for set in &wish.set {
        source.set(set)?;
    }
    if let Some(until) = &wish.until {
        source.set(&format!("time.until={until}"))?;
    }
    Ok(source)
}

/// A flag that Ctrl-C or SIGTERM raises; a second one ends the program at once.
pub fn until_signal() -> Arc<AtomicBool> {
    let stopped = Arc::new(AtomicBool::new(false));
    let flag = stopped.clone();
    // Without a handler a signal just ends the program; the run itself does not need it.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
    });
    stopped
}

/// The machine's side of a wish. Grids of distances are kept beside the runs, so that the next one starts at once.
pub fn choices(wish: &SceneWish, out: Option<&Path>) -> Choices {
    let beside = out.and_then(Path::parent).unwrap_or(Path::new("out"));
    let said: Mutex<(String, u32)> = Mutex::default();
    let watch = move |wall: &str, share: f64| {
        let quarter = (4.0 * share) as u32;
        let Ok(mut said) = said.lock() else { return };
        if said.0 != wall {
            *said = (wall.to_owned(), 0);
            tell!("building the grid of distances of `{wall}` …");
        }
        if quarter > said.1 {
            said.1 = quarter;
            tell!("  {:3} %", 25 * quarter);
        }
    };
    Choices {
        threads: wish.threads.map(usize::from),
        lanes: wish.lanes.0,
        allow_unstable: wish.allow_unstable,
        grids: Some(beside.join("grids")),
        watch: Some(Watch(Arc::new(watch))),
    }
}

/// `tsubu run`.
pub fn run(wish: &RunWish) -> Result<u8, Trouble> {
    let start = Instant::now();
    let checked = read(&wish.scene)?;
    if let Some(seeds) = &wish.seeds {
        return seeds::run(wish, seeds, &checked);
    }
    let built = build(&checked, &choices(&wish.scene, wish.out.as_deref()))?;
    let folder = RunFolder::create(wish.out.as_deref(), &stem(&wish.scene), wish.force)?;
    tell!(
        "{}: {} grains, step {:.3e} s, {} thread(s), into {}",
        checked.scene.title,
        built.plan.grains,
        built.plan.constants.dt,
        built.plan.threads,
        folder.root().display()
    );
    let lambda = built.plan.constants.lambda;
    let progress = Progress::new();
    let ran = one(&checked, built, &folder, &until_signal(), progress, start)?;
    match ran.end {
        End::Over => {
            say!(
                "{}",
                ending::words(
                    &ending::result(&ran.summary),
                    &ran.summary,
                    start.elapsed().as_secs_f64(),
                    lambda,
                    folder.root(),
                    &ran.pictures,
                    &wish.scene.scene
                )
            );
            Ok(0)
        }
        End::Failed(words) => Err(Trouble::Physics(format!(
            "{words}\nnote: what was computed until then is in {}",
            folder.root().display()
        ))),
        End::Stopped { time } => {
            tell!(
                "stopped by a signal at t = {time:.6} s; what was computed is in {}",
                folder.root().display()
            );
            Ok(130)
        }
    }
}

/// The name of the scene's file, without its ending.
pub fn stem(wish: &SceneWish) -> String {
    wish.scene
        .file_stem()
        .map_or("scene".into(), |s| s.to_string_lossy().into_owned())
}

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

/// Runs a scene into a folder, to its end or until it is stopped.
pub fn one(
    checked: &Checked,
    built: Built,
    folder: &RunFolder,
    stopped: &AtomicBool,
    mut progress: Progress,
    start: Instant,
) -> Result<Ran, Trouble> {
    let (mut run, plan) = (built.simulation, built.plan);
    write_whole(
        &folder.path("scene.resolved.ron"),
        checked.scene.to_resolved_ron().as_bytes(),
    )?;
    folder.make("figures")?;
    let output = checked.scene.output;
    let clock = Clock::of(&output, &plan);
    let mut rows = Rows::start(folder, &mut *run)?;
    let mut frames = output
        .frames
        .then(|| FrameWriter::new(folder))
        .transpose()?;
    let mut film = output.animation.then(Film::new);
    let mut stepping = Duration::ZERO;
    let mut last = (0, 0);
    let mut shoot = |run: &dyn tsubu::assemble::Simulation| -> Result<(), Trouble> {
        if frames.is_none() && film.is_none() {
            return Ok(());
        }
        let snapshot = run.snapshot();
        if let Some(frames) = &mut frames {
            film::write_frame(frames, &snapshot, &run.machines())?;
        }
        if let Some(film) = &mut film {
            film.add(run, &snapshot);
        }
        Ok(())
    };
    shoot(&*run)?;
    while !run.is_over() && !stopped.load(Ordering::SeqCst) {
        let mut due = clock.to_next(run.steps());
        while due > 0 && !run.is_over() && !stopped.load(Ordering::SeqCst) {
            let glance = Instant::now();
            due -= run.advance(due.min(GLANCE)).min(due);
            stepping += glance.elapsed();
            progress.show(&*run, stepping);
        }
        let now = run.steps();
        if now % clock.row == 0 || run.is_over() {
            rows.add(&mut *run)?;
            last.0 = now;
        }
        if now % clock.frame == 0 || run.is_over() {
            shoot(&*run)?;
            last.1 = now;
        }
    }
    // A run that a signal stopped still ends with a row and a frame of its last moment.
    if last.0 != run.steps() {
        rows.add(&mut *run)?;
    }
    if last.1 != run.steps() {
        shoot(&*run)?;
    }
    let stop = run.stop();
    let ended = match &stop {
        Some(Stop::Over) => "over",
        Some(Stop::NeverStill { .. }) => "never still",
        Some(Stop::NoBed { .. }) => "no bed",
        Some(Stop::UnstablePacking { .. }) => "unstable step",
        Some(Stop::Trouble(_)) => "trouble",
        None => "stopped by a signal",
    };
    let summarise = |rows: &Rows| {
        let wall = start.elapsed();
        let spent = Spent { wall, stepping };
        ending::summary(folder, &checked.scene, &plan, &*run, rows, spent, ended)
    };
    // Before the pictures, which may fail, and again with the time that they took.
    summarise(&rows)?;
    progress.say("drawing");
    let film = film
        .as_ref()
        .map(|f| f.draw(folder, run.released_at()))
        .transpose()?
        .flatten()
        .map(|drawn| drawn.0);
    let figures = figures::draw(folder, &*run, &rows, &command_line())?;
    progress.finish();
    let summary = summarise(&rows)?;
    rows.finish()?;
    Ok(Ran {
        end: match stop {
            Some(Stop::Over) => End::Over,
            Some(stop) => End::Failed(ending::failure(&stop, &plan)),
            None => End::Stopped { time: run.time() },
        },
        summary,
        curves: run.curves(),
        pictures: Pictures { film, figures },
    })
}

/// The command as it was typed, for the captions of figures.
pub fn command_line() -> String {
    let mut words: Vec<String> = std::env::args().collect();
    if let Some(first) = words.first_mut() {
        *first = "tsubu".into();
    }
    words
        .iter()
        .map(|w| {
            if w.contains(' ') {
                format!("\"{w}\"")
            } else {
                w.clone()
            }
        })
        .collect::<Vec<_>>()
        .join(" ")
}
