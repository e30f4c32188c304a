//! `tsubu run`: from a scene file to a folder of results.

use crate::arguments::{MachineWish, RunWish, SceneWish};
use crate::course::{Course, End, Place, Ran};
use crate::ending;
use crate::keep::Begun;
use crate::progress::Progress;
use crate::seeds;
use crate::trouble::Trouble;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use tsubu::assemble::{Choices, Watch, build};
use tsubu::record::RunFolder;
use tsubu::scene::{Checked, Source};

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

/// The machine's side of a wish.
pub fn choices(wish: &SceneWish, out: Option<&Path>) -> Choices {
    choices_of(&wish.machine, wish.allow_unstable, out)
}

/// The same. Grids of distances are kept beside the runs, so that the next one starts at once.
pub fn choices_of(wish: &MachineWish, allow_unstable: bool, out: Option<&Path>) -> Choices {
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
        allow_unstable,
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
    let choices = choices(&wish.scene, wish.out.as_deref());
    let built = build(&checked, &choices)?;
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
    let stopped = until_signal();
    let place = Place {
        folder: &folder,
        stopped: &stopped,
        start,
        every: wish.keep.every(),
        choices: &choices,
    };
    let ran = Course::begin(place, &checked, built, begun(&wish.scene))?.go(Progress::new())?;
    let wall = start.elapsed().as_secs_f64();
    closing(&ran, wall, lambda, &folder, &wish.scene.scene)
}

/// How a run is begun by this wish.
pub fn begun(wish: &SceneWish) -> Begun {
    Begun {
        scene_file: wish.scene.clone(),
        command: command_line(),
        allow_unstable: wish.allow_unstable,
    }
}

/// Says how a run ended that took `wall` seconds, and gives the exit code.
pub fn closing(
    ran: &Ran,
    wall: f64,
    lambda: f64,
    folder: &RunFolder,
    scene: &Path,
) -> Result<u8, Trouble> {
    let root = folder.root();
    match &ran.end {
        End::Over => {
            let (summary, pictures) = (&ran.summary, &ran.pictures);
            let result = ending::result(summary);
            say!(
                "{}",
                ending::words(&result, summary, wall, lambda, root, pictures, scene)
            );
            Ok(0)
        }
        End::Failed(words) => Err(Trouble::Physics(format!(
            "{words}\nnote: what was computed until then is in {}",
            root.display()
        ))),
        End::Stopped { time, kept } => {
            tell!(
                "stopped by a signal at t = {time:.6} s; what was computed is in {}",
                root.display()
            );
            if kept.is_some() {
                tell!("go on with:  tsubu resume {}", root.display());
            }
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
