//! A small river bed from end to end.

use tsubu::assemble::{Choices, Stop, build};
use tsubu::engine::Lanes;
use tsubu_tests::{bits, check, run_out};

/// Forty columns and four layers, stiffer than paper B's tuned bed so that a step of 5 µs resolves it.
const BED: &str = r#"(
    title: "A small bed",
    space: Plane,
    gravity: "9.80665 m/s2",
    grains: (
        diameter: "0.5 mm", density: "2650 kg/m3",
        law: SpringDashpot(constants: FromTimeStep(step: "20 us", tn: 20, cn: 0.3), friction: 0.577),
    ),
    domain: (x: Periodic("21.4 mm")),
    initial: (bed: (layers: 4)),
    water: (shields: 0.5, begins: "0.1 s"),
    time: (step: Exactly("5 us"), until: "0.25 s"),
    output: (every: "2 ms"),
)"#;

/// Why a run ended, its transport over time, and its report.
type Ran = (Option<Stop>, Vec<(f64, f64)>, Vec<(String, f64)>);

fn ran(sets: &[&str], choices: &Choices) -> Ran {
    let mut run = build(&check(BED, sets), choices)
        .unwrap_or_else(|e| panic!("{e}"))
        .simulation;
    let mut rows = Vec::new();
    while !run.is_over() {
        let row = run.look();
        let transport = row.iter().find(|r| r.name == "transport");
        rows.push((run.time(), transport.map_or(f64::NAN, |r| r.value)));
        run.advance(400);
    }
    run.look();
    let report = run
        .report()
        .into_iter()
        .map(|r| (r.name.into_owned(), r.value));
    (run.stop(), rows, report.collect())
}

fn named(report: &[(String, f64)], name: &str) -> f64 {
    report
        .iter()
        .find(|r| r.0 == name)
        .map_or(f64::NAN, |r| r.1)
}

/// Nothing is carried before the water flows, and at ten times the threshold the bed moves: within a factor of 5 of the
/// flume's relation, which a bed as short and thin as this keeps to no better.
#[test]
fn a_bed_rests_until_the_water_flows_and_then_moves() {
    let (stop, rows, report) = ran(&[], &Choices::default());
    assert_eq!(stop, Some(Stop::Over));
    let at_rest = rows.iter().filter(|(t, _)| (0.08..0.099).contains(t));
    assert!(at_rest.clone().count() > 5);
    for (t, transport) in at_rest {
        assert!(transport.abs() < 1e-2, "{transport} at {t} s");
    }
    assert_eq!(named(&report, "shields"), 0.5);
    // 8 · 0.453^1.5, by hand.
    assert!((named(&report, "transport_meyer_peter_mueller") - 2.439).abs() < 1e-3);
    let ratio = named(&report, "ratio_to_meyer_peter_mueller");
    assert!((0.2..5.0).contains(&ratio), "{ratio}");
    assert!(named(&report, "step_over_limit") < 1.0);
}

/// Paper B's damping at a quarter of its step: a pair bears it, so nothing refuses it before, but not the packing as it
/// lies. Refused when the water begins, and run when it is allowed, with the share in the report.
#[test]
fn a_step_over_the_limit_of_the_packing_is_refused_when_it_lies() {
    let sets = ["grains.law.constants.cn=1.3", "time.until=0.101 s"];
    let (stop, _, report) = ran(&sets, &Choices::default());
    let Some(Stop::UnstablePacking { time, used }) = stop else {
        panic!("{stop:?}")
    };
    assert!((time - 0.1).abs() < 1e-4 && used >= 1.0, "{used} at {time}");
    assert_eq!(named(&report, "step_over_limit"), used);
    let allowed = Choices {
        allow_unstable: true,
        ..Choices::default()
    };
    let (stop, _, report) = ran(&sets, &allowed);
    assert_eq!(stop, Some(Stop::Over));
    assert_eq!(named(&report, "step_over_limit"), used);
}

/// A bed of the plane costs less a grain than the same in space: no second line for the spin, no third coordinate, fewer
/// neighbours. What a grain costs by itself is held to the byte in the engine's tests.
#[test]
fn a_plane_bed_stores_less_than_one_in_space() {
    let bytes = |sets: &[&str]| {
        let built = build(&check(BED, sets), &Choices::default()).unwrap_or_else(|e| panic!("{e}"));
        let mut run = built.simulation;
        run.advance(100);
        run.bytes_per_grain()
    };
    let plane = bytes(&[]);
    let space = bytes(&["space=Space"]);
    assert!(plane > 116.0 && plane + 96.0 < space, "{plane} {space}");
}

