//! docs/architecture.md is a map: it names every crate, and every path on it exists.

use super::Finding;
use super::tree::Tree;

const MAP: &str = "docs/architecture.md";
/// What a path on the map begins with.
const FOLDERS: [&str; 8] = [
    "crates/",
    "xtask/",
    "tests/",
    "benches/",
    "docs/",
    "scenarios/",
    ".ci/",
    ".cargo/",
];

/// The map against the tree.
pub fn architecture(tree: &Tree) -> Vec<Finding> {
    let Some(map) = tree.file(MAP) else {
        return vec![Finding::error(
            MAP,
            "is missing: it says who lives where and which way the arrows point",
        )];
    };
    let mut findings = Vec::new();
    for name in tree.crates() {
        let forms = [
            format!("`{name}`"),
            format!("`crates/{name}"),
            format!("`tsubu-{name}`"),
        ];
        if !forms.iter().any(|form| map.text.contains(form)) {
            findings.push(Finding::error(
                MAP,
                format!("does not name the crate `{name}`"),
            ));
        }
    }
    for (place, line) in map.lines() {
        for path in line.split('`').skip(1).step_by(2) {
            let plain = !path.contains(|c: char| c.is_whitespace() || "*{}<>…".contains(c));
            if plain && FOLDERS.iter().any(|f| path.starts_with(f)) && !tree.has(path) {
                findings.push(Finding::error(
                    place.clone(),
                    format!("`{path}` does not exist"),
                ));
            }
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_map_crate_or_path_is_found() {
        let manifest = ("crates/model/Cargo.toml", "");
        assert_eq!(architecture(&Tree::of(&[manifest])).len(), 1);
        assert_eq!(
            architecture(&Tree::of(&[
                manifest,
                (MAP, "`model` lives in `crates/model/`")
            ])),
            []
        );
        assert_eq!(
            architecture(&Tree::of(&[manifest, (MAP, "nothing")])).len(),
            1
        );
        assert_eq!(
            architecture(&Tree::of(&[
                manifest,
                (MAP, "`model`, `crates/model/src/gone.rs`")
            ]))
            .len(),
            1
        );
        assert_eq!(
            architecture(&Tree::of(&[
                manifest,
                (MAP, "`model`, `scenarios/*.ron`, `docs/<name>`")
            ])),
            []
        );
    }
}
