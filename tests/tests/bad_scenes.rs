//! Every bad scene ends with exactly the message it states, in the library and in the command, and leaves nothing.

use tsubu::assemble::{Choices, build};
use tsubu::scene::testing::Expected;
use tsubu::scene::{SceneError, Source};
use tsubu_tests::{Outcome, Scratch, run_in, scene_files, tree};

/// Everything that happens to a scene before it runs.
fn assemble(path: &std::path::Path) -> Result<(), SceneError> {
    let checked = Source::read(path)?.check()?;
    build(&checked, &Choices::default()).map(drop)
}

fn expected(path: &std::path::Path) -> Expected {
    // Bytes that are no UTF-8 are among the bad scenes; their statement is readable all the same.
    let bytes = std::fs::read(path).unwrap_or_default();
    let stated = Expected::read(&String::from_utf8_lossy(&bytes));
    stated.unwrap_or_else(|| panic!("{} states no message", path.display()))
}

#[test]
fn say_what_they_state_when_assembled() {
    let (mut wrong, mut late) = (Vec::new(), 0);
    for path in scene_files("tests/scenes/bad") {
        let name = path.file_name().unwrap_or_default().display();
        let expected = expected(&path);
        late += usize::from(expected.when_assembled);
        match assemble(&path) {
            Ok(()) => wrong.push(format!("{name}: is assembled without a word")),
            Err(error) => {
                wrong.extend(expected.differs(&error).map(|how| format!("{name}: {how}")));
                // Every message says what to do, in a line of its own.
                if !error.to_string().contains("help: ") {
                    wrong.push(format!("{name}: does not say what to do\n{error}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    // A folder that is not found must not pass for a folder without faults.
    assert!(
        late >= 14,
        "only {late} scenes that are wrong when assembled"
    );
}

/// The stated message and place stand in the words of the command.
fn shows(outcome: &Outcome, expected: &Expected) -> bool {
    let place = expected.place.is_none_or(|(line, column)| {
        outcome.stderr.lines().any(|shown| {
            shown.trim_start().starts_with("--> ") && shown.ends_with(&format!(":{line}:{column}"))
        })
    });
    // Long headlines are not wrapped, so the message stands in one line.
    place && outcome.stderr.contains(&expected.message)
}

#[test]
fn end_the_command_with_one_message_and_leave_nothing() {
    let scratch = Scratch::new("bad");
    for path in scene_files("tests/scenes/bad") {
        let expected = expected(&path);
        for verb in ["run", "check"] {
            let outcome = run_in(scratch.path(), &format!("{verb} {}", path.display()));
            assert_eq!(outcome.code, 2, "{outcome:#?}");
            assert!(
                shows(&outcome, &expected),
                "{} states {expected:?}, but the command says\n{}",
                path.display(),
                outcome.stderr
            );
            assert!(!outcome.stderr.contains("panicked"), "{outcome:#?}");
            assert!(outcome.stderr.starts_with("error: "), "{outcome:#?}");
            // `check` may have shown the limits before it refuses the step.
            assert!(verb == "check" || outcome.stdout.is_empty(), "{outcome:#?}");
        }
    }
    assert!(
        tree(scratch.path()).is_empty(),
        "a refused scene leaves {:?}",
        tree(scratch.path()).keys()
    );
}

#[test]
fn a_refused_scene_leaves_the_folder_asked_for_unmade() {
    let scratch = Scratch::new("unmade");
    let bad = |name: &str| {
        scene_files("tests/scenes/bad")
            .into_iter()
            .find(|p| p.ends_with(name))
            .map(|p| p.display().to_string())
            .unwrap_or_default()
    };
    for name in [
        "negative_diameter.ron",
        "listed_grains_overlap.ron",
        "step_over_the_limit.ron",
    ] {
        run_in(scratch.path(), &format!("run {} --out asked", bad(name))).is_one_message(2);
        assert!(!scratch.join("asked").exists());
    }
}

#[test]
fn a_scene_that_is_not_there_or_is_a_folder_is_refused() {
    let scratch = Scratch::new("absent");
    run_in(scratch.path(), "run absent.ron")
        .is_one_message(2)
        .says("absent.ron");
    run_in(scratch.path(), "check .")
        .is_one_message(2)
        .says("this is a folder");
    assert!(tree(scratch.path()).is_empty());
}

#[test]
fn a_change_that_is_wrong_is_shown_as_it_was_typed() {
    let scratch = Scratch::new("set");
    let scene = tsubu_tests::repository().join("tests/scenes/good/smallest.ron");
    let scene = scene.display();
    for (arguments, words) in [
        ("--set grains.diameter=2", "bare number"),
        ("--set grains.diametre=2~mm", "diametre"),
        (
            "--set grains.diameter=-2~mm",
            "the diameter is not above zero",
        ),
        ("--set grains.diameter", "without “=”"),
        ("--until 2~kg", "“kg” is a mass"),
        ("--until never", "--set:1:"),
        ("--set time.step=PerPeriod(2)", "is over its limit"),
        ("--set initial.file=absent.csv", "there is no grain file"),
    ] {
        run_in(scratch.path(), &format!("run {scene} {arguments}"))
            .is_one_message(2)
            .says(words);
    }
    assert!(tree(scratch.path()).is_empty());
}
