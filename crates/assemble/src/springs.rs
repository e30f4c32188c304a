//! Grains that turn: their constants from what the scene says, in water or dry.

use tsubu_contact::{Normal, Slip, SpringDashpot, Tension, restitution};
use tsubu_model::Kind;
use tsubu_scene as scene;
use tsubu_scene::{Checked, SceneError};
use tsubu_stream::{Sediment, Water};

/// The constants of the water.
pub(crate) fn clear_water(water: &scene::Water, gravity: f64) -> Water {
    Water {
        density: water.density,
        gravity,
        drag: water.drag,
        added_mass: water.added_mass,
    }
}

/// The largest grain as sediment.
pub(crate) fn sediment(grains: &scene::Grains) -> Sediment {
    Sediment {
        diameter: grains.diameter,
        density: grains.density(),
    }
}

/// The largest grain at n = 0: dry, or with added mass and its weight under water.
pub(crate) fn grain(checked: &Checked) -> Result<Kind, SceneError> {
    of_size(checked, checked.scene.grains.diameter)
}

/// A grain of the scene's material at this diameter in m.
pub(crate) fn of_size(checked: &Checked, diameter: f64) -> Result<Kind, SceneError> {
    let scene = &checked.scene;
    let grains = &scene.grains;
    let share = diameter / grains.diameter;
    match &scene.water {
        None => Ok(Kind::with_mass(diameter, grains.mass * share.powi(3))),
        Some(water) => clear_water(water, scene.gravity)
            .grain(&Sediment {
                diameter,
                ..sediment(grains)
            })
            .map_err(|e| checked.problem("water", e.to_string(), "change the water or the grains")),
    }
}

/// The law between grains at n = 0.
pub(crate) fn law(wanted: &scene::SpringDashpot, grain: &Kind) -> SpringDashpot {
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

/// The law while the grains settle, with this share of its damping.
pub(crate) fn settling(law: &SpringDashpot, share: f64) -> SpringDashpot {
    SpringDashpot {
        normal_damping: law.normal_damping * share,
        tangential_damping: law.tangential_damping * share,
        ..*law
    }
}

/// The law at each wall: the grains' own, with the wall's friction, and its restitution if it has one.
pub(crate) fn walls(
    scene: &scene::Scene,
    grains: &SpringDashpot,
    kind: &Kind,
) -> Vec<SpringDashpot> {
    let wall = |wall: &scene::Wall| {
        let mut law = *grains;
        law.friction = wall.friction.unwrap_or(grains.friction);
        if let Some(e) = wall.restitution {
            let zeta = restitution::ratio_from_restitution(e);
            let damping = 2.0 * zeta * (kind.mass * grains.normal_stiffness).sqrt();
            let share = if grains.normal_damping > 0.0 {
                grains.tangential_damping / grains.normal_damping
            } else {
                (grains.tangential_stiffness / grains.normal_stiffness).sqrt()
            };
            (law.normal_damping, law.tangential_damping) = (damping, share * damping);
        }
        law
    };
    scene.walls.iter().map(wall).collect()
}
