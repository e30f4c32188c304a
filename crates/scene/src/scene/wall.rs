//! Walls: their shapes, and what a grain finds when it touches one.

use std::path::PathBuf;

use glam::DVec3;

use super::Motion;

/// A wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Unique, not empty, without `.`, `[`, `]` and `=`.
    pub name: String,
    /// Its surface.
    pub shape: Shape,
    /// Number of its material; `None`: touched by the grains' own law, with the restitution and the friction below.
    pub material: Option<usize>,
    /// Restitution in (0, 1]; `None`: elastic, without damping, built of grains, or of a material.
    pub restitution: Option<f64>,
    /// Coefficient of kinetic friction; `None`: smooth, built of grains, or of a material.
    pub friction: Option<f64>,
    /// Where a grain touches it.
    pub touches_at: TouchesAt,
    /// When it is taken away.
    pub removed: Removal,
    /// How it moves; `None`: it rests.
    pub motion: Option<Motion>,
}

/// The surface of a wall, where it stands at the start; in the plane only `HalfSpace`, `Ball` and `Cuboid`.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Everything behind a plane.
    HalfSpace {
        /// A point of the plane, m.
        point: DVec3,
        /// The outward normal, towards the grains, of length 1.
        outward: DVec3,
    },
    /// A solid ball; in the plane a disc.
    Ball {
        /// Its centre, m.
        centre: DVec3,
        /// Its radius, m, above zero.
        radius: f64,
    },
    /// A solid block along the axes; in the plane a rectangle, whose y is zero at both corners.
    Cuboid {
        /// The corner of the smallest x, y and z, m.
        min: DVec3,
        /// The corner of the largest x, y and z, m, above `min` on every axis.
        max: DVec3,
    },
    /// A solid round bar with flat ends.
    Cylinder {
        /// The centre of one end, m.
        from: DVec3,
        /// The centre of the other end, m, another point.
        to: DVec3,
        /// Its radius, m, above zero.
        radius: f64,
    },
    /// A round pipe with open ends; grains may be inside and outside.
    Tube {
        /// The centre of one end, m.
        from: DVec3,
        /// The centre of the other end, m, another point.
        to: DVec3,
        /// Inner radius, m, above zero.
        inner: f64,
        /// Outer radius, m, above the inner one.
        outer: f64,
    },
    /// The wall of a hopper: a hollow frustum with open ends.
    Cone {
        /// The centre of one end, m.
        from: DVec3,
        /// The centre of the other end, m, another point.
        to: DVec3,
        /// Inner radii at `from` and at `to`, m, above zero.
        radii: [f64; 2],
        /// Thickness of the wall, m, above zero.
        thickness: f64,
    },
    /// A screw: a shaft with one helical flight.
    Screw {
        /// Where the axis begins, m.
        from: DVec3,
        /// Where the axis ends, m, another point.
        to: DVec3,
        /// Diameter of the shaft, m, above zero.
        shaft: f64,
        /// Diameter over the flight, m, above that of the shaft.
        outer: f64,
        /// Length of one turn of the flight along the axis, m, above its thickness.
        pitch: f64,
        /// Thickness of the flight along the axis, m, above zero.
        thickness: f64,
        /// The sense of the flight.
        hand: Hand,
    },
    /// A surface read from a file of triangles.
    Mesh {
        /// The file.
        mesh: MeshFile,
        /// How the distance to it is found.
        surface: MeshSurface,
        /// Thickness that an open sheet is given, m, above zero; `None`: as the file has it.
        thickness: Option<f64>,
    },
}

impl Shape {
    /// The choice as it is written in a scene.
    pub fn name(&self) -> &'static str {
        match self {
            Shape::HalfSpace { .. } => "HalfSpace",
            Shape::Ball { .. } => "Ball",
            Shape::Cuboid { .. } => "Cuboid",
            Shape::Cylinder { .. } => "Cylinder",
            Shape::Tube { .. } => "Tube",
            Shape::Cone { .. } => "Cone",
            Shape::Screw { .. } => "Screw",
            Shape::Mesh { .. } => "Mesh",
        }
    }

    /// Radius of its wall grains, m, if it is a body built of grains.
    pub fn wall_grains(&self) -> Option<f64> {
        match self {
            Shape::Mesh {
                surface: MeshSurface::Grains { radius, .. },
                ..
            } => Some(*radius),
            _ => None,
        }
    }
}

/// The sense in which the flight of a screw winds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hand {
    /// As the threads of usual bolts: going along the axis the flight turns clockwise.
    #[default]
    Right,
    /// The mirror image.
    Left,
}

/// A file of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// The file, an absolute path.
    pub path: PathBuf,
    /// Metres per unit of its coordinates: 1, 0.01, 0.001 or 0.0254.
    pub unit: f64,
}

/// How the distance to a mesh is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshSurface {
    /// From a grid of distances around the surface.
    Grid {
        /// Width of a cell, m, above zero; `None`: the program chooses.
        cell: Option<f64>,
        /// Whether cells at edges ask the triangles themselves.
        exact_edges: bool,
    },
    /// From the triangles.
    Exact,
    /// The mesh is filled with wall grains, and grains touch these by their own law: such a wall has
    /// no restitution and no friction, and `touches_at` says nothing.
    Grains {
        /// Radius of a wall grain, m, above zero; a coarse level leaves it as it is.
        radius: f64,
        /// What becomes of parts too thin to hold a wall grain.
        thin: Thin,
    },
}

/// What becomes of parts of a body of grains that are too thin to hold a grain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Thin {
    /// They stay empty.
    Leave,
    /// One layer of grains in their middle, sticking out of both faces alike.
    #[default]
    OneLayer,
}

impl Default for MeshSurface {
    fn default() -> Self {
        MeshSurface::Grid {
            cell: None,
            exact_edges: false,
        }
    }
}

/// Which distance from the surface enters the law in place of the distance of two centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TouchesAt {
    /// s = R + d/2: the grain's surface touches the wall.
    #[default]
    Surface,
    /// s = R, the literal reading of the paper: the wall stands d/2 further in.
    Centre,
}

/// When a wall is taken away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Removal {
    /// It stays.
    #[default]
    Never,
    /// Once the grains are still, see [`Still`](super::Still).
    WhenStill,
    /// At this time from the start, s.
    At(f64),
}
