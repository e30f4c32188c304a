//! The rules of the shapes of walls.

use glam::DVec3;

use super::Rules;
use super::room::periods;
use super::vectors::{lengths, numbers};
use crate::quantity::{Length, Number, Quantity, Triple};
use crate::raw::{MeshUnit, RawHand, RawRegion, RawShape, RawSurface, RawThin};
use crate::scene::{Domain, Hand, MeshFile, MeshSurface, Region, Shape, Space, Thin};

impl Rules<'_> {
    pub(super) fn shape(&mut self, path: &str, raw: &RawShape, domain: &Domain) -> Shape {
        let length = |rules: &mut Self, field: &str, name: &str, value: &Quantity<Length>| {
            rules.above_zero(&format!("{path}.{field}"), name, value.0)
        };
        let shape = match raw {
            RawShape::HalfSpace { point, outward } => self.half_space(path, point, outward, domain),
            RawShape::Ball { centre, radius } => {
                let centre = lengths(centre);
                self.in_plane(&format!("{path}.centre"), centre);
                let radius = length(self, "radius", "the radius", radius);
                Shape::Ball { centre, radius }
            }
            RawShape::Cuboid { min, max } => {
                let corners = RawRegion {
                    min: *min,
                    max: *max,
                };
                let Region { min, max } = self.region(path, "cuboid", &corners);
                Shape::Cuboid { min, max }
            }
            RawShape::Cylinder { from, to, radius } => {
                let [from, to] = self.ends(path, from, to);
                let radius = length(self, "radius", "the radius", radius);
                Shape::Cylinder { from, to, radius }
            }
            RawShape::Tube {
                from,
                to,
                inner,
                outer,
            } => {
                let [from, to] = self.ends(path, from, to);
                let inner = length(self, "inner", "the inner radius", inner);
                let outer = length(self, "outer", "the outer radius", outer);
                self.above(
                    &format!("{path}.outer"),
                    ["the outer radius", "the inner one"],
                    outer,
                    inner,
                );
                Shape::Tube {
                    from,
                    to,
                    inner,
                    outer,
                }
            }
            RawShape::Cone {
                from,
                to,
                radii,
                thickness,
            } => {
                let [from, to] = self.ends(path, from, to);
                let radii = [0, 1].map(|i| {
                    length(
                        self,
                        &format!("radii[{i}]"),
                        "the inner radius",
                        &radii.0[i],
                    )
                });
                let thickness = length(self, "thickness", "the thickness", thickness);
                Shape::Cone {
                    from,
                    to,
                    radii,
                    thickness,
                }
            }
            RawShape::Screw {
                from,
                to,
                shaft,
                outer,
                pitch,
                thickness,
                hand,
            } => {
                let [from, to] = self.ends(path, from, to);
                let shaft = length(self, "shaft", "the diameter of the shaft", shaft);
                let outer = length(self, "outer", "the outer diameter", outer);
                let pitch = length(self, "pitch", "the pitch", pitch);
                let thickness = length(self, "thickness", "the thickness", thickness);
                self.above(
                    &format!("{path}.outer"),
                    ["the outer diameter", "that of the shaft"],
                    outer,
                    shaft,
                );
                self.above(
                    &format!("{path}.pitch"),
                    ["the pitch", "the thickness of the flight"],
                    pitch,
                    thickness,
                );
                let hand = match hand {
                    None | Some(RawHand::Right) => Hand::Right,
                    Some(RawHand::Left) => Hand::Left,
                };
                Shape::Screw {
                    from,
                    to,
                    shaft,
                    outer,
                    pitch,
                    thickness,
                    hand,
                }
            }
            RawShape::Mesh {
                file,
                unit,
                surface,
                thickness,
            } => {
                let mesh = self.mesh(path, file, *unit);
                let thickness = thickness
                    .as_ref()
                    .map(|value| length(self, "thickness", "the thickness", value));
                let surface = self.surface(&format!("{path}.surface"), *surface);
                Shape::Mesh {
                    mesh,
                    surface,
                    thickness,
                }
            }
        };
        let flat = matches!(
            shape,
            Shape::HalfSpace { .. } | Shape::Ball { .. } | Shape::Cuboid { .. }
        );
        if self.space == Space::Plane && !flat {
            self.refuse(
                path,
                format!("a plane scene has no {}", shape.name()),
                "write a HalfSpace, a Ball or a Cuboid, or space: Space",
            );
        }
        shape
    }

    fn half_space(
        &mut self,
        path: &str,
        point: &Triple<Quantity<Length>>,
        outward: &Triple<Number>,
        domain: &Domain,
    ) -> Shape {
        let point = lengths(point);
        self.in_plane(&format!("{path}.point"), point);
        let path = format!("{path}.outward");
        self.in_plane(&path, numbers(outward));
        let example = "write the direction towards the grains, such as (0, 0, 1)";
        let outward = self.direction(&path, "outward normal", example, outward);
        for (i, name, _) in periods(domain) {
            if outward[i].abs() > 1e-12 {
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

    /// The two ends of an axis.
    fn ends(
        &mut self,
        path: &str,
        from: &Triple<Quantity<Length>>,
        to: &Triple<Quantity<Length>>,
    ) -> [DVec3; 2] {
        let ends = [lengths(from), lengths(to)];
        if ends[0] == ends[1] {
            self.refuse(
                format!("{path}.to"),
                "this shape ends where it begins: from and to are one point",
                "write the two ends of its axis",
            );
        }
        ends
    }

    /// Refuses a value that is not above another; `names` are those of the two.
    pub(super) fn above(&mut self, path: &str, names: [&str; 2], value: f64, least: f64) {
        // A value below zero has been refused already.
        if value > 0.0 && least >= 0.0 && value <= least {
            let [name, other] = names;
            self.refuse(
                path,
                format!("{name} is not above {other}"),
                format!("write more than \"{least:?} m\""),
            );
        }
    }

    pub(super) fn mesh(&mut self, path: &str, file: &str, unit: MeshUnit) -> MeshFile {
        MeshFile {
            path: self.file(&format!("{path}.file"), "mesh", file),
            unit: unit.0,
        }
    }

    fn surface(&mut self, path: &str, raw: Option<RawSurface>) -> MeshSurface {
        match raw {
            None => MeshSurface::default(),
            Some(RawSurface::Exact) => MeshSurface::Exact,
            Some(RawSurface::Grains { radius, thin }) => MeshSurface::Grains {
                radius: self.above_zero(
                    &format!("{path}.radius"),
                    "the radius of the wall grains",
                    radius.0,
                ),
                thin: match thin {
                    None | Some(RawThin::OneLayer) => Thin::OneLayer,
                    Some(RawThin::Leave) => Thin::Leave,
                },
            },
            Some(RawSurface::Grid { cell, exact_edges }) => MeshSurface::Grid {
                cell: cell.map(|cell| {
                    self.above_zero(&format!("{path}.cell"), "the width of a cell", cell.0)
                }),
                exact_edges: exact_edges.unwrap_or(false),
            },
        }
    }
}
