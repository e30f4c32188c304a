//! One run of the feeder after another: the shipped scene with other levels, speeds, stiffnesses and screws.
//!
//! The bed is settled once for each level and started from file; a finished run is kept in
//! `target/validate/screw/`, so that the long version can be stopped and taken up again. Its name holds a
//! fingerprint of the physics, so a change of the code, of the scene or of its meshes starts anew.

use crate::validate::scenes::{
    build_on_one_thread, changed, from_places, keep, places, until_released,
};
use std::fmt::Write as _;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use tsubu_scene::Source;

/// What the screw is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The shipped grid of distances.
    Grid,
    /// The triangles of the same file.
    Triangles,
    /// The analytic surface.
    Analytic,
}

impl Kind {
    /// The shape as a scene says it.
    pub fn shape(self) -> &'static str {
        match self {
            Kind::Grid => {
                "Mesh(file: \"meshes/screw.stl\", unit: \"mm\", surface: Grid(cell: \"2 mm\"))"
            }
            Kind::Triangles => "Mesh(file: \"meshes/screw.stl\", unit: \"mm\", surface: Exact)",
            Kind::Analytic => {
                "Screw(from: (\"0 mm\", \"0 mm\", \"0 mm\"), to: (\"675 mm\", \"0 mm\", \"0 mm\"), shaft: \"55 mm\", outer: \"205 mm\", pitch: \"150 mm\", thickness: \"6 mm\")"
            }
        }
    }
}

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Coarse level n.
    pub coarse: u32,
    /// Turns per minute.
    pub rpm: f64,
    /// Stiffness divided by this.
    pub soften: f64,
    /// Tangential damping between grains over paper A's.
    pub tangential: f64,
    /// Friction of screw, casing and hopper.
    pub friction: f64,
    /// Grains touch walls at their centres (the literal reading), not at their surface.
    pub at_centres: bool,
    /// Solid fraction of the random fill, before it falls.
    pub fill: f64,
    /// What the screw is made of.
    pub kind: Kind,
}

/// What a run measured: name, value, uncertainty (NaN if there is none).
#[derive(Clone, Debug)]
pub struct Measured(Vec<(String, f64, f64)>);

impl Measured {
    /// Value and uncertainty by name; NaN if it was not measured.
    pub fn get(&self, name: &str) -> (f64, f64) {
        self.0
            .iter()
            .find(|r| r.0 == name)
            .map_or((f64::NAN, f64::NAN), |r| (r.1, r.2))
    }
}

impl Case {
    /// The shipped scene at a level and a speed.
    pub fn of(coarse: u32, rpm: f64) -> Self {
        Self {
            coarse,
            rpm,
            soften: 100.0,
            tangential: 1.0,
            friction: 0.413,
            at_centres: false,
            fill: FILL,
            kind: Kind::Grid,
        }
    }

    /// The same with grains that touch walls at their centres. Their room is a radius narrower all round, so no more
    /// than this can be placed at random.
    pub fn touching_at_centres(self) -> Self {
        Self {
            at_centres: true,
            fill: 0.26,
            ..self
        }
    }

    /// How the walls are read and how many grains there are, as names of files say it.
    fn place(&self) -> String {
        let place = if self.at_centres { "centre" } else { "surface" };
        if self.fill == FILL {
            return place.to_owned();
        }
        format!("{place}-{}", self.fill)
    }

    /// Seconds from the start of the screw: until the tube is full (its length over p n, a tenth slower),
    /// then four turns (three where they are slow), since the rate swings once a turn, and one second for
    /// grains to fall out. From a full tube: one turn to become even, then as many turns.
    pub fn until(&self) -> f64 {
        let turns = if self.rpm < 50.0 { 3.0 } else { 4.0 };
        match self.flow() {
            Some(_) => 60.0 * (1.0 + turns) / self.rpm + 0.1,
            None => (103.0 + 60.0 * turns) / self.rpm + 1.0,
        }
    }

    /// The run in whose flow this one starts, where runs are long: the same feeder at 60 r/min. Its tube is
    /// full, its screw where it was at the start; the grains start at rest.
    fn flow(&self) -> Option<Self> {
        (self.coarse < 4 && self.rpm != 60.0).then_some(Self { rpm: 60.0, ..*self })
    }

    fn sets(&self) -> Vec<String> {
        let mut sets = vec![
            format!("grains.coarse={}", self.coarse),
            format!("grains.soften={}", self.soften),
            format!("walls.screw.shape={}", self.kind.shape()),
            format!("walls.screw.motion.turn.rate=-{} rpm", self.rpm),
            format!("time.until={} s", self.until()),
            "still.at_most=10 s".to_owned(),
        ];
        if self.fill != FILL {
            sets.push(format!("initial.fill.solid_fraction={}", self.fill));
        }
        let centre = if self.at_centres { "Centre" } else { "Surface" };
        for wall in ["screw", "casing", "hopper"] {
            sets.push(format!("walls.{wall}.friction={}", self.friction));
            sets.push(format!("walls.{wall}.touches_at={centre}"));
        }
        sets
    }

    fn file(&self, root: &Path, fingerprint: u64, what: &str) -> PathBuf {
        let Case {
            coarse,
            rpm,
            soften,
            tangential,
            friction,
            kind,
            ..
        } = self;
        let place = self.place();
        root.join(format!(
            "target/validate/screw/{fingerprint:016x}-n{coarse}-{rpm}rpm-s{soften}-t{tangential}-mu{friction}-{place}-{kind:?}-{:.2}s{what}.csv",
            self.until()
        ))
    }

