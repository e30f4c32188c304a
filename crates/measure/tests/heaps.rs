//! Heaps of known shape: what the measures say of them against their geometry.

mod common;

use std::f64::consts::PI;

use common::{Fake, body, lattice, named, random_fill};
use glam::{DVec2, DVec3};
use tsubu_measure::slope::{Measured, Stand, crest_height, flank_angle, front, runout_angle};
use tsubu_measure::{Deposit, Heap, HeapOptions, Profile, ProfileOptions, Slices};
use tsubu_model::{Observer, Plane, Space, Still};

/// Everything about a heap against a wall at x = 0.
struct Found {
    profile: Profile,
    flank: Measured,
    runout: Measured,
    front: f64,
}

fn measure<D: Slices>(
    view: &Fake<D>,
    d: f64,
    depth: Option<f64>,
    back: f64,
    far: Option<f64>,
) -> Found {
    let profile = Profile::of(
        view,
        ProfileOptions {
            bin: d,
            origin: back,
            depth,
        },
    );
    let stand = Stand {
        diameter: d,
        back,
        far,
    };
    Found {
        flank: flank_angle(&profile, &stand),
        runout: runout_angle(&profile, &stand),
        front: front(&profile, &stand).value,
        profile,
    }
}

/// A straight flank: height at the wall `h`, falling at `angle` degrees.
fn wedge(h: f64, angle: f64) -> ([f64; 3], impl Fn(f64) -> f64) {
    let t = angle.to_radians().tan();
    ([h / t, 8.0, h], move |x| h - t * x)
}

fn sigma(m: Measured) -> f64 {
    m.uncertainty.expect("a resolved flank has an uncertainty")
}

#[test]
fn a_wedge_of_random_grains_has_its_angle() {
    for angle in [12.0, 20.0, 30.0] {
        let (size, surface) = wedge(22.0, angle);
        let space = Fake::<Space>::of(1.0, random_fill::<Space>(1, 1.0, size, &surface));
        let plane = Fake::<Plane>::of(1.0, random_fill::<Plane>(2, 1.0, size, &surface));
        for found in [
            measure(&space, 1.0, Some(8.0), 0.0, None),
            measure(&plane, 1.0, None, 0.0, None),
        ] {
            println!(
                "{angle}: flank {:.2} ± {:.2}, run-out {:.2} ± {:.2}, front {:.2}, crest {:.2}, bulk {:.4} ± {:.4}",
                found.flank.value,
                sigma(found.flank),
                found.runout.value,
                sigma(found.runout),
                found.front,
                crest_height(&found.profile),
                found.profile.bulk_fraction,
                found.profile.bulk_uncertainty
            );
            assert!((found.flank.value - angle).abs() < 1.0);
            assert!((found.flank.value - angle).abs() < 3.0 * sigma(found.flank));
            // The height at the wall of such a loose plane fill is rough: a degree or two sigma.
            assert!((found.runout.value - angle).abs() < (2.0 * sigma(found.runout)).max(1.0));
            let toe = (22.0 - 0.5) / angle.to_radians().tan();
            // The height at the front is known to a good half of a grain.
            assert!(
                (found.front - toe).abs() * angle.to_radians().tan() < 0.6,
                "front {} toe {toe}",
                found.front
            );
        }
    }
}

#[test]
fn a_wedge_of_a_lattice_has_its_angle_and_its_solid_fraction() {
    for angle in [15.0, 20.0, 27.0] {
        let (size, surface) = wedge(24.0, angle);
        let space = measure(
            &Fake::<Space>::of(1.0, lattice::<Space>(1.0, size, &surface)),
            1.0,
            Some(8.0),
            0.0,
            None,
        );
        let plane = measure(
            &Fake::<Plane>::of(1.0, lattice::<Plane>(1.0, size, &surface)),
            1.0,
            None,
            0.0,
            None,
        );
        // Spheres in cubes and discs in squares: π/6 and π/4.
        assert!((space.profile.bulk_fraction - PI / 6.0).abs() < 1e-6);
        assert!((plane.profile.bulk_fraction - PI / 4.0).abs() < 1e-6);
        for found in [space, plane] {
            println!(
                "{angle}: flank {:.2} ± {:.2}, run-out {:.2}",
                found.flank.value,
                sigma(found.flank),
                found.runout.value
            );
            assert!((found.flank.value - angle).abs() < 1.0);
            assert!((found.runout.value - angle).abs() < 1.0);
        }
    }
}

