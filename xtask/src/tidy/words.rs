//! Words that belong to one machine: absolute paths of a home or a build folder, hosts of package registries.

use super::Finding;
use super::tree::{File, Tree};

/// Written in two parts, so that this file has none of them.
const FORBIDDEN: [&str; 8] = [
    concat!("/wo", "rk/"),
    concat!("/ho", "me/"),
    concat!("/ro", "ot/"),
    concat!("/Us", "ers/"),
    concat!("index.cra", "tes.io"),
    concat!("static.cra", "tes.io"),
    concat!("://regi", "stry."),
    concat!("arti", "factory"),
];
/// Where a locked package may come from.
const SOURCE: &str = concat!(
    "source = \"registry+https://github.com/rust-lang/cra",
    "tes.io-index\""
);

/// No such word in any text; locked packages come from the public index.
pub fn places(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (place, line) in tree.files.iter().flat_map(File::lines) {
        if let Some(word) = FORBIDDEN.iter().find(|word| line.contains(**word)) {
            findings.push(Finding::error(
                place,
                format!("`{word}` is a place of one machine"),
            ));
        } else if place.starts_with("Cargo.lock:")
            && line.starts_with("source = ")
            && line != SOURCE
        {
            findings.push(Finding::error(
                place,
                "a locked package that is not from the public index",
            ));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_forbidden_word_is_found() {
        for word in FORBIDDEN {
            assert_eq!(
                places(&Tree::of(&[("docs/a.md", &format!("see {word}x"))])).len(),
                1,
                "{word}"
            );
        }
        assert_eq!(
            places(&Tree::of(&[("docs/a.md", "see crates/work.rs")])),
            []
        );
    }

    #[test]
    fn a_foreign_source_in_the_lock_is_found() {
        assert_eq!(places(&Tree::of(&[("Cargo.lock", SOURCE)])), []);
        assert_eq!(
            places(&Tree::of(&[(
                "Cargo.lock",
                "source = \"git+https://example.org/x\""
            )]))
            .len(),
            1
        );
    }
}
