//! Law `SpringDashpot` of a run.

use super::{Coarse, OfRun, at_wall, table};
use crate::build::Parts;
use crate::constants::Constants;
use crate::plan::{LimitLine, of_turning};
use crate::simulation::Simulation;
use tsubu_coarsen::TooCoarse;
use tsubu_contact::{Normal, PerPair, Slip, SpringDashpot, Tension, restitution};
use tsubu_engine::{Layout, ManyKinds, NoTally, OneKind};
use tsubu_measure::Slices;
use tsubu_model::{Kind, Linear, Spins};
use tsubu_scene as scene;

/// Law `SpringDashpot` with its walls.
#[derive(Clone, Debug)]
pub struct OfSprings {
    /// Between grains of each pair of materials.
    pub laws: PerPair<SpringDashpot>,
    /// At each wall.
    pub walls: Vec<PerPair<SpringDashpot>>,
}

/// Restitution of a pair at n = 0.
pub(super) fn restitution(wanted: &scene::SpringDashpot, fine: &Kind) -> f64 {
    restitution::at_zero_force(law(wanted, fine).damping_ratio(0.5 * fine.mass))
}

impl OfSprings {
    pub(super) fn of(
        scene: &scene::Scene,
        fine: &Kind,
        kind: &Kind,
        coarse: &Coarse<'_>,
    ) -> Result<Self, TooCoarse> {
        let grains = &scene.grains;
        let count = grains.materials.len() + 1;
        let own = (0..count)
            .map(|material| match grains.law_of(material) {
                scene::Law::SpringDashpot(wanted) => coarse.of(&law(wanted, fine)),
                _ => unreachable!("a material of another law"),
            })
            .collect::<Result<Vec<_>, _>>()?;
        let pairs = |a: &SpringDashpot, b: &SpringDashpot, pair: &scene::PairOf| {
            unlike(a, b, pair, 0.5 * kind.mass)
        };
        let laws = table(grains, |a| own[a], pairs);
        let walls = scene
            .walls
            .iter()
            .map(|wall| {
                at_wall(grains, wall, &laws, |a, law| {
                    let of_pair = wall
                        .material
                        .and_then(|b| grains.pair_of(a, b)?.restitution);
                    touched(wall, law, wall.restitution.or(of_pair), kind)
                })
            })
            .collect();
        Ok(Self { laws, walls })
    }

    /// The law between grains of the scene's own material.
    pub fn law(&self) -> &SpringDashpot {
        &self.laws.laws()[0]
    }
}

/// The law between grains at n = 0.
fn law(wanted: &scene::SpringDashpot, grain: &Kind) -> SpringDashpot {
    let (poisson, friction) = (wanted.poisson, wanted.friction);
    let ratio = 2.0 * (1.0 + poisson);
    let law = match wanted.constants {
        scene::SpringConstants::FromTimeStep { step, tn, cn, beta } => {
            SpringDashpot::from_time_step(step, grain.mass, tn, cn, poisson, friction)
                .scaled_by(beta)
        }
        scene::SpringConstants::FromRestitution {
            normal_stiffness,
            restitution,
        } => SpringDashpot::from_restitution(
            normal_stiffness,
            restitution,
            0.5 * grain.mass,
            poisson,
            friction,
        ),
        scene::SpringConstants::Given {
            normal_stiffness,
            tangential_stiffness,
            normal_damping,
            tangential_damping,
        } => SpringDashpot::new(
            normal_stiffness,
            tangential_stiffness.unwrap_or(normal_stiffness / ratio),
            normal_damping,
            tangential_damping.unwrap_or(normal_damping / ratio.sqrt()),
            friction,
        ),
    };
    law.tension(match wanted.tension {
        scene::Tension::NoPull => Tension::NoPull,
        scene::Tension::AsPrinted => Tension::AsPrinted,
    })
    .slip(match wanted.slip {
        scene::Slip::Total => Slip::Total,
        scene::Slip::AsPrinted => Slip::AsPrinted,
    })
    .normal(match wanted.normal_force {
        scene::NormalForce::Closed => Normal::Closed,
        scene::NormalForce::Incremental => Normal::Incremental,
    })
}