#[test]
fn a_hexagonal_packing_off_the_cells_has_its_solid_fraction() {
    // Discs touching six others: π/(2√3) = 0.9069, with an origin and orientation that no cell fits.
    let (sin, cos) = 0.3f64.sin_cos();
    let mut grains = Vec::new();
    for i in -60..60 {
        for k in -60..60 {
            let p = DVec2::new(
                f64::from(i) + 0.5 * f64::from(k),
                f64::from(k) * 0.75f64.sqrt(),
            );
            let p = DVec2::new(cos * p.x - sin * p.y + 0.37, sin * p.x + cos * p.y + 0.11);
            if p.x > 0.0 && p.x < 40.0 && p.y > 0.0 && p.y < 20.0 {
                grains.push(p);
            }
        }
    }
    let deposit = Deposit::of(&Fake::<Plane>::of(1.0, grains), None);
    println!("{} ± {}", deposit.bulk_fraction, deposit.bulk_uncertainty);
    assert!((deposit.bulk_fraction - 0.9069).abs() < 2e-3);
}

#[test]
fn a_coarse_wedge_has_the_same_angle_within_its_uncertainty() {
    let (size, surface) = wedge(40.0, 20.0);
    let mut deviation = Vec::new();
    for seed in 0..3 {
        for d in [1.0, 2.0, 4.0] {
            let view = Fake::<Space>::of(d, random_fill::<Space>(seed, d, size, &surface));
            let found = measure(&view, d, Some(8.0), 0.0, None);
            println!(
                "d {d}: {:.2} ± {:.2}, {:.2} ± {:.2}",
                found.flank.value,
                sigma(found.flank),
                found.runout.value,
                sigma(found.runout)
            );
            deviation.push((found.flank.value - 20.0) / sigma(found.flank));
            assert!((found.runout.value - 20.0).abs() < 3.0 * sigma(found.runout).max(0.3));
        }
    }
    println!("{deviation:.1?}");
    assert!(deviation.iter().all(|z| z.abs() < 3.0));
}

