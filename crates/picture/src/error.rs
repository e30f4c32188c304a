//! What can go wrong between a picture and its file, always with the path.

use std::fmt;
use std::path::{Path, PathBuf};

/// A picture that could not be written.
#[derive(Debug)]
pub enum PictureError {
    /// The file could not be created, written or renamed.
    File {
        /// The file concerned.
        path: PathBuf,
        /// What the machine said.
        source: std::io::Error,
    },
    /// The picture could not be put into the file's format.
    Format {
        /// The file concerned.
        path: PathBuf,
        /// What is wrong and what would be right.
        reason: String,
    },
}

impl PictureError {
    pub(crate) fn file(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::File { path, source }
    }

    pub(crate) fn format(path: &Path, reason: impl fmt::Display) -> Self {
        Self::Format {
            path: path.to_path_buf(),
            reason: reason.to_string(),
        }
    }

    /// The file that was to be written.
    pub fn path(&self) -> &Path {
        match self {
            Self::File { path, .. } | Self::Format { path, .. } => path,
        }
    }
}

impl fmt::Display for PictureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, source } => write!(f, "cannot write {}: {source}", path.display()),
            Self::Format { path, reason } => {
                write!(f, "cannot make the picture {}: {reason}", path.display())
            }
        }
    }
}

impl std::error::Error for PictureError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::File { source, .. } => Some(source),
            Self::Format { .. } => None,
        }
    }
}
