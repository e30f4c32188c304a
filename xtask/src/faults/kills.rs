//! Runs killed at random moments, resumed, killed again, and held against a run that was left alone.

use super::Table;
use super::program::{Program, checkpoints, differ, left, outputs_are_whole};
use super::scenes::{LARGE, SHORT, Short};
use std::time::{Duration, Instant};
use tsubu_model::uniform;

/// Kills of each scene in the quick set, and of each small one in the full set: 200 in all there.
const KILLS: (u64, u64) = (3, 45);
/// Kills of the large scene in the full set.
const KILLS_OF_LARGE: u64 = 20;

/// Kills and resumes every scene; a row each.
pub fn run(program: &Program, table: &mut Table, full: bool, seed: u64) -> Result<(), String> {
    let count = if full { KILLS.1 } else { KILLS.0 };
    for scene in &SHORT {
        let tried = killed(program, scene, count, seed);
        table.row(&format!("{} kills of {}", count, scene.name), tried);
    }
    if full {
        let tried = killed(program, &LARGE, KILLS_OF_LARGE, seed);
        table.row(&format!("{KILLS_OF_LARGE} kills of {}", LARGE.name), tried);
    }
    Ok(())
}

/// Runs a scene whole, then kills it so many times, each time resuming from what is left.
fn killed(program: &Program, scene: &Short, kills: u64, seed: u64) -> Result<String, String> {
    let whole = program.fresh(&format!("{}-whole", scene.name))?;
    std::fs::remove_dir(&whole).map_err(|e| e.to_string())?;
    let line = scene.run(&program.root, &whole.display().to_string());
    let arguments: Vec<&str> = line.iter().map(String::as_str).collect();
    // The first may have to make the grids of distances; the second is timed.
    let mut took = Duration::ZERO;
    for _ in 0..2 {
        std::fs::remove_dir_all(&whole).ok();
        let start = Instant::now();
        program
            .run(&[&arguments[..], &["--threads", "1"]].concat())?
            .is(0, &[])?;
        took = start.elapsed();
    }
    let expected = left(&whole)?;
    let draw = |kill: u64, event: u64| uniform(seed, kill, event);
    let (mut resumes, mut before_first) = (0, 0);
    for kill in 0..kills {
        let run = program.fresh(&format!("{}-killed", scene.name))?;
        std::fs::remove_dir(&run).map_err(|e| e.to_string())?;
        let folder = run.display().to_string();
        // Checkpoints now at every glance, now some fifty times a run, now only at the start.
        let every = ["0", "0.0005", "1"][(3.0 * draw(kill, 0)) as usize];
        let threads = ["1", "2", "3"][(3.0 * draw(kill, 1)) as usize];
        let fresh = scene.run(&program.root, &folder);
        let mut moment = took.mul_f64(0.8 * draw(kill, 2));
        for part in 0.. {
            // Killed before the first checkpoint, there is nothing to go on from.
            let has_begun = !checkpoints(&run).is_empty();
            let line: Vec<&str> = if has_begun {
                resumes += 1;
                vec!["resume", &folder]
            } else {
                before_first += u64::from(part > 0);
                std::fs::remove_dir_all(&run).ok();
                fresh.iter().map(String::as_str).collect()
            };
            let options = ["--checkpoint-every", every, "--threads", threads];
            let mut running = program.start(&[&line[..], &options].concat())?;
            // Killed twice; the third part may come to its end.
            if part < 2 {
                // Most moments are counted from the first checkpoint, the others from the start of the process.
                let counted = draw(kill, 4 + part) < 0.8;
                while counted && checkpoints(&run).is_empty() && !running.is_over() {
                    std::thread::sleep(Duration::from_micros(500));
                }
                let since = Instant::now();
                while since.elapsed() < moment && !running.is_over() {
                    std::thread::sleep(Duration::from_micros(500));
                }
                running.kill();
                moment = took.mul_f64(0.4 * draw(kill, 3));
            }
            let outcome = running.end()?;
            if run.is_dir() {
                outputs_are_whole(&run).map_err(|why| format!("kill {kill}: {why}"))?;
            }
            if outcome.code.is_some() {
                outcome
                    .is(0, &[])
                    .map_err(|why| format!("kill {kill}: {why}"))?;
                break;
            }
        }
        if let Some(name) = differ(&expected, &left(&run)?) {
            return Err(format!(
                "kill {kill}: {name} differs from the run never stopped"
            ));
        }
    }
    Ok(format!(
        "{kills} of {kills} to the same bits, after {resumes} resumes and {before_first} new starts of a run of {:.1} s",
        took.as_secs_f64()
    ))
}
