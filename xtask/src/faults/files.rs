//! Faults of disks, folders and checkpoints: each ends with its exit code and its words, and nothing computed is lost.

use super::Table;
use super::program::{Outcome, Program, checkpoints, differ, left, outputs_are_whole};
use super::scenes::SHORT;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A fault, what it is called, and what is done.
type Fault = (&'static str, fn(&Program) -> Result<String, String>);

const FAULTS: [Fault; 6] = [
    ("a disk that is full", full_disk),
    ("a folder that may not be written to", read_only),
    ("a folder removed while running", removed),
    ("two runs on one folder", two_runs),
    (
        "a checkpoint cut or flipped at every kind of place",
        damaged,
    ),
    ("every checkpoint damaged", all_damaged),
];

/// All of them; a row each.
pub fn run(program: &Program, table: &mut Table) -> Result<(), String> {
    for (name, fault) in FAULTS {
        table.row(name, fault(program));
    }
    Ok(())
}

/// The line that runs the short heap into a folder of this name, which is not there yet.
fn heap(program: &Program, name: &str) -> Result<(PathBuf, Vec<String>), String> {
    let out = program.fresh(name)?;
    fs::remove_dir(&out).map_err(|e| e.to_string())?;
    let line = SHORT[0].run(&program.root, &out.display().to_string());
    Ok((out, line))
}

fn with<'a>(line: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    let own = line.iter().map(String::as_str);
    own.chain(more.iter().copied()).collect()
}

fn resumed(program: &Program, out: &Path) -> Result<Outcome, String> {
    program.run(&["resume", &out.display().to_string()])
}

/// No file may grow beyond a size, which is the first to be too long: a checkpoint, a frame, the film. With room again
/// the run goes on to the bits of one that had it throughout.
fn full_disk(program: &Program) -> Result<String, String> {
    let (whole, line) = heap(program, "heap-whole")?;
    program.run(&with(&line, &[]))?.is(0, &[])?;
    let expected = left(&whole)?;
    let mut resumes = 0;
    for blocks in ["2", "40", "400", "800", "1600"] {
        let (out, line) = heap(program, "heap-full")?;
        let options = with(&line, &["--checkpoint-every", "0.001"]);
        let outcome = program
            .start_limited(&format!("-f {blocks}"), &options)?
            .end()?;
        if outcome.code != Some(0) {
            outcome
                .is(4, &["help:"])
                .or_else(|_| outcome.is(4, &["(os error"]))?;
        }
        outputs_are_whole(&out)?;
        if !checkpoints(&out).is_empty() {
            resumes += 1;
            resumed(program, &out)?.is(0, &[])?;
            if let Some(name) = differ(&expected, &left(&out)?) {
                return Err(format!("after {blocks} blocks and a resume {name} differs"));
            }
        }
    }
    if resumes == 0 {
        return Err("no run got as far as its first checkpoint".into());
    }
    Ok(format!(
        "exit code 4, and {resumes} resumed to the same bits"
    ))
}

/// A place where even the superuser makes no folder, and one whose permissions forbid it to others.
fn read_only(program: &Program) -> Result<String, String> {
    let (out, line) = heap(program, "read-only")?;
    let mut said = Vec::new();
    if Path::new("/sys/kernel").is_dir() {
        let mut line = line.clone();
        line[3] = "/sys/kernel/tsubu".into();
        said.push(
            program
                .run(&with(&line, &[]))?
                .is(4, &["/sys/kernel/tsubu"])?,
        );
    }
    program
        .run(&with(&line, &["--until", "1 ms"]))?
        .is(0, &[])?;
    let mode = |writable: bool| -> Result<(), String> {
        let mut permissions = fs::metadata(&out).map_err(|e| e.to_string())?.permissions();
        permissions.set_readonly(!writable);
        fs::set_permissions(&out, permissions).map_err(|e| e.to_string())
    };
    mode(false)?;
    // The superuser may write all the same.
    let is_super = fs::write(out.join("probe"), "x").is_ok();
    let outcome = resumed(program, &out);
    fs::remove_file(out.join("probe")).ok();
    // The permission to list and to remove is wanted again.
    mode(true).or_else(|_| fs::remove_dir_all(&out).map_err(|e| e.to_string()))?;
    if !is_super {
        said.push(outcome?.is(4, &["ermission"])?);
    }
    Ok(said.join(", "))
}

