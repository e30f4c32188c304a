//! A screw of known flow: what the observer says of it against the formula.

mod common;

use common::{Dice, Fake, body, lattice, named};
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use tsubu_measure::{Conveying, ConveyingOptions, screw};
use tsubu_model::{
    BodyState, Curve, Kind, Motion, Observer, Passage, Pose, Reading, Space, Span, Still, Turn,
};

const DIAMETER: f64 = 0.02;
const DENSITY: f64 = 1000.0;
/// A simple cubic packing: ρ π/6.
const BULK: f64 = DENSITY * PI / 6.0;
const PITCH: f64 = 0.15;
const SPEED: f64 = 2.0; // turns per second
const LENGTH: f64 = 0.3;

fn options() -> ConveyingOptions {
    ConveyingOptions {
        screw: 1,
        outlet: Some(1),
        point: DVec3::new(0.1, 0.0, 0.0),
        direction: DVec3::X * 2.0,
        section: (0.3, 0.3 + LENGTH),
        along: (0.0, 0.9),
        period: None,
        pitch: PITCH,
        outer: 0.205,
        shaft: 0.055,
        casing: 0.2296,
        hopper: Some([DVec3::new(0.0, -0.12, 0.5), DVec3::new(0.24, 0.12, 0.74)]),
        density: DENSITY,
    }
}

/// The whole screw full to a filling ratio `fill`, its grains at random places of the annulus, and a hopper box
/// of 12³ grains in rows.
fn full(seed: u64, fill: f64) -> Vec<DVec3> {
    let o = options();
    let mut dice = Dice(seed);
    let mut grains = lattice::<Space>(DIAMETER, [0.24, 0.24, 0.24], |_| 1.0);
    for grain in &mut grains {
        *grain += DVec3::new(0.0, -0.12, 0.5);
    }
    // Evenly spread along the axis, so that every stretch holds what it should to a grain.
    let mass = Kind::sphere(DIAMETER, DENSITY).mass;
    let count = (fill * BULK * screw::annulus(o.outer, o.shaft) * 0.9 / mass).round() as usize;
    for k in 0..count {
        let angle = TAU * dice.next();
        let square = o.shaft.powi(2) + (o.outer.powi(2) - o.shaft.powi(2)) * dice.next();
        let arm = DVec3::new(0.0, angle.cos(), angle.sin()) * (0.5 * square.sqrt());
        grains.push(o.point + DVec3::X * (0.9 * (k as f64 + 0.5) / count as f64) + arm);
    }
    grains
}

fn outlet(name: &str, mass: f64) -> Passage {
    Passage {
        name: name.into(),
        came: 0,
        went: 1,
        moved: 0,
        mass,
    }
}

/// The screw at this time, turning about x through a point of its axis.
fn turning(rate: f64, time: f64, torque: f64) -> BodyState<Space> {
    let turn = Turn {
        point: DVec3::new(-3.0, 0.0, 0.0),
        axis: DVec3::X,
        rate,
        span: Span::ALWAYS,
    };
    BodyState {
        torque: DVec3::new(torque, 9.0, -9.0),
        pose: Motion {
            turn: Some(turn),
            shifts: Vec::new(),
        }
        .at(time),
        ..body("screw", DVec3::new(40.0, 0.0, 0.0), None)
    }
}

/// What a run of 10 s says in which grains move by `velocity` and the outlet has passed `mass(t)`.
fn run(
    grains: Vec<DVec3>,
    velocity: impl Fn(DVec3) -> DVec3 + 'static,
    mass: impl Fn(f64) -> f64,
) -> (Vec<Reading>, Vec<Reading>, Vec<Curve>) {
    let mut view = Fake::<Space>::of(DIAMETER, grains);
    view.velocity = Box::new(velocity);
    let mut conveying = Conveying::new(options());
    let mut row = Vec::new();
    for k in 0..=200 {
        view.time = 0.05 * f64::from(k);
        view.bodies = vec![
            body("casing", DVec3::ZERO, None),
            turning(TAU * SPEED, view.time, -3.0),
        ];
        view.passages = vec![outlet("hopper", 99.0), outlet("outlet", mass(view.time))];
        row = conveying.see(&view);
    }
    let observer: &dyn Observer<Space, Still> = &conveying;
    (row, observer.report(), observer.curves())
}

/// Q at a = 1.
fn theory() -> f64 {
    let o = options();
    screw::mass_rate(
        1.0,
        screw::volume_per_turn(o.outer, o.shaft, o.pitch),
        SPEED,
        BULK,
    )
}

