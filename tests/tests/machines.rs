//! Machines: meshes that a user may bring, bodies that move, grains that come and go.

use glam::DVec3;
use std::path::Path;
use tsubu::assemble::{Choices, Stop, build};
use tsubu::engine::Lanes;
use tsubu::model::Surface;
use tsubu::scene::Source;
use tsubu::sdf::mesh::{Mesh, write_stl};
use tsubu::sdf::{Ball, Cuboid};
use tsubu_tests::{Scratch, bits, run_in, run_out};

fn mesh_of(surface: &dyn Surface<tsubu::model::Space>) -> Mesh {
    let shell = surface.shell().expect("this shape is drawn with triangles");
    Mesh::from(shell)
}

/// A block of 40 × 20 × 30 mm, in the millimetres of its file.
fn block() -> Mesh {
    let cuboid = Cuboid::new(
        DVec3::new(-20.0, -10.0, -15.0),
        DVec3::new(20.0, 10.0, 15.0),
    );
    mesh_of(&cuboid.expect("a block"))
}

/// A few grains over a mesh of this name.
fn scene(file: &str, more: &str) -> String {
    format!(
        r#"(
    title: "A mesh and some grains",
    gravity: "9.80665 m/s2",
    grains: (
        diameter: "5 mm", density: "2650 kg/m3",
        law: Repulsion(stiffness: YoungModulus("1 MPa"), damping: Equal("0.2 kg/s")),
    ),
    walls: [(name: "body", shape: Mesh(file: "{file}", unit: "mm"{more}), restitution: 0.5, friction: 0.4)],
    initial: (fill: (region: (min: ("-20 mm", "-20 mm", "30 mm"), max: ("20 mm", "20 mm", "60 mm")), solid_fraction: 0.2, seed: 1)),
    time: (step: PerPeriod(20), until: "20 ms"),
)"#
    )
}

/// What a scene makes of a mesh: nothing, or the message that it is refused with.
fn refusal(folder: &Path, file: &str, more: &str) -> Option<String> {
    let path = folder.join("scene.ron");
    std::fs::write(&path, scene(file, more)).expect("the scene is written");
    let checked = Source::read(&path)
        .and_then(|s| s.check())
        .unwrap_or_else(|e| panic!("{file}: {e}"));
    match build(&checked, &Choices::default()) {
        Ok(mut built) => {
            run_out(&mut *built.simulation);
            None
        }
        Err(error) => Some(error.to_string()),
    }
}

/// A mesh with something wrong, and what is said of it; `None` if it is used all the same.
type Case = (&'static str, Vec<u8>, Option<&'static str>);

