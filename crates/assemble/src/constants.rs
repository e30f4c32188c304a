//! From the scene's grains to the constants that run: softened, then coarsened, then the step.

use crate::grain;
use crate::law::{Coarse, Law};
use std::f64::consts::PI;
use tsubu_coarsen::{
    CoarseRule, Gap, Level, RadlRestitution, Renormalised, SakaiKoshizuka, check_gaps,
};
use tsubu_integrate::Scheme;
use tsubu_model::Kind;
use tsubu_scene as scene;
use tsubu_scene::{Checked, SceneError};

/// The constants of a run, all at the coarse level of the scene.
#[derive(Clone, Debug)]
pub struct Constants {
    /// The grain.
    pub kind: Kind,
    /// The kinds of a mixture in the order of the scene's populations; empty for one kind. `kind` is the largest.
    pub populations: Vec<Kind>,
    /// Share of the mass of each.
    pub shares: Vec<f64>,
    /// The lightest kind, whose contacts are the quickest.
    pub quickest: Kind,
    /// Grains that no force moves, of a bed's fixed row; `None` if there are none.
    pub fixed: Option<Kind>,
    /// The laws.
    pub law: Law,
    /// λ = 2^n.
    pub lambda: f64,
    /// Name of the coarse-graining rule.
    pub rule: &'static str,
    /// Sources of the law and the rule, keys of the bibliography.
    pub sources: Vec<&'static str>,
    /// The scheme.
    pub scheme: Scheme,
    /// Δt in s.
    pub dt: f64,
    /// Period of a pair of touching grains, 2π√(m*/k), in s.
    pub period: f64,
}

