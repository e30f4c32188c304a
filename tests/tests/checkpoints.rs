//! A run that is saved, dropped and taken up again goes on to the same bits, in the library and in the command.

use crate::command::{frames, series, summary};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Child;
use std::time::Duration;
use tsubu::assemble::{Choices, Simulation, build};
use tsubu::model::Words;
use tsubu::scene::{Checked, Source};
use tsubu_tests::{
    Bits, Outcome, Scratch, bits, good_scene, kill, repository, run_in, scene_files, start_in, tree,
};

/// Everything a run has to say at one moment, to the bit: grains, row, report, curves, energies.
fn said(run: &mut dyn Simulation) -> (Bits, Vec<String>) {
    let mut words: Vec<String> = run.look().iter().map(|r| format!("{r:?}")).collect();
    words.extend(run.report().iter().map(|r| format!("{r:?}")));
    words.extend(run.curves().iter().map(|c| format!("{c:?}")));
    words.push(format!("{:?}", run.energies()));
    words.push(format!("{:?} {:?}", run.stop(), run.released_at()));
    (bits(run), words)
}

fn built(checked: &Checked, threads: usize) -> Box<dyn Simulation> {
    let choices = Choices {
        threads: Some(threads),
        // Grids of distances are kept between the tests, as the command keeps them between runs.
        grids: Some(std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("grids")),
        ..Choices::default()
    };
    build(checked, &choices)
        .unwrap_or_else(|error| panic!("{error}"))
        .simulation
}

/// Runs to `last`, looking every `row` steps; at each step of `stops` the run is saved, dropped, and another one that was
/// built anew with other threads goes on.
fn run(checked: &Checked, row: u64, last: u64, stops: &[u64]) -> (Bits, Vec<String>) {
    let mut run = built(checked, 1);
    run.look();
    let mut saved = 0;
    while !run.is_over() && run.steps() < last {
        let now = run.steps();
        let next_stop = stops.iter().filter(|stop| **stop > now).min();
        let to_row = row - now % row;
        let steps = next_stop.map_or(to_row, |stop| to_row.min(stop - now));
        run.advance(steps.min(last - now));
        if run.steps().is_multiple_of(row) && !run.is_over() {
            run.look();
        }
        if stops.contains(&run.steps()) {
            let mut words = Words::new();
            run.save(&mut words);
            saved += 1;
            run = built(checked, 1 + saved % 3);
            run.restore(&mut words)
                .unwrap_or_else(|error| panic!("{}: {error}", checked.scene.title));
            assert_eq!(words.left(), 0);
            let mut again = Words::new();
            run.save(&mut again);
            assert_eq!(again.all(), words.all(), "{}", checked.scene.title);
        }
    }
    said(&mut *run)
}

fn goes_on_to_the_same_bits(checked: &Checked, row: u64, last: u64, stops: &[u64]) {
    let whole = run(checked, row, last, &[]);
    let parted = run(checked, row, last, stops);
    assert_eq!(whole.1, parted.1, "{}", checked.scene.title);
    assert!(whole.0 == parted.0, "{}", checked.scene.title);
}

/// Every scene of the tests: laws, schemes, walls that go, bodies that turn, gates, water.
#[test]
fn every_good_scene_goes_on_to_the_same_bits() {
    for path in scene_files("tests/scenes/good") {
        let checked = Source::read(&path).and_then(|source| source.check());
        let checked = checked.unwrap_or_else(|error| panic!("{error}"));
        goes_on_to_the_same_bits(&checked, 97, 4000, &[1, 97, 500, 1234, 2000, 3333]);
    }
}

