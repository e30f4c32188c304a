//! Every field of bodies that move, of grains that come and go, and of their measures, read and written back.

use std::f64::consts::TAU;
use std::path::Path;

use glam::DVec3;
use tsubu_scene::*;

const SCENE: &str = include_str!("conveyor.ron");

fn with(overrides: &[&str]) -> Result<Scene, SceneError> {
    let mut source = Source::from_text("conveyor.ron", SCENE);
    for spec in overrides {
        source.set(spec)?;
    }
    source.check().map(|checked| checked.scene)
}

fn good(overrides: &[&str]) -> Scene {
    with(overrides).unwrap_or_else(|error| panic!("{overrides:?}:\n{error}"))
}

#[test]
fn it_reads_back_to_the_bit() {
    let scene = good(&[]);
    let resolved = scene.to_resolved_ron();
    let again = Source::from_text("resolved", &resolved)
        .check()
        .unwrap_or_else(|error| panic!("{error}\n{resolved}"))
        .scene;
    assert_eq!(again, scene);
    assert_eq!(again.to_resolved_ron(), resolved);
}

#[test]
fn motions_are_what_is_written() {
    let scene = good(&[]);
    let motion = |i: usize| scene.walls[i].motion.clone();
    let floor = Motion {
        turn: None,
        shifts: vec![
            Shift {
                direction: DVec3::Z,
                course: Course::Swing {
                    amplitude: 0.001,
                    frequency: 50.0,
                },
            },
            Shift {
                direction: DVec3::X,
                course: Course::Steady(-0.1),
            },
        ],
        begins: Begin::WhenStill,
        lasts: Some(2.0),
    };
    assert_eq!(motion(0), Some(floor));
    assert_eq!(motion(1), None);
    let screw = Motion {
        turn: Some(Turn {
            point: DVec3::ZERO,
            axis: DVec3::X,
            rate: TAU,
        }),
        shifts: Vec::new(),
        begins: Begin::At(0.0),
        lasts: None,
    };
    assert_eq!(motion(6), Some(screw));
    assert!(scene.waits_for_stillness());
    let none_waits = ["walls.floor.motion.begins=At(\"0 s\")", "still=None"];
    assert!(!good(&none_waits).waits_for_stillness());
}

#[test]
fn shapes_take_their_defaults() {
    let scene = good(&[]);
    let hand = |i: usize| match scene.walls[i].shape {
        Shape::Screw { hand, .. } => Some(hand),
        _ => None,
    };
    assert_eq!([hand(6), hand(7)], [Some(Hand::Right), Some(Hand::Left)]);
    let mesh = |i: usize| match &scene.walls[i].shape {
        Shape::Mesh {
            mesh,
            surface,
            thickness,
        } => Some((mesh.path.clone(), mesh.unit, *surface, *thickness)),
        _ => None,
    };
    let here = |path: &str| std::path::absolute(path).expect("a path");
    let usual = MeshSurface::Grid {
        cell: None,
        exact_edges: false,
    };
    assert_eq!(
        mesh(8),
        Some((here("meshes/cover.stl"), 0.001, usual, None))
    );
    let chute = (
        here("meshes/chute.stl"),
        0.0254,
        MeshSurface::Exact,
        Some(0.002),
    );
    assert_eq!(mesh(9), Some(chute));
    let fine = MeshSurface::Grid {
        cell: Some(0.002),
        exact_edges: true,
    };
    assert_eq!(
        mesh(10),
        Some(("/meshes/vane.stl".into(), 0.01, fine, None))
    );
    let Initial::Fill(fill) = &scene.initial else {
        panic!("no fill")
    };
    assert_eq!(fill.region, None);
    assert_eq!(
        fill.within.as_ref().map(|mesh| mesh.path.as_path()),
        Some(Path::new(&here("meshes/fill.stl")))
    );
    // The room in a mesh is not known here; in so much room the fill has so many grains.
    assert_eq!(fill.count(0.005, Space::Space), 0);
    assert_eq!(fill.count_in(0.001, 0.005, Space::Space), 4584);
}

#[test]
fn measures_know_their_wall_and_their_outlet() {
    let scene = good(&[]);
    let conveying = scene.measures.conveying.expect("it is asked for");
    assert_eq!(scene.walls[conveying.screw].name, "screw");
    let outlet = conveying.outlet.expect("it feeds one");
    assert_eq!(scene.outlets[outlet].name, "outlet");
    assert!(conveying.hopper.is_some());
    assert_eq!(conveying.section, [0.33, 0.54]);
    assert_eq!(scene.outlets[0].then, Fate::Delete);
    assert!(matches!(scene.outlets[1].then, Fate::Recycle { into, seed: 1 } if into.min.z == 0.7));
    assert_eq!(scene.inlets[0].solid_fraction, 0.3);
}