fn wrong_meshes() -> Vec<Case> {
    let good = block();
    let stl = |mesh: &Mesh| write_stl(mesh, "wrong");
    let change = |f: &dyn Fn(&mut Mesh)| {
        let mut mesh = good.clone();
        f(&mut mesh);
        write_stl(&mesh, "wrong")
    };
    let with = |vertex: DVec3| change(&|m| m.vertices[0] = vertex);
    // Of single triangles, so that a vertex can be moved in one of them alone.
    let text = |vertex: &str| {
        format!(
            "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex {vertex}\nendloop\nendfacet\nendsolid s\n"
        )
        .into_bytes()
    };
    let mut two = good.clone();
    let shift = DVec3::new(15.0, 3.0, 4.0);
    let first = two.vertices.len() as u32;
    two.vertices
        .extend(good.vertices.iter().map(|v| *v + shift));
    two.triangles
        .extend(good.triangles.iter().map(|t| t.map(|c| c + first)));
    let bytes = stl(&good);
    let mut counted = bytes.clone();
    counted[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let open_sheet = change(&|m| m.triangles.truncate(2));
    vec![
        ("good.stl", bytes.clone(), None),
        (
            "inside_out.stl",
            change(&|m| m.triangles.iter_mut().for_each(|t| t.swap(0, 1))),
            None,
        ),
        (
            "one_turned.stl",
            change(&|m| m.triangles[3].swap(0, 1)),
            None,
        ),
        (
            "hole.stl",
            change(&|m| {
                m.triangles.pop();
            }),
            None,
        ),
        (
            "twice.stl",
            change(&|m| m.triangles.extend(m.triangles.clone())),
            None,
        ),
        ("self_intersecting.stl", stl(&two), None),
        (
            "flat_face.stl",
            change(&|m| m.triangles.push([0, 0, 1])),
            None,
        ),
        ("sheet.stl", open_sheet, Some("open sheet")),
        ("empty.stl", Vec::new(), Some("empty")),
        ("only_a_header.stl", bytes[..84].to_vec(), Some("")),
        (
            "truncated.stl",
            bytes[..bytes.len() - 30].to_vec(),
            Some(""),
        ),
        ("counted_wrong.stl", counted, Some("")),
        (
            "not_a_number.stl",
            with(DVec3::new(f64::NAN, 0.0, 0.0)),
            Some(""),
        ),
        (
            "infinite.stl",
            with(DVec3::new(0.0, f64::INFINITY, 0.0)),
            Some(""),
        ),
        ("huge.stl", with(DVec3::new(0.0, 0.0, 1e30)), Some("")),
        ("text_not_a_number.stl", text("0 nan 0"), Some("")),
        ("text_word.stl", text("0 one 0"), Some("")),
        ("text_huge.stl", text("0 1e300 0"), Some("")),
        ("one_triangle.stl", text("0 1 0"), Some("open sheet")),
        ("no_area.stl", text("2 0 0"), Some("")),
        (
            "noise.stl",
            (0..5000u32)
                .map(|k| (k.wrapping_mul(2_654_435_761) >> 13) as u8)
                .collect(),
            Some(""),
        ),
        ("noise.obj", b"v 0 0\nf 1 2 3 9\nxyz\n".to_vec(), Some("")),
        ("wrong_ending.step", bytes, Some("")),
    ]
}

#[test]
fn a_mesh_with_a_fault_is_mended_or_refused_with_a_remedy() {
    let scratch = Scratch::new("meshes");
    for (name, bytes, expected) in wrong_meshes() {
        std::fs::write(scratch.join(name), bytes).expect("the mesh is written");
        match (refusal(scratch.path(), name, ""), expected) {
            (None, None) => {}
            (Some(said), Some(words)) => {
                assert!(said.contains(words), "{name}: {said}");
                assert!(said.contains(name), "{name} is not named: {said}");
                assert!(said.contains("help: "), "{name}: no remedy: {said}");
            }
            (said, expected) => panic!("{name}: {said:?}, expected {expected:?}"),
        }
        // The doctor looks at all of them too.
        let outcome = run_in(scratch.path(), &format!("mesh {name}"));
        assert!([0, 2].contains(&outcome.code), "{name}: {outcome:#?}");
        assert!(!outcome.stderr.contains("panicked"), "{name}: {outcome:#?}");
    }
    // A sheet is a wall once it has a thickness.
    assert_eq!(
        refusal(scratch.path(), "sheet.stl", ", thickness: \"4 mm\""),
        None
    );
    // Cells that are too large or too many.
    for (more, words) in [
        (
            ", surface: Grid(cell: \"25 mm\")",
            "larger than the thinnest part",
        ),
        (", surface: Grid(cell: \"2 um\")", "GB"),
    ] {
        let said = refusal(scratch.path(), "good.stl", more).expect("it is refused");
        assert!(said.contains(words) && said.contains("help: "), "{said}");
    }
    let said = refusal(scratch.path(), "nowhere.stl", "").expect("it is refused");
    assert!(said.contains("nowhere.stl"), "{said}");
}

#[test]
fn grains_that_start_inside_a_body_are_refused() {
    let scratch = Scratch::new("inside");
    scratch.write("scene.ron", "");
    std::fs::write(scratch.join("block.stl"), write_stl(&block(), "block")).expect("written");
    let text = scene("block.stl", "").replace(
        "initial: (fill: (region: (min: (\"-20 mm\", \"-20 mm\", \"30 mm\"), max: (\"20 mm\", \"20 mm\", \"60 mm\")), solid_fraction: 0.2, seed: 1))",
        "initial: (grains: [(at: (\"0 mm\", \"0 mm\", \"40 mm\")), (at: (\"1 mm\", \"0 mm\", \"12 mm\"))])",
    );
    let path = scratch.write("inside.ron", &text);
    let checked = Source::read(&path)
        .and_then(|s| s.check())
        .expect("it reads");
    let said = build(&checked, &Choices::default())
        .err()
        .expect("it is refused")
        .to_string();
    assert!(
        said.contains("grain 1") && said.contains("`body`"),
        "{said}"
    );
}

/// A paddle turns among falling grains; those that leave at the side come back above, and an inlet adds some.
fn paddle(folder: &Path) -> std::path::PathBuf {
    let blade = Cuboid::new(DVec3::new(-20.0, 20.0, -15.0), DVec3::new(20.0, 40.0, 15.0));
    let blade = mesh_of(&blade.expect("a block"));
    std::fs::write(folder.join("paddle.stl"), write_stl(&blade, "paddle")).expect("written");
    let ball = mesh_of(&Ball::new(DVec3::new(0.0, 30.0, -10.0), 12.0).expect("a ball"));
    std::fs::write(folder.join("ball.stl"), write_stl(&ball, "ball")).expect("written");
    let text = r#"(
    title: "A paddle among grains that come and go",
    gravity: "9.80665 m/s2",
    grains: (
        diameter: "5 mm", density: "2650 kg/m3",
        law: Repulsion(stiffness: YoungModulus("1 MPa"), damping: Equal("0.2 kg/s")),
    ),
    domain: (y: Periodic("60 mm")),
    walls: [
        (name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "-60 mm"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.4),
        (name: "left", shape: HalfSpace(point: ("-60 mm", "0 mm", "0 mm"), outward: (1, 0, 0)), restitution: 0.7, friction: 0.2),
        (name: "paddle", shape: Mesh(file: "paddle.stl", unit: "mm"), restitution: 0.5, friction: 0.4, motion: (
            turn: (point: ("0 mm", "30 mm", "0 mm"), axis: (0, 1, 0), rate: "240 rpm"),
            shifts: [(direction: (0, 0, 1), amplitude: "3 mm", frequency: "20 Hz")],
            begins: At("10 ms"),
        )),
        (name: "ball", shape: Mesh(file: "ball.stl", unit: "mm", surface: Exact), restitution: 0.5, friction: 0.4),
    ],
    outlets: [
        (name: "side", region: (min: ("45 mm", "0 mm", "-80 mm"), max: ("200 mm", "60 mm", "110 mm")), then: Recycle(min: ("-50 mm", "0 mm", "160 mm"), max: ("40 mm", "60 mm", "240 mm"))),
        (name: "top", region: (min: ("-60 mm", "0 mm", "250 mm"), max: ("60 mm", "60 mm", "500 mm"))),
    ],
    inlets: [(name: "rain", region: (min: ("-50 mm", "0 mm", "120 mm"), max: ("50 mm", "60 mm", "150 mm")), solid_fraction: 0.1, seed: 5)],
    initial: (fill: (region: (min: ("-55 mm", "0 mm", "-55 mm"), max: ("55 mm", "60 mm", "110 mm")), solid_fraction: 0.22, seed: 3)),
    time: (step: PerPeriod(20), until: "80 ms"),
    output: (every: "10 ms", energies: true, animation: false),
)"#;
    let path = folder.join("paddle.ron");
    std::fs::write(&path, text).expect("written");
    path
}

