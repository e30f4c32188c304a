//! One heap after another: runs of the shipped scene with other levels, dampings and seeds.
//!
//! A finished run is kept in `target/validate/repose/`, so that the long version can be stopped and
//! taken up again. Its name holds a fingerprint of the physics (the bits of a short run), so a
//! change of the code or of the scene starts anew.

use crate::validate::scenes::{
    build_on_one_thread, changed, from_places, keep, places, until_released,
};
use std::fmt::Write as _;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use tsubu_assemble::Simulation;
use tsubu_scene::Source;

/// Between two samples, s.
pub const EVERY: f64 = 0.02;

/// One run: the shipped scene with these changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Coarse level n.
    pub coarse: u32,
    /// Damping over paper A's.
    pub gamma: f64,
    /// Stiffness divided by this.
    pub soften: f64,
    /// Seed of the fill.
    pub seed: u64,
    /// Seconds after the removal of the wall.
    pub until: f64,
    /// What the wall holds back.
    pub bed: Bed,
}

/// The bed from which a heap starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bed {
    /// Filled at random and settled with the case's own stiffness.
    Own,
    /// Settled by the same seed at this softening: what is compared is then the run-out alone.
    /// From stiff to soft, since a soft bed's overlaps would shoot stiff grains apart.
    SettledAt(u32),
}

/// What is sampled, in this order.
pub const COLUMNS: [&str; 6] = [
    "front",
    "crest_height",
    "centre_x",
    "centre_z",
    "angle_runout",
    "angle_flank",
];

/// A history: row `k` is `k × EVERY` after the removal of the wall.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Values by row, in the order of [`COLUMNS`].
    pub rows: Vec<[f64; COLUMNS.len()]>,
    /// Diameter of the coarse grain, m.
    pub diameter: f64,
    /// Number of grains.
    pub grains: usize,
    /// Energy that the books miss over the energy that went through them.
    pub budget: f64,
}

impl History {
    /// Column by name.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = COLUMNS.iter().position(|c| *c == name).unwrap_or(0);
        self.rows.iter().map(|r| r[at]).collect()
    }
}

impl Case {
    /// The source of the scene with the changes of this case.
    pub fn source(&self, root: &Path) -> Result<Source, String> {
        let sets = [
            format!("grains.coarse={}", self.coarse),
            format!("grains.law.damping=Equal(\"{} kg/s\")", 0.1257 * self.gamma),
            format!("grains.soften={}", self.soften),
            format!("initial.fill.seed={}", self.seed),
            format!("still.kinetic_energy={:e}", self.still()),
            "still.damping=1".to_owned(),
            // More damping needs a shorter step: K + 2C of a packing stays below 4.
            format!("time.step=PerPeriod({})", 20.0 * self.gamma.max(1.0)),
            "still.at_most=20 s".to_owned(),
            format!("time.until={} s", self.until),
            // The books are looked at where heaps are cheap; at n = 1 the tally would cost minutes.
            format!("output.energies={}", self.coarse > 1),
        ];
        changed(&root.join("scenarios/angle_of_repose.ron"), &sets)
    }

    /// The source that runs out from a bed on file.
    fn source_from(&self, root: &Path, bed: &Path) -> Result<Source, String> {
        let mut source = self.source(root)?;
        for set in from_places(self.coarse, 0.1257 * self.gamma, bed) {
            source.set(&set).map_err(|e| e.to_string())?;
        }
        Ok(source)
    }

    /// The bed at the moment its wall would go: a file of places, made once.
    fn bed_at(&self, soften: u32, root: &Path, fingerprint: u64) -> Result<PathBuf, String> {
        let stiff = Case {
            soften: f64::from(soften),
            bed: Bed::Own,
            until: EVERY,
            ..*self
        };
        let file = stiff.file(root, fingerprint);
        if !file.exists() {
            let mut run = build_on_one_thread(&stiff.source(root)?)?.simulation;
            until_released(&mut *run)?;
            keep(&file, &places(&*run))?;
        }
        Ok(file)
    }

