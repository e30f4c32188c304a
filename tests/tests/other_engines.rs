//! Scenes for other engines, and what comes back from them.

use std::fmt::Write as _;
use tsubu::assemble::{Choices, Moment, Simulation, build};
use tsubu::export::{Deck, Target, deck};
use tsubu::model::Reading;
use tsubu::scene::{Checked, SceneError, Source};
use tsubu_tests::{Scratch, repository, run_in};

fn source(name: &str, sets: &[&str]) -> Source {
    let mut source = Source::read(repository().join(name)).unwrap_or_else(|e| panic!("{e}"));
    for set in sets {
        source.set(set).unwrap_or_else(|e| panic!("{set}: {e}"));
    }
    source
}

fn exported(target: Target, name: &str, sets: &[&str]) -> Result<Deck, SceneError> {
    let checked = source(name, sets).check()?;
    deck(target, &checked, &Choices::default(), &|_| Some(100))
}

/// The words of the deck's first line that begins so.
fn words(deck: &Deck, start: &str) -> Vec<String> {
    let line = deck.files[0].1.lines().find(|line| line.starts_with(start));
    let line = line.unwrap_or_else(|| panic!("no line `{start}`:\n{}", deck.files[0].1));
    line.split_whitespace().map(String::from).collect()
}

/// The number after that word.
fn after(words: &[String], word: &str, places: usize) -> f64 {
    let at = words
        .iter()
        .position(|w| w == word)
        .unwrap_or_else(|| panic!("{words:?}"));
    words[at + places]
        .parse()
        .unwrap_or_else(|e| panic!("{words:?}: {e}"))
}

const REPULSION: &str = "benches/scenes/repulsion.ron";
const SPRINGS: &str = "benches/scenes/spring_dashpot.ron";

/// Decks for the same grains were written by hand before there was an export, from the manual of LAMMPS: ε, σ and γ as
/// they are, the rates of damping those of m* = m/2.
#[test]
fn constants_are_those_of_decks_written_by_hand() {
    let lammps = exported(Target::Lammps, REPULSION, &[]).unwrap();
    let lj = words(&lammps, "pair_coeff 1 1 lj/cut");
    assert_eq!(
        (after(&lj, "lj/cut", 1), after(&lj, "lj/cut", 2)),
        (9.434e-5, 1.203e-3)
    );
    let dpd = words(&lammps, "pair_coeff 1 1 dpd/ext/tstat");
    assert_eq!(
        (
            after(&dpd, "dpd/ext/tstat", 1),
            after(&dpd, "dpd/ext/tstat", 2)
        ),
        (3.975e-3, 3.975e-3)
    );
    // The floor acts on the height of the centre (touches_at: Centre), so it stands where the scene has it.
    assert_eq!(after(&words(&lammps, "fix wall_floor"), "zlo", 1), 0.0);

    let lammps = exported(Target::Lammps, SPRINGS, &[]).unwrap();
    let near =
        |got: f64, expected: f64| assert!((got / expected - 1.0).abs() < 1e-4, "{got} {expected}");
    let pair = words(&lammps, "pair_style gran/hooke/history");
    let of = |words: &[String], k| {
        after(
            words,
            if words[0] == "fix" {
                "hooke/history"
            } else {
                "gran/hooke/history"
            },
            k,
        )
    };
    for (k, expected) in [3725.2, 1432.8, 4504.0, 2252.0, 0.413]
        .into_iter()
        .enumerate()
    {
        near(of(&pair, k + 1), expected);
    }
    // Against a wall the reduced mass is the grain's: half the rate for the same dashpot.
    let wall = words(&lammps, "fix wall_floor");
    near(of(&wall, 3), 2252.0);
    near(of(&wall, 4), 1126.0);
    assert_eq!(after(&wall, "zplane", 1), 0.0);

    let liggghts = exported(Target::Liggghts, SPRINGS, &[]).unwrap();
    // Damping in kg/s, whatever the mass.
    near(
        after(&words(&liggghts, "fix gamman_abs"), "peratomtypepair", 2),
        3.9746e-3,
    );
    near(
        after(
            &words(&liggghts, "fix coefficientFriction"),
            "peratomtypepair",
            5,
        ),
        0.413,
    );
}

#[test]
fn a_screw_of_grains_is_a_frozen_group_that_turns() {
    let mut sets = vec![
        "grains.coarse=5".to_owned(),
        "outlets.outlet.then=Delete".to_owned(),
    ];
    for wall in ["screw", "casing", "hopper"] {
        sets.push(format!(
            "walls.{wall}.shape.surface=Grains(radius: \"20 mm\")"
        ));
        sets.push(format!("walls.{wall}.restitution=None"));
        sets.push(format!("walls.{wall}.friction=None"));
    }
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let deck = exported(Target::Lammps, "scenarios/screw_feeder.ron", &sets).unwrap();
    // −100 r/min about x: 0.6 s a turn about −x, so that a right-handed screw feeds towards +x.
    let turn = words(&deck, "fix move_screw");
    assert_eq!(after(&turn, "rotate", 4), -1.0);
    assert!((after(&turn, "rotate", 7) - 0.6).abs() < 1e-12);
    // It waits for stillness: the motion comes after the settling, and the full damping with it.
    let text = &deck.files[0].1;
    let place = |word: &str| text.find(word).unwrap_or_else(|| panic!("{word}"));
    assert!(place("jump SELF settle") < place("fix move_screw"));
    assert_eq!(text.matches("pair_coeff 1 1 dpd/ext/tstat").count(), 2);
    // Grains and wall grains are all in the data file, by type.
    let data = &deck.files[1].1;
    assert!(data.contains(&format!("{} atoms", deck.grains + deck.wall_grains)));
    assert!(data.contains("4 atom types") && deck.wall_grains > 100);
}

