//! What the command says and leaves behind when all is well.

use serde_json::Value;
use std::path::Path;
use tsubu_tests::{Scratch, good_scene, repository, run_in, start_in, tree};

const NUMBERS: [&str; 11] = [
    "angle_of_repose",
    "energy_budget_error",
    "packing_fraction",
    "time",
    "released_at",
    "steps",
    "grains",
    "grain_steps_per_second",
    "bytes_per_grain",
    "threads",
    "wall_time",
];

/// `summary.json`, read by another reader than the one that wrote it.
pub fn summary(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("summary.json"))
        .unwrap_or_else(|error| panic!("{error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The columns and rows of `series.csv`; every row has a number in every column.
pub fn series(folder: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = std::fs::read_to_string(folder.join("series.csv"))
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(text.ends_with('\n'), "the last row is cut short");
    let mut lines = text.lines();
    let header: Vec<String> = lines
        .next()
        .unwrap_or_default()
        .split(',')
        .map(String::from)
        .collect();
    let numbers = |line: &str| {
        line.split(',')
            .map(|cell| {
                cell.parse()
                    .unwrap_or_else(|_| panic!("“{cell}” in {line}"))
            })
            .collect::<Vec<f64>>()
    };
    let rows: Vec<Vec<f64>> = lines.map(numbers).collect();
    assert!(
        rows.iter().all(|row| row.len() == header.len()),
        "rows of unequal length"
    );
    (header, rows)
}

/// The frames that `frames.pvd` names; each is there and whole, and no other is.
pub fn frames(folder: &Path) -> Vec<Vec<u8>> {
    let list = std::fs::read_to_string(folder.join("frames.pvd"))
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(
        list.starts_with("<?xml") && list.trim_end().ends_with("</VTKFile>"),
        "{list}"
    );
    let names: Vec<&str> = list
        .split("file=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    let there = tree(&folder.join("frames"));
    assert_eq!(
        names
            .iter()
            .map(|name| name.trim_start_matches("frames/"))
            .collect::<Vec<_>>(),
        there.keys().collect::<Vec<_>>()
    );
    let read = |name: &&str| {
        std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    let all: Vec<Vec<u8>> = names.iter().map(read).collect();
    assert!(all.iter().all(
        |bytes| bytes.starts_with(b"<?xml") && bytes.trim_ascii_end().ends_with(b"</VTKFile>")
    ));
    all
}

#[test]
fn run_leaves_all_that_the_contract_names() {
    let scratch = Scratch::new("leaves");
    let outcome = run_in(
        scratch.path(),
        &format!("run {} --out heap", good_scene("small_heap.ron")),
    );
    outcome.is_done();
    let folder = scratch.join("heap");
    let summary = summary(&folder);
    for name in NUMBERS {
        let entry = &summary[name];
        assert!(
            entry["value"].is_f64() && entry["unit"].is_string(),
            "{name}: {entry}"
        );
        assert!(
            entry["uncertainty"].is_null() || entry["uncertainty"].is_f64(),
            "{name}: {entry}"
        );
    }
    assert_eq!(summary["angle_of_repose"]["unit"], "deg");
    assert_eq!(summary["ended"], "over");
    let (header, rows) = series(&folder);
    // Rows each 20 ms from the start to the end, the first and the last moment among them.
    let end = summary["time"]["value"].as_f64().unwrap_or(f64::NAN);
    assert!(
        header[0] == "time"
            && rows[0][0] == 0.0
            && rows
                .last()
                .is_some_and(|row| (row[0] / end - 1.0).abs() < 1e-15)
    );
    assert!(
        rows.windows(2).all(|two| two[0][0] < two[1][0]),
        "time does not grow"
    );
    assert_eq!(
        header.len(),
        summary["series_units"]
            .as_object()
            .map_or(0, |units| units.len())
    );
    assert_eq!(frames(&folder).len(), rows.len());
    let files = tree(&folder);
    let begins = |name: &str, magic: &[u8]| {
        files
            .get(name)
            .is_some_and(|bytes| bytes.starts_with(magic))
    };
    assert!(
        begins("animation.gif", b"GIF89a") && files["animation.gif"].ends_with(b";"),
        "{:?}",
        files.keys()
    );
    for figure in ["profile", "angle", "energies", "coordination"] {
        assert!(
            begins(&format!("figures/{figure}.svg"), b"<")
                && begins(&format!("figures/{figure}.png"), b"\x89PNG"),
            "{figure}"
        );
    }
    assert!(
        !files.keys().any(|name| name.ends_with("part")),
        "{:?}",
        files.keys()
    );
    // The closing words: the result, the time it took, where the pictures are, what to do next.
    for words in [
        "Angle of repose",
        "grain-steps/s",
        "animation.gif",
        "figures/",
        "Next, try:  tsubu run",
    ] {
        assert!(outcome.stdout.contains(words), "{words}: {outcome:#?}");
    }

    // What it left runs to the same numbers: the resolved scene is the scene.
    run_in(scratch.path(), "run heap/scene.resolved.ron --out again").is_done();
    let again = tree(&scratch.join("again"));
    for name in ["series.csv", "scene.resolved.ron", "frames.pvd"] {
        assert!(
            files[name] == again[name],
            "{name} of the resolved scene differs"
        );
    }
}

#[test]
fn run_without_out_numbers_its_folders() {
    let scratch = Scratch::new("numbered");
    let line = format!(
        "run {} --until 0.1~ms --set output.animation=false",
        good_scene("smallest.ron")
    );
    for name in ["out/smallest", "out/smallest-2", "out/smallest-3"] {
        let outcome = run_in(scratch.path(), &line);
        outcome.is_done();
        assert!(
            outcome.stdout.contains(name),
            "the folder is not named: {outcome:#?}"
        );
        assert!(scratch.join(name).join("summary.json").exists());
    }
}

#[test]
fn an_existing_run_is_refused_untouched_and_replaced_only_by_force() {
    let scratch = Scratch::new("existing");
    let line = |more: &str| {
        format!(
            "run {} --out here --set output.animation=false {more}",
            good_scene("smallest.ron")
        )
    };
    run_in(scratch.path(), &line("--until 0.2~ms")).is_done();
    std::fs::write(scratch.join("here/notes.txt"), "mine")
        .unwrap_or_else(|error| panic!("{error}"));
    let before = tree(&scratch.join("here"));
    run_in(scratch.path(), &line("--until 0.1~ms"))
        .is_one_message(2)
        .says("already holds a run")
        .says("--force");
    assert!(
        tree(&scratch.join("here")) == before,
        "a refused run changed the folder"
    );
    run_in(scratch.path(), &line("--until 0.1~ms --force")).is_done();
    let after = tree(&scratch.join("here"));
    assert_eq!(
        after["notes.txt"], b"mine",
        "--force removes what a run wrote and nothing else"
    );
    assert_ne!(after["series.csv"], before["series.csv"]);
    let end = summary(&scratch.join("here"))["time"]["value"].as_f64();
    assert!(end.is_some_and(|end| (end - 1e-4).abs() < 1e-6), "{end:?}");
}

#[test]
fn a_folder_of_others_is_refused_even_with_force() {
    let scratch = Scratch::new("others");
    std::fs::create_dir(scratch.join("thesis")).unwrap_or_else(|error| panic!("{error}"));
    scratch.write("thesis/summary.json", "{}");
    run_in(
        scratch.path(),
        &format!("run {} --out thesis --force", good_scene("smallest.ron")),
    )
    .is_one_message(2)
    .says("thesis");
    assert_eq!(
        tree(&scratch.join("thesis"))
            .into_iter()
            .collect::<Vec<_>>(),
        [("summary.json".to_owned(), b"{}".to_vec())]
    );
}

#[test]
fn check_says_what_is_modelled_and_writes_nothing() {
    let scratch = Scratch::new("check");
    let outcome = run_in(
        scratch.path(),
        &format!("check {}", good_scene("small_heap.ron")),
    );
    outcome.is_done();
    for words in [
        "Modelled",
        "Not modelled",
        "static friction",
        "bytes each",
        "% of the limit for a pair of grains",
        "grain-steps/s",
    ] {
        assert!(outcome.stdout.contains(words), "{words}: {outcome:#?}");
    }
    // Over the limit, the limits are shown all the same, and the exit code says that it would not run.
    let over = run_in(
        scratch.path(),
        &format!(
            "check {} --set time.step=PerPeriod(4)",
            good_scene("small_heap.ron")
        ),
    );
    over.is_one_message(2).says("is over its limit");
    assert!(over.stdout.contains("% of the limit for"), "{over:#?}");
    assert!(tree(scratch.path()).is_empty());
}

#[test]
fn a_reader_that_goes_away_is_no_reason_to_panic() {
    let scratch = Scratch::new("closed_pipe");
    let mut child = start_in(
        scratch.path(),
        &format!("check {}", good_scene("small_heap.ron")),
    );
    drop(child.stdout.take());
    let outcome = child
        .wait_with_output()
        .unwrap_or_else(|error| panic!("{error}"));
    let words = String::from_utf8_lossy(&outcome.stderr);
    assert!(outcome.status.success() && words.is_empty(), "{words}");
}

#[test]
fn scenes_and_init_hand_out_scenes_that_run() {
    let scratch = Scratch::new("init");
    let listed = run_in(scratch.path(), "scenes");
    let listed = listed
        .is_done()
        .stdout
        .lines()
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next())
        .collect::<Vec<_>>();
    assert!(listed.contains(&"angle_of_repose"), "{listed:?}");
    for name in listed {
        run_in(scratch.path(), &format!("init {name}")).is_done();
        let copy = tree(scratch.path())[&format!("{name}.ron")].clone();
        assert!(
            std::fs::read(repository().join(format!("scenarios/{name}.ron")))
                .is_ok_and(|shipped| shipped == copy)
        );
        run_in(scratch.path(), &format!("init {name}"))
            .is_one_message(2)
            .says("already here");
        assert!(tree(scratch.path())[&format!("{name}.ron")] == copy);
    }
    let before = tree(scratch.path());
    run_in(scratch.path(), "init angle_of_reprose")
        .is_one_message(2)
        .says("angle_of_repose");
    run_in(scratch.path(), "init ../angle_of_repose").is_one_message(2);
    assert!(tree(scratch.path()) == before);
}

#[test]
fn arguments_that_make_no_sense_are_refused_before_anything_happens() {
    let scratch = Scratch::new("arguments");
    let scene = good_scene("smallest.ron");
    for (arguments, words) in [
        ("--threads 0", "--threads"),
        ("--threads two", "--threads"),
        ("--lanes avx1024", "expected auto, portable, avx2 or avx512"),
        ("--treads 2", "--threads"),
        ("--set", "--set"),
    ] {
        run_in(scratch.path(), &format!("run {scene} {arguments}"))
            .is_one_message(2)
            .says(words);
    }
    run_in(scratch.path(), "runn").is_one_message(2).says("run");
    run_in(scratch.path(), "run").is_one_message(2);
    assert!(tree(scratch.path()).is_empty());
    let help = run_in(scratch.path(), "--help");
    assert!(help.is_done().stdout.contains("tsubu run"), "{help:#?}");
    assert!(help.stdout.contains("Exit codes"), "{help:#?}");
    let bare = run_in(scratch.path(), "");
    assert!(
        bare.code == 2 && bare.stderr.contains("tsubu run"),
        "{bare:#?}"
    );
}
