//! The command `tsubu` as a process that faults are done to, and what it leaves behind.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Nothing tried here takes as long: what does hangs.
const HANGS: Duration = Duration::from_secs(180);

/// The command, built.
pub struct Program {
    path: PathBuf,
    /// The root of the repository.
    pub root: PathBuf,
    /// Where runs are made and thrown away; grids of distances are kept in it.
    pub yard: PathBuf,
}

/// How a process ended.
pub struct Outcome {
    /// Exit code; `None` if a signal ended it.
    pub code: Option<i32>,
    /// What it complained of.
    pub words: String,
}

impl Program {
    /// Builds the command beside this program, in the words of the tests, which have built it so already.
    pub fn build(root: &Path) -> Result<Self, String> {
        let here = std::env::current_exe().map_err(|e| e.to_string())?;
        let built = here.parent().ok_or("this program lies nowhere")?;
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut build = Command::new(cargo);
        build.args(["build", "--quiet", "--package", "tsubu", "--bin", "tsubu"]);
        build.args(["--package", "tsubu-tests", "--test", "all"]);
        if built.ends_with("release") {
            build.arg("--release");
        }
        let done = build.current_dir(root).status();
        if !done.is_ok_and(|status| status.success()) {
            return Err("the command does not build".into());
        }
        let yard = root.join("target/faults");
        fs::create_dir_all(&yard).map_err(|e| format!("{}: {e}", yard.display()))?;
        Ok(Self {
            path: built.join(format!("tsubu{}", std::env::consts::EXE_SUFFIX)),
            root: root.into(),
            yard,
        })
    }

    /// An empty folder in the yard.
    pub fn fresh(&self, name: &str) -> Result<PathBuf, String> {
        let path = self.yard.join(name);
        fs::remove_dir_all(&path).ok();
        fs::create_dir_all(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(path)
    }

    /// Starts the command with these arguments; what it complains of goes to a file.
    pub fn start(&self, arguments: &[&str]) -> Result<Running, String> {
        let mut command = Command::new(&self.path);
        command.args(arguments);
        self.spawn(command)
    }

    /// Starts it under a limit of the shell, such as `-f 100` (blocks of 512 bytes or 1 KiB).
    pub fn start_limited(&self, limit: &str, arguments: &[&str]) -> Result<Running, String> {
        let mut shell = Command::new("sh");
        // The signal that comes with a file that is too long is ignored: the write fails, as on a full disk.
        let line = format!("trap '' XFSZ; ulimit {limit}; exec \"$@\"");
        shell.args(["-c", &line, "sh"]).arg(&self.path);
        shell.args(arguments);
        self.spawn(shell)
    }

    fn spawn(&self, mut command: Command) -> Result<Running, String> {
        let words = self.yard.join("stderr.txt");
        let file = File::create(&words).map_err(|e| format!("{}: {e}", words.display()))?;
        let child = command
            .current_dir(&self.yard)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(file)
            .spawn()
            .map_err(|e| format!("the command does not start: {e}"))?;
        Ok(Running {
            child,
            words,
            since: Instant::now(),
        })
    }

    /// Runs it to its end.
    pub fn run(&self, arguments: &[&str]) -> Result<Outcome, String> {
        self.start(arguments)?.end()
    }
}

/// A process under way.
pub struct Running {
    child: Child,
    words: PathBuf,
    since: Instant,
}

impl Running {
    /// True once it has ended.
    pub fn is_over(&mut self) -> bool {
        !matches!(self.child.try_wait(), Ok(None))
    }

    /// Kills it: the system takes the process away between two of its instructions.
    pub fn kill(&mut self) {
        self.child.kill().ok();
    }

