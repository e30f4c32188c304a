//! The chart of a scene: settings of its knobs against a reference run.

use super::front::Point;
use super::runs::{Ran, Wanted};
use crate::validate::kept::fingerprint;
use crate::validate::scenes::changed;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use tsubu_model::mean_of_runs;

/// One setting of the knobs.
#[derive(Clone, Debug)]
pub struct Setting {
    pub name: String,
    /// What it leaves out or coarsens.
    pub gives_up: &'static str,
    pub sets: Vec<String>,
}

/// A setting by its words.
pub fn setting(name: &str, gives_up: &'static str, sets: &[&str]) -> Setting {
    Setting {
        name: name.to_owned(),
        gives_up,
        sets: sets.iter().map(|&s| s.to_owned()).collect(),
    }
}

/// A scene and the quantity that it is about.
pub struct Subject {
    /// File of the scene below the root.
    pub scene: &'static str,
    /// Name of the chart, its files and its finished runs.
    pub name: &'static str,
    /// The reading, and its word.
    pub quantity: &'static str,
    pub word: &'static str,
    /// Simulated seconds between two looks.
    pub look: f64,
    /// Changes that all share.
    pub shared: Vec<String>,
    /// Changes after which the scene is cheap, for the fingerprint.
    pub cheap: Vec<String>,
    /// Changes that give it a seed, with # for the number.
    pub seeds: &'static [&'static str],
}

impl Subject {
    /// So many seeds of each setting, side by side; an inner `None` is a run that broke or was refused.
    pub fn runs(
        &self,
        root: &Path,
        wanted: &[(&Setting, u64)],
    ) -> Result<Vec<Vec<Option<Ran>>>, String> {
        let scene = root.join(self.scene);
        let cheap: Vec<String> = self.shared.iter().chain(&self.cheap).cloned().collect();
        let print = fingerprint(&changed(&scene, &cheap)?)?;
        let ran = |(setting, seed): &(&Setting, u64)| {
            let mut sets = self.shared.clone();
            let seeds = self.seeds.iter();
            sets.extend(seeds.map(|field| field.replace('#', &seed.to_string())));
            sets.extend(setting.sets.iter().cloned());
            let mut hasher = DefaultHasher::new();
            sets.hash(&mut hasher);
            let file = root.join(format!(
                "target/chart/{}/{print:016x}-{:016x}.csv",
                self.name,
                hasher.finish()
            ));
            let wanted = Wanted {
                name: format!("{}: {}, seed {seed}", self.name, setting.name),
                scene: &scene,
                sets: &sets,
                quantity: self.quantity,
                look: self.look,
            };
            wanted.ran(&file)
        };
        let all: Vec<(&Setting, u64)> = wanted
            .iter()
            .flat_map(|&(s, tries)| (1..=tries).map(move |seed| (s, seed)))
            .collect();
        let mut all: Vec<Option<Ran>> = all.par_iter().map(ran).collect::<Result<_, _>>()?;
        let rest = wanted
            .iter()
            .map(|&(_, tries)| all.drain(..tries as usize).collect());
        Ok(rest.collect())
    }
}

/// A scene and the settings that are tried.
pub struct SceneChart {
    pub subject: Subject,
    pub title: &'static str,
    /// Seeds of a setting and of the reference.
    pub tries: u64,
    pub tries_of_reference: u64,
    /// The converged run.
    pub reference: Setting,
    /// The first is the shipped scene.
    pub settings: Vec<Setting>,
}

impl SceneChart {
    /// Mean of the reference with its standard error, and every setting that ran.
    pub fn points(&self, root: &Path) -> Result<((f64, f64), Vec<Point>), String> {
        let mut wanted = vec![(&self.reference, self.tries_of_reference)];
        wanted.extend(self.settings.iter().map(|s| (s, self.tries)));
        let all = self.subject.runs(root, &wanted)?;
        let reference: Vec<Ran> = all[0].iter().flatten().copied().collect();
        if reference.is_empty() {
            return Err(format!("{}: the reference broke", self.subject.scene));
        }
        let truth = mean(&reference);
        let points = self.settings.iter().zip(&all[1..]).enumerate();
        let points = points.filter_map(|(k, (setting, runs))| {
            let runs: Option<Vec<Ran>> = runs.iter().copied().collect();
            Some(point(setting, &runs?, truth, k == 0))
        });
        Ok((truth, points.collect()))
    }
}

/// Mean with its standard error: of the scatter and of the runs' own, the larger.
pub fn mean(runs: &[Ran]) -> (f64, f64) {
    let values: Vec<_> = runs
        .iter()
        .map(|r| (r.value, Some(r.uncertainty)))
        .collect();
    let (mean, error) = mean_of_runs(&values);
    (mean, error.unwrap_or(0.0))
}

fn point(setting: &Setting, runs: &[Ran], truth: (f64, f64), is_default: bool) -> Point {
    let n = runs.len() as f64;
    let off = |r: &Ran| (r.value / truth.0 - 1.0).powi(2);
    let square = runs.iter().map(off).sum::<f64>() / n;
    let error = square.sqrt();
    let (_, sigma) = mean(runs);
    Point {
        name: setting.name.clone(),
        gives_up: setting.gives_up.to_owned(),
        cost: runs.iter().map(|r| r.cost).sum::<f64>() / n,
        error,
        // A mean that is off by b ± σ is off by |b| to ± σ; that of the reference adds to it.
        uncertainty: (sigma / truth.0).hypot(truth.1 / truth.0),
        is_default,
    }
}