fn close(readings: &[Reading], name: &str, expected: f64, tolerance: f64) {
    let found = named(readings, name);
    assert!(
        (found - expected).abs() <= tolerance * expected.abs(),
        "{name}: {found}, not {expected}"
    );
}

#[test]
fn a_plug_that_advances_one_pitch_per_turn_has_the_rate_of_the_formula() {
    let advance = PITCH * SPEED;
    let (row, report, curves) = run(
        full(1, 1.0),
        move |_| DVec3::new(advance, 0.0, 0.0),
        |t| theory() * t,
    );
    for (name, expected, tolerance) in [
        ("mass_rate", theory(), 1e-9),
        ("hopper_bulk_density", BULK, 1e-9),
        ("axial_efficiency", 1.0, 1e-9),
        ("ratio_to_theory", 1.0, 1e-9),
        // The section holds what it should to one grain of 900.
        ("ratio_to_theory_measured_a", 1.0, 3e-3),
        ("fill_ratio", 1.0, 3e-3),
        ("mass_rate_from_section", theory(), 3e-3),
        // (0.205² − 0.055²)/(0.2296² − 0.055²) of the space, at π/6.
        ("solid_fraction", 0.784_7 * PI / 6.0, 4e-3),
        ("screw_torque", 3.0, 1e-9),
        ("screw_power", 3.0 * TAU * SPEED, 1e-9),
        ("steady", 1.0, 0.0),
        ("turns", 20.0, 1e-9),
    ] {
        close(&report, name, expected, tolerance);
    }
    assert!(named(&report, "steady_from").abs() < 1e-9);
    assert!(named(&report, "tangential_speed").abs() < 1e-12);
    assert!(report.iter().all(|r| r.value.is_finite()));
    assert!(report.iter().all(|r| {
        r.uncertainty
            .is_none_or(|u| u.abs() < 1e-6 * r.value.abs().max(1.0))
    }));
    for (name, expected) in [
        ("outlet_mass", 10.0 * theory()),
        ("mass_rate", theory()),
        ("axial_speed", advance),
        ("turns", 20.0),
    ] {
        close(&row, name, expected, 1e-9);
    }
    let figures: Vec<(&str, &str)> = curves
        .iter()
        .map(|c| (c.figure, c.label.as_str()))
        .collect();
    assert_eq!(
        figures,
        [
            ("outlet_mass", "through the outlet"),
            ("mass_rate", "measured"),
            ("mass_rate", "theory, a = 1"),
            ("axial_speed", "measured"),
            ("axial_speed", "one pitch per turn"),
            ("fill", "measured"),
        ]
    );
    assert!(curves.iter().all(|c| c.x.len() == c.y.len()));
    assert!(
        curves[2]
            .y
            .iter()
            .all(|y| (y / theory() - 1.0).abs() < 1e-9)
    );
    assert!(curves[3].y.iter().all(|y| (y / advance - 1.0).abs() < 1e-9));
    // Four bins a pitch over the whole screw, each full to a grain of a hundred.
    assert_eq!(curves[5].x.len(), 24);
    assert!(curves[5].y.iter().all(|y| (y - 1.0).abs() < 0.02));
}

#[test]
fn a_leak_and_a_start_up_show_in_the_rate_and_a_half_full_screw_in_the_filling() {
    // Half full, moving at 0.8 of the pitch per turn; the outlet sees it after 2 s.
    let advance = 0.8 * PITCH * SPEED;
    let (_, report, _) = run(
        full(2, 0.5),
        move |_| DVec3::new(advance, 0.0, 0.0),
        |t| 0.4 * theory() * (t - 2.0).max(0.0),
    );
    for (name, expected) in [
        ("mass_rate", 0.4 * theory()),
        ("ratio_to_theory", 0.4),
        ("ratio_to_theory_measured_a", 0.8),
        ("axial_efficiency", 0.8),
        ("fill_ratio", 0.5),
        ("mass_rate_from_section", 0.4 * theory()),
        ("steady_from", 2.0),
        ("steady", 1.0),
    ] {
        close(&report, name, expected, 5e-3);
    }
}

