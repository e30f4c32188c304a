//! The command line.

use crate::seeds::Seeds;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;
use tsubu::engine::Lanes;

/// Granular physics for machines and rivers.
#[derive(Debug, Parser)]
#[command(
    name = "tsubu",
    version,
    arg_required_else_help = true,
    after_help = "Try:  tsubu run scenarios/angle_of_repose.ron --set grains.coarse=3\n\nExit codes: 0 done, 2 the scene or the arguments are wrong, 3 the physics failed, 4 the machine failed, 130 stopped by a signal, checkpoint written."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene and write its results, figures and an animation into a folder
    #[command(
        after_help = "Example:  tsubu run scenarios/angle_of_repose.ron --set grains.coarse=3 --until \"2 s\""
    )]
    Run(RunWish),
    /// Go on with a run that was stopped or killed, from its newest whole checkpoint, to the bits of one never stopped
    #[command(after_help = "Example:  tsubu resume out/angle_of_repose --until \"2 s\"")]
    Resume(ResumeWish),
    /// Say what a scene models and what not, its step against the limits, and what it will cost
    #[command(
        after_help = "Example:  tsubu check scenarios/angle_of_repose.ron --set grains.coarse=1"
    )]
    Check(CheckWish),
    /// Find the cheapest settings that keep a quantity within a tolerance of a converged run of the scene
    #[command(
        after_help = "Example:  tsubu tune scenarios/movable_bed.ron --quantity transport --tolerance 20%"
    )]
    Tune(TuneWish),
    /// Look at an STL or OBJ file: what is wrong with it, what a scene can make of it, which cell suits it
    #[command(after_help = "Example:  tsubu mesh scenarios/meshes/screw.stl")]
    Mesh(MeshWish),
    /// Write a scene as a deck of another engine: for a cluster, or for a second opinion
    #[command(
        after_help = "Example:  tsubu export lammps benches/scenes/repulsion.ron --out deck\n\nWhat the engine cannot say is refused at its field (exit code 2), never dropped."
    )]
    Export(ExportWish),
    /// Measure, draw and film the frames of another engine's text dump as if the scene had run here
    #[command(
        after_help = "Example:  tsubu import deck/frames.dump --scene benches/scenes/repulsion.ron --out out/from_lammps"
    )]
    Import(ImportWish),
    /// List the shipped scenes
    Scenes,
    /// Copy a shipped scene here, to edit
    Init {
        /// Name of the scene (see `tsubu scenes`)
        name: String,
    },
}

/// Which scene, with which changes.
#[derive(Debug, Args)]
pub struct SceneWish {
    /// The scene file
    pub scene: PathBuf,
    /// Change a field of the scene, as grains.coarse=3 or walls.floor.friction=0.2; may be given many times
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// End of the run, as "2 s"; short for --set time.until=…
    #[arg(long, value_name = "TIME")]
    pub until: Option<String>,
    /// On what.
    #[command(flatten)]
    pub machine: MachineWish,
    /// Run even if the step is over its limit
    #[arg(long)]
    pub allow_unstable: bool,
}

/// What the machine is to do, which changes no bit of the result.
#[derive(Clone, Copy, Debug, Args)]
pub struct MachineWish {
    /// Threads [default: as many as pay for the number of grains]; changes no bit of the result
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Vector instructions; changes no bit of the result
    #[arg(long, value_parser = lanes, default_value = "auto", value_name = "auto|portable|avx2|avx512")]
    pub lanes: LanesWish,
}

/// How often a run writes a checkpoint.
#[derive(Clone, Copy, Debug, Args)]
pub struct KeepWish {
    /// Minutes of wall time between two checkpoints, or `never`; changes no bit of the result
    #[arg(long, value_parser = minutes, default_value = "10", value_name = "MINUTES|never")]
    pub checkpoint_every: MinutesWish,
}

impl KeepWish {
    /// The time between two; `None` for none at all.
    pub fn every(&self) -> Option<Duration> {
        self.checkpoint_every.0
    }
}

/// A time, or never.
#[derive(Clone, Copy, Debug)]
pub struct MinutesWish(Option<Duration>);

fn minutes(text: &str) -> Result<MinutesWish, String> {
    if text == "never" {
        return Ok(MinutesWish(None));
    }
    let minutes = text.trim().parse::<f64>().ok().filter(|m| *m >= 0.0);
    minutes
        .and_then(|m| Duration::try_from_secs_f64(60.0 * m).ok())
        .map(|every| MinutesWish(Some(every)))
        .ok_or_else(|| "expected a number of minutes, as 10 or 0.5, or never".to_owned())
}

/// `tsubu run`.
#[derive(Debug, Args)]
pub struct RunWish {
    /// Which scene.
    #[command(flatten)]
    pub scene: SceneWish,
    /// Folder for the results [default: out/<scene>, or the next free out/<scene>-2]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Overwrite an earlier run in that folder
    #[arg(long)]
    pub force: bool,
    /// Run the scene with several seeds, as 4 (seeds 1 to 4), 1,2,7 or 3..6, and give means with their standard errors; --threads then counts the threads of all runs together
    #[arg(long, value_parser = Seeds::read, value_name = "N|LIST|FROM..TO")]
    pub seeds: Option<Seeds>,
    /// Checkpoints.
    #[command(flatten)]
    pub keep: KeepWish,
}

