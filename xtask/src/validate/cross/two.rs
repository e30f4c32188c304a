//! One scene in two engines: ours steps beside a dump of the other.

use crate::peers::{Log, Peer};
use crate::validate::scenes::build_on_one_thread;
use glam::DVec3;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use tsubu::dump::{Dump, DumpMoment};
use tsubu::export::{DUMP, INPUT, Target, deck};
use tsubu_assemble::{Choices, Simulation};
use tsubu_scene::Source;

/// A scene, and what the other engine made of it.
pub struct Two {
    /// Ours at the start.
    pub ours: Box<dyn Simulation>,
    /// Δt in s.
    pub dt: f64,
    /// Mass of a grain in kg.
    pub mass: f64,
    /// Diameter of a grain in m.
    pub diameter: f64,
    folder: PathBuf,
    target: Target,
}

impl Two {
    /// Writes the deck of a scene into `target/validate/cross/<name>`, with a frame every so many steps and the deck's text
    /// changed by `edit`.
    pub fn of(
        root: &Path,
        name: &str,
        target: Target,
        source: &Source,
        frames: u64,
        edit: impl Fn(&str) -> String,
    ) -> Result<Self, String> {
        let checked = source.check().map_err(|e| e.to_string())?;
        let choices = Choices {
            threads: Some(1),
            ..Choices::default()
        };
        let mut deck =
            deck(target, &checked, &choices, &|_| Some(frames)).map_err(|e| e.to_string())?;
        for (file, text) in &mut deck.files {
            if file == INPUT {
                *text = edit(text);
            }
        }
        let folder = root.join("target/validate/cross").join(name);
        Peer::write(&deck, &folder)?;
        let built = build_on_one_thread(source)?;
        let kind = built.plan.constants.kind;
        Ok(Self {
            ours: built.simulation,
            dt: built.plan.constants.dt,
            mass: kind.mass,
            diameter: kind.diameter(),
            folder,
            target,
        })
    }

    /// The folder of the deck.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Runs the other engine.
    pub fn run(&self, peer: &Peer, variables: &[(&str, String)]) -> Result<Log, String> {
        let mut all = vec![("digits", "17".to_owned())];
        if self.target == Target::Liggghts {
            all.clear();
        }
        all.extend(variables.iter().cloned());
        peer.run(&self.folder, 1, &all)
    }

    /// Its moments.
    pub fn moments(&self) -> Result<Vec<DumpMoment>, String> {
        let path = self.folder.join(DUMP);
        let file = std::fs::File::open(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Dump::new(BufReader::new(file))
            .collect::<Result<_, _>>()
            .map_err(|e| format!("{}: {e}", path.display()))
    }

    /// Forces in N on the grains in the order of the dump, where the deck was told to write them (see [`with_forces`]).
    pub fn forces(&self) -> Result<Vec<DVec3>, String> {
        let path = self.folder.join(DUMP);
        let text =
            std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let named = text.replacen("fx fy fz", "vx vy vz", 1);
        let first = Dump::new(named.as_bytes()).next();
        let first = first.ok_or_else(|| format!("{} is empty", path.display()))?;
        let first = first.map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(first.atoms.iter().map(|atom| atom.velocity).collect())
    }
}

/// A deck that writes forces in the place of velocities, to the last digit.
pub fn with_forces(deck: &str) -> String {
    deck.replace("vx vy vz", "fx fy fz")
        .replace("%.9g", "%.17g")
}
