//! The rules of walls.

use glam::DVec3;

use super::Rules;
use crate::raw::{RawRemoval, RawShape, RawTouchesAt, RawWall};
use crate::scene::{Axis, Domain, Removal, Shape, Space, TouchesAt, Wall};

impl Rules<'_> {
    pub(super) fn walls(&mut self, raw: Vec<RawWall>, domain: &Domain) -> Vec<Wall> {
        let mut walls: Vec<Wall> = Vec::with_capacity(raw.len());
        for (i, raw) in raw.into_iter().enumerate() {
            let path = format!("walls[{i}]");
            self.wall_name(&path, &raw.name, &walls);
            let shape = self.shape(&path, &raw.shape, domain);
            let restitution = raw.restitution.map(|restitution| restitution.0);
            if restitution.is_some_and(|restitution| !(restitution > 0.0 && restitution <= 1.0)) {
                let remedy =
                    "1 returns all the speed; leave the field out for a wall without damping";
                self.refuse(
                    format!("{path}.restitution"),
                    "the restitution is outside (0, 1]",
                    remedy,
                );
            }
            let friction = raw.friction.map(|friction| {
                self.not_negative(&format!("{path}.friction"), "the friction", friction.0)
            });
            let removed = match raw.removed {
                None | Some(RawRemoval::Never) => Removal::Never,
                Some(RawRemoval::WhenStill) => Removal::WhenStill,
                Some(RawRemoval::At(time)) => Removal::At(self.above_zero(
                    &format!("{path}.removed[0]"),
                    "the time of removal",
                    time.0,
                )),
            };
            let touches_at = match raw.touches_at {
                None | Some(RawTouchesAt::Surface) => TouchesAt::Surface,
                Some(RawTouchesAt::Centre) => TouchesAt::Centre,
            };
            walls.push(Wall {
                name: raw.name,
                shape,
                restitution,
                friction,
                touches_at,
                removed,
            });
        }
        walls
    }

    fn wall_name(&mut self, path: &str, name: &str, before: &[Wall]) {
        let path = format!("{path}.name");
        if name.trim().is_empty() {
            self.refuse(
                path,
                "a wall's name is empty",
                "name it, as in \"floor\": messages and results speak of it by name",
            );
        } else if name.contains(['.', '[', ']', '=', '"', '\\'])
            || name.chars().any(char::is_control)
        {
            self.refuse(
                path,
                "a wall's name holds one of . [ ] = \" \\",
                "paths such as walls.floor.friction name it: use letters, digits, spaces, -",
            );
        } else if name.parse::<usize>().is_ok() {
            self.refuse(
                path,
                "a wall's name is a number",
                "in paths a number is the place in the list: add a word",
            );
        } else if before.iter().any(|wall| wall.name == name) {
            self.refuse(
                path,
                format!("two walls are named “{name}”"),
                "give each its own name",
            );
        }
    }

    fn shape(&mut self, path: &str, raw: &RawShape, domain: &Domain) -> Shape {
        let RawShape::HalfSpace { point, outward } = raw;
        let point = DVec3::from_array(point.0.map(|length| length.0));
        self.in_plane(&format!("{path}.shape.point"), point);
        let path = format!("{path}.shape.outward");
        let outward = DVec3::from_array(outward.0.map(|number| number.0));
        self.in_plane(&path, outward);
        let outward = unit(outward).unwrap_or_else(|| {
            self.refuse(
                path.clone(),
                "the outward normal is zero",
                "write the direction towards the grains, such as (0, 0, 1)",
            );
            DVec3::Z
        });
        for (name, axis, part) in [
            ("x", domain.x, outward.x),
            ("y", domain.y, outward.y),
            ("z", domain.z, outward.z),
        ] {
            if matches!(axis, Axis::Periodic(_)) && part.abs() > 1e-12 {
                let what = format!("this wall is not parallel to the periodic axis {name}");
                self.refuse(
                    path.clone(),
                    what,
                    format!(
                        "write {name}: Open in the domain, or a normal without a part along {name}"
                    ),
                );
            }
        }
        Shape::HalfSpace { point, outward }
    }

    /// Refuses a y other than zero in a plane scene.
    pub(super) fn in_plane(&mut self, path: &str, vector: DVec3) {
        if self.space == Space::Plane && vector.y != 0.0 {
            self.refuse(
                format!("{path}[1]"),
                "a plane scene has no y, but this is not zero",
                "write zero for y, or space: Space",
            );
        }
    }
}

/// The vector at length 1, untouched if it has it already, so that a resolved scene reads back to the bit.
fn unit(vector: DVec3) -> Option<DVec3> {
    let largest = vector.abs().max_element();
    if largest == 0.0 {
        return None;
    }
    let scaled = vector / largest;
    if (vector.length() - 1.0).abs() <= 4.0 * f64::EPSILON {
        Some(vector)
    } else {
        Some(scaled / scaled.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_vectors() {
        assert_eq!(unit(DVec3::ZERO), None);
        for vector in [
            DVec3::new(1e300, 2e300, 0.0),
            DVec3::new(0.0, 3e-320, 0.0),
            DVec3::new(1.0, 2.0, 3.0),
        ] {
            let once = unit(vector).unwrap_or(DVec3::ZERO);
            assert!((once.length() - 1.0).abs() < 1e-15);
            assert_eq!(unit(once), Some(once));
        }
    }
}
