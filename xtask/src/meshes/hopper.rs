//! The conical hopper: a cylinder on a cone with an opening, and the room inside it.
//!
//! Beads of 4 mm: the opening is nine of them wide, the cylinder 2.8 openings. The axis is the z axis, the opening lies at z = 0.

use glam::DVec3;
use std::f64::consts::PI;
use tsubu_model::Shell;
use tsubu_sdf::steps_for;

/// Radius of the opening, of the cylinder, and height of its top, in m.
const OPENING: f64 = 0.018;
const INNER: f64 = 0.050;
const TOP: f64 = 0.300;
/// The cone falls by 45°.
const CONE: f64 = INNER - OPENING;
/// Thickness of the cylinder, and of the cone along the radius.
const WALL: f64 = 0.004;
const RIM: f64 = 0.006;
/// Room left between the grains of the start and the walls.
const CLEAR: f64 = 0.001;

/// Cylinder and cone as one closed shell.
pub fn hopper(chord: f64) -> Shell {
    let outer = INNER + WALL;
    revolved(
        &[
            [OPENING, 0.0],
            [OPENING + RIM, 0.0],
            [outer, outer - OPENING - RIM],
            [outer, TOP],
            [INNER, TOP],
            [INNER, CONE],
        ],
        chord,
    )
}

/// The room inside, from the opening to a little below the rim.
pub fn inside(chord: f64) -> Shell {
    let (low, wide) = (OPENING - CLEAR, INNER - CLEAR);
    let shift = CLEAR * (2f64.sqrt() - 1.0);
    revolved(
        &[
            [0.0, CLEAR],
            [low, CLEAR],
            [wide, CONE + shift],
            [wide, TOP - CLEAR],
            [0.0, TOP - CLEAR],
        ],
        chord,
    )
}

/// The body of revolution of a closed profile of [radius, z], anticlockwise with the radius to the right, about the z axis.
/// A point of radius zero is one vertex.
fn revolved(profile: &[[f64; 2]], chord: f64) -> Shell {
    let widest = profile.iter().map(|p| p[0]).fold(0.0, f64::max);
    let steps = steps_for(widest, chord);
    let (mut vertices, mut rings) = (Vec::new(), Vec::new());
    for &[radius, z] in profile {
        let first = vertices.len() as u32;
        let count = if radius == 0.0 { 1 } else { steps };
        rings.push((first, count as u32));
        vertices.extend((0..count).map(|k| {
            let (sin, cos) = (2.0 * PI * k as f64 / steps as f64).sin_cos();
            DVec3::new(radius * cos, radius * sin, z)
        }));
    }
    let mut triangles = Vec::new();
    for (i, &(a, many_a)) in rings.iter().enumerate() {
        let (b, many_b) = rings[(i + 1) % rings.len()];
        for k in 0..steps as u32 {
            let next = (k + 1) % steps as u32;
            let at = |first: u32, many: u32, k: u32| first + if many == 1 { 0 } else { k };
            let [a0, a1] = [k, next].map(|k| at(a, many_a, k));
            let [b0, b1] = [k, next].map(|k| at(b, many_b, k));
            triangles.extend([[a0, a1, b1], [a0, b1, b0]].into_iter().filter(proper));
        }
    }
    Shell {
        vertices,
        triangles,
    }
}

/// False for a triangle with an edge of no length.
fn proper(t: &[u32; 3]) -> bool {
    t[0] != t[1] && t[1] != t[2] && t[2] != t[0]
}

/// Volumes in m³ of the hopper's solid and of the room inside, from cylinders and frusta.
#[cfg(test)]
pub fn volumes() -> [f64; 2] {
    let frustum = |a: f64, b: f64, h: f64| PI / 3.0 * h * (a * a + a * b + b * b);
    let cylinder = |r: f64, h: f64| PI * r * r * h;
    let outer = INNER + WALL;
    let high = outer - OPENING - RIM;
    let solid = frustum(OPENING + RIM, outer, high) + cylinder(outer, TOP - high)
        - frustum(OPENING, INNER, CONE)
        - cylinder(INNER, TOP - CONE);
    let (low, wide) = (OPENING - CLEAR, INNER - CLEAR);
    let bend = CONE + CLEAR * (2f64.sqrt() - 1.0);
    let room = frustum(low, wide, bend - CLEAR) + cylinder(wide, TOP - CLEAR - bend);
    [solid, room]
}
