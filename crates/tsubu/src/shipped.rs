//! The scenes that come with the program.

use crate::trouble::Trouble;
use std::path::Path;
use tsubu::scene::Source;

/// Name and text of each shipped scene.
const SCENES: [(&str, &str); 1] = [(
    "angle_of_repose",
    include_str!("../../../scenarios/angle_of_repose.ron"),
)];

/// `tsubu scenes`.
pub fn list() -> Result<u8, Trouble> {
    for (name, text) in SCENES {
        let title = Source::from_text(name, text).check()?.scene.title;
        say!("{name:<20} {title}");
    }
    say!("\nCopy one here to edit it:  tsubu init {}", SCENES[0].0);
    Ok(0)
}

/// `tsubu init NAME`.
pub fn init(name: &str) -> Result<u8, Trouble> {
    let name = name.trim_end_matches(".ron");
    let Some((name, text)) = SCENES.iter().find(|s| s.0 == name) else {
        let known: Vec<&str> = SCENES.iter().map(|s| s.0).collect();
        return Err(Trouble::Arguments(format!(
            "there is no shipped scene `{name}`\nhelp: shipped are {}",
            known.join(", ")
        )));
    };
    let file = format!("{name}.ron");
    if Path::new(&file).exists() {
        return Err(Trouble::Arguments(format!(
            "{file} is already here\nhelp: move it away, or run it: tsubu run {file}"
        )));
    }
    tsubu::record::write_whole(Path::new(&file), text.as_bytes())?;
    say!("wrote {file}; edit it, then:  tsubu run {file}");
    Ok(0)
}
