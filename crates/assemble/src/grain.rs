//! A grain from what the scene says, in water or dry.

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
    let grains = &checked.scene.grains;
    of_size(checked, grains.diameter, grains.density(), grains.mass)
}

/// A grain of a population at n = 0.
pub(crate) fn of_population(
    checked: &Checked,
    population: &scene::Population,
) -> Result<Kind, SceneError> {
    let grains = &checked.scene.grains;
    let share = (population.diameter / grains.diameter).powi(3);
    let mass = if population.density == grains.density() {
        grains.mass * share
    } else {
        population.density * grains.volume() * share
    };
    let kind = of_size(checked, population.diameter, population.density, mass)?;
    Ok(kind.of(population.material))
}

fn of_size(checked: &Checked, diameter: f64, density: f64, mass: f64) -> Result<Kind, SceneError> {
    let scene = &checked.scene;
    match &scene.water {
        None => Ok(Kind::with_mass(diameter, mass)),
        Some(water) => clear_water(water, scene.gravity)
            .grain(&Sediment { diameter, density })
            .map_err(|e| checked.problem("water", e.to_string(), "change the water or the grains")),
    }
}
