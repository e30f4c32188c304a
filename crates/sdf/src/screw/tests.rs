//! The screw against brute force, its symmetries and its mesh.

use super::*;
use crate::drawing::{tests::assert_closed, volume};
use crate::solid::Solid;
use proptest::prelude::*;

const FEEDER: ScrewSize = ScrewSize {
    shaft: 0.0275,
    outer: 0.1025,
    pitch: 0.150,
    thickness: 0.006,
};
/// Steep, thick and slender: the horizon of the shaft and the turning back of the face matter.
const STEEP: ScrewSize = ScrewSize {
    shaft: 0.010,
    outer: 0.050,
    pitch: 0.300,
    thickness: 0.040,
};

fn screw(size: ScrewSize, hand: Hand) -> Screw {
    Screw::new(DVec3::ZERO, DVec3::X * 0.675, size, hand).unwrap()
}

/// The least distance to a dense sampling of every part of the surface, refined around the best
/// samples by halving steps in the two coordinates of the part. It shares nothing with the solver
/// but the definition of the body.
fn brute(screw: &Screw, x: DVec3) -> f64 {
    let ScrewSize {
        shaft,
        outer,
        thickness,
        ..
    } = screw.size;
    let [first, last] = screw.turn;
    let half = 0.5 * thickness;
    let l = screw.axis.length;
    let at = |r: f64, angle: f64, z: f64| {
        let v = angle.sin() * screw.mirror();
        screw.axis.point(z, r * angle.cos(), r * v)
    };
    let bare = |angle: f64, z: f64| {
        let k = ((z - screw.rise * angle) / screw.size.pitch).round();
        let theta = angle + TAU * k;
        let over = z - screw.rise * theta;
        over.abs() > half || theta < first || theta > last
    };
    // Each part: a map of the unit square, None where it is not surface.
    type Part<'a> = Box<dyn Fn(f64, f64) -> Option<DVec3> + 'a>;
    let mix = |a: f64, b: f64, s: f64| a + (b - a) * s;
    let mut parts: Vec<(Part, usize, usize)> = Vec::new();
    for side in [-half, half] {
        let face = move |s: f64, t: f64| {
            let angle = mix(first, last, s);
            Some(at(mix(shaft, outer, t), angle, screw.rise * angle + side))
        };
        parts.push((Box::new(face), 600, 24));
    }
    parts.push((
        Box::new(move |s, t| {
            let angle = mix(first, last, s);
            Some(at(outer, angle, screw.rise * angle + mix(-half, half, t)))
        }),
        600,
        4,
    ));
    parts.push((
        Box::new(move |s, t| {
            let (angle, z) = (TAU * s, l * t);
            bare(angle, z).then(|| at(shaft, angle, z))
        }),
        120,
        240,
    ));
    for z in [0.0, l] {
        parts.push((
            Box::new(move |s, t| Some(at(shaft * t, TAU * s, z))),
            80,
            20,
        ));
    }
    for angle in [first, last] {
        let end = move |s: f64, t: f64| {
            let z = screw.rise * angle + mix(-half, half, t);
            Some(at(mix(shaft, outer, s), angle, z))
        };
        parts.push((Box::new(end), 40, 10));
    }
    let mut least = f64::INFINITY;
    for (part, m, n) in &parts {
        let away = |s: f64, t: f64| part(s, t).map_or(f64::INFINITY, |y| (y - x).length());
        let mut samples = Vec::new();
        for i in 0..=*m {
            for j in 0..=*n {
                let (s, t) = (i as f64 / *m as f64, j as f64 / *n as f64);
                samples.push((away(s, t), s, t));
            }
        }
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        for &(mut best, mut s, mut t) in samples.iter().take(4) {
            let (mut ds, mut dt) = (1.0 / *m as f64, 1.0 / *n as f64);
            while ds > 1e-13 {
                let mut moved = false;
                for (a, b) in [
                    (ds, 0.0),
                    (-ds, 0.0),
                    (0.0, dt),
                    (0.0, -dt),
                    (ds, dt),
                    (-ds, -dt),
                    (ds, -dt),
                    (-ds, dt),
                ] {
                    let (p, q) = ((s + a).clamp(0.0, 1.0), (t + b).clamp(0.0, 1.0));
                    let length = away(p, q);
                    if length < best {
                        (best, s, t, moved) = (length, p, q, true);
                    }
                }
                if !moved {
                    (ds, dt) = (0.5 * ds, 0.5 * dt);
                }
            }
            least = least.min(best);
        }
    }
    least
}

