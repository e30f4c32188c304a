//! Shipped scenes with changes, as suites run them: side by side on one thread each, finished runs kept.

use std::fmt::Write as _;
use std::path::Path;
use tsubu_assemble::{Built, Choices, Simulation, build};
use tsubu_scene::Source;

/// A scene with these changes.
pub fn changed(scene: &Path, sets: &[String]) -> Result<Source, String> {
    let mut source = Source::read(scene).map_err(|e| e.to_string())?;
    for set in sets {
        source.set(set).map_err(|e| e.to_string())?;
    }
    Ok(source)
}

/// Changes that start a scene of paper A's coke from places on file. Listed grains are not coarsened,
/// so the coarse grain is named outright: under the renormalisation it is a grain of the same material.
/// `gamma` is the damping at n = 0 in kg/s.
pub fn from_places(coarse: u32, gamma: f64, file: &Path) -> [String; 4] {
    let lambda = f64::from(1u32 << coarse);
    let damping = format!(
        "grains.law.damping=Equal(\"{} kg/s\")",
        gamma * lambda * lambda
    );
    let [level, diameter, places] = listed(coarse, file);
    [level, diameter, damping, places]
}

/// The same without the law.
pub fn listed(coarse: u32, file: &Path) -> [String; 3] {
    let lambda = f64::from(1u32 << coarse);
    [
        "grains.coarse=0".to_owned(),
        format!("grains.diameter={} mm", 1.350 * lambda),
        format!("initial.file={}", file.display()),
    ]
}

/// The places of all grains as a grain file.
pub fn places(run: &dyn Simulation) -> String {
    let mut text = "x,y,z\n".to_owned();
    for (x, _) in run.state() {
        let _ = writeln!(text, "{:?},{:?},{:?}", x.x, x.y, x.z);
    }
    text
}

/// One thread each; several cases run side by side.
pub fn build_on_one_thread(source: &Source) -> Result<Built, String> {
    build_on(source, 1)
}

/// A scene ready to run on so many threads.
pub fn build_on(source: &Source, threads: usize) -> Result<Built, String> {
    let choices = Choices {
        threads: Some(threads),
        ..Choices::default()
    };
    let checked = source.check().map_err(|e| e.to_string())?;
    build(&checked, &choices).map_err(|e| e.to_string())
}

/// On one thread, also where the step is over its limit.
pub fn build_anyway(source: &Source) -> Result<Built, String> {
    let choices = Choices {
        threads: Some(1),
        allow_unstable: true,
        ..Choices::default()
    };
    let checked = source.check().map_err(|e| e.to_string())?;
    build(&checked, &choices).map_err(|e| e.to_string())
}

/// Runs until the wall is gone, to within a few steps, and says when it went.
pub fn until_released(run: &mut dyn Simulation) -> Result<f64, String> {
    run.look();
    while run.released_at().is_none() && !run.is_over() {
        run.advance(50);
    }
    run.released_at()
        .ok_or_else(|| format!("the wall was never removed: {:?}", run.stop()))
}

/// Writes a file, and its folder if need be.
pub fn keep(file: &Path, text: &str) -> Result<(), String> {
    let parent = file.parent().unwrap_or(file);
    std::fs::create_dir_all(parent)
        .and_then(|()| std::fs::write(file, text))
        .map_err(|e| format!("{}: {e}", file.display()))
}
