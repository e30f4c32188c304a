//! `tsubu export`: writes the deck of a scene into a folder.

use crate::arguments::{ExportWish, TargetWish};
use crate::clock::Clock;
use crate::run::{choices, read, stem};
use crate::trouble::Trouble;
use tsubu::assemble::Plan;
use tsubu::export::{self, Target};
use tsubu::record::{RunFolder, write_whole};

/// The file of the scene in the folder of a deck.
const SCENE: &str = "scene.resolved.ron";

/// `tsubu export`.
pub fn export(wish: &ExportWish) -> Result<u8, Trouble> {
    let target = match wish.target {
        TargetWish::Lammps => Target::Lammps,
        TargetWish::Liggghts => Target::Liggghts,
    };
    let checked = read(&wish.scene)?;
    let choices = choices(&wish.scene, wish.out.as_deref());
    // A frame of the dump is a row of the series too.
    let rows = |plan: &Plan| Some(Clock::of(&checked.scene.output, plan).row);
    let deck = export::deck(target, &checked, &choices, &rows)?;
    let default = format!("{}-{}", stem(&wish.scene), target.name());
    let folder = RunFolder::create(wish.out.as_deref(), &default, wish.force)?;
    let own = [
        ("run.sh".to_owned(), deck.script()),
        (
            "README.md".to_owned(),
            deck.readme(&checked.scene.title, SCENE),
        ),
        // With every change of the command line in it, so that an import needs none of them.
        (SCENE.to_owned(), checked.scene.to_resolved_ron()),
    ];
    for (name, text) in deck.files.iter().chain(&own) {
        write_whole(&folder.path(name), text.as_bytes())?;
    }
    let walls = match deck.wall_grains {
        0 => String::new(),
        count => format!(" and {count} wall grains"),
    };
    say!(
        "{}: {} grains{walls} for {}, in {}",
        checked.scene.title,
        deck.grains,
        target.title(),
        folder.root().display()
    );
    for line in &deck.differs {
        say!("note: {line}");
    }
    say!(
        "Run it:       cd {} && {}",
        folder.root().display(),
        deck.run_line(2)
    );
    say!(
        "Read it back: tsubu import {} --scene {} --out DIR",
        folder.path(export::DUMP).display(),
        folder.path(SCENE).display()
    );
    Ok(0)
}
