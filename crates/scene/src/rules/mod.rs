//! What a single field cannot know: ranges, names, and which fields go together.

mod flow;
mod grains;
mod initial;
mod law;
mod materials;
mod measures;
mod motion;
mod room;
mod shapes;
mod time;
mod vectors;
mod walls;
mod water;

use std::path::{Path, PathBuf};

use crate::raw::{ONE_OF, RawScene, RawSpace};
use crate::scene::{Domain, Output, Scene, Space};

/// A rule that a scene breaks, at the field of a path.
pub(crate) struct Refusal {
    pub path: String,
    pub what: String,
    pub remedy: String,
}

/// The rules, and what they have refused so far.
pub(crate) struct Rules<'a> {
    /// The folder that relative paths start from.
    folder: &'a Path,
    space: Space,
    /// Name of the grains' law.
    law: &'static str,
    /// Names of all materials, that of the grains first.
    materials: Vec<String>,
    pub refusals: Vec<Refusal>,
}

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;

impl<'a> Rules<'a> {
    pub fn new(folder: &'a Path) -> Self {
        Rules {
            folder,
            space: Space::Space,
            law: "",
            materials: Vec::new(),
            refusals: Vec::new(),
        }
    }

    /// The checked scene; it is to be used only if nothing was refused.
    pub fn scene(&mut self, raw: RawScene) -> Option<Scene> {
        self.space = match raw.space {
            None | Some(RawSpace::Space) => Space::Space,
            Some(RawSpace::Plane) => Space::Plane,
        };
        self.law = raw.grains.law.name();
        let gravity = raw.gravity.map_or(GRAVITY, |gravity| gravity.0);
        if gravity < 0.0 {
            self.refuse(
                "gravity",
                "gravity is negative",
                "it already points downwards, along -z: write it without the sign",
            );
        }
        let grains = self.grains(raw.grains);
        let width = raw.initial.bed.as_ref().zip(grains.as_ref());
        let width = width.map(|(bed, grains)| {
            let spacing = bed.spacing.as_ref().map_or(initial::SPACING, |raw| raw.0);
            initial::WIDTH * spacing * grains.diameter
        });
        let domain = raw.domain.map_or(Domain::default(), |domain| {
            self.domain(domain, width, gravity)
        });
        let walls = self.walls(raw.walls.unwrap_or_default(), &domain);
        let initial = self.initial(raw.initial, &domain, gravity);
        let (outlets, inlets) = self.flow(
            raw.outlets.unwrap_or_default(),
            raw.inlets.unwrap_or_default(),
            &domain,
        );
        if let (Some(grains), Some(initial)) = (&grains, &initial) {
            self.mixture_fits(grains, initial, &inlets);
            self.pairs_are_there(grains, &walls);
        }
        let watered = raw.water.is_some();
        let water = raw.water.and_then(|water| {
            self.water_fits(&water, grains.as_ref(), initial.as_ref());
            self.water(&water)
        });
        let still = raw.still.map(|still| self.still(&still));
        let time = self.time(&raw.time);
        let skin = raw
            .neighbours
            .and_then(|neighbours| neighbours.skin)
            .map(|skin| skin.0);
        if skin.is_some_and(|skin| !(skin > 0.0 && skin <= 1.0)) {
            self.refuse(
                "neighbours.skin",
                "the skin is outside (0, 1]",
                "it is a share of the grain's diameter, usually 0.05 to 0.3",
            );
        }
        let measures = raw.measures.as_ref();
        let measures = self.measures(measures, &walls, &outlets, &domain, watered);
        let output = raw
            .output
            .map_or(Output::default(), |output| self.output(&output));
        let scene = Scene {
            title: raw.title,
            space: self.space,
            gravity,
            grains: grains?,
            domain,
            walls,
            initial: initial?,
            outlets,
            inlets,
            water,
            still,
            time: time?,
            skin,
            measures,
            output,
        };
        self.stillness(&scene);
        self.bed_has_fallen(&scene);
        Some(scene)
    }

    /// True if the grains turn: all laws but `Repulsion` need it.
    fn spins(&self) -> bool {
        self.law != "Repulsion"
    }

    fn refuse(
        &mut self,
        path: impl Into<String>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        self.refusals.push(Refusal {
            path: path.into(),
            what: what.into(),
            remedy: remedy.into(),
        });
    }

    /// The absolute path of a file, which a scene names from its own folder; `kind` is what the file holds.
    fn file(&mut self, path: &str, kind: &str, file: &str) -> PathBuf {
        if file.trim().is_empty() {
            self.refuse(
                path,
                format!("the path of the {kind} file is empty"),
                "write its path, relative to the scene's folder",
            );
        }
        let path = self.folder.join(file);
        std::path::absolute(&path).unwrap_or(path)
    }

    fn above_zero(&mut self, path: &str, name: &str, value: f64) -> f64 {
        if value <= 0.0 {
            self.refuse(
                path,
                format!("{name} is not above zero"),
                "write a value above zero",
            );
        }
        value
    }

    fn not_negative(&mut self, path: &str, name: &str, value: f64) -> f64 {
        if value < 0.0 {
            self.refuse(
                path,
                format!("{name} is negative"),
                "write zero or a value above",
            );
        }
        value
    }

    /// Refuses a value outside [low, high].
    fn within(
        &mut self,
        path: &str,
        name: &str,
        value: f64,
        [low, high]: [f64; 2],
        remedy: &str,
    ) -> f64 {
        if !(low..=high).contains(&value) {
            self.refuse(path, format!("{name} is outside [{low}, {high}]"), remedy);
        }
        value
    }

    fn restitution(&mut self, path: &str, value: f64, remedy: &str) -> f64 {
        if !(value > 0.0 && value <= 1.0) {
            self.refuse(path, "the restitution is outside (0, 1]", remedy);
        }
        value
    }

    /// Refuses unless exactly one of the fields of a block is given.
    fn exactly_one(&mut self, block: &str, given: &[bool]) {
        let fields = ONE_OF
            .iter()
            .find(|(path, _)| *path == block)
            .map_or(&[][..], |(_, fields)| fields);
        let list = fields.join(", ");
        let present: Vec<_> = fields
            .iter()
            .zip(given)
            .filter(|(_, given)| **given)
            .map(|(field, _)| *field)
            .collect();
        match present[..] {
            [] => self.refuse(
                block,
                format!("{block} has none of {list}"),
                format!("give exactly one of {list}"),
            ),
            [_] => {}
            [first, second, ..] => {
                let what = format!("{block} has both {first} and {second}");
                self.refuse(
                    format!("{block}.{second}"),
                    what,
                    format!("give exactly one of {list}"),
                );
            }
        }
    }
}
