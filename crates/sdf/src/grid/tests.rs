//! Whole grids against analytic distances: error, order, signs, bounds, threads.

use super::*;
use crate::mesh::samples::{self, Random};
use tsubu_model::{HitBuffer, Space, Surface};

fn build(mesh: &Mesh, cell: f64) -> DistanceGrid {
    DistanceGrid::build(mesh, &GridOptions::new(cell, 0.25), &|_| ()).unwrap()
}

fn box_distance(x: DVec3, half: DVec3) -> f64 {
    let q = x.abs() - half;
    q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
}

fn torus_distance(x: DVec3, major: f64, minor: f64) -> f64 {
    (x.truncate().length() - major).hypot(x.z) - minor
}

/// Root mean square and largest error of the interpolant at random points of the band.
fn errors(grid: &DistanceGrid, points: usize, truth: impl Fn(DVec3) -> Option<f64>) -> (f64, f64) {
    let mut random = Random::new(1);
    let [low, high] = grid.body_box.map(|x| x * 1.2);
    let (mut sum, mut most, mut count) = (0.0, 0.0f64, 0);
    while count < points {
        let x = random.within(low, high);
        if let (Some(truth), Some((value, _))) = (truth(x), grid.value_and_gradient(x)) {
            let error = (value - truth).abs();
            (sum, most, count) = (sum + error * error, most.max(error), count + 1);
        }
    }
    ((sum / count as f64).sqrt(), most)
}

/// Stated before looking: away from edges the error falls as cell², so halving the cell divides it by
/// four; between 3 and 5 passes. The meshes are fine enough that theirs does not count.
#[test]
fn the_error_falls_as_the_square_of_the_cell() {
    let ball = samples::ball(0.5, 160);
    let near_ball = |x: DVec3| Some(x.length() - 0.5).filter(|d| d.abs() < 0.15);
    let torus = samples::torus(0.5, 0.2, 200);
    let near_torus = |x: DVec3| Some(torus_distance(x, 0.5, 0.2)).filter(|d| d.abs() < 0.12);
    for (mesh, truth) in [
        (&ball, &near_ball as &dyn Fn(DVec3) -> Option<f64>),
        (&torus, &near_torus),
    ] {
        let coarse = errors(&build(mesh, 0.08), 20_000, truth);
        let fine = errors(&build(mesh, 0.04), 20_000, truth);
        println!(
            "rms {:.3e} -> {:.3e}, largest {:.3e} -> {:.3e}",
            coarse.0, fine.0, coarse.1, fine.1
        );
        let ratio = coarse.0 / fine.0;
        assert!((3.0..5.0).contains(&ratio), "{ratio}");
        // h² times the larger curvature, 2 or 5 per metre near the surface more, over 4.
        assert!(fine.1 < 0.04f64.powi(2) * 10.0 / 4.0, "{}", fine.1);
    }
}

#[test]
fn a_box_is_exact_off_its_edges_and_within_half_a_cell_at_them() {
    let half = DVec3::new(0.5, 0.4, 0.3);
    let grid = build(&samples::cuboid(2.0 * half, 8), 0.04);
    let flat = |x: DVec3| {
        // Outside, in front of a face, a cell away from the edges' planes.
        let q = x.abs() - half;
        let inner = q.to_array().iter().filter(|q| **q < -0.07).count();
        Some(box_distance(x, half)).filter(|d| inner == 2 && (0.0..0.2).contains(d))
    };
    let (_, most) = errors(&grid, 5000, flat);
    assert!(most < 1e-6, "{most}");
    let all = |x: DVec3| Some(box_distance(x, half)).filter(|d| d.abs() < 0.2);
    let (rms, most) = errors(&grid, 50_000, all);
    println!(
        "box: rms {:.3} cells, largest {:.3} cells",
        rms / 0.04,
        most / 0.04
    );
    assert!(most < 0.5 * 0.04, "{most}");
}