#[test]
fn a_stretch_that_repeats_has_neither_outlet_nor_hopper() {
    let section = |domain: &str, length: &str| {
        short(&format!(
            r#"domain: ({domain}), walls: [(
                name: "screw",
                shape: Screw(
                    from: ("-1 m", "0 m", "0 m"), to: ("2 m", "0 m", "0 m"),
                    shaft: "5 cm", outer: "20 cm", pitch: "15 cm", thickness: "6 mm",
                ),
                motion: (turn: (point: ("0 m", "0 m", "0 m"), axis: (-1, 0, 0), rate: "60 rpm")),
            )],
            measures: (conveying: (
                screw: "screw", pitch: "15 cm", outer: "20 cm", shaft: "5 cm", casing: "23 cm",
                section: ("0 m", "{length}"),
            )),"#
        ))
    };
    let scene = section(r#"x: Periodic("15 cm")"#, "15 cm").unwrap_or_else(|e| panic!("{e}"));
    let conveying = scene.measures.conveying.expect("it is asked for");
    assert_eq!((conveying.outlet, conveying.hopper), (None, None));
    assert_eq!(conveying.period(&scene.walls[0], &scene.domain), Some(0.15));
    // Across the screw a period does not matter.
    let across = section(r#"y: Periodic("15 cm")"#, "16 cm").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(conveying.period(&across.walls[0], &across.domain), None);
    assert!(section(r#"x: Periodic("15 cm")"#, "16 cm").is_err());
}

#[test]
fn each_field_can_be_set() {
    let turn = good(&["walls.screw.motion.turn.rate=30 rpm"]).walls[6]
        .motion
        .as_ref()
        .and_then(|motion| motion.turn);
    assert_eq!(turn.map(|turn| turn.rate), Some(TAU / 2.0));
    let scene = good(&[
        "walls.chute.shape.unit=mm",
        "outlets.lost.then=Delete",
        "inlets.hopper.seed=9",
        "walls.stone.motion.shifts=[(direction: (0, 0, 1), speed: \"1 m/s\")]",
    ]);
    assert!(matches!(&scene.walls[9].shape, Shape::Mesh { mesh, .. } if mesh.unit == 0.001));
    assert_eq!(scene.outlets[1].then, Fate::Delete);
    assert_eq!(scene.inlets[0].seed, 9);
    assert!(scene.walls[1].motion.is_some());
    // A file that is here is meant from here: the tests run in the folder of the crate.
    let file = good(&["walls.cover.shape.file=Cargo.toml"]).walls[8]
        .shape
        .clone();
    let here = std::path::absolute("Cargo.toml").expect("a path");
    assert!(matches!(file, Shape::Mesh { mesh, .. } if mesh.path == here));
}

/// A scene of these fields; the rest is as short as it can be.
fn short(fields: &str) -> Result<Scene, SceneError> {
    let text = format!(
        r#"(
            title: "T", {fields}
            grains: (
                diameter: "1 mm", density: "1000 kg/m3",
                law: Repulsion(stiffness: YoungModulus("3 GPa"), damping: Equal("0.1 kg/s")),
            ),
            initial: (grains: [(at: ("0 mm", "0 mm", "5 mm"))]),
            time: (step: PerPeriod(20), until: "1 s"),
        )"#
    );
    let scene = Source::from_text("short.ron", &text).check()?.scene;
    let again = Source::from_text("resolved", &scene.to_resolved_ron())
        .check()?
        .scene;
    assert_eq!(again, scene);
    Ok(scene)
}

#[test]
fn in_the_plane_bodies_are_flat_and_turn_about_y() {
    let scene = short(
        r#"space: Plane, walls: [
            (name: "disc", shape: Ball(centre: ("1 m", "0 m", "0 m"), radius: "1 cm")),
            (
                name: "paddle",
                shape: Cuboid(min: ("2 m", "0 m", "0 m"), max: ("3 m", "0 m", "1 m")),
                motion: (turn: (point: ("2 m", "0 m", "0 m"), axis: (0, -3, 0), rate: "6 deg/s")),
            ),
        ],
        outlets: [(
            name: "out",
            region: (min: ("5 m", "0 m", "0 m"), max: ("6 m", "0 m", "1 m")),
            then: Recycle(min: ("0 m", "0 m", "3 m"), max: ("1 m", "0 m", "4 m")),
        )],
        inlets: [(name: "in", region: (min: ("0 m", "0 m", "3 m"), max: ("1 m", "0 m", "4 m")), solid_fraction: 0.5, seed: 1)],"#,
    );
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    let turn = scene.walls[1]
        .motion
        .as_ref()
        .and_then(|motion| motion.turn);
    assert_eq!(turn.map(|turn| turn.axis), Some(DVec3::NEG_Y));
}

#[test]
fn a_half_space_moves_as_long_as_it_stays_parallel_to_the_periodic_axes() {
    let moving = |motion: &str| {
        short(&format!(
            r#"domain: (y: Periodic("1 m")), walls: [(
                name: "floor",
                shape: HalfSpace(point: ("0 m", "0 m", "0 m"), outward: (0, 0, 1)),
                motion: ({motion}),
            )],"#
        ))
    };
    let turn = |axis: &str| {
        format!(r#"turn: (point: ("0 m", "0 m", "0 m"), axis: {axis}, rate: "1 rpm")"#)
    };
    let fine = [
        turn("(0, 0, 1)"),
        turn("(0, -2, 0)"),
        r#"shifts: [(direction: (0, 1, 1), speed: "1 m/s")]"#.into(),
    ];
    for motion in fine {
        assert!(moving(&motion).is_ok(), "{motion}");
    }
    for axis in ["(1, 0, 0)", "(0, 1, 1e-6)"] {
        assert!(moving(&turn(axis)).is_err(), "{axis}");
    }
}
