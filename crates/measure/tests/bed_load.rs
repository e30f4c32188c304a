//! Beds whose every grain is placed by hand: what the observer of bed load says of them.

mod common;

use common::{Dice, Fake, lattice, named};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_6, PI};
use tsubu_measure::{BedLoad, BedLoadOptions};
use tsubu_model::{Curve, Kind, Observer, Plane, Reading, Space, Still};

const D: f64 = 0.5e-3;
/// √(1.65 · 9.80665 · (5e-4)³), by hand.
const UNIT: f64 = 4.4974e-5;

fn options() -> BedLoadOptions {
    BedLoadOptions {
        length: 40.0 * D,
        width: D,
        diameter: D,
        unit: UNIT,
        shields: 0.5,
        expected: vec![("meyer_peter_mueller", 7.0), ("nothing_moves", 0.0)],
        begins: 1.0,
        skip: 0.25,
        moving_speed: 0.01,
        sizes: Vec::new(),
    }
}

/// One grain in a bed of such a size that its speed is qB*: d = L = 1, b = π/6, unit 1.
fn of_one_grain() -> (BedLoadOptions, Fake<Plane>) {
    let o = BedLoadOptions {
        length: 1.0,
        width: FRAC_PI_6,
        diameter: 1.0,
        unit: 1.0,
        ..options()
    };
    (o, Fake::<Plane>::of(1.0, vec![DVec2::new(0.5, 2.0)]))
}

/// Looks of one grain whose qB* at a time is that of `transport`.
fn run(
    o: BedLoadOptions,
    times: impl Iterator<Item = f64>,
    transport: impl Fn(f64) -> f64,
) -> (Vec<Reading>, Vec<Curve>) {
    let mut view = of_one_grain().1;
    let mut bed = BedLoad::new(o);
    for time in times {
        let speed = transport(time);
        view.time = time;
        view.velocity = Box::new(move |_| DVec3::new(speed, 0.0, 0.0));
        bed.see(&view);
    }
    let observer: &dyn Observer<Plane, Still> = &bed;
    (observer.report(), observer.curves())
}

fn reading<'a>(readings: &'a [Reading], name: &str) -> &'a Reading {
    readings
        .iter()
        .find(|r| r.name == name)
        .unwrap_or_else(|| panic!("no {name}"))
}

fn close(readings: &[Reading], name: &str, expected: f64, tolerance: f64) {
    let found = named(readings, name);
    assert!(
        (found - expected).abs() <= tolerance * expected.abs().max(1e-300),
        "{name}: {found}, not {expected}"
    );
}

/// A grain that no force moves.
fn fixed(diameter: f64) -> Kind {
    Kind {
        radius: 0.5 * diameter,
        weight: 1e6,
        ..Kind::immovable()
    }
}

#[test]
fn one_grain_in_ten_that_moves_carries_what_a_calculator_says() {
    let grains = (0..40).map(|i| DVec2::new((f64::from(i) + 0.5) * D, f64::from(i % 10) * D));
    let mut view = Fake::<Plane>::of(D, grains.collect());
    view.velocity = Box::new(|x| DVec3::new(if x.z < 0.5 * D { 0.1 } else { 0.0 }, 0.0, 7.0));
    let row = BedLoad::new(options()).see(&view);
    let names: Vec<&str> = row.iter().map(|r| &*r.name).collect();
    assert_eq!(
        names,
        [
            "transport",
            "transport_rate",
            "moving_fraction",
            "bed_height",
            "centre_of_mass"
        ]
    );
    assert!(row.iter().map(|r| r.unit).eq(["1", "m2/s", "1", "m", "m"]));
    // 0.523599 · 1.25e-10 m³ · 4 · 0.1 m/s/(0.02 m · 5e-4 m), and that over 4.4974e-5.
    close(&row, "transport_rate", 2.618e-6, 1e-4);
    close(&row, "transport", 0.05821, 1e-4);
    close(&row, "moving_fraction", 0.1, 1e-12);
    close(&row, "centre_of_mass", 4.5 * D, 1e-12);
    assert!(named(&row, "bed_height").is_nan(), "nothing touches");
}