/// Points more than a cell from the surface at which the sign is wrong.
fn wrong_signs(mesh: &Mesh, truth: impl Fn(DVec3) -> f64) -> usize {
    let grid = build(mesh, 0.04);
    let mut random = Random::new(2);
    let [low, high] = grid.body_box.map(|x| x * 1.3);
    let (mut wrong, mut count) = (0, 0);
    while count < 100_000 {
        let x = random.within(low, high);
        let distance = truth(x);
        if distance.abs() > 0.04 {
            count += 1;
            let value = grid.value_and_gradient(x).map_or(1.0, |v| v.0);
            wrong += usize::from((value < 0.0) != (distance < 0.0));
        }
    }
    wrong
}

#[test]
fn signs_are_right_on_clean_and_on_bad_meshes() {
    let torus = samples::torus(0.5, 0.2, 80);
    let truth = |x: DVec3| torus_distance(x, 0.5, 0.2);
    assert_eq!(wrong_signs(&torus, truth), 0);
    assert_eq!(
        wrong_signs(&samples::with_holes(torus.clone(), 0.01), truth),
        0
    );
    let mut inside_out = torus.clone();
    inside_out.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    assert_eq!(wrong_signs(&inside_out, truth), 0);
    // Inside out and with holes cannot be turned by its volume: the winding number's size still tells.
    assert_eq!(
        wrong_signs(&samples::with_holes(inside_out, 0.01), truth),
        0
    );
    let half = DVec3::new(0.7, 0.15, 0.15);
    let mut overlapping = torus;
    samples::append(&mut overlapping, &samples::cuboid(2.0 * half, 9));
    assert_eq!(
        wrong_signs(&overlapping, |x| truth(x).min(box_distance(x, half))),
        0
    );
}

#[test]
fn the_bound_is_never_above_the_distance_and_is_of_use() {
    let half = DVec3::new(0.5, 0.4, 0.3);
    let torus = build(&samples::torus(0.5, 0.2, 200), 0.05);
    let cuboid = build(&samples::cuboid(2.0 * half, 6), 0.05);
    let mut random = Random::new(4);
    let mut slack = 0.0;
    for _ in 0..50_000 {
        let x = 2.0 * random.vector();
        // The mesh of the torus is cut from the inside of its round shape by up to 1e-4.
        assert!(torus.lower_bound(x) <= torus_distance(x, 0.5, 0.2) + 2e-4);
        let truth = box_distance(x, half);
        assert!(
            cuboid.lower_bound(x) <= truth + 1e-9,
            "{x}: {} > {truth}",
            cuboid.lower_bound(x)
        );
        slack += truth - cuboid.lower_bound(x);
    }
    assert!(slack / 50_000.0 < 0.06, "{}", slack / 50_000.0);
    // A wide body with a deep inside, far from any surface.
    let block = build(&samples::cuboid(DVec3::splat(2.0), 2), 0.1);
    for _ in 0..20_000 {
        let x = 1.4 * random.vector();
        let truth = box_distance(x, DVec3::ONE);
        assert!(block.lower_bound(x) <= truth + 1e-9);
        assert!(truth - block.lower_bound(x) < 0.5);
    }
}

