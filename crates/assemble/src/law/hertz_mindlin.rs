//! Law `HertzMindlin` of a run.

use super::{Coarse, OfRun, at_wall};
use crate::build::Parts;
use crate::constants::Constants;
use crate::plan::{LimitLine, of_turning};
use crate::simulation::Simulation;
use tsubu_coarsen::TooCoarse;
use tsubu_contact::{
    Elastic, Freely, HertzMindlin, PerPair, Resistance, Resisted, Rolling, restitution,
};
use tsubu_engine::{Layout, ManyKinds, NoTally};
use tsubu_measure::Slices;
use tsubu_model::{ContactLaw, Kind, Linear, Space, Spins, Touch, Vector};
use tsubu_scene as scene;

/// Law `HertzMindlin` with its walls.
#[derive(Clone, Debug)]
pub struct OfHertz<R: Rolling> {
    /// Between grains of each pair of materials.
    pub laws: PerPair<HertzMindlin<R>>,
    /// At each wall.
    pub walls: Vec<PerPair<HertzMindlin<R>>>,
}

/// The deepest overlap of a sound run over the diameter.
const DEEPEST: f64 = 0.01;

/// A material, and the law between two grains of it, as far as it says how they roll.
type Own = (Elastic, scene::HertzMindlin);

fn materials(grains: &scene::Grains) -> Vec<Own> {
    let own = |material| match grains.law_of(material) {
        scene::Law::HertzMindlin(law) => (
            Elastic {
                young: law.young,
                poisson: law.poisson,
            },
            *law,
        ),
        _ => unreachable!("a material of another law"),
    };
    (0..grains.materials.len() + 1).map(own).collect()
}

/// The laws of all pairs of a scene; `roll` adds what resists rolling.
fn of<R: Rolling>(
    scene: &scene::Scene,
    coarse: &Coarse<'_>,
    roll: impl Fn(HertzMindlin, Option<scene::RollingResistance>) -> HertzMindlin<R>,
) -> Result<OfHertz<R>, TooCoarse> {
    let grains = &scene.grains;
    let materials = materials(grains);
    let own = |material: usize| {
        let (elastic, law) = &materials[material];
        (*elastic, law.restitution, law.friction, law.rolling)
    };
    let value = |(a, b): (usize, usize)| {
        let (one, other) = (own(a.min(b)), own(a.max(b)));
        let (e, friction, rolling) = match grains.pair_of(a, b) {
            Some(pair) => (
                pair.restitution.unwrap_or(one.1),
                pair.friction,
                one.3.map(|rolling| scene::RollingResistance {
                    friction: pair.rolling_friction.unwrap_or(rolling.friction),
                    ..rolling
                }),
            ),
            None => (own(a).1, own(a).2, own(a).3),
        };
        let elastic = if grains.pair_of(a, b).is_some() {
            [one.0, other.0]
        } else {
            [own(a).0, own(a).0]
        };
        roll(
            HertzMindlin::between(&elastic[0], &elastic[1], e, friction),
            rolling,
        )
    };
    let count = materials.len();
    let all = (0..count).flat_map(|a| (0..count).map(move |b| (a, b)));
    let all = all
        .map(|pair| coarse.of(&value(pair)))
        .collect::<Result<Vec<_>, _>>()?;
    let laws = PerPair::table(all, count);
    let walls = scene
        .walls
        .iter()
        .map(|wall| {
            at_wall(grains, wall, &laws, |_, law| HertzMindlin {
                restitution: wall.restitution.unwrap_or(law.restitution),
                friction: wall.friction.unwrap_or(law.friction),
                ..*law
            })
        })
        .collect();
    Ok(OfHertz { laws, walls })
}

impl OfHertz<Freely> {
    pub(super) fn of(scene: &scene::Scene, coarse: &Coarse<'_>) -> Result<Self, TooCoarse> {
        of(scene, coarse, |law, _| law)
    }
}

