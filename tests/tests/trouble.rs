//! Folders that cannot be written, disks that fill up, signals, physics that fails: the code, one message, whole files.

use crate::command::{frames, series, summary};
use std::process::{Command, Stdio};
use tsubu_tests::{Outcome, Scratch, good_scene, kill, run_in, start_in, tree, tsubu};

#[test]
fn a_folder_that_cannot_be_made_is_refused() {
    let scratch = Scratch::new("impossible");
    scratch.write("file", "x");
    let run = |out: &str| {
        run_in(
            scratch.path(),
            &format!("run {} --out {out}", good_scene("smallest.ron")),
        )
    };
    run("file").is_one_message(2).says("is not a folder");
    run("file/below")
        .is_one_message(2)
        .says("is a file, not a folder");
    run("no/such/parent")
        .is_one_message(2)
        .says("does not exist");
    assert_eq!(tree(scratch.path()).keys().collect::<Vec<_>>(), ["file"]);
    // The folder of numbered runs is a file.
    scratch.write("out", "x");
    run_in(
        scratch.path(),
        &format!("run {}", good_scene("smallest.ron")),
    )
    .is_one_message(2);
}

/// Even the superuser cannot make a folder there.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_the_machine_refuses_is_the_machines_fault() {
    let scratch = Scratch::new("refused");
    if std::path::Path::new("/sys/kernel").is_dir() {
        run_in(
            scratch.path(),
            &format!("run {} --out /sys/kernel/tsubu", good_scene("smallest.ron")),
        )
        .is_one_message(4)
        .says("/sys/kernel/tsubu");
    }
    assert!(tree(scratch.path()).is_empty());
}

/// A limit on the size of files fails a write in the middle, as a full disk does: the shell sets it and has the
/// signal that comes with it ignored.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_up_ends_with_one_message_and_whole_files() {
    let scratch = Scratch::new("full");
    // Blocks of 512 bytes or of 1 KiB, as the shell has it; either way this file is the first that is too long.
    for (blocks, changes, first) in [
        (
            6,
            &[
                "output.frames=false",
                "output.animation=false",
                "output.every=0.2 ms",
            ][..],
            "series.csv",
        ),
        (6, &["output.animation=false"], "frame_000000.vtp"),
        (
            16,
            &["output.frames=false", "output.every=0.1 s"],
            "animation.gif",
        ),
        (
            8,
            &[
                "output.frames=false",
                "output.animation=false",
                "output.every=0.1 s",
            ],
            "figures",
        ),
    ] {
        let mut shell = Command::new("sh");
        shell
            .args([
                "-c",
                &format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\""),
                "sh",
            ])
            .arg(tsubu());
        shell.args(["run", &good_scene("small_heap.ron"), "--out", first]);
        shell.args(changes.iter().flat_map(|change| ["--set", change]));
        // Checkpoints would be the first file that is too long.
        shell.args(["--checkpoint-every", "never"]);
        shell
            .current_dir(scratch.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let outcome = Outcome::of(shell.spawn().unwrap_or_else(|error| panic!("{error}")));
        outcome
            .is_one_message(4)
            .says(&format!(" {first}/"))
            .says("(os error ");
        let folder = scratch.join(first);
        series(&folder);
        let left = tree(&folder);
        if left.contains_key("frames.pvd") {
            frames(&folder);
        }
        assert!(
            !left.keys().any(|name| name.ends_with("tsubu-part")),
            "{:?}",
            left.keys()
        );
        // A run that did not end has no result; one whose pictures alone fail keeps its numbers.
        let pictures_alone = ["animation.gif", "figures"].contains(&first);
        assert_eq!(left.contains_key("summary.json"), pictures_alone, "{first}");
        // Nothing else is cut short: pictures are whole or absent, as are frames.
        for (name, end) in [
            (".gif", &b";"[..]),
            (".svg", b"</svg>"),
            (".png", b"IEND\xaeB`\x82"),
            (".vtp", b"</VTKFile>"),
        ] {
            let cut = left.iter().find(|(file, bytes)| {
                file.ends_with(name) && !bytes.trim_ascii_end().ends_with(end)
            });
            assert!(
                cut.is_none(),
                "{first} fails, and {:?} is left cut short",
                cut.map(|(file, _)| file)
            );
        }
    }
}

