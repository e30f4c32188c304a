//! Which crate may see which, and which dependencies are fenced in.

use super::Finding;
use super::manifest::dependencies;
use super::tree::Tree;

/// The arrows that docs/architecture.md draws: a crate and the crates of ours that it may depend on.
/// `assemble` and the command see everything; tests of a crate (dev-dependencies) may see more.
pub const ARROWS: &[(&str, &[&str])] = &[
    ("model", &[]),
    ("contact", &["model"]),
    ("coarsen", &["model"]),
    ("sdf", &["model"]),
    ("stream", &["model"]),
    ("neighbors", &["model"]),
    ("integrate", &["model"]),
    ("engine", &["model", "neighbors", "integrate"]),
    ("measure", &["model"]),
    ("record", &["model"]),
    ("picture", &[]),
    ("scene", &["model"]),
];
/// Crates that may depend on every crate of the table; the command on `assemble` too.
const ON_TOP: [&str; 2] = ["assemble", "tsubu"];
/// Dependencies that only these crates may name, by the beginning of their name.
const FENCED: &[(&str, &[&str])] = &[
    ("serde_json", &["record"]),
    ("serde", &["scene", "record"]),
    ("parry", &["sdf"]),
];

/// Invariant 1: the arrows are those of the table.
pub fn between_crates(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for name in tree.crates() {
        let Some(manifest) = tree.file(&format!("crates/{name}/Cargo.toml")) else {
            continue;
        };
        let row = ARROWS.iter().find(|row| row.0 == name);
        if row.is_none() && !ON_TOP.contains(&name) {
            findings.push(Finding::error(
                &manifest.path,
                format!(
                    "the crate `{name}` is not in the table of arrows (xtask/src/tidy/arrows.rs)"
                ),
            ));
            continue;
        }
        for dependency in dependencies(manifest)
            .into_iter()
            .filter(|d| d.section == "dependencies" || d.section == "build-dependencies")
        {
            let Some(ours) = dependency.name.strip_prefix("tsubu-") else {
                continue;
            };
            let allowed = row.map_or(
                ARROWS.iter().any(|row| row.0 == ours) || (name == "tsubu" && ours == "assemble"),
                |row| row.1.contains(&ours),
            );
            if !allowed {
                findings.push(Finding::error(
                    dependency.place,
                    format!("`{name}` may not depend on `{ours}`"),
                ));
            }
        }
    }
    findings
}

/// Invariant 1: serde only in `scene` and `record`, serde_json only in `record`, parry only in `sdf`.
pub fn fenced_dependencies(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for name in tree.crates() {
        let Some(manifest) = tree.file(&format!("crates/{name}/Cargo.toml")) else {
            continue;
        };
        for dependency in dependencies(manifest) {
            let fence = FENCED
                .iter()
                .find(|(fenced, _)| dependency.name.starts_with(fenced));
            if let Some((fenced, homes)) = fence.filter(|(_, homes)| !homes.contains(&name)) {
                findings.push(Finding::error(
                    dependency.place,
                    format!("`{fenced}` belongs to {} only", homes.join(" and ")),
                ));
            }
        }
    }
    findings
}

/// Every line that brings in a dependency says why. The workspace's own crates explain themselves where they are used.
pub fn reasons(tree: &Tree) -> Vec<Finding> {
    let manifests = tree.files.iter().filter(|f| f.path.ends_with("Cargo.toml"));
    manifests
        .flat_map(dependencies)
        .filter(|d| !(d.has_reason || d.is_path && d.section == "workspace.dependencies"))
        .map(|d| {
            Finding::error(
                d.place,
                format!("`{}` has no comment that says why it is needed", d.name),
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(lines: &str) -> String {
        format!("[package]\nname = \"x\"\n[dependencies]\n{lines}\n")
    }

    fn check(check: fn(&Tree) -> Vec<Finding>, name: &str, lines: &str) -> Vec<Finding> {
        check(&Tree::of(&[(
            &format!("crates/{name}/Cargo.toml"),
            &manifest(lines),
        )]))
    }

    #[test]
    fn an_arrow_beside_the_table_is_found() {
        assert_eq!(
            check(
                between_crates,
                "contact",
                "tsubu-model.workspace = true # words"
            ),
            []
        );
        assert_eq!(
            check(
                between_crates,
                "contact",
                "tsubu-sdf.workspace = true # why"
            )
            .len(),
            1
        );
        assert_eq!(check(between_crates, "newcomer", "").len(), 1);
        assert_eq!(
            check(
                between_crates,
                "assemble",
                "tsubu-sdf.workspace = true # why"
            ),
            []
        );
        assert_eq!(
            check(
                between_crates,
                "assemble",
                "tsubu-assemble.workspace = true # why"
            )
            .len(),
            1
        );
        assert_eq!(
            check(
                between_crates,
                "contact",
                "[dev-dependencies]\ntsubu-sdf.workspace = true # in tests"
            ),
            []
        );
    }

    /// A program of the engine alone, without water, links none: nothing that the engine stands on sees it.
    #[test]
    fn the_engine_stands_on_no_water_no_law_no_mesh_and_no_scene() {
        let row = |name: &str| {
            ARROWS
                .iter()
                .find(|row| row.0 == name)
                .map_or(&[][..], |row| row.1)
        };
        let mut below = vec!["engine"];
        let mut at = 0;
        while let Some(&name) = below.get(at) {
            below.extend(
                row(name)
                    .iter()
                    .filter(|n| !below.contains(n))
                    .collect::<Vec<_>>(),
            );
            at += 1;
        }
        for above in ["stream", "contact", "sdf", "scene", "measure", "record"] {
            assert!(!below.contains(&above), "{below:?}");
        }
    }

    #[test]
    fn a_fenced_dependency_elsewhere_is_found() {
        assert_eq!(
            check(
                fenced_dependencies,
                "record",
                "serde.workspace = true # a\nserde_json = \"1\" # b"
            ),
            []
        );
        assert_eq!(
            check(
                fenced_dependencies,
                "scene",
                "serde = \"1\" # a\nserde_json = \"1\" # b"
            )
            .len(),
            1
        );
        assert_eq!(
            check(
                fenced_dependencies,
                "engine",
                "parry3d-f64 = \"1\" # a\nserde = \"1\" # b"
            )
            .len(),
            2
        );
    }

    #[test]
    fn a_dependency_without_a_reason_is_found() {
        assert_eq!(check(reasons, "sdf", "glam = \"1\" # vectors"), []);
        assert_eq!(check(reasons, "sdf", "glam = \"1\"").len(), 1);
    }
}
