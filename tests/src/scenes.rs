//! Scenes run through the library: read, checked, assembled, run to their end.

use std::path::{Path, PathBuf};
use tsubu::assemble::{Choices, Simulation, build};
use tsubu::scene::{Checked, SceneError, Source};

/// The root of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The scenes of a folder of the repository, in order.
pub fn scene_files(folder: &str) -> Vec<PathBuf> {
    let folder = repository().join(folder);
    let entries =
        std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "ron"));
    paths.sort();
    paths
}

/// The path of a scene that runs, as the command takes it.
pub fn good_scene(name: &str) -> String {
    let path = repository().join("tests/scenes/good").join(name);
    path.display().to_string()
}

/// The checked scene of a text with changes laid over it; a wrong one fails the test.
pub fn check(text: &str, changes: &[&str]) -> Checked {
    let mut source = Source::from_text("test.ron", text);
    let set = changes.iter().try_for_each(|change| source.set(change));
    set.and_then(|()| source.check())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The assembled simulation of a text with changes, on one thread.
pub fn assemble(text: &str, changes: &[&str]) -> Box<dyn Simulation> {
    let choices = Choices {
        threads: Some(1),
        ..Choices::default()
    };
    built(&check(text, changes), &choices).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn built(checked: &Checked, choices: &Choices) -> Result<Box<dyn Simulation>, SceneError> {
    Ok(build(checked, choices)?.simulation)
}

/// Runs to the end, whatever that is.
pub fn run_out(run: &mut dyn Simulation) {
    while !run.is_over() {
        run.advance(u64::MAX);
    }
}

/// The bits of every coordinate and velocity, in order of identity.
pub type Bits = Vec<[u64; 6]>;

/// The state of a simulation to the bit.
pub fn bits(run: &dyn Simulation) -> Bits {
    let six =
        |(x, v): &(glam::DVec3, glam::DVec3)| [x.x, x.y, x.z, v.x, v.y, v.z].map(f64::to_bits);
    run.state().iter().map(six).collect()
}
