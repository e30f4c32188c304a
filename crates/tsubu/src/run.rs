//! `tsubu run`: from a scene file to a folder of results.

use crate::arguments::{RunWish, SceneWish};
use crate::clock::Clock;
use crate::ending::{self, Spent};
use crate::figures;
use crate::film::{self, Film};
use crate::progress::Progress;
use crate::rows::Rows;
use crate::trouble::Trouble;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tsubu::assemble::{Choices, Stop, Watch, build};
use tsubu::record::{FrameWriter, RunFolder, write_whole};
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
    let built = build(&checked, &choices(&wish.scene, wish.out.as_deref()))?;
    let (mut run, plan) = (built.simulation, built.plan);
    let stem = wish
        .scene
        .scene
        .file_stem()
        .map_or("scene".into(), |s| s.to_string_lossy().into_owned());
    let folder = RunFolder::create(wish.out.as_deref(), &stem, wish.force)?;
    write_whole(
        &folder.path("scene.resolved.ron"),
        checked.scene.to_resolved_ron().as_bytes(),
    )?;
    folder.make("figures")?;
    tell!(
        "{}: {} grains, step {:.3e} s, {} thread(s), into {}",
        checked.scene.title,
        plan.grains,
        plan.constants.dt,
        plan.threads,
        folder.root().display()
    );

    let stopped = until_signal();
    let output = checked.scene.output;
    let clock = Clock::of(&output, &plan);
    let mut rows = Rows::start(&folder, &mut *run)?;
    let mut frames = output
        .frames
        .then(|| FrameWriter::new(&folder))
        .transpose()?;
    let mut film = output.animation.then(Film::new);
    let mut progress = Progress::new();
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
    let summarise = |rows: &Rows| -> Result<Spent, Trouble> {
        let wall = start.elapsed();
        let spent = Spent { wall, stepping };
        ending::summary(&folder, &checked.scene, &plan, &*run, rows, spent, ended)?;
        Ok(spent)
    };
    // Before the pictures, which may fail, and again with the time that they took.
    summarise(&rows)?;
    progress.say("drawing");
    let command = command_line();
    let drawn = film
        .as_ref()
        .map(|f| f.draw(&folder, run.released_at()))
        .transpose()?
        .flatten();
    let drawings = figures::draw(&folder, &*run, &rows, &command)?;
    progress.finish();
    let spent = summarise(&rows)?;
    rows.finish()?;
    match stop {
        Some(Stop::Over) => {
            say!(
                "{}",
                ending::words(
                    &*run,
                    &plan,
                    spent,
                    folder.root(),
                    drawn.as_ref().map(|d| &d.0),
                    &drawings,
                    &wish.scene.scene
                )
            );
            Ok(0)
        }
        Some(stop) => Err(Trouble::Physics(format!(
            "{}\nnote: what was computed until then is in {}",
            ending::failure(&stop, &plan),
            folder.root().display()
        ))),
        None => {
            tell!(
                "stopped by a signal at t = {:.6} s; what was computed is in {}",
                run.time(),
                folder.root().display()
            );
            Ok(130)
        }
    }
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
