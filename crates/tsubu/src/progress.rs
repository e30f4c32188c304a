//! Progress: a bar where someone watches, a line now and then where the output goes to a file.

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};
use tsubu::assemble::Simulation;

/// Between two lines when there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(20);

/// Shows how far a run is.
pub struct Progress {
    /// Said before everything: which run it is, if there are several.
    label: String,
    bar: Option<ProgressBar>,
    start: Instant,
    last_line: Instant,
}

impl Progress {
    /// Starts to watch.
    pub fn new() -> Self {
        Self::among(&MultiProgress::new(), "")
    }

    /// Starts to watch one of several runs, with its bar among `bars`.
    pub fn among(bars: &MultiProgress, label: &str) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = bars.add(ProgressBar::new(1000));
            if let Ok(style) = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}") {
                bar.set_style(style);
            }
            bar
        });
        Self {
            label: label.to_owned(),
            bar,
            start: Instant::now(),
            last_line: Instant::now(),
        }
    }

    /// After a batch of steps that took `stepping` seconds so far.
    pub fn show(&mut self, run: &dyn Simulation, stepping: Duration) {
        let rate =
            run.grains() as f64 * run.steps() as f64 / stepping.as_secs_f64().max(1e-9) / 1e6;
        let (share, phase) = match run.last_step() {
            Some(last) => {
                let left = last.saturating_sub(run.steps()) as f64 / run.steps().max(1) as f64
                    * self.start.elapsed().as_secs_f64();
                (
                    run.steps() as f64 / last.max(1) as f64,
                    format!("{left:.0} s left"),
                )
            }
            None => (0.0, format!("settling, agitation {:.1e}", run.agitation())),
        };
        let text = format!(
            "{}t = {:.4} s  {rate:.1} M grain-steps/s  {phase}",
            self.label,
            run.time()
        );
        match &self.bar {
            Some(bar) => {
                bar.set_position((1000.0 * share) as u64);
                bar.set_message(text);
            }
            None if self.last_line.elapsed() > LINE_EVERY => {
                self.last_line = Instant::now();
                tell!("{:3.0} %  {text}", 100.0 * share);
            }
            None => {}
        }
    }

    /// Says what comes after the steps, such as drawing.
    pub fn say(&self, what: &str) {
        if let Some(bar) = &self.bar {
            bar.set_message(format!("{}{what}", self.label));
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