/// The feeder with grains that turn goes to LIGGGHTS with its triangles.
#[test]
fn meshes_go_as_triangles_that_move() {
    let law = "grains.law=SpringDashpot(constants: FromRestitution(normal_stiffness: \"4e5 N/m\", restitution: 0.5), friction: 0.5)";
    let sets = [
        "grains.coarse=5",
        "outlets.outlet.then=Delete",
        "still.damping=1",
        law,
        "grains.soften=None",
        "grains.softened_damping=None",
    ];
    let deck = exported(Target::Liggghts, "scenarios/screw_feeder.ron", &sets).unwrap();
    let stl = |name: &str| {
        let file = deck.files.iter().find(|f| f.0 == name);
        file.unwrap_or_else(|| panic!("{name}"))
            .1
            .matches("facet normal")
            .count()
    };
    let shipped = std::fs::read(repository().join("scenarios/meshes/screw.stl")).unwrap();
    let mesh = tsubu::sdf::mesh::parse_stl(&shipped, 1e-3).unwrap();
    // All but the few needles that the deck names.
    let left = mesh.triangles.len() - stl("screw.stl");
    assert!(left < 100, "{left} triangles left out");
    assert_eq!(left > 0, deck.differs.iter().any(|d| d.contains("`screw`")));
    assert!(stl("casing.stl") > 0 && stl("hopper.stl") > 0);
    let turn = words(&deck, "fix move_screw");
    assert_eq!(after(&turn, "axis", 1), -1.0);
}

/// What an engine cannot say is refused at its field, in the library and in the command.
#[test]
fn what_cannot_be_said_is_refused_by_name() {
    let heap = "scenarios/angle_of_repose.ron";
    let feeder = "scenarios/screw_feeder.ron";
    let cases: [(Target, &str, &[&str], &str); 10] = [
        (Target::Lammps, "scenarios/movable_bed.ron", &[], "water"),
        (Target::Lammps, heap, &[], "`floor`"),
        (
            Target::Lammps,
            heap,
            &["walls.floor.friction=None"],
            "`floor`",
        ),
        (
            Target::Lammps,
            heap,
            &["time.integrator=VerletAveraged(sweeps: 4)"],
            "half-step",
        ),
        (Target::Lammps, feeder, &[], "outlet `outlet`"),
        (
            Target::Lammps,
            feeder,
            &["outlets.outlet.then=Delete", "grains.coarse=5"],
            "`screw`",
        ),
        (Target::Liggghts, heap, &[], "Repulsion"),
        (
            Target::Lammps,
            SPRINGS,
            &["grains.law.tension=AsPrinted"],
            "pulling",
        ),
        (
            Target::Liggghts,
            SPRINGS,
            &["grains.law.slip=AsPrinted"],
            "limits",
        ),
        (
            Target::Lammps,
            SPRINGS,
            &["walls.floor.motion=(shifts: [(direction: (0, 0, 1), speed: \"1 m/s\")])"],
            "at rest",
        ),
    ];
    for (target, scene, sets, word) in cases {
        let error = exported(target, scene, sets)
            .map(|_| ())
            .unwrap_err()
            .to_string();
        assert!(
            error.contains(word) && error.contains(target.title()) && error.contains(" --> "),
            "{error}"
        );
    }
    let scratch = Scratch::new("refused");
    let scene = repository().join(feeder);
    let out = scratch.join("deck");
    let words = format!("export lammps {} --out {}", scene.display(), out.display());
    run_in(scratch.path(), &words).is_one_message(2);
    assert!(!out.exists(), "a refused export leaves no folder");
}

/// A deck is written with how to run it, and is not overwritten unasked.
#[test]
fn a_deck_has_its_run_line_and_its_folder_to_itself() {
    let scratch = Scratch::new("deck");
    std::fs::write(scratch.join("two.ron"), TWO).unwrap();
    let words = "export lammps two.ron --out deck";
    let done = run_in(scratch.path(), words);
    assert_eq!(done.code, 0, "{done:#?}");
    assert!(
        done.stdout.contains("mpiexec -n 2 lmp -in deck.in"),
        "{}",
        done.stdout
    );
    for name in [
        "deck.in",
        "grains.data",
        "run.sh",
        "README.md",
        "scene.resolved.ron",
    ] {
        assert!(scratch.join("deck").join(name).exists(), "{name}");
    }
    run_in(scratch.path(), words).is_one_message(2);
    let forced = format!("{words} --force");
    assert_eq!(run_in(scratch.path(), &forced).code, 0);
}

