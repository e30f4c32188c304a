//! Walls for rebounds, each as a formula and as a mesh, from flat to bent as a shaft.

use super::bench::Bench;
use super::shapes::{self, Shared};
use glam::DVec3;
use std::f64::consts::TAU;
use std::sync::Arc;
use tsubu_model::Space;
use tsubu_sdf::{Ball, Cylinder, HalfSpace, Mesh, Tube};

/// A wall said in several ways.
pub struct Wall {
    /// As the table calls it.
    pub name: &'static str,
    /// The surface itself.
    pub formula: Shared,
    /// Its triangles.
    pub mesh: Mesh,
    /// The principal curvatures where the grain's centre is, in 1/m.
    pub curvature: [f64; 2],
    /// A point of the surface and its normal, from two numbers in 0…1.
    pub place: fn(f64, f64) -> (DVec3, DVec3),
}

/// Radii in m: of the feeder's shaft and casing, and of a ball between them.
const SHAFT: f64 = 0.0275;
const CASING: f64 = 0.1148;
const BALL: f64 = 0.05;

/// A plane, a shaft, the inside of a tube, a ball.
pub fn walls(bench: &Bench) -> Result<Vec<Wall>, String> {
    let wrong = |e: tsubu_sdf::Misshapen| e.to_string();
    let (from, to) = (DVec3::X * -0.03, DVec3::X * 0.03);
    let shaft = Cylinder::new(from, to, SHAFT).map_err(wrong)?;
    let casing = Tube::new(from, to, CASING, CASING + 0.0102).map_err(wrong)?;
    // Chords of N sides: R(1 − cos(π/N)); with N = 1440 a facet's normal is off by 0.125° at its edges.
    let chord = |radius: f64| radius * (1.0 - (0.5 * TAU / 1440.0).cos());
    // Rings near the pole, where the grains meet the ball, are 0.15° apart.
    let mut angles: Vec<f64> = (0..=50).map(|k| f64::from(k) * 2.6e-3).collect();
    angles.extend((1..=60).map(|k| 0.13 + (0.5 * TAU - 0.13) * f64::from(k) / 60.0));
    let half = bench.kind.radius;
    Ok(vec![
        Wall {
            name: "plane",
            formula: Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z)),
            mesh: shapes::cuboid(DVec3::new(-0.05, -0.05, -0.04), DVec3::new(0.05, 0.05, 0.0))?,
            curvature: [0.0; 2],
            place: |s, t| {
                (
                    DVec3::new(0.02 * (s - 0.5), 0.02 * (t - 0.5), 0.0),
                    DVec3::Z,
                )
            },
        },
        Wall {
            name: "shaft, R = 27.5 mm",
            formula: Arc::new(shaft.clone()),
            mesh: Mesh::from(shaft.mesh(chord(SHAFT))),
            curvature: [1.0 / (SHAFT + half), 0.0],
            place: |s, t| {
                let (sin, cos) = (0.9 * (t - 0.5)).sin_cos();
                let normal = DVec3::new(0.0, sin, cos);
                (normal * SHAFT + DVec3::X * 0.02 * (s - 0.5), normal)
            },
        },
        Wall {
            name: "inside of a tube, R = 114.8 mm",
            formula: Arc::new(casing.clone()),
            mesh: Mesh::from(casing.mesh(chord(CASING))),
            curvature: [-1.0 / (CASING - half), 0.0],
            place: |s, t| {
                let (sin, cos) = (0.9 * (t - 0.5)).sin_cos();
                let normal = DVec3::new(0.0, sin, cos);
                (normal * -CASING + DVec3::X * 0.02 * (s - 0.5), normal)
            },
        },
        Wall {
            name: "ball, R = 50 mm",
            formula: Arc::new(Ball::<Space>::new(DVec3::ZERO, BALL).map_err(wrong)?),
            mesh: shapes::ball(BALL, &angles, 256),
            curvature: [1.0 / (BALL + half); 2],
            place: |s, t| {
                let (tilt, (sin, cos)) = (0.01 + 0.08 * s, (TAU * t).sin_cos());
                let normal = DVec3::new(tilt.sin() * cos, tilt.sin() * sin, tilt.cos());
                (normal * BALL, normal)
            },
        },
    ])
}
