//! The shipped bed with other sizes, constants, readings and steps. Finished runs are kept.

use crate::validate::kept::{Measured, bits_of};
use crate::validate::scenes::{build_anyway, build_on_one_thread, changed};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use tsubu_assemble::Stop;
use tsubu_model::mean_of_runs;
use tsubu_stream::TransportCurve;

/// The shipped scene.
pub const SCENE: &str = "scenarios/movable_bed.ron";

/// Diameter of its grains in mm.
const DIAMETER: f64 = 0.5;

/// Which of the two readings of no tension and of slip: ours or the paper's printed ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Normal forces never pull, friction limits spring and dashpot together.
    NoPull,
    /// Normal forces never pull, friction limits the spring alone.
    NoPullSlipAsPrinted,
    /// Both as printed.
    AsPrinted,
}

/// One bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Diameter in mm.
    pub diameter: f64,
    /// Layers above the fixed row.
    pub layers: u32,
    /// τ*.
    pub shields: f64,
    /// Paper B's β.
    pub beta: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// How the law is read.
    pub reading: Reading,
    /// The height y = 0 stays where it is when the water begins.
    pub frozen_datum: bool,
    /// Step of the run in µs; the constants are those of 20 µs.
    pub step: f64,
    /// Three dimensions.
    pub in_space: bool,
}

impl Bed {
    /// The shipped bed at this Shields number.
    pub fn of(shields: f64) -> Self {
        Self {
            diameter: DIAMETER,
            layers: 10,
            shields,
            beta: 15.8,
            friction: 0.577,
            reading: Reading::NoPull,
            frozen_datum: false,
            step: 3.0,
            in_space: false,
        }
    }

    /// Length of the runs over those of the shipped scene: times of free fall.
    fn slower(&self) -> f64 {
        (self.diameter / DIAMETER).sqrt()
    }

    /// Changes of the shipped scene.
    pub fn sets(&self, seed: u64) -> Vec<String> {
        let (tension, slip) = match self.reading {
            Reading::NoPull => ("NoPull", "Total"),
            Reading::NoPullSlipAsPrinted => ("NoPull", "AsPrinted"),
            Reading::AsPrinted => ("AsPrinted", "AsPrinted"),
        };
        let datum = if self.frozen_datum {
            "Frozen"
        } else {
            "Renewed"
        };
        let mut sets = vec![
            format!("grains.diameter={} mm", self.diameter),
            format!("domain.x=Periodic(\"{} mm\")", 42.8 * self.diameter),
            format!("initial.bed.layers={}", self.layers),
            format!("initial.bed.seed={seed}"),
            format!("grains.law.constants.beta={}", self.beta),
            format!("grains.law.friction={}", self.friction),
            format!("grains.law.tension={tension}"),
            format!("grains.law.slip={slip}"),
            format!("water.shields={}", self.shields),
            format!("water.turbulence=Switched(seed: {seed})"),
            format!("water.datum={datum}"),
            format!("water.begins={} s", 0.4 * self.slower()),
            format!("time.until={} s", 1.6 * self.slower()),
            format!("time.step=Exactly(\"{} us\")", self.step),
            "output.frames=false".to_owned(),
        ];
        if self.in_space {
            sets.push("space=Space".to_owned());
        }
        sets
    }

    fn name(&self, seed: u64) -> String {
        let Self {
            diameter,
            layers,
            shields,
            beta,
            friction,
            reading,
            step,
            ..
        } = self;
        let space = if self.in_space { "-space" } else { "" };
        let frozen = if self.frozen_datum { "-frozen" } else { "" };
        format!(
            "d{diameter}-{layers}layers-tau{shields}-beta{beta}-mu{friction}-{reading:?}-{step}us{frozen}{space}-seed{seed}"
        )
    }
}

/// A mean over seeds.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    /// qB*; NaN if a run broke.
    pub transport: f64,
    /// Standard error: of the seeds' scatter and of each run's own, the larger.
    pub error: f64,
    /// The largest share that a step took of its limit for the packing as it lay.
    pub over_limit: f64,
    /// Runs that broke.
    pub broken: usize,
}

