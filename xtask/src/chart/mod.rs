//! `cargo xtask chart`: the error of what a scene is about against what it costs, over the knobs of the scene.

mod bed;
pub mod collision;
mod draw;
mod feeder;
mod front;
mod heap;
mod price;
mod runs;
mod scene;

use scene::SceneChart;
use std::path::Path;

/// What makes the chart of a scene.
type Chart = fn() -> SceneChart;

/// Charts by their names.
const CHARTS: [(&str, Chart); 3] = [
    ("heap", heap::chart),
    ("bed", bed::chart),
    ("feeder", feeder::chart),
];

/// The list of what each piece of physics costs and changes.
const PRICE: &str = "price";

/// The chart of collisions and a packing.
const COLLISION: &str = "collision";

/// Makes the named charts, or all.
pub fn run(root: &Path, names: &[String]) -> Result<bool, String> {
    let all: Vec<&str> = CHARTS
        .iter()
        .map(|c| c.0)
        .chain([COLLISION, PRICE])
        .collect();
    if let Some(name) = names.iter().find(|name| !all.contains(&name.as_str())) {
        return Err(format!(
            "there is no chart `{name}`; the charts are {}",
            all.join(", ")
        ));
    }
    let mut held = true;
    let asked = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    for (name, chart) in CHARTS {
        if asked(name) {
            held &= draw::scene(root, name, &chart())?;
        }
    }
    if asked(COLLISION) {
        held &= collision::run(root)?;
    }
    if asked(PRICE) {
        held &= price::run(root)?;
    }
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::scene::{Setting, Subject};
    use super::*;
    use crate::validate::scenes::changed;

    /// Every setting of every chart and of the price list is a scene: a slip of the pen would show only after hours.
    #[test]
    fn every_setting_is_a_scene() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let checks = |subject: &Subject, setting: &Setting| {
            let seeds = subject.seeds.iter().map(|field| field.replace('#', "1"));
            let mut sets: Vec<String> = subject.shared.iter().cloned().chain(seeds).collect();
            sets.extend(setting.sets.iter().cloned());
            let checked = changed(&root.join(subject.scene), &sets).map(|source| source.check());
            assert!(
                matches!(checked, Ok(Ok(_))),
                "{}: {}: {checked:?}",
                subject.name,
                setting.name
            );
        };
        for (_, chart) in CHARTS {
            let chart = chart();
            let all = chart.settings.iter().chain([&chart.reference]);
            all.for_each(|setting| checks(&chart.subject, setting));
            assert!(chart.settings.len() >= 25, "{}", chart.title);
        }
        for list in price::lists() {
            let all = list.pieces.iter().chain([&list.base]);
            all.for_each(|setting| checks(&list.subject, setting));
        }
    }
}
