//! Checkpoints: the whole state of a run in one file, written whole and read with mistrust.
//!
//! A file is a first line that says what it is, words of 64 bits (the lowest byte first), and a checksum over all
//! before it. The words are the version of this layout, the version of the program, the scene, the files that the scene
//! names with the checksums of their content, and the state. A run keeps its last two in `checkpoint/`.

use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use blake3::{Hash, Hasher};
use tsubu_model::{Damaged, Words};

use crate::whole::{PART_SUFFIX, write_whole_by};
use crate::{RecordError, RunFolder};

/// The first line of every checkpoint, of this layout or another; sixteen bytes.
const FIRST_LINE: &[u8; 16] = b"tsubu checkpoint";
/// The layout that this program writes. It reads no other yet.
const LAYOUT: u64 = 1;
/// Bytes of the checksum.
const CHECKSUM: u64 = 32;
/// Longer files are no checkpoints: that of 2e8 grains has half of it.
const LONGEST: u64 = 1 << 36;
/// Words written or read at a time.
const AT_ONCE: usize = 1024;
/// How many a run keeps.
const KEPT: usize = 2;

/// The folder of the checkpoints in that of the run.
const FOLDER: &str = "checkpoint";
const BEFORE: &str = "step_";
const ENDING: &str = ".tsubu";

/// The state of a run, and of what.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// Version of the program that wrote it.
    pub program: String,
    /// The scene, resolved.
    pub scene: String,
    /// The files that the scene names, and the checksum of each.
    pub files: Vec<(String, String)>,
    /// Everything else.
    pub state: Words,
}

/// The checkpoints of one run.
#[derive(Clone, Debug)]
pub struct Checkpoints {
    folder: PathBuf,
}

/// The newest checkpoint that is whole.
#[derive(Debug)]
pub struct Newest {
    /// The checkpoint.
    pub checkpoint: Checkpoint,
    /// Its file.
    pub path: PathBuf,
    /// What is wrong with newer ones, in words; they are set aside.
    pub damaged: Vec<String>,
}

/// Why a file is not taken.
enum Refusal {
    Machine(io::Error),
    /// Cut, changed, or no checkpoint.
    Damaged(String),
    /// Whole, but of another layout.
    Foreign(String),
}

impl Checkpoints {
    /// Makes their folder in that of a run.
    pub fn of(run: &RunFolder) -> Result<Self, RecordError> {
        let all = Self {
            folder: run.make(FOLDER)?,
        };
        // What a kill left half written.
        for entry in fs::read_dir(&all.folder).into_iter().flatten().flatten() {
            let name = entry.file_name();
            if name
                .to_str()
                .is_some_and(|name| name.ends_with(PART_SUFFIX))
            {
                remove(&entry.path())?;
            }
        }
        Ok(all)
    }

    /// A path in their folder, for what else has to last as long as they do.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Writes the checkpoint of a step; then all but the last two go.
    ///
    /// A kill, or a disk that fills up, leaves the former ones as they were.
    pub fn write(&self, step: u64, checkpoint: &Checkpoint) -> Result<PathBuf, RecordError> {
        let path = self.folder.join(format!("{BEFORE}{step:015}{ENDING}"));
        self.write_as(&path, checkpoint)?;
        let mut all = self.all()?;
        all.truncate(all.len().saturating_sub(KEPT));
        for old in all {
            remove(&old)?;
        }
        Ok(path)
    }

    /// Writes one for study, which is no place to go on from.
    pub fn write_for_study(
        &self,
        name: &str,
        checkpoint: &Checkpoint,
    ) -> Result<PathBuf, RecordError> {
        let path = self.folder.join(format!("{name}{ENDING}"));
        self.write_as(&path, checkpoint)?;
        Ok(path)
    }

    fn write_as(&self, path: &Path, checkpoint: &Checkpoint) -> Result<(), RecordError> {
        write_whole_by(path, |file| write(file, checkpoint))?;
        // The name is in the folder, which has a place on the disk of its own.
        sync_folder(&self.folder)
            .map_err(|e| RecordError::machine("it could not be forced to the disk", path, e))
    }

    /// The newest that is whole. Newer ones that are damaged get another name, so that they push none out.
    pub fn newest(&self) -> Result<Newest, RecordError> {
        let mut damaged = Vec::new();
        for path in self.all()?.into_iter().rev() {
            match read(&path) {
                Ok(checkpoint) => {
                    return Ok(Newest {
                        checkpoint,
                        path,
                        damaged,
                    });
                }
                Err(Refusal::Machine(cause)) => {
                    return Err(RecordError::machine("it could not be read", &path, cause));
                }
                Err(Refusal::Foreign(what)) => {
                    return Err(RecordError::arguments(
                        what,
                        &path,
                        "Go on with the version of tsubu that wrote it, or run the scene again: scene.resolved.ron is it.",
                    ));
                }
                Err(Refusal::Damaged(what)) => {
                    fs::rename(&path, path.with_extension("damaged")).map_err(|e| {
                        RecordError::machine("it is damaged and could not be set aside", &path, e)
                    })?;
                    damaged.push(format!("{}: {what}", path.display()));
                }
            }
        }
        let again = "Run the scene again: scene.resolved.ron in the folder of the run is it.";
        Err(match damaged.first() {
            None => RecordError::arguments("there is no checkpoint", &self.folder, again),
            Some(first) => {
                let what = format!("no checkpoint is whole ({first})");
                RecordError::damaged(what, &self.folder, again)
            }
        })
    }

