//! The meshes of the suite, finer than the grids that are tried on them, and the surfaces made of them.

use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use std::sync::Arc;
use tsubu_model::{Shell, Space, Surface};
use tsubu_sdf::mesh::Report as Doctor;
use tsubu_sdf::{DistanceGrid, ExactMesh, GridOptions, Mesh};

/// Any surface, shared with a world.
pub type Shared = Arc<dyn Surface<Space>>;

/// The mesh turned and shifted.
pub fn placed(mut mesh: Mesh, turn: DMat3, shift: DVec3) -> Mesh {
    for vertex in &mut mesh.vertices {
        *vertex = turn * *vertex + shift;
    }
    mesh
}

/// A box between two corners.
pub fn cuboid(low: DVec3, high: DVec3) -> Result<Mesh, String> {
    let block = tsubu_sdf::Cuboid::<Space>::new(low, high).map_err(|e| e.to_string())?;
    block
        .shell()
        .map(Mesh::from)
        .ok_or("a box has no shell".into())
}

/// A profile of (radius, height) turned about z: from pole to pole, or round and closed in itself.
pub fn turned(profile: &[[f64; 2]], closed: bool, steps: usize) -> Mesh {
    let mut shell = Shell::default();
    for &[radius, height] in profile {
        for k in 0..steps {
            let (sin, cos) = (TAU * k as f64 / steps as f64).sin_cos();
            let corner = DVec3::new(radius * cos, radius * sin, height);
            shell.vertices.push(corner);
        }
    }
    let rings = profile.len();
    let corner = |ring: usize, k: usize| ((ring % rings) * steps + k % steps) as u32;
    for ring in 0..if closed { rings } else { rings - 1 } {
        for k in 0..steps {
            let quad = [(ring, k), (ring, k + 1), (ring + 1, k + 1), (ring + 1, k)];
            let [a, b, c, d] = quad.map(|(ring, k)| corner(ring, k));
            // At a pole one of the two has no area; welding drops it.
            shell.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::from(shell)
}

/// A ball about the origin whose rings lie at these polar angles between the poles.
pub fn ball(radius: f64, angles: &[f64], steps: usize) -> Mesh {
    let profile: Vec<[f64; 2]> = angles
        .iter()
        .map(|a| [radius * a.sin(), radius * a.cos()])
        .collect();
    turned(&profile, false, steps)
}

/// `rings` + 1 polar angles from 0 to π, evenly apart.
pub fn even(rings: usize) -> Vec<f64> {
    (0..=rings)
        .map(|k| 0.5 * TAU * k as f64 / rings as f64)
        .collect()
}

/// A ring about z, its section of `sides` corners.
pub fn torus(ring: f64, section: f64, steps: usize, sides: usize) -> Mesh {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / sides as f64).sin_cos();
        [ring + section * cos, section * sin]
    };
    turned(&(0..sides).map(corner).collect::<Vec<_>>(), true, steps)
}

/// The grid of a mesh.
pub fn grid(mesh: &Mesh, cell: f64, band: f64, exact_edges: bool) -> Result<DistanceGrid, String> {
    let options = GridOptions {
        exact_edges,
        ..GridOptions::new(cell, band)
    };
    DistanceGrid::build(mesh, &options, &|_| ()).map_err(|e| e.to_string())
}

/// The triangles themselves.
pub fn exact(mesh: &Mesh) -> Result<ExactMesh, String> {
    ExactMesh::body(mesh).map_err(|e| e.to_string())
}

/// The cell that a user would take: a quarter of the grain or what the doctor says, whichever is smaller.
pub fn usual_cell(mesh: &Mesh, diameter: f64) -> f64 {
    let advice = Doctor::of(mesh).cell_advice();
    advice
        .map_or(f64::INFINITY, |a| a.cell)
        .min(0.25 * diameter)
}
