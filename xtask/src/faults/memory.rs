//! Too little memory at the start: refused in words, before anything is written.

use super::Table;
use super::program::Program;

/// One row for each thing that can be too large.
pub fn run(program: &Program, table: &mut Table) -> Result<(), String> {
    let large = |name: &str, changes: &[&str]| -> Result<String, String> {
        let out = program.fresh("memory")?;
        std::fs::remove_dir(&out).map_err(|e| e.to_string())?;
        let scene = program.root.join("scenarios").join(name);
        let (scene, folder) = (scene.display().to_string(), out.display().to_string());
        let mut line = vec!["run", &scene, "--out", &folder, "--threads", "1"];
        line.extend(changes.iter().flat_map(|change| ["--set", change]));
        // 400 MB in all: the program itself maps some of it.
        let outcome = program.start_limited("-v 400000", &line)?.end()?;
        let said = outcome.is(4, &["memory", "help:"])?;
        if out.exists() {
            return Err("a folder was made all the same".into());
        }
        Ok(said)
    };
    table.row(
        "memory for 6 million grains of a fill",
        large("angle_of_repose.ron", &["grains.coarse=0", "initial.fill.region=(min: (\"0 mm\", \"0 mm\", \"0 mm\"), max: (\"150 mm\", \"54 mm\", \"3 m\"))"]),
    );
    table.row(
        "memory for 4 million grains of a bed",
        large(
            "movable_bed.ron",
            &["initial.bed.layers=10000", "domain.x=Periodic(\"200 mm\")"],
        ),
    );
    Ok(())
}
