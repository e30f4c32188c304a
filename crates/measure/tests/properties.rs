//! Properties that hold for any heap.

mod common;

use common::{Dice, Fake, body, lattice, named, random_fill};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use tsubu_measure::slope::{Stand, crest_height, flank_angle, front, runout_angle};
use tsubu_measure::{Balance, Deposit, Line, Profile, ProfileOptions, Structure};
use tsubu_model::{Dim, Kind, Observer, Plane, Space, Still, Vector};

fn options(bin: f64) -> ProfileOptions {
    ProfileOptions {
        bin,
        origin: 0.0,
        depth: Some(6.0),
    }
}

/// Finds the pairs whose centres are closer than the sum of radii, one by one.
fn with_contacts<D: Dim>(mut view: Fake<D>) -> Fake<D> {
    for i in 0..view.grains.len() {
        for j in i + 1..view.grains.len() {
            let apart = (view.grains[i] - view.grains[j]).length();
            let overlap = view.kinds[i].radius + view.kinds[j].radius - apart;
            if overlap > 0.0 {
                view.pairs.push((i, j, overlap));
            }
        }
    }
    view
}

/// A shuffle by sorting on random numbers.
fn shuffled<T: Clone>(list: &[T], seed: u64) -> Vec<T> {
    let mut dice = Dice(seed);
    let mut keyed: Vec<(f64, T)> = list.iter().map(|v| (dice.next(), v.clone())).collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    keyed.into_iter().map(|(_, v)| v).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_profile_holds_the_content_of_its_grains(seed in 0u64..1000, bin in 0.3..3.0f64, h in 6.0..12.0f64, slope in 0.1..1.0f64) {
        let grains = random_fill::<Space>(seed, 1.0, [20.0, 6.0, h], |x| h - slope * x);
        let view = Fake::<Space>::of(1.0, grains);
        let deposit = Deposit::of(&view, Some(6.0));
        let profile = Profile::of(&view, options(bin));
        // Volume of a sphere of diameter 1: π/6.
        let volume = deposit.grains.len() as f64 * std::f64::consts::PI / 6.0;
        prop_assert!((profile.area() * 6.0 * profile.bulk_fraction / volume - 1.0).abs() < 1e-12);
        prop_assert!(deposit.grains.len() + deposit.left_out == view.grains.len());
    }

    #[test]
    fn the_order_of_grains_in_memory_does_not_matter(seed in 0u64..1000, shuffle in 0u64..1000) {
        let grains = random_fill::<Space>(seed, 1.0, [24.0, 6.0, 9.0], |x| 9.0 - 0.4 * x);
        let (a, b) = (Fake::<Space>::of(1.0, grains.clone()), Fake::<Space>::of(1.0, shuffled(&grains, shuffle)));
        let (p, q) = (Profile::of(&a, options(1.0)), Profile::of(&b, options(1.0)));
        prop_assert_eq!(p.x, q.x);
        prop_assert!((p.bulk_fraction - q.bulk_fraction).abs() < 1e-12);
        for (h, k) in p.height.iter().zip(&q.height) {
            prop_assert!((h - k).abs() < 1e-12 * 9.0);
        }
        let (p, q) = (Deposit::of(&a, Some(6.0)), Deposit::of(&b, Some(6.0)));
        prop_assert!((p.centre_x - q.centre_x).abs() < 1e-12 * 24.0 && (p.centre_z - q.centre_z).abs() < 1e-12 * 9.0);
    }

    #[test]
    fn any_scatter_of_grains_has_a_profile_without_nan(
        places in prop::collection::vec((-20.0..20.0f64, 0.0..10.0f64, 0.2..2.0f64), 1..40),
        back in -30.0..30.0f64,
    ) {
        let mut view = Fake::<Plane>::of(1.0, places.iter().map(|p| DVec2::new(p.0, p.1)).collect());
        view.kinds = places.iter().map(|p| Kind::sphere(p.2, 1000.0)).collect();
        let profile = Profile::of(&view, options(1.0));
        prop_assert!(profile.height.iter().all(|h| h.is_finite() && *h >= 0.0));
        prop_assert!(profile.bulk_fraction > 0.0 && crest_height(&profile) > 0.0);
        for far in [None, Some(30.0), Some(-30.0)] {
            let stand = Stand { diameter: 1.0, back, far };
            for angle in [flank_angle(&profile, &stand), runout_angle(&profile, &stand)] {
                prop_assert!(angle.value.is_nan() || angle.value.abs() <= 90.0);
                prop_assert!(angle.uncertainty.is_none_or(|u| u.is_finite() && u >= 0.0));
            }
            prop_assert!(!front(&profile, &stand).value.is_infinite());
        }
    }

    #[test]
    fn a_line_is_found_again(slope in -5.0..5.0f64, intercept in -5.0..5.0f64, n in 3usize..30) {
        let x: Vec<f64> = (0..n).map(|i| i as f64 * 0.5).collect();
        let y: Vec<f64> = x.iter().map(|x| intercept + slope * x).collect();
        let line = Line::fit(&x, &y).unwrap();
        prop_assert!((line.slope - slope).abs() < 1e-9 && (line.intercept - intercept).abs() < 1e-9);
        prop_assert!(line.slope_error.unwrap() < 1e-9);
    }
}

