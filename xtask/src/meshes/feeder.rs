//! The bodies of the screw feeder: screw, casing, hopper, and the region that grains fill.
//!
//! From paper A: screw of 205 mm on a shaft of 55 mm, pitch 150 mm, 4.5 pitches, casing of 229.6 mm,
//! inlet opening of 318 mm. Read into it: flight of 6 mm, walls of 10 mm, a trough under the inlet with
//! vertical sides up to 160 mm, a tube from there to 550 mm, the screw free beyond it, a hopper up to 1 m.
//! The flight is cut at right angles to its sweep, half a thickness before each end of the shaft: its
//! middle runs from 6 to 669 mm, 4.42 turns, and would pass x = 0 in the direction +y.
//! Each body is made of closed shells; those of the casing overlap or abut.

use glam::DVec3;
use std::f64::consts::PI;
use tsubu_model::{Shell, Space, Surface};
use tsubu_sdf::{Cuboid, Hand, Misshapen, Screw, ScrewSize, Tube, steps_for};

/// How far a chord may lie from its surface, in m: a hundredth of the flight's thickness.
pub const CHORD: f64 = 5e-5;

/// Advance of the flight per turn, in m.
const PITCH: f64 = 0.150;
/// Inner radius of trough and tube, in m.
const INNER: f64 = 0.1148;
/// Thickness of every wall.
const WALL: f64 = 0.010;
/// Length of the inlet opening.
const INLET: f64 = 318.0 * 1e-3;
/// Where the tube ends.
const OUTLET: f64 = 0.550;
/// Where the sides of the trough end and the hopper begins.
const SIDES: f64 = 0.160;
/// Top of the hopper.
const TOP: f64 = 1.0;

/// The screw, from x = 0 to 675 mm along the x axis, right-handed.
pub fn screw() -> Result<Screw, Misshapen> {
    screw_between(0.0, 4.5 * PITCH)
}

/// The same screw for a section of one pitch that repeats from x = 0 on: one pitch beyond both of its ends.
pub fn screw_section() -> Result<Screw, Misshapen> {
    screw_between(-PITCH, 2.0 * PITCH)
}

fn screw_between(from: f64, to: f64) -> Result<Screw, Misshapen> {
    let size = ScrewSize {
        shaft: 0.0275,
        outer: 0.1025,
        pitch: PITCH,
        thickness: 0.006,
    };
    Screw::new(DVec3::X * from, DVec3::X * to, size, Hand::Right)
}

/// Trough, tube, the plate behind the inlet and the wall over the beginning of the tube.
pub fn casing() -> Result<Vec<Shell>, Misshapen> {
    let outer = INNER + WALL;
    let steps = steps_for(outer, CHORD);
    let ring = |radius: f64, from: usize, to: usize| {
        (from..=to).map(move |k| {
            let (sin, cos) = (2.0 * PI * k as f64 / steps as f64).sin_cos();
            [radius * cos, radius * sin]
        })
    };
    // The trough: down the side of −y, through the lower half circle, up the side of +y.
    let trough = |radius: f64| -> Vec<[f64; 2]> {
        std::iter::once([-radius, SIDES])
            .chain(ring(radius, steps / 2, steps))
            .chain([[radius, SIDES]])
            .collect()
    };
    // The wall over the tube reaches into the middle of the tube's own wall.
    let hold = INNER + 0.5 * WALL;
    let mut angles: Vec<f64> = (0..=steps / 2)
        .map(|k| 2.0 * PI * k as f64 / steps as f64)
        .collect();
    let corner = SIDES.atan2(outer);
    angles.extend([corner, PI - corner]);
    angles.sort_by(f64::total_cmp);
    let arc: Vec<[f64; 2]> = angles
        .iter()
        .map(|a| [hold * a.cos(), hold * a.sin()])
        .collect();
    let edge: Vec<[f64; 2]> = angles
        .iter()
        .map(|a| {
            let (sin, cos) = a.sin_cos();
            let scale = (outer / cos.abs()).min(SIDES / sin.max(1e-12));
            [scale * cos, scale * sin]
        })
        .collect();
    let tube = Tube::new(DVec3::X * INLET, DVec3::X * OUTLET, INNER, outer)?;
    Ok(vec![
        strip(&trough(INNER), &trough(outer), 0.0, INLET),
        tube.mesh(CHORD),
        block([-WALL, -outer, -outer], [0.0, outer, SIDES])?,
        strip(&arc, &edge, INLET, INLET + WALL),
    ])
}

/// Four plates on top of the trough.
pub fn hopper() -> Result<Vec<Shell>, Misshapen> {
    let outer = INNER + WALL;
    Ok(vec![
        block([-WALL, INNER, SIDES], [INLET + WALL, outer, TOP])?,
        block([-WALL, -outer, SIDES], [INLET + WALL, -INNER, TOP])?,
        block([-WALL, -outer, SIDES], [0.0, outer, TOP])?,
        block([INLET, -outer, SIDES], [INLET + WALL, outer, TOP])?,
    ])
}