fn removed(program: &Program) -> Result<String, String> {
    let (out, line) = heap(program, "removed")?;
    let mut running = program.start(&with(&line, &["--until", "60 s"]))?;
    while checkpoints(&out).is_empty() && !running.is_over() {
        std::thread::sleep(Duration::from_millis(2));
    }
    // A frame may be written between the removal of a file and that of its folder.
    while fs::remove_dir_all(&out).is_err() && out.exists() {}
    running.end()?.is(4, &["removed or moved the folder"])
}

fn two_runs(program: &Program) -> Result<String, String> {
    let (out, line) = heap(program, "two-runs")?;
    let mut running = program.start(&with(&line, &["--until", "60 s"]))?;
    while checkpoints(&out).is_empty() && !running.is_over() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let words = ["another run is writing into this folder"];
    let forced = program.run(&with(&line, &["--force"]));
    let resume = resumed(program, &out);
    running.kill();
    running.end()?;
    forced?.is(2, &words)?;
    resume?.is(2, &words)?;
    // The lock went with the process that held it.
    program
        .run(&["resume", &out.display().to_string(), "--until", "1 ms"])?
        .is(0, &[])
}

/// The newest checkpoint is damaged: that is said, the one before is taken, and the end is the same.
fn damaged(program: &Program) -> Result<String, String> {
    let (out, line) = heap(program, "damaged")?;
    // The film, which takes the longest, is drawn from the frames.
    let options = ["--set", "output.animation=false"];
    program.run(&with(&line, &options))?.is(0, &[])?;
    let expected = left(&out)?;
    let newest = checkpoints(&out).pop().ok_or("no checkpoint")?;
    let whole = fs::read(&newest).map_err(|e| e.to_string())?;
    let end = whole.len();
    // First line, layout, lengths and texts of the head, scene, state, its end, checksum.
    let places = [
        0,
        15,
        16,
        24,
        32,
        64,
        700,
        end / 4,
        end / 2,
        end - 40,
        end - 33,
        end - 1,
    ];
    let mut damages: Vec<Vec<u8>> = Vec::new();
    for at in places {
        let mut flipped = whole.clone();
        flipped[at] ^= 0x10;
        damages.extend([flipped, whole[..at].to_vec()]);
    }
    let count = damages.len();
    for bytes in damages {
        fs::write(&newest, bytes).map_err(|e| e.to_string())?;
        resumed(program, &out)?.is(0, &["warning:", "the one before is taken"])?;
        if let Some(name) = differ(&expected, &left(&out)?) {
            return Err(format!("{name} differs"));
        }
        if fs::read(&newest).ok().as_ref().map(Vec::len) != Some(end) {
            return Err("the resumed run wrote another last checkpoint".into());
        }
    }
    Ok(format!(
        "{count} damages, each set aside, each to the same bits"
    ))
}

fn all_damaged(program: &Program) -> Result<String, String> {
    let (out, line) = heap(program, "all-damaged")?;
    program
        .run(&with(&line, &["--until", "1 ms"]))?
        .is(0, &[])?;
    for path in checkpoints(&out) {
        let bytes = fs::read(&path).map_err(|e| e.to_string())?;
        fs::write(&path, &bytes[..bytes.len() - 8]).map_err(|e| e.to_string())?;
    }
    resumed(program, &out)?.is(4, &["no checkpoint is whole", "scene.resolved.ron"])
}
