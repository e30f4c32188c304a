//! `cargo xtask tidy`: what a program can check of the invariants of the house.
//!
//! Every check is a function from the [`Tree`] of sources to findings, so that its test can hand it a
//! tiny tree in which it must fire. Below `assemble` nothing may ask "is this 2D?"; that one needs a reader.

mod arrows;
mod copies;
mod laws;
mod licences;
mod manifest;
mod map;
mod sources;
mod tree;
mod words;

use std::path::Path;
use tree::Tree;

/// Something that a check found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// File, and line if there is one.
    pub place: String,
    /// What is wrong and what to do.
    pub what: String,
    /// True if it does not fail the run.
    pub warning: bool,
}

impl Finding {
    /// A failure.
    pub fn error(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self {
            place: place.into(),
            what: what.into(),
            warning: false,
        }
    }

    /// Worth a look.
    pub fn warning(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self {
            warning: true,
            ..Self::error(place, what)
        }
    }
}

/// A check: its name and what it looks for.
type Check = (&'static str, fn(&Tree) -> Vec<Finding>);

const CHECKS: &[Check] = &[
    (
        "arrows between crates are those of the table",
        arrows::between_crates,
    ),
    (
        "serde, serde_json and parry only where they belong",
        arrows::fenced_dependencies,
    ),
    ("every dependency says why it is there", arrows::reasons),
    (
        "every source file begins with its subject",
        sources::first_lines,
    ),
    ("files are short", sources::lengths),
    ("one fenced module", sources::fence),
    ("nothing is left undone", sources::undone),
    (
        "laws and rules name sources that the bibliography has",
        sources::keys,
    ),
    ("laws are named at home only", laws::named_at_home),
    ("no place of one machine, no registry host", words::places),
    (
        "docs/architecture.md names every crate and only what exists",
        map::architecture,
    ),
];

/// Runs every check; true if none failed.
pub fn run(root: &Path) -> Result<bool, String> {
    let tree = Tree::read(root)?;
    let mut failures = 0;
    let mut say = |name: &str, findings: Vec<Finding>| {
        let failed = findings.iter().filter(|f| !f.warning).count();
        println!("{} {name}", if failed > 0 { "NO " } else { "yes" });
        for finding in &findings {
            println!(
                "    {}{}: {}",
                if finding.warning { "warning: " } else { "" },
                finding.place,
                finding.what
            );
        }
        failures += failed;
    };
    for (name, check) in CHECKS {
        say(name, check(&tree));
    }
    say(
        "every dependency has a permissive licence and comes from the registry",
        licences::check(root)?,
    );
    println!(
        "    copies of the step in the command: {}",
        copies::count(root)?
    );
    println!("tidy: {failures} failures in {} files", tree.files.len());
    Ok(failures == 0)
}
