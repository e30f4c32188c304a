//! `cargo xtask stability`: maps of where each method holds and where it fails, theory drawn over measurement.

mod gap;
mod impact;
mod packings;
mod plane;
mod springs;
mod tunnel;

use crate::validate::scenes::keep;
use std::path::Path;
use tsubu_picture::Figure;

/// Maps by their names; each returns whether the measurement keeps to the theory where that is exact.
type Map = fn(&Sheet) -> Result<bool, String>;

const MAPS: [(&str, Map); 6] = [
    ("plane", plane::run),
    ("packings", packings::run),
    ("springs", springs::run),
    ("impact", impact::run),
    ("gap", gap::run),
    ("tunnel", tunnel::run),
];

/// Makes the named maps, or all; true if those with an exact theory keep to it.
pub fn run(root: &Path, names: &[String]) -> Result<bool, String> {
    if let Some(name) = names.iter().find(|n| MAPS.iter().all(|m| m.0 != **n)) {
        let all: Vec<&str> = MAPS.iter().map(|m| m.0).collect();
        return Err(format!(
            "there is no map `{name}`; the maps are {}",
            all.join(", ")
        ));
    }
    let mut held = true;
    for (name, map) in MAPS {
        if names.is_empty() || names.iter().any(|n| n == name) {
            held &= map(&Sheet { root, name })?;
        }
    }
    Ok(held)
}

/// Where a map writes.
pub struct Sheet<'a> {
    root: &'a Path,
    name: &'static str,
}

impl Sheet<'_> {
    /// Writes `docs/charts/stability_<file>.svg` and the CSV beside it.
    fn write(&self, file: &str, figure: Figure, csv: &str) -> Result<(), String> {
        let named = |end: &str| {
            self.root
                .join(format!("docs/charts/stability_{file}.{end}"))
        };
        let caption = format!("cargo xtask stability {}", self.name);
        keep(&named("csv"), csv)?;
        keep(&named("svg"), &figure.caption(&caption).svg())?;
        eprintln!("{}: docs/charts/stability_{file}.svg", self.name);
        Ok(())
    }
}
