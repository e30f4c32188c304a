//! Walls as text: shapes and motions.

use std::fmt::{Result, Write};

use glam::DVec3;

use super::{mesh_file, numbers, quantity, region, text, triple};
use crate::scene::{
    Begin, Course, Grains, MeshSurface, Motion, Region, Removal, Shape, Shift, Turn, Wall,
};
use crate::units::Dimension;

impl Wall {
    pub(super) fn write_to(&self, out: &mut String, grains: &Grains) -> Result {
        writeln!(out, "        (")?;
        writeln!(out, "            name: {},", text(&self.name))?;
        if let Some(material) = self.material {
            let material = text(grains.material_name(material));
            writeln!(out, "            material: {material},")?;
        }
        let (name, fields) = (self.shape.name(), fields(&self.shape));
        writeln!(out, "            shape: {name}({fields}),")?;
        if let Some(restitution) = self.restitution {
            writeln!(out, "            restitution: {restitution:?},")?;
        }
        if let Some(friction) = self.friction {
            writeln!(out, "            friction: {friction:?},")?;
        }
        if self.shape.wall_grains().is_none() {
            writeln!(out, "            touches_at: {:?},", self.touches_at)?;
        }
        let removed = match self.removed {
            Removal::Never => "Never".into(),
            Removal::WhenStill => "WhenStill".into(),
            Removal::At(time) => format!("At({})", quantity(Dimension::Time, time)),
        };
        writeln!(out, "            removed: {removed},")?;
        if let Some(motion) = &self.motion {
            motion.write_to(out)?;
        }
        writeln!(out, "        ),")
    }
}

impl Motion {
    fn write_to(&self, out: &mut String) -> Result {
        writeln!(out, "            motion: (")?;
        if let Some(Turn { point, axis, rate }) = &self.turn {
            let point = place(*point);
            let rate = quantity(Dimension::AngularVelocity, *rate);
            let axis = numbers(*axis);
            writeln!(
                out,
                "                turn: (point: {point}, axis: {axis}, rate: {rate}),"
            )?;
        }
        writeln!(out, "                shifts: [")?;
        for Shift { direction, course } in &self.shifts {
            let direction = numbers(*direction);
            let course = match course {
                Course::Steady(speed) => {
                    format!("speed: {}", quantity(Dimension::Velocity, *speed))
                }
                Course::Swing {
                    amplitude,
                    frequency,
                } => format!(
                    "amplitude: {}, frequency: {}",
                    length(*amplitude),
                    quantity(Dimension::Frequency, *frequency)
                ),
            };
            writeln!(
                out,
                "                    (direction: {direction}, {course}),"
            )?;
        }
        writeln!(out, "                ],")?;
        let begins = match self.begins {
            Begin::At(time) => format!("At({})", quantity(Dimension::Time, time)),
            Begin::WhenStill => "WhenStill".into(),
        };
        writeln!(out, "                begins: {begins},")?;
        if let Some(lasts) = self.lasts {
            let lasts = quantity(Dimension::Time, lasts);
            writeln!(out, "                lasts: {lasts},")?;
        }
        writeln!(out, "            ),")
    }
}

fn length(value: f64) -> String {
    quantity(Dimension::Length, value)
}

fn place(value: DVec3) -> String {
    triple(Dimension::Length, value)
}

/// What stands in the brackets of a shape.
fn fields(shape: &Shape) -> String {
    let ends = |from: &DVec3, to: &DVec3| format!("from: {}, to: {}", place(*from), place(*to));
    match shape {
        Shape::HalfSpace { point, outward } => {
            format!("point: {}, outward: {}", place(*point), numbers(*outward))
        }
        Shape::Ball { centre, radius } => {
            format!("centre: {}, radius: {}", place(*centre), length(*radius))
        }
        Shape::Cuboid { min, max } => region(&Region {
            min: *min,
            max: *max,
        }),
        Shape::Cylinder { from, to, radius } => {
            format!("{}, radius: {}", ends(from, to), length(*radius))
        }
        Shape::Tube {
            from,
            to,
            inner,
            outer,
        } => format!(
            "{}, inner: {}, outer: {}",
            ends(from, to),
            length(*inner),
            length(*outer)
        ),
        Shape::Cone {
            from,
            to,
            radii: [first, last],
            thickness,
        } => format!(
            "{}, radii: ({}, {}), thickness: {}",
            ends(from, to),
            length(*first),
            length(*last),
            length(*thickness)
        ),
        Shape::Screw {
            from,
            to,
            shaft,
            outer,
            pitch,
            thickness,
            hand,
        } => format!(
            "{}, shaft: {}, outer: {}, pitch: {}, thickness: {}, hand: {hand:?}",
            ends(from, to),
            length(*shaft),
            length(*outer),
            length(*pitch),
            length(*thickness)
        ),
        Shape::Mesh {
            mesh,
            surface,
            thickness,
        } => {
            let surface = match surface {
                MeshSurface::Exact => "Exact".into(),
                MeshSurface::Grains { radius, thin } => {
                    format!("Grains(radius: {}, thin: {thin:?})", length(*radius))
                }
                MeshSurface::Grid { cell, exact_edges } => {
                    let cell =
                        cell.map_or(String::new(), |cell| format!("cell: {}, ", length(cell)));
                    format!("Grid({cell}exact_edges: {exact_edges})")
                }
            };
            let thickness = thickness.map_or(String::new(), |thickness| {
                format!(", thickness: {}", length(thickness))
            });
            format!("{}, surface: {surface}{thickness}", mesh_file(mesh))
        }
    }
}