impl OfHertz<Resisted> {
    pub(super) fn resisting(scene: &scene::Scene, coarse: &Coarse<'_>) -> Result<Self, TooCoarse> {
        of(scene, coarse, |law, rolling| {
            let rolling = rolling.map_or(Resisted::default(), |rolling| Resisted {
                friction: rolling.friction,
                damping: rolling.damping,
                by: match rolling.by {
                    scene::Resistance::ElasticPlastic => Resistance::ElasticPlastic,
                    scene::Resistance::Constant => Resistance::Constant,
                },
            });
            law.resisting(rolling)
        })
    }
}

/// The contact of a grain with its like, or with a wall, at the deepest.
fn linear<R: Rolling>(law: &HertzMindlin<R>, kind: &Kind, partner: &Kind) -> Linear {
    let pair = <HertzMindlin<R> as ContactLaw<Space, Spins>>::pair(law, kind, partner);
    let r = pair.range * (1.0 - DEEPEST);
    let touch = Touch::<Space, Spins> {
        apart: glam::DVec3::Z * r,
        velocity: glam::DVec3::ZERO,
        r2: r * r,
        reach: pair.range,
        spin: <glam::DVec3 as Vector>::ZERO,
        roll: <glam::DVec3 as Vector>::ZERO,
    };
    <HertzMindlin<R> as ContactLaw<Space, Spins>>::linear(&pair, &touch, 0.0)
}

impl<R: Rolling> OfRun for OfHertz<R> {
    const TURNS: bool = true;
    const DEEP: f64 = 0.3;

    fn linear(&self, kind: &Kind) -> Linear {
        super::stiffest(self.laws.laws().iter().map(|law| linear(law, kind, kind)))
    }

    fn limits(&self, constants: &Constants) -> Vec<LimitLine> {
        let kind = &constants.quickest;
        let walls = self.walls.iter().flat_map(PerPair::laws);
        let walls = walls.map(|law| linear(law, kind, &Kind::immovable()));
        of_turning(constants, &self.linear(kind), walls)
    }

    fn sources(&self) -> Vec<&'static str> {
        let mut sources = vec!["Hertz1882", "Mindlin1953", "Antypov2011"];
        if R::RESISTS {
            sources.push("Ai2011");
        }
        sources
    }

    fn words(&self, constants: &Constants) -> String {
        let law = &self.laws.laws()[0];
        let constants_of_rolling: String = law
            .rolling
            .constants()
            .iter()
            .map(|(name, _, value)| format!(", {} {value}", name.replace('_', " ")))
            .collect();
        let ratio = restitution::ratio_from_restitution(law.restitution);
        format!(
            "law HertzMindlin: E* = {:.4e}, G* = {:.4e} Pa, restitution {} (damping ratio {ratio:.4}), friction {}{constants_of_rolling}; kn = {:.4e} N/m at an overlap of 1 % of d",
            law.modulus,
            law.shear,
            law.restitution,
            law.friction,
            self.linear(&constants.kind).normal_stiffness,
        )
    }

    fn at_bare_walls(&self) -> [&'static str; 2] {
        ["the grains' restitution", "the grains' friction"]
    }

    fn leaves_out(&self, scene: &scene::Scene) -> Vec<String> {
        let mut lines = Vec::new();
        if !R::RESISTS {
            lines.push("resistance to rolling".to_owned());
        }
        lines.push("micro-slip, adhesion, plastic contacts, resistance to twisting".to_owned());
        lines.push(super::around(scene).to_owned());
        lines.push("energy lost to damping and friction: not tallied".to_owned());
        lines
    }

    fn run<D: Layout + Slices>(
        &self,
        parts: Parts<'_, D>,
        kinds: Vec<Kind>,
        share: f64,
    ) -> Box<dyn Simulation> {
        // Less damping while grains settle: ζ is multiplied, so the restitution is that of the smaller ζ.
        let settling = self.laws.map(|law| HertzMindlin {
            restitution: restitution::at_zero_force(
                share * restitution::ratio_from_restitution(law.restitution),
            ),
            ..*law
        });
        let (laws, walls) = (self.laws.clone(), self.walls.clone());
        // One program for one kind and several: where all pairs are alike none is looked up.
        parts.run::<Spins, _, _, _, NoTally>(ManyKinds(kinds), laws, settling, walls)
    }
}