/// A repeatable spread of points in and around a screw, every third in the thickness of its flight
/// or less than that away from it.
fn spread(screw: &Screw, count: usize) -> impl Iterator<Item = DVec3> {
    (1..=count).map(|k| {
        let part = |a: f64| (k as f64 * a).fract();
        // The steps of the plastic-number sequence fill a box evenly.
        let (a, b, c) = (part(0.8191725134), part(0.6710436067), part(0.5497004779));
        if k % 3 == 0 {
            let angle = screw.turn[0] - 0.2 + (screw.turn[1] - screw.turn[0] + 0.4) * a;
            let over = 2.0 * screw.size.thickness * (b - 0.5);
            return screw.corner(1.05 * screw.size.outer * c, angle, over);
        }
        DVec3::new(-0.08 + 0.83 * a, 0.32 * b - 0.16, 0.32 * c - 0.16)
    })
}

#[test]
fn distance_is_the_least_distance_to_a_dense_sampling_of_the_surface() {
    for (size, hand) in [
        (FEEDER, Hand::Right),
        (FEEDER, Hand::Left),
        (STEEP, Hand::Right),
    ] {
        let screw = screw(size, hand);
        let (mut worst, mut inside) = (0.0f64, 0);
        for x in spread(&screw, 150) {
            let (exact, sampled) = (screw.distance(x), brute(&screw, x));
            inside += usize::from(exact < 0.0);
            // Descent by halving may stop a little above the least distance, never below it.
            worst = worst.max((exact.abs() - sampled).abs());
            assert!(
                (exact.abs() - sampled).abs() < 2e-8,
                "{size:?} {hand:?} at {x}: {exact} against {sampled}"
            );
        }
        println!("{size:?} {hand:?}: worst {worst:.2e} m, {inside} points inside");
        assert!(inside > 15);
    }
}

#[test]
fn a_grain_in_the_corner_of_flight_and_shaft_meets_both_and_a_wide_one_both_faces() {
    let screw = screw(FEEDER, Hand::Right);
    let hits = |x: DVec3, reach: f64| {
        let mut out = HitBuffer::default();
        screw.hits(&[x], &[reach], &mut out);
        out.hits
    };
    // 5 mm over the shaft, 4 mm in front of the face: at azimuth 0 the middle of a turn is at 150 mm.
    let corner = hits(DVec3::new(0.157, 0.0325, 0.0), 0.006);
    let features: Vec<_> = corner.iter().map(|h| h.feature).collect();
    assert_eq!(features, [0, 1]);
    assert!((corner[0].normal - DVec3::Y).length() < 1e-12);
    assert!(corner[1].normal.x > 0.7 && corner[1].distance < 0.004);
    // Midway between two turns, high over the shaft: the front of one, the back of the next.
    let between = hits(DVec3::new(0.225, 0.09, 0.0), 0.074);
    let features: Vec<_> = between.iter().map(|h| h.feature).collect();
    assert_eq!(features, [0, 1, 2]);
    assert!((between[1].distance - between[2].distance).abs() < 1e-12);
    assert!((between[1].normal.x + between[2].normal.x).abs() < 1e-12);
    // Beyond the rim, level with the flight: the rim and nothing else near.
    let rim = hits(DVec3::new(0.150, 0.105, 0.0), 0.01);
    assert_eq!(rim.len(), 1);
    assert_eq!(rim[0].feature, 3);
    assert!((rim[0].distance - 0.0025).abs() < 1e-15);
}