#[test]
fn a_signal_ends_the_run_in_order() {
    for signal in ["INT", "TERM"] {
        let scratch = Scratch::new("signal");
        // An hour of grains: only the signal ends it. Rows far apart, as most of the time passes between two then,
        // and the signal comes there.
        let line = format!(
            "run {} --out run --set still.kinetic_energy=1e9 --set still.for_at_least=0~s --until 3600~s --set output.every=1~s",
            good_scene("small_heap.ron")
        );
        let mut child = start_in(scratch.path(), &line);
        // The second frame is written after the second row: from then on it steps.
        while std::fs::read_to_string(scratch.join("run/frames.pvd"))
            .map_or(0, |text| text.matches("<DataSet").count())
            < 2
        {
            let over = child.try_wait().unwrap_or_else(|error| panic!("{error}"));
            assert!(
                over.is_none(),
                "it ended by itself: {:#?}",
                Outcome::of(child)
            );
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        kill(&child, signal);
        let outcome = Outcome::of(child);
        assert!(
            outcome.code == 130
                && outcome.stderr.contains("stopped by a signal")
                && !outcome.stderr.contains("error"),
            "{outcome:#?}"
        );
        let folder = scratch.join("run");
        let (_, rows) = series(&folder);
        assert!(rows.len() >= 2);
        assert_eq!(
            frames(&folder).len(),
            rows.len(),
            "the last moment has a row and a frame"
        );
        let summary = summary(&folder);
        assert_eq!(summary["ended"], "stopped by a signal");
        let end = summary["time"]["value"].as_f64().unwrap_or(f64::NAN);
        // The reader of the summary rounds the last digit its own way.
        assert!(
            rows.last()
                .is_some_and(|row| (row[0] / end - 1.0).abs() < 1e-15),
            "the last row is the moment of the signal"
        );
        let animation = tree(&folder)["animation.gif"].clone();
        assert!(animation.starts_with(b"GIF89a") && animation.ends_with(b";"));
    }
}

/// Two grains pressed together by their speed, without damping, under the scheme that is never stable then: each
/// collision multiplies the energy, and the periodic line brings the next one.
const BLOWS_UP: &str = r#"(
    title: "Explicit Euler fails",
    gravity: "0 m/s2",
    grains: (
        diameter: "1 mm", density: "2500 kg/m3",
        law: Repulsion(stiffness: YoungModulus("10 MPa"), damping: Equal("0 kg/s")),
    ),
    domain: (x: Periodic("3 mm")),
    initial: (grains: [
        (at: ("1 mm", "0 mm", "0 mm"), velocity: ("0.5 m/s", "0 m/s", "0 m/s")),
        (at: ("2.1 mm", "0 mm", "0 mm")),
    ]),
    time: (step: PerPeriod(12), integrator: ExplicitEuler, steps: 1000000),
    output: (animation: false),
)"#;

#[test]
fn physics_that_fails_names_grain_place_time_and_remedy() {
    let scratch = Scratch::new("unstable");
    scratch.write("blows_up.ron", BLOWS_UP);
    run_in(scratch.path(), "run blows_up.ron --out refused")
        .is_one_message(2)
        .says("no stable step")
        .says("--allow-unstable");
    assert!(!scratch.join("refused").exists());
    let outcome = run_in(
        scratch.path(),
        "run blows_up.ron --allow-unstable --out run",
    );
    outcome
        .is_one_message(3)
        .says("grain ")
        .says(" at t = ")
        .says(" m")
        .says("help: ")
        .says("step");
    // What was computed until then is whole, and says how it ended.
    let (_, rows) = series(&scratch.join("run"));
    assert!(!rows.is_empty() && !frames(&scratch.join("run")).is_empty());
    assert_eq!(summary(&scratch.join("run"))["ended"], "trouble");
}

#[test]
fn grains_that_are_never_still_are_a_failure_of_the_scene_in_words() {
    let scratch = Scratch::new("never");
    let line = format!(
        "run {} --out run --set still.at_most=50~ms --set still.kinetic_energy=1e-12",
        good_scene("small_heap.ron")
    );
    run_in(scratch.path(), &line)
        .is_one_message(3)
        .says("were not still")
        .says("still.at_most");
    assert_eq!(summary(&scratch.join("run"))["ended"], "never still");
}

/// Runs a scene that fails and looks at what it says and keeps: the last checkpoint, and the state just before.
fn fails_with(name: &str, text: &str, words: &[&str]) {
    let scratch = Scratch::new(name);
    scratch.write("scene.ron", text);
    let outcome = run_in(scratch.path(), "run scene.ron --allow-unstable --out run");
    outcome.is_one_message(3).says(" at t = ").says("help: ");
    for word in words {
        outcome.says(word);
    }
    outcome
        .says("before_trouble.vtp")
        .says("the last checkpoint is run/checkpoint/step_000000000000000.tsubu");
    let folder = scratch.join("run");
    assert_eq!(summary(&folder)["ended"], "trouble");
    let left = tree(&folder);
    assert!(left.contains_key("checkpoint/before_trouble.tsubu"));
    // The frame before is sound: ParaView draws no grain whose place is not a number.
    let frame = folder.join("checkpoint/before_trouble.vtp");
    let points = tsubu::record::read_array(&frame, "Points").unwrap_or_default();
    assert!(
        !points.is_empty() && points.iter().all(|x| x.is_finite()),
        "{points:?}"
    );
    assert_eq!(summary(&folder)["grains_lost"]["value"], 0.0);
    // From the last checkpoint it fails in the same way.
    let again = run_in(scratch.path(), "resume run");
    again.is_one_message(3).says(words[0]);
}

/// Explicit Euler gives energy with each collision and damping takes none: it is noticed before a grain runs away.
#[test]
fn energy_from_nowhere_stops_a_run() {
    let slow = BLOWS_UP.replace("PerPeriod(12)", "PerPeriod(200)");
    fails_with(
        "energy",
        &slow,
        &["energy grows from nowhere", "the fastest is grain "],
    );
}

#[test]
fn a_grain_that_runs_away_stops_a_run() {
    fails_with("runaway", BLOWS_UP, &["grain "]);
}

/// Far too soft for their speed: the grains go deep into each other.
#[test]
fn a_deep_overlap_stops_a_run() {
    let soft = BLOWS_UP
        .replace("10 MPa", "100 Pa")
        .replace("Equal(\"0 kg/s\")", "Equal(\"1e-9 kg/s\")")
        .replace("ExplicitEuler", "SymplecticEuler")
        .replace("PerPeriod(12)", "PerPeriod(2000)");
    fails_with("deep", &soft, &["overlap by ", "soften"]);
}