    /// Places of the settled grains, made once for each level and reading of the walls.
    fn bed(&self, root: &Path, fingerprint: u64) -> Result<PathBuf, String> {
        let file = root.join(format!(
            "target/validate/screw/{fingerprint:016x}-n{}-{}-bed.csv",
            self.coarse,
            self.place()
        ));
        if !file.exists() {
            let settling = Case {
                at_centres: self.at_centres,
                fill: self.fill,
                ..Case::of(self.coarse, 60.0)
            };
            let source = changed(&root.join(SCENE), &settling.sets())?;
            let mut run = build_on_one_thread(&source)?.simulation;
            until_released(&mut *run)?;
            keep(&file, &places(&*run))?;
        }
        Ok(file)
    }

    /// The scene of the run with all its changes; the run in whose flow it starts is made if need be.
    pub fn prepared(
        &self,
        root: &Path,
        fingerprint: u64,
        more: &[String],
    ) -> Result<Source, String> {
        let mut sets = self.sets();
        let start = if let Some(flow) = self.flow() {
            // Nobody waits for grains that are on their way.
            sets.push("still.for_at_least=1 ms".to_owned());
            sets.push("still.at_most=2 ms".to_owned());
            flow.measured(root, fingerprint)?;
            flow.file(root, fingerprint, FLOW)
        } else {
            self.bed(root, fingerprint)?
        };
        sets.extend(from_places(self.coarse, 0.1257, &start));
        if self.tangential != 1.0 {
            let gamma = 0.1257 * f64::from(1u32 << self.coarse).powi(2);
            sets.push(format!(
                "grains.law.damping=Parts(normal: \"{gamma} kg/s\", tangential: \"{} kg/s\")",
                gamma * self.tangential
            ));
        }
        sets.extend_from_slice(more);
        changed(&root.join(SCENE), &sets)
    }

    /// What the run measured, from the folder of finished runs or run now.
    pub fn measured(&self, root: &Path, fingerprint: u64) -> Result<Measured, String> {
        let file = self.file(root, fingerprint, "");
        if let Some(measured) = std::fs::read_to_string(&file).ok().and_then(|t| read(&t)) {
            return Ok(measured);
        }
        let built = build_on_one_thread(&self.prepared(root, fingerprint, &[])?)?;
        let (mut run, dt) = (built.simulation, built.plan.constants.dt);
        // A look every 10 ms: forty and more in a turn; the flow is kept when the last whole turn is over.
        let each = (0.01 / dt).round() as u64;
        let turns = (self.until() * self.rpm / 60.0).floor() * 60.0 / self.rpm;
        run.look();
        while !run.is_over() {
            let to_look = each - run.steps() % each;
            let to_turn = run.released_at().map_or(u64::MAX, |start| {
                ((start + turns - run.time()) / dt).round() as u64
            });
            run.advance(match to_turn {
                0 => to_look,
                _ => to_look.min(to_turn),
            });
            if to_turn > 0 && to_turn <= to_look {
                keep(&self.file(root, fingerprint, FLOW), &places(&*run))?;
            }
            if run.steps() % each == 0 {
                run.look();
            }
        }
        if run.stop() != Some(tsubu_assemble::Stop::Over) {
            return Err(format!("{self:?}: {:?}", run.stop()));
        }
        let mut text = String::new();
        for reading in run.report() {
            let uncertainty = reading.uncertainty.unwrap_or(f64::NAN);
            let _ = writeln!(text, "{},{:?},{uncertainty:?}", reading.name, reading.value);
        }
        keep(&file, &text)?;
        read(&text).ok_or_else(|| format!("{self:?}: its results do not read back"))
    }
}

/// Ends the name of the file with the places of the grains after the last whole turn.
const FLOW: &str = "-flow";

/// The shipped scene's solid fraction of the random fill.
const FILL: f64 = 0.31;

/// The shipped scene.
const SCENE: &str = "scenarios/screw_feeder.ron";

fn read(text: &str) -> Option<Measured> {
    let line = |line: &str| {
        let mut words = line.split(',');
        Some((
            words.next()?.to_owned(),
            words.next()?.parse().ok()?,
            words.next()?.parse().ok()?,
        ))
    };
    text.lines()
        .map(line)
        .collect::<Option<Vec<_>>>()
        .map(Measured)
}

/// The bits at n = 4 four tenths of a second after the screw has started: they change with the physics, the
/// scene, its meshes and what is measured. A new rule for what is steady may not show so early: then the
/// folder of kept runs is to be emptied by hand.
pub fn fingerprint(root: &Path) -> Result<u64, String> {
    let source = changed(&root.join(SCENE), &Case::of(4, 60.0).sets())?;
    let mut run = build_on_one_thread(&source)?.simulation;
    until_released(&mut *run)?;
    for _ in 0..40 {
        run.advance(400);
        run.look();
    }
    let mut hasher = DefaultHasher::new();
    for (x, v) in run.state() {
        for value in x.to_array().into_iter().chain(v.to_array()) {
            value.to_bits().hash(&mut hasher);
        }
    }
    for reading in run.look().into_iter().chain(run.report()) {
        reading.value.to_bits().hash(&mut hasher);
    }
    Ok(hasher.finish())
}
