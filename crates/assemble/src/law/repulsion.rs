//! Law `Repulsion` of a run: grains that do not turn.

use super::{Coarse, OfRun, at_wall, table};
use crate::build::Parts;
use crate::constants::Constants;
use crate::plan::{LimitLine, column, densest, pair};
use crate::simulation::Simulation;
use tsubu_coarsen::TooCoarse;
use tsubu_contact::{
    BodyLaw, BodyPair, PerPair, Repulsion, RepulsiveWall, WallGrains, restitution,
};
use tsubu_engine::{Layout, ManyKinds, NoTally, OneKind, WithTally};
use tsubu_integrate::{Limit, Packing};
use tsubu_measure::Slices;
use tsubu_model::{ContactLaw, Kind, Linear, Space, Still};
use tsubu_scene as scene;

/// Law `Repulsion` with its walls.
#[derive(Clone, Debug)]
pub struct OfRepulsion {
    /// Between grains of each pair of materials.
    pub laws: PerPair<Repulsion>,
    /// True if γn = γt: the law needs neither root nor projection.
    pub isotropic: bool,
    /// At each wall.
    pub walls: Vec<PerPair<BodyLaw>>,
}

/// Restitution of a pair at n = 0.
pub(super) fn restitution(
    grains: &scene::Grains,
    stiffness: &scene::Stiffness,
    damping: &scene::Damping,
    kind: &Kind,
) -> f64 {
    let law = softened(grains, stiffness, damping);
    restitution::at_zero_overlap(law.damping_ratio(0.5 * kind.mass))
}

impl OfRepulsion {
    pub(super) fn of(scene: &scene::Scene, coarse: &Coarse<'_>) -> Result<Self, TooCoarse> {
        let grains = &scene.grains;
        let count = grains.materials.len() + 1;
        let own = (0..count)
            .map(|material| match grains.law_of(material) {
                scene::Law::Repulsion { stiffness, damping } => {
                    coarse.of(&softened(grains, stiffness, damping))
                }
                // All materials follow one law: the rules of a scene see to it.
                _ => unreachable!("a material of another law"),
            })
            .collect::<Result<Vec<_>, _>>()?;
        let mass = 0.5
            * coarse
                .of(&Kind::with_mass(grains.diameter, grains.mass))?
                .mass;
        let laws = table(grains, |a| own[a], |a, b, pair| unlike(a, b, pair, mass));
        let law = laws.laws();
        let isotropic = law.iter().all(|l| l.normal_damping == l.tangential_damping);
        let walls = scene
            .walls
            .iter()
            .map(|wall| {
                at_wall(grains, wall, &laws, |_, law| {
                    match wall.shape.wall_grains() {
                        // Of the coarse grains' material, at the size that the scene gives.
                        Some(radius) => BodyLaw::Grains(WallGrains {
                            grains: *law,
                            radius,
                        }),
                        // A wall shares the grains' potential; its own constants go through the plain rule (crate coarsen says why).
                        None => BodyLaw::Surface(RepulsiveWall {
                            grains: *law,
                            restitution: wall.restitution,
                            friction: wall.friction.unwrap_or(0.0),
                        }),
                    }
                })
            })
            .collect();
        Ok(Self {
            laws,
            isotropic,
            walls,
        })
    }

    /// The law between grains of the scene's own material.
    pub fn law(&self) -> &Repulsion {
        &self.laws.laws()[0]
    }
}

/// Two materials: springs in series, and the restitution of their pair at the diameter of the grains, both dampings alike.
fn unlike(a: &Repulsion, b: &Repulsion, pair: &scene::PairOf, reduced_mass: f64) -> Repulsion {
    let series = |x: f64, y: f64| 2.0 * x * y / (x + y);
    let mut law = *a;
    law.epsilon = series(a.epsilon, b.epsilon);
    let ratio = restitution::ratio_as_printed(pair.restitution.unwrap_or(1.0));
    law.normal_damping = 2.0 * ratio * (law.stiffness() * reduced_mass).sqrt();
    law.tangential_damping = law.normal_damping;
    law
}

fn softened(
    grains: &scene::Grains,
    stiffness: &scene::Stiffness,
    damping: &scene::Damping,
) -> Repulsion {
    let (normal, tangential) = match *damping {
        scene::Damping::Equal(g) => (g, g),
        scene::Damping::Parts { normal, tangential } => (normal, tangential),
    };
    let law = match *stiffness {
        scene::Stiffness::YoungModulus(young) => Repulsion::from_young_modulus(
            young,
            Repulsion::sigma_for_diameter(grains.diameter),
            normal,
            tangential,
            grains.diameter,
        ),
        scene::Stiffness::Energy { epsilon, sigma } => {
            Repulsion::new(epsilon, sigma, normal, tangential, grains.diameter)
        }
    };
    let root = 1.0 / grains.soften.sqrt();
    let (n, t) = match grains.softened_damping {
        scene::SoftenedDamping::Kept => (1.0, 1.0),
        scene::SoftenedDamping::Scaled => (root, root),
        scene::SoftenedDamping::NormalScaled => (root, 1.0),
    };
    law.softened(grains.soften, n, t)
}