/// Changes after which a scene's grains turn and remember.
const SPRINGS: [&str; 2] = [
    "grains.law=SpringDashpot(constants: FromRestitution(normal_stiffness: \"5 kN/m\", restitution: 0.5), friction: 0.4)",
    "output.energies=false",
];

#[test]
fn threads_and_vector_paths_change_no_bit_of_a_machine() {
    bits_of_paddle(&[]);
}

#[test]
fn nor_of_a_machine_whose_grains_turn_and_remember() {
    bits_of_paddle(&SPRINGS);
}

fn bits_of_paddle(sets: &[&str]) {
    let scratch = Scratch::new(if sets.is_empty() {
        "machine-bits"
    } else {
        "turning-bits"
    });
    let mut source = Source::read(paddle(scratch.path())).unwrap_or_else(|e| panic!("{e}"));
    for set in sets {
        source.set(set).unwrap_or_else(|e| panic!("{e}"));
    }
    let checked = source.check().unwrap_or_else(|e| panic!("{e}"));
    let run = |threads: usize, lanes: Lanes| {
        let choices = Choices {
            threads: Some(threads),
            lanes: Some(lanes),
            ..Choices::default()
        };
        let mut run = build(&checked, &choices)
            .unwrap_or_else(|error| panic!("{error}"))
            .simulation;
        run_out(&mut *run);
        let readings = run.look();
        let number = |name: &str| readings.iter().find(|r| r.name == name).map(|r| r.value);
        let report = run.report();
        let missing = report.iter().find(|r| r.name == "grains_missing");
        assert_eq!(missing.map(|r| r.value), Some(0.0));
        assert!(number("moved_through_side") > Some(20.0));
        let readings: Vec<(String, u64)> = readings
            .into_iter()
            .map(|r| (r.name.into_owned(), r.value.to_bits()))
            .collect();
        (bits(&*run), readings)
    };
    let first = run(1, Lanes::Portable);
    for (threads, lanes) in [(2, Lanes::best()), (3, Lanes::best()), (3, Lanes::Portable)] {
        assert!(
            run(threads, lanes) == first,
            "{threads} threads on {} vectors give other bits",
            lanes.name()
        );
    }
}

