//! Scenes of many grains of this suite, and what their series say.

use crate::validate::scenes::build_on_one_thread;
use std::path::Path;
use tsubu_assemble::Stop;
use tsubu_model::Reading;
use tsubu_scene::Source;

/// The scenes of the suite; users have `scenarios/hopper.ron`.
const SCENES: [(&str, &str); 4] = [
    ("column", include_str!("../../../scenes/column.ron")),
    ("silo", include_str!("../../../scenes/silo.ron")),
    ("bin", include_str!("../../../scenes/bin.ron")),
    ("slot", include_str!("../../../scenes/slot.ron")),
];

/// A scene of the suite with changes.
pub fn scene(name: &str, sets: &[String]) -> Result<Source, String> {
    let text = SCENES.iter().find(|(known, _)| *known == name);
    let (_, text) = text.ok_or_else(|| format!("the suite has no scene {name}"))?;
    let mut source = Source::from_text(&format!("{name}.ron"), text);
    for set in sets {
        source.set(set).map_err(|e| e.to_string())?;
    }
    Ok(source)
}

/// Bits of a scene, by which a kept run is known again: name and text.
pub fn file(root: &Path, name: &str) -> Result<std::path::PathBuf, String> {
    let source = scene(name, &[])?;
    let print = crate::validate::kept::fingerprint(&source)?;
    Ok(root.join(format!("target/validate/hertz/{print:016x}-{name}")))
}

/// The looks of a run, and how many grains it ended with.
pub struct Rows {
    looks: Vec<Vec<Reading>>,
    /// Number of grains at the end.
    pub grains: usize,
    /// Height of the uppermost centre at the end, m.
    pub top: f64,
}

impl Rows {
    /// A column by name.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let of = |row: &Vec<Reading>| {
            let reading = row.iter().find(|reading| reading.name == name);
            reading.map_or(f64::NAN, |reading| reading.value)
        };
        self.looks.iter().map(of).collect()
    }

    /// The last value of a column.
    pub fn last(&self, name: &str) -> f64 {
        self.column(name).last().copied().unwrap_or(f64::NAN)
    }

    /// The value of a column at the look nearest to where another has this value.
    pub fn at(&self, clock: &str, when: f64, name: &str) -> f64 {
        let off = |time: &f64| {
            let off = (time - when).abs();
            if off.is_nan() { f64::INFINITY } else { off }
        };
        let times = self.column(clock);
        let nearest = (0..times.len()).min_by(|&a, &b| off(&times[a]).total_cmp(&off(&times[b])));
        nearest.map_or(f64::NAN, |look| self.column(name)[look])
    }
}

/// Runs a scene on one thread to its end and looks every so many seconds.
pub fn rows(source: &Source, every: f64) -> Result<Rows, String> {
    let built = build_on_one_thread(source)?;
    let (mut run, dt) = (built.simulation, built.plan.constants.dt);
    let each = (every / dt).round().max(1.0) as u64;
    let mut looks = vec![run.look()];
    while !run.is_over() {
        run.advance(each);
        looks.push(run.look());
    }
    match run.stop() {
        None | Some(Stop::Over) => Ok(Rows {
            looks,
            grains: run.grains(),
            top: run
                .state()
                .iter()
                .map(|(x, _)| x.z)
                .fold(f64::NEG_INFINITY, f64::max),
        }),
        Some(stop) => Err(format!("{source:?}: {stop:?}")),
    }
}
