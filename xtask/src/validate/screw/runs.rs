//! One run of the feeder after another: the shipped scene with other levels, speeds, stiffnesses and screws.
//!
//! The bed is settled once for each level and started from file; a finished run is kept ([`crate::validate::kept`]).

use crate::validate::kept::{self, Flow, Measured};
use crate::validate::scenes::{
    build_on_one_thread, changed, from_places, keep, listed, places, until_released,
};
use std::path::{Path, PathBuf};
use tsubu_contact::Repulsion;
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
    /// Wall grains of this radius in µm that fill the same file.
    Grains(u32),
}

impl Kind {
    /// The shape of the screw as a scene says it.
    pub fn shape(self) -> String {
        let surface = match self {
            Kind::Grid => "Grid(cell: \"2 mm\")".to_owned(),
            Kind::Triangles => "Exact".to_owned(),
            Kind::Grains(radius) => {
                format!("Grains(radius: \"{} mm\")", f64::from(radius) * 1e-3)
            }
            Kind::Analytic => {
                return "Screw(from: (\"0 mm\", \"0 mm\", \"0 mm\"), to: (\"675 mm\", \"0 mm\", \"0 mm\"), shaft: \"55 mm\", outer: \"205 mm\", pitch: \"150 mm\", thickness: \"6 mm\")".to_owned();
            }
        };
        format!("Mesh(file: \"meshes/screw.stl\", unit: \"mm\", surface: {surface})")
    }

    /// Changes of a scene after which its screw is of this kind. What holds of surfaces is left out of wall grains.
    fn sets(self) -> Vec<String> {
        let mut sets = vec![format!("walls.screw.shape={}", self.shape())];
        if matches!(self, Kind::Grains(_)) {
            sets.push("walls.screw.restitution=None".to_owned());
            sets.push("walls.screw.friction=None".to_owned());
        }
        sets
    }

    /// As the table calls it.
    pub fn name(self) -> String {
        match self {
            Kind::Grid => "a grid of distances".into(),
            Kind::Triangles => "triangles".into(),
            Kind::Analytic => "a formula".into(),
            Kind::Grains(radius) => format!("grains of rs = {} mm", f64::from(radius) * 1e-3),
        }
    }
}

/// Changes after which a wall only repels: no friction, no damping.
fn repelling(wall: &str) -> [String; 2] {
    [
        format!("walls.{wall}.restitution=None"),
        format!("walls.{wall}.friction=None"),
    ]
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
    /// Softening divides the normal damping by its root, so that restitution stays (`NormalScaled`).
    pub keeps_restitution: bool,
    /// Tangential damping between grains over paper A's.
    pub tangential: f64,
    /// Friction of screw, casing and hopper.
    pub friction: f64,
    /// Grains touch walls at their centres (the literal reading), not at their surface.
    pub at_centres: bool,
    /// What the screw is made of.
    pub kind: Kind,
    /// The casing only repels (physics of paper A's fig. 4).
    pub smooth: bool,
    /// Grains turn, with this friction between them and e = 0.5: law `SpringDashpot`, as stiff at contact as paper A's.
    pub coulomb: Option<f64>,
}

impl Case {
    /// The shipped scene at a level and a speed.
    pub fn of(coarse: u32, rpm: f64) -> Self {
        Self {
            coarse,
            rpm,
            soften: 100.0,
            keeps_restitution: false,
            tangential: 1.0,
            friction: 0.413,
            at_centres: false,
            kind: Kind::Grid,
            smooth: false,
            coulomb: None,
        }
    }

    /// The same of grains that turn, with this friction between them.
    pub fn with_coulomb(self, friction: f64) -> Self {
        Self {
            coulomb: Some(friction),
            ..self
        }
    }

    /// The same with grains that touch walls at their centres.
    pub fn touching_at_centres(self) -> Self {
        Self {
            at_centres: true,
            ..self
        }
    }

    /// As the table calls it.
    pub fn name(&self) -> String {
        let reading = if self.at_centres { ", s = R" } else { "" };
        let law = if self.coulomb.is_some() {
            format!(", Coulomb friction, E/{}", self.soften)
        } else {
            String::new()
        };
        format!("n = {}, {} r/min{reading}{law}", self.coarse, self.rpm)
    }

    /// Changes to the law of the grains; of those already coarse if it is to be at level `at` outright.
    pub fn law(&self, at: u32) -> Vec<String> {
        let Some(friction) = self.coulomb else {
            return vec![format!("grains.soften={}", self.soften)];
        };
        let sigma = Repulsion::sigma_for_diameter(1.350e-3);
        let coke = Repulsion::from_young_modulus(3.096e9, sigma, 0.0, 0.0, 1.350e-3);
        let stiffness = coke.stiffness() / self.soften * f64::from(1u32 << at);
        vec![
            format!(
                "grains.law=SpringDashpot(constants: FromRestitution(normal_stiffness: \"{stiffness} N/m\", restitution: 0.5), poisson: 0.3, friction: {friction}, tension: NoPull)"
            ),
            "grains.soften=None".to_owned(),
            "grains.softened_damping=None".to_owned(),
        ]
    }

