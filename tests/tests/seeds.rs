//! Several seeds in one command: whole runs beside each other, their means, and what is refused.

use crate::command::{series, summary};
use serde_json::Value;
use tsubu_tests::{Outcome, Scratch, good_scene, kill, run_in, start_in, tree};

/// A small bed that has fallen before the water comes; rows enough for an error of each run.
const BED: &str = r#"(
    title: "A small bed",
    space: Plane,
    grains: (
        diameter: "0.5 mm", density: "2650 kg/m3",
        law: SpringDashpot(constants: FromTimeStep(step: "20 us", tn: 20, cn: 0.3), friction: 0.577),
    ),
    domain: (x: Periodic("10.7 mm")),
    initial: (bed: (layers: 3)),
    water: (shields: 0.5, begins: "60 ms"),
    time: (step: Exactly("5 us"), until: "0.12 s"),
    output: (every: "1 ms", frames: false, animation: false),
)"#;

fn number(summary: &Value, name: &str, of: &str) -> f64 {
    summary[name][of].as_f64().unwrap_or(f64::NAN)
}

#[test]
fn each_seed_leaves_its_run_and_all_leave_the_mean() {
    let scratch = Scratch::new("seeds");
    scratch.write("bed.ron", BED);
    let outcome = run_in(scratch.path(), "run bed.ron --seeds 2,5 --threads 2");
    outcome.is_done();
    let out = scratch.join("out/bed");
    // Each is what a run with this seed leaves, to the bit.
    let seed = "--set initial.bed.seed=5 --set water.turbulence=Switched(seed:~5)";
    run_in(scratch.path(), &format!("run bed.ron --out alone {seed}")).is_done();
    let files = tree(&out);
    for (name, bytes) in tree(&scratch.join("alone")) {
        let other = files.get(&format!("seed-5/{name}"));
        assert!(other.is_some(), "seed-5 lacks {name}");
        if ["series.csv", "scene.resolved.ron"].contains(&&*name) {
            assert!(other == Some(&bytes), "{name} differs");
        }
    }
    let [two, five, mean] = ["seed-2", "seed-5", ""].map(|name| summary(&out.join(name)));
    assert_ne!(
        series(&out.join("seed-2")).1.last(),
        series(&out.join("seed-5")).1.last()
    );
    for name in ["transport", "bed_height", "time", "grains"] {
        let expected = 0.5 * (number(&two, name, "value") + number(&five, name, "value"));
        let got = number(&mean, name, "value");
        assert!((got - expected).abs() <= 1e-12 * expected, "{name}: {got}");
        assert_eq!(mean[name]["unit"], two[name]["unit"]);
    }
    // Of two runs the scatter's standard error is half their difference; their own errors add in squares, halved.
    let [a, b] = [&two, &five].map(|run| number(run, "transport", "value"));
    let own = [&two, &five].map(|run| number(run, "transport", "uncertainty"));
    let expected = (0.5 * (a - b).abs()).max(0.5 * own[0].hypot(own[1]));
    let got = number(&mean, "transport", "uncertainty");
    assert!((got / expected - 1.0).abs() < 1e-9, "{got} {expected}");
    assert_eq!(mean["ended"], "over");
    assert_eq!(mean["runs"]["seed-2"], "over");
    assert!(mean["runs"].as_object().is_some_and(|runs| runs.len() == 2));
    for figure in ["seeds", "transport"] {
        assert!(files.contains_key(&format!("figures/{figure}.svg")));
    }
    for words in [
        "Mean of 2 seeds: Transport qB*",
        " ± ",
        "Meyer-Peter",
        "out/bed\n",
    ] {
        assert!(outcome.stdout.contains(words), "{words}: {outcome:#?}");
    }
    assert!(outcome.stderr.contains("seed 2: Transport"), "{outcome:#?}");

    // One after the other on one thread: the same runs. The folder is refused first, then replaced with all it held.
    let again = "run bed.ron --seeds 5..5 --threads 1 --out out/bed";
    run_in(scratch.path(), again)
        .is_one_message(2)
        .says("--force");
    run_in(scratch.path(), &format!("{again} --force")).is_done();
    let replaced = tree(&out);
    assert!(replaced["seed-5/series.csv"] == files["seed-5/series.csv"]);
    assert!(!replaced.contains_key("seed-2/"));
    // One run has no scatter: its own error stays.
    assert_eq!(number(&summary(&out), "transport", "uncertainty"), own[1]);
}

#[test]
fn seeds_that_make_no_sense_are_refused_and_leave_nothing() {
    let scratch = Scratch::new("no-seeds");
    scratch.write("bed.ron", BED);
    for (seeds, words) in [
        ("0", "write how many"),
        ("2,3,2", "write each once"),
        ("many", "as 4"),
        ("9..3", "upwards"),
        ("100000", "more than 1000"),
    ] {
        run_in(scratch.path(), &format!("run bed.ron --seeds {seeds}"))
            .is_one_message(2)
            .says("--seeds")
            .says(words);
    }
    run_in(
        scratch.path(),
        &format!("run {} --seeds 2", good_scene("smallest.ron")),
    )
    .is_one_message(2)
    .says("nothing in this scene is random")
    .says("leave out --seeds");
    run_in(
        scratch.path(),
        "run bed.ron --seeds 2 --set water.shields=-1",
    )
    .is_one_message(2);
    assert_eq!(tree(scratch.path()).keys().collect::<Vec<_>>(), ["bed.ron"]);
}

/// Water that comes before the bed has fallen: every seed fails, each says so, and there is no mean.
#[test]
fn seeds_whose_physics_fails_say_which() {
    let scratch = Scratch::new("failing-seeds");
    scratch.write("bed.ron", BED);
    let outcome = run_in(
        scratch.path(),
        "run bed.ron --seeds 2 --out bed --set water.begins=0.1~ms",
    );
    outcome
        .is_one_message(3)
        .says("error: seed 1: the water found no bed")
        .says("seed 2: failed")
        .says("0 of 2 runs");
    let mean = summary(&scratch.join("bed"));
    assert_eq!(mean["ended"], "trouble");
    assert_eq!(mean["runs"]["seed-2"], "failed");
    assert!(mean.get("transport").is_none());
    assert_eq!(summary(&scratch.join("bed/seed-2"))["ended"], "no bed");
}

#[test]
fn a_signal_ends_the_runs_in_order_and_starts_no_other() {
    let scratch = Scratch::new("seeds-signal");
    scratch.write("bed.ron", BED);
    let line = "run bed.ron --seeds 3 --threads 1 --out bed --until 3600~s";
    let mut child = start_in(scratch.path(), line);
    // The second row of the first seed: from then on it steps.
    let rows = scratch.join("bed/seed-1/series.csv");
    while std::fs::read_to_string(&rows).map_or(0, |text| text.lines().count()) < 3 {
        let over = child.try_wait().unwrap_or_else(|error| panic!("{error}"));
        assert!(over.is_none(), "it ended: {:#?}", Outcome::of(child));
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    kill(&child, "INT");
    let outcome = Outcome::of(child);
    assert_eq!(outcome.code, 130, "{outcome:#?}");
    outcome.says("stopped by a signal; 0 of 3 runs");
    let mean = summary(&scratch.join("bed"));
    assert_eq!(mean["runs"]["seed-1"], "stopped by a signal");
    assert_eq!(mean["runs"]["seed-2"], "not started");
    assert_eq!(
        summary(&scratch.join("bed/seed-1"))["ended"],
        "stopped by a signal"
    );
    assert!(!scratch.join("bed/seed-2").exists());
}