/// Short versions of the shipped scenes: coarse, and with the release or the water early.
#[test]
fn every_shipped_scene_goes_on_to_the_same_bits() {
    let short = |name: &str, changes: &[&str]| {
        let path = repository().join("scenarios").join(name);
        let mut source = Source::read(path).unwrap_or_else(|error| panic!("{error}"));
        for change in changes {
            source.set(change).unwrap_or_else(|error| panic!("{error}"));
        }
        source.check().unwrap_or_else(|error| panic!("{error}"))
    };
    let still = ["still.kinetic_energy=1e9", "still.for_at_least=5 ms"];
    let heap = short(
        "angle_of_repose.ron",
        &[&["grains.coarse=3"], &still[..]].concat(),
    );
    goes_on_to_the_same_bits(&heap, 211, 4000, &[150, 211, 1000, 2900]);
    for name in ["screw_feeder.ron", "screw_section.ron"] {
        let screw = short(name, &[&["grains.coarse=4"], &still[..]].concat());
        goes_on_to_the_same_bits(&screw, 211, 3000, &[150, 1000, 1055, 2000]);
    }
    let bed = short(
        "movable_bed.ron",
        &["water.begins=5 ms", "initial.bed.layers=5"],
    );
    goes_on_to_the_same_bits(&bed, 211, 8000, &[150, 1000, 2110, 5000]);
}

/// All that a run says of its grains: the series, every frame, the film, and the summary without what the clock says.
fn left(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = tree(folder);
    files.retain(|name, _| !name.starts_with("checkpoint") && !name.starts_with("figures"));
    let mut summary = summary(folder);
    for of_the_machine in [
        "wall_time",
        "grain_steps_per_second",
        "bytes_per_grain",
        "threads",
        "lanes",
    ] {
        summary[of_the_machine] = serde_json::Value::Null;
    }
    files.insert("summary.json".into(), summary.to_string().into_bytes());
    files
}

fn same(whole: &Path, resumed: &Path) {
    let (whole, resumed) = (left(whole), left(resumed));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&whole), names(&resumed));
    for (name, bytes) in &whole {
        assert!(resumed[name] == *bytes, "{name} differs");
    }
}

/// The folder has a checkpoint of a later step than 0.
fn has_gone_on(folder: &Path) -> bool {
    let entries = std::fs::read_dir(folder.join("checkpoint"));
    let steps = entries.into_iter().flatten().flatten().map(|entry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        let step = name
            .strip_prefix("step_")
            .and_then(|n| n.strip_suffix(".tsubu"));
        step.and_then(|step| step.parse::<u64>().ok())
    });
    steps.flatten().any(|step| step > 0)
}

/// Starts a run and waits until it has written a checkpoint on the way.
fn under_way(scratch: &Scratch, line: &str, folder: &str) -> Child {
    let mut child = start_in(scratch.path(), line);
    while !has_gone_on(&scratch.join(folder)) {
        let over = child.try_wait().unwrap_or_else(|error| panic!("{error}"));
        assert!(
            over.is_none(),
            "it ended by itself: {:#?}",
            Outcome::of(child)
        );
        std::thread::sleep(Duration::from_millis(2));
    }
    child
}

#[test]
fn a_run_that_was_killed_or_stopped_goes_on_as_if_nothing_had_been() {
    let scratch = Scratch::new("resume");
    let heap = good_scene("small_heap.ron");
    let run = |out: &str, more: &str| format!("run {heap} --out {out} --until 0.6~s {more}");
    run_in(scratch.path(), &run("whole", "--threads 1")).is_done();
    for (signal, out) in [
        ("KILL", "killed"),
        ("TERM", "stopped"),
        ("INT", "interrupted"),
    ] {
        let line = run(out, "--checkpoint-every 0 --threads 2");
        let child = under_way(&scratch, &line, out);
        kill(&child, signal);
        let outcome = Outcome::of(child);
        if signal == "KILL" {
            assert_eq!(outcome.code, -1);
        } else {
            assert_eq!(outcome.code, 130, "{outcome:#?}");
            outcome.says("go on with:  tsubu resume");
        }
        run_in(
            scratch.path(),
            &format!("resume {out} --threads 1 --lanes portable"),
        )
        .is_done();
        same(&scratch.join("whole"), &scratch.join(out));
    }
    // A run that is over goes on to a later end, as one that had it from the start.
    run_in(
        scratch.path(),
        &format!("run {heap} --out short --until 0.11~s"),
    )
    .is_done();
    run_in(scratch.path(), "resume short --until 0.6~s").is_done();
    let rows = |folder: &str| series(&scratch.join(folder)).1;
    assert_eq!(rows("short").last(), rows("whole").last());
    // And one that is over stays over.
    run_in(scratch.path(), "resume whole").is_done();
    assert_eq!(rows("whole").len(), frames(&scratch.join("whole")).len());
}

