//! What a suite has found: checks as a table and as JSON, figures, words on the way.

use super::check::{Check, Evidence, Tolerance};
use std::path::{Path, PathBuf};
use std::time::Instant;
use tsubu_picture::Figure;

/// The findings of one suite while it runs.
pub struct Report {
    suite: &'static str,
    root: PathBuf,
    full: bool,
    checks: Vec<Check>,
    started: Instant,
}

impl Report {
    /// An empty report of `suite` for the workspace at `root`.
    pub fn new(suite: &'static str, root: &Path, full: bool) -> Self {
        Self {
            suite,
            root: root.to_path_buf(),
            full,
            checks: Vec::new(),
            started: Instant::now(),
        }
    }

    /// The workspace.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// True for the long version.
    pub fn full(&self) -> bool {
        self.full
    }

    /// Adds an analytic check; `note` says why the tolerance is what it is.
    pub fn check(
        &mut self,
        name: impl Into<String>,
        expected: f64,
        got: f64,
        tolerance: Tolerance,
        note: &str,
    ) {
        self.add(
            name.into(),
            expected,
            got,
            tolerance,
            Evidence::Analytic,
            note,
        );
    }

    /// The same against what another program gave.
    pub fn cross_code(
        &mut self,
        name: impl Into<String>,
        expected: f64,
        got: f64,
        tolerance: Tolerance,
        note: &str,
    ) {
        self.add(
            name.into(),
            expected,
            got,
            tolerance,
            Evidence::CrossCode,
            note,
        );
    }

    /// The same against a measurement in a laboratory.
    pub fn experiment(
        &mut self,
        name: impl Into<String>,
        expected: f64,
        got: f64,
        tolerance: Tolerance,
        note: &str,
    ) {
        self.add(
            name.into(),
            expected,
            got,
            tolerance,
            Evidence::Experiment,
            note,
        );
    }

    fn add(
        &mut self,
        name: String,
        expected: f64,
        got: f64,
        tolerance: Tolerance,
        evidence: Evidence,
        note: &str,
    ) {
        let check = Check::new(self.suite, name, expected, got, tolerance, evidence, note);
        if !check.pass {
            eprintln!(
                "  FAILED {}: expected {}, got {}",
                check.name,
                number(expected),
                number(got)
            );
        }
        self.checks.push(check);
    }

    /// Adds a number that is neither passed nor failed, beside one to read it against.
    pub fn beside(&mut self, name: impl Into<String>, expected: f64, got: f64, note: &str) {
        self.check(name, expected, got, Tolerance::Information, note);
    }

    /// Adds a number to read.
    pub fn tell(&mut self, name: impl Into<String>, got: f64, note: &str) {
        self.beside(name, f64::NAN, got, note);
    }

    /// A line on stderr, so that a long suite is seen to live.
    pub fn progress(&self, words: &str) {
        eprintln!(
            "  [{} {:6.1} s] {words}",
            self.suite,
            self.started.elapsed().as_secs_f64()
        );
    }

    /// With `--full`, writes the figure to docs/figures; its caption is the command that makes it.
    pub fn figure(&self, name: &str, figure: Figure) -> Result<(), String> {
        if !self.full {
            return Ok(());
        }
        let folder = self.root.join("docs/figures");
        std::fs::create_dir_all(&folder)
            .map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
        let caption = format!("cargo xtask validate {} --full", self.suite);
        figure
            .caption(&caption)
            .save(&folder.join(name))
            .map_err(|e| e.to_string())?;
        self.progress(&format!("figure docs/figures/{name}.svg"));
        Ok(())
    }

    /// Prints the table, writes the JSON, and says whether everything held.
    pub fn finish(self) -> Result<bool, String> {
        print!("{}", table(&self.checks));
        let failed = self.checks.iter().filter(|c| !c.pass).count();
        let compared = self
            .checks
            .iter()
            .filter(|c| c.tolerance != Tolerance::Information)
            .count();
        println!(
            "{}: {} of {compared} checks hold, {:.1} s\n",
            self.suite,
            compared - failed,
            self.started.elapsed().as_secs_f64()
        );
        let folder = self.root.join("target/validate");
        std::fs::create_dir_all(&folder)
            .map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
        let file = folder.join(format!("{}.json", self.suite));
        let text = serde_json::to_string_pretty(&self.checks).map_err(|e| e.to_string())?;
        std::fs::write(&file, text + "\n")
            .map_err(|e| format!("cannot write {}: {e}", file.display()))?;
        Ok(failed == 0)
    }
}

/// The checks as aligned columns, the note of a failed one below it.
fn table(checks: &[Check]) -> String {
    let width = checks
        .iter()
        .map(|c| c.name.chars().count())
        .max()
        .unwrap_or(0)
        .max(5);
    let mut out = format!(
        "{:<width$}  {:>13}  {:>13}  {:>11}  {:<10} pass\n",
        "check", "expected", "got", "tolerance", "evidence"
    );
    for c in checks {
        let verdict = match (c.tolerance, c.pass) {
            (Tolerance::Information, _) => "·",
            (_, true) => "yes",
            (_, false) => "NO",
        };
        let expected = if c.expected.is_nan() {
            "–".into()
        } else {
            number(c.expected)
        };
        let evidence = format!("{:?}", c.evidence).to_lowercase();
        out += &format!(
            "{:<width$}  {:>13}  {:>13}  {:>11}  {evidence:<10} {verdict}\n",
            c.name,
            expected,
            number(c.got),
            c.tolerance.words(),
        );
        if !c.pass {
            out += &format!("    {}\n", c.note);
        }
    }
    out
}

/// Seven digits, in the shorter of the two notations.
fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || (1e-3..1e6).contains(&size) {
        format!("{x:.7}")
    } else {
        format!("{x:.6e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_names_a_failure_and_its_reason() {
        let check = |got| {
            let tolerance = Tolerance::Relative(0.1);
            Check::new(
                "t",
                format!("row {got}"),
                1.0,
                got,
                tolerance,
                Evidence::Analytic,
                "a tenth for rounding",
            )
        };
        let text = table(&[check(1.05), check(1.2)]);
        assert!(
            text.contains("yes") && text.contains("NO") && text.contains("a tenth for rounding")
        );
        assert_eq!(text.matches("a tenth").count(), 1);
    }
}
