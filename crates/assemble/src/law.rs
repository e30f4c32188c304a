//! The laws that a scene can ask for: a row each in [`Law`] and in `each!`, a file each beside this one.

mod hertz_mindlin;
mod repulsion;
mod springs;

pub use hertz_mindlin::OfHertz;
pub use repulsion::OfRepulsion;
pub use springs::OfSprings;

use crate::build::Parts;
use crate::constants::Constants;
use crate::plan::LimitLine;
use crate::simulation::Simulation;
use tsubu_coarsen::{CoarseRule, Level, TooCoarse, coarsen};
use tsubu_contact::{Freely, PerPair, Resisted};
use tsubu_engine::Layout;
use tsubu_measure::Slices;
use tsubu_model::{Constants as Listed, Kind, Linear};
use tsubu_scene as scene;

/// The law between grains, with that of each wall.
#[derive(Clone, Debug)]
pub enum Law {
    /// Of grains without spin.
    Repulsion(OfRepulsion),
    /// Springs and dashpots, of grains that turn.
    SpringDashpot(OfSprings),
    /// Elastic spheres that roll freely.
    HertzMindlin(OfHertz<Freely>),
    /// Elastic spheres that are held back from rolling.
    HertzMindlinRolling(OfHertz<Resisted>),
}

/// Does the same with whichever law it is.
macro_rules! each {
    ($law:expr, $of:ident => $what:expr) => {
        match $law {
            Law::Repulsion($of) => $what,
            Law::SpringDashpot($of) => $what,
            Law::HertzMindlin($of) => $what,
            Law::HertzMindlinRolling($of) => $what,
        }
    };
}

/// What the rest of this crate asks of a law.
pub(crate) trait OfRun {
    /// True if grains turn.
    const TURNS: bool;
    /// Overlap over the diameter from which on a contact is no longer physics.
    const DEEP: f64;

    /// Two equal grains of this kind that touch, stiffest of all materials; where stiffness grows with overlap, at the deepest that a
    /// sound run has, 1 % of the diameter.
    fn linear(&self, kind: &Kind) -> Linear;
    /// What the step of these constants uses of each limit that is known before there is a packing.
    fn limits(&self, constants: &Constants) -> Vec<LimitLine>;
    /// Keys of the bibliography.
    fn sources(&self) -> Vec<&'static str>;
    /// Name and constants.
    fn words(&self, constants: &Constants) -> String;
    /// What a wall does where the scene gives no restitution, and where it gives no friction.
    fn at_bare_walls(&self) -> [&'static str; 2];
    /// What it does not model, a line each.
    fn leaves_out(&self, scene: &scene::Scene) -> Vec<String>;
    /// The run of these parts; `share` of the damping acts until the release.
    fn run<D: Layout + Slices>(
        &self,
        parts: Parts<'_, D>,
        kinds: Vec<Kind>,
        share: f64,
    ) -> Box<dyn Simulation>;
}

impl Law {
    /// The law of a scene at its coarse level: `fine` is the largest grain at n = 0, `kind` the same coarsened.
    pub(crate) fn of(
        scene: &scene::Scene,
        fine: &Kind,
        kind: &Kind,
        coarse: &Coarse<'_>,
    ) -> Result<Self, TooCoarse> {
        Ok(match &scene.grains.law {
            scene::Law::Repulsion { .. } => Law::Repulsion(OfRepulsion::of(scene, coarse)?),
            scene::Law::SpringDashpot(_) => {
                Law::SpringDashpot(OfSprings::of(scene, fine, kind, coarse)?)
            }
            scene::Law::HertzMindlin(law) if law.rolling.is_none() => {
                Law::HertzMindlin(OfHertz::of(scene, coarse)?)
            }
            scene::Law::HertzMindlin(_) => {
                Law::HertzMindlinRolling(OfHertz::resisting(scene, coarse)?)
            }
        })
    }

    /// Restitution of two grains by the constants at n = 0.
    pub(crate) fn restitution_of(scene: &scene::Scene, fine: &Kind) -> f64 {
        match &scene.grains.law {
            scene::Law::Repulsion { stiffness, damping } => {
                repulsion::restitution(&scene.grains, stiffness, damping, fine)
            }
            scene::Law::SpringDashpot(wanted) => springs::restitution(wanted, fine),
            scene::Law::HertzMindlin(law) => law.restitution,
        }
    }

