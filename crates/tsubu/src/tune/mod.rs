//! `tsubu tune`: the cheapest settings of a scene that keep a quantity within a tolerance of a converged run of it.
//!
//! No optimiser: a reference, then settings of one knob or two, cheapest first, until one holds with another seed too.

mod knobs;
mod pilot;
mod report;
mod verdict;

use crate::arguments::TuneWish;
use crate::run::{choices, read_source, stem, until_signal};
use crate::trouble::Trouble;
use knobs::Notch;
use pilot::{Ended, Outcome, pilot, reading};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use tsubu::assemble::{Choices, build};
use tsubu::scene::{Scene, Source};
use verdict::{Mean, Verdict, mean, off, verdict};

/// Seeds of the pilots. The scene's own seed is one of its settings and is not used: a tuned scene is to hold with any.
const SEEDS: [u64; 4] = [101, 102, 103, 104];

/// A setting that was tried.
pub struct Tried {
    notch: Notch,
    /// Mean over the seeds so far; what went wrong if it did.
    mean: Result<Mean, String>,
    runs: usize,
    within: bool,
}

/// All that a tuning needs to know.
struct Tuning<'a> {
    source: Source,
    quantity: &'a str,
    tolerance: f64,
    pilots: PathBuf,
    choices: Choices,
    stopped: &'a AtomicBool,
    /// Runs with another seed differ.
    has_seed: bool,
}

/// `tsubu tune`.
pub fn tune(wish: &TuneWish) -> Result<u8, Trouble> {
    let start = Instant::now();
    let source = read_source(&wish.scene)?;
    let checked = source.check()?;
    let out = wish
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("out/{}-tune", stem(&wish.scene))));
    let choices = choices(&wish.scene, Some(&out));
    quantity_is_there(&wish.quantity, build(&checked, &choices)?)?;
    let knobs = knobs::knobs(&checked.scene, is_steady(&checked.scene));
    let reference = knobs::reference(&knobs, wish.reference_cost).ok_or_else(|| {
        Trouble::Arguments(format!(
            "no finer run of this scene costs at most {} times as much\nhelp: raise --reference-cost",
            wish.reference_cost
        ))
    })?;
    let stopped = until_signal();
    let pilots = out.join("pilots");
    std::fs::create_dir_all(&pilots).map_err(|cause| {
        Trouble::Machine(format!(
            "the folder {} could not be made: {cause}",
            pilots.display()
        ))
    })?;
    let tuning = Tuning {
        has_seed: checked.scene.clone().reseed(SEEDS[0]),
        source,
        quantity: &wish.quantity,
        tolerance: wish.tolerance.0,
        pilots,
        choices,
        stopped: &stopped,
    };
    tell!(
        "{}: looking for the cheapest settings that keep {} within {:.3} %; pilots are kept in {}",
        checked.scene.title,
        wish.quantity,
        100.0 * wish.tolerance.0,
        tuning.pilots.display()
    );
    tell!(
        "reference: {} (about {:.1} times the cost of the scene)",
        reference.words,
        reference.cost
    );
    let Some(truth) = tuning.truth(&reference)? else {
        return stop(&out);
    };
    let mut tried = Vec::new();
    for notch in knobs::candidates(&knobs) {
        let Some(one) = tuning.tried(notch, truth)? else {
            return stop(&out);
        };
        tell!("{}", report::line(&one, truth));
        let found = one.within;
        tried.push(one);
        if found {
            break;
        }
    }
    report::write(
        &out,
        &tuning,
        &reference,
        truth,
        &tried,
        &wish.scene.scene,
        start.elapsed(),
    )?;
    Ok(0)
}

fn stop(out: &std::path::Path) -> Result<u8, Trouble> {
    tell!(
        "stopped by a signal; finished pilots are kept: the same command goes on from them (--out {})",
        out.display()
    );
    Ok(130)
}

/// A mean over time, which a longer run knows better: what a conveyor or a river bed gives.
fn is_steady(scene: &Scene) -> bool {
    scene.water.is_some() || scene.measures.conveying.is_some()
}

fn quantity_is_there(quantity: &str, mut built: tsubu::assemble::Built) -> Result<(), Trouble> {
    built.simulation.look();
    if reading(&*built.simulation, quantity).is_some() {
        return Ok(());
    }
    let report = built.simulation.report();
    let names: Vec<&str> = report.iter().map(|r| r.name.as_ref()).collect();
    Err(Trouble::Arguments(format!(
        "this scene does not measure `{quantity}`\nhelp: it measures {}",
        names.join(", ")
    )))
}

impl Tuning<'_> {
    /// The setting with this seed.
    fn run(&self, notch: &Notch, seed: u64) -> Result<Ended, Trouble> {
        let mut checked = match knobs::turned(&self.source, notch).and_then(|s| s.check()) {
            Ok(checked) => checked,
            Err(error) => return Ok(Ended::Badly(pilot::first_line(&error.to_string()))),
        };
        checked.scene.reseed(seed);
        let name = format!("{}, seed {seed}", notch.words);
        pilot(
            &name,
            &checked,
            self.quantity,
            &self.pilots,
            &self.choices,
            self.stopped,
        )
    }

    /// The reference, over two seeds; `None` after a signal.
    fn truth(&self, reference: &Notch) -> Result<Option<Mean>, Trouble> {
        let mut runs = Vec::new();
        for &seed in SEEDS.iter().take(if self.has_seed { 2 } else { 1 }) {
            match self.run(reference, seed)? {
                Ended::Well(outcome) => runs.push(outcome),
                Ended::Stopped => return Ok(None),
                Ended::Badly(why) => {
                    return Err(Trouble::Physics(format!(
                        "the reference ({}) did not run: {why}\nhelp: make the scene itself run, or lower --reference-cost",
                        reference.words
                    )));
                }
            }
        }
        Ok(Some(mean(&runs)))
    }

    /// A setting: one seed, and more while nothing can be said or while it holds; `None` after a signal.
    fn tried(&self, notch: Notch, truth: Mean) -> Result<Option<Tried>, Trouble> {
        let mut runs: Vec<Outcome> = Vec::new();
        let bad = |notch, why, runs| Tried {
            notch,
            mean: Err(why),
            runs,
            within: false,
        };
        let seeds = if self.has_seed { SEEDS.len() } else { 1 };
        for (k, &seed) in SEEDS.iter().take(seeds).enumerate() {
            match self.run(&notch, seed)? {
                Ended::Well(outcome) => runs.push(outcome),
                Ended::Stopped => return Ok(None),
                Ended::Badly(why) => return Ok(Some(bad(notch, why, k))),
            }
            let said = verdict(mean(&runs), truth, self.tolerance);
            // One run that holds is not believed until another does.
            let enough = runs.len() >= 2 || !self.has_seed;
            if said == Verdict::Beyond || (said == Verdict::Within && enough) {
                break;
            }
        }
        let all = mean(&runs);
        Ok(Some(Tried {
            notch,
            mean: Ok(all),
            runs: runs.len(),
            within: verdict(all, truth, self.tolerance) == Verdict::Within,
        }))
    }
}

/// How far a setting is off and its standard error, if it ran.
fn distance(tried: &Tried, truth: Mean) -> Option<(f64, f64)> {
    tried.mean.as_ref().ok().map(|&m| off(m, truth))
}