const TWO: &str = r#"(
    title: "Two grains over a floor",
    grains: (
        diameter: "1.35 mm", density: "1370 kg/m3",
        law: Repulsion(stiffness: YoungModulus("31 MPa"), damping: Equal("0.0126 kg/s")),
    ),
    walls: [(name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (0, 0, 1)))],
    initial: (grains: [(at: ("0 mm", "0 mm", "1 mm")), (at: ("0.2 mm", "0 mm", "3 mm"))]),
    time: (step: PerPeriod(40), until: "30 ms"),
    output: (energies: true),
)"#;

/// A bed that waits for a wall to go, small and quick.
fn heap() -> Checked {
    let sets = [
        "grains.coarse=3",
        "time.until=0.1 s",
        "still.kinetic_energy=0.5",
        "still.for_at_least=1 ms",
    ];
    source("scenarios/angle_of_repose.ron", &sets)
        .check()
        .unwrap_or_else(|e| panic!("{e}"))
}

fn moment(run: &dyn Simulation, dt: f64) -> Moment {
    let state = run.state().into_iter().enumerate();
    Moment {
        steps: run.steps(),
        released: run.released_at().map(|t| (t / dt).round() as u64),
        grains: state.map(|(i, (x, v))| (i as u32, x, v)).collect(),
    }
}

/// A moment that is shown is measured as the moment that ran: every reading of the heap, the removal of its wall included,
/// but for the losses, which are sums over steps. Forces on bodies are those of the step before in a run, so they may differ by
/// what a step changes.
#[test]
fn a_shown_moment_is_measured_as_the_run_itself() {
    let checked = heap();
    let choices = Choices {
        threads: Some(1),
        ..Choices::default()
    };
    let mut run = build(&checked, &choices).unwrap_or_else(|e| panic!("{e}"));
    let dt = run.plan.constants.dt;
    let weight = run.plan.grains as f64 * run.plan.constants.kind.weight * 9.80665;
    let mut shown = build(&checked, &choices)
        .unwrap_or_else(|e| panic!("{e}"))
        .simulation;
    let run = &mut *run.simulation;
    let mut looks = 0;
    while !run.is_over() {
        run.advance(1500);
        shown.show(&moment(run, dt));
        let sums = |name: &str| {
            name.contains("lost")
                || name.contains("total")
                || name.contains("taken")
                || name.contains("budget")
                || name.contains("work")
        };
        for (ran, again) in run.look().iter().zip(shown.look()) {
            let Reading { name, value, .. } = ran;
            assert_eq!(*name, again.name);
            let lags = name.contains("force") || name.contains("support");
            let room = if lags {
                0.05 * value.abs().max(weight)
            } else {
                1e-9 * value.abs().max(1e-9)
            };
            let same =
                (value - again.value).abs() <= room || (value.is_nan() && again.value.is_nan());
            assert!(
                same || sums(name),
                "{name}: {value} ran, {} shown at step {}",
                again.value,
                run.steps()
            );
        }
        assert_eq!(run.released_at().is_some(), shown.released_at().is_some());
        looks += 1;
    }
    assert!(looks > 3 && shown.released_at().is_some());
}

/// `tsubu import` leaves what a run leaves; a dump with a fault is told with its line.
#[test]
fn a_dump_becomes_the_folder_of_a_run() {
    let scratch = Scratch::new("import");
    std::fs::write(scratch.join("two.ron"), TWO).unwrap();
    let mut dump = String::new();
    for (step, height) in [(0, 1.0), (50, 0.9), (100, 0.8)] {
        let _ = write!(
            dump,
            "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n\
             ITEM: ATOMS id type x y z vx vy vz\n2 1 0.0002 0 0.003 0 0 0\n1 1 0 0 {:e} 0 0 -1e-2\n",
            height * 1e-3
        );
    }
    std::fs::write(scratch.join("frames.dump"), &dump).unwrap();
    let done = run_in(
        scratch.path(),
        "import frames.dump --scene two.ron --out back",
    );
    assert_eq!(done.code, 0, "{done:#?}");
    let summary = crate::command::summary(&scratch.join("back"));
    assert_eq!(summary["ended"], "imported");
    let (header, rows) = crate::command::series(&scratch.join("back"));
    assert_eq!(rows.len(), 3);
    let column = |name: &str| {
        header
            .iter()
            .position(|h| h == name)
            .unwrap_or_else(|| panic!("{name}"))
    };
    // ½ m v² of the one that moves: 1.7649e-6 kg at 10 mm/s.
    assert!((rows[2][column("kinetic")] / 8.8245e-11 - 1.0).abs() < 1e-4);
    assert_eq!(crate::command::frames(&scratch.join("back")).len(), 3);

    std::fs::write(scratch.join("bad.dump"), dump.replace("0.0002", "two")).unwrap();
    let failed = run_in(scratch.path(), "import bad.dump --scene two.ron --out bad");
    failed.is_one_message(2);
    assert!(
        failed.stderr.contains("bad.dump: line 10"),
        "{}",
        failed.stderr
    );
}