#[test]
fn a_rate_that_grows_is_not_steady_and_has_no_beginning() {
    let (_, report, curves) = run(full(3, 1.0), |_| DVec3::X, |t| t * t);
    close(&report, "steady", 0.0, 0.0);
    assert!(report.iter().all(|r| r.name != "steady_from"));
    // The second half: from 25 kg at 5 s to 100 kg at 10 s.
    close(&report, "mass_rate", 15.0, 1e-9);
    assert!(report[0].uncertainty.is_some_and(|u| u > 0.5));
    assert_eq!(curves.len(), 6);
}

#[test]
fn noise_in_the_outlet_is_within_its_uncertainty() {
    let mut dice = Dice(7);
    let mut sum = 0.0;
    let masses: Vec<f64> = (0..=200)
        .map(|_| {
            sum += 0.5 + dice.next();
            sum
        })
        .collect();
    // Mean 1 kg per look of 0.05 s; deviation √(1/12).
    let (_, report, _) = run(
        full(4, 1.0),
        |_| DVec3::X,
        |t| masses[(t / 0.05).round() as usize],
    );
    let rate = &report[0];
    let error = rate.uncertainty.expect("a steady rate has an error");
    let expected = 20.0 * (1.0f64 / 12.0).sqrt() / 200f64.sqrt();
    assert!(
        error > 0.5 * expected && error < 2.0 * expected,
        "{error} {expected}"
    );
    assert!((rate.value - 20.0).abs() < 3.0 * error);
    // Quotients carry it on.
    let ratio = &report[1];
    assert!((ratio.uncertainty.unwrap() / ratio.value / (error / rate.value) - 1.0).abs() < 1e-6);
}

/// One look at a ring of grains that turns as a block.
fn ring(view_spin: f64, block: f64, direction: DVec3) -> Vec<Reading> {
    let o = ConveyingOptions {
        direction,
        section: (-1.0, 1.0),
        ..options()
    };
    let grains: Vec<DVec3> = (0..12)
        .map(|k| TAU * f64::from(k) / 12.0)
        .map(|a| o.point + DVec3::new(0.0, a.cos(), a.sin()) * 0.08)
        .collect();
    let mut view = Fake::<Space>::of(DIAMETER, grains);
    let point = o.point;
    view.velocity = Box::new(move |x| (DVec3::X * block).cross(x - point));
    view.bodies = vec![
        body("casing", DVec3::ZERO, None),
        turning(view_spin, 1.3, 3.0),
    ];
    Conveying::new(o).see(&view)
}

#[test]
fn a_block_that_turns_with_the_screw_has_a_positive_tangential_speed() {
    // 5 rad/s at 0.08 m, whichever way the screw turns and the axis points.
    for (spin, block, direction, expected) in [
        (6.0, 5.0, DVec3::X, 0.4),
        (-6.0, -5.0, DVec3::X, 0.4),
        (-6.0, 5.0, DVec3::X, -0.4),
        (6.0, 5.0, -DVec3::X, 0.4),
    ] {
        let row = ring(spin, block, direction);
        close(&row, "tangential_speed", expected, 1e-12);
        assert!(named(&row, "axial_speed").abs() < 1e-12);
        // The grains push the screw with 3 N m along x: they drive it if it turns that way.
        close(&row, "screw_torque", -3.0 * spin.signum(), 1e-12);
    }
}

#[test]
fn an_empty_hopper_and_an_empty_screw_are_undefined_only_where_they_must_be() {
    let (row, report, curves) = run(Vec::new(), |_| DVec3::X, |_| 0.0);
    for (name, value) in [
        ("outlet_mass", 0.0),
        ("mass_rate", 0.0),
        ("section_mass", 0.0),
        ("section_solid_fraction", 0.0),
    ] {
        assert_eq!(named(&row, name), value, "{name}");
    }
    for name in [
        "axial_speed",
        "tangential_speed",
        "fill_ratio",
        "hopper_bulk_density",
    ] {
        assert!(named(&row, name).is_nan(), "{name}");
    }
    assert_eq!(named(&report, "mass_rate_from_section"), 0.0);
    for name in ["ratio_to_theory", "axial_efficiency", "hopper_bulk_density"] {
        let reading = report.iter().find(|r| r.name == name).unwrap();
        assert!(
            reading.value.is_nan() && reading.uncertainty.is_none(),
            "{name}"
        );
    }
    // No theory without a bulk density, and no profile without grains.
    assert_eq!(curves.len(), 3);
    let nothing = Conveying::new(options());
    let observer: &dyn Observer<Space, Still> = &nothing;
    assert!(observer.report().is_empty() && observer.curves().is_empty());
}

