//! What each piece of the physics of a scene costs and changes: each is left out alone.

use super::scene::{Setting, Subject, mean, setting};
use super::{bed, feeder, heap};
use crate::validate::scenes::keep;
use std::fmt::Write as _;
use std::path::Path;

/// A scene as it is priced, and its pieces.
pub struct List {
    pub subject: Subject,
    tries: u64,
    pub base: Setting,
    pub pieces: Vec<Setting>,
}

/// The three scenes.
pub fn lists() -> [List; 3] {
    let n4 = "grains.coarse=4";
    [
        List {
            subject: heap::subject(),
            tries: 3,
            base: setting("heap, n = 3", "", &["grains.coarse=3"]),
            pieces: vec![
                setting(
                    "friction of the walls",
                    "",
                    &[
                        "grains.coarse=3",
                        "walls.floor.friction=None",
                        "walls.left.friction=None",
                    ],
                ),
                setting(
                    "restitution of the walls",
                    "",
                    &[
                        "grains.coarse=3",
                        "walls.floor.restitution=None",
                        "walls.left.restitution=None",
                    ],
                ),
                setting(
                    "damping across contacts",
                    "",
                    &[
                        "grains.coarse=3",
                        "grains.law.damping=Parts(normal: \"0.1257 kg/s\", tangential: \"0 kg/s\")",
                    ],
                ),
                setting(
                    "depth: half of the slice",
                    "",
                    &[
                        "grains.coarse=3",
                        "domain.y=Periodic(\"32.4 mm\")",
                        "initial.fill.region.max=(\"150 mm\", \"32.4 mm\", \"420 mm\")",
                    ],
                ),
                setting(
                    "stiffness: E/1000 instead of E/100, damping softened too",
                    "",
                    &[
                        "grains.coarse=3",
                        "grains.soften=1000",
                        "grains.softened_damping=Scaled",
                    ],
                ),
                setting("one level of grain size: n = 4", "", &["grains.coarse=4"]),
            ],
        },
        List {
            subject: feeder::subject(),
            tries: 1,
            base: setting("feeder, n = 4", "", &[n4]),
            pieces: vec![
                setting(
                    "friction of the walls",
                    "",
                    &[
                        n4,
                        "walls.screw.friction=None",
                        "walls.casing.friction=None",
                        "walls.hopper.friction=None",
                    ],
                ),
                setting(
                    "restitution of the walls",
                    "",
                    &[
                        n4,
                        "walls.screw.restitution=None",
                        "walls.casing.restitution=None",
                        "walls.hopper.restitution=None",
                    ],
                ),
                setting(
                    "damping across contacts",
                    "",
                    &[
                        n4,
                        "grains.law.damping=Parts(normal: \"0.1257 kg/s\", tangential: \"0 kg/s\")",
                    ],
                ),
                setting(
                    "edges of the flight: cell 4 mm",
                    "",
                    &[n4, "walls.screw.shape.surface=Grid(cell: \"4 mm\")"],
                ),
                setting(
                    "stiffness: E/1000 instead of E/100, damping softened too",
                    "",
                    &[n4, "grains.soften=1000", "grains.softened_damping=Scaled"],
                ),
                setting("one level of grain size: n = 5", "", &["grains.coarse=5"]),
            ],
        },
        List {
            subject: bed::subject(),
            tries: 6,
            base: setting("bed", "", &[]),
            pieces: vec![
                setting("turbulence", "", &["water.turbulence=Off"]),
                setting("shelter", "", &["water.shelter=1"]),
                setting("added mass", "", &["water.added_mass=0"]),
                setting("a datum that follows the bed", "", &["water.datum=Frozen"]),
                setting(
                    "the cap on spring and dashpot together",
                    "",
                    &["grains.law.slip=AsPrinted"],
                ),
                setting(
                    "friction: a tenth of it",
                    "",
                    &["grains.law.friction=0.0577"],
                ),
                setting("depth: 5 layers", "", &["initial.bed.layers=5"]),
                setting("the third dimension, added", "", &["space=Space"]),
            ],
        },
    ]
}

/// Prints the lists and writes docs/charts/price.csv.
pub fn run(root: &Path) -> Result<bool, String> {
    let mut csv = "scene,left out,quantity,change of the answer,standard error,cost over that of the scene,bytes per grain\n".to_owned();
    for list in lists() {
        let mut wanted = vec![(&list.base, list.tries)];
        wanted.extend(list.pieces.iter().map(|piece| (piece, list.tries)));
        let all = list.subject.runs(root, &wanted)?;
        let told = |runs: &Vec<Option<super::runs::Ran>>| {
            let runs: Option<Vec<_>> = runs.iter().copied().collect();
            let runs = runs?;
            let n = runs.len() as f64;
            let cost = runs.iter().map(|r| r.cost).sum::<f64>() / n;
            Some((mean(&runs), cost, runs[0].bytes))
        };
        let Some(((base, base_error), base_cost, bytes)) = told(&all[0]) else {
            return Err(format!("{}: the scene itself broke", list.base.name));
        };
        println!(
            "{}: {} = {base:.4} ± {base_error:.4}, {base_cost:.1} s of one core, {bytes:.0} bytes a grain\n  {:<58} {:>9} {:>8} {:>7} {:>7}",
            list.base.name, list.subject.word, "without", "change", "±", "cost", "bytes"
        );
        for (piece, runs) in list.pieces.iter().zip(&all[1..]) {
            let Some(((value, error), cost, bytes)) = told(runs) else {
                println!("  {:<58} broke", piece.name);
                continue;
            };
            let (change, spread) = (
                value / base - 1.0,
                (error / base).hypot(value / base * base_error / base),
            );
            println!(
                "  {:<58} {change:>+9.3} {spread:>8.3} {:>7.2} {bytes:>7.0}",
                piece.name,
                cost / base_cost
            );
            let _ = writeln!(
                csv,
                "\"{}\",\"{}\",{},{change:?},{spread:?},{:?},{bytes:?}",
                list.base.name,
                piece.name,
                list.subject.quantity,
                cost / base_cost
            );
        }
    }
    keep(&root.join("docs/charts/price.csv"), &csv)?;
    Ok(true)
}
