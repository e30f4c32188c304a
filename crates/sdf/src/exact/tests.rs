//! The exact mesh against bodies whose distances are known.

use super::*;
use crate::mesh::samples::{self, Random};
use proptest::prelude::*;
use std::sync::OnceLock;

fn hits(surface: &ExactMesh, x: DVec3, reach: f64) -> Vec<Hit<Space>> {
    let mut out = HitBuffer::default();
    surface.hits(&[x], &[reach], &mut out);
    out.hits
}

/// An L: a plate with a block on it, two overlapping boxes whose concave corner runs along y at x = 0, z = 0.
fn step() -> Mesh {
    let mut mesh = samples::moved(
        samples::cuboid(DVec3::new(4.0, 4.0, 1.0), 5),
        DVec3::new(0.0, 0.0, -0.5),
    );
    samples::append(
        &mut mesh,
        &samples::moved(
            samples::cuboid(DVec3::new(2.0, 4.0, 2.0), 4),
            DVec3::new(-1.0, 0.0, 0.5),
        ),
    );
    mesh
}

#[test]
fn one_flat_face_of_many_triangles_is_one_contact() {
    let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 8)).unwrap();
    for (x, y) in [(0.01, 0.02), (0.25, 0.25), (0.3, 0.111)] {
        let found = hits(&cube, DVec3::new(x, y, 1.4), 0.5);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].distance - 0.4).abs() < 1e-12);
        assert!((found[0].normal - DVec3::Z).length() < 1e-12);
    }
    // The feature is that of the face, wherever on it the grain is.
    let a = hits(&cube, DVec3::new(0.4, 0.3, 1.4), 0.5)[0].feature;
    let b = hits(&cube, DVec3::new(-0.6, 0.1, 1.4), 0.5)[0].feature;
    assert_eq!(a, b);
}

#[test]
fn a_convex_edge_is_one_contact_and_a_concave_corner_two() {
    let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 3)).unwrap();
    let found = hits(&cube, DVec3::new(1.3, 0.1, 1.3), 0.5);
    assert_eq!(found.len(), 1, "{found:?}");
    let towards = DVec3::new(1.0, 0.0, 1.0).normalize();
    assert!((found[0].normal - towards).length() < 1e-12);
    assert!((found[0].distance - 0.3 * 2f64.sqrt()).abs() < 1e-12);
    let corner = hits(&cube, DVec3::splat(1.2), 0.5);
    assert_eq!(corner.len(), 1);

    let step = ExactMesh::body(&step()).unwrap();
    let found = hits(&step, DVec3::new(0.3, 0.1, 0.4), 0.5);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        (found[0].normal - DVec3::X).length() < 1e-12 && (found[0].distance - 0.3).abs() < 1e-12
    );
    assert!(
        (found[1].normal - DVec3::Z).length() < 1e-12 && (found[1].distance - 0.4).abs() < 1e-12
    );
    assert_ne!(found[0].feature, found[1].feature);
}

#[test]
fn a_deep_grain_is_pushed_outward() {
    let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 3)).unwrap();
    let step = ExactMesh::body(&step()).unwrap();
    for (surface, x, reach, distance) in [
        (&cube, DVec3::new(0.1, 0.2, 0.7), 0.5, -0.3),
        // Deeper than the reach.
        (&cube, DVec3::new(0.1, 0.2, 0.3), 0.1, -0.7),
        // Where two shells overlap the nearest face counts.
        (&step, DVec3::new(1.5, 0.0, -0.2), 0.5, -0.2),
    ] {
        let found = hits(surface, x, reach);
        assert_eq!(found.len(), 1);
        assert!((found[0].distance - distance).abs() < 1e-12, "{found:?}");
        assert!((found[0].normal - DVec3::Z).length() < 1e-12);
        assert!(surface.lower_bound(x) <= distance && surface.lower_bound(x) > distance - 0.2);
    }
}

#[test]
fn the_side_is_right_where_shells_overlap_and_where_holes_are() {
    let step = step();
    for mesh in [step.clone(), samples::with_holes(step.clone(), 0.02)] {
        let surface = ExactMesh::body(&mesh).unwrap();
        assert!(!surface.clean);
        let plate = |x: DVec3| {
            (x - DVec3::new(0.0, 0.0, -0.5))
                .abs()
                .cmplt(DVec3::new(2.0, 2.0, 0.5))
                .all()
        };
        let block = |x: DVec3| {
            (x - DVec3::new(-1.0, 0.0, 0.5))
                .abs()
                .cmplt(DVec3::new(1.0, 2.0, 1.0))
                .all()
        };
        let mut random = Random::new(9);
        for _ in 0..20_000 {
            let x = 2.5 * random.vector();
            let (distance, ..) = surface.closest(x, f64::MAX).unwrap();
            assert_eq!(distance < 0.0, plate(x) || block(x), "{x} {distance}");
        }
    }
}

