//! A scene's text: read from a file, overridden by `--set`, checked.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::check::{Checked, check};
use crate::error::{Place, SceneError};
use crate::pieces::Pieces;

/// The longest scene that is read, in bytes; a list of 50 000 grains fits.
const LONGEST: u64 = 8 << 20;

/// The text of a scene and the overrides laid over it.
#[derive(Clone, Debug)]
pub struct Source {
    pub(crate) pieces: Pieces,
    /// The folder that relative paths in the scene start from.
    pub(crate) folder: PathBuf,
}

impl Source {
    /// Reads a scene file.
    ///
    /// # Errors
    /// When it cannot be read, is a folder, is too long, or is not UTF-8.
    pub fn read(path: impl AsRef<Path>) -> Result<Source, SceneError> {
        let path = path.as_ref();
        let text = read_text(path, LONGEST, "a scene")?;
        let mut source = Source::from_text(&path.display().to_string(), &text);
        source.folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(source)
    }

    /// A scene from a text; `name` stands in messages where the file's name would.
    /// Relative paths in it start from the current folder.
    pub fn from_text(name: &str, text: &str) -> Source {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Source {
            pieces: Pieces::new(name.into(), text.into()),
            folder: PathBuf::new(),
        }
    }

    /// The text with the overrides in their places.
    pub fn text(&self) -> &str {
        self.pieces.text()
    }

    /// Lays an override over the text: `path=value`, as typed after `--set`.
    ///
    /// The path names fields from the top, parted by dots; an item of a list by its number or its name:
    /// `grains.coarse=3`, `walls[0].friction=0.2`, `walls.floor.friction=0.2`, `grains.law.stiffness=YoungModulus("1 GPa")`.
    /// A value stands there as in the file; a text or a quantity may go without its quotes: `time.until=2 s`.
    /// A field that the scene lacks is added, and the one that excludes it is removed (`initial.file` for
    /// `initial.fill`). A relative path to a file of grains or of a mesh that exists from the current folder is that
    /// file; else it starts from the scene's folder, as in the scene.
    ///
    /// # Errors
    /// When there is no `=`, the path leads nowhere, or the scene's brackets do not match.
    /// A value of the wrong kind is found by [`check`](Source::check).
    pub fn set(&mut self, spec: &str) -> Result<(), SceneError> {
        crate::set::set(self, spec)
    }

    /// Checks the scene.
    ///
    /// # Errors
    /// With what is wrong, where, and what to do; independent troubles are listed together.
    pub fn check(&self) -> Result<Checked, SceneError> {
        check(self)
    }
}

/// Reads a text file of at most `longest` bytes; `kind` says in messages what it should be.
pub(crate) fn read_text(path: &Path, longest: u64, kind: &str) -> Result<String, SceneError> {
    let name = path.display().to_string();
    let error =
        |what: String, remedy: &str| SceneError::new(what, remedy, Place::Whole(name.clone()));
    let cannot = |cause: std::io::Error| {
        error(
            format!("cannot read this file as {kind}: {cause}"),
            "check the path and its permissions",
        )
    };
    if path.is_dir() {
        return Err(error(
            format!("this is a folder, not {kind}"),
            "give the path of a file in it",
        ));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(longest + 1).read_to_end(&mut bytes))
        .map_err(cannot)?;
    if bytes.len() as u64 > longest {
        return Err(error(
            format!(
                "this file is too long for {kind}: over {} MB",
                longest >> 20
            ),
            "is it the file you meant?",
        ));
    }
    String::from_utf8(bytes).map_err(|bad| {
        let valid = bad.utf8_error().valid_up_to();
        let line = bad.as_bytes()[..valid]
            .iter()
            .filter(|byte| **byte == b'\n')
            .count()
            + 1;
        error(
            format!("this file is not UTF-8 text: line {line} holds other bytes"),
            "save it as UTF-8; is it the file you meant?",
        )
    })
}