/// Two materials: springs and dashpots in series, the friction of their pair, and its restitution if it has one.
fn unlike(
    a: &SpringDashpot,
    b: &SpringDashpot,
    pair: &scene::PairOf,
    reduced_mass: f64,
) -> SpringDashpot {
    let series = |x: f64, y: f64| {
        if x + y > 0.0 {
            2.0 * x * y / (x + y)
        } else {
            0.0
        }
    };
    let law = SpringDashpot {
        normal_stiffness: series(a.normal_stiffness, b.normal_stiffness),
        tangential_stiffness: series(a.tangential_stiffness, b.tangential_stiffness),
        normal_damping: series(a.normal_damping, b.normal_damping),
        tangential_damping: series(a.tangential_damping, b.tangential_damping),
        friction: pair.friction,
        ..*a
    };
    pair.restitution
        .map_or(law, |e| damped(&law, e, reduced_mass))
}

/// The law at a wall: the grains' own, with the wall's friction, and its restitution if it has one.
fn touched(
    wall: &scene::Wall,
    law: &SpringDashpot,
    restitution: Option<f64>,
    kind: &Kind,
) -> SpringDashpot {
    let law = SpringDashpot {
        friction: wall.friction.unwrap_or(law.friction),
        ..*law
    };
    restitution.map_or(law, |e| damped(&law, e, kind.mass))
}

/// The damping that gives this restitution, the tangential one in its former proportion.
fn damped(law: &SpringDashpot, restitution: f64, reduced_mass: f64) -> SpringDashpot {
    let zeta = restitution::ratio_from_restitution(restitution);
    let damping = 2.0 * zeta * (reduced_mass * law.normal_stiffness).sqrt();
    let share = if law.normal_damping > 0.0 {
        law.tangential_damping / law.normal_damping
    } else {
        (law.tangential_stiffness / law.normal_stiffness).sqrt()
    };
    SpringDashpot {
        normal_damping: damping,
        tangential_damping: share * damping,
        ..*law
    }
}

fn linear(law: &SpringDashpot) -> Linear {
    Linear {
        normal_stiffness: law.normal_stiffness,
        tangential_stiffness: law.tangential_stiffness,
        normal_damping: law.normal_damping,
        tangential_damping: law.tangential_damping,
    }
}

impl OfRun for OfSprings {
    const TURNS: bool = true;
    // A soft bed is pressed deep by its own weight; past its centre no law pushes a grain back.
    const DEEP: f64 = 0.9;

    fn linear(&self, _kind: &Kind) -> Linear {
        super::stiffest(self.laws.laws().iter().map(linear))
    }

    fn limits(&self, constants: &Constants) -> Vec<LimitLine> {
        let walls = self.walls.iter().flat_map(PerPair::laws).map(linear);
        of_turning(constants, &self.linear(&constants.quickest), walls)
    }

    fn sources(&self) -> Vec<&'static str> {
        vec!["Gotoh2001"]
    }

    fn words(&self, constants: &Constants) -> String {
        let law = self.law();
        let zeta = law.damping_ratio(0.5 * constants.kind.mass);
        format!(
            "law SpringDashpot: kn = {:.4e}, ks = {:.4e} N/m, damping {:.4e} and {:.4e} kg/s, friction {}; {:?}, slip {:?}, normal force {:?}; restitution of a pair {:.3}",
            law.normal_stiffness,
            law.tangential_stiffness,
            law.normal_damping,
            law.tangential_damping,
            law.friction,
            law.tension,
            law.slip,
            law.normal,
            match law.tension {
                Tension::NoPull => restitution::at_zero_force(zeta),
                Tension::AsPrinted => restitution::at_zero_overlap(zeta),
            }
        )
    }

    fn at_bare_walls(&self) -> [&'static str; 2] {
        ["the grains' damping", "the grains' friction"]
    }

    fn leaves_out(&self, scene: &scene::Scene) -> Vec<String> {
        vec![
            "resistance to rolling".to_owned(),
            super::around(scene).to_owned(),
            "energy lost to damping and friction: not tallied".to_owned(),
        ]
    }

    fn run<D: Layout + Slices>(
        &self,
        parts: Parts<'_, D>,
        kinds: Vec<Kind>,
        share: f64,
    ) -> Box<dyn Simulation> {
        let (laws, walls) = (self.laws.clone(), self.walls.clone());
        let settling = laws.map(|law| SpringDashpot {
            normal_damping: law.normal_damping * share,
            tangential_damping: law.tangential_damping * share,
            ..*law
        });
        if let [kind] = kinds[..] {
            let kinds = OneKind([kind]);
            return parts.run::<Spins, _, _, _, NoTally>(kinds, laws, settling, walls);
        }
        parts.run::<Spins, _, _, _, NoTally>(ManyKinds(kinds), laws, settling, walls)
    }
}