#[test]
fn a_machine_leaves_its_books_closed_and_its_bodies_in_the_frames() {
    let scratch = Scratch::new("machine");
    paddle(scratch.path());
    run_in(scratch.path(), "run paddle.ron --out out/first").is_done();
    let read = |name: &str| std::fs::read_to_string(scratch.join(name)).expect("it is there");
    let summary: serde_json::Value =
        serde_json::from_str(&read("out/first/summary.json")).expect("it is JSON");
    let number = |name: &str| {
        summary[name]["value"]
            .as_f64()
            .unwrap_or_else(|| panic!("{name}: {}", summary[name]))
    };
    assert_eq!(number("grains_missing"), 0.0);
    assert!(number("came_through_rain") > 20.0);
    assert!(number("moved_through_side") > 20.0);
    let missing = number("energy_budget_error");
    assert!(missing < 0.01, "{missing} of the energy is missing");
    let list = read("out/first/frames.pvd");
    assert!(list.contains("frames/frame_000003.vtp") && list.contains("frames/bodies_000003.vtp"));
    let header = read("out/first/series.csv");
    let header = header.lines().next().unwrap_or_default();
    for column in ["torque_y_on_paddle", "power_of_paddle", "force_z_on_ball"] {
        assert!(header.split(',').any(|c| c == column), "{column}: {header}");
    }
    // Grids are kept beside the runs, and the next run reads them: its bits are the same.
    let grids = std::fs::read_dir(scratch.join("out/grids")).expect("grids are kept");
    assert_eq!(grids.count(), 1);
    let again = run_in(scratch.path(), "run paddle.ron --out out/second");
    again.is_done();
    assert!(!again.stderr.contains("building"), "{}", again.stderr);
    assert_eq!(read("out/first/series.csv"), read("out/second/series.csv"));
}

