//! Writing a file so that it is there whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::RecordError;

/// The end of the name of a file that is still being written.
pub(crate) const PART_SUFFIX: &str = ".tsubu-part";

/// Writes `bytes` to `path` whole: a reader sees the old file or the new one, never a piece,
/// and a kill or a full disk at any moment leaves the old one as it was.
///
/// The bytes go to a hidden file in the same folder, are forced to the disk, and the file takes its name last.
/// That hidden file always has the same name, so a killed run leaves at most one of them behind per file.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), RecordError> {
    write_whole_by(path, |file| file.write_all(bytes))
}

/// The same with a file that `write` fills.
pub(crate) fn write_whole_by(
    path: &Path,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), RecordError> {
    let part = part_of(path)?;
    write_and_rename(&part, path, write).map_err(|cause| {
        // Best effort: the error to report is the first one.
        fs::remove_file(&part).ok();
        RecordError::machine("it could not be written", path, cause)
    })
}

fn write_and_rename(
    part: &Path,
    path: &Path,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = File::create(part)?;
    write(&mut file)?;
    file.sync_all()?;
    drop(file);
    fs::rename(part, path)
}

fn part_of(path: &Path) -> Result<PathBuf, RecordError> {
    let Some(name) = path.file_name() else {
        return Err(RecordError::caller("it does not name a file", path));
    };
    let mut part = OsString::from(".");
    part.push(name);
    part.push(PART_SUFFIX);
    Ok(path.with_file_name(part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fault;
    use crate::scratch::{Scratch, names};

    #[test]
    fn replaces_the_old_file_and_leaves_nothing_else() {
        let scratch = Scratch::new();
        let path = scratch.join("a.txt");
        write_whole(&path, b"a long old text").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(scratch.path()), ["a.txt"]);
    }

    #[test]
    fn what_a_kill_left_behind_is_no_obstacle() {
        let scratch = Scratch::new();
        let path = scratch.join("a.txt");
        fs::write(scratch.join(".a.txt.tsubu-part"), "half of a lon").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(scratch.path()), ["a.txt"]);
    }

    #[test]
    fn a_missing_folder_is_an_error_and_stays_missing() {
        let scratch = Scratch::new();
        let error = write_whole(&scratch.join("no/a.txt"), b"new").unwrap_err();
        assert_eq!(error.fault(), Fault::Machine);
        assert!(names(scratch.path()).is_empty());
    }

    #[test]
    fn a_path_without_a_name_is_the_callers_fault() {
        assert_eq!(
            write_whole(Path::new("/"), b"").unwrap_err().fault(),
            Fault::Caller
        );
    }

    /// The part file is a link to the device that is always full.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_keeps_the_old_file() {
        let scratch = Scratch::new();
        let path = scratch.join("a.txt");
        write_whole(&path, b"old").unwrap();
        std::os::unix::fs::symlink("/dev/full", scratch.join(".a.txt.tsubu-part")).unwrap();
        let error = write_whole(&path, b"new").unwrap_err();
        assert_eq!(error.fault(), Fault::Machine);
        assert!(error.remedy().contains("Free some space"), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(scratch.path()), ["a.txt"]);
    }
}