#[test]
fn the_bed_is_what_has_two_contacts_near_the_highest_of_them() {
    // In units of d: heights, and who touches whom. The leaping pair at 9 has one contact each, the grain at 3.9 is too deep.
    let height = [9.0, 9.9, 5.0, 4.6, 4.01, 3.9, 4.3, 0.0];
    let grains = height.iter().map(|z| DVec2::new(0.0, z * D)).collect();
    let mut view = Fake::<Plane>::of(D, grains);
    let pairs = [(0, 1), (2, 3), (2, 5), (3, 4), (4, 5), (6, 7)];
    view.pairs = pairs.map(|(i, j)| (i, j, 1e-6)).to_vec();
    // (5.0 + 4.6 + 4.01)/3: 4.3 hangs on one contact.
    let row = BedLoad::new(options()).see(&view);
    close(&row, "bed_height", 13.61 / 3.0 * D, 1e-9);
    // A second contact makes it bed, though with a fixed grain.
    view.kinds[7] = fixed(D);
    view.pairs.push((6, 7, 1e-6));
    let row = BedLoad::new(options()).see(&view);
    close(&row, "bed_height", 17.91 / 4.0 * D, 1e-9);
    // A fixed grain is no bed however high it lies and whatever it touches.
    view.kinds[2] = fixed(D);
    let row = BedLoad::new(options()).see(&view);
    close(&row, "bed_height", 16.81 / 4.0 * D, 1e-9);
}

#[test]
fn each_size_has_its_transport_in_space() {
    // d1 = 2, d2 = 1 over 4 × 3: (π/6)(8 · 0.5 − 8 · 0.25)/12 = π/36 and (π/6)(3 · 1 · 0.5)/12 = π/48.
    let x = [0.0, 1.0, 2.0, 3.0, 3.5];
    let mut view = Fake::<Space>::of(1.0, x.map(|x| DVec3::new(x, 1.0, 1.0)).to_vec());
    view.grains[0].z = 3.0;
    view.kinds[0] = Kind::sphere(2.0, 1000.0);
    view.kinds[1] = Kind::sphere(2.0 + 1e-12, 1000.0);
    view.velocity = Box::new(|x| DVec3::new(if x.x == 1.0 { -0.25 } else { 0.5 }, 9.0, 9.0));
    let o = BedLoadOptions {
        length: 4.0,
        width: 3.0,
        diameter: 2.0,
        unit: 0.1,
        sizes: vec![2.0, 1.0],
        ..options()
    };
    let mut bed = BedLoad::new(o);
    let row = bed.see(&view);
    close(&row, "transport_rate", PI / 36.0 + PI / 48.0, 1e-9);
    close(&row, "transport_d1", PI / 3.6, 1e-9);
    close(&row, "transport_d2", PI / 4.8, 1e-9);
    close(&row, "transport", PI / 3.6 + PI / 4.8, 1e-9);
    // Masses as 8, 8, 1, 1, 1 at heights 3, 1, 1, 1, 1.
    close(&row, "centre_of_mass", 35.0 / 19.0, 1e-9);
    // One of five moves back.
    close(&row, "moving_fraction", 0.8, 1e-12);
    assert_eq!(row[5].name, "transport_d1");
    for k in 1..=16 {
        view.time = f64::from(k);
        bed.see(&view);
    }
    let report = Observer::<Space, Still>::report(&bed);
    close(&report, "transport_d2", PI / 4.8, 1e-9);
}

