//! What the walls cost in the shipped feeder: told, not checked, since a clock is no test.

use super::runs::{Case, Kind};
use crate::validate::report::Report;
use crate::validate::scenes::build_on_one_thread;
use std::path::Path;
use std::time::Instant;
use tsubu_assemble::Simulation;
use tsubu_scene::Source;

/// Rounds in which all ways take their turn, and steps of a turn: 5 ms, in which hardly a grain moves by a tenth of its size.
const ROUNDS: usize = 7;
const STEPS: u64 = 500;

/// Out of every grain's sight: a wall that is never asked.
/// On the axis, so that turning moves it no faster than grains.
const AWAY: &str = "Ball(centre: (\"-90 m\", \"0 m\", \"0 m\"), radius: \"1 mm\")";

/// One way to say the walls, and the ns that a grain-step takes with it.
pub struct Way {
    /// As a table calls it.
    pub name: String,
    run: Box<dyn Simulation>,
    /// The best of its turns.
    pub cost: f64,
}

impl Way {
    /// A case in full flow on one thread, with these shapes of walls instead of its own.
    pub fn in_flow(
        case: &Case,
        root: &Path,
        print: u64,
        name: &str,
        shapes: &[(&str, &str)],
    ) -> Result<Self, String> {
        let sets: Vec<String> = shapes
            .iter()
            .map(|(wall, shape)| format!("walls.{wall}.shape={shape}"))
            .collect();
        Self::of(name, &case.in_flow(root, print, &sets)?)
    }

    /// Any scene on one thread.
    pub fn of(name: &str, source: &Source) -> Result<Self, String> {
        let mut run = build_on_one_thread(source)?.simulation;
        run.look();
        run.advance(STEPS);
        Ok(Self {
            name: name.to_owned(),
            run,
            cost: f64::INFINITY,
        })
    }
}

/// Times them in turns.
pub fn take_turns(ways: &mut [Way]) {
    for _ in 0..ROUNDS {
        for way in &mut *ways {
            let grains = way.run.grains() as f64;
            let start = Instant::now();
            way.run.advance(STEPS);
            let cost = start.elapsed().as_secs_f64() * 1e9 / (grains * STEPS as f64);
            way.cost = way.cost.min(cost);
        }
    }
}

/// The feeder at n = 3 and 60 r/min in full flow, with the screw said in three ways and without any wall.
pub fn run(report: &mut Report, root: &Path, print: u64) -> Result<(), String> {
    let case = Case::of(3, 60.0);
    let with = |name, shapes: &[(&str, &str)]| Way::in_flow(&case, root, print, name, shapes);
    let [triangles, formula] = [Kind::Triangles, Kind::Analytic].map(Kind::shape);
    let no_walls = ["screw", "casing", "hopper"].map(|wall| (wall, AWAY));
    let mut ways = [
        with("a grid of distances (2 mm)", &[])?,
        with("triangles", &[("screw", triangles.as_str())])?,
        with("formula", &[("screw", formula.as_str())])?,
        with("no screw", &no_walls[..1])?,
        with("no walls", &no_walls)?,
    ];
    take_turns(&mut ways);
    let [.., no_screw, none] = &ways;
    let (no_screw, none) = (no_screw.cost, none.cost);
    for way in &ways {
        report.tell(
            format!("n = 3, 60 r/min, screw as {}: ns per grain-step", way.name),
            way.cost,
            "one thread, the best of seven turns; compare rows",
        );
    }
    for way in &ways[..3] {
        report.tell(
            format!(
                "n = 3, screw as {}: share of a step spent on bodies",
                way.name
            ),
            1.0 - none / way.cost,
            "against the same grains with the walls out of sight; asked of the grid: at most 0.25",
        );
        report.tell(
            format!(
                "n = 3, screw as {}: share of a step spent on the screw",
                way.name
            ),
            1.0 - no_screw / way.cost,
            "",
        );
    }
    Ok(())
}