/// The same bed without water is weighed after 10 000 steps, then after 20 000 and so on.
#[test]
fn a_dry_bed_is_held_against_the_limit_of_its_packing_too() {
    let dry = ["water=None", "time.until=0.11 s"];
    let (stop, _, report) = ran(&dry, &Choices::default());
    assert_eq!(stop, Some(Stop::Over));
    let used = named(&report, "step_over_limit");
    assert!(used > 0.1 && used < 1.0, "{used}");
    // A pair of grains bears this step, the packing does not.
    let over = [
        "grains.law.constants.cn=1.3",
        "time.step=Exactly(\"10 us\")",
    ];
    let over = [&dry[..], &over].concat();
    let (stop, _, report) = ran(&over, &Choices::default());
    let Some(Stop::UnstablePacking { time, used }) = stop else {
        panic!("{stop:?}")
    };
    assert!((time - 0.1).abs() < 1e-9 && used >= 1.0, "{used} at {time}");
    assert_eq!(named(&report, "step_over_limit"), used);
    let allowed = Choices {
        allow_unstable: true,
        ..Choices::default()
    };
    let (stop, _, report) = ran(&over, &allowed);
    assert_eq!(stop, Some(Stop::Over));
    assert!(named(&report, "step_over_limit") >= used);
}

/// Water over grains that have no contacts has no bottom.
#[test]
fn water_that_begins_before_there_is_a_bed_says_so() {
    let (stop, _, _) = ran(
        &["water.begins=0.1 ms", "time.until=1 ms"],
        &Choices::default(),
    );
    assert!(matches!(stop, Some(Stop::NoBed { .. })), "{stop:?}");
}

/// Two sizes of equal mass share: the small ones, half as wide, are eight times as many; each has its transport, and the
/// two add up. 160 sites give 142 small grains of 160 within four standard deviations.
#[test]
fn a_mixture_has_its_numbers_and_its_transport_by_size() {
    let sets = [
        "grains.populations=[(diameter: \"0.5 mm\", share: 0.5), (diameter: \"0.25 mm\", share: 0.5)]",
        "initial.bed.vacancies=0",
        "time.step=Exactly(\"1.5 us\")",
        "time.until=0.15 s",
    ];
    let run = build(&check(BED, &sets), &Choices::default()).unwrap_or_else(|e| panic!("{e}"));
    let grains = run.simulation.snapshot().grains;
    let small = grains.iter().filter(|g| g.radius < 0.2e-3).count();
    // 40 fixed grains of the largest size besides.
    assert_eq!(grains.len(), 200);
    assert!(
        (small as f64 - 160.0 * 8.0 / 9.0).abs() < 4.0 * (160.0f64 * 8.0 / 81.0).sqrt(),
        "{small}"
    );
    let (stop, _, report) = ran(&sets, &Choices::default());
    assert_eq!(stop, Some(Stop::Over));
    let [all, large, little] =
        ["transport", "transport_d1", "transport_d2"].map(|name| named(&report, name));
    assert!(all > 0.0 && little > 0.0, "{all} {large} {little}");
    assert!((large + little - all).abs() < 1e-9 * all.abs());
}

/// Threads and vector paths change no bit of a flowing bed, in the plane and in space.
#[test]
fn threads_and_vector_paths_change_no_bit() {
    let space = [
        "space=Space",
        "domain.x=Periodic(\"8.56 mm\")",
        "domain.y=Periodic(\"6.42 mm\")",
        "water.begins=25 ms",
        "time.until=30 ms",
    ];
    let plane = ["water.begins=25 ms", "time.until=40 ms"];
    for sets in [&plane[..], &space[..]] {
        let end = |threads: usize, lanes: Lanes| {
            let choices = Choices {
                threads: Some(threads),
                lanes: Some(lanes),
                allow_unstable: true,
                ..Choices::default()
            };
            let mut run = build(&check(BED, sets), &choices)
                .unwrap_or_else(|e| panic!("{e}"))
                .simulation;
            run_out(&mut *run);
            bits(&*run)
        };
        let expected = end(1, Lanes::Portable);
        for (threads, lanes) in [(2, Lanes::Portable), (3, Lanes::best()), (1, Lanes::best())] {
            assert!(
                end(threads, lanes) == expected,
                "{threads} threads, {lanes:?}"
            );
        }
    }
}