impl Constants {
    /// Works out the constants; refuses a coarse level that a gap or the rule does not bear.
    pub fn of(checked: &Checked) -> Result<Self, SceneError> {
        let scene = &checked.scene;
        let grains = &scene.grains;
        let fine = grain::grain(checked)?;
        let level = Level::new(grains.coarse);
        let rule = rule_of(checked, &fine)?;
        let refuse = |trouble: tsubu_coarsen::TooCoarse| {
            checked.problem(
                "grains.coarse",
                trouble.to_string(),
                "lower grains.coarse, or choose another grains.coarse_rule",
            )
        };
        let coarse = Coarse {
            rule: &*rule,
            level,
        };
        let kind = coarse.of(&fine).map_err(refuse)?;
        let law = Law::of(scene, &fine, &kind, &coarse).map_err(refuse)?;
        let populations = grains
            .populations
            .iter()
            .map(|one| {
                let fine = grain::of_population(checked, one)?;
                coarse.of(&fine).map_err(refuse)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let lighter = |a: &Kind, b: &Kind| a.mass.total_cmp(&b.mass);
        let quickest = populations.iter().copied().min_by(lighter).unwrap_or(kind);
        if grains.coarse > 0 {
            check_gaps(&gaps(scene), grains.diameter, level).map_err(|narrow| {
                checked.problem(
                    "grains.coarse",
                    narrow.to_string(),
                    "lower grains.coarse or widen the gap",
                )
            })?;
        }
        let stiffness = law.linear(&quickest).normal_stiffness;
        let period = 2.0 * PI * (0.5 * quickest.mass / stiffness).sqrt();
        let dt = match scene.time.step {
            scene::Step::Automatic => period / STEPS_PER_PERIOD,
            scene::Step::PerPeriod(steps) => period / steps,
            scene::Step::Seconds(dt) => dt * rule.step_factor(level.lambda()),
            scene::Step::Exactly(dt) => dt,
        };
        let mut sources = law.sources();
        if grains.coarse > 0 {
            let of_rule = rule.source().split(',').map(str::trim);
            let new: Vec<&str> = of_rule.filter(|key| !sources.contains(key)).collect();
            sources.extend(new);
        }
        let bed = matches!(scene.initial, scene::Initial::Bed(_));
        let mut constants = Self {
            kind,
            shares: grains.populations.iter().map(|one| one.share).collect(),
            populations,
            quickest,
            fixed: bed.then_some(Kind {
                mass: f64::INFINITY,
                inertia: f64::INFINITY,
                weight: 0.0,
                ..kind
            }),
            law,
            lambda: level.lambda(),
            rule: rule.name(),
            sources,
            scheme: scheme_of(scene.time.integrator),
            dt,
            period,
        };
        if scene.time.step == scene::Step::Automatic {
            constants.shorten_step();
        }
        Ok(constants)
    }

    /// Mean diameter of the grains by mass, m.
    pub(crate) fn mean_diameter(&self) -> f64 {
        if self.populations.is_empty() {
            return self.kind.diameter();
        }
        let kinds = self.populations.iter().zip(&self.shares);
        kinds.map(|(kind, share)| share * kind.diameter()).sum()
    }

    /// Diameter of a kind by its number, m: a population, or the only one.
    pub(crate) fn diameter_of(&self, kind: usize) -> f64 {
        self.populations.get(kind).unwrap_or(&self.kind).diameter()
    }

    /// K = kΔt²/m of two equal grains of the lightest kind, by the mass of one.
    pub fn k(&self) -> f64 {
        let stiffness = self.law.linear(&self.quickest).normal_stiffness;
        stiffness * self.dt * self.dt / self.quickest.mass
    }

    /// C = γΔt/m with the larger of the two dampings.
    pub fn c(&self) -> f64 {
        let linear = self.law.linear(&self.quickest);
        let across = if self.law.turns() {
            0.0
        } else {
            linear.tangential_damping
        };
        linear.normal_damping.max(across) * self.dt / self.quickest.mass
    }
}

/// Steps per period of a contact where the scene leaves the step to the program: single collisions are then known to some
/// per cent (`cargo xtask validate collision`).
const STEPS_PER_PERIOD: f64 = 20.0;

fn rule_of(checked: &Checked, kind: &Kind) -> Result<Box<dyn CoarseRule>, SceneError> {
    Ok(match checked.scene.grains.coarse_rule {
        scene::CoarseRule::Renormalised => Box::new(Renormalised),
        scene::CoarseRule::SakaiKoshizuka => Box::new(SakaiKoshizuka),
        scene::CoarseRule::RadlRestitution => {
            let e = Law::restitution_of(&checked.scene, kind);
            let rule = RadlRestitution::new(e).map_err(|bad| {
                checked.problem(
                    "grains.coarse_rule",
                    bad.to_string(),
                    "choose Renormalised, or lower the damping",
                )
            })?;
            Box::new(rule)
        }
    })
}

/// Gaps that a grain has to fit: periodic lengths and the room between facing walls.
fn gaps(scene: &scene::Scene) -> Vec<Gap> {
    let mut gaps = Vec::new();
    for (name, axis) in [
        ("domain.x", scene.domain.x),
        ("domain.y", scene.domain.y),
        ("domain.z", scene.domain.z),
    ] {
        if let scene::Axis::Periodic(length) = axis {
            gaps.push(Gap::new(name, length));
        }
    }
    for (i, a) in scene.walls.iter().enumerate() {
        for b in &scene.walls[i + 1..] {
            let (
                scene::Shape::HalfSpace {
                    point: p,
                    outward: n,
                },
                scene::Shape::HalfSpace {
                    point: q,
                    outward: m,
                },
            ) = (&a.shape, &b.shape)
            else {
                continue;
            };
            if n.dot(*m) < -1.0 + 1e-9 && (*q - *p).dot(*n) > 0.0 {
                gaps.push(Gap::new(
                    format!("between the walls `{}` and `{}`", a.name, b.name),
                    (*q - *p).dot(*n),
                ));
            }
        }
    }
    gaps
}

fn scheme_of(integrator: scene::Integrator) -> Scheme {
    match integrator {
        scene::Integrator::ExplicitEuler => Scheme::ExplicitEuler,
        scene::Integrator::SymplecticEuler => Scheme::SymplecticEuler,
        scene::Integrator::VerletOld => Scheme::VerletOld,
        scene::Integrator::VerletAveraged { sweeps } => Scheme::VerletAveraged { sweeps },
        scene::Integrator::DashpotImplicit { sweeps } => Scheme::DashpotImplicit { sweeps },
    }
}
