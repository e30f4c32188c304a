//! `tsubu export`: a scene as a deck of LAMMPS or LIGGGHTS, for clusters and for a second opinion.
//!
//! The constants are those that run here, softened and coarsened; the grains stand where a run here would place them.
//! What the other engine cannot say is refused at its field; what it says a little otherwise is listed in
//! [`Deck::differs`].

mod lammps;
mod liggghts;
mod ready;
mod timeline;

use ready::Ready;
use tsubu_assemble::{Choices, Plan};
use tsubu_scene::{Checked, SceneError};

/// An engine that a scene can be written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// LAMMPS of 2023 or newer, with its packages DPD-BASIC and GRANULAR.
    Lammps,
    /// LIGGGHTS-PUBLIC 3.8.
    Liggghts,
}

impl Target {
    /// All of them.
    pub const ALL: [Target; 2] = [Target::Lammps, Target::Liggghts];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Target::Lammps => "lammps",
            Target::Liggghts => "liggghts",
        }
    }

    /// Its name in a sentence.
    pub fn title(self) -> &'static str {
        match self {
            Target::Lammps => "LAMMPS",
            Target::Liggghts => "LIGGGHTS",
        }
    }

    /// Its program.
    pub fn program(self) -> &'static str {
        match self {
            Target::Lammps => "lmp",
            Target::Liggghts => "liggghts",
        }
    }
}

/// The name of the input file in a deck.
pub const INPUT: &str = "deck.in";
/// The name of the file in which the grains stand.
pub const DATA: &str = "grains.data";
/// The name of the dump that a deck leaves.
pub const DUMP: &str = "frames.dump";
/// The name of the file in which a deck leaves the step at which the grains were still.
pub const RELEASED: &str = "released.txt";

/// The files of a scene for another engine.
#[derive(Clone, Debug)]
pub struct Deck {
    /// For which engine.
    pub target: Target,
    /// Names and contents; [`INPUT`] is the one to run.
    pub files: Vec<(String, String)>,
    /// What the other engine does a little otherwise, a sentence each.
    pub differs: Vec<String>,
    /// Number of grains, without those of walls.
    pub grains: usize,
    /// Number of wall grains.
    pub wall_grains: usize,
}

/// Writes a scene for another engine; `frames` gives the number of steps between two frames of its dump, if it is to leave one.
///
/// ```
/// use tsubu::export::{Target, deck};
/// let text = r#"(
///     title: "Two grains meet",
///     gravity: "0 m/s2",
///     grains: (
///         diameter: "1.35 mm", density: "1370 kg/m3",
///         law: Repulsion(stiffness: YoungModulus("3.096 GPa"), damping: Equal("0.1257 kg/s")),
///     ),
///     initial: (grains: [
///         (at: ("0 mm", "0 mm", "0 mm"), velocity: ("1 m/s", "0 m/s", "0 m/s")),
///         (at: ("1.4 mm", "0 mm", "0 mm")),
///     ]),
///     time: (step: PerPeriod(200), until: "0.2 ms"),
/// )"#;
/// let scene = tsubu::scene::Source::from_text("two.ron", text).check()?;
/// let deck = deck(Target::Lammps, &scene, &Default::default(), &|_| Some(10))?;
/// assert!(deck.files[0].1.contains("pair_coeff 1 1 dpd/ext/tstat 0.1257 0.1257 0 0"));
/// # Ok::<(), tsubu::scene::SceneError>(())
/// ```
pub fn deck(
    target: Target,
    checked: &Checked,
    choices: &Choices,
    frames: &dyn Fn(&Plan) -> Option<u64>,
) -> Result<Deck, SceneError> {
    let ready = Ready::of(target, checked, choices, frames)?;
    match target {
        Target::Lammps => lammps::deck(&ready),
        Target::Liggghts => liggghts::deck(&ready),
    }
}

impl Deck {
    /// The line that runs the deck, in its folder, on so many processes.
    pub fn run_line(&self, processes: usize) -> String {
        format!(
            "mpiexec -n {processes} {} -in {INPUT}",
            self.target.program()
        )
    }

    /// A shell script that runs it.
    pub fn script(&self) -> String {
        format!(
            "#!/bin/sh\n# On 4 processes:  sh run.sh 4\ncd \"$(dirname \"$0\")\" || exit 1\nexec mpiexec -n \"${{1:-1}}\" {} -in {INPUT}\n",
            self.target.program()
        )
    }

    /// What the folder holds, for who finds it. `scene` is the file of the scene beside the deck.
    pub fn readme(&self, title: &str, scene: &str) -> String {
        let differs: String = if self.differs.is_empty() {
            "- nothing that the deck does not say\n".to_owned()
        } else {
            self.differs.iter().map(|d| format!("- {d}\n")).collect()
        };
        format!(
            "# {title}\n\n\
             A scene of tsubu as a deck of {}, written by `tsubu export {}`: {} grains{}.\n\n\
             Run it here:\n\n    {}\n\n\
             Read its frames back:\n\n    tsubu import {DUMP} --scene {scene} --out DIR\n\n\
             Variables that a run may set with `-var NAME VALUE`: `skin` (m), `steps`, `every` (steps between frames), `digits`.\n\n\
             What {} does a little otherwise than tsubu:\n\n{differs}",
            self.target.title(),
            self.target.name(),
            self.grains,
            match self.wall_grains {
                0 => String::new(),
                n => format!(" and {n} wall grains"),
            },
            self.run_line(2),
            self.target.title(),
        )
    }
}
