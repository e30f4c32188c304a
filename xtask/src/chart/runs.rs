//! One run of a scene with changed settings: what it says of the quantity, and the time of a core it took to step.
//!
//! Finished runs are kept in `target/chart/` under a fingerprint of the physics.

use crate::validate::scenes::{build_on_one_thread, changed, keep};
use std::path::Path;
use std::time::Instant;
use tsubu_assemble::{Simulation, Stop};

/// What a run gave.
#[derive(Clone, Copy, Debug)]
pub struct Ran {
    /// The quantity and its own uncertainty.
    pub value: f64,
    pub uncertainty: f64,
    /// Seconds of one core, looks left out.
    pub cost: f64,
    /// Bytes held per grain.
    pub bytes: f64,
}

/// A scene with changes, and what is asked of it.
#[derive(Clone, Debug)]
pub struct Wanted<'a> {
    /// As progress calls it.
    pub name: String,
    /// The scene's file.
    pub scene: &'a Path,
    /// Its changes.
    pub sets: &'a [String],
    /// The reading.
    pub quantity: &'a str,
    /// Simulated seconds between two looks.
    pub look: f64,
}

impl Wanted<'_> {
    /// The run, from file or made now; `None` if it broke or is refused, with the reason on stderr.
    pub fn ran(&self, file: &Path) -> Result<Option<Ran>, String> {
        if let Some(ran) = std::fs::read_to_string(file).ok().and_then(|t| read(&t)) {
            return Ok(ran);
        }
        let name = &self.name;
        eprintln!("  {name} …");
        let ran = match self.run() {
            Ok(ran) => Some(ran),
            Err(why) => {
                eprintln!("  {name}: {}", why.lines().next().unwrap_or("broke"));
                None
            }
        };
        let text = ran.map_or("broke\n".to_owned(), |r| {
            format!(
                "{:?},{:?},{:?},{:?}\n",
                r.value, r.uncertainty, r.cost, r.bytes
            )
        });
        keep(file, &text)?;
        Ok(ran)
    }

    fn run(&self) -> Result<Ran, String> {
        let built = build_on_one_thread(&changed(self.scene, self.sets)?)?;
        let (mut run, dt) = (built.simulation, built.plan.constants.dt);
        let each = (self.look / dt).round().max(1.0) as u64;
        let mut cost = 0.0;
        run.look();
        while !run.is_over() {
            let clock = Clock::start();
            run.advance(each - run.steps() % each);
            cost += clock.seconds();
            if run.steps() % each == 0 {
                run.look();
            }
        }
        if run.stop() != Some(Stop::Over) {
            return Err(format!("{:?}", run.stop()));
        }
        let reading = reading(&*run, self.quantity)?;
        Ok(Ran {
            value: reading.0,
            uncertainty: reading.1,
            cost,
            bytes: run.bytes_per_grain(),
        })
    }
}

fn reading(run: &dyn Simulation, name: &str) -> Result<(f64, f64), String> {
    let all = run.report();
    let found = all.iter().find(|r| r.name == name);
    found
        .map(|r| (r.value, r.uncertainty.unwrap_or(0.0)))
        .ok_or_else(|| format!("the scene does not measure {name}"))
}

fn read(text: &str) -> Option<Option<Ran>> {
    if text == "broke\n" {
        return Some(None);
    }
    let words: Option<Vec<f64>> = text.trim().split(',').map(|w| w.parse().ok()).collect();
    let [value, uncertainty, cost, bytes] = words?[..] else {
        return None;
    };
    Some(Some(Ran {
        value,
        uncertainty,
        cost,
        bytes,
    }))
}

/// Time that this thread was on a core, where the system tells (Linux); else time that passed.
struct Clock {
    on_core: Option<f64>,
    wall: Instant,
}

impl Clock {
    fn start() -> Self {
        Self {
            on_core: on_core(),
            wall: Instant::now(),
        }
    }

    fn seconds(&self) -> f64 {
        match (self.on_core, on_core()) {
            (Some(from), Some(to)) => to - from,
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

fn on_core() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split(' ').next()?.parse::<f64>().ok()? * 1e-9)
}
