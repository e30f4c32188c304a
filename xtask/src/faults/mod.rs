//! `cargo xtask faults`: what can go wrong is made to go wrong, and must end as it is documented.
//!
//! Runs are killed at random moments and resumed to the same bits; disks fill up, folders vanish, checkpoints are cut and
//! flipped, memory is short; every reader of files gets mutated input by the thousand. The quick set is for every change,
//! `--full` has the numbers that are claimed. All of it is drawn from one seed, so a failure can be had again.

mod files;
mod fuzz;
mod kills;
mod memory;
mod program;
mod readers;
mod scenes;
mod soak;

pub use fuzz::child;

use program::Program;
use std::path::Path;
use std::time::Instant;

/// What was tried, line by line.
pub struct Table {
    tried: usize,
    failed: usize,
    start: Instant,
}

impl Table {
    fn new() -> Self {
        Self {
            tried: 0,
            failed: 0,
            start: Instant::now(),
        }
    }

    /// One fault and how it ended.
    pub fn row(&mut self, name: &str, outcome: Result<String, String>) {
        self.tried += 1;
        self.failed += usize::from(outcome.is_err());
        match outcome {
            Ok(how) => println!("yes {name}: {how}"),
            Err(why) => println!("NO  {name}: {why}"),
        }
    }
}

/// The parts, in the order in which they run.
const PARTS: [&str; 5] = ["kills", "files", "memory", "readers", "soak"];

/// Runs the named parts, or all (the soak only with `--full`); true if every fault ended as it should.
pub fn run(root: &Path, parts: &[String], full: bool, seed: u64) -> Result<bool, String> {
    if let Some(unknown) = parts.iter().find(|name| !PARTS.contains(&name.as_str())) {
        return Err(format!(
            "there is no part `{unknown}`; the parts are {}",
            PARTS.join(", ")
        ));
    }
    let wanted = |name: &str| parts.iter().any(|p| p == name) || parts.is_empty();
    let program = Program::build(root)?;
    let mut table = Table::new();
    println!("faults, seed {seed}{}", if full { ", full" } else { "" });
    if wanted("kills") {
        kills::run(&program, &mut table, full, seed)?;
    }
    if wanted("files") {
        files::run(&program, &mut table)?;
    }
    if wanted("memory") {
        memory::run(&program, &mut table)?;
    }
    if wanted("readers") {
        fuzz::run(&program, &mut table, full, seed)?;
    }
    if full && wanted("soak") {
        soak::run(&program, &mut table)?;
    }
    println!(
        "faults: {} tried, {} ended otherwise than documented, {:.0} s",
        table.tried,
        table.failed,
        table.start.elapsed().as_secs_f64()
    );
    Ok(table.failed == 0)
}
