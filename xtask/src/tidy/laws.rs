//! Where laws may be named: so that a new one touches its own files and a row, and nobody else.

use super::Finding;
use super::tree::{File, Tree};

/// Names of the laws, as `Law` in `assemble` has them.
const LAWS: [&str; 3] = ["Repulsion", "SpringDashpot", "HertzMindlin"];

/// Whose business laws are, by the beginning of a path.
const PLACES: [&str; 5] = [
    "crates/contact/",
    "crates/scene/",
    "crates/assemble/src/law",
    // What other programs call them.
    "crates/tsubu/src/export/",
    // Which constant of a law makes it softer.
    "crates/tsubu/src/tune/knobs.rs",
];

/// No other line of a crate's code names a law.
pub fn named_at_home(tree: &Tree) -> Vec<Finding> {
    let elsewhere = |file: &&File| {
        let path = &file.path;
        file.is_rust()
            && path.starts_with("crates/")
            && path.contains("/src/")
            && !PLACES.iter().any(|place| path.starts_with(place))
    };
    let mut findings = Vec::new();
    for (place, line) in tree.files.iter().filter(elsewhere).flat_map(File::lines) {
        if line.trim_start().starts_with("//") {
            continue;
        }
        let names = |law: &&&str| {
            let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
            words.any(|word| word == **law)
        };
        if let Some(law) = LAWS.iter().find(names) {
            findings.push(Finding::error(
                place,
                format!("`{law}` is named here: ask the law instead (crates/assemble/src/law.rs)"),
            ));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_named_by_a_stranger_is_found() {
        let code = "//! A plan.\nif let Law::HertzMindlin(law) = law {}\n";
        let found = named_at_home(&Tree::of(&[("crates/assemble/src/plan.rs", code)]));
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].place, "crates/assemble/src/plan.rs:2");
        for home in [
            "crates/assemble/src/law/own.rs",
            "crates/contact/src/own.rs",
        ] {
            assert_eq!(named_at_home(&Tree::of(&[(home, code)])), []);
        }
        let told = "/// Not for law HertzMindlin.\nlet of_hertz = OfHertzMindlin;\n";
        assert_eq!(
            named_at_home(&Tree::of(&[("crates/engine/src/a.rs", told)])),
            []
        );
    }

    /// The list of names is that of the table.
    #[test]
    fn every_law_is_known() {
        let table = include_str!("../../../crates/scene/src/raw.rs");
        let row = table.lines().find(|line| line.contains("(\"law\", &["));
        let row = row.expect("the choices of a law");
        assert_eq!(row.matches('"').count() / 2 - 1, LAWS.len(), "{row}");
        assert!(LAWS.iter().all(|law| row.contains(law)));
    }
}
