//! Surfaces as signed distances: positive outside the body, negative inside.
//!
//! ```
//! use glam::DVec3;
//! use tsubu_model::{Space, Surface};
//! use tsubu_sdf::HalfSpace;
//! let floor = HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z);
//! assert_eq!(floor.lower_bound(DVec3::new(5.0, 1.0, 0.25)), 0.25);
//! ```
//!
//! A body from a CAD program: read, examined, made a grid of distances.
//!
//! ```
//! use glam::DVec3;
//! use tsubu_sdf::mesh::{parse_stl, Report, Verdict};
//! use tsubu_sdf::{DistanceGrid, GridOptions};
//! // A wedge of 30 × 20 × 20 mm, as text; a file is read with Mesh::read("wedge.stl", 0.001).
//! let corners = ["0 0 0", "30 0 0", "0 20 0", "0 0 20"];
//! let mut text = String::from("solid wedge\n");
//! for [a, b, c] in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
//!     let [a, b, c] = [corners[a], corners[b], corners[c]];
//!     text += &format!("facet normal 0 0 0 outer loop vertex {a} vertex {b} vertex {c} endloop endfacet\n");
//! }
//! let mesh = parse_stl(text.as_bytes(), 1e-3)?;
//! assert_eq!(Report::of(&mesh).verdict, Verdict::Clean);
//! // Cells of 1 mm, for grains of up to 3 mm radius: the band is their reach and two cells.
//! let grid = DistanceGrid::build(&mesh, &GridOptions::new(1e-3, 5e-3), &|_progress| ())?;
//! let (distance, normal) = grid.distance_and_normal(DVec3::new(5e-3, 5e-3, -2e-3)).unwrap();
//! assert!((distance - 2e-3).abs() < 1e-9);
//! assert!((normal - DVec3::NEG_Z).length() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod ball;
mod cavity;
mod cuboid;
mod drawing;
mod exact;
mod grain_body;
mod grid;
mod half_space;
mod lattice;
pub mod mesh;
mod profile;
mod round;
mod screw;
mod solid;
pub mod testing;
mod torus;
mod tree;
mod triangle;
mod winding;

pub use ball::Ball;
pub use cavity::Cavity;
pub use cuboid::Cuboid;
pub use drawing::{steps_for, volume};
pub use exact::ExactMesh;
pub use grain_body::{GrainBody, GrainBodyError, GrainBodyOptions};
pub use grid::{DistanceGrid, GridError, GridOptions};
pub use half_space::HalfSpace;
pub use lattice::{Thin, fill_fcc};
pub use mesh::Mesh;
pub use round::{Cone, Cylinder, HollowCone, Tube};
pub use screw::{Hand, Screw, ScrewSize};
pub use solid::{Misshapen, Solid};
pub use torus::Torus;
pub use winding::Winding;

/// Distance of x from a box, zero within it.
fn distance_to_box(x: glam::DVec3, [low, high]: [glam::DVec3; 2]) -> f64 {
    (x - x.clamp(low, high)).length()
}
