//! What can go wrong while a run writes, and whose turn it is to act.

use std::error::Error;
use std::fmt;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Who can put the trouble right; the command chooses its exit code by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// What the user asked for cannot be done as asked: the folder exists, a name is a file.
    Arguments,
    /// The machine refused: the disk is full, the place may not be written to.
    Machine,
    /// The program that calls this crate broke a promise, as with columns of unequal length.
    Caller,
}

/// An error of writing: what could not be done, where, why, and what to do about it.
#[derive(Debug)]
pub struct RecordError {
    fault: Fault,
    what: String,
    place: PathBuf,
    remedy: String,
    cause: Option<io::Error>,
}

impl RecordError {
    /// Whose turn it is to act.
    pub fn fault(&self) -> Fault {
        self.fault
    }

    /// The exit code a command ends with: 2 for arguments, 4 for the machine.
    ///
    /// A fault of the calling program is 4 too: nothing in the scene or the arguments could repair it.
    pub fn exit_code(&self) -> u8 {
        match self.fault {
            Fault::Arguments => 2,
            Fault::Machine | Fault::Caller => 4,
        }
    }

    /// The file or folder the error is about.
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// What to do about it, as a sentence.
    pub fn remedy(&self) -> &str {
        &self.remedy
    }

    pub(crate) fn arguments(what: impl Into<String>, place: &Path, remedy: &str) -> Self {
        Self {
            fault: Fault::Arguments,
            what: what.into(),
            place: place.into(),
            remedy: remedy.into(),
            cause: None,
        }
    }

    /// What is on the disk is not what was written there.
    pub(crate) fn damaged(what: impl Into<String>, place: &Path, remedy: &str) -> Self {
        Self {
            fault: Fault::Machine,
            ..Self::arguments(what, place, remedy)
        }
    }

    pub(crate) fn machine(what: impl Into<String>, place: &Path, cause: io::Error) -> Self {
        Self {
            fault: Fault::Machine,
            what: what.into(),
            place: place.into(),
            remedy: machine_remedy(cause.kind()).into(),
            cause: Some(cause),
        }
    }

    pub(crate) fn caller(what: impl Into<String>, place: &Path) -> Self {
        Self {
            fault: Fault::Caller,
            what: what.into(),
            place: place.into(),
            remedy: "This is a fault of the program, not of the scene: please report it.".into(),
            cause: None,
        }
    }
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place.display(), self.what)?;
        if let Some(cause) = &self.cause {
            write!(f, ": {cause}")?;
        }
        write!(f, ". {}", self.remedy)
    }
}

impl Error for RecordError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.cause.as_ref().map(|cause| cause as _)
    }
}

fn machine_remedy(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "Free some space there, or choose a folder on another disk with --out."
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "Choose a folder you may write to with --out, or change the permissions of this one."
        }
        ErrorKind::NotFound => {
            "Something removed or moved the folder meanwhile; leave it in place and start again."
        }
        _ => "Check the disk, or choose another folder with --out.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_says_what_where_and_what_to_do() {
        let error = RecordError::machine(
            "a row could not be written",
            Path::new("out/pile/series.csv"),
            ErrorKind::StorageFull.into(),
        );
        let text = error.to_string();
        assert!(
            text.starts_with("out/pile/series.csv: a row could not be written: "),
            "{text}"
        );
        assert!(
            text.ends_with("Free some space there, or choose a folder on another disk with --out."),
            "{text}"
        );
        assert_eq!(error.exit_code(), 4);
        assert!(error.source().is_some());
    }

    #[test]
    fn wrong_arguments_end_with_two() {
        let error = RecordError::arguments("it exists", Path::new("a"), "Take another.");
        assert_eq!(error.to_string(), "a: it exists. Take another.");
        assert_eq!(error.exit_code(), 2);
        assert!(error.source().is_none());
    }
}