#[test]
fn the_stated_uncertainty_is_the_scatter_of_many_fills() {
    let (size, surface) = wedge(20.0, 20.0);
    let found: Vec<Found> = (100..200)
        .map(|seed| {
            measure(
                &Fake::<Plane>::of(1.0, random_fill::<Plane>(seed, 1.0, size, &surface)),
                1.0,
                None,
                0.0,
                None,
            )
        })
        .collect();
    for (method, of) in [
        ("flank", found.iter().map(|f| f.flank).collect::<Vec<_>>()),
        ("run-out", found.iter().map(|f| f.runout).collect()),
    ] {
        let n = of.len() as f64;
        let mean = of.iter().map(|m| m.value).sum::<f64>() / n;
        let scatter = (of.iter().map(|m| (m.value - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        let stated = (of.iter().map(|m| sigma(*m).powi(2)).sum::<f64>() / n).sqrt();
        println!("{method}: {mean:.3}, scatter {scatter:.3}, stated {stated:.3}");
        // No bias beyond the noise of the mean and a tenth of a degree; the error is honest within half.
        assert!(
            (mean - 20.0).abs() < 2.0 * scatter / n.sqrt() + 0.1,
            "{method} {mean}"
        );
        assert!(
            stated > 0.67 * scatter && stated < 1.5 * scatter,
            "{method} {stated} {scatter}"
        );
    }
}

#[test]
fn a_flat_bed_to_the_opposite_wall_is_level() {
    let view = Fake::<Space>::of(
        1.0,
        random_fill::<Space>(3, 1.0, [40.0, 8.0, 12.0], |_| 12.0),
    );
    let found = measure(&view, 1.0, Some(8.0), 0.0, Some(40.0));
    println!("{:.2} ± {:.2}", found.flank.value, sigma(found.flank));
    assert!(found.flank.value.abs() < 1.0);
    assert!(found.runout.value.is_nan(), "nothing ran out");
    assert!((found.front - 40.0).abs() < 0.5);
}

#[test]
fn a_step_is_steep_and_its_height_is_right() {
    let view = Fake::<Space>::of(1.0, lattice::<Space>(1.0, [20.0, 8.0, 20.0], |_| 20.0));
    let found = measure(&view, 1.0, Some(8.0), 0.0, None);
    assert!(
        found.flank.value > 80.0 && found.flank.value < 90.0,
        "{:?}",
        found.flank
    );
    assert!((found.front - 20.0).abs() < 1.0);
    // A full lattice fills its box: each bin stands at 20 exactly.
    assert!(found.profile.height.iter().all(|h| (h - 20.0).abs() < 1e-9));
}

#[test]
fn stray_grains_and_gas_change_nothing() {
    let (size, surface) = wedge(20.0, 20.0);
    let grains = random_fill::<Space>(4, 1.0, size, &surface);
    let quiet = measure(
        &Fake::<Space>::of(1.0, grains.clone()),
        1.0,
        Some(8.0),
        0.0,
        None,
    );
    let mut with_gas = grains.clone();
    with_gas.extend([
        DVec3::new(75.0, 4.0, 0.5),
        DVec3::new(1e9, 4.0, 40.0),
        DVec3::new(f64::NAN, 0.0, 0.0),
    ]);
    with_gas.extend((0..30).map(|i| {
        DVec3::new(
            f64::from(i) * 2.0,
            f64::from(i * 5 % 8),
            26.0 + f64::from(i * 7 % 11),
        )
    }));
    let view = Fake::<Space>::of(1.0, with_gas);
    assert_eq!(Deposit::of(&view, Some(8.0)).left_out, 33);
    let noisy = measure(&view, 1.0, Some(8.0), 0.0, None);
    assert_eq!(quiet.profile, noisy.profile);
    assert_eq!((quiet.front, quiet.flank), (noisy.front, noisy.flank));

    // A thin gas that begins at the toe is not a bridge to anything: only its first grains count.
    let mut with_gas = grains.clone();
    with_gas
        .extend((0..20).map(|i| DVec3::new(54.0 + 2.0 * f64::from(i), f64::from(i * 5 % 8), 0.5)));
    let view = Fake::<Space>::of(1.0, with_gas);
    assert!(Deposit::of(&view, Some(8.0)).left_out >= 16);
    let noisy = measure(&view, 1.0, Some(8.0), 0.0, None);
    assert!((quiet.front - noisy.front).abs() < 0.3);
    assert!((quiet.flank.value - noisy.flank.value).abs() < 1e-9);

    // In the plane one grain fills a cell, and still it is not the deposit.
    let mut grains = lattice::<Plane>(1.0, size, &surface);
    let quiet = measure(
        &Fake::<Plane>::of(1.0, grains.clone()),
        1.0,
        None,
        0.0,
        None,
    );
    grains.push(DVec2::new(62.0, 0.5));
    assert_eq!(
        quiet.front,
        measure(&Fake::<Plane>::of(1.0, grains), 1.0, None, 0.0, None).front
    );
}

#[test]
fn a_mirrored_heap_and_a_shifted_one_have_the_same_angle() {
    let (size, surface) = wedge(20.0, 22.0);
    let grains = random_fill::<Space>(5, 1.0, size, &surface);
    let here = measure(
        &Fake::<Space>::of(1.0, grains.clone()),
        1.0,
        Some(8.0),
        0.0,
        None,
    );
    // Whole cells of two diameters, so that the same cells are cut.
    let mirrored: Vec<DVec3> = grains.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
    let there = measure(&Fake::<Space>::of(1.0, mirrored), 1.0, Some(8.0), 0.0, None);
    assert!((here.flank.value - there.flank.value).abs() < 1e-9);
    assert!((here.runout.value - there.runout.value).abs() < 1e-9);
    assert!((here.front + there.front).abs() < 1e-9);
    let shifted: Vec<DVec3> = grains
        .iter()
        .map(|p| *p + DVec3::new(100.3, 0.0, -7.7))
        .collect();
    let there = measure(
        &Fake::<Space>::of(1.0, shifted),
        1.0,
        Some(8.0),
        100.3,
        None,
    );
    println!("{:?} {:?}", here.flank, there.flank);
    assert!((here.flank.value - there.flank.value).abs() < 2.0 * sigma(here.flank));
}

#[test]
fn a_walled_slot_takes_its_depth_from_the_grains() {
    let view = Fake::<Space>::of(1.0, lattice::<Space>(1.0, [20.0, 6.0, 10.0], |_| 10.0));
    assert!((Deposit::of(&view, None).depth - 6.0).abs() < 1e-12);
    assert!((Deposit::of(&view, Some(12.0)).bulk_fraction - PI / 12.0).abs() < 1e-6);
}

fn heap(release: Option<&str>) -> Heap {
    let release = release.map(str::to_owned);
    Heap::new(HeapOptions {
        diameter: 1.0,
        depth: Some(8.0),
        back: 0.0,
        far: None,
        release,
        snapshots: vec![0.5, 0.1],
    })
}

#[test]
fn the_observer_starts_its_clock_at_the_release() {
    let (size, surface) = wedge(20.0, 20.0);
    let mut view = Fake::<Space>::of(1.0, random_fill::<Space>(6, 1.0, size, &surface));
    view.bodies.push(body("gate", DVec3::ZERO, None));
    let mut heap = heap(Some("gate"));
    let heap: &mut dyn Observer<Space, Still> = &mut heap;
    view.time = 1.0;
    let before = heap.see(&view);
    for name in ["time_since_release", "angle_flank", "angle_runout"] {
        assert!(named(&before, name).is_nan(), "{name}");
    }
    assert!(named(&before, "front") > 0.0 && named(&before, "crest_height") > 19.0);
    assert_eq!(heap.curves()[0].label, "before the removal of gate");

    view.bodies[0].removed_at = Some(1.0);
    for time in [1.0, 1.1, 1.2, 1.6, 2.0] {
        view.time = time;
        let row = heap.see(&view);
        assert_eq!(
            row.iter().map(|r| &r.name).collect::<Vec<_>>(),
            before.iter().map(|r| &r.name).collect::<Vec<_>>()
        );
    }
    let labels: Vec<String> = heap.curves().into_iter().map(|c| c.label).collect();
    assert_eq!(
        labels,
        ["0.10", "0.60", "1.00"].map(|t| format!(
            "{t} s after the removal of gate{}",
            if t == "1.00" { " (end)" } else { "" }
        ))
    );
    let report = heap.report();
    assert!((named(&report, "angle_of_repose") - 20.0).abs() < 1.0);
    assert!(report[0].uncertainty.is_some_and(|u| u > 0.0 && u < 1.0));
    assert_eq!(named(&report, "time_since_release"), 1.0);
    // Centre of mass of a triangle: a third of its sides.
    assert!((named(&report, "centre_of_mass_x") - size[0] / 3.0).abs() < 0.3);
    assert!((named(&report, "centre_of_mass_z") - 20.0 / 3.0).abs() < 0.2);
}

#[test]
fn without_a_release_the_clock_of_the_simulation_runs() {
    let mut view = Fake::<Plane>::of(
        1.0,
        lattice::<Plane>(1.0, [20.0, 1.0, 8.0], |x| 8.0 - 0.4 * x),
    );
    view.time = 0.25;
    let mut heap = heap(None);
    let row = Observer::<Plane, Still>::see(&mut heap, &view);
    assert_eq!(named(&row, "time_since_release"), 0.25);
    assert!(named(&row, "angle_flank") > 15.0);
}
