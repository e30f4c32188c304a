//! Long runs: the screw feeder and the bed go on for hours, and count, energy books and memory stay where they were.

use super::Table;
use super::program::Program;
use std::time::{Duration, Instant};
use tsubu_assemble::{Choices, build};
use tsubu_scene::Source;

/// No soak takes longer.
const LONGEST: Duration = Duration::from_secs(2 * 3600);
/// Looks of the observers in a soak.
const LOOKS: u64 = 200;
/// Share by which memory may grow after the first tenth.
const GROWTH: f64 = 0.05;

/// Both soaks; a row each.
pub fn run(program: &Program, table: &mut Table) -> Result<(), String> {
    eprintln!("planned: 2e7 steps of the feeder or 2 h, then 1e7 steps of the bed");
    table.row(
        "soak of the screw feeder",
        soaked(
            program,
            "screw_feeder.ron",
            20_000_000,
            &["output.energies=true"],
        ),
    );
    table.row(
        "soak of the movable bed",
        soaked(program, "movable_bed.ron", 10_000_000, &[]),
    );
    Ok(())
}

fn soaked(program: &Program, name: &str, steps: u64, changes: &[&str]) -> Result<String, String> {
    let words = |e: tsubu_scene::SceneError| e.to_string();
    let mut source = Source::read(program.root.join("scenarios").join(name)).map_err(words)?;
    for change in changes {
        source.set(change).map_err(words)?;
    }
    source.set(&format!("time.steps={steps}")).map_err(words)?;
    let checked = source.check().map_err(words)?;
    let choices = Choices {
        grids: Some(program.yard.join("grids")),
        ..Choices::default()
    };
    let mut run = build(&checked, &choices).map_err(words)?.simulation;
    let start = Instant::now();
    run.look();
    let (mut early, mut looks) = (None, 0);
    let mut speeds = Vec::new();
    while !run.is_over() && start.elapsed() < LONGEST {
        let before = Instant::now();
        let taken = run.advance(steps / LOOKS);
        speeds.push(taken as f64 * run.grains() as f64 / before.elapsed().as_secs_f64());
        run.look();
        looks += 1;
        if looks == LOOKS / 10 {
            early = Some(memory());
        }
    }
    let stop = run.stop();
    let report = run.report();
    let value = |name: &str| report.iter().find(|r| r.name == name).map(|r| r.value);
    let tenth = (speeds.len() / 10).max(1);
    let mean = |some: &[f64]| some.iter().sum::<f64>() / some.len() as f64 / 1e6;
    let said = format!(
        "{} steps, {:?}; grains missing {:?}, energy books off by {:?}; {:.0} MB after {:.0} MB; {:.1} million grain-steps/s after {:.1}",
        run.steps(),
        stop,
        value("grains_missing"),
        value("energy_budget_error"),
        memory(),
        early.unwrap_or(f64::NAN),
        mean(&speeds[speeds.len() - tenth..]),
        mean(&speeds[..tenth])
    );
    let lost = value("grains_missing").is_some_and(|missing| missing != 0.0);
    let open_books = value("energy_budget_error").is_some_and(|error| error >= 0.01);
    let grown = early.is_some_and(|early| memory() > early * (1.0 + GROWTH) + 8.0);
    let failed = stop.is_some_and(|stop| stop != tsubu_assemble::Stop::Over);
    if lost || open_books || grown || failed {
        return Err(said);
    }
    Ok(said)
}

/// Memory that this process holds, in MB; NaN where the system does not say.
fn memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    let kib = line.and_then(|l| l.trim().trim_end_matches(" kB").parse::<f64>().ok());
    kib.unwrap_or(f64::NAN) / 1024.0
}
