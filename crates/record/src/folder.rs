//! The folder of one run: found or made, claimed, and never shared with another run.

use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use crate::RecordError;
use crate::whole::PART_SUFFIX;

/// Where runs go when no folder was asked for.
const DEFAULT_BASE: &str = "out";

/// The file by which a run claims its folder, and by which a later one knows that it may replace it.
const CLAIM: &str = ".tsubu-run";

const CLAIM_TEXT: &[u8] =
    b"A run of tsubu wrote this folder; a later run with --force may replace what it wrote.\n";

/// Every name a run writes at the top of its folder, apart from `animation.*`, unfinished parts and the runs of seeds.
const OURS: [&str; 8] = [
    "summary.json",
    "series.csv",
    "frames.pvd",
    "frames",
    "figures",
    "checkpoint",
    "scene.resolved.ron",
    CLAIM,
];

/// Beginning of the name of a run's folder in the folder of several seeds; the seed follows.
const SEED: &str = "seed-";

/// Names that prove a run of ours wrote the folder; `figures` or `summary.json` could be anyone's.
const PROOF: [&str; 2] = [CLAIM, "scene.resolved.ron"];

/// A folder that belongs to this run alone: its claim is locked as long as this value or a copy lives, and the system
/// lets go of it however the program ends.
#[derive(Clone, Debug)]
pub struct RunFolder {
    root: PathBuf,
    /// The claim, held to keep its lock.
    _claim: Arc<File>,
}

impl PartialEq for RunFolder {
    fn eq(&self, other: &Self) -> bool {
        self.root == other.root
    }
}

impl RunFolder {
    /// Finds or makes the folder of a run and claims it.
    ///
    /// Without a `requested` path it is `out/<default_stem>`, or the next free `out/<default_stem>-2`, `-3`, …;
    /// `force` then changes nothing.
    /// A requested folder is made, or taken when it exists and is empty.
    /// One that holds something is refused, unless `force` is given and an earlier run of ours wrote it:
    /// then what that run wrote is removed, by name, and everything else in it stays.
    /// A folder nothing shows to be ours is refused even with `force`.
    ///
    /// Two runs started at once never get the same folder, and a failure leaves nothing new behind.
    pub fn create(
        requested: Option<&Path>,
        default_stem: &str,
        force: bool,
    ) -> Result<Self, RecordError> {
        match requested {
            Some(path) => Self::requested(path, force),
            None => Self::numbered(Path::new(DEFAULT_BASE), default_stem),
        }
    }

    /// Takes up the folder of an earlier run, to go on in it.
    ///
    /// # Errors
    /// When it is none, or when a run is writing into it.
    pub fn reopen(path: &Path) -> Result<Self, RecordError> {
        let no_run = |what: &str| {
            RecordError::arguments(
                what,
                path,
                "Give the folder that `tsubu run` named; of several seeds, that of one: DIR/seed-1.",
            )
        };
        if !path.is_dir() {
            return Err(no_run("there is no such folder"));
        }
        match lock(path)? {
            Some(claim) => Ok(Self::with(path.into(), claim)),
            None => Err(no_run("no run of tsubu wrote this folder")),
        }
    }

    fn with(root: PathBuf, claim: File) -> Self {
        Self {
            root,
            _claim: Arc::new(claim),
        }
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The path of a file or folder in it.
    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.root.join(name)
    }

    /// Makes a folder inside this one; it may be there already.
    ///
    /// # Errors
    /// When the machine refuses.
    pub fn make(&self, name: &str) -> Result<PathBuf, RecordError> {
        let path = self.path(name);
        match std::fs::create_dir_all(&path) {
            Ok(()) => Ok(path),
            Err(cause) => Err(RecordError::machine(
                "the folder could not be made",
                &path,
                cause,
            )),
        }
    }

    /// Makes and claims the folder `seed-<seed>` inside this one; of an earlier run of ours only what it did not write
    /// is still there.
    ///
    /// # Errors
    /// When something else is there already, or the machine refuses.
    pub fn of_seed(&self, seed: u64) -> Result<Self, RecordError> {
        Self::requested(&self.path(format!("{SEED}{seed}")), true)
    }