/// The region to fill: the inside of hopper and upper trough, above the screw.
pub fn fill() -> Result<Vec<Shell>, Misshapen> {
    Ok(vec![block([0.006, -0.109, 0.110], [0.312, 0.109, 0.990])?])
}

/// The hopper for paper A's 200 000 grains: on the same opening, but widening to 1200 × 1000 mm over 1.2 m.
pub fn wide_hopper() -> Shell {
    let inside = frustum([INLET, 2.0 * INNER], [1.2, 1.0], SIDES, SIDES + 1.2);
    let outside = frustum(
        [INLET + 2.0 * WALL, 2.0 * INNER + 2.0 * WALL],
        [1.2 + 2.0 * WALL, 1.0 + 2.0 * WALL],
        SIDES,
        SIDES + 1.2,
    );
    let mut shell = Shell {
        vertices: [inside, outside].concat(),
        triangles: Vec::new(),
    };
    let mut quad = |[a, b, c, d]: [u32; 4]| shell.triangles.extend([[a, b, c], [a, c, d]]);
    for k in 0..4u32 {
        let next = (k + 1) % 4;
        // Corners 0–3 below and 4–7 above, the same eight further out.
        quad([k, k + 4, next + 4, next]);
        quad([8 + k, 8 + next, 12 + next, 12 + k]);
        quad([k, next, 8 + next, 8 + k]);
        quad([4 + k, 12 + k, 12 + next, 4 + next]);
    }
    shell
}

/// The region to fill in it.
pub fn wide_fill() -> Shell {
    let mut shell = Shell {
        vertices: frustum([0.28, 0.19], [1.10, 0.91], SIDES + 0.03, SIDES + 1.18),
        triangles: Vec::new(),
    };
    let mut quad = |[a, b, c, d]: [u32; 4]| shell.triangles.extend([[a, b, c], [a, c, d]]);
    for k in 0..4u32 {
        let next = (k + 1) % 4;
        quad([k, next, next + 4, k + 4]);
    }
    quad([3, 2, 1, 0]);
    quad([4, 5, 6, 7]);
    shell
}

/// The corners of a frustum over the middle of the inlet, from a rectangle (along x, along y) at `low` to one at
/// `high`; each counter-clockwise seen from above.
fn frustum(bottom: [f64; 2], top: [f64; 2], low: f64, high: f64) -> Vec<DVec3> {
    let ring = |[x, y]: [f64; 2], z: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[s, t]| DVec3::new(0.5 * (INLET + s * x), 0.5 * t * y, z))
    };
    [ring(bottom, low), ring(top, high)].concat()
}

fn block(low: [f64; 3], high: [f64; 3]) -> Result<Shell, Misshapen> {
    let block = Cuboid::<Space>::new(DVec3::from(low), DVec3::from(high))?;
    Ok(block.shell().unwrap_or_default())
}

/// The strip between two chains of points (y, z) in the plane across x, drawn out from `from` to `to`
/// along x. Both chains run counter-clockwise about x; `outer` is to the right of `inner`.
fn strip(inner: &[[f64; 2]], outer: &[[f64; 2]], from: f64, to: f64) -> Shell {
    let count = inner.len();
    let mut shell = Shell::default();
    for (chain, x) in [(inner, from), (outer, from), (inner, to), (outer, to)] {
        let corners = chain.iter().map(|&[y, z]| DVec3::new(x, y, z));
        shell.vertices.extend(corners);
    }
    let corner = |far: bool, outside: bool, k: usize| {
        ((2 * usize::from(far) + usize::from(outside)) * count + k) as u32
    };
    let mut quad = |[a, b, c, d]: [u32; 4]| shell.triangles.extend([[a, b, c], [a, c, d]]);
    for k in 0..count - 1 {
        let around =
            |far: bool, outside: bool| [corner(far, outside, k), corner(far, outside, k + 1)];
        let ([a, b], [c, d]) = (around(false, true), around(true, true));
        quad([a, b, d, c]);
        let ([a, b], [c, d]) = (around(false, false), around(true, false));
        quad([b, a, c, d]);
        for far in [false, true] {
            let ([a, b], [c, d]) = (around(far, false), around(far, true));
            quad(if far { [a, c, d, b] } else { [b, d, c, a] });
        }
    }
    let end = |k: usize| {
        [
            corner(false, false, k),
            corner(false, true, k),
            corner(true, true, k),
            corner(true, false, k),
        ]
    };
    quad(end(0));
    let [a, b, c, d] = end(count - 1);
    quad([d, c, b, a]);
    shell
}
