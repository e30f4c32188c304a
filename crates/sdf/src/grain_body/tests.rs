//! Bodies of grains against their wall grains asked one by one.

use super::*;
use crate::mesh::samples::{self, Random};

/// A torus of ring radius 30 and tube radius 12 mm.
fn ring(radius: f64, reach: f64) -> GrainBody {
    let mesh = samples::torus(0.030, 0.012, 24);
    GrainBody::build(&mesh, &GrainBodyOptions::new(radius, reach)).unwrap()
}

/// Number and distance of every wall grain within reach, asked one by one.
fn one_by_one(body: &GrainBody, x: DVec3, reach: f64) -> Vec<(u32, f64)> {
    let distances = body
        .centres()
        .iter()
        .map(|c| (x - *c).length() - body.options.radius);
    (0u32..)
        .zip(distances)
        .filter(|(_, d)| *d < reach)
        .collect()
}

fn found(body: &GrainBody, x: DVec3, reach: f64) -> Vec<(u32, f64)> {
    let mut out = HitBuffer::default();
    body.hits(&[x], &[reach], &mut out);
    out.hits.iter().map(|h| (h.feature, h.distance)).collect()
}

#[test]
fn every_wall_grain_within_reach_is_found_once_in_the_order_of_their_numbers() {
    for (radius, reach) in [(0.002, 0.010), (0.004, 0.003), (0.0011, 0.006)] {
        let body = ring(radius, reach);
        let mut random = Random::new(7);
        let mut most = 0;
        for k in 0..3000 {
            let x = random.within(DVec3::splat(-0.06), DVec3::splat(0.06));
            // Also further than the cells reach, and not at all.
            let reach = reach * [1.0, 0.3, 3.0, 0.0, -0.5][k % 5];
            let expected = one_by_one(&body, x, reach);
            most = most.max(expected.len());
            assert_eq!(found(&body, x, reach), expected, "{x} {reach}");
        }
        assert!(most > 5, "only {most} at once");
    }
}

#[test]
fn the_bound_is_below_the_distance_and_close_to_it_within_the_cells() {
    let body = ring(0.002, 0.010);
    let mut random = Random::new(3);
    for _ in 0..3000 {
        let x = random.within(DVec3::splat(-0.08), DVec3::splat(0.08));
        let distance = one_by_one(&body, x, f64::INFINITY)
            .iter()
            .map(|(_, d)| *d)
            .fold(f64::INFINITY, f64::min);
        let bound = body.lower_bound(x);
        assert!(bound <= distance, "{x}: {bound} above {distance}");
        // Within the reach it is short by no more than twice half a cell's diagonal.
        let cell = cells::cell_edge(0.002, 0.010);
        if distance < 0.010 {
            assert!(
                bound > distance - 1.7321 * cell,
                "{x}: {bound} for {distance}"
            );
        } else {
            assert!(bound > 0.0, "{x}: {bound} for {distance}");
        }
    }
}

#[test]
fn a_point_that_is_no_point_hits_nothing() {
    let body = ring(0.003, 0.010);
    for x in [
        DVec3::NAN,
        DVec3::splat(f64::INFINITY),
        DVec3::new(0.0, f64::NAN, 0.03),
    ] {
        assert!(found(&body, x, 0.01).is_empty());
    }
    // In the middle of a wall grain the way out has some direction.
    let mut out = HitBuffer::default();
    body.hits(&[body.centres()[5]], &[0.0], &mut out);
    assert!(
        out.hits
            .iter()
            .any(|h| h.feature == 5 && h.distance == -0.003)
    );
    assert!(out.hits.iter().all(Hit::is_finite));
}

#[test]
fn the_box_holds_every_wall_grain_and_the_picture_is_the_mesh() {
    // A plate of 40 × 40 × 2 mm with grains that stick out of it by 1 mm.
    let mesh = samples::cuboid(DVec3::new(0.040, 0.040, 0.002), 1);
    let body = GrainBody::build(&mesh, &GrainBodyOptions::new(0.002, 0.005)).unwrap();
    let [low, high] = body.bounds().unwrap();
    let thick = high.z - low.z;
    assert!((thick - 0.004).abs() < 1e-8, "{thick}");
    assert!(body.centres().iter().all(|c| c.z.abs() < 1e-8));
    assert_eq!(body.shell().unwrap().vertices, body.mesh().vertices);
    assert!(!body.outline(DVec3::splat(-1.0), DVec3::ONE).is_empty());
    assert!(body.bytes() > 24 * body.count() as u64);
}

/// An open sheet is filled as a wall of a given thickness: two layers of four grains per a³ here.
#[test]
fn a_sheet_with_a_thickness_is_filled() {
    let sheet = Mesh {
        vertices: [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)]
            .map(|(x, y)| DVec3::new(x, y, 0.0))
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        parts: Vec::new(),
    };
    let options = GrainBodyOptions {
        thickness: Some(0.010),
        ..GrainBodyOptions::new(0.002, 0.01)
    };
    let body = GrainBody::build(&sheet, &options).unwrap();
    assert!(body.centres().iter().all(|c| c.z.abs() <= 0.003 + 1e-9));
    // Layers are √2 rs = 2.83 mm apart, so three fit into 6 mm; each has one grain per 4 rs².
    let each = 3.0 * 0.1 * 0.1 / (4.0 * 0.002 * 0.002);
    let share = body.count() as f64 / each;
    assert!((share - 1.0).abs() < 0.2, "{share}");
}

#[test]
fn what_cannot_be_built_says_why() {
    let mesh = samples::cuboid(DVec3::splat(0.02), 1);
    let said = |options: GrainBodyOptions| {
        let error = GrainBody::build(&mesh, &options).unwrap_err();
        (error.to_string(), error)
    };
    let (text, _) = said(GrainBodyOptions::new(0.0, 0.01));
    assert!(
        text.contains("radius of wall grains must be a positive length"),
        "{text}"
    );
    let (text, _) = said(GrainBodyOptions::new(0.001, f64::NAN));
    assert!(text.contains("reach of the grains must be"), "{text}");
    let (text, error) = said(GrainBodyOptions {
        thin: Thin::Leave,
        ..GrainBodyOptions::new(0.012, 0.01)
    });
    assert!(matches!(error, GrainBodyError::NoGrain { .. }));
    assert!(
        text.contains("20.0 × 20.0 × 20.0 mm holds no grain of 12.0000 mm"),
        "{text}"
    );
    let small = GrainBodyOptions {
        most_bytes: 1 << 20,
        ..GrainBodyOptions::new(1e-4, 0.002)
    };
    let (text, error) = said(small);
    let GrainBodyError::TooLarge { fits, bytes, .. } = error else {
        panic!("{text}");
    };
    assert!(bytes > 1e6 && text.contains("mm fits"), "{text}");
    let fitting = GrainBody::build(
        &mesh,
        &GrainBodyOptions {
            radius: fits,
            ..small
        },
    )
    .unwrap();
    assert!(fitting.bytes() <= 1 << 20, "{}", fitting.bytes());
    assert!(fitting.bytes() > 1 << 19, "{}", fitting.bytes());
    let nothing = GrainBody::build(&Mesh::default(), &small).unwrap_err();
    assert_eq!(nothing, GrainBodyError::Mesh(MeshError::Empty));
}

use crate::mesh::MeshError;
