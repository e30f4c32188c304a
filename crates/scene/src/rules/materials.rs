//! The rules of mixtures: populations, materials, and what each pair of materials makes of the other.

use super::Rules;
use crate::raw::{RawMaterial, RawPairOf, RawPopulation, RawWall};
use crate::scene::{Grains, Initial, Inlet, Law, Material, PairOf, Population, Wall};

impl Rules<'_> {
    /// Notes the names of all materials, so that populations, pairs and walls can speak of them.
    pub(super) fn name_materials(&mut self, own: Option<String>, raw: &[RawMaterial]) {
        self.materials = vec![own.unwrap_or_else(|| "grains".into())];
        for (i, material) in raw.iter().enumerate() {
            let twice = self.materials.contains(&material.name);
            let path = format!("grains.materials[{i}]");
            self.name(
                &path,
                ["a material", "two materials"],
                &material.name,
                twice,
            );
            self.materials.push(material.name.clone());
        }
    }

    pub(super) fn further_materials(
        &mut self,
        raw: &[RawMaterial],
        own: &Law,
        diameter: f64,
    ) -> Vec<Material> {
        let resists = |law: &Law| match law {
            Law::HertzMindlin(law) => law.rolling.map(|rolling| rolling.by),
            _ => None,
        };
        let mut materials = Vec::with_capacity(raw.len());
        for (i, raw) in raw.iter().enumerate() {
            let path = format!("grains.materials[{i}].law");
            if raw.law.name() != self.law {
                self.refuse(
                    path,
                    format!("a material of law {} among grains of law {}", raw.law.name(), self.law),
                    format!("all materials of a scene follow one law: write law: {}(…) with its own constants", self.law),
                );
                continue;
            }
            let law = self.law(&path, &raw.law, diameter);
            if resists(&law) != resists(own) {
                self.refuse(
                    path,
                    "one material resists rolling otherwise than another",
                    "give all of them rolling: (friction: …) with the same “by”, or none",
                );
            }
            materials.push(Material {
                name: raw.name.clone(),
                law,
            });
        }
        materials
    }

    pub(super) fn populations(
        &mut self,
        raw: &[RawPopulation],
        largest: f64,
        density: f64,
    ) -> Vec<Population> {
        let mut populations: Vec<Population> = Vec::with_capacity(raw.len());
        for (i, raw) in raw.iter().enumerate() {
            let path = |field: &str| format!("grains.populations[{i}].{field}");
            let population = Population {
                diameter: self.above_zero(&path("diameter"), "the diameter", raw.diameter.0),
                density: raw.density.map_or(density, |density| {
                    self.above_zero(&path("density"), "the density", density.0)
                }),
                share: self.above_zero(&path("share"), "the share", raw.share.0),
                material: raw.material.as_deref().map_or(0, |name| {
                    self.material(&path("material"), name).unwrap_or(0)
                }),
            };
            let alike = |other: &Population| {
                Population {
                    share: other.share,
                    ..population
                } == *other
            };
            if populations.iter().any(alike) {
                self.refuse(
                    path("diameter"),
                    "two populations are alike in diameter, density and material",
                    "write it once, with the sum of the shares",
                );
            }
            if population.diameter > largest {
                self.refuse(
                    path("diameter"),
                    "this population is larger than the diameter of the grains",
                    "grains.diameter is that of the largest population",
                );
            }
            populations.push(population);
        }
        self.whole(&populations, largest);
        populations
    }

    /// Refuses populations that together are no mixture.
    fn whole(&mut self, populations: &[Population], largest: f64) {
        if populations.is_empty() {
            self.refuse(
                "grains.populations",
                "the list of populations is empty",
                "list (diameter: …, share: …) for each, or remove it for grains all alike",
            );
            return;
        }
        if populations.iter().all(|one| one.diameter < largest) {
            self.refuse(
                "grains.populations",
                "no population has the diameter of the grains",
                "grains.diameter is that of the largest population: write the same there and here",
            );
        }
        let sum: f64 = populations.iter().map(|one| one.share).sum();
        if (sum - 1.0).abs() > 1e-6 {
            let sum = (sum * 1e7).round() / 1e7;
            self.refuse(
                "grains.populations",
                format!("the shares of the populations add up to {sum}, not to 1"),
                "they are shares of the mass of all grains",
            );
        }
    }

    /// The number of a material by its name.
    fn material(&mut self, path: &str, name: &str) -> Option<usize> {
        let number = self.materials.iter().position(|other| other == name);
        if number.is_none() {
            let known = self.materials.join(", ");
            self.refuse(
                path,
                format!("no material is named “{name}”"),
                format!("write one of {known}, or add it to grains.materials"),
            );
        }
        number
    }

    /// What the table says of each pair.
    pub(super) fn pairs(&mut self, raw: &[RawPairOf], own: &Law) -> Vec<PairOf> {
        let rolls = matches!(own, Law::HertzMindlin(law) if law.rolling.is_some());
        let mut pairs: Vec<PairOf> = Vec::with_capacity(raw.len());
        for (i, raw) in raw.iter().enumerate() {
            let path = |field: &str| format!("grains.pairs[{i}].{field}");
            let [a, b] = [0, 1].map(|k| self.material(&path(&format!("of[{k}]")), &raw.of.0[k]));
            let (Some(a), Some(b)) = (a, b) else { continue };
            let of = [a.min(b), a.max(b)];
            if a == b {
                self.refuse(
                    path("of"),
                    format!("“{}” against itself is said by its law", raw.of.0[0]),
                    "remove this pair, and change the law of that material",
                );
            }
            if pairs.iter().any(|other| other.of == of) {
                self.refuse(path("of"), "this pair is listed twice", "keep one of them");
            }
            self.of_pair(&path, raw, rolls);
            let number = |raw: &Option<crate::quantity::Number>| raw.as_ref().map(|raw| raw.0);
            pairs.push(PairOf {
                of,
                restitution: number(&raw.restitution),
                friction: number(&raw.friction).unwrap_or(0.0),
                rolling_friction: number(&raw.rolling_friction),
            });
        }
        pairs
    }

    /// Which properties a pair needs and has not, or has and would not use.
    fn of_pair(&mut self, path: &dyn Fn(&str) -> String, raw: &RawPairOf, rolls: bool) {
        let law = self.law;
        let fields = [
            (
                "restitution",
                raw.restitution.as_ref(),
                law != "SpringDashpot",
                true,
            ),
            (
                "friction",
                raw.friction.as_ref(),
                law != "Repulsion",
                law != "Repulsion",
            ),
            (
                "rolling_friction",
                raw.rolling_friction.as_ref(),
                rolls,
                rolls,
            ),
        ];
        for (field, given, needed, used) in fields {
            match given {
                None if needed => self.refuse(
                    path("of"),
                    format!(
                        "the pair “{}” and “{}” has no {field}",
                        raw.of.0[0], raw.of.0[1]
                    ),
                    format!("add {field}: … to this pair"),
                ),
                Some(_) if !used => self.refuse(
                    path(field),
                    format!("{field} of a pair would be ignored: these grains have none"),
                    "remove it",
                ),
                Some(value) if field == "restitution" => {
                    self.restitution(&path(field), value.0, "1 returns all the speed");
                }
                Some(value) => {
                    self.not_negative(&path(field), "this value", value.0);
                }
                None => {}
            }
        }
    }

    /// The number of a wall's material, for laws whose walls have one.
    pub(super) fn wall_material(&mut self, path: &str, name: &str, raw: &RawWall) -> Option<usize> {
        if !self.spins() {
            self.refuse(
                format!("{path}.material"),
                "a wall of law Repulsion has the potential of the grains, so its material would be ignored",
                "remove it, and give the wall its restitution and friction",
            );
            return None;
        }
        for (field, given) in [
            ("restitution", raw.restitution.is_some()),
            ("friction", raw.friction.is_some()),
        ] {
            if given {
                self.refuse(
                    format!("{path}.{field}"),
                    format!("a wall of a material takes its {field} from grains.pairs, so this would be ignored"),
                    "remove it, or remove the wall's material",
                );
            }
        }
        self.material(&format!("{path}.material"), name)
    }

    /// What a mixture asks of the rest of the scene.
    pub(super) fn mixture_fits(&mut self, grains: &Grains, initial: &Initial, inlets: &[Inlet]) {
        let count = grains.populations.len();
        if let Initial::Grains(listed) = initial {
            for (i, grain) in listed.iter().enumerate() {
                if grain.population >= count.max(1) {
                    self.refuse(
                        format!("initial.grains[{i}].population"),
                        format!("there is no population number {}", grain.population),
                        "they are numbered from 0 in the order of grains.populations",
                    );
                }
            }
        }
        if count == 0 {
            return;
        }
        if !inlets.is_empty() {
            self.refuse(
                "inlets",
                "an inlet brings grains of one population, and these have several",
                "remove the inlet, or remove populations",
            );
        }
        if grains.coarse > 0 && matches!(initial, Initial::Bed(_)) {
            self.refuse(
                "grains.coarse",
                "a bed of several populations cannot be coarsened",
                "write coarse: 0, or remove populations",
            );
        }
    }

    /// Every pair of unlike materials that can meet has its properties.
    pub(super) fn pairs_are_there(&mut self, grains: &Grains, walls: &[Wall]) {
        let used: Vec<usize> = match grains.populations.len() {
            0 => vec![0],
            _ => grains.populations.iter().map(|one| one.material).collect(),
        };
        let mut told = Vec::new();
        let mut ask = |rules: &mut Self, path: String, a: usize, b: usize| {
            let of = [a.min(b), a.max(b)];
            if a == b || grains.pair_of(a, b).is_some() || told.contains(&of) {
                return;
            }
            told.push(of);
            let [one, other] = of.map(|number| grains.material_name(number));
            rules.refuse(
                path,
                format!("“{one}” and “{other}” can meet, but grains.pairs does not say how"),
                format!(
                    "add (of: (\"{one}\", \"{other}\"), {}) to grains.pairs",
                    match rules.law {
                        "Repulsion" => "restitution: 0.5",
                        "SpringDashpot" => "friction: 0.3",
                        _ => "restitution: 0.5, friction: 0.3",
                    }
                ),
            );
        };
        for (i, &a) in used.iter().enumerate() {
            for &b in &used[..i] {
                ask(self, format!("grains.populations[{i}]"), a, b);
            }
        }
        for (i, wall) in walls.iter().enumerate() {
            for &a in &used {
                if let Some(b) = wall.material {
                    ask(self, format!("walls[{i}].material"), a, b);
                }
            }
        }
    }
}
