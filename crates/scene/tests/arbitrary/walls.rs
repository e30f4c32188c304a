//! Walls of every shape, at rest and moving.

use glam::DVec3;
use proptest::option::of;
use proptest::prelude::*;
use tsubu_scene::*;

use super::{direction, region, size, vector};

pub fn wall() -> impl Strategy<Value = Wall> {
    let touches_at = prop_oneof![Just(TouchesAt::Surface), Just(TouchesAt::Centre)];
    let removed = prop_oneof![
        Just(Removal::Never),
        Just(Removal::WhenStill),
        size().prop_map(Removal::At)
    ];
    let share = of(1e-6_f64..=1.0);
    (
        shape(),
        share.clone(),
        share,
        touches_at,
        removed,
        of(motion()),
    )
        .prop_map(
            |(shape, restitution, friction, touches_at, removed, motion)| {
                let mut wall = Wall {
                    name: String::new(),
                    shape,
                    material: None,
                    restitution,
                    friction,
                    touches_at,
                    removed,
                    motion,
                };
                // A body of grains is touched by the grains' own law.
                if wall.shape.wall_grains().is_some() {
                    (wall.restitution, wall.friction) = (None, None);
                    wall.touches_at = TouchesAt::default();
                }
                // A wall that is gone does not begin to move.
                match (
                    wall.removed,
                    wall.motion.as_ref().map(|motion| motion.begins),
                ) {
                    (Removal::At(gone), Some(Begin::At(begins))) if begins >= gone => {
                        wall.motion = None;
                    }
                    (Removal::WhenStill, Some(Begin::WhenStill)) => wall.motion = None,
                    _ => {}
                }
                wall
            },
        )
}

/// Whether a wall waits for the grains to be still.
pub fn waits(wall: &Wall) -> bool {
    let begins = wall.motion.as_ref().map(|motion| motion.begins);
    wall.removed == Removal::WhenStill || begins == Some(Begin::WhenStill)
}

pub fn mesh_file() -> impl Strategy<Value = MeshFile> {
    let unit = prop_oneof![Just(1.0), Just(0.01), Just(0.001), Just(0.0254)];
    ("/[ -~é粒]{1,20}", unit).prop_map(|(path, unit)| MeshFile {
        path: path.into(),
        unit,
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    prop_oneof![flat(), round(), mesh()]
}

/// Shapes that a plane scene may have as well.
fn flat() -> impl Strategy<Value = Shape> {
    prop_oneof![
        (vector(), direction()).prop_map(|(point, outward)| Shape::HalfSpace { point, outward }),
        (vector(), size()).prop_map(|(centre, radius)| Shape::Ball { centre, radius }),
        region().prop_map(|Region { min, max }| Shape::Cuboid { min, max }),
    ]
}

/// Shapes about an axis.
fn round() -> impl Strategy<Value = Shape> {
    let ends = || {
        (vector(), direction(), 1.0_f64..10.0)
            .prop_map(|(from, along, by)| (from, from + along * by))
    };
    let hand = prop_oneof![Just(Hand::Right), Just(Hand::Left)];
    prop_oneof![
        (ends(), size()).prop_map(|((from, to), radius)| Shape::Cylinder { from, to, radius }),
        (ends(), size(), 1.01_f64..9.0).prop_map(|((from, to), inner, more)| Shape::Tube {
            from,
            to,
            inner,
            outer: inner * more,
        }),
        (ends(), [size(), size()], size()).prop_map(|((from, to), radii, thickness)| Shape::Cone {
            from,
            to,
            radii,
            thickness,
        }),
        (ends(), size(), size(), [1.01_f64..9.0, 1.01..9.0], hand).prop_map(
            |((from, to), shaft, thickness, [outer, pitch], hand)| Shape::Screw {
                from,
                to,
                shaft,
                outer: shaft * outer,
                pitch: thickness * pitch,
                thickness,
                hand,
            }
        ),
    ]
}

fn mesh() -> impl Strategy<Value = Shape> {
    let surface = prop_oneof![
        Just(MeshSurface::Exact),
        (size(), prop_oneof![Just(Thin::Leave), Just(Thin::OneLayer)])
            .prop_map(|(radius, thin)| MeshSurface::Grains { radius, thin }),
        (of(size()), any::<bool>())
            .prop_map(|(cell, exact_edges)| MeshSurface::Grid { cell, exact_edges }),
    ];
    (mesh_file(), surface, of(size())).prop_map(|(mesh, surface, thickness)| Shape::Mesh {
        mesh,
        surface,
        thickness,
    })
}

fn motion() -> impl Strategy<Value = Motion> {
    let turn = (vector(), direction(), -1e3_f64..1e3).prop_map(|(point, axis, rate)| Turn {
        point,
        axis,
        rate,
    });
    let course = prop_oneof![
        (-1e3_f64..1e3).prop_map(Course::Steady),
        (-1e3_f64..1e3, size()).prop_map(|(amplitude, frequency)| Course::Swing {
            amplitude,
            frequency
        }),
    ];
    let shift = (direction(), course).prop_map(|(direction, course)| Shift { direction, course });
    let begins = prop_oneof![
        Just(Begin::default()),
        Just(Begin::WhenStill),
        size().prop_map(Begin::At)
    ];
    let shifts = proptest::collection::vec(shift, 0..3);
    (of(turn), shifts, begins, of(size())).prop_map(|(turn, mut shifts, begins, lasts)| {
        if turn.is_none() && shifts.is_empty() {
            shifts.push(Shift {
                direction: DVec3::Z,
                course: Course::Steady(0.1),
            });
        }
        Motion {
            turn,
            shifts,
            begins,
            lasts,
        }
    })
}
