//! Every scene of the repository: good ones read back from their resolved text, bad ones say what they state.

use std::path::{Path, PathBuf};

use tsubu_scene::testing::Expected;
use tsubu_scene::{SceneError, Source};

fn scenes(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(folder);
    let entries =
        std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "ron"));
    paths.sort();
    paths
}

/// The checks of this crate, reading the file of grains included.
fn check(path: &Path) -> Result<(), SceneError> {
    Source::read(path)?.check()?.starting_grains().map(drop)
}

#[test]
fn bad_scenes_say_what_they_state() {
    let mut wrong = Vec::new();
    let mut own = 0;
    for path in scenes("tests/scenes/bad") {
        let name = path.file_name().unwrap_or_default().display().to_string();
        // Bytes that are no UTF-8 are among the bad scenes; their statement is readable all the same.
        let text = String::from_utf8_lossy(&std::fs::read(&path).expect("listed a moment ago"))
            .into_owned();
        let Some(expected) = Expected::read(&text) else {
            wrong.push(format!("{name}: states no message"));
            continue;
        };
        match (check(&path), expected.when_assembled) {
            (Ok(()), true) => {}
            (Ok(()), false) => wrong.push(format!("{name}: passes")),
            (Err(error), true) => {
                wrong.push(format!("{name}: found before it is assembled\n{error}"))
            }
            (Err(error), false) => {
                own += 1;
                wrong.extend(expected.differs(&error).map(|how| format!("{name}: {how}")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(own >= 25, "only {own} bad scenes");
}

#[test]
fn good_scenes_read_back() {
    let mut paths = scenes("tests/scenes/good");
    paths.extend(scenes("scenarios"));
    paths.extend(scenes("benches/scenes"));
    assert!(paths.len() >= 6);
    for path in paths {
        let scene = Source::read(&path)
            .and_then(|source| source.check())
            .unwrap_or_else(|error| panic!("{error}"))
            .scene;
        let resolved = scene.to_resolved_ron();
        let again = Source::from_text("resolved", &resolved)
            .check()
            .unwrap_or_else(|error| panic!("{error}\n{resolved}"))
            .scene;
        assert_eq!(again, scene, "{}", path.display());
        assert_eq!(again.to_resolved_ron(), resolved);
    }
}

#[test]
fn grains_of_the_good_scenes_can_be_read() {
    for path in scenes("tests/scenes/good") {
        check(&path).unwrap_or_else(|error| panic!("{error}"));
    }
}
