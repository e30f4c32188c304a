//! The scenes that come with the program.

use crate::trouble::Trouble;
use std::path::Path;
use tsubu::scene::Source;

/// A scene that comes with the program, and the files that it names.
struct Shipped {
    name: &'static str,
    text: &'static str,
    files: &'static [(&'static str, &'static [u8])],
}

const SCENES: [Shipped; 6] = [
    Shipped {
        name: "angle_of_repose",
        text: include_str!("../../../scenarios/angle_of_repose.ron"),
        files: &[],
    },
    Shipped {
        name: "hopper",
        text: include_str!("../../../scenarios/hopper.ron"),
        files: &[
            (
                "meshes/cone.stl",
                include_bytes!("../../../scenarios/meshes/cone.stl"),
            ),
            (
                "meshes/cone_inside.stl",
                include_bytes!("../../../scenarios/meshes/cone_inside.stl"),
            ),
        ],
    },
    Shipped {
        name: "movable_bed",
        text: include_str!("../../../scenarios/movable_bed.ron"),
        files: &[],
    },
    Shipped {
        name: "screw_feeder",
        text: include_str!("../../../scenarios/screw_feeder.ron"),
        files: &[
            (
                "meshes/screw.stl",
                include_bytes!("../../../scenarios/meshes/screw.stl"),
            ),
            (
                "meshes/casing.stl",
                include_bytes!("../../../scenarios/meshes/casing.stl"),
            ),
            (
                "meshes/hopper.stl",
                include_bytes!("../../../scenarios/meshes/hopper.stl"),
            ),
            (
                "meshes/fill.stl",
                include_bytes!("../../../scenarios/meshes/fill.stl"),
            ),
        ],
    },
    Shipped {
        name: "screw_section",
        text: include_str!("../../../scenarios/screw_section.ron"),
        files: &[(
            "meshes/screw_section.stl",
            include_bytes!("../../../scenarios/meshes/screw_section.stl"),
        )],
    },
    Shipped {
        name: "screw_feeder_full",
        text: include_str!("../../../scenarios/screw_feeder_full.ron"),
        files: &[
            (
                "meshes/screw.stl",
                include_bytes!("../../../scenarios/meshes/screw.stl"),
            ),
            (
                "meshes/casing.stl",
                include_bytes!("../../../scenarios/meshes/casing.stl"),
            ),
            (
                "meshes/hopper_full.stl",
                include_bytes!("../../../scenarios/meshes/hopper_full.stl"),
            ),
            (
                "meshes/fill_full.stl",
                include_bytes!("../../../scenarios/meshes/fill_full.stl"),
            ),
        ],
    },
];

/// `tsubu scenes`.
pub fn list() -> Result<u8, Trouble> {
    for Shipped { name, text, .. } in SCENES {
        let title = Source::from_text(name, text).check()?.scene.title;
        say!("{name:<20} {title}");
    }
    say!("\nCopy one here to edit it:  tsubu init {}", SCENES[0].name);
    Ok(0)
}

/// `tsubu init NAME`.
pub fn init(name: &str) -> Result<u8, Trouble> {
    let name = name.trim_end_matches(".ron");
    let Some(scene) = SCENES.iter().find(|s| s.name == name) else {
        let known: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
        return Err(Trouble::Arguments(format!(
            "there is no shipped scene `{name}`\nhelp: shipped are {}",
            known.join(", ")
        )));
    };
    let file = format!("{name}.ron");
    let mut all = vec![(file.as_str(), scene.text.as_bytes())];
    all.extend(scene.files);
    // A mesh that another scene has brought already is no obstacle.
    let same = |file: &str, bytes: &[u8]| std::fs::read(file).ok().as_deref() == Some(bytes);
    let obstacle = all
        .iter()
        .enumerate()
        .find(|(k, (file, bytes))| Path::new(file).exists() && (*k == 0 || !same(file, bytes)));
    if let Some((_, (here, _))) = obstacle {
        return Err(Trouble::Arguments(format!(
            "{here} is already here\nhelp: move it away, or run what is here: tsubu run {file}"
        )));
    }
    for (file, bytes) in &all {
        let path = Path::new(file);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| {
                Trouble::Arguments(format!(
                    "the folder {} could not be made: {e}\nhelp: go to a folder where you may write",
                    folder.display()
                ))
            })?;
        }
        tsubu::record::write_whole(path, bytes)?;
    }
    let others = match scene.files.len() {
        0 => String::new(),
        n => format!(" and {n} files that it names"),
    };
    say!("wrote {file}{others}; edit it, then:  tsubu run {file}");
    Ok(0)
}