    /// Kinetic energy per grain over m g d at which the wall goes. Creep to rest is a function of
    /// t/(λγ), so its speed is ∝ 1/(λγ) at a given compaction and the energy over m g d ∝ 1/(λ³γ²):
    /// with this rule every case is released from a bed of the same compaction. A denser bed is far
    /// stiffer (its viscosity diverges at close packing), so unequal beds would hide what is compared.
    fn still(&self) -> f64 {
        let lambda = f64::from(1u32 << self.coarse);
        0.128 / (lambda.powi(3) * self.gamma * self.gamma)
    }

    fn file(&self, root: &Path, fingerprint: u64) -> PathBuf {
        let Case {
            coarse,
            gamma,
            soften,
            seed,
            until,
            bed,
        } = self;
        root.join(format!("target/validate/repose/{fingerprint:016x}-n{coarse}-g{gamma}-s{soften}-t{until}-{bed:?}-{seed}.csv"))
    }

    /// The history, from the folder of finished runs or run now.
    pub fn history(&self, root: &Path, fingerprint: u64) -> Result<History, String> {
        let file = self.file(root, fingerprint);
        if let Some(history) = std::fs::read_to_string(&file)
            .ok()
            .and_then(|text| read(&text))
        {
            return Ok(history);
        }
        let source = match self.bed {
            Bed::Own => self.source(root)?,
            Bed::SettledAt(soften) => {
                self.source_from(root, &self.bed_at(soften, root, fingerprint)?)?
            }
        };
        let history = self.run(&source)?;
        let mut text = format!(
            "{:?},{},{:?}\n",
            history.diameter, history.grains, history.budget
        );
        for row in &history.rows {
            let words: Vec<String> = row.iter().map(|v| format!("{v:?}")).collect();
            let _ = writeln!(text, "{}", words.join(","));
        }
        keep(&file, &text)?;
        Ok(history)
    }

    fn run(&self, source: &Source) -> Result<History, String> {
        let built = build_on_one_thread(source)?;
        let (mut run, dt) = (built.simulation, built.plan.constants.dt);
        let released = until_released(&mut *run)?;
        let mut history = History {
            diameter: 2.0 * built.plan.constants.kind.radius,
            grains: run.grains(),
            ..History::default()
        };
        let rows = (self.until / EVERY).round() as usize;
        for k in 0..=rows {
            let due = ((released + k as f64 * EVERY) / dt).round() as u64;
            run.advance(due.saturating_sub(run.steps()));
            history.rows.push(sample(&mut *run));
        }
        let budget = run
            .report()
            .iter()
            .find(|r| r.name == "energy_budget_error")
            .map(|r| r.value);
        history.budget = budget.unwrap_or(f64::NAN);
        Ok(history)
    }
}

fn sample(run: &mut dyn Simulation) -> [f64; COLUMNS.len()] {
    let readings = run.look();
    COLUMNS.map(|name| {
        readings
            .iter()
            .find(|r| r.name == name)
            .map_or(f64::NAN, |r| r.value)
    })
}

fn read(text: &str) -> Option<History> {
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next()?.split(',').collect();
    let rows = lines
        .map(|line| {
            let values: Vec<f64> = line
                .split(',')
                .map(str::parse)
                .collect::<Result<_, _>>()
                .ok()?;
            values.try_into().ok()
        })
        .collect::<Option<Vec<_>>>()?;
    Some(History {
        rows,
        diameter: head.first()?.parse().ok()?,
        grains: head.get(1)?.parse().ok()?,
        budget: head.get(2)?.parse().ok()?,
    })
}

/// The bits of a short run of the scene: they change with its physics, the laws and the engine, not with its outputs.
pub fn fingerprint(root: &Path) -> Result<u64, String> {
    let case = Case {
        coarse: 3,
        gamma: 1.0,
        soften: 100.0,
        seed: 1,
        until: 0.1,
        bed: Bed::Own,
    };
    let mut run = build_on_one_thread(&case.source(root)?)?.simulation;
    run.advance(20_000);
    let mut hasher = DefaultHasher::new();
    for (x, v) in run.state() {
        for value in x.to_array().into_iter().chain(v.to_array()) {
            value.to_bits().hash(&mut hasher);
        }
    }
    // What this suite reads, and no more: another measure in the row is no other physics.
    for value in sample(&mut *run) {
        value.to_bits().hash(&mut hasher);
    }
    Ok(hasher.finish())
}
