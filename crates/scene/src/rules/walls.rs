//! The rules of walls, and of names.

use super::Rules;
use crate::raw::{RawRemoval, RawTouchesAt, RawWall};
use crate::scene::{Begin, Domain, Motion, Removal, Scene, TouchesAt, Wall};

impl Rules<'_> {
    pub(super) fn walls(&mut self, raw: Vec<RawWall>, domain: &Domain) -> Vec<Wall> {
        let mut walls: Vec<Wall> = Vec::with_capacity(raw.len());
        for (i, raw) in raw.into_iter().enumerate() {
            let path = format!("walls[{i}]");
            let twice = walls.iter().any(|wall| wall.name == raw.name);
            self.name(&path, ["a wall", "two walls"], &raw.name, twice);
            let shape = self.shape(&format!("{path}.shape"), &raw.shape, domain);
            if shape.wall_grains().is_some() {
                self.of_grains(&path, &raw);
            }
            let remedy = if self.spins() {
                "1 returns all the speed; leave the field out for the grains' own damping"
            } else {
                "1 returns all the speed; leave the field out for a wall without damping"
            };
            let restitution = raw.restitution.map(|restitution| {
                self.restitution(&format!("{path}.restitution"), restitution.0, remedy)
            });
            let friction = raw.friction.map(|friction| {
                self.not_negative(&format!("{path}.friction"), "the friction", friction.0)
            });
            let material = raw
                .material
                .as_ref()
                .and_then(|name| self.wall_material(&path, name, &raw));
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
            let motion = raw
                .motion
                .map(|motion| self.motion(&format!("{path}.motion"), &motion, &shape, domain));
            if let Some(motion) = &motion {
                self.moves_while_there(&path, motion, removed);
            }
            walls.push(Wall {
                name: raw.name,
                shape,
                material,
                restitution,
                friction,
                touches_at,
                removed,
                motion,
            });
        }
        walls
    }

    /// Refuses what a body built of grains has not: grains touch it as they touch each other.
    fn of_grains(&mut self, path: &str, raw: &RawWall) {
        if self.spins() {
            self.refuse(
                format!("{path}.shape.surface"),
                "a body built of grains is made for law Repulsion",
                "choose surface: Grid() or Exact",
            );
        }
        for (field, given) in [
            ("restitution", raw.restitution.is_some()),
            ("friction", raw.friction.is_some()),
            ("touches_at", raw.touches_at.is_some()),
        ] {
            if given {
                self.refuse(
                    format!("{path}.{field}"),
                    format!("a body built of grains has no {field}: grains touch it by their own law"),
                    format!("leave the field out, or write {field}=None in an override; or choose surface: Grid() or Exact"),
                );
            }
        }
    }

    /// Refuses a motion that begins when its wall is gone.
    fn moves_while_there(&mut self, path: &str, motion: &Motion, removed: Removal) {
        let late = match (removed, motion.begins) {
            (Removal::At(gone), Begin::At(begins)) => begins >= gone,
            (Removal::WhenStill, Begin::WhenStill) => true,
            _ => false,
        };
        if late {
            self.refuse(
                format!("{path}.motion"),
                "this wall is gone by the time it would begin to move",
                "let it begin earlier, or remove it later",
            );
        }
    }

    /// Refuses a name that paths could not tell from something else; `owners` are one of its kind and two.
    pub(super) fn name(&mut self, path: &str, owners: [&str; 2], name: &str, twice: bool) {
        let path = format!("{path}.name");
        let [one, two] = owners;
        if name.trim().is_empty() {
            self.refuse(
                path,
                format!("{one}'s name is empty"),
                "name it, as in \"floor\": messages and results speak of it by name",
            );
        } else if name.contains(['.', '[', ']', '=', '"', '\\'])
            || name.chars().any(char::is_control)
        {
            self.refuse(
                path,
                format!("{one}'s name holds one of . [ ] = \" \\"),
                "paths such as walls.floor.friction name it: use letters, digits, spaces, -",
            );
        } else if name.parse::<usize>().is_ok() {
            self.refuse(
                path,
                format!("{one}'s name is a number"),
                "in paths a number is the place in the list: add a word",
            );
        } else if twice {
            self.refuse(
                path,
                format!("{two} are named “{name}”"),
                "give each its own name",
            );
        }
    }

    /// Whatever waits for stillness needs the block that says when that is, and the block needs someone who waits.
    pub(super) fn stillness(&mut self, scene: &Scene) {
        let (waits, instead) = if scene.removes_when_still() {
            ("a wall is removed WhenStill", "remove the wall At(\"…\")")
        } else if scene.moves_when_still() {
            (
                "a wall begins to move WhenStill",
                "let its motion begin At(\"…\")",
            )
        } else {
            if scene.still.is_some() {
                self.refuse(
                    "still",
                    "no wall is removed WhenStill and none begins to move then, so “still” would be ignored",
                    "remove the block, or write removed: WhenStill for a wall, or begins: WhenStill for its motion",
                );
            }
            return;
        };
        if scene.still.is_none() {
            self.refuse(
                "",
                format!("{waits}, but the block “still” does not say when that is"),
                "add still: (kinetic_energy: 1e-4, for_at_least: \"20 ms\", at_most: \"3 s\")",
            );
        }
        if scene.gravity == 0.0 {
            self.refuse(
                "gravity",
                format!("{waits}, which is measured against m g d, but there is no gravity"),
                format!("give gravity a value, or {instead}"),
            );
        }
    }
}
