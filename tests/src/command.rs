//! The command `tsubu` as a process: built once, run in a folder, its words and its exit code.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;

/// The path of the command, built on the first call with the profile and into the folder of these tests.
///
/// Cargo builds a binary for the tests of its own package only, so these tests ask for it themselves.
/// All it is made of has been built for the tests already: what remains is to link it.
pub fn tsubu() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    PATH.get_or_init(|| {
        // target/<profile folder>/deps/<test>
        let test = std::env::current_exe().unwrap_or_else(|error| panic!("{error}"));
        let mut above = test.ancestors().skip(2);
        let (Some(built), Some(target)) = (above.next(), above.next()) else {
            panic!("{} is not where cargo puts a test", test.display())
        };
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut build = Command::new(cargo);
        // The test is named too, so that the parts are built with the very features that it has them with.
        build.args(["build", "--quiet", "--package", "tsubu", "--bin", "tsubu"]);
        build.args(["--package", "tsubu-tests", "--test", "all"]);
        build
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .arg("--target-dir")
            .arg(target);
        if built.ends_with("release") {
            build.arg("--release");
        }
        let done = build
            .output()
            .unwrap_or_else(|error| panic!("cargo does not start: {error}"));
        assert!(
            done.status.success(),
            "the command does not build:\n{}",
            String::from_utf8_lossy(&done.stderr)
        );
        built.join(format!("tsubu{}", std::env::consts::EXE_SUFFIX))
    })
}

/// How a command ended.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The exit code; -1 if a signal killed it.
    pub code: i32,
    /// What it said.
    pub stdout: String,
    /// What it complained of.
    pub stderr: String,
}

impl Outcome {
    /// Waits for the end of a process.
    pub fn of(child: Child) -> Self {
        let output = child
            .wait_with_output()
            .unwrap_or_else(|error| panic!("{error}"));
        Self {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Fails the test unless the command ended with this code, one error message and no trace of a panic.
    #[track_caller]
    pub fn is_one_message(&self, code: i32) -> &Self {
        let errors = self
            .stderr
            .lines()
            .filter(|line| line.starts_with("error"))
            .count();
        assert!(
            self.code == code && errors == 1,
            "exit code {code} and one message expected, got {self:#?}"
        );
        let panics = ["panicked", "RUST_BACKTRACE", "unwrap", "src/"]
            .iter()
            .find(|word| self.stderr.contains(**word));
        assert!(panics.is_none(), "{self:#?}");
        self
    }

    /// Fails the test unless the complaint holds these words.
    #[track_caller]
    pub fn says(&self, words: &str) -> &Self {
        assert!(
            self.stderr.contains(words),
            "“{words}” expected in {self:#?}"
        );
        self
    }

    /// Fails the test unless the command ended well.
    #[track_caller]
    pub fn is_done(&self) -> &Self {
        assert_eq!(self.code, 0, "{self:#?}");
        self
    }
}

/// Starts `tsubu` with these arguments, parted by blanks (`~` stands for a blank inside one), in a folder.
pub fn start_in(folder: &Path, arguments: &str) -> Child {
    let mut command = Command::new(tsubu());
    command.args(
        arguments
            .split_whitespace()
            .map(|argument| argument.replace("~", " ")),
    );
    command
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command.spawn().unwrap_or_else(|error| panic!("{error}"))
}

/// Runs `tsubu` to its end.
pub fn run_in(folder: &Path, arguments: &str) -> Outcome {
    Outcome::of(start_in(folder, arguments))
}

/// Sends a signal, such as `INT`.
pub fn kill(child: &Child, signal: &str) {
    let sent = Command::new("kill")
        .args(["-s", signal, &child.id().to_string()])
        .status();
    assert!(sent.is_ok_and(|status| status.success()), "no signal sent");
}
