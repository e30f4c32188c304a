//! The grains at the start, as far as the scene lists them or names their file.

use crate::check::Checked;
use crate::error::SceneError;
use crate::grain_file::GrainFile;
use crate::scene::{Initial, Scene, Shape, StartingGrain};
use std::path::Path;

impl Scene {
    /// The files that it names: meshes of walls, the mesh that is filled, the grains.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let walls = self.walls.iter().filter_map(|wall| match &wall.shape {
            Shape::Mesh { mesh, .. } => Some(&*mesh.path),
            _ => None,
        });
        let start = match &self.initial {
            Initial::Fill(fill) => fill.within.as_ref().map(|mesh| &*mesh.path),
            Initial::File(path) => Some(&**path),
            Initial::Grains(_) | Initial::Bed(_) => None,
        };
        walls.chain(start)
    }
}

impl Checked {
    /// The grains listed in the scene or read from its file; `None` if they are to be placed by a [`Fill`](crate::Fill) or a [`Bed`](crate::Bed).
    ///
    /// # Errors
    /// At `initial.file` when the file cannot be read, and at the file's own line and column when its content is wrong.
    pub fn starting_grains(&self) -> Result<Option<Vec<StartingGrain>>, SceneError> {
        match &self.scene.initial {
            Initial::Fill(_) | Initial::Bed(_) => Ok(None),
            Initial::Grains(grains) => Ok(Some(grains.clone())),
            Initial::File(path) => {
                if !path.is_file() {
                    let what = format!("there is no grain file {}", path.display());
                    let remedy = "a path in a scene starts from the scene's folder; --set initial.file=PATH names another file";
                    return Err(self.problem("initial.file", what, remedy));
                }
                let grains = &self.scene.grains;
                let diameters: Vec<f64> = match grains.populations.len() {
                    0 => vec![grains.diameter],
                    _ => grains.populations.iter().map(|one| one.diameter).collect(),
                };
                GrainFile::read(path, &diameters, self.scene.space).map(|file| Some(file.grains))
            }
        }
    }
}