#[test]
fn means_are_over_the_looks_since_the_water_flows_less_the_share_that_is_dropped() {
    // Water from 1 s to 5 s, a quarter dropped: from 2 s on. Eight looks there, by hand 3.5 ± √(6/8) (s² = 6).
    let counted = [0.0, 7.0, 2.0, 5.0, 4.0, 3.0, 6.0, 1.0];
    let times = [0.0, 0.5, 1.0, 1.9].into_iter();
    let times = times.chain((0..8).map(|k| 2.0 + 3.0 * f64::from(k) / 7.0));
    let transport = move |t: f64| {
        if t < 2.0 {
            1e6
        } else {
            counted[((t - 2.0) * 7.0 / 3.0).round() as usize]
        }
    };
    let (report, curves) = run(of_one_grain().0, times.clone(), transport);
    let error = 0.75f64.sqrt();
    for (name, value, uncertainty) in [
        ("transport", 3.5, Some(error)),
        ("transport_rate", 3.5, Some(error)),
        ("shields", 0.5, None),
        ("transport_meyer_peter_mueller", 7.0, None),
        ("ratio_to_meyer_peter_mueller", 0.5, Some(error / 7.0)),
        ("transport_nothing_moves", 0.0, None),
        // Seven of eight: s² = (7/8 · 1/8) · 8/7.
        ("moving_fraction", 0.875, Some(0.125)),
        ("centre_of_mass", 2.0, Some(0.0)),
        ("transport_looks", 8.0, None),
    ] {
        let found = reading(&report, name);
        assert!((found.value - value).abs() < 1e-9, "{name}: {found:?}");
        assert_eq!(found.uncertainty.is_some(), uncertainty.is_some(), "{name}");
        let off = found.uncertainty.unwrap_or(0.0) - uncertainty.unwrap_or(0.0);
        assert!(off.abs() < 1e-9, "{name}: {found:?}");
    }
    for name in ["ratio_to_nothing_moves", "bed_height"] {
        let found = reading(&report, name);
        assert!(found.value.is_nan() && found.uncertainty.is_none());
    }
    let figures: Vec<(&str, &str)> = curves.iter().map(|c| (c.figure, &*c.label)).collect();
    assert_eq!(
        figures,
        [
            ("transport", "measured"),
            ("transport", "meyer peter mueller"),
            ("transport", "nothing moves"),
            ("velocity_profile", "measured"),
            ("concentration_profile", "measured"),
            ("centre_of_mass", "measured"),
        ]
    );
    assert_eq!((curves[0].x.len(), curves[0].y[2]), (12, 1e6));
    assert_eq!(
        (&*curves[1].x, &*curves[1].y),
        (&[1.0, 5.0][..], &[7.0, 7.0][..])
    );
    // The grain at height 2 is in the layer from 2 to 2.5, and only the counted looks are in the profile.
    assert_eq!(curves[3].x, [2.25]);
    assert!((curves[3].y[0] - 3.5).abs() < 1e-9);
    assert_eq!(curves[4].x, [1.75, 2.25, 2.75]);
}

#[test]
fn fewer_than_eight_looks_say_nothing_nor_does_water_that_has_not_begun() {
    let at = |begins: f64| {
        let o = BedLoadOptions {
            begins,
            skip: 0.0,
            ..of_one_grain().0
        };
        run(o, (0..20).map(f64::from), |_| 3.0).0
    };
    let report = at(12.0);
    close(&report, "transport_looks", 8.0, 0.0);
    close(&report, "transport", 3.0, 1e-12);
    for (begins, looks) in [(13.0, 7.0), (99.0, 0.0), (f64::INFINITY, 0.0)] {
        let report = at(begins);
        close(&report, "transport_looks", looks, 0.0);
        for name in [
            "transport",
            "transport_rate",
            "ratio_to_meyer_peter_mueller",
            "moving_fraction",
            "centre_of_mass",
        ] {
            let found = reading(&report, name);
            assert!(found.value.is_nan() && found.uncertainty.is_none());
        }
        close(&report, "transport_meyer_peter_mueller", 7.0, 0.0);
        close(&report, "shields", 0.5, 0.0);
        close(&report, "transport_steady", 0.0, 0.0);
    }
    let observer: &dyn Observer<Plane, Still> = &BedLoad::new(options());
    assert!(observer.report().is_empty() && observer.curves().is_empty());
}

