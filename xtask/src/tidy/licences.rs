//! Licences and sources of everything that is linked: permissive ones only, from the registry or this workspace.
//!
//! It asks `cargo metadata`, which needs no network and no tool of its own to be built first.

use super::Finding;
use std::path::Path;
use std::process::Command;

/// Licences that ask for no more than their text to be kept.
const PERMISSIVE: [&str; 12] = [
    "MIT",
    "MIT-0",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "0BSD",
    "ISC",
    "Zlib",
    "BSL-1.0",
    "CC0-1.0",
    "Unicode-3.0",
];

/// Every package built on this system that is under a licence that is not permissive, or from elsewhere than the registry.
pub fn check(root: &Path) -> Result<Vec<Finding>, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // Packages of other systems are not on this machine.
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--offline", "--locked"])
        .args(["--filter-platform", &host()?])
        .current_dir(root)
        .output()
        .map_err(|e| format!("cargo does not start: {e}"))?;
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout)
        .map_err(|e| format!("cargo metadata says nothing: {e}"))?;
    let packages = metadata["packages"].as_array();
    let packages = packages.ok_or("cargo metadata names no packages")?;
    Ok(packages.iter().filter_map(finding).collect())
}

/// The system that this one builds for, as rustc calls it.
fn host() -> Result<String, String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).arg("-vV").output();
    let words = output
        .map_err(|e| format!("rustc does not start: {e}"))?
        .stdout;
    let words = String::from_utf8_lossy(&words).into_owned();
    let host = words.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned)
        .ok_or_else(|| "rustc names no host".into())
}

fn finding(package: &serde_json::Value) -> Option<Finding> {
    let text = |key: &str| package[key].as_str().unwrap_or_default();
    let (name, licence, source) = (text("name"), text("license"), text("source"));
    let what = if !is_permissive(licence) {
        format!("its licence is `{licence}`, which is not among the permissive ones")
    } else if !(source.is_empty() || source.starts_with("registry+")) {
        "it does not come from the registry".to_owned()
    } else {
        return None;
    };
    Some(Finding::error(format!("Cargo.lock, {name}"), what))
}

/// Whether an expression of licences can be met with permissive ones alone: `AND` binds more tightly than `OR`, and a
/// slash is an old way to write `OR`.
fn is_permissive(expression: &str) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ");
    let spaced = spaced.replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = &words[..];
    any(&mut rest) && rest.is_empty()
}

fn any(words: &mut &[&str]) -> bool {
    let mut held = all(words);
    while words.first() == Some(&"OR") {
        *words = &words[1..];
        // Both sides are read, whatever the first is.
        held |= all(words);
    }
    held
}

fn all(words: &mut &[&str]) -> bool {
    let mut held = one(words);
    while words.first() == Some(&"AND") {
        *words = &words[1..];
        held &= one(words);
    }
    held
}

fn one(words: &mut &[&str]) -> bool {
    match **words {
        ["(", ref inside @ ..] => {
            let mut inside = inside;
            let held = any(&mut inside);
            let closed = inside.first() == Some(&")");
            *words = inside.get(1..).unwrap_or_default();
            held && closed
        }
        [licence, "WITH", exception, ref rest @ ..] => {
            *words = rest;
            PERMISSIVE.contains(&&*format!("{licence} WITH {exception}"))
        }
        [licence, ref rest @ ..] => {
            *words = rest;
            PERMISSIVE.contains(&licence)
        }
        [] => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_met_or_not() {
        for yes in [
            "MIT",
            "MIT OR GPL-3.0-only",
            "GPL-3.0 OR MIT AND Zlib",
            "Unlicense/MIT",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception OR LGPL-2.1",
        ] {
            assert!(is_permissive(yes), "{yes}");
        }
        for no in [
            "",
            "MPL-2.0",
            "MIT AND GPL-3.0-only",
            "(MIT OR Apache-2.0) AND LGPL-2.1",
            "(MIT",
            "MIT)",
            "GPL-2.0 WITH Classpath-exception-2.0",
        ] {
            assert!(!is_permissive(no), "{no}");
        }
    }

    #[test]
    fn a_package_from_elsewhere_is_found() {
        let of = |licence: &str, source: &str| {
            finding(&serde_json::json!({ "name": "x", "license": licence, "source": source }))
        };
        assert!(of("MIT", "registry+y").is_none() && of("MIT", "").is_none());
        assert!(of("MIT", "git+y").is_some() && of("AGPL-3.0", "registry+y").is_some());
    }
}
