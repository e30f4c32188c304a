//! One pilot run: the quantity that it gave and what it cost. A finished pilot is kept, so that a tuning that was stopped goes
//! on where it was.

use crate::clock::Clock;
use crate::progress::Progress;
use crate::trouble::Trouble;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use tsubu::assemble::{Choices, Simulation, Stop, build};
use tsubu::record::write_whole;
use tsubu::scene::Checked;

/// Steps between two looks at the clock and at signals.
const GLANCE: u64 = 64;

/// What a pilot gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The quantity.
    pub value: f64,
    /// Its own uncertainty, 0 if it has none.
    pub uncertainty: f64,
    /// Core-seconds of stepping.
    pub cost: f64,
}

/// How a pilot ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// At its end.
    Well(Outcome),
    /// Refused before it began, or broken on the way.
    Badly(String),
    /// A signal came.
    Stopped,
}

/// Runs a scene for one quantity, or reads what an earlier tuning found in `folder`.
pub fn pilot(
    name: &str,
    checked: &Checked,
    quantity: &str,
    folder: &Path,
    choices: &Choices,
    stopped: &AtomicBool,
) -> Result<Ended, Trouble> {
    let mut hasher = DefaultHasher::new();
    (
        checked.scene.to_resolved_ron(),
        quantity,
        env!("CARGO_PKG_VERSION"),
    )
        .hash(&mut hasher);
    let file = folder.join(format!("{:016x}.csv", hasher.finish()));
    if let Some(ended) = std::fs::read_to_string(&file)
        .ok()
        .and_then(|text| read(&text))
    {
        return Ok(ended);
    }
    let ended = ran(name, checked, quantity, choices, stopped)?;
    if let Some(text) = written(&ended) {
        write_whole(&file, text.as_bytes())?;
    }
    Ok(ended)
}

fn ran(
    name: &str,
    checked: &Checked,
    quantity: &str,
    choices: &Choices,
    stopped: &AtomicBool,
) -> Result<Ended, Trouble> {
    let built = match build(checked, choices) {
        Ok(built) => built,
        Err(error) => return Ok(Ended::Badly(first_line(&error.to_string()))),
    };
    tell!("  {name} …");
    let (mut run, plan) = (built.simulation, built.plan);
    let clock = Clock::of(&checked.scene.output, &plan);
    let mut progress = Progress::new();
    let mut stepping = Duration::ZERO;
    run.look();
    while !run.is_over() {
        let mut due = clock.row - run.steps() % clock.row;
        while due > 0 && !run.is_over() {
            if stopped.load(Ordering::SeqCst) {
                progress.finish();
                return Ok(Ended::Stopped);
            }
            let glance = Instant::now();
            due -= run.advance(due.min(GLANCE)).min(due);
            stepping += glance.elapsed();
            progress.show(&*run, stepping);
        }
        if run.steps() % clock.row == 0 {
            run.look();
        }
    }
    progress.finish();
    if run.stop() != Some(Stop::Over) {
        let why = run
            .stop()
            .map_or(String::new(), |stop| crate::ending::failure(&stop, &plan));
        return Ok(Ended::Badly(first_line(&why)));
    }
    Ok(match reading(&*run, quantity) {
        Some((value, uncertainty)) if value.is_finite() => Ended::Well(Outcome {
            value,
            uncertainty,
            cost: stepping.as_secs_f64() * plan.threads as f64,
        }),
        _ => Ended::Badly(format!("it gave no {quantity}")),
    })
}

/// A quantity of the report and its uncertainty.
pub fn reading(run: &dyn Simulation, quantity: &str) -> Option<(f64, f64)> {
    let report = run.report();
    let found = report.iter().find(|r| r.name == quantity)?;
    Some((found.value, found.uncertainty.unwrap_or(0.0)))
}

/// What a message says in its first line.
pub fn first_line(text: &str) -> String {
    let line = text.lines().next().unwrap_or("it broke");
    line.trim_start_matches("error: ").to_owned()
}

fn written(ended: &Ended) -> Option<String> {
    match ended {
        Ended::Well(o) => Some(format!("{:?},{:?},{:?}\n", o.value, o.uncertainty, o.cost)),
        Ended::Badly(why) => Some(format!("refused: {why}\n")),
        Ended::Stopped => None,
    }
}

fn read(text: &str) -> Option<Ended> {
    if let Some(why) = text.strip_prefix("refused: ") {
        return Some(Ended::Badly(why.trim_end().to_owned()));
    }
    let words: Vec<f64> = text
        .trim()
        .split(',')
        .map(|w| w.parse().ok())
        .collect::<Option<_>>()?;
    let [value, uncertainty, cost] = words[..] else {
        return None;
    };
    Some(Ended::Well(Outcome {
        value,
        uncertainty,
        cost,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_kept_reads_back(value in any::<f64>(), uncertainty in 0.0..1e9f64, cost in 0.0..1e9f64, why in "[a-z ,:]{1,40}") {
            prop_assume!(value.is_finite());
            for ended in [Ended::Well(Outcome { value, uncertainty, cost }), Ended::Badly(why.trim_end().to_owned())] {
                prop_assert_eq!(written(&ended).and_then(|text| read(&text)), Some(ended));
            }
        }
    }
}