/// `tsubu resume`.
#[derive(Debug, Args)]
pub struct ResumeWish {
    /// The folder of the run
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Another end of the run, as "2 s"
    #[arg(long, value_name = "TIME")]
    pub until: Option<String>,
    /// On what.
    #[command(flatten)]
    pub machine: MachineWish,
    /// Checkpoints.
    #[command(flatten)]
    pub keep: KeepWish,
}

/// `tsubu export`.
#[derive(Debug, Args)]
pub struct ExportWish {
    /// For which engine
    #[arg(value_enum)]
    pub target: TargetWish,
    /// Which scene.
    #[command(flatten)]
    pub scene: SceneWish,
    /// Folder for the deck [default: out/<scene>-<engine>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Overwrite an earlier deck in that folder
    #[arg(long)]
    pub force: bool,
}

/// An engine that a scene can be written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TargetWish {
    /// Any number of processes; law Repulsion with bodies of grains, law SpringDashpot with planes
    Lammps,
    /// Any number of processes; law SpringDashpot with STL meshes that move
    Liggghts,
}

/// `tsubu import`.
#[derive(Debug, Args)]
pub struct ImportWish {
    /// The dump: text with id, x, y, z and, for all that moves, vx, vy, vz
    pub dump: PathBuf,
    /// The scene that was exported
    #[arg(long, value_name = "SCENE")]
    pub scene: PathBuf,
    /// Change a field of the scene, as it was changed for the export; may be given many times
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Step at which the grains were still [default: read from released.txt beside the dump]
    #[arg(long, value_name = "STEP")]
    pub released: Option<u64>,
    /// Folder for the results [default: out/<scene>, or the next free out/<scene>-2]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Overwrite an earlier run in that folder
    #[arg(long)]
    pub force: bool,
}

/// `tsubu check`.
#[derive(Debug, Args)]
pub struct CheckWish {
    /// Which scene.
    #[command(flatten)]
    pub scene: SceneWish,
}

/// `tsubu tune`.
#[derive(Debug, Args)]
pub struct TuneWish {
    /// Which scene.
    #[command(flatten)]
    pub scene: SceneWish,
    /// What is to stay, as a run's summary names it: mass_rate, angle_of_repose, transport, …
    #[arg(long, value_name = "NAME")]
    pub quantity: String,
    /// How far it may be off, as 5% or 0.05
    #[arg(long, value_parser = tolerance, value_name = "P")]
    pub tolerance: ToleranceWish,
    /// The most that a run of the reference may cost, in runs of the scene
    #[arg(long, default_value_t = 12.0, value_name = "TIMES")]
    pub reference_cost: f64,
    /// Folder for the pilots and the result [default: out/<scene>-tune]; a tuning that was stopped goes on there
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// A tolerance as a share.
#[derive(Clone, Copy, Debug)]
pub struct ToleranceWish(pub f64);

fn tolerance(text: &str) -> Result<ToleranceWish, String> {
    let (number, unit) = match text.strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        Ok(share) if share * unit > 0.0 && share * unit <= 1.0 => Ok(ToleranceWish(share * unit)),
        _ => Err("expected a share above 0 % and at most 100 %, as 5% or 0.05".to_owned()),
    }
}

/// `tsubu mesh`.
#[derive(Debug, Args)]
pub struct MeshWish {
    /// The file, .stl or .obj
    pub file: PathBuf,
    /// Unit of its coordinates
    #[arg(long, value_parser = unit, default_value = "mm", value_name = "m|cm|mm|inch")]
    pub unit: UnitWish,
}

/// Metres per unit of a mesh's coordinates.
#[derive(Clone, Copy, Debug)]
pub struct UnitWish(pub f64);

fn unit(text: &str) -> Result<UnitWish, String> {
    match text {
        "m" => Ok(UnitWish(1.0)),
        "cm" => Ok(UnitWish(0.01)),
        "mm" => Ok(UnitWish(0.001)),
        "inch" => Ok(UnitWish(0.0254)),
        _ => Err("expected m, cm, mm or inch".to_owned()),
    }
}

/// A vector path, or the widest.
#[derive(Clone, Copy, Debug)]
pub struct LanesWish(pub Option<Lanes>);

fn lanes(text: &str) -> Result<LanesWish, String> {
    if text == "auto" {
        return Ok(LanesWish(None));
    }
    let lanes = Lanes::ALL
        .into_iter()
        .find(|l| l.name() == text)
        .ok_or("expected auto, portable, avx2 or avx512")?;
    if lanes.is_here() {
        Ok(LanesWish(Some(lanes)))
    } else {
        Err(format!(
            "this machine has no {text}; auto takes the widest it has"
        ))
    }
}