/// Nodes differ by a cell at most, so no component of the gradient exceeds 1. Its length may, where the
/// field turns within a cell: a difference over h of a field of curvature 1/r is off by h/2r at a corner of the cell,
/// r being the distance from the ring in the torus's middle. Holes included.
#[test]
fn the_interpolant_is_smooth_within_the_band() {
    let torus = samples::torus(0.5, 0.2, 100);
    for mesh in [torus.clone(), samples::with_holes(torus, 0.01)] {
        let grid = build(&mesh, 0.04);
        let mut random = Random::new(6);
        for _ in 0..50_000 {
            let x = random.within(grid.body_box[0], grid.body_box[1]);
            let Some((value, gradient)) = grid.value_and_gradient(x) else {
                continue;
            };
            if value.abs() < 0.1 {
                assert!(gradient.abs().max_element() < 1.001, "{x} {gradient}");
                let turn = 0.5 * 0.04 / (0.2 + value);
                assert!(gradient.length() < 1.001 + turn, "{x} {gradient}");
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mesh = samples::with_holes(samples::torus(0.5, 0.2, 60), 0.01);
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| build(&mesh, 0.05).to_bytes())
    };
    let one = bytes(1);
    assert_eq!(one, bytes(2));
    assert_eq!(one, bytes(3));
}

#[test]
fn a_sheet_needs_a_thickness_and_becomes_a_wall() {
    let sheet = samples::sheet(10, 10, |i, j| {
        DVec3::new(0.1 * i as f64, 0.1 * j as f64, 0.0)
    });
    let options = GridOptions::new(0.05, 0.2);
    assert_eq!(
        DistanceGrid::build(&sheet, &options, &|_| ()).unwrap_err(),
        GridError::NoInside
    );
    let thin = GridOptions {
        thickness: Some(0.1),
        ..options
    };
    assert!(matches!(
        DistanceGrid::build(&sheet, &thin, &|_| ()),
        Err(GridError::Thickness { .. })
    ));
    let wall = GridOptions {
        thickness: Some(0.2),
        ..options
    };
    let wall = DistanceGrid::build(&sheet, &wall, &|_| ()).unwrap();
    for side in [-1.0, 1.0] {
        let (distance, normal) = wall
            .distance_and_normal(DVec3::new(0.5, 0.4, 0.22 * side))
            .unwrap();
        assert!((distance - 0.12).abs() < 1e-6);
        assert!((normal - DVec3::Z * side).length() < 1e-6);
    }
    assert_eq!(wall.bounds().unwrap()[0], DVec3::splat(-0.1));
}

#[test]
fn a_grid_that_is_too_large_names_the_cell_that_fits() {
    let mesh = samples::cuboid(DVec3::ONE, 2);
    let options = GridOptions {
        most_bytes: 100_000,
        ..GridOptions::new(1e-4, 0.3)
    };
    let Err(GridError::TooLarge { cell, .. }) = DistanceGrid::build(&mesh, &options, &|_| ())
    else {
        panic!("it was built");
    };
    let fits = DistanceGrid::build(&mesh, &GridOptions { cell, ..options }, &|_| ()).unwrap();
    assert!(fits.bytes() <= 100_000 && fits.bytes() > 80_000);
    for (cell, band) in [
        (0.0, 1.0),
        (f64::NAN, 1.0),
        (0.1, 0.1),
        (0.1, f64::INFINITY),
    ] {
        assert!(DistanceGrid::build(&mesh, &GridOptions::new(cell, band), &|_| ()).is_err());
    }
}

#[test]
fn exact_edges_are_exact_and_far_grains_are_not_touched() {
    let half = DVec3::splat(0.5);
    let options = GridOptions {
        exact_edges: true,
        ..GridOptions::new(0.05, 0.25)
    };
    let grid = DistanceGrid::build(&samples::cuboid(2.0 * half, 3), &options, &|_| ()).unwrap();
    let mut random = Random::new(8);
    let mut out = HitBuffer::<Space>::default();
    for _ in 0..5000 {
        let x = 0.8 * random.vector();
        out.hits.clear();
        grid.hits(&[x], &[0.1], &mut out);
        let truth = box_distance(x, half);
        assert_eq!(out.hits.len(), usize::from(truth < 0.1), "{x} {truth}");
        if let Some(hit) = out.hits.first().filter(|_| truth > -0.1) {
            assert!((hit.distance - truth).abs() < 1e-12);
        }
    }
}

#[test]
fn progress_ends_at_one() {
    let seen = std::sync::Mutex::new(Vec::new());
    let note = |p: f64| seen.lock().unwrap().push(p);
    DistanceGrid::build(&samples::ball(0.5, 8), &GridOptions::new(0.1, 0.3), &note).unwrap();
    let seen = seen.into_inner().unwrap();
    assert!(seen.len() > 10 && seen.last() == Some(&1.0));
    assert!(seen.iter().all(|p| (0.0..=1.0).contains(p)));
}
