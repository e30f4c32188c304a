//! What every source file owes the reader: a subject, a length, safety, nothing left undone, true sources.

use super::Finding;
use super::tree::{File, Tree};
use std::collections::BTreeSet;

/// The one file that may hold unsafe code.
const FENCE: &str = "crates/engine/src/lanes.rs";
/// Lines above which a file is worth a look.
const LONG: usize = 600;
/// Words that say something was left for later. Written in two parts so that this file has none of them.
const UNDONE: [&str; 5] = [
    concat!("to", "do!"),
    concat!("unimple", "mented!"),
    concat!("#[ig", "nore"),
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
];
/// The bibliography.
const BIBLIOGRAPHY: &str = "docs/literature.bib";

fn rust(tree: &Tree) -> impl Iterator<Item = &File> {
    tree.files.iter().filter(|f| f.is_rust())
}

/// Every Rust file begins with `//!`.
pub fn first_lines(tree: &Tree) -> Vec<Finding> {
    let bare = rust(tree).filter(|f| !f.text.starts_with("//! "));
    bare.map(|f| Finding::error(&f.path, "does not begin with `//! ` and its subject"))
        .collect()
}

/// A file over 600 lines is a warning.
pub fn lengths(tree: &Tree) -> Vec<Finding> {
    let long = rust(tree)
        .map(|f| (f, f.text.lines().count()))
        .filter(|(_, lines)| *lines > LONG);
    long.map(|(f, lines)| {
        Finding::warning(&f.path, format!("{lines} lines: more than one subject?"))
    })
    .collect()
}

/// Unsafe code lies in the fenced module only.
pub fn fence(tree: &Tree) -> Vec<Finding> {
    let word = concat!("un", "safe");
    let opens = |line: &str| {
        let code = line.split("//").next().unwrap_or_default();
        code.split(|c: char| !(c.is_alphanumeric() || c == '_'))
            .any(|w| w == word)
            || code.contains(concat!("allow(un", "safe_code"))
    };
    rust(tree)
        .filter(|f| f.path != FENCE)
        .flat_map(File::lines)
        .filter(|(_, line)| opens(line))
        .map(|(place, _)| Finding::error(place, format!("{word} code outside {FENCE}")))
        .collect()
}

/// No placeholder, no ignored test.
pub fn undone(tree: &Tree) -> Vec<Finding> {
    let read = |f: &&File| f.is_rust() || f.path.ends_with(".toml") || f.path.ends_with(".ron");
    let mut findings = Vec::new();
    for (place, line) in tree.files.iter().filter(read).flat_map(File::lines) {
        if let Some(word) = UNDONE.iter().find(|word| line.contains(**word)) {
            findings.push(Finding::error(
                place,
                format!("`{word}`: do it, or say in an issue what is missing"),
            ));
        }
    }
    findings
}

/// Laws and rules name a source; every key named in the docs of a crate is in the bibliography.
pub fn keys(tree: &Tree) -> Vec<Finding> {
    let sources: Vec<&File> = rust(tree)
        .filter(|f| f.path.starts_with("crates/") && f.path.contains("/src/"))
        .collect();
    let is_doc =
        |line: &str| line.trim_start().starts_with("///") || line.trim_start().starts_with("//!");
    let mut findings = Vec::new();
    for file in &sources {
        let law = ["ContactLaw<D, S> for ", "impl CoarseRule for "]
            .iter()
            .any(|head| file.text.contains(head));
        let named = file
            .text
            .lines()
            .any(|line| is_doc(line) && (line.contains("Source: ") || line.contains("Sources: ")));
        if law && !named {
            findings.push(Finding::error(
                &file.path,
                "a law or a rule without a line `Source: ` and its key",
            ));
        }
    }
    let cited: Vec<(String, String)> = sources
        .iter()
        .flat_map(|f| f.lines())
        .filter(|(_, line)| is_doc(line))
        .flat_map(|(place, line)| {
            line.split('`')
                .skip(1)
                .step_by(2)
                .filter(|word| is_key(word))
                .map(move |key| (place.clone(), key.to_string()))
        })
        .collect();
    let Some(bibliography) = tree.file(BIBLIOGRAPHY) else {
        if !cited.is_empty() {
            findings.push(Finding::error(
                BIBLIOGRAPHY,
                format!("is missing; {} places name its keys", cited.len()),
            ));
        }
        return findings;
    };
    let known: BTreeSet<&str> = bibliography
        .text
        .lines()
        .filter_map(|l| l.strip_prefix('@')?.split_once('{')?.1.strip_suffix(','))
        .collect();
    for (place, key) in cited
        .into_iter()
        .filter(|(_, key)| !known.contains(key.as_str()))
    {
        findings.push(Finding::error(
            place,
            format!("`{key}` is not in {BIBLIOGRAPHY}"),
        ));
    }
    findings
}