#[test]
fn nothing_is_measured_of_nothing() {
    let view = Fake::<Space>::of(1.0, Vec::new());
    let deposit = Deposit::of(&view, None);
    assert!(deposit.bulk_fraction.is_nan() && deposit.centre_x.is_nan() && deposit.content == 0.0);
    let profile = Profile::of(&view, options(1.0));
    assert!(profile.x.is_empty() && crest_height(&profile).is_nan());
    let stand = Stand {
        diameter: 1.0,
        back: 0.0,
        far: None,
    };
    assert!(
        flank_angle(&profile, &stand).value.is_nan()
            && runout_angle(&profile, &stand).value.is_nan()
    );
    let mut structure = Structure::new(None);
    let row = Observer::<Space, Still>::see(&mut structure, &view);
    assert_eq!(row.len(), 5);
    assert_eq!(named(&row, "overlap_max"), 0.0);
}

#[test]
fn a_bin_that_is_none_gives_no_profile() {
    let view = Fake::<Space>::of(1.0, vec![DVec3::ZERO; 3]);
    for bin in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Profile::of(&view, options(bin)).x.is_empty());
    }
    assert!(Profile::of(&view, options(1e-30)).x.len() <= 100_002);
}

#[test]
fn a_lattice_has_the_coordination_of_its_lattice() {
    // Simple cubic, squeezed by one in a thousand: 6 contacts; square: 4. Overlap 0.001 of the diameter.
    let shrink = |p: DVec3| p * 0.999;
    let cubic: Vec<DVec3> = lattice::<Space>(1.0, [12.0, 12.0, 12.0], |_| 12.0)
        .into_iter()
        .map(shrink)
        .collect();
    // Contacts across the period are those of the first and last layer along y.
    let mut view = with_contacts(Fake::<Space>::of(1.0, cubic));
    for i in 0..view.grains.len() {
        for j in 0..view.grains.len() {
            let apart = view.grains[i] - view.grains[j];
            if apart.y > 10.0 && apart.x.abs() + apart.z.abs() < 0.1 {
                view.pairs.push((i, j, 0.001));
            }
        }
    }
    let row = Observer::<Space, Still>::see(&mut Structure::new(Some(12.0 * 0.999)), &view);
    assert_eq!(named(&row, "coordination"), 6.0);
    assert_eq!(named(&row, "coordination_bearing"), 6.0);
    assert!(
        (named(&row, "overlap_max") - 0.001).abs() < 1e-9
            && (named(&row, "overlap_mean") - 0.001).abs() < 1e-9
    );
    assert!(
        (named(&row, "packing_fraction") - std::f64::consts::FRAC_PI_6 / 0.999f64.powi(3)).abs()
            < 2e-3
    );

    let square = lattice::<Plane>(1.0, [20.0, 1.0, 20.0], |_| 20.0)
        .into_iter()
        .map(|p| p * 0.999)
        .collect();
    let mut view = with_contacts(Fake::<Plane>::of(1.0, square));
    let mut structure = Structure::new(None);
    assert_eq!(
        named(
            &Observer::<Plane, Still>::see(&mut structure, &view),
            "coordination"
        ),
        4.0
    );
    // A rattler in the middle: its four neighbours keep three contacts, it has none.
    let middle = 10 * 20 + 10;
    view.pairs.retain(|p| p.0 != middle && p.1 != middle);
    let row = Observer::<Plane, Still>::see(&mut structure, &view);
    let inside = Deposit::of(&view, None).inside.len() as f64;
    assert!((named(&row, "coordination") - (4.0 - 8.0 / inside)).abs() < 1e-12);
    assert!(
        (named(&row, "coordination_bearing") - (4.0 * (inside - 1.0) - 4.0) / (inside - 1.0)).abs()
            < 1e-12
    );
    assert_eq!(Observer::<Plane, Still>::report(&structure), row);
}

#[test]
fn a_frozen_floor_is_not_part_of_the_deposit() {
    let mut view = Fake::<Plane>::of(1.0, lattice::<Plane>(1.0, [20.0, 1.0, 11.0], |_| 11.0));
    for (kind, place) in view.kinds.iter_mut().zip(&view.grains) {
        if place.y < 1.0 {
            *kind = Kind {
                radius: 0.5,
                ..Kind::immovable()
            };
        }
    }
    let profile = Profile::of(&view, options(1.0));
    assert!(profile.height.iter().all(|h| (h - 10.0).abs() < 1e-9));
}

#[test]
fn the_floor_carries_the_grains() {
    let mut view = Fake::<Plane>::of(1.0, vec![DVec2::new(0.0, 0.5), DVec2::new(2.0, 0.5)]);
    let weight = 2.0 * 1000.0 * std::f64::consts::PI / 6.0 * 9.81;
    view.bodies = vec![
        body("b", DVec2::new(3.0, -weight), None),
        body("b", DVec2::new(7.0, 7.0), Some(0.5)),
    ];
    let mut balance = Balance::new();
    let row = Observer::<Plane, Still>::see(&mut balance, &view);
    assert!((named(&row, "support") - 1.0).abs() < 1e-12);
    assert_eq!(named(&row, "force_on_bodies_x"), 3.0);
    assert!((named(&row, "momentum_x") - 2.0 * weight / 9.81).abs() < 1e-9);
    assert_eq!(Observer::<Plane, Still>::report(&balance).len(), 1);
}
