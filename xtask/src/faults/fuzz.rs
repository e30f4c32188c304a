//! Every reader of files gets mutated input: no panic, no hang, no more memory than a gigabyte.
//!
//! An input is a function of reader, seed and number, so that a failure is had again by its number. Each reader runs in a
//! process of its own under a limit of memory, and says how far it is; one that falls silent hangs.

use super::Table;
use super::program::Program;
use super::readers::{READERS, Reader};
use std::io::{BufRead, BufReader};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};
use tsubu_model::uniform;

/// One input may take so long.
const LONGEST: Duration = Duration::from_secs(10);
/// Inputs between two signs of life.
const SIGN: u64 = 16;
/// Address space of a reader in KiB: a gigabyte for it and some for the program.
const SPACE: u64 = 1_400_000;
/// Longest input in bytes.
const MOST: usize = 200_000;

/// Runs every reader; a row each.
pub fn run(program: &Program, table: &mut Table, full: bool, seed: u64) -> Result<(), String> {
    for reader in READERS {
        let count = if full { reader.full } else { reader.quick };
        let name = format!("{count} inputs to the reader of {}", reader.name);
        table.row(&name, tried(program, reader, count, seed));
    }
    Ok(())
}

/// Starts the process of a reader and waits for its end or its silence.
fn tried(program: &Program, reader: &Reader, count: u64, seed: u64) -> Result<String, String> {
    let here = std::env::current_exe().map_err(|e| e.to_string())?;
    let numbers = [0, count, seed].map(|n| n.to_string());
    let mut child = Command::new("sh")
        .args(["-c", &format!("ulimit -v {SPACE}; exec \"$@\""), "sh"])
        .arg(here)
        .args(["fuzzed-reader", reader.name])
        .args(&numbers)
        .current_dir(&program.root)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| e.to_string())?;
    let (say, hear) = channel();
    let out = child.stdout.take().ok_or("no pipe")?;
    std::thread::spawn(move || {
        for line in BufReader::new(out).lines().map_while(Result::ok) {
            if say.send(line).is_err() {
                break;
            }
        }
    });
    let mut last = "its first inputs".to_owned();
    let again = |last: &str| {
        format!(
            "after {last}; to have it again: cargo xtask fuzzed-reader \"{}\" FROM {SIGN} {seed}",
            reader.name
        )
    };
    loop {
        match hear.recv_timeout(LONGEST * SIGN as u32) {
            Ok(line) if line.starts_with("found:") => {
                child.kill().ok();
                child.wait().ok();
                return Err(line);
            }
            Ok(line) => last = line,
            Err(RecvTimeoutError::Timeout) => {
                child.kill().ok();
                child.wait().ok();
                return Err(format!("it hangs {}", again(&last)));
            }
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    let status = child.wait().map_err(|e| e.to_string())?;
    if !status.success() {
        return Err(format!("it ended with {status} {}", again(&last)));
    }
    Ok(last)
}

/// `cargo xtask fuzzed-reader NAME FROM COUNT SEED`: what a process of [`tried`] does.
pub fn child(root: &Path, name: &str, [from, count, seed]: [u64; 3]) -> Result<bool, String> {
    let reader = READERS.iter().find(|reader| reader.name == name);
    let reader = reader.ok_or_else(|| format!("there is no reader `{name}`"))?;
    let corpus = (reader.corpus)(root)?;
    let (mut taken, mut slowest) = (0, Duration::ZERO);
    std::panic::set_hook(Box::new(|_| {}));
    for number in from..from + count {
        if number % SIGN == 0 {
            println!("input {number}");
        }
        let input = mutated(&corpus, reader.tokens, seed, number);
        let start = Instant::now();
        let read = catch_unwind(AssertUnwindSafe(|| (reader.read)(&input)));
        slowest = slowest.max(start.elapsed());
        let trouble = match read {
            Ok(accepted) => {
                taken += u64::from(accepted);
                (start.elapsed() > LONGEST).then_some("takes too long")
            }
            Err(_) => Some("makes it panic"),
        };
        if let Some(what) = trouble {
            let path = root.join(format!("target/faults/{name}-{seed}-{number}"));
            std::fs::write(&path, &input).ok();
            println!("found: input {number} {what}; it is in {}", path.display());
            return Ok(false);
        }
    }
    println!(
        "no panic, the slowest {:.0} ms, {taken} of them taken, {} MB of memory at most",
        1e3 * slowest.as_secs_f64(),
        most_memory()
    );
    Ok(true)
}

/// The most memory that this process has held, in MB; 0 where the system does not say.
fn most_memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kib = line.and_then(|l| l.trim().trim_end_matches(" kB").parse::<u64>().ok());
    kib.unwrap_or(0) / 1024
}

/// A whole number below `most`.
fn below(seed: u64, number: u64, event: &mut u64, most: usize) -> usize {
    *event += 1;
    (uniform(seed, number, *event) * most as f64) as usize
}

/// One of the corpus with one to eight changes: bits flipped, bytes set, pieces cut out, doubled, put in from another one
/// or from the tokens, the end cut off.
fn mutated(corpus: &[Vec<u8>], tokens: &[&str], seed: u64, number: u64) -> Vec<u8> {
    let mut event = 0;
    let mut draw = |most: usize| below(seed, number, &mut event, most);
    let mut bytes = corpus[draw(corpus.len())].clone();
    let most = 1 + draw(8);
    for _ in 0..1 + draw(most) {
        let at = draw(bytes.len() + 1);
        let piece = at..(at + draw(64)).min(bytes.len());
        match draw(8) {
            0 if at < bytes.len() => bytes[at] ^= 1 << draw(8),
            1 if at < bytes.len() => {
                bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b'-', b'9', b'('][draw(8)]
            }
            2 => drop(bytes.drain(piece)),
            3 => {
                let twice = bytes[piece].to_vec();
                bytes.splice(at..at, twice.repeat(1 + draw(3)));
            }
            4 => {
                let other = &corpus[draw(corpus.len())];
                let from = draw(other.len() + 1);
                bytes.truncate(at);
                bytes.extend(&other[from..]);
            }
            5 => bytes.truncate(at),
            _ => {
                let token = tokens[draw(tokens.len())];
                bytes.splice(piece, token.bytes());
            }
        }
    }
    bytes.truncate(MOST);
    bytes
}