#[test]
fn two_runs_on_one_folder_are_refused() {
    let scratch = Scratch::new("locked");
    let heap = good_scene("small_heap.ron");
    let line = format!("run {heap} --out run --until 3600~s --checkpoint-every 0");
    let child = under_way(&scratch, &line, "run");
    for other in [
        "resume run".to_owned(),
        format!("run {heap} --out run --force"),
    ] {
        run_in(scratch.path(), &other)
            .is_one_message(2)
            .says("another run is writing into this folder");
    }
    kill(&child, "INT");
    assert_eq!(Outcome::of(child).code, 130);
}

#[test]
fn what_cannot_be_resumed_is_refused_in_words() {
    let scratch = Scratch::new("refused");
    let refused = |line: &str, code: i32, words: &str| {
        run_in(scratch.path(), line)
            .is_one_message(code)
            .says(words);
    };
    refused("resume nowhere", 2, "there is no such folder");
    std::fs::create_dir(scratch.join("folder")).unwrap_or_else(|error| panic!("{error}"));
    scratch.write("folder/file", "x");
    refused("resume folder", 2, "no run of tsubu wrote this folder");
    let smallest = good_scene("smallest.ron");
    let run = |line: &str| {
        run_in(scratch.path(), &format!("run {line}"))
            .is_done()
            .clone()
    };
    run(&format!("{smallest} --out none --checkpoint-every never"));
    refused("resume none", 2, "there is no checkpoint");
    // The newest is cut: the one before is taken. Both are: nothing is.
    run(&format!("{smallest} --out run"));
    let newest = |folder: &str| {
        let mut files: Vec<_> = std::fs::read_dir(scratch.join(folder).join("checkpoint"))
            .unwrap_or_else(|error| panic!("{error}"))
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|e| e == "tsubu"))
            .collect();
        files.sort();
        files.pop().unwrap_or_else(|| panic!("no checkpoint"))
    };
    let whole = left(&scratch.join("run"));
    std::fs::write(newest("run"), "tsubu checkpoint").unwrap_or_else(|error| panic!("{error}"));
    run_in(scratch.path(), "resume run")
        .is_done()
        .says("it is cut short")
        .says("the one before is taken");
    assert_eq!(left(&scratch.join("run")), whole);
    let all = std::fs::read_dir(scratch.join("run/checkpoint"));
    for entry in all.into_iter().flatten().flatten() {
        std::fs::write(entry.path(), "x").unwrap_or_else(|error| panic!("{error}"));
    }
    refused("resume run", 4, "no checkpoint is whole");
    // A file that the scene names has changed.
    let csv = std::fs::read_to_string(repository().join("tests/scenes/good/three_grains.csv"));
    let csv = csv.unwrap_or_else(|error| panic!("{error}"));
    scratch.write("grains.csv", &csv);
    let grains = good_scene("grain_file.ron");
    run(&format!(
        "{grains} --out file --set initial.file=grains.csv"
    ));
    scratch.write("grains.csv", &(csv + "\n"));
    refused("resume file", 2, "grains.csv has changed since");
    // A series that is not the one of the checkpoint, and frames that are gone.
    run(&format!("{smallest} --out rows"));
    std::fs::write(scratch.join("rows/series.csv"), "time\n0\n").unwrap_or_else(|e| panic!("{e}"));
    refused("resume rows", 2, "series.csv");
    run(&format!("{smallest} --out frames"));
    std::fs::remove_file(scratch.join("frames/frames.pvd")).unwrap_or_else(|e| panic!("{e}"));
    refused("resume frames", 4, "frames.pvd");
}
