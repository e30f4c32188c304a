//! Grains that no force moves: every observer says the same with and without them.

mod common;

use common::{Fake, body, lattice, named};
use glam::DVec2;
use tsubu_measure::{
    Balance, BedLoad, BedLoadOptions, Deposit, Energy, Flow, Heap, HeapOptions, Loads, Profile,
    ProfileOptions, Slices, Structure,
};
use tsubu_model::{Kind, Observer, Plane, Reading, Space, Still};

/// Of infinite mass, of a weight that must not be asked, larger than all others.
fn fixed() -> Kind {
    Kind {
        radius: 2.0,
        weight: 1e6,
        ..Kind::immovable()
    }
}

/// A heap on a floor that carries it.
fn heap<D: Slices>() -> Fake<D> {
    let grains = lattice::<D>(1.0, [20.0, 6.0, 10.0], |x| 10.0 - 0.4 * x);
    let mut view = Fake::<D>::of(1.0, grains);
    view.pairs = vec![(0, 1, 0.01), (1, 2, 0.02), (2, 0, 0.03)];
    let weight = view.kinds.iter().map(|kind| kind.mass).sum::<f64>() * 9.81;
    let down = D::from_space(glam::DVec3::NEG_Z * weight);
    view.bodies = vec![body("floor", down, None)];
    view
}

/// The same with a fixed row below, one fixed grain far above, and fixed ones inside that overlap each other by half.
fn with_fixed<D: Slices>() -> Fake<D> {
    let mut view = heap::<D>();
    let row = (0..20).map(|i| glam::DVec3::new(f64::from(i) + 0.5, 0.5, -0.5));
    let more = [(3.0, 90.0), (5.0, 3.0), (5.1, 3.0)].map(|(x, z)| glam::DVec3::new(x, 0.5, z));
    for place in row.chain(more) {
        view.grains.push(D::from_space(place));
        view.kinds.push(fixed());
    }
    let last = view.grains.len() - 1;
    view.pairs.push((last - 1, last, 2.0));
    view
}

fn observers<D: Slices>() -> Vec<Box<dyn Observer<D, Still>>> {
    vec![
        Box::new(Heap::new(HeapOptions {
            diameter: 1.0,
            depth: Some(6.0),
            back: 0.0,
            far: None,
            release: None,
            snapshots: vec![0.0],
        })),
        Box::new(Structure::new(Some(6.0))),
        Box::new(Balance::new()),
        Box::new(Energy::new()),
        Box::new(Loads::new(vec![true])),
        Box::new(BedLoad::new(BedLoadOptions {
            length: 20.0,
            width: 6.0,
            diameter: 1.0,
            unit: 1.0,
            shields: 0.1,
            expected: vec![("one", 1.0)],
            begins: 0.0,
            skip: 0.0,
            moving_speed: 0.1,
            sizes: vec![1.0, 4.0],
        })),
    ]
}

/// Ten looks: the last row and the report.
fn seen<D: Slices>(observer: &mut dyn Observer<D, Still>, mut view: Fake<D>) -> Vec<Reading> {
    let mut row = Vec::new();
    for k in 0..10 {
        view.time = f64::from(k);
        row = observer.see(&view);
    }
    row.extend(observer.report());
    row
}

fn say_the_same<D: Slices>() {
    for (mut a, mut b) in observers::<D>().into_iter().zip(observers::<D>()) {
        let without = seen(&mut *a, heap::<D>());
        let with = seen(&mut *b, with_fixed::<D>());
        // What has no value with them has none without them either.
        for (a, b) in without.iter().zip(&with) {
            assert_eq!(a.name, b.name);
            assert!(
                a.value == b.value || a.value.is_nan() && b.value.is_nan(),
                "{a:?} {b:?}"
            );
            assert_eq!(a.uncertainty, b.uncertainty, "{}", a.name);
            assert!(!b.value.is_infinite());
        }
        assert_eq!(without.len(), with.len());
        assert_eq!(a.curves(), b.curves());
    }
    let options = ProfileOptions {
        bin: 1.0,
        origin: 0.0,
        depth: Some(6.0),
    };
    let (a, b) = (heap::<D>(), with_fixed::<D>());
    assert_eq!(Profile::of(&a, options), Profile::of(&b, options));
    assert_eq!(Deposit::of(&a, Some(6.0)), Deposit::of(&b, Some(6.0)));
}

#[test]
fn every_observer_says_the_same_with_and_without_fixed_grains() {
    say_the_same::<Plane>();
    say_the_same::<Space>();
}

#[test]
fn what_lies_on_a_fixed_row_is_not_borne_by_bodies() {
    let mut view = with_fixed::<Plane>();
    view.bodies[0].force *= 0.25;
    let row = Observer::<Plane, Still>::see(&mut Balance::new(), &view);
    assert!((named(&row, "support") - 0.25).abs() < 1e-12);
    assert!(named(&row, "momentum_x").is_finite());
}

#[test]
fn a_contact_with_a_fixed_grain_is_one_of_the_other_grain_and_one_between_two_is_none() {
    // Two grains and two fixed ones: overlaps of 0.1 and 0.3 over the radii 0.5 + 2, and 2.0 that nothing presses.
    let mut view = Fake::<Plane>::of(1.0, (0..4).map(|i| DVec2::new(f64::from(i), 0.0)).collect());
    view.kinds[2] = fixed();
    view.kinds[3] = fixed();
    view.pairs = vec![(0, 2, 0.1), (3, 0, 0.3), (2, 3, 2.0)];
    let row = Observer::<Plane, Still>::see(&mut Structure::new(None), &view);
    for (name, expected) in [
        ("overlap_max", 0.12),
        ("overlap_mean", 0.08),
        // Two contacts of one grain of two.
        ("coordination", 1.0),
        ("coordination_bearing", 2.0),
    ] {
        assert!((named(&row, name) - expected).abs() < 1e-12, "{name}");
    }
}

#[test]
fn nothing_but_fixed_grains_weighs_nothing_and_nothing_is_infinite() {
    let mut view = with_fixed::<Space>();
    view.kinds.fill(fixed());
    for mut observer in observers::<Space>() {
        let all = seen(&mut *observer, with_fixed::<Space>());
        assert!(all.iter().all(|r| !r.value.is_infinite()));
        for reading in observer.see(&view) {
            assert!(!reading.value.is_infinite(), "{reading:?}");
        }
    }
    let row = Observer::<Space, Still>::see(&mut Balance::new(), &view);
    assert!(named(&row, "support").is_nan());
    assert_eq!(named(&row, "momentum_x"), 0.0);
    let row = Observer::<Space, Still>::see(&mut Flow::new(), &view);
    assert_eq!(named(&row, "grains"), view.grains.len() as f64);
}
