//! Rates: ours by advancing one world, another engine's by running its deck.

use super::cases::Case;
use super::yade;
use crate::peers::{Engine, Peer};
use crate::validate::scenes::build_on;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tsubu::export::{Target, deck};
use tsubu_assemble::{Choices, Simulation};

/// Grain-steps of one of our measurements, and of one of another engine's.
const OURS: f64 = 3e7;
const THEIRS: f64 = 1e7;
/// Skins that another engine is tried with, over the diameter.
const SKINS: [f64; 4] = [0.03, 0.08, 0.2, 0.4];

fn steps(of: f64, grains: usize) -> u64 {
    ((of / grains as f64) as u64).clamp(20, 20_000)
}

/// Our engine.
pub struct Ours {
    run: Box<dyn Simulation>,
    grains: usize,
}

impl Ours {
    /// Ready to be measured, its skin adapted.
    pub fn of(case: &Case, threads: usize) -> Result<Self, String> {
        let mut run = build_on(&case.source, threads)?.simulation;
        run.advance(50);
        Ok(Self {
            run,
            grains: case.grains,
        })
    }

    /// Million grain-steps per second.
    pub fn rate(&mut self) -> Result<f64, String> {
        let steps = steps(OURS, self.grains);
        let start = Instant::now();
        let taken = self.run.advance(steps);
        let seconds = start.elapsed().as_secs_f64();
        if taken < steps {
            return Err(format!("our run stopped: {:?}", self.run.stop()));
        }
        Ok(taken as f64 * self.grains as f64 / seconds / 1e6)
    }
}

/// Another engine with the deck of a case.
pub struct Theirs<'a> {
    peer: &'a Peer,
    folder: PathBuf,
    grains: usize,
    threads: usize,
    skin: f64,
}

impl<'a> Theirs<'a> {
    /// Its deck written and its best skin found; `None` if it is not asked for this scene.
    pub fn of(
        root: &Path,
        case: &Case,
        threads: usize,
        peer: &'a Peer,
    ) -> Result<Option<Self>, String> {
        if !case.engines.contains(&peer.engine) {
            return Ok(None);
        }
        let name = format!(
            "{}_{}_{}_{}",
            peer.engine.name(),
            case.scene,
            case.law,
            case.grains
        );
        let mut made = Self {
            peer,
            folder: root.join("target/bench").join(name),
            grains: case.grains,
            threads,
            skin: 0.0,
        };
        let target = match peer.engine {
            Engine::Lammps => Target::Lammps,
            Engine::Liggghts => Target::Liggghts,
            Engine::Yade if case.grains > yade::MOST => return Ok(None),
            Engine::Yade => {
                yade::write(&made.folder, case)?;
                return Ok(Some(made));
            }
        };
        let checked = case.source.check().map_err(|e| e.to_string())?;
        // Frames cost time that is not the engine's.
        let deck = deck(target, &checked, &Choices::default(), &|_| None);
        Peer::write(&deck.map_err(|e| e.to_string())?, &made.folder)?;
        let diameter = checked.scene.grains.diameter;
        let mut best = (0.0, 0.0);
        for share in SKINS {
            made.skin = share * diameter;
            let rate = made.rate()?;
            if rate > best.0 {
                best = (rate, made.skin);
            }
        }
        made.skin = best.1;
        Ok(Some(made))
    }

    /// Which engine.
    pub fn engine(&self) -> Engine {
        self.peer.engine
    }

    /// Million grain-steps per second.
    pub fn rate(&self) -> Result<f64, String> {
        let steps = steps(THEIRS, self.grains);
        let grain_steps = steps as f64 * self.grains as f64;
        let seconds = if self.peer.engine == Engine::Yade {
            // A tenth as fast as the others: a tenth of the steps.
            let steps = (steps / 8).max(20);
            let seconds = yade::seconds(self.peer, &self.folder, self.threads, steps)?;
            return Ok(steps as f64 * self.grains as f64 / seconds / 1e6);
        } else {
            let variables = [
                ("steps", steps.to_string()),
                ("skin", format!("{:?}", self.skin)),
            ];
            let log = self.peer.run(&self.folder, self.threads, &variables)?;
            log.loop_time()
                .ok_or_else(|| format!("{} printed no loop time", self.peer.engine.name()))?
        };
        Ok(grain_steps / seconds / 1e6)
    }
}