#[test]
fn the_back_of_a_thin_plate_is_not_touched_from_the_front() {
    let plate = ExactMesh::body(&samples::cuboid(DVec3::new(2.0, 2.0, 0.1), 4)).unwrap();
    assert_eq!(hits(&plate, DVec3::new(0.1, 0.2, 0.3), 0.5).len(), 1);
    let sheet = samples::sheet(4, 4, |i, j| DVec3::new(i as f64, j as f64, 0.0));
    let wall = ExactMesh::wall(&sheet, 0.2).unwrap();
    for side in [-1.0, 1.0] {
        let found = hits(&wall, DVec3::new(2.1, 1.8, 0.5 * side), 0.5);
        assert_eq!(found.len(), 1);
        assert!((found[0].distance - 0.4).abs() < 1e-12);
        assert!((found[0].normal - DVec3::Z * side).length() < 1e-12);
    }
}

#[test]
fn a_round_wall_seen_from_within_is_one_contact() {
    // A pipe seen from inside; facets of 6°.
    let pipe = samples::sheet(60, 4, |i, j| {
        let u = std::f64::consts::TAU * (i % 60) as f64 / 60.0;
        DVec3::new(u.cos(), u.sin(), j as f64)
    });
    let pipe = ExactMesh::wall(&pipe, 0.0).unwrap();
    let mut random = Random::new(5);
    for _ in 0..500 {
        let u = random.unit() * 6.0;
        let x = DVec3::new(0.9 * u.cos(), 0.9 * u.sin(), 1.0 + 2.0 * random.unit());
        assert_eq!(hits(&pipe, x, 0.2).len(), 1);
    }
}

#[test]
fn an_edge_has_one_name_all_along() {
    let cube = ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 7)).unwrap();
    let mut names: Vec<u32> = (0..500)
        .map(|k| hits(&cube, DVec3::new(1.2, -0.99 + 0.00396 * k as f64, 1.3), 0.5)[0].feature)
        .collect();
    names.dedup();
    assert_eq!(names.len(), 1, "{names:?}");
}

/// Made once: it is asked hundreds of times.
fn cube() -> &'static ExactMesh {
    static CUBE: OnceLock<ExactMesh> = OnceLock::new();
    CUBE.get_or_init(|| ExactMesh::body(&samples::cuboid(DVec3::splat(2.0), 2)).unwrap())
}

proptest! {
    #[test]
    fn any_triangles_give_finite_hits_or_an_error(
        points in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 3..12), scale in -40..7i32, wall in any::<bool>(),
    ) {
        let scale = 10f64.powi(scale);
        let mesh = Mesh {
            triangles: (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect(),
            vertices: points.iter().map(|&p| DVec3::from(p) * scale).collect(),
            parts: Vec::new(),
        };
        prop_assert!(!crate::mesh::Report::of(&mesh).to_string().is_empty());
        let made = if wall { ExactMesh::wall(&mesh, 0.0) } else { ExactMesh::body(&mesh) };
        if let Ok(surface) = made {
            for &x in &[DVec3::ZERO, mesh.vertices[0], DVec3::ONE * scale, DVec3::NAN, DVec3::INFINITY] {
                let bound = surface.lower_bound(x);
                prop_assert!(bound.is_finite() || !x.is_finite());
                if wall && x.is_finite() {
                    let distance = surface.closest(x, f64::MAX).map_or(0.0, |found| found.0);
                    prop_assert!(bound <= distance + 1e-12 * scale, "{bound} > {distance}");
                }
                for hit in hits(&surface, x, scale) {
                    prop_assert!(hit.is_finite() && (hit.normal.length() - 1.0).abs() < 1e-9, "{:?}", hit);
                }
            }
        }
    }

    #[test]
    fn the_nearest_hit_is_the_distance_and_the_bound_is_below(x in prop::array::uniform3(-2.5..2.5f64), reach in 0.05..1.0f64) {
        let x = DVec3::from(x);
        let out = (x.abs() - DVec3::ONE).max(DVec3::ZERO).length();
        let distance = if out > 0.0 { out } else { (x.abs() - DVec3::ONE).max_element() };
        let cube = cube();
        prop_assert!(cube.lower_bound(x) <= distance + 1e-12);
        let found = hits(cube, x, reach);
        prop_assert_eq!(found.is_empty(), distance >= reach);
        for hit in &found {
            prop_assert!(hit.is_finite() && (hit.normal.length() - 1.0).abs() < 1e-12);
        }
        if let Some(first) = found.first() {
            prop_assert!((first.distance - distance).abs() < 1e-12);
            prop_assert_eq!(found.len(), 1);
        }
    }
}