    /// The names of the folders of seeds in it.
    pub fn seeds(&self) -> Result<Vec<String>, RecordError> {
        let found = entries(&self.root)
            .map_err(|e| RecordError::machine("the folder could not be read", &self.root, e))?;
        let mut seeds: Vec<String> = found
            .iter()
            .filter(|name| is_seed(&self.root, name))
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        seeds.sort();
        Ok(seeds)
    }

    fn numbered(base: &Path, stem: &str) -> Result<Self, RecordError> {
        if !is_plain_name(stem) {
            return Err(RecordError::arguments(
                format!("'{stem}' cannot be the name of a folder"),
                base,
                "Rename the scene file, or choose a folder with --out.",
            ));
        }
        let made_base = match fs::create_dir(base) {
            Ok(()) => true,
            Err(e) if e.kind() == ErrorKind::AlreadyExists && base.is_dir() => false,
            Err(e) => return Err(not_made(base, e)),
        };
        let folder = Self::first_free(base, stem);
        if folder.is_err() && made_base {
            // Only an empty folder goes, so a run that put its own there meanwhile loses nothing.
            fs::remove_dir(base).ok();
        }
        folder
    }

    fn first_free(base: &Path, stem: &str) -> Result<Self, RecordError> {
        let mut root = base.join(stem);
        let mut number = 1u64;
        loop {
            match fs::create_dir(&root) {
                Ok(()) => return Self::claim_new(root),
                Err(e) if e.kind() == ErrorKind::AlreadyExists => {
                    number += 1;
                    root = base.join(format!("{stem}-{number}"));
                }
                Err(e) => return Err(not_made(&root, e)),
            }
        }
    }

    fn requested(path: &Path, force: bool) -> Result<Self, RecordError> {
        match fs::create_dir(path) {
            Ok(()) => return Self::claim_new(path.into()),
            Err(e) if e.kind() == ErrorKind::AlreadyExists && path.is_dir() => {}
            Err(e) => return Err(not_made(path, e)),
        }
        let found = entries(path)
            .map_err(|e| RecordError::machine("the folder could not be read", path, e))?;
        let proven = found.iter().any(|name| PROOF.iter().any(|p| name == p));
        if !found.is_empty() && !proven {
            return Err(RecordError::arguments(
                "the folder holds files and nothing in it shows that a run of tsubu wrote it, so even --force leaves it alone",
                path,
                "Choose an empty or a new folder with --out.",
            ));
        }
        if !found.is_empty() && !force {
            return Err(taken(path));
        }
        // A run that is still writing here keeps its folder, whatever was asked for.
        let held = lock(path)?;
        remove_ours(path, &found)?;
        let claim = held.map_or_else(|| claim(path), Ok)?;
        Ok(Self::with(path.into(), claim))
    }

    fn claim_new(root: PathBuf) -> Result<Self, RecordError> {
        match claim(&root) {
            Ok(claim) => Ok(Self::with(root, claim)),
            Err(error) => {
                fs::remove_dir(&root).ok();
                Err(error)
            }
        }
    }
}

/// Makes the claim file, which also shows at the start, not at the first frame, that the folder can be written to.
fn claim(root: &Path) -> Result<File, RecordError> {
    let path = root.join(CLAIM);
    let mut file = match OpenOptions::new().write(true).create_new(true).open(&path) {
        Ok(file) => file,
        Err(e) if e.kind() == ErrorKind::AlreadyExists => return Err(taken(root)),
        Err(e) => {
            return Err(RecordError::machine(
                "the folder could not be written to",
                root,
                e,
            ));
        }
    };
    file.write_all(CLAIM_TEXT).map_err(|e| {
        fs::remove_file(&path).ok();
        RecordError::machine("the folder could not be written to", root, e)
    })?;
    locked(file, root)
}

/// The claim of an earlier run, locked; `None` if there is none.
fn lock(root: &Path) -> Result<Option<File>, RecordError> {
    let path = root.join(CLAIM);
    match OpenOptions::new().read(true).write(true).open(&path) {
        Ok(file) => locked(file, root).map(Some),
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(None),
        Err(e) => Err(RecordError::machine(
            "the folder could not be written to",
            root,
            e,
        )),
    }
}