    /// How the walls are read, as names of files say it.
    fn place(&self) -> &'static str {
        match (self.at_centres, self.smooth) {
            (true, false) => "centre",
            (false, false) => "surface",
            (true, true) => "centre-smooth",
            (false, true) => "surface-smooth",
        }
    }

    /// Seconds from the start of the screw: four turns and a half until the tube is full, the turn after that, and four that
    /// are measured, since the rate swings once a turn. A start in the flow of another speed would save nothing: the
    /// change takes as long to come through the tube.
    pub fn until(&self) -> f64 {
        60.0 * 9.5 / self.rpm
    }

    /// The changes.
    pub fn sets(&self) -> Vec<String> {
        let mut sets = vec![
            format!("grains.coarse={}", self.coarse),
            format!("walls.screw.motion.turn.rate=-{} rpm", self.rpm),
            format!("time.until={} s", self.until()),
            "still.at_most=10 s".to_owned(),
        ];
        sets.extend(self.law(0));
        let centre = if self.at_centres { "Centre" } else { "Surface" };
        for wall in ["screw", "casing", "hopper"] {
            let made_of_grains = wall == "screw" && matches!(self.kind, Kind::Grains(_));
            if !made_of_grains {
                sets.push(format!("walls.{wall}.friction={}", self.friction));
                sets.push(format!("walls.{wall}.touches_at={centre}"));
            }
        }
        if self.keeps_restitution {
            sets.push("grains.softened_damping=NormalScaled".to_owned());
        }
        sets.extend(self.kind.sets());
        if self.smooth {
            sets.extend(repelling("casing"));
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
        let damping = if self.keeps_restitution { "n" } else { "" };
        let law = match self.coulomb {
            Some(friction) => format!("-coulomb{friction}"),
            None => String::new(),
        };
        root.join(format!(
            "target/validate/screw/{fingerprint:016x}-n{coarse}-{rpm}rpm-s{soften}{damping}-t{tangential}-mu{friction}-{place}-{kind:?}{law}-{:.2}s{what}.csv",
            self.until()
        ))
    }

    /// Places of the settled grains, made once for each level, reading of the walls, screw of grains and law: other screws
    /// share theirs.
    fn bed(&self, root: &Path, fingerprint: u64) -> Result<PathBuf, String> {
        let (kind, of_grains) = match self.kind {
            Kind::Grains(radius) => (self.kind, format!("-Grains({radius})")),
            _ => (Kind::Grid, String::new()),
        };
        let law = self.coulomb.map_or("", |_| "-coulomb");
        let file = root.join(format!(
            "target/validate/screw/{fingerprint:016x}-n{}-{}{of_grains}{law}-bed.csv",
            self.coarse,
            self.place()
        ));
        if !file.exists() {
            let settling = Case {
                at_centres: self.at_centres,
                smooth: self.smooth,
                kind,
                coulomb: self.coulomb.map(|_| 0.413),
                ..Case::of(self.coarse, 60.0)
            };
            let source = changed(&root.join(SCENE), &settling.sets())?;
            let mut run = build_on_one_thread(&source)?.simulation;
            until_released(&mut *run)?;
            keep(&file, &places(&*run))?;
        }
        Ok(file)
    }

    /// The scene of the run with all its changes, its grains starting from a file.
    fn prepared(&self, root: &Path, start: &Path, more: &[String]) -> Result<Source, String> {
        let mut sets = self.sets();
        sets.extend(if self.coulomb.is_some() {
            let mut listed = listed(self.coarse, start).to_vec();
            listed.extend(self.law(self.coarse));
            listed
        } else {
            from_places(self.coarse, 0.1257, start).to_vec()
        });
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

    /// The scene from its own flow on, after the last whole turn of its run: the tube is full, the screw where it was at the
    /// start, the grains at rest where they were.
    pub fn in_flow(
        &self,
        root: &Path,
        fingerprint: u64,
        more: &[String],
    ) -> Result<Source, String> {
        self.in_flow_of(self, root, fingerprint, more)
    }

    /// The same from the flow of another case of the same level, whose fingerprint it is.
    pub fn in_flow_of(
        &self,
        other: &Case,
        root: &Path,
        fingerprint: u64,
        more: &[String],
    ) -> Result<Source, String> {
        other.measured(root, fingerprint)?;
        // Nobody waits for grains that are on their way.
        let mut sets = vec![
            "still.for_at_least=1 ms".to_owned(),
            "still.at_most=2 ms".to_owned(),
        ];
        sets.extend_from_slice(more);
        self.prepared(root, &other.file(root, fingerprint, FLOW), &sets)
    }

    /// What the run measured, from the folder of finished runs or run now.
    pub fn measured(&self, root: &Path, fingerprint: u64) -> Result<Measured, String> {
        let file = self.file(root, fingerprint, "");
        if let Some(measured) = Measured::kept(&file) {
            return Ok(measured);
        }
        let flow = Flow {
            after: (self.until() * self.rpm / 60.0).floor() * 60.0 / self.rpm,
            file: self.file(root, fingerprint, FLOW),
        };
        let bed = self.bed(root, fingerprint)?;
        Measured::of_run(&self.prepared(root, &bed, &[])?, &file, Some(&flow), 1)
    }
}

/// Ends the name of the file with the places of the grains after the last whole turn.
const FLOW: &str = "-flow";

/// The shipped scene.
const SCENE: &str = "scenarios/screw_feeder.ron";

/// The fingerprint of the shipped scene at n = 4.
pub fn fingerprint(root: &Path) -> Result<u64, String> {
    kept::fingerprint(&changed(&root.join(SCENE), &Case::of(4, 60.0).sets())?)
}
