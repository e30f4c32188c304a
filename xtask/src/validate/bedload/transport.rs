//! The movable bed: transport over Shields numbers, readings, β and steps.

use crate::validate::check::Tolerance;
use crate::validate::kept::{Measured, bits_of};
use crate::validate::report::Report;
use crate::validate::scenes::{build_on_one_thread, changed};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use tsubu_picture::Figure;
use tsubu_stream::TransportCurve;

const SCENE: &str = "scenarios/movable_bed.ron";

/// Grain-steps of the long version: some fifty runs of 400 grains and half a million steps.
pub const FULL_GRAIN_STEPS: f64 = 1.4e10;

/// Seeds of bed and turbulence of each case.
const SEEDS: [u64; 2] = [1, 2];
/// Shields numbers of the figure.
const SHIELDS: [f64; 5] = [0.1, 0.2, 0.5, 1.0, 1.5];

/// One bed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Case {
    shields: f64,
    beta: f64,
    /// The paper's printed reading of no tension, and of slip.
    pulls: bool,
    printed_slip: bool,
    /// µs.
    step: f64,
    seed: u64,
}

impl Case {
    fn of(shields: f64) -> Self {
        Self {
            shields,
            beta: 15.8,
            pulls: false,
            printed_slip: false,
            step: 3.0,
            seed: 1,
        }
    }

    fn sets(&self) -> Vec<String> {
        let reading = |printed: bool, other: &str| {
            if printed {
                "AsPrinted".to_owned()
            } else {
                other.to_owned()
            }
        };
        vec![
            format!("water.shields={}", self.shields),
            format!("grains.law.constants.beta={}", self.beta),
            format!("grains.law.tension={}", reading(self.pulls, "NoPull")),
            format!("grains.law.slip={}", reading(self.printed_slip, "Total")),
            format!("time.step=Exactly(\"{} us\")", self.step),
            format!("initial.bed.seed={}", self.seed),
            format!("water.turbulence=Switched(seed: {})", self.seed),
            "output.frames=false".to_owned(),
        ]
    }

    fn file(&self, root: &Path, print: u64) -> PathBuf {
        let Case {
            shields,
            beta,
            step,
            seed,
            ..
        } = self;
        let readings = format!(
            "{}{}",
            if self.pulls { "-pulls" } else { "" },
            if self.printed_slip { "-slip" } else { "" }
        );
        root.join(format!(
            "target/validate/bedload/{print:016x}-tau{shields}-beta{beta}{readings}-{step}us-seed{seed}.csv"
        ))
    }

    fn measured(&self, root: &Path, print: u64) -> Result<Measured, String> {
        let file = self.file(root, print);
        match Measured::kept(&file) {
            Some(measured) => Ok(measured),
            None => {
                eprintln!("  bed {self:?} …");
                let source = changed(&root.join(SCENE), &self.sets())?;
                Measured::of_unstable_run(&source, &file, 2e-3)
            }
        }
    }
}

/// Mean over the seeds with its standard error: of the seeds' scatter and of each run's own, the larger.
fn over_seeds(report: &Report, print: u64, case: Case) -> Result<(f64, f64), String> {
    let root = report.root();
    let all: Vec<Measured> = SEEDS
        .par_iter()
        .map(|&seed| Case { seed, ..case }.measured(root, print))
        .collect::<Result<_, _>>()?;
    let values: Vec<(f64, f64)> = all.iter().map(|m| m.get("transport")).collect();
    let n = values.len() as f64;
    let mean = values.iter().map(|v| v.0).sum::<f64>() / n;
    let scatter = values.iter().map(|v| (v.0 - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
    let own = values.iter().map(|v| v.1 * v.1).sum::<f64>() / (n * n);
    Ok((mean, scatter.max(own).sqrt()))
}

fn theory(shields: f64) -> f64 {
    TransportCurve::MEYER_PETER_MULLER
        .transport(shields)
        .unwrap_or(f64::NAN)
}

/// The shipped bed in short; with `--full` the readings over Shields numbers.
pub fn run(report: &mut Report) -> Result<(), String> {
    let root = report.root().to_owned();
    let sets = Case {
        step: 1.0,
        ..Case::of(0.5)
    }
    .sets();
    let mut source = changed(&root.join(SCENE), &sets)?;
    source.set("water.begins=2 ms").map_err(|e| e.to_string())?;
    let mut run = build_on_one_thread(&source)?.simulation;
    run.advance(4000);
    let print = bits_of(&mut *run);
    // τ* = 0.5, the paper's choice of constants.
    let (transport, error) = over_seeds(report, print, Case::of(0.5))?;
    report.beside(
        "no_pull, β = 15.8, τ* = 0.5, Δt = 3 µs: qB*, two seeds",
        theory(0.5),
        transport,
        &format!("expected: Meyer-Peter and Müller; ± {error:.3}"),
    );
    report.progress("the shipped bed");
    if !report.full() {
        return Ok(());
    }
    let half = over_seeds(
        report,
        print,
        Case {
            step: 1.5,
            ..Case::of(0.5)
        },
    )?;
    report.check(
        "no_pull, β = 15.8, τ* = 0.5: qB* at Δt = 3 µs over that at 1.5 µs",
        1.0,
        transport / half.0,
        Tolerance::Absolute(3.0 * (error / transport).hypot(half.1 / half.0)),
        "converged in the step: three standard errors of two seeds each",
    );
    report.check(
        "no_pull, β = 15.8, τ* = 0.5: qB* over Meyer-Peter and Müller's",
        1.0,
        half.0 / theory(0.5),
        Tolerance::Absolute(0.2),
        "as asked; at the smaller step",
    );
    let readings = [
        ("no_pull, β = 15.8", Case::of(0.5)),
        (
            "no_pull, β = 15.8, slip as printed",
            Case {
                printed_slip: true,
                ..Case::of(0.5)
            },
        ),
        (
            "no_pull, β = 1",
            Case {
                beta: 1.0,
                ..Case::of(0.5)
            },
        ),
        (
            "as_printed, β = 1",
            Case {
                beta: 1.0,
                pulls: true,
                printed_slip: true,
                ..Case::of(0.5)
            },
        ),
    ];
    let x: Vec<f64> = (0..=60).map(|k| 0.05 * 1.06f64.powi(k)).collect();
    let curve = |c: TransportCurve| -> Vec<f64> {
        x.iter()
            .map(|&s| c.transport(s).unwrap_or(f64::NAN))
            .collect()
    };
    let mut figure = Figure::new(
        "Transport of a bed of 0.5 mm sand, converged in the step",
        "Shields number τ* (–)",
        "transport qB* (–)",
    )
    .log_x()
    .log_y()
    .theory(
        "Meyer-Peter & Müller 1948",
        &x,
        &curve(TransportCurve::MEYER_PETER_MULLER),
    )
    .theory(
        "Wong & Parker 2006",
        &x,
        &curve(TransportCurve::WONG_PARKER),
    );
    for (name, base) in readings {
        let (mut y, mut e) = (Vec::new(), Vec::new());
        for shields in SHIELDS {
            let (mean, error) = over_seeds(report, print, Case { shields, ..base })?;
            report.beside(
                format!("{name}, τ* = {shields}: qB*"),
                theory(shields),
                mean,
                &format!("expected: Meyer-Peter and Müller; ± {error:.3}"),
            );
            y.push(mean);
            e.push(error);
        }
        figure = figure.points(name, &SHIELDS, &y, Some(&e));
        report.progress(name);
    }
    report.figure("bedload_transport", figure)
}
