//! From a source to a checked scene that still knows where each field stands.

use std::fmt;
use std::sync::Arc;

use crate::error::{Place, SceneError, Trouble};
use crate::path::{follow, segments};
use crate::pieces::Pieces;
use crate::rules::Rules;
use crate::scan::Node;
use crate::scene::Scene;
use crate::source::Source;

/// A checked scene, and the places of its fields for the troubles that later stages find.
#[derive(Clone)]
pub struct Checked {
    /// The scene.
    pub scene: Scene,
    map: Arc<Map>,
}

/// The places of the fields of a scene.
pub(crate) struct Map {
    pieces: Pieces,
    tree: Node,
}

impl Checked {
    /// An error at the field of this path (`grains.diameter`, `walls[0].friction`, `walls.floor.friction`).
    ///
    /// Where the scene leaves the field to its default, the block around it is pointed at.
    pub fn problem(
        &self,
        path: &str,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> SceneError {
        SceneError::new(what, remedy, self.map.place(path))
    }
}

impl fmt::Debug for Checked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.scene.fmt(f)
    }
}

impl Map {
    /// Where the value of a field stands; of a block of several lines, or one that lacks the field, the name.
    pub fn place(&self, path: &str) -> Place {
        let parts = segments(path).unwrap_or_default();
        let count = parts.len();
        let reached = follow(
            &self.tree,
            self.pieces.text(),
            parts.into_iter().map(|part| &path[part]),
        );
        let name = reached.item.and_then(|item| item.key.clone());
        let value = reached.node.span.clone();
        let one_line = !self.pieces.text()[value.clone()].contains('\n');
        self.pieces.place(if reached.parts == count && one_line {
            value
        } else {
            name.unwrap_or(value)
        })
    }
}

pub(crate) fn check(source: &Source) -> Result<Checked, SceneError> {
    let (tree, raw) =
        crate::ron_trouble::read(source.text()).map_err(|bad| bad.error(&source.pieces))?;
    let map = Arc::new(Map {
        pieces: source.pieces.clone(),
        tree,
    });
    let mut rules = Rules::new(&source.folder);
    let scene = rules.scene(raw);
    let trouble = |refusal: crate::rules::Refusal| Trouble {
        what: refusal.what,
        remedy: refusal.remedy,
        place: map.place(&refusal.path),
    };
    match (
        SceneError::of(rules.refusals.into_iter().map(trouble).collect()),
        scene,
    ) {
        (Some(error), _) => Err(error),
        (None, Some(scene)) => Ok(Checked { scene, map }),
        // A scene is only withheld together with a refusal.
        (None, None) => Err(SceneError::new(
            "the scene is incomplete",
            "",
            Place::Whole(map.pieces.name().into()),
        )),
    }
}
