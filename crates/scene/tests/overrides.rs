//! Overrides: `path=value` as typed after `--set`.

use tsubu_scene::{Checked, End, Initial, SceneError, Source};

const SCENE: &str = r#"(
    title: "T",
    grains: (
        diameter: "1.35 mm", // as measured
        density: "1370 kg/m3",
        law: Repulsion(stiffness: YoungModulus("3 GPa"), damping: Equal("0.1 kg/s")),
    ),
    walls: [
        (name: "floor", shape: HalfSpace(point: ("0 m", "0 m", "0 m"), outward: (0, 0, 1)), friction: 0.4),
        (name: "left wall", shape: HalfSpace(point: ("0 m", "0 m", "0 m"), outward: (1, 0, 0))),
    ],
    initial: (
        fill: (region: (min: ("0 m", "0 m", "0 m"), max: ("1 m", "1 m", "1 m")), solid_fraction: 0.3, seed: 1)
    ),
    time: (step: PerPeriod(20), until: "1 s"),
)
"#;

fn with(overrides: &[&str]) -> Result<Checked, SceneError> {
    let mut source = Source::from_text("t.ron", SCENE);
    for spec in overrides {
        source.set(spec)?;
    }
    source.check()
}

fn good(overrides: &[&str]) -> tsubu_scene::Scene {
    with(overrides)
        .unwrap_or_else(|error| panic!("{overrides:?}:\n{error}"))
        .scene
}

#[test]
fn values_are_replaced() {
    assert_eq!(good(&["grains.diameter=2 mm"]).grains.diameter, 0.002);
    assert_eq!(good(&["grains.diameter=\"2 mm\""]).grains.diameter, 0.002);
    assert_eq!(
        good(&["walls[0].friction=0.2"]).walls[0].friction,
        Some(0.2)
    );
    assert_eq!(
        good(&["walls.floor.friction=0.2"]).walls[0].friction,
        Some(0.2)
    );
    assert_eq!(good(&["walls.0.friction=None"]).walls[0].friction, None);
    assert_eq!(
        good(&["walls.floor.shape.outward=[0, 3, 4]"]).walls[0].shape,
        {
            let outward = glam::DVec3::new(0.0, 0.6, 0.8);
            tsubu_scene::Shape::HalfSpace {
                point: glam::DVec3::ZERO,
                outward,
            }
        }
    );
    let stiff = good(&["grains.law.stiffness=YoungModulus(\"1 GPa\")"])
        .grains
        .law;
    let tsubu_scene::Law::Repulsion { stiffness, .. } = stiff else {
        panic!("another law");
    };
    assert_eq!(stiffness, tsubu_scene::Stiffness::YoungModulus(1e9));
}

#[test]
fn texts_may_go_without_quotes() {
    for (typed, title) in [
        ("2", "2"),
        ("Some heap", "Some heap"),
        ("a // b", "a // b"),
        ("true", "true"),
        ("a \"b\" \\", "a \"b\" \\"),
        ("None", "None"),
        ("粒", "粒"),
    ] {
        assert_eq!(good(&[&format!("title={typed}")]).title, title);
    }
}

#[test]
fn missing_fields_are_added() {
    assert_eq!(
        good(&["grains.coarse=3", "grains.coarse=2"]).grains.coarse,
        2
    );
    assert_eq!(good(&["neighbours.skin=0.2"]).skin, Some(0.2));
    assert_eq!(
        good(&["output.every=10 ms", "output.energies=true"])
            .output
            .every,
        Some(0.01)
    );
    assert_eq!(
        good(&["walls.left wall.removed=At(\"1 s\")"]).walls[1].removed,
        tsubu_scene::Removal::At(1.0)
    );
    let implicit = good(&[
        "time.integrator=DashpotImplicit()",
        "time.integrator.sweeps=9",
    ])
    .time
    .integrator;
    assert_eq!(
        implicit,
        tsubu_scene::Integrator::DashpotImplicit { sweeps: 9 }
    );
    assert_eq!(
        good(&["time.integrator.sweeps=8", "time.integrator=VerletOld"])
            .time
            .integrator,
        tsubu_scene::Integrator::VerletOld
    );
    assert_eq!(good(&["walls=[]"]).walls, []);
}