#[test]
fn a_rate_that_holds_is_steady_and_one_that_climbs_is_not() {
    let times = || (0..=400).map(|k| 0.05 * f64::from(k));
    let noise = |t: f64| Dice((t * 1e3) as u64).next() - 0.5;
    // Counted from 5.75 s on; a start-up that reaches 8 s is found, but stays in the mean.
    let steady = |t: f64| if t < 8.0 { t / 4.0 } else { 2.0 } + 0.2 * noise(t);
    let report = run(of_one_grain().0, times(), steady).0;
    close(&report, "transport_steady", 1.0, 0.0);
    let from = named(&report, "transport_steady_from");
    assert!((7.0..12.0).contains(&from), "{from}");
    // ∫ t/4 from 5.75 to 8 = 3.867, and 2 · 12: 27.867 over 14.25 s.
    let found = reading(&report, "transport");
    assert!((found.value - 1.956).abs() < 0.01, "{found:?}");
    let climbs = |t: f64| 0.1 * t + 0.2 * noise(t);
    let report = run(of_one_grain().0, times(), climbs).0;
    close(&report, "transport_steady", 0.0, 0.0);
    assert!(report.iter().all(|r| r.name != "transport_steady_from"));
    // It holds long, and dies at the end.
    let dies = |t: f64| if t < 18.0 { 2.0 } else { 0.5 } + 0.2 * noise(t);
    let report = run(of_one_grain().0, times(), dies).0;
    close(&report, "transport_steady", 0.0, 0.0);
    // A bed that nothing moves is steady too, and its uncertainty is no NaN.
    let report = run(of_one_grain().0, times(), |_| 0.0).0;
    close(&report, "transport_steady", 1.0, 0.0);
    assert_eq!(reading(&report, "transport").uncertainty, Some(0.0));
}

/// Profiles of grains in rows, d = 1, that shear by 0.3/s; the rate of the row.
fn sheared<G: tsubu_measure::Slices>(o: BedLoadOptions, grains: Vec<G::V>) -> (f64, Vec<Curve>) {
    let mut view = Fake::<G>::of(1.0, grains);
    view.velocity = Box::new(|x| DVec3::new(0.3 * x.z, 1.0, 1.0));
    view.time = 2.0;
    let mut bed = BedLoad::new(o);
    let row = Observer::<G, Still>::see(&mut bed, &view);
    let curves = Observer::<G, Still>::curves(&bed);
    (named(&row, "transport_rate"), curves)
}

#[test]
fn profiles_have_the_shear_and_the_fraction_of_a_lattice_and_carry_its_rate() {
    let o = BedLoadOptions {
        length: 8.0,
        width: 1.0,
        diameter: 1.0,
        ..options()
    };
    // Rows at 0.25, 1.25, 2.25 in layers of a half: every other one holds a row, the lowest begins at 0.
    let lift = |x: DVec2| x - DVec2::new(0.0, 0.25);
    let grains = lattice::<Plane>(1.0, [8.0, 1.0, 3.0], |_| 9.0);
    let (rate, curves) = sheared::<Plane>(o.clone(), grains.into_iter().map(lift).collect());
    let [speed, solid] = ["velocity_profile", "concentration_profile"]
        .map(|name| curves.iter().find(|c| c.figure == name).unwrap());
    assert_eq!(speed.axes[0], "height (m)");
    assert_eq!(speed.x, [0.25, 1.25, 2.25]);
    for (x, y) in speed.x.iter().zip(&speed.y) {
        assert!((y - 0.3 * x).abs() < 1e-12);
    }
    // π/4 of an area of a half.
    assert_eq!(solid.x, [-0.25, 0.25, 0.75, 1.25, 1.75, 2.25, 2.75]);
    for (k, y) in solid.y.iter().enumerate() {
        let expected = if k % 2 == 1 { FRAC_PI_2 } else { 0.0 };
        assert!((y - expected).abs() < 1e-6, "{y}");
    }
    // (π/6) · 8 · 0.3 (0.25 + 1.25 + 2.25)/(8 · 1).
    assert!((rate - 0.589_049).abs() < 1e-6);
    let flux: f64 = [0, 1, 2]
        .map(|k| speed.y[k] * solid.y[2 * k + 1] * 0.5)
        .iter()
        .sum();
    assert!((flux - 1.5 * rate).abs() < 1e-12);

    // In space, three grains wide: (π/6)/(1/2), and the profiles carry the rate itself.
    let o = BedLoadOptions { width: 3.0, ..o };
    let grains = lattice::<Space>(1.0, [8.0, 3.0, 3.0], |_| 9.0);
    let lift = |x: DVec3| x - DVec3::new(0.0, 0.0, 0.25);
    let (rate, curves) = sheared::<Space>(o, grains.into_iter().map(lift).collect());
    let [speed, solid] = ["velocity_profile", "concentration_profile"]
        .map(|name| curves.iter().find(|c| c.figure == name).unwrap());
    assert!((solid.y[1] - FRAC_PI_3).abs() < 1e-6);
    let flux: f64 = [0, 1, 2]
        .map(|k| speed.y[k] * solid.y[2 * k + 1] * 0.5)
        .iter()
        .sum();
    assert!((flux - rate).abs() < 1e-12 && (rate - 0.589_049).abs() < 1e-6);
}