impl Mean {
    /// Over Meyer-Peter and Müller's.
    pub fn over_theory(&self, shields: f64) -> (f64, f64) {
        let theory = meyer_peter_mueller(shields);
        (self.transport / theory, self.error / theory)
    }
}

/// Meyer-Peter and Müller's qB*.
pub fn meyer_peter_mueller(shields: f64) -> f64 {
    TransportCurve::MEYER_PETER_MULLER
        .transport(shields)
        .unwrap_or(f64::NAN)
}

/// Where runs are kept.
pub struct Beds<'a> {
    root: &'a Path,
    print: u64,
}

impl<'a> Beds<'a> {
    /// The runs of the code as it is.
    pub fn new(root: &'a Path) -> Result<Self, String> {
        let bed = Bed {
            step: 1.0,
            ..Bed::of(0.5)
        };
        let mut source = changed(&root.join(SCENE), &bed.sets(1))?;
        source.set("water.begins=2 ms").map_err(|e| e.to_string())?;
        let mut run = build_on_one_thread(&source)?.simulation;
        run.advance(4000);
        let print = bits_of(&mut *run);
        Ok(Self { root, print })
    }

    fn file(&self, name: &str) -> PathBuf {
        let print = self.print;
        self.root
            .join(format!("target/validate/bedload/{print:016x}-{name}.csv"))
    }

    /// What one run measured.
    pub fn one(&self, bed: &Bed, seed: u64) -> Result<Measured, String> {
        let file = self.file(&bed.name(seed));
        match Measured::kept(&file) {
            Some(measured) => Ok(measured),
            None => {
                eprintln!("  bed {} …", bed.name(seed));
                let source = changed(&self.root.join(SCENE), &bed.sets(seed))?;
                Measured::of_unstable_run(&source, &file, 2e-3 * bed.slower())
            }
        }
    }

    /// Root mean square speed over √(g d) in the last quarter of a rest of 0.4 s without water; NaN if the run broke.
    pub fn agitation(&self, bed: &Bed) -> Result<f64, String> {
        let mut sets = bed.sets(1);
        sets.extend([
            "water.begins=100 s".to_owned(),
            format!("time.until={} s", 0.4 * bed.slower()),
        ]);
        let source = changed(&self.root.join(SCENE), &sets)?;
        let mut run = build_anyway(&source)?.simulation;
        let looks = 100;
        let each = (0.4e6 * bed.slower() / bed.step / f64::from(looks)).max(1.0) as u64;
        let (mut sum, mut grains) = (0.0, 0.0);
        for look in 0..looks {
            run.advance(each);
            if look >= looks * 3 / 4 {
                let state = run.state();
                sum += state.iter().map(|(_, v)| v.length_squared()).sum::<f64>();
                grains += state.len() as f64;
            }
        }
        let broken = run.stop().is_some_and(|stop| stop != Stop::Over);
        let mean = if broken { f64::NAN } else { sum / grains };
        Ok((mean / (9.80665 * bed.diameter * 1e-3)).sqrt())
    }

    /// Each bed over this many seeds.
    pub fn means(&self, beds: &[Bed], seeds: u64) -> Result<Vec<Mean>, String> {
        let runs: Vec<(Bed, u64)> = beds
            .iter()
            .flat_map(|bed| (1..=seeds).map(|seed| (*bed, seed)))
            .collect();
        let all: Vec<Measured> = runs
            .par_iter()
            .map(|(bed, seed)| self.one(bed, *seed))
            .collect::<Result<_, _>>()?;
        Ok(all.chunks(seeds as usize).map(mean).collect())
    }
}

fn mean(runs: &[Measured]) -> Mean {
    let broken = runs.iter().filter(|m| m.get("broken").0 == 1.0).count();
    let values: Vec<_> = runs
        .iter()
        .map(|m| m.get("transport"))
        .map(|(value, own)| (value, Some(own)))
        .collect();
    let (mean, error) = mean_of_runs(&values);
    let used = runs.iter().map(|m| m.get("step_over_limit").0);
    Mean {
        transport: if broken > 0 { f64::NAN } else { mean },
        error: error.unwrap_or(f64::NAN),
        over_limit: used.fold(f64::NAN, f64::max),
        broken,
    }
}
