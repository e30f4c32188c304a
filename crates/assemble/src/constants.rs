//! From the scene's grains to the constants that run: softened, then coarsened, then the step.

use crate::springs;
use std::f64::consts::PI;
use tsubu_coarsen::{
    CoarseRule, Gap, Level, RadlRestitution, Renormalised, SakaiKoshizuka, check_gaps, coarsen,
};
use tsubu_contact::{BodyLaw, Repulsion, RepulsiveWall, SpringDashpot, WallGrains, restitution};
use tsubu_integrate::Scheme;
use tsubu_model::Kind;
use tsubu_scene as scene;
use tsubu_scene::{Checked, SceneError};

/// The constants of a run, all at the coarse level of the scene.
#[derive(Clone, Debug)]
pub struct Constants {
    /// The grain.
    pub kind: Kind,
    /// The kinds of a mixture in the order of the scene's sizes; empty for one size. `kind` is the largest.
    pub sizes: Vec<Kind>,
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

/// The law between grains, with that of each wall.
#[derive(Clone, Debug)]
pub enum Law {
    /// Of grains without spin.
    Repulsion {
        /// Between grains.
        law: Repulsion,
        /// True if γn = γt: the law needs neither root nor projection.
        isotropic: bool,
        /// At each wall.
        walls: Vec<BodyLaw>,
    },
    /// Of grains that turn.
    SpringDashpot {
        /// Between grains.
        law: SpringDashpot,
        /// At each wall.
        walls: Vec<SpringDashpot>,
    },
}

impl Law {
    /// Normal stiffness of two grains in N/m.
    pub fn stiffness(&self) -> f64 {
        match self {
            Law::Repulsion { law, .. } => law.stiffness(),
            Law::SpringDashpot { law, .. } => law.normal_stiffness,
        }
    }
}

impl Constants {
    /// Works out the constants; refuses a coarse level that a gap or the rule does not bear.
    pub fn of(checked: &Checked) -> Result<Self, SceneError> {
        let scene = &checked.scene;
        let grains = &scene.grains;
        let fine = springs::grain(checked)?;
        let level = Level::new(grains.coarse);
        let rule = rule_of(checked, &fine)?;
        let refuse = |trouble: tsubu_coarsen::TooCoarse| {
            checked.problem(
                "grains.coarse",
                trouble.to_string(),
                "lower grains.coarse, or choose another grains.coarse_rule",
            )
        };
        let kind = coarsen(&*rule, &fine, level).map_err(refuse)?;
        let law = match &grains.law {
            scene::Law::Repulsion { stiffness, damping } => {
                let law = softened(grains, stiffness, damping);
                repulsion(scene, coarsen(&*rule, &law, level).map_err(refuse)?)
            }
            scene::Law::SpringDashpot(wanted) => {
                let law = springs::law(wanted, &fine);
                let law = coarsen(&*rule, &law, level).map_err(refuse)?;
                Law::SpringDashpot {
                    law,
                    walls: springs::walls(scene, &law, &kind),
                }
            }
        };
        if grains.coarse > 0 {
            check_gaps(&gaps(scene), grains.diameter, level).map_err(|narrow| {
                checked.problem(
                    "grains.coarse",
                    narrow.to_string(),
                    "lower grains.coarse or widen the gap",
                )
            })?;
        }
        let period = 2.0 * PI * (0.5 * kind.mass / law.stiffness()).sqrt();
        let dt = match scene.time.step {
            scene::Step::Automatic => period / STEPS_PER_PERIOD,
            scene::Step::PerPeriod(steps) => period / steps,
            scene::Step::Seconds(dt) => dt * rule.step_factor(level.lambda()),
            scene::Step::Exactly(dt) => dt,
        };
        let mut sources = match law {
            Law::Repulsion { .. } => vec!["Sumitomo2024", "Weeks1971"],
            Law::SpringDashpot { .. } => vec!["Gotoh2001"],
        };
        if grains.coarse > 0 {
            let of_rule = rule.source().split(',').map(str::trim);
            let new: Vec<&str> = of_rule.filter(|key| !sources.contains(key)).collect();
            sources.extend(new);
        }
        let bed = matches!(scene.initial, scene::Initial::Bed(_));
        if !bed && !grains.sizes.is_empty() {
            return Err(checked.problem(
                "grains.sizes",
                "only a bed is made of several sizes yet",
                "write initial: (bed: …), or leave out sizes",
            ));
        }
        let sizes = grains.sizes.iter();
        let sizes = sizes
            .map(|size| springs::of_size(checked, size.diameter))
            .collect::<Result<_, _>>()?;
        let mut constants = Self {
            kind,
            sizes,
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

    /// K = kΔt²/m of one grain's mass.
    pub fn k(&self) -> f64 {
        self.law.stiffness() * self.dt * self.dt / self.kind.mass
    }

    /// C = γΔt/m with the larger of the two dampings.
    pub fn c(&self) -> f64 {
        let damping = match &self.law {
            Law::Repulsion { law, .. } => law.normal_damping.max(law.tangential_damping),
            Law::SpringDashpot { law, .. } => law.normal_damping,
        };
        damping * self.dt / self.kind.mass
    }
}

/// Steps per period of a contact where the scene leaves the step to the program: single collisions are then known to some
/// per cent (`cargo xtask validate collision`).
const STEPS_PER_PERIOD: f64 = 20.0;

/// The laws of grains without spin. A wall shares the grains' potential; its own constants go through the plain rule
/// (crate coarsen says why).
fn repulsion(scene: &scene::Scene, coarse: Repulsion) -> Law {
    let wall = |wall: &scene::Wall| match wall.shape.wall_grains() {
        // Of the coarse grains' material, at the size that the scene gives.
        Some(radius) => BodyLaw::Grains(WallGrains {
            grains: coarse,
            radius,
        }),
        None => BodyLaw::Surface(RepulsiveWall {
            grains: coarse,
            restitution: wall.restitution,
            friction: wall.friction.unwrap_or(0.0),
        }),
    };
    Law::Repulsion {
        law: coarse,
        isotropic: coarse.normal_damping == coarse.tangential_damping,
        walls: scene.walls.iter().map(wall).collect(),
    }
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

fn rule_of(checked: &Checked, kind: &Kind) -> Result<Box<dyn CoarseRule>, SceneError> {
    Ok(match checked.scene.grains.coarse_rule {
        scene::CoarseRule::Renormalised => Box::new(Renormalised),
        scene::CoarseRule::SakaiKoshizuka => Box::new(SakaiKoshizuka),
        scene::CoarseRule::RadlRestitution => {
            let grains = &checked.scene.grains;
            let e = match &grains.law {
                scene::Law::Repulsion { stiffness, damping } => {
                    let law = softened(grains, stiffness, damping);
                    restitution::at_zero_overlap(law.damping_ratio(0.5 * kind.mass))
                }
                scene::Law::SpringDashpot(wanted) => {
                    let law = springs::law(wanted, kind);
                    restitution::at_zero_force(law.damping_ratio(0.5 * kind.mass))
                }
            };
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