fn locked(file: File, root: &Path) -> Result<File, RecordError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(RecordError::arguments(
            "another run is writing into this folder",
            root,
            "Wait for its end or stop it, or choose another folder with --out.",
        )),
        // Some network disks know no locks; the claim alone must do there.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// Removes what a run wrote; the proofs go last, so a removal that fails half way can be tried again.
fn remove_ours(root: &Path, found: &[std::ffi::OsString]) -> Result<(), RecordError> {
    let is_proof = |name: &OsStr| PROOF.iter().any(|p| name == *p);
    // The claim stays: it is locked, and the new run goes on with it.
    let ours = || {
        found
            .iter()
            .filter(|name| *name != CLAIM && is_ours(root, name))
    };
    let in_order = ours()
        .filter(|name| !is_proof(name))
        .chain(ours().filter(|name| is_proof(name)));
    for name in in_order {
        let path = root.join(name);
        if is_seed(root, name) {
            remove_seed(&path)?;
            continue;
        }
        remove(&path)
            .map_err(|e| RecordError::machine("the earlier run could not be removed", &path, e))?;
    }
    Ok(())
}

/// Removes what the run of a seed wrote, and its folder if nothing else is in it; else it stays ours.
fn remove_seed(path: &Path) -> Result<(), RecordError> {
    let found =
        entries(path).map_err(|e| RecordError::machine("the folder could not be read", path, e))?;
    let held = lock(path)?;
    remove_ours(path, &found)?;
    let only_the_claim = entries(path).is_ok_and(|left| left.iter().all(|name| name == CLAIM));
    if only_the_claim {
        fs::remove_dir_all(path)
            .map_err(|e| RecordError::machine("the earlier run could not be removed", path, e))?;
    }
    drop(held);
    Ok(())
}

/// Whether this is the folder of a seed, written by a run of ours.
fn is_seed(root: &Path, name: &OsStr) -> bool {
    let seed = name.to_str().and_then(|name| name.strip_prefix(SEED));
    seed.is_some_and(|seed| seed.parse::<u64>().is_ok()) && root.join(name).join(CLAIM).is_file()
}

fn remove(path: &Path) -> io::Result<()> {
    // Of a link, the link itself is looked at and removed, never what it leads to.
    if fs::symlink_metadata(path)?.is_dir() {
        fs::remove_dir_all(path)
    } else {
        fs::remove_file(path)
    }
}

fn is_ours(root: &Path, name: &OsStr) -> bool {
    let text = name.to_string_lossy();
    OURS.iter().any(|ours| name == *ours)
        || text.starts_with("animation.")
        || (text.starts_with('.') && text.ends_with(PART_SUFFIX))
        || is_seed(root, name)
}

fn entries(path: &Path) -> io::Result<Vec<std::ffi::OsString>> {
    fs::read_dir(path)?
        .map(|entry| entry.map(|e| e.file_name()))
        .collect()
}

fn is_plain_name(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    matches!((parts.next(), parts.next()), (Some(Component::Normal(part)), None) if part == name)
}

fn taken(path: &Path) -> RecordError {
    RecordError::arguments(
        "the folder already holds a run",
        path,
        "Add --force to replace that run, choose another folder with --out, or leave out --out for a fresh one.",
    )
}

fn not_made(path: &Path, cause: io::Error) -> RecordError {
    let wrong = |what: &str, remedy: &str| RecordError::arguments(what, path, remedy);
    match cause.kind() {
        ErrorKind::AlreadyExists => wrong(
            "it exists and is not a folder",
            "Move that file away, or choose another folder with --out.",
        ),
        ErrorKind::NotADirectory => wrong(
            "a part of this path is a file, not a folder",
            "Choose another folder with --out.",
        ),
        ErrorKind::NotFound => wrong(
            "the folder it should stand in does not exist",
            "Make that folder first, or correct the path given with --out.",
        ),
        _ => RecordError::machine("the folder could not be made", path, cause),
    }
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