    /// All of them, oldest first.
    fn all(&self) -> Result<Vec<PathBuf>, RecordError> {
        let cannot =
            |e| RecordError::machine("the folder could not be read", &self.folder.clone(), e);
        let is_one = |name: &str| {
            let step = name
                .strip_prefix(BEFORE)
                .and_then(|rest| rest.strip_suffix(ENDING));
            step.is_some_and(|step| step.len() == 15 && step.bytes().all(|b| b.is_ascii_digit()))
        };
        let mut found = Vec::new();
        for entry in fs::read_dir(&self.folder).map_err(cannot)? {
            let entry = entry.map_err(cannot)?;
            if entry.file_name().to_str().is_some_and(is_one) {
                found.push(entry.path());
            }
        }
        found.sort();
        Ok(found)
    }
}

/// The checksum of a file's content.
pub fn checksum(path: &Path) -> Result<String, RecordError> {
    let mut hasher = Hasher::new();
    File::open(path)
        .and_then(|mut file| io::copy(&mut file, &mut hasher))
        .map_err(|e| RecordError::machine("it could not be read", path, e))?;
    Ok(hasher.finalize().to_hex().to_string())
}

fn remove(path: &Path) -> Result<(), RecordError> {
    fs::remove_file(path)
        .map_err(|e| RecordError::machine("the old checkpoint could not be removed", path, e))
}

#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}

/// Passes on what it is given, and sums it up.
struct Summed<W> {
    to: W,
    hasher: Hasher,
}

impl<W: Write> Summed<W> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hasher.update(bytes);
        self.to.write_all(bytes)
    }
}

fn write(file: &mut File, checkpoint: &Checkpoint) -> io::Result<()> {
    let mut head = Words::new();
    head.put_whole(LAYOUT);
    head.put_text(&checkpoint.program);
    head.put_text(&checkpoint.scene);
    head.put_whole(checkpoint.files.len() as u64);
    for (name, sum) in &checkpoint.files {
        head.put_text(name);
        head.put_text(sum);
    }
    let mut out = Summed {
        to: BufWriter::new(file),
        hasher: Hasher::new(),
    };
    out.put(FIRST_LINE)?;
    for words in [head.all(), checkpoint.state.all()] {
        for some in words.chunks(AT_ONCE) {
            let bytes: Vec<u8> = some.iter().flat_map(|word| word.to_le_bytes()).collect();
            out.put(&bytes)?;
        }
    }
    let sum = out.hasher.finalize();
    out.to.write_all(sum.as_bytes())?;
    out.to.flush()
}

impl Checkpoint {
    /// Reads what a file of these bytes would say; `Err` says why it is none.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        read_from(bytes, bytes.len() as u64).map_err(|refusal| match refusal {
            Refusal::Machine(cause) => cause.to_string(),
            Refusal::Damaged(what) | Refusal::Foreign(what) => what,
        })
    }
}

fn read(path: &Path) -> Result<Checkpoint, Refusal> {
    let file = File::open(path).map_err(Refusal::Machine)?;
    let length = file.metadata().map_err(Refusal::Machine)?.len();
    read_from(BufReader::new(file), length)
}

fn read_from(mut file: impl Read, length: u64) -> Result<Checkpoint, Refusal> {
    let first = FIRST_LINE.len() as u64;
    if length < first + 8 + CHECKSUM {
        return Err(Refusal::Damaged(format!(
            "it is cut short: {length} bytes are left"
        )));
    }
    if length > LONGEST {
        return Err(Refusal::Damaged(format!(
            "it is {length} bytes long, more than any checkpoint is"
        )));
    }
    let mut line = [0; FIRST_LINE.len()];
    let mut take = |bytes: &mut [u8]| file.read_exact(bytes).map_err(Refusal::Machine);
    take(&mut line)?;
    if line != *FIRST_LINE {
        return Err(Refusal::Damaged(
            "it does not begin as a checkpoint does".into(),
        ));
    }
    let mut hasher = Hasher::new();
    hasher.update(&line);
    let mut words = Vec::with_capacity(((length - first - CHECKSUM) / 8) as usize);
    let mut left = (length - first - CHECKSUM) as usize;
    let mut bytes = [0; 8 * AT_ONCE];
    while left > 0 {
        let some = &mut bytes[..left.min(8 * AT_ONCE)];
        take(some)?;
        hasher.update(some);
        let eights = some.chunks_exact(8).map(|eight| {
            let mut word = [0; 8];
            word.copy_from_slice(eight);
            u64::from_le_bytes(word)
        });
        words.extend(eights);
        left -= some.len();
    }
    let mut sum = [0; CHECKSUM as usize];
    take(&mut sum)?;
    let whole = (length - first - CHECKSUM).is_multiple_of(8);
    if !whole || hasher.finalize() != Hash::from_bytes(sum) {
        return Err(Refusal::Damaged(
            "its checksum does not fit: it was cut or changed".into(),
        ));
    }
    content(Words::of(words))
}

/// What the words of a whole file say.
fn content(mut words: Words) -> Result<Checkpoint, Refusal> {
    let bad = |why: Damaged| Refusal::Damaged(why.0);
    let layout = words.take_whole().map_err(bad)?;
    let program = words.take_text().map_err(bad)?;
    if layout != LAYOUT {
        return Err(Refusal::Foreign(format!(
            "it has layout {layout}, written by tsubu {program}; this program reads layout {LAYOUT}"
        )));
    }
    let scene = words.take_text().map_err(bad)?;
    let mut files = Vec::new();
    for _ in 0..words.take_count(2).map_err(bad)? {
        let name = words.take_text().map_err(bad)?;
        files.push((name, words.take_text().map_err(bad)?));
    }
    Ok(Checkpoint {
        program,
        scene,
        files,
        state: words.rest(),
    })
}

#[cfg(test)]
#[path = "checkpoint_tests.rs"]
mod tests;