impl OfRun for OfRepulsion {
    const TURNS: bool = false;
    const DEEP: f64 = 0.3;

    fn linear(&self, kind: &Kind) -> Linear {
        let of = |law: &Repulsion| {
            let law = law.at_diameter(kind.diameter());
            Linear {
                normal_stiffness: law.stiffness(),
                tangential_stiffness: 0.0,
                normal_damping: law.normal_damping,
                tangential_damping: law.tangential_damping,
            }
        };
        super::stiffest(self.laws.laws().iter().map(of))
    }

    fn limits(&self, constants: &Constants) -> Vec<LimitLine> {
        let limit: Limit = constants.scheme.limit();
        let kind = &constants.quickest;
        let linear = self.linear(kind);
        let per_mass = constants.dt / kind.mass;
        let (k, c) = (
            linear.normal_stiffness * constants.dt * constants.dt / kind.mass,
            linear.normal_damping.max(linear.tangential_damping) * constants.dt / kind.mass,
        );
        let mut lines = vec![
            pair(limit.used_by_packing(k, c, Packing::Pair)),
            column(limit.used_by_packing(k, c, Packing::Column(10))),
            densest(limit.used_by_packing(k, c, Packing::FaceCentredCubic)),
        ];
        let (mut at_walls, mut at_grains) = (None::<f64>, None::<f64>);
        for law in self.walls.iter().flat_map(PerPair::laws) {
            let pair = <BodyLaw as ContactLaw<Space, Still>>::pair(law, kind, &Kind::immovable());
            match pair {
                BodyPair::Surface(pair) => {
                    at_walls = Some(at_walls.unwrap_or(0.0).max(pair.damping * per_mass));
                }
                BodyPair::Grains(pair) => {
                    let k = pair.contact_stiffness() * constants.dt * per_mass;
                    let c = pair.normal_damping.max(pair.tangential_damping) * per_mass;
                    let used = limit.used_by_packing(k, c, Packing::OneWallContact);
                    at_grains = Some(at_grains.unwrap_or(0.0).max(used));
                }
            }
        }
        let at_walls = at_walls.map(|c| limit.used_by_packing(k, c, Packing::OneWallContact));
        for (name, used) in [
            ("a grain at a wall", at_walls),
            ("a grain at a wall grain", at_grains),
        ] {
            lines.extend(used.map(|used| LimitLine {
                name: name.into(),
                used,
            }));
        }
        lines
    }

    fn sources(&self) -> Vec<&'static str> {
        vec!["Sumitomo2024", "Weeks1971"]
    }

    fn words(&self, constants: &Constants) -> String {
        let law = self.law();
        format!(
            "law Repulsion: k = {:.4e} N/m, {}; restitution of a pair {:.3}",
            law.stiffness(),
            if self.isotropic {
                format!(
                    "damping {:.4} kg/s in every direction (no projection, no root)",
                    law.normal_damping
                )
            } else {
                format!(
                    "damping {:.4} kg/s along, {:.4} kg/s across the contact",
                    law.normal_damping, law.tangential_damping
                )
            },
            restitution::at_zero_overlap(law.damping_ratio(0.5 * constants.kind.mass)),
        )
    }

    fn at_bare_walls(&self) -> [&'static str; 2] {
        ["elastic", "smooth"]
    }

    fn leaves_out(&self, scene: &scene::Scene) -> Vec<String> {
        let mut lines = vec![
            "spin: grains do not turn and store no spin".to_owned(),
            "static friction and contact memory: a heap creeps, its angle is a function of time"
                .to_owned(),
            "water, air, cohesion, breakage".to_owned(),
        ];
        if !scene.output.energies {
            lines.push(
                "energy lost to damping and friction: not tallied (output.energies: true does)"
                    .to_owned(),
            );
        }
        lines
    }

    fn run<D: Layout + Slices>(
        &self,
        parts: Parts<'_, D>,
        kinds: Vec<Kind>,
        share: f64,
    ) -> Box<dyn Simulation> {
        let laws = self.laws.clone();
        let settling = laws.map(|law| law.softened(1.0, share, share));
        let walls = self.walls.clone();
        let sided = |laws: &PerPair<Repulsion>| laws.map(|law| law.per_direction());
        let energies = parts.wants_energies();
        let [kind] = kinds[..] else {
            // A mixture has one program for both kinds of damping.
            let kinds = ManyKinds(kinds);
            let (laws, settling) = (sided(&laws), sided(&settling));
            return parts.run::<Still, _, _, _, NoTally>(kinds, laws, settling, walls);
        };
        let kinds = OneKind([kind]);
        match (self.isotropic, energies) {
            (true, false) => parts.run::<Still, _, _, _, NoTally>(kinds, laws, settling, walls),
            (true, true) => parts.run::<Still, _, _, _, WithTally>(kinds, laws, settling, walls),
            (false, _) => {
                let (laws, settling) = (sided(&laws), sided(&settling));
                if energies {
                    parts.run::<Still, _, _, _, WithTally>(kinds, laws, settling, walls)
                } else {
                    parts.run::<Still, _, _, _, NoTally>(kinds, laws, settling, walls)
                }
            }
        }
    }
}