#[test]
fn a_hopper_that_runs_empty_keeps_its_bulk_density_down_to_the_last_layers() {
    let o = options();
    for rows in [12, 9, 7, 5] {
        let mut grains =
            lattice::<Space>(DIAMETER, [0.24, 0.24, DIAMETER * f64::from(rows)], |_| 1.0);
        for grain in &mut grains {
            *grain += DVec3::new(0.0, -0.12, 0.5);
        }
        let mut view = Fake::<Space>::of(DIAMETER, grains);
        view.bodies = Vec::new();
        let row = Conveying::new(o.clone()).see(&view);
        close(&row, "hopper_bulk_density", BULK, 1e-9);
    }
}

#[test]
fn a_screw_or_an_outlet_that_is_not_there_breaks_nothing() {
    let mut view = Fake::<Space>::of(DIAMETER, full(5, 1.0));
    let mut conveying = Conveying::new(ConveyingOptions {
        direction: DVec3::ZERO,
        ..options()
    });
    for k in 0..30 {
        view.time = f64::from(k);
        let row = conveying.see(&view);
        assert_eq!(row.len(), 11);
        assert!(named(&row, "screw_torque").is_nan() && named(&row, "outlet_mass").is_nan());
        close(&row, "axial_speed", 2.0, 1e-12);
    }
    let observer: &dyn Observer<Space, Still> = &conveying;
    assert_eq!(named(&observer.report(), "steady"), 0.0);
    assert!(!observer.curves().is_empty());
}

#[test]
fn a_force_on_a_screw_whose_torque_is_about_another_point_turns_it_about_its_axis() {
    let mut view = Fake::<Space>::of(DIAMETER, vec![DVec3::ZERO]);
    let mut screw = turning(1.0, 0.3, -3.0);
    screw.pose.pivot = DVec3::new(7.0, 0.5, 0.0);
    screw.force = DVec3::new(0.0, 0.0, 2.0);
    view.bodies = vec![body("casing", DVec3::ZERO, None), screw];
    // −3 N m about the pivot, and 2 N upward at 0.5 m beside the axis: −2 N m on the screw.
    let row = Conveying::new(options()).see(&view);
    close(&row, "screw_torque", 2.0, 1e-12);
}

#[test]
fn grains_outside_the_casing_or_behind_the_section_are_no_load() {
    let o = options();
    let at = |x: f64, r: f64| o.point + DVec3::new(x, 0.0, r);
    let grains = vec![at(0.4, 0.11), at(0.4, 0.12), at(0.29, 0.0), at(0.61, 0.0)];
    let row = Conveying::new(o).see(&Fake::<Space>::of(DIAMETER, grains));
    let one = Kind::sphere(DIAMETER, DENSITY).mass;
    close(&row, "section_mass", one, 1e-12);
}

#[test]
fn a_section_that_repeats_counts_every_grain_once_and_has_the_rate_of_what_moves_through_it() {
    let o = ConveyingOptions {
        outlet: None,
        hopper: None,
        period: Some(LENGTH),
        ..options()
    };
    let one = Kind::sphere(DIAMETER, DENSITY).mass;
    let (first, last) = o.section;
    // At both ends, a little outside of them as between two builds of the lists, and one that is rounded onto the end.
    let grains: Vec<DVec3> = [
        first,
        first - 1e-3,
        first - 1e-18,
        last - 1e-18,
        last,
        last + 1e-3,
    ]
    .map(|x| o.point + DVec3::new(x, 0.08, 0.0))
    .to_vec();
    let count = grains.len() as f64;
    let mut view = Fake::<Space>::of(DIAMETER, grains);
    let (mut conveying, mut row) = (Conveying::new(o), Vec::new());
    for k in 0..=200 {
        view.time = 0.05 * f64::from(k);
        // Up to speed within two seconds.
        let speed = 0.2 * (0.5 * view.time).min(1.0);
        view.velocity = Box::new(move |_| DVec3::new(speed, 0.0, 0.0));
        view.bodies = vec![
            body("casing", DVec3::ZERO, None),
            turning(TAU * SPEED, view.time, -3.0),
        ];
        row = conveying.see(&view);
    }
    close(&row, "section_mass", count * one, 1e-12);
    let observer: &dyn Observer<Space, Still> = &conveying;
    let report = observer.report();
    for (name, expected) in [
        ("mass_rate", count * one / LENGTH * 0.2),
        ("mass_rate_from_section", count * one / LENGTH * 0.2),
        ("axial_efficiency", 0.2 / (PITCH * SPEED)),
        ("ratio_to_theory_measured_a", 0.2 / (PITCH * SPEED)),
        ("steady", 1.0),
    ] {
        close(&report, name, expected, 1e-9);
    }
    assert!(named(&report, "steady_from") > 1.5);
    let absent = [
        "outlet_mass",
        "hopper_bulk_density",
        "fill_ratio",
        "ratio_to_theory",
    ];
    for reading in row.iter().chain(&report) {
        assert!(!absent.contains(&&*reading.name), "{}", reading.name);
    }
    let figures = observer.curves();
    assert!(
        figures
            .iter()
            .all(|c| c.figure != "outlet_mass" && c.figure != "fill")
    );
    assert!(figures.iter().any(|c| c.figure == "mass_rate"));
}