#[test]
fn the_layers_are_the_mean_of_the_looks_and_a_grain_far_away_costs_nothing() {
    let (o, mut view) = of_one_grain();
    let mut bed = BedLoad::new(o);
    // Of the counted looks, from 2.25 s on, the grain is low at 3 and 4 s and high at 5 and 6 s.
    for (time, height, speed) in [
        (2.0, 0.1, 99.0),
        (3.0, 0.1, 1.0),
        (4.0, 0.2, 3.0),
        (5.0, 0.6, 5.0),
        (6.0, 1e12, 7.0),
    ] {
        view.time = time;
        view.grains[0].y = height;
        view.velocity = Box::new(move |_| DVec3::new(speed, 0.0, 0.0));
        bed.see(&view);
    }
    let curves = Observer::<Plane, Still>::curves(&bed);
    let [speed, solid] = ["velocity_profile", "concentration_profile"]
        .map(|name| curves.iter().find(|c| c.figure == name).unwrap());
    assert_eq!((speed.x.len(), &speed.y[..2]), (3, &[2.0, 5.0][..]));
    // π/4 over a half, seen in two looks of four and in one.
    assert!((solid.y[1] - PI / 4.0).abs() < 1e-12 && (solid.y[2] - PI / 8.0).abs() < 1e-12);
    assert_eq!(solid.x.len(), 7);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_grains_are_shared_out_to_classes_and_nothing_is_infinite(
        grains in prop::collection::vec((0.0..9.0f64, -3.0..9.0f64, 0.3..2.0f64, any::<bool>()), 0..30),
        shear in -2.0..2.0f64, lift in -5.0..5.0f64,
    ) {
        let o = BedLoadOptions { diameter: 2.0, sizes: vec![2.0, 1.0, 0.5], ..options() };
        let places = grains.iter().map(|g| DVec2::new(g.0, g.1)).collect();
        let mut view = Fake::<Plane>::of(1.0, places);
        view.kinds = grains.iter().map(|g| if g.3 { fixed(g.2) } else { Kind::sphere(g.2, 1e3) }).collect();
        view.pairs = (1..grains.len()).map(|i| (i - 1, i, 0.1)).collect();
        view.velocity = Box::new(move |x| DVec3::new(shear * x.z, 0.0, 0.0));
        let row = BedLoad::new(o.clone()).see(&view);
        let all = named(&row, "transport");
        let classes: f64 = ["transport_d1", "transport_d2", "transport_d3"].map(|n| named(&row, n)).iter().sum();
        prop_assert!((all - classes).abs() <= 1e-9 * all.abs().max(1.0));
        prop_assert!(row.iter().all(|r| !r.value.is_infinite()));
        prop_assert_eq!(named(&row, "moving_fraction").is_nan(), grains.iter().all(|g| g.3));
        // The other way round it carries as much back, and lifted by anything the bed lies higher by that.
        view.velocity = Box::new(move |x| DVec3::new(-shear * (x.z - lift), 0.0, 0.0));
        for x in &mut view.grains {
            x.y += lift;
        }
        let back = BedLoad::new(o).see(&view);
        prop_assert!((named(&back, "transport") + all).abs() <= 1e-9 * all.abs().max(1e3));
        for name in ["bed_height", "centre_of_mass"] {
            let (a, b) = (named(&row, name), named(&back, name));
            prop_assert!(a.is_nan() && b.is_nan() || (b - a - lift).abs() < 1e-9);
        }
    }
}
