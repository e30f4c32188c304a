//! Where the grains of bodies built of grains are: other engines have no such surface, only grains.

use crate::build::Choices;
use crate::constants::Constants;
use crate::surfaces::Shapes;
use glam::DVec3;
use tsubu_scene::{Checked, MeshSurface, SceneError, Shape};

/// For each wall of the scene the centres of its wall grains in m, where it stands at the start; none for other walls.
pub fn wall_grains(checked: &Checked) -> Result<Vec<Vec<DVec3>>, SceneError> {
    let choices = Choices::default();
    let shapes = Shapes {
        checked,
        choices: &choices,
        diameter: Constants::of(checked)?.kind.diameter(),
    };
    let walls = checked.scene.walls.iter().enumerate();
    walls
        .map(|(number, wall)| match &wall.shape {
            Shape::Mesh {
                mesh,
                surface: MeshSurface::Grains { radius, thin },
                thickness,
            } => shapes
                .of_grains(number, mesh, *radius, *thin, *thickness)
                .map(|body| body.centres().to_vec()),
            _ => Ok(Vec::new()),
        })
        .collect()
}
