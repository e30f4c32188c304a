//! Files that appear under their name only when all of them is written.

use crate::error::PictureError;
use std::path::{Path, PathBuf};

/// The name until the file is whole.
pub(crate) fn partial(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_os_string();
    name.push(".part");
    PathBuf::from(name)
}

/// Writes a file beside its place and renames it; nothing is left where that fails.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), PictureError> {
    let partial = partial(path);
    let done = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    if done.is_err() {
        let _ = std::fs::remove_file(&partial);
    }
    done.map_err(PictureError::file(path))
}