    /// Waits for its end; one that hangs is killed.
    pub fn end(mut self) -> Result<Outcome, String> {
        while !self.is_over() {
            if self.since.elapsed() > HANGS {
                self.kill();
                return Err(format!("it hangs: {} s and no end", HANGS.as_secs()));
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        let status = self.child.wait().map_err(|e| e.to_string())?;
        Ok(Outcome {
            code: status.code(),
            words: fs::read_to_string(&self.words).unwrap_or_default(),
        })
    }
}

impl Outcome {
    /// Ends with this code, these words, and, where it is a failure, exactly one message and no trace of a panic.
    pub fn is(&self, code: i32, words: &[&str]) -> Result<String, String> {
        let errors = self.words.lines().filter(|l| l.starts_with("error"));
        let wanted = usize::from(![0, 130].contains(&code));
        let missing = words.iter().find(|w| !self.words.contains(**w));
        let panics = self.words.contains("panicked") || self.words.contains("RUST_BACKTRACE");
        if self.code != Some(code) || errors.count() != wanted || missing.is_some() || panics {
            return Err(format!(
                "exit code {code} and the words {words:?} expected, got {:?}:\n{}",
                self.code,
                self.words.trim_end()
            ));
        }
        Ok(format!("exit code {code}"))
    }
}

/// The checkpoints of a run, oldest first.
pub fn checkpoints(run: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(run.join("checkpoint")).into_iter().flatten();
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    found.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("step_") && name.ends_with(".tsubu")
    });
    found.sort();
    found
}

/// What a summary says of the machine and not of the grains.
const OF_THE_MACHINE: [&str; 5] = [
    "wall_time",
    "grain_steps_per_second",
    "bytes_per_grain",
    "threads",
    "lanes",
];

/// All that a run says of its grains: series, frames, film, the measures of the summary.
pub fn left(folder: &Path) -> Result<BTreeMap<String, Vec<u8>>, String> {
    let mut found = BTreeMap::new();
    let mut read = |name: String| -> Result<(), String> {
        let path = folder.join(&name);
        let bytes = fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        found.insert(name, bytes);
        Ok(())
    };
    for name in ["series.csv", "frames.pvd", "summary.json"] {
        read(name.into())?;
    }
    if folder.join("animation.gif").exists() {
        read("animation.gif".into())?;
    }
    let frames = fs::read_dir(folder.join("frames")).map_err(|e| e.to_string())?;
    for entry in frames.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        // What a kill left half written has a name that starts with a dot.
        if !name.starts_with('.') {
            read(format!("frames/{name}"))?;
        }
    }
    let text = found.remove("summary.json").unwrap_or_default();
    let mut summary: serde_json::Value =
        serde_json::from_slice(&text).map_err(|e| format!("summary.json: {e}"))?;
    for name in OF_THE_MACHINE {
        summary[name] = serde_json::Value::Null;
    }
    found.insert("summary.json".into(), summary.to_string().into_bytes());
    Ok(found)
}

/// The first file in which two runs differ.
pub fn differ(
    one: &BTreeMap<String, Vec<u8>>,
    other: &BTreeMap<String, Vec<u8>>,
) -> Option<String> {
    let names = one.keys().chain(other.keys());
    names
        .into_iter()
        .find(|n| one.get(*n) != other.get(*n))
        .cloned()
}

/// Whether what a run has written so far can be read: rows whole, every listed frame there and whole.
pub fn outputs_are_whole(folder: &Path) -> Result<(), String> {
    let read = |name: &str| fs::read(folder.join(name)).unwrap_or_default();
    let series = String::from_utf8(read("series.csv")).map_err(|e| format!("series.csv: {e}"))?;
    let mut lines = series.lines();
    let columns = lines.next().map_or(0, |header| header.split(',').count());
    let row_is_whole = |row: &str| {
        row.split(',').count() == columns && row.split(',').all(|cell| cell.parse::<f64>().is_ok())
    };
    if !(series.is_empty() || series.ends_with('\n')) || !lines.all(row_is_whole) {
        return Err("series.csv has a row that is not whole".into());
    }
    let list = String::from_utf8(read("frames.pvd")).map_err(|e| format!("frames.pvd: {e}"))?;
    if !(list.is_empty() || list.trim_end().ends_with("</VTKFile>")) {
        return Err("frames.pvd is cut short".into());
    }
    for name in list.split("file=\"").skip(1) {
        let name = name.split('"').next().unwrap_or_default();
        if !read(name).trim_ascii_end().ends_with(b"</VTKFile>") {
            return Err(format!("frames.pvd names {name}, which is not whole"));
        }
    }
    Ok(())
}
