//! The scenes of the bench: a dense bed and a dilute gas at several sizes, flow out of a hopper, the screw.

use super::grains;
use crate::peers::Engine;
use crate::validate::scenes::{build_on, changed, keep, listed};
use std::path::{Path, PathBuf};
use tsubu_scene::Source;

/// A scene for the bench.
pub struct Case {
    /// `bed`, `gas`, `hopper`, `screw`.
    pub scene: &'static str,
    /// The law, and what walls are made of where that differs between targets.
    pub law: &'static str,
    /// Number of grains.
    pub grains: usize,
    /// The scene.
    pub source: Source,
    /// Engines that are asked for it.
    pub engines: &'static [Engine],
    /// The file of its grains.
    pub file: PathBuf,
}

const REPULSION: &str = "benches/scenes/repulsion.ron";
const SPRINGS: &str = "benches/scenes/spring_dashpot.ron";

/// Names of the scenes.
pub const SCENES: [&str; 4] = ["bed", "gas", "hopper", "screw"];

/// The cases of these scenes, from small to large within a scene, up to about `most` grains.
pub fn of(root: &Path, scenes: &[&str], most: usize) -> Result<Vec<Case>, String> {
    let folder = root.join("target/bench");
    let mut cases = Vec::new();
    for scene in scenes {
        cases.extend(match *scene {
            "bed" => beds(root, &folder, most)?,
            "gas" => gases(root, &folder, most)?,
            "hopper" => hoppers(root, &folder)?,
            _ => vec![screw(root, &folder)?],
        });
    }
    Ok(cases)
}

/// Settled beds on a floor.
fn beds(root: &Path, folder: &Path, most: usize) -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for (law, scene, engines) in [
        ("Repulsion", REPULSION, &[Engine::Lammps][..]),
        ("SpringDashpot", SPRINGS, &Engine::ALL[..]),
    ] {
        for cut in grains::CUTS {
            let (text, side, count) = grains::bed(root, cut)?;
            if count > most {
                continue;
            }
            let file = folder.join(format!("bed_{count}.csv"));
            keep(&file, &text)?;
            let mut sets = at(&file, &[("x", side), ("y", side)]);
            // The packing lay with its centres on the floor.
            sets.push("walls.floor.touches_at=Centre".into());
            cases.push(case(root, "bed", law, scene, &sets, engines, count, file)?);
        }
    }
    Ok(cases)
}

/// Gases that cool.
fn gases(root: &Path, folder: &Path, most: usize) -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for count in [1_000, 10_000, 100_000] {
        if count > most {
            continue;
        }
        let (text, side) = grains::gas(count);
        let file = folder.join(format!("gas_{count}.csv"));
        keep(&file, &text)?;
        let mut sets = at(&file, &[("x", side), ("y", side), ("z", side)]);
        sets.push("walls=[]".into());
        sets.push("gravity=0 m/s2".into());
        let engines = &[Engine::Lammps][..];
        cases.push(case(
            root,
            "gas",
            "Repulsion",
            REPULSION,
            &sets,
            engines,
            count,
            file,
        )?);
    }
    Ok(cases)
}

#[allow(clippy::too_many_arguments)] // one row of a table
fn case(
    root: &Path,
    scene: &'static str,
    law: &'static str,
    of: &str,
    sets: &[String],
    engines: &'static [Engine],
    grains: usize,
    file: PathBuf,
) -> Result<Case, String> {
    let mut sets = sets.to_vec();
    sets.push("time.steps=100000000".into());
    Ok(Case {
        scene,
        law,
        grains,
        source: changed(&root.join(of), &sets)?,
        engines,
        file,
    })
}

/// Grains from a file, in a box of these periods in m.
fn at(file: &Path, periods: &[(&str, f64)]) -> Vec<String> {
    let mut sets = vec![format!("initial.file={}", file.display())];
    for (axis, side) in periods {
        sets.push(format!("domain.{axis}=Periodic(\"{side:?} m\")"));
    }
    sets
}

/// Flow out of a conical hopper under a silo: of wall grains for LAMMPS, of triangles for LIGGGHTS.
fn hoppers(root: &Path, folder: &Path) -> Result<Vec<Case>, String> {
    let mesh = folder.join("hopper.stl");
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    std::fs::write(&mesh, grains::hopper()?).map_err(|e| format!("{}: {e}", mesh.display()))?;
    let mut cases = Vec::new();
    for (law, scene, surface, engines) in [
        (
            "Repulsion",
            REPULSION,
            "Grains(radius: \"0.675 mm\")",
            &[Engine::Lammps][..],
        ),
        ("SpringDashpot", SPRINGS, "Exact", &[Engine::Liggghts][..]),
    ] {
        let walls = format!(
            "walls=[(name: \"hopper\", shape: Mesh(file: \"{}\", unit: \"m\", surface: {surface}))]",
            mesh.display()
        );
        let base = vec![walls, "domain=(x: Open, y: Open, z: Open)".to_owned()];
        let file = folder.join(format!("hopper_{law}.csv"));
        if !file.exists() {
            // Filled and let flow until grains fall out of the opening all the time.
            let mut sets = base.clone();
            sets.push("initial=(fill: (region: (min: (\"-14 mm\", \"-14 mm\", \"18 mm\"), max: (\"14 mm\", \"14 mm\", \"50 mm\")), solid_fraction: 0.28, seed: 1))".into());
            sets.push("time.steps=40000".into());
            eprintln!("  filling the hopper ({law}) …");
            let mut run = build_on(&changed(&root.join(scene), &sets)?, 2)?.simulation;
            run.advance(u64::MAX);
            keep(&file, &grains::state(&*run, -30e-3))?;
        }
        let count = grains::count(&file)?;
        let mut sets = base;
        sets.push(format!("initial.file={}", file.display()));
        cases.push(case(
            root, "hopper", law, scene, &sets, engines, count, file,
        )?);
    }
    Ok(cases)
}

/// Paper A's feeder at n = 4, every body of wall grains, in full flow.
fn screw(root: &Path, folder: &Path) -> Result<Case, String> {
    let mut sets = vec![
        "outlets=None".to_owned(),
        "measures=None".to_owned(),
        "grains.law.damping=Equal(\"32.1792 kg/s\")".into(),
    ];
    for wall in ["screw", "casing", "hopper"] {
        sets.push(format!(
            "walls.{wall}.shape.surface=Grains(radius: \"5.4 mm\")"
        ));
        sets.push(format!("walls.{wall}.restitution=None"));
        sets.push(format!("walls.{wall}.friction=None"));
    }
    sets.push("walls.screw.motion.begins=At(\"0 s\")".into());
    sets.push("still=None".into());
    let file = folder.join("screw.csv");
    let scene = "scenarios/screw_feeder.ron";
    if !file.exists() {
        eprintln!("  filling the screw …");
        let mut filling = sets.clone();
        filling.push("grains.coarse=4".into());
        filling.push("grains.law.damping=Equal(\"0.1257 kg/s\")".into());
        filling.push("time.until=1.2 s".into());
        let mut run = build_on(&changed(&root.join(scene), &filling)?, 2)?.simulation;
        run.advance(u64::MAX);
        keep(&file, &grains::state(&*run, -0.3))?;
    }
    let count = grains::count(&file)?;
    sets.extend(listed(4, &file));
    case(
        root,
        "screw",
        "Repulsion",
        scene,
        &sets,
        &[Engine::Lammps],
        count,
        file,
    )
}