#[test]
fn driven_grains_are_no_load() {
    let mut view = Fake::<Space>::of(DIAMETER, full(6, 1.0));
    let before = Conveying::new(options()).see(&view);
    for k in 0..200 {
        view.grains
            .push(DVec3::new(0.1 + 0.0045 * f64::from(k), 0.0, 0.05));
        view.kinds.push(Kind {
            radius: 0.5 * DIAMETER,
            ..Kind::immovable()
        });
    }
    let after = Conveying::new(options()).see(&view);
    for name in ["section_mass", "axial_speed", "hopper_bulk_density"] {
        close(&after, name, named(&before, name), 0.0);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn turning_the_whole_scene_changes_nothing_in_the_section(
        axis in prop::array::uniform3(-1.0..1.0f64), angle in 0.1..6.0f64, shift in prop::array::uniform3(-1.0..1.0f64),
        seed in 0u64..99,
    ) {
        let turn = DMat3::from_axis_angle(DVec3::from(axis).normalize_or(DVec3::Z), angle);
        let (shift, o) = (DVec3::from(shift), options());
        let point = o.point;
        let swirl = move |x: DVec3| DVec3::new(0.3, 0.0, 0.0) + DVec3::new(4.0 * x.x, 0.0, 0.0).cross(x - point);
        let screw = |pose: Pose, frame: DMat3, at: DVec3| BodyState::<Space> {
            torque: frame * DVec3::new(-3.0, 1.0, 2.0),
            pose: Pose { turn: frame * pose.turn * frame.transpose(), pivot: frame * pose.pivot + at, spin: frame * pose.spin, ..pose },
            ..body("screw", frame * DVec3::new(1.0, 2.0, 3.0), None)
        };
        let pose = turning(7.0, 0.4, 0.0).pose;
        let mut a = Fake::<Space>::of(DIAMETER, full(seed, 0.3));
        let mut b = Fake::<Space>::of(DIAMETER, a.grains.iter().map(|x| turn * *x + shift).collect());
        a.velocity = Box::new(swirl);
        b.velocity = Box::new(move |x| turn * swirl(turn.transpose() * (x - shift)));
        a.bodies = vec![body("casing", DVec3::ZERO, None), screw(pose, DMat3::IDENTITY, DVec3::ZERO)];
        b.bodies = vec![body("casing", DVec3::ZERO, None), screw(pose, turn, shift)];
        // Half a grain's spacing off any edge, so that rounding moves no grain across one.
        let moved = ConveyingOptions { point: turn * o.point + shift, direction: turn * o.direction, ..o.clone() };
        let (a, b) = (Conveying::new(o).see(&a), Conveying::new(moved).see(&b));
        for name in ["section_mass", "axial_speed", "tangential_speed", "section_solid_fraction", "screw_torque", "screw_power"] {
            let (a, b) = (named(&a, name), named(&b, name));
            prop_assert!((a - b).abs() < 1e-9 * (1.0 + a.abs()), "{}: {} {}", name, a, b);
        }
    }

    #[test]
    fn turns_are_counted_whatever_the_cadence(rate in -40.0..40.0f64, cadence in 0.01..1.5f64) {
        let mut view = Fake::<Space>::of(DIAMETER, vec![DVec3::ZERO]);
        let mut conveying = Conveying::new(options());
        let mut row = Vec::new();
        for k in 0..20 {
            view.time = 0.2 + cadence * f64::from(k);
            view.bodies = vec![body("casing", DVec3::ZERO, None), turning(rate, view.time, 0.0)];
            row = conveying.see(&view);
        }
        prop_assert!((named(&row, "turns") - rate.abs() / TAU * 19.0 * cadence).abs() < 1e-6);
    }
}