#[test]
fn turning_by_a_negative_angle_carries_the_faces_of_a_right_handed_screw_forward() {
    for (hand, sign) in [(Hand::Right, -1.0), (Hand::Left, 1.0)] {
        let screw = screw(FEEDER, hand);
        let angle = sign * TAU / 8.0;
        assert!((screw.advance(angle) - 0.150 / 8.0).abs() < 1e-15);
        // A grain on the face at azimuth 0 that cannot turn stays on the face if it advances p/8.
        let grain = DVec3::new(0.153, 0.08, 0.0);
        assert!(screw.distance(grain).abs() < 1e-15);
        let moved = grain + DVec3::X * screw.advance(angle);
        let back = glam::DMat3::from_rotation_x(-angle) * moved;
        assert!(screw.distance(back).abs() < 1e-15);
    }
}

#[test]
fn the_mesh_is_one_closed_shell_within_its_chord_of_the_surface() {
    for (size, hand, chord) in [
        (FEEDER, Hand::Right, 2e-4),
        (FEEDER, Hand::Left, 1e-3),
        (STEEP, Hand::Right, 2e-4),
    ] {
        let screw = screw(size, hand);
        let shell = screw.mesh(chord);
        assert_closed(&shell);
        let share = volume(&shell) / screw.volume();
        // Polygons lose area near the shaft in proportion to the chord.
        assert!((share - 1.0).abs() < chord / size.shaft, "{share}");
        let mut farthest = 0.0f64;
        for t in &shell.triangles {
            let [a, b, c] = t.map(|k| shell.vertices[k as usize]);
            for x in [
                (a + b) / 2.0,
                (b + c) / 2.0,
                (c + a) / 2.0,
                (a + b + c) / 3.0,
            ] {
                farthest = farthest.max(screw.distance(x).abs());
            }
        }
        println!(
            "chord {chord}: farthest {farthest:.2e}, {} triangles",
            shell.triangles.len()
        );
        assert!(farthest <= chord, "{farthest} against {chord}");
        assert!(farthest > 0.1 * chord);
    }
}

#[test]
fn impossible_screws_are_refused() {
    let make = |size| Screw::new(DVec3::ZERO, DVec3::X, size, Hand::Right);
    for wrong in [
        ScrewSize {
            shaft: 0.0,
            ..FEEDER
        },
        ScrewSize {
            outer: 0.02,
            ..FEEDER
        },
        ScrewSize {
            pitch: -0.1,
            ..FEEDER
        },
        ScrewSize {
            thickness: 0.08,
            ..FEEDER
        },
        ScrewSize {
            thickness: f64::NAN,
            ..FEEDER
        },
    ] {
        assert!(make(wrong).is_err(), "{wrong:?}");
    }
    assert!(Screw::new(DVec3::ZERO, DVec3::X * 0.01, FEEDER, Hand::Right).is_err());
}

proptest! {
    #[test]
    fn turned_by_an_angle_and_shifted_along_the_helix_a_point_keeps_its_distance_from_the_flight(
        rho in 0.03..0.15f64, phi in -3.0..3.0f64, z in 0.25..0.40f64, angle in -1.0..1.0f64,
    ) {
        let screw = screw(FEEDER, Hand::Right);
        let at = |phi: f64, z: f64| DVec3::new(z, rho * phi.cos(), rho * phi.sin());
        let (a, b) = (at(phi, z), at(phi + angle, z + 0.150 / TAU * angle));
        prop_assert!((screw.distance(a) - screw.distance(b)).abs() < 1e-14);
        prop_assert!(screw.lower_bound(a) <= screw.distance(a) + 1e-15);
    }
}
