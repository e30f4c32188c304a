//! `cargo xtask validate`: suites of checks, each against numbers from outside the code.
//!
//! A suite is one row of [`SUITES`] and one module with a function that fills a [`Report`].

mod bedload;
mod check;
mod coarsen;
pub mod collision;
mod cross;
mod hertz;
pub mod kept;
pub mod lab;
mod report;
mod repose;
pub mod scenes;
mod screw;
pub mod sdf;
pub mod stability;
pub mod wca;

use report::Report;
use std::path::Path;

/// A suite.
struct Suite {
    name: &'static str,
    /// What it holds against what.
    about: &'static str,
    /// Grain-steps of the long version, stated before it starts.
    full_grain_steps: f64,
    /// Grain-steps per second that its estimate assumes, on two cores.
    speed: f64,
    run: fn(&mut Report) -> Result<(), String>,
}

/// Every suite, in the order in which they run.
const SUITES: &[Suite] = &[
    Suite {
        name: "collision",
        about: "two grains, a wall, a row: restitution, order, limits, energy, bits",
        full_grain_steps: collision::FULL_GRAIN_STEPS,
        speed: FEW_GRAINS,
        run: collision::run,
    },
    Suite {
        name: "stability",
        about: "where each scheme fails: wall, pair, columns and packings at 1.02 and 0.98 of the limit, the guard",
        full_grain_steps: stability::FULL_GRAIN_STEPS,
        speed: FEW_GRAINS,
        run: stability::run,
    },
    Suite {
        name: "coarsen",
        about: "what coarse-graining keeps and what it does not",
        full_grain_steps: coarsen::FULL_GRAIN_STEPS,
        speed: FEW_GRAINS,
        run: coarsen::run,
    },
    Suite {
        name: "repose",
        about: "paper A's heap: coarse levels, damping, stiffness",
        full_grain_steps: repose::FULL_GRAIN_STEPS,
        speed: MANY_GRAINS,
        run: repose::run,
    },
    Suite {
        name: "sdf",
        about: "surfaces: distances of grids and meshes, rebounds, sliding, rest, grazing",
        full_grain_steps: sdf::FULL_GRAIN_STEPS,
        speed: ONE_GRAIN_ON_A_MESH,
        run: sdf::run,
    },
    Suite {
        name: "screw",
        about: "paper A's screw feeder: a plug, the rate against theory, speeds, stiffness, kinds of screw",
        full_grain_steps: screw::FULL_GRAIN_STEPS,
        speed: MANY_GRAINS,
        run: screw::run,
    },
    Suite {
        name: "bedload",
        about: "paper B's law and water: collisions, rolling, thresholds, transport of a movable bed",
        full_grain_steps: bedload::FULL_GRAIN_STEPS,
        speed: SMALL_BEDS,
        run: bedload::run,
    },
    Suite {
        name: "hertz",
        about: "law Hertz–Mindlin: Hertz, restitution, eight published impacts, grazing, rolling, piles of three",
        full_grain_steps: hertz::FULL_GRAIN_STEPS,
        speed: SINGLE_CONTACTS,
        run: hertz::run,
    },
    Suite {
        name: "cross",
        about: "the same scenes in LAMMPS and LIGGGHTS: forces, collisions, settling, pressure, a screw",
        full_grain_steps: cross::FULL_GRAIN_STEPS,
        speed: OTHER_ENGINES,
        run: cross::run,
    },
];

/// What other engines reach.
const OTHER_ENGINES: f64 = 3.0e6;
/// Many suites step a handful of grains at a time, where the cost is that of the step and not of the grain.
const FEW_GRAINS: f64 = 1.5e7;
/// One or two grains that turn, looked at after every step.
const SINGLE_CONTACTS: f64 = 2.0e6;
/// One grain on a mesh, where most of the time goes into making grids.
const ONE_GRAIN_ON_A_MESH: f64 = 1.0e5;
/// Beds of some hundred grains that turn, two side by side.
const SMALL_BEDS: f64 = 1.2e7;
/// Heaps, two side by side.
const MANY_GRAINS: f64 = 4.0e7;

/// Runs the named suites, or all; true if every check held.
pub fn run(root: &Path, names: &[String], full: bool) -> Result<bool, String> {
    let chosen = choose(names)?;
    if full {
        let planned: f64 = chosen.iter().map(|s| s.full_grain_steps).sum();
        let hours: f64 = chosen
            .iter()
            .map(|s| s.full_grain_steps / s.speed)
            .sum::<f64>()
            / 3600.0;
        eprintln!("planned: {planned:.1e} grain-steps, about {hours:.2} h on two cores");
    }
    let mut held = true;
    for suite in chosen {
        println!("{} – {}", suite.name, suite.about);
        let mut report = Report::new(suite.name, root, full);
        (suite.run)(&mut report)?;
        held &= report.finish()?;
    }
    Ok(held)
}

fn choose(names: &[String]) -> Result<Vec<&'static Suite>, String> {
    if names.is_empty() {
        return Ok(SUITES.iter().collect());
    }
    let find = |name: &String| {
        SUITES.iter().find(|s| s.name == name).ok_or_else(|| {
            let all: Vec<String> = SUITES
                .iter()
                .map(|s| format!("  {:<10} {}", s.name, s.about))
                .collect();
            format!(
                "there is no suite `{name}`; the suites are\n{}",
                all.join("\n")
            )
        })
    };
    names.iter().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_means_every_suite_and_an_unknown_one_lists_them() {
        assert_eq!(choose(&[]).map(|s| s.len()), Ok(SUITES.len()));
        let message = choose(&["colision".into()]).err().unwrap_or_default();
        assert!(SUITES.iter().all(|s| message.contains(s.name)), "{message}");
    }
}