    /// True if grains turn.
    pub fn turns(&self) -> bool {
        fn of<L: OfRun>(_: &L) -> bool {
            L::TURNS
        }
        each!(self, law => of(law))
    }

    /// Overlap over the diameter from which on a contact is no longer physics.
    pub(crate) fn deep(&self) -> f64 {
        fn of<L: OfRun>(_: &L) -> f64 {
            L::DEEP
        }
        each!(self, law => of(law))
    }

    /// Two equal grains that touch.
    pub fn linear(&self, kind: &Kind) -> Linear {
        each!(self, law => law.linear(kind))
    }

    pub(crate) fn limits(&self, constants: &Constants) -> Vec<LimitLine> {
        each!(self, law => law.limits(constants))
    }

    pub(crate) fn sources(&self) -> Vec<&'static str> {
        each!(self, law => law.sources())
    }

    pub(crate) fn words(&self, constants: &Constants) -> String {
        each!(self, law => law.words(constants))
    }

    pub(crate) fn at_bare_walls(&self) -> [&'static str; 2] {
        each!(self, law => law.at_bare_walls())
    }

    pub(crate) fn leaves_out(&self, scene: &scene::Scene) -> Vec<String> {
        each!(self, law => law.leaves_out(scene))
    }

    pub(crate) fn run<D: Layout + Slices>(
        &self,
        parts: Parts<'_, D>,
        kinds: Vec<Kind>,
        share: f64,
    ) -> Box<dyn Simulation> {
        each!(self, law => law.run(parts, kinds, share))
    }
}

/// A coarse level and its rule.
pub(crate) struct Coarse<'a> {
    pub rule: &'a dyn CoarseRule,
    pub level: Level,
}

impl Coarse<'_> {
    /// Anything that lists its constants, at this level.
    pub fn of<C: Listed>(&self, fine: &C) -> Result<C, TooCoarse> {
        coarsen(self.rule, fine, self.level)
    }
}

/// A value for each pair of the scene's materials; `own` makes that of a material with itself, `unlike` that of two.
pub(crate) fn table<L: Clone>(
    grains: &scene::Grains,
    own: impl Fn(usize) -> L,
    unlike: impl Fn(&L, &L, &scene::PairOf) -> L,
) -> PerPair<L> {
    let count = grains.materials.len() + 1;
    let value = |a: usize, b: usize| match grains.pair_of(a, b) {
        // The smaller number first, so that both orders give the same bits.
        Some(pair) => unlike(&own(a.min(b)), &own(a.max(b)), pair),
        // Of equal materials; or of two that never meet.
        None => own(a),
    };
    let all = (0..count).flat_map(|a| (0..count).map(move |b| (a, b)));
    PerPair::table(all.map(|(a, b)| value(a, b)).collect(), count)
}

/// The laws of one wall against each material of grains; `touched` makes it of the number of that and the law of the pair.
pub(crate) fn at_wall<L: Clone, M>(
    grains: &scene::Grains,
    wall: &scene::Wall,
    laws: &PerPair<L>,
    touched: impl Fn(usize, &L) -> M,
) -> PerPair<M> {
    let count = grains.materials.len() + 1;
    let against = |a: usize| &laws.laws()[a * count + wall.material.unwrap_or(a)];
    PerPair::table((0..count).map(|a| touched(a, against(a))).collect(), 1)
}

/// The largest of each constant.
pub(crate) fn stiffest(all: impl Iterator<Item = Linear>) -> Linear {
    all.fold(Linear::default(), |most, one| Linear {
        normal_stiffness: most.normal_stiffness.max(one.normal_stiffness),
        tangential_stiffness: most.tangential_stiffness.max(one.tangential_stiffness),
        normal_damping: most.normal_damping.max(one.normal_damping),
        tangential_damping: most.tangential_damping.max(one.tangential_damping),
    })
}

/// What is not modelled around the grains, with water or without.
fn around(scene: &scene::Scene) -> &'static str {
    match scene.water {
        Some(_) => "lift, the grains' effect on the water, air, cohesion, breakage",
        None => "water, air, cohesion, breakage",
    }
}
