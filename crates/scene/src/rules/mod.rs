//! What a single field cannot know: ranges, names, and which fields go together.

mod flow;
mod grains;
mod initial;
mod measures;
mod motion;
mod river;
mod room;
mod shapes;
mod time;
mod vectors;
mod walls;

use std::path::{Path, PathBuf};

use crate::raw::{ONE_OF, RawScene, RawSpace};
use crate::scene::{Domain, Measures, Output, Scene, Space};

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
    pub refusals: Vec<Refusal>,
}

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;

impl<'a> Rules<'a> {
    pub fn new(folder: &'a Path) -> Self {
        Rules {
            folder,
            space: Space::Space,
            refusals: Vec::new(),
        }
    }

    /// The checked scene; it is to be used only if nothing was refused.
    pub fn scene(&mut self, raw: RawScene) -> Option<Scene> {
        self.space = match raw.space {
            None | Some(RawSpace::Space) => Space::Space,
            Some(RawSpace::Plane) => Space::Plane,
        };
        let gravity = raw.gravity.map_or(GRAVITY, |gravity| gravity.0);
        if gravity < 0.0 {
            self.refuse(
                "gravity",
                "gravity is negative",
                "it already points downwards, along -z: write it without the sign",
            );
        }
        let grains = self.grains(raw.grains);
        let domain = raw
            .domain
            .map_or(Domain::default(), |domain| self.domain(domain, gravity));
        let walls = self.walls(raw.walls.unwrap_or_default(), &domain);
        let initial = self.initial(raw.initial, &domain);
        let (outlets, inlets) = self.flow(
            raw.outlets.unwrap_or_default(),
            raw.inlets.unwrap_or_default(),
            &domain,
        );
        let water = raw.water.as_ref().and_then(|water| self.water(water));
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
        let bed = raw.measures.as_ref().and_then(|measures| measures.bed);
        let bed = self.bed_measure(&bed, water.is_some());
        let measures = raw.measures.map_or(Measures::default(), |measures| {
            self.measures(&measures, &walls, &outlets, &domain)
        });
        let measures = Measures { bed, ..measures };
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
        self.river(&scene);
        Some(scene)
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
