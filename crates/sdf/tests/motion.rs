//! A surface that moves: the pose carries queries and normals so that distance, velocity and place agree.

use glam::DVec3;
use proptest::prelude::*;
use tsubu_model::{Course, HitBuffer, Motion, Shift, Space, Span, Surface, Turn};
use tsubu_sdf::{Cuboid, Hand, Screw, ScrewSize};

/// Turning about an axis that is carried along by a shift and a swing.
fn motion(axis: DVec3, rate: f64) -> Motion {
    let shift = |direction, course| Shift {
        direction,
        course,
        span: Span::ALWAYS,
    };
    Motion {
        turn: Some(Turn {
            point: DVec3::new(0.1, 0.02, -0.03),
            axis,
            rate,
            span: Span::ALWAYS,
        }),
        shifts: vec![
            shift(DVec3::Z, Course::Steady(0.3)),
            shift(
                DVec3::Y,
                Course::Swing {
                    amplitude: 0.05,
                    frequency: 1.5,
                },
            ),
        ],
    }
}

/// Distance, normal in the world and foot in the world of a point near a moving surface.
fn nearest(surface: &dyn Surface<Space>, motion: &Motion, x: DVec3, t: f64) -> (f64, DVec3, DVec3) {
    let pose = motion.at(t);
    let mut out = HitBuffer::default();
    surface.hits(&[pose.to_body(x)], &[f64::INFINITY], &mut out);
    let hits = out.hits.into_iter();
    let hit = hits.min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
    let hit = hit.expect("every point has a nearest place at an endless reach");
    let normal = pose.direction(hit.normal);
    (hit.distance, normal, x - normal * hit.distance)
}

proptest! {
    #[test]
    fn the_wall_velocity_is_that_of_the_bodys_point_and_closes_the_gap_at_its_normal_part(
        x in prop::array::uniform3(-0.2..0.4f64), t in 0.1..2.0f64, rate in -9.0..9.0f64, tilt in -1.0..1.0f64, which in 0..2usize,
    ) {
        let size = ScrewSize { shaft: 0.0275, outer: 0.1025, pitch: 0.150, thickness: 0.006 };
        let screw = Screw::new(DVec3::ZERO, DVec3::X * 0.3, size, Hand::Right).unwrap();
        let block = Cuboid::<Space>::new(DVec3::splat(-0.1), DVec3::new(0.2, 0.1, 0.3)).unwrap();
        let surface: &dyn Surface<Space> = if which == 0 { &screw } else { &block };
        let motion = motion(DVec3::new(1.0, tilt, 0.5).normalize(), rate);
        let (x, h) = (motion.at(t).to_world(DVec3::from(x)), 1e-6);
        let (distance, normal, foot) = nearest(surface, &motion, x, t);
        let pose = motion.at(t);
        let wall = pose.velocity_at(foot);
        // The body's point that is the foot now moves as the pose says.
        let label = pose.to_body(foot);
        let went = (motion.at(t + h).to_world(label) - motion.at(t - h).to_world(label)) / (2.0 * h);
        prop_assert!((went - wall).length() < 1e-6 * (1.0 + rate.abs()));
        // A point that rests in the world sees the surface come nearer at −n·v, except at a crease.
        let (before, a, _) = nearest(surface, &motion, x, t - h);
        let (after, b, _) = nearest(surface, &motion, x, t + h);
        if (a - normal).length() + (b - normal).length() < 1e-3 {
            let closing = (after - before) / (2.0 * h);
            prop_assert!((closing + normal.dot(wall)).abs() < 1e-5 * (1.0 + wall.length()), "{distance} {closing} {}", normal.dot(wall));
        }
    }
}