/// True for a name and a year: `Sumitomo2024`, `Maurin2015b`.
fn is_key(word: &str) -> bool {
    let word = word
        .strip_suffix(|c: char| {
            c.is_ascii_lowercase() && word.contains(|d: char| d.is_ascii_digit())
        })
        .unwrap_or(word);
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let year = &word[letters.len()..];
    year.len() == 4
        && (year.starts_with("18") || year.starts_with("19") || year.starts_with("20"))
        && letters.len() > 1
        && letters.chars().all(char::is_alphabetic)
        && letters.starts_with(char::is_uppercase)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(check: fn(&Tree) -> Vec<Finding>, path: &str, text: &str) -> usize {
        check(&Tree::of(&[(path, text)])).len()
    }

    #[test]
    fn a_file_without_a_subject_is_found() {
        assert_eq!(
            (
                found(first_lines, "a.rs", "//! A.\n"),
                found(first_lines, "a.rs", "fn a() {}\n")
            ),
            (0, 1)
        );
    }

    #[test]
    fn a_long_file_is_a_warning() {
        let findings = lengths(&Tree::of(&[
            ("a.rs", &"\n".repeat(601)),
            ("b.rs", &"\n".repeat(600)),
        ]));
        assert!(findings.len() == 1 && findings[0].warning && findings[0].place == "a.rs");
    }

    #[test]
    fn code_beyond_the_fence_is_found() {
        let code = concat!("fn a() { un", "safe { b() } }");
        assert_eq!(
            (
                found(fence, FENCE, code),
                found(fence, "xtask/src/a.rs", code)
            ),
            (0, 1)
        );
        assert_eq!(found(fence, "a.rs", concat!("//! un", "safe is a word")), 0);
        assert_eq!(
            found(fence, "a.rs", concat!("#![allow(un", "safe_code)]")),
            1
        );
    }

    #[test]
    fn every_placeholder_is_found() {
        for word in UNDONE {
            assert_eq!(found(undone, "a.rs", &format!("    {word}")), 1, "{word}");
        }
        assert_eq!(found(undone, "a.rs", "//! Done."), 0);
    }

    #[test]
    fn a_key_that_the_bibliography_lacks_is_found() {
        let law = "/// Source: `Known2001`.\nimpl CoarseRule for A {}\n";
        let bib = ("docs/literature.bib", "@article{Known2001,\n}\n");
        assert_eq!(keys(&Tree::of(&[("crates/a/src/a.rs", law), bib])), []);
        assert_eq!(keys(&Tree::of(&[("crates/a/src/a.rs", law)])).len(), 1);
        assert_eq!(
            keys(&Tree::of(&[
                ("crates/a/src/a.rs", "//! By `Other1999b`."),
                bib
            ]))
            .len(),
            1
        );
        assert_eq!(
            keys(&Tree::of(&[
                ("crates/a/src/a.rs", "impl CoarseRule for A {}"),
                bib
            ]))
            .len(),
            1
        );
        assert!(
            is_key("Known2001")
                && is_key("Known2001a")
                && !is_key("Level2")
                && !is_key("known2001")
                && !is_key("2001")
        );
    }
}
