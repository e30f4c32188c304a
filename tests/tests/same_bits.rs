//! Threads, vector paths, outputs and batches of steps change no bit of a result.

use std::collections::BTreeMap;
use std::path::Path;
use tsubu::assemble::{Choices, build};
use tsubu::engine::Lanes;
use tsubu_tests::{Bits, Scratch, bits, check, run_in, tree};

/// A block of grains falls on a rough floor between two walls; one goes on the way. 6 000 grains are twelve chunks,
/// so that three threads have work; they fall by several skins, so that lists are built anew; energies are tallied.
const SPACE: &str = r#"(
    title: "Six thousand grains and a wall that goes",
    gravity: "9.80665 m/s2",
    grains: (
        diameter: "5 mm", density: "2650 kg/m3",
        law: Repulsion(stiffness: YoungModulus("1 MPa"), damping: Equal("0.2 kg/s")),
    ),
    domain: (y: Periodic("60 mm")),
    walls: [
        (name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.4),
        (name: "left", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (1, 0, 0)), restitution: 0.7, friction: 0.2),
        (name: "right", shape: HalfSpace(point: ("150 mm", "0 mm", "0 mm"), outward: (-1, 0, 0)), removed: At("20 ms")),
    ],
    initial: (fill: (region: (min: ("0 mm", "0 mm", "0 mm"), max: ("150 mm", "60 mm", "145 mm")), solid_fraction: 0.30, seed: 3)),
    time: (step: PerPeriod(20), until: "50 ms"),
    output: (every: "10 ms", energies: true),
)"#;

/// The same in the vertical plane, with the law that damps direction by direction and the scheme that solves.
const PLANE: &str = r#"(
    title: "Six thousand grains in the plane",
    space: Plane,
    gravity: "9.80665 m/s2",
    grains: (
        diameter: "5 mm", density: "2650 kg/m3",
        law: Repulsion(stiffness: YoungModulus("1 MPa"), damping: Parts(normal: "0.2 kg/s", tangential: "0.1 kg/s")),
    ),
    walls: [
        (name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.4),
        (name: "left", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (1, 0, 0)), restitution: 0.7, friction: 0.2),
        (name: "right", shape: HalfSpace(point: ("500 mm", "0 mm", "0 mm"), outward: (-1, 0, 0)), removed: At("20 ms")),
    ],
    initial: (fill: (region: (min: ("0 mm", "0 mm", "0 mm"), max: ("500 mm", "0 mm", "550 mm")), solid_fraction: 0.44, seed: 3)),
    time: (step: PerPeriod(20), integrator: VerletAveraged(sweeps: 4), until: "50 ms"),
    output: (every: "10 ms", energies: true),
)"#;

/// What must be equal: the series, and the last frame if frames are asked for.
fn left(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = tree(folder);
    let last = files
        .keys()
        .rfind(|name| name.starts_with("frames/") && name.ends_with(".vtp"))
        .cloned();
    files.retain(|name, _| name == "series.csv" || Some(name) == last.as_ref());
    files
}

fn machine_changes_nothing(name: &str, text: &str) {
    let scratch = Scratch::new(name);
    scratch.write("scene.ron", text);
    let grains = check(text, &[]).scene.initial;
    let tsubu::scene::Initial::Fill(fill) = grains else {
        panic!("a fill")
    };
    assert!(fill.count(5e-3, check(text, &[]).scene.space) >= 5000);
    let run = |arguments: &str| {
        let folder = arguments.replace([' ', '-'], "");
        run_in(
            scratch.path(),
            &format!("run scene.ron --set output.animation=false {arguments} --out {folder}"),
        )
        .is_done();
        left(&scratch.join(&folder))
    };
    let first = run("--threads 1 --lanes portable");
    assert_eq!(first.len(), 2, "{:?}", first.keys());
    let mut others = vec![
        "--threads 2".to_owned(),
        "--threads 3 --lanes portable".to_owned(),
        "--threads 3".to_owned(),
    ];
    others.extend(
        Lanes::ALL
            .into_iter()
            .filter(|lanes| lanes.is_here())
            .map(|lanes| format!("--threads 1 --lanes {}", lanes.name()))
            .skip(1),
    );
    for other in others {
        assert!(
            run(&other) == first,
            "{other} gives other bits than one thread on the portable path"
        );
    }
    // Without frames the series is the same; the frames of the run before are not there to differ.
    assert!(
        run("--set output.frames=false")["series.csv"] == first["series.csv"],
        "frames change the numbers"
    );
}

#[test]
fn threads_and_vector_paths_in_space() {
    machine_changes_nothing("bits-space", SPACE);
}

#[test]
fn threads_and_vector_paths_in_the_plane() {
    machine_changes_nothing("bits-plane", PLANE);
}

#[test]
fn an_animation_and_more_rows_change_no_number() {
    let scratch = Scratch::new("bits-output");
    scratch.write("scene.ron", SPACE);
    let run = |name: &str, arguments: &str| {
        run_in(
            scratch.path(),
            &format!("run scene.ron --until 30~ms --out {name} {arguments}"),
        )
        .is_done();
        left(&scratch.join(name))
    };
    let few = run("few", "--set output.animation=false");
    let many = run(
        "many",
        "--set output.every=5~ms --set output.frames_every=10~ms",
    );
    let rows = |files: &BTreeMap<String, Vec<u8>>| {
        String::from_utf8_lossy(&files["series.csv"])
            .lines()
            .map(String::from)
            .collect::<Vec<_>>()
    };
    let (few_rows, many_rows) = (rows(&few), rows(&many));
    assert!(many_rows.len() > few_rows.len() + 1);
    // The two cadences are rounded to steps each by itself, so the first and the last moment are the common ones.
    assert_eq!(few_rows[..2], many_rows[..2]);
    assert_eq!(few_rows.last(), many_rows.last());
    let frame = |files: &BTreeMap<String, Vec<u8>>| {
        files
            .iter()
            .find(|(name, _)| name.ends_with(".vtp"))
            .map(|(_, bytes)| bytes.clone())
    };
    assert!(frame(&few) == frame(&many), "the last frames differ");
}

/// In full precision, which frames do not have: threads, paths, and how many steps are asked for at once.
#[test]
fn the_state_in_full_precision() {
    for text in [SPACE, PLANE] {
        let checked = check(text, &["time.until=25 ms"]);
        let state = |threads: usize, lanes: Lanes, batch: u64, look: bool| -> Bits {
            let choices = Choices {
                threads: Some(threads),
                lanes: Some(lanes),
                ..Choices::default()
            };
            let mut run = build(&checked, &choices)
                .unwrap_or_else(|error| panic!("{error}"))
                .simulation;
            while !run.is_over() {
                run.advance(batch);
                if look {
                    run.look();
                }
            }
            bits(&*run)
        };
        let first = state(1, Lanes::Portable, u64::MAX, false);
        assert!(
            first == state(2, Lanes::best(), 64, false),
            "two threads and batches of 64"
        );
        assert!(
            first == state(3, Lanes::best(), 37, true),
            "three threads, batches of 37 and looks between them"
        );
    }
}
