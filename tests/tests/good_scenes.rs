//! Every good scene and every scenario runs to its end, and its resolved text runs to the same bits.

use std::path::{Path, PathBuf};
use tsubu::assemble::{Built, Choices, Constants, Stop, build};
use tsubu::scene::{Checked, End, Source};
use tsubu_tests::{bits, repository, run_out, scene_files};

/// Changes that make a scene short without changing what it is made of: the wait for stillness is over at its
/// first look, the coarsest grains that the scenario speaks of, and so many steps.
fn shortened(path: &Path) -> Checked {
    let mut source = Source::read(path).unwrap_or_else(|error| panic!("{error}"));
    let mut set = |change: &str| source.set(change).unwrap_or_else(|error| panic!("{error}"));
    if path.ends_with("angle_of_repose.ron") {
        set("grains.coarse=3");
    }
    if path
        .file_stem()
        .is_some_and(|name| name.to_string_lossy().starts_with("screw_feeder"))
    {
        set("grains.coarse=4");
    }
    let text = std::fs::read_to_string(path).unwrap_or_default();
    if text.contains("still: (") {
        set("still.kinetic_energy=1e9");
        set("still.for_at_least=0 s");
    }
    set("time.steps=300");
    source.check().unwrap_or_else(|error| panic!("{error}"))
}

fn assembled(checked: &Checked) -> Built {
    // Grids of distances are kept between the tests, as the command keeps them between runs.
    let grids = Some(Path::new(env!("CARGO_TARGET_TMPDIR")).join("grids"));
    let choices = Choices {
        grids,
        ..Choices::default()
    };
    build(checked, &choices).unwrap_or_else(|error| panic!("{error}"))
}

fn all() -> Vec<PathBuf> {
    let mut paths = scene_files("tests/scenes/good");
    paths.extend(scene_files("scenarios"));
    assert!(paths.len() >= 6, "the scenes are not where they were");
    paths
}

#[test]
fn run_to_their_end_and_again_from_their_resolved_text() {
    for path in all() {
        let checked = shortened(&path);
        let mut first = assembled(&checked).simulation;
        let start = bits(&*first);
        run_out(&mut *first);
        assert_eq!(first.stop(), Some(Stop::Over), "{}", path.display());
        assert!(
            first
                .state()
                .iter()
                .all(|(x, v)| x.is_finite() && v.is_finite()),
            "{}",
            path.display()
        );
        // Grains that never moved would make the comparison below empty.
        assert_ne!(bits(&*first), start, "{}", path.display());

        let resolved = checked.scene.to_resolved_ron();
        let again = Source::from_text("resolved", &resolved)
            .check()
            .unwrap_or_else(|error| panic!("{error}\n{resolved}"));
        let mut second = assembled(&again).simulation;
        run_out(&mut *second);
        assert_eq!(second.steps(), first.steps(), "{}", path.display());
        assert!(
            bits(&*second) == bits(&*first),
            "{}: the resolved scene runs to other bits",
            path.display()
        );
    }
}

#[test]
fn look_and_report_the_same_names_in_every_row() {
    for path in all() {
        let mut run = assembled(&shortened(&path)).simulation;
        let names = |run: &mut dyn tsubu::assemble::Simulation| {
            run.look()
                .iter()
                .map(|r| (r.name.clone(), r.unit))
                .collect::<Vec<_>>()
        };
        let first = names(&mut *run);
        run.advance(50);
        assert_eq!(names(&mut *run), first, "{}", path.display());
        run_out(&mut *run);
        assert_eq!(names(&mut *run), first, "{}", path.display());
        let mut sorted = first.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(
            sorted.len(),
            first.len(),
            "a column has two meanings: {first:?}"
        );
    }
}

#[test]
fn the_small_heap_waits_for_stillness_and_then_runs_as_long_as_it_says() {
    let path = repository().join("tests/scenes/good/small_heap.ron");
    let checked = Source::read(path)
        .and_then(|source| source.check())
        .unwrap_or_else(|error| panic!("{error}"));
    let Built {
        mut simulation,
        plan,
    } = assembled(&checked);
    assert!(
        simulation.last_step().is_none(),
        "the end is known before the release"
    );
    run_out(&mut *simulation);
    assert_eq!(simulation.stop(), Some(Stop::Over));
    let End::Until(until) = checked.scene.time.end else {
        panic!("the scene ends after a time")
    };
    let released = simulation.released_at().unwrap_or(f64::NAN);
    // Half a step is all that rounding the end to steps can cost.
    assert!((simulation.time() - released - until).abs() <= 0.51 * plan.constants.dt);
    assert!(
        released >= 5e-3,
        "still for 5 ms means at least 5 ms, not {released}"
    );
    simulation.look();
    let angle = simulation
        .report()
        .into_iter()
        .find(|r| r.name == "angle_of_repose");
    // A heap, not a wall and not a puddle; the value itself belongs to `cargo xtask validate repose`.
    assert!(
        angle
            .as_ref()
            .is_some_and(|r| r.value > 2.0 && r.value < 60.0),
        "{angle:?}"
    );
}

/// A step that the program chooses is at most a twentieth of the period, and leaves room below every limit: a tenth of it for
/// grains that do not turn, and for those that do what a packing of them needs.
#[test]
fn a_step_that_the_program_chooses_keeps_clear_of_every_limit() {
    for (path, most) in scene_files("scenarios").iter().map(|path| {
        let turning =
            std::fs::read_to_string(path).is_ok_and(|text| text.contains("SpringDashpot("));
        (path, if turning { 0.15 } else { 0.9 })
    }) {
        let mut source = Source::read(path).unwrap_or_else(|error| panic!("{error}"));
        for change in ["time.step=Automatic", "grains.coarse=0"] {
            source.set(change).unwrap_or_else(|error| panic!("{error}"));
        }
        // Constants and limits need no grains and no grids: the box of a screw is not asked for.
        let checked = source.check().unwrap_or_else(|error| panic!("{error}"));
        let constants = Constants::of(&checked).unwrap_or_else(|error| panic!("{error}"));
        let limits = constants.limits();
        assert!(
            constants.dt <= constants.period / 20.0,
            "{}",
            path.display()
        );
        assert!(!limits.is_empty());
        for limit in limits {
            assert!(limit.used <= most, "{}: {limit:?}", path.display());
        }
        // No shorter than it needs to be.
        let tight = constants.limits().iter().any(|l| l.used > 0.98 * most);
        assert!(
            tight || constants.dt == constants.period / 20.0,
            "{}",
            path.display()
        );
    }
}