#[test]
fn the_field_that_excludes_another_removes_it() {
    assert_eq!(good(&["time.steps=40"]).time.end, End::Steps(40));
    assert_eq!(
        good(&["time.steps=40", "time.until=2 s"]).time.end,
        End::Until(2.0)
    );
    assert_eq!(good(&["grains.mass=1 mg"]).grains.mass, 1e-6);
    for spec in [
        "initial.file=/somewhere/grains.csv",
        "initial.file=\"/somewhere/grains.csv\"",
    ] {
        assert_eq!(
            good(&[spec]).initial,
            Initial::File("/somewhere/grains.csv".into())
        );
    }
    let listed = good(&[
        "initial.file=a.csv",
        "initial.grains=[(at: (\"0 m\", \"0 m\", \"1 m\"))]",
    ])
    .initial;
    assert!(matches!(listed, Initial::Grains(grains) if grains.len() == 1));
}

#[test]
fn a_file_that_is_here_is_meant_from_here() {
    // The tests run in the folder of the crate.
    let Initial::File(path) = good(&["initial.file=Cargo.toml"]).initial else {
        panic!("no file")
    };
    assert_eq!(path, std::path::absolute("Cargo.toml").expect("a path"));
}

#[test]
fn trouble_in_an_override_is_shown_in_the_override() {
    for (spec, message, place) in [
        ("grains.diameter=2 mmm", "unknown unit “mmm”", (1, 17)),
        ("grains.diameter=2", "bare number", (1, 17)),
        (
            "grains.diameter=-2 mm",
            "the diameter is not above zero",
            (1, 17),
        ),
        ("grains.coars=2", "unknown field “coars”", (1, 8)),
        ("grains.coarse=2.5", "2.5 is not a whole number", (1, 15)),
        (
            "grains.coarse=lots",
            "a whole number such as 2 is expected",
            (1, 15),
        ),
        ("grains.coarse=(", "“(” is a text", (1, 15)),
        ("grains.coarse=", "no value", (1, 15)),
        ("grains.coarse", "without “=”", (1, 1)),
        ("grains..coarse=1", "empty part", (1, 1)),
        ("grains.diameter.x=1", "has no part “x”", (1, 17)),
        ("walls.flor.friction=0.2", "no item “flor”", (1, 7)),
        ("walls[2].friction=0.2", "no item “2”", (1, 7)),
        (
            "walls.floor.restitution=2",
            "restitution is outside",
            (1, 25),
        ),
        (
            "time.step=PerPeroid(3)",
            "unknown choice “PerPeroid”",
            (1, 11),
        ),
        ("titel=x", "unknown field “titel”", (1, 1)),
    ] {
        let error = with(&[spec]).expect_err(spec);
        assert!(error.headline().contains(message), "{spec}:\n{error}");
        assert_eq!(error.line_column(), Some(place), "{spec}:\n{error}");
        assert!(error.to_string().contains(" --> --set:1:"), "{error}");
    }
}

#[test]
fn trouble_elsewhere_keeps_its_place_in_the_file() {
    let mut source = Source::from_text("t.ron", &SCENE.replace("0.4", "-0.4"));
    source.set("grains.law=Repulsion(stiffness: YoungModulus(\"3 GPa\"),\n\n damping: Equal(\"0.1 kg/s\"))").expect("in form");
    source.set("title=A much longer title").expect("in form");
    assert_eq!(
        source.check().expect_err("negative").line_column(),
        Some((9, 103))
    );
}

#[test]
fn later_stages_point_at_fields() {
    let checked = with(&["grains.coarse=3"]).expect("good");
    let place = |path: &str| checked.problem(path, "what", "remedy").line_column();
    assert_eq!(place("grains.diameter"), Some((4, 19)));
    assert_eq!(
        place("grains.soften"),
        Some((3, 5)),
        "an absent field is its block"
    );
    assert_eq!(place("walls.left wall.shape.outward"), Some((10, 85)));
    assert_eq!(place("walls[1].shape.outward[2]"), Some((10, 92)));
    assert_eq!(place("neighbours.skin"), Some((1, 1)));
    assert_eq!(place("no sense at all.."), Some((1, 1)));
    assert!(
        checked
            .problem("grains.coarse", "what", "remedy")
            .to_string()
            .contains("1 | grains.coarse=3")
    );
}