/// The shipped feeder at its coarsest with a screw built of grains of half a grain's radius.
#[test]
fn the_feeder_runs_with_a_screw_built_of_grains() {
    let mut source = Source::read(tsubu_tests::repository().join("scenarios/screw_feeder.ron"))
        .unwrap_or_else(|e| panic!("{e}"));
    for change in [
        "grains.coarse=4",
        "walls.screw.shape=Mesh(file: \"meshes/screw.stl\", unit: \"mm\", surface: Grains(radius: \"5.4 mm\"))",
        "walls.screw.restitution=None",
        "walls.screw.friction=None",
        "still.kinetic_energy=1e9",
        "still.for_at_least=0 s",
        "time.steps=400",
    ] {
        source.set(change).unwrap_or_else(|e| panic!("{e}"));
    }
    let checked = source.check().unwrap_or_else(|e| panic!("{e}"));
    // Grids of distances are kept between the tests, as the command keeps them between runs.
    let grids = Some(Path::new(env!("CARGO_TARGET_TMPDIR")).join("grids"));
    let choices = Choices {
        grids,
        ..Choices::default()
    };
    let built = build(&checked, &choices).unwrap_or_else(|e| panic!("{e}"));
    let said = built.plan.modelled.join("\n");
    assert!(
        said.contains("wall grains of `screw`:") && said.contains("rs/rp = 0.5000"),
        "{said}"
    );
    let mut run = built.simulation;
    run_out(&mut *run);
    assert!(
        run.state()
            .iter()
            .all(|(x, v)| x.is_finite() && v.is_finite())
    );
    let mut readings = run.look();
    readings.extend(run.report());
    let reading = |name: &str| {
        let found = readings.iter().find(|r| r.name == name);
        found.map_or_else(|| panic!("no {name}"), |r| r.value)
    };
    assert_eq!(reading("grains_missing"), 0.0);
    assert!(reading("torque_x_on_screw").is_finite());
}

/// Grains that turn have stiffer motions than a pair: a damping that a pair bears at this step is too much for the heap, which
/// is found out once it lies, when the wall that waited for it would go.
#[test]
fn a_step_over_the_limit_of_a_dry_packing_is_refused_at_the_release() {
    let heap = tsubu_tests::repository().join("tests/scenes/good/small_heap.ron");
    let ran = |damping: &str| {
        let mut source = Source::read(&heap).unwrap_or_else(|e| panic!("{e}"));
        for set in [
            &format!(
                "grains.law=SpringDashpot(constants: FromTimeStep(step: \"80 us\", tn: 20, cn: {damping}), friction: 0.4)"
            ),
            "output.energies=false",
            "time.step=Exactly(\"20 us\")",
            "time.until=1 ms",
        ] {
            source.set(set).unwrap_or_else(|e| panic!("{e}"));
        }
        let checked = source.check().unwrap_or_else(|e| panic!("{e}"));
        let built = build(&checked, &Choices::default()).unwrap_or_else(|e| panic!("{e}"));
        let mut run = built.simulation;
        while run.stop().is_none() {
            run.advance(10_000);
        }
        let used = run
            .report()
            .iter()
            .find(|r| r.name == "step_over_limit")
            .map(|r| r.value);
        (run.stop(), used)
    };
    let (stop, used) = ran("1.3");
    let Some(Stop::UnstablePacking { used: said, .. }) = stop else {
        panic!("{stop:?}")
    };
    assert!(said >= 1.0 && used == Some(said), "{used:?}");
    let (stop, used) = ran("0.3");
    assert_eq!(stop, Some(Stop::Over));
    assert!(used > Some(0.1) && used < Some(1.0), "{used:?}");
}
