//! A grain laid on every kind of surface, and in corners: it stays, and wins no energy.
//!
//! Friction is kinetic: each step stops the slip that the step before left, so a grain at rest on one wall
//! may still move as fast as its weight drives it within a step, gΔt. That is the bound: ½ m (gΔt)².
//! A grid that asks its triangles reports the nearest contact only. It holds a grain in a corner of n faces by
//! each of them in turn, so that weight drives it for n steps between: there the bound is ½ m (n gΔt)².

use super::bench::{Bench, FRICTION, GRAVITY, RESTITUTION, USUAL_STEPS};
use super::shapes::{self, Shared};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use std::sync::Arc;
use tsubu_model::{HitBuffer, Motion, Space, View};
use tsubu_sdf::{Ball, Cavity, Cuboid, Cylinder, HalfSpace, Hand, Mesh, Screw, ScrewSize, Tube};

/// A grain about to be laid down.
struct Bed {
    name: String,
    surface: Shared,
    /// Where it would touch the true surface.
    place: DVec3,
    /// Where its centre is let go: there, or as much higher as this surface wants.
    start: DVec3,
    /// Where the weight points.
    down: DVec3,
    /// Faces that press it while the surface reports the nearest only: each holds it once in so many steps.
    in_turn: f64,
}

/// Moves a point until it is `touch` away from every face that it is near: into a corner.
fn nestled(surface: &Shared, mut x: DVec3, touch: f64) -> DVec3 {
    let mut out = HitBuffer::<Space>::default();
    for _ in 0..200 {
        out.hits.clear();
        surface.hits(&[x], &[1.5 * touch], &mut out);
        let step: DVec3 = out
            .hits
            .iter()
            .map(|hit| hit.normal * (touch - hit.distance))
            .sum();
        x += 0.5 * step;
    }
    x
}

/// Moves a point against `down` until nothing that the surface reports there is nearer than `touch`: a grid
/// rounds a concave corner off, so that a grain lies a part of a cell further from it.
fn lifted(surface: &Shared, mut x: DVec3, down: DVec3, touch: f64) -> DVec3 {
    let mut out = HitBuffer::<Space>::default();
    for _ in 0..100 {
        out.hits.clear();
        surface.hits(&[x], &[touch], &mut out);
        let rise = |distance: f64, normal: DVec3| (touch - distance) / (-normal.dot(down)).max(0.3);
        let rises = out.hits.iter().map(|hit| rise(hit.distance, hit.normal));
        x -= down * rises.fold(0.0, f64::max);
    }
    x
}

/// The unit vector against the normals of all faces that a grain touches at x.
fn into(surface: &Shared, x: DVec3, touch: f64) -> DVec3 {
    let mut out = HitBuffer::<Space>::default();
    surface.hits(&[x], &[1.1 * touch], &mut out);
    -out.hits
        .iter()
        .map(|hit| hit.normal)
        .sum::<DVec3>()
        .normalize_or_zero()
}

/// The formula, the triangles and the grid of one wall.
fn ways(
    bench: &Bench,
    formula: Shared,
    mesh: &tsubu_sdf::Mesh,
) -> Result<[(&'static str, Shared); 4], String> {
    let cell = shapes::usual_cell(mesh, bench.kind.diameter());
    let band = bench.kind.radius + 2.5 * cell;
    Ok([
        ("formula", formula),
        ("triangles", Arc::new(shapes::exact(mesh)?)),
        ("grid", Arc::new(shapes::grid(mesh, cell, band, false)?)),
        (
            "grid that asks its triangles",
            Arc::new(shapes::grid(mesh, cell, band, true)?),
        ),
    ])
}

fn beds(bench: &Bench) -> Result<Vec<Bed>, String> {
    let wrong = |e: tsubu_sdf::Misshapen| e.to_string();
    let touch = bench.touch();
    let (down, half) = (-DVec3::Z, DVec3::splat(0.03));
    let block = Cuboid::<Space>::new(-half, half).map_err(wrong)?;
    let (from, to) = (DVec3::X * -0.03, DVec3::X * 0.03);
    let shaft = Cylinder::new(from, to, 0.0275).map_err(wrong)?;
    let casing = Tube::new(from, to, 0.06, 0.07).map_err(wrong)?;
    let size = ScrewSize {
        shaft: 0.0275,
        outer: 0.0625,
        pitch: 0.15,
        thickness: 0.012,
    };
    let screw = Screw::new(DVec3::ZERO, DVec3::X * 0.15, size, Hand::Right).map_err(wrong)?;
    let plain: Shared = Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z));
    let dent: Shared = Arc::new(Cavity(
        Ball::<Space>::new(DVec3::ZERO, 0.05).map_err(wrong)?,
    ));
    let mut beds = Vec::new();
    let mut add =
        |wall: &str, way: &str, surface: Shared, start: DVec3, down: DVec3, faces: f64| {
            let name = format!("{wall}, {way}");
            let in_turn = if way.starts_with("grid that") {
                faces
            } else {
                1.0
            };
            beds.push(Bed {
                name,
                place: start,
                start: lifted(&surface, start, down, touch),
                surface,
                down,
                in_turn,
            });
        };
    add("plane", "formula", plain, DVec3::Z * touch, down, 1.0);
    // A little up the slope, where the grain must hold by friction: 0.1 rad.
    let tilted = DVec3::new(0.02, 0.1, 0.99).normalize();
    let up = DVec3::new(0.0, 0.1f64.sin(), 0.1f64.cos());
    add("dent", "formula", dent, tilted * -(0.05 - touch), down, 1.0);
    let box_mesh = shapes::cuboid(-half, half)?;
    for (way, surface) in ways(bench, Arc::new(block), &box_mesh)? {
        let start = DVec3::new(4e-3, 3e-3, half.z + touch);
        add("box", way, surface, start, down, 1.0);
    }
    for (way, surface) in ways(
        bench,
        Arc::new(shaft.clone()),
        &Mesh::from(shaft.mesh(1e-6)),
    )? {
        add(
            "top of a shaft",
            way,
            surface,
            up * (0.0275 + touch),
            down,
            1.0,
        );
    }
    for (way, surface) in ways(
        bench,
        Arc::new(casing.clone()),
        &Mesh::from(casing.mesh(1e-6)),
    )? {
        add(
            "inside of a tube",
            way,
            surface,
            up * -(0.06 - touch),
            down,
            1.0,
        );
    }
    let hole: Shared = Arc::new(Cavity(block));
    let corner = nestled(&hole, DVec3::splat(touch - half.x), touch);
    let around = DVec3::splat(0.05);
    let mut shell = shapes::cuboid(-around, around)?;
    let mut inner = shapes::cuboid(-half, half)?;
    inner.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    let first = shell.vertices.len() as u32;
    shell.vertices.extend(inner.vertices);
    shell
        .triangles
        .extend(inner.triangles.iter().map(|t| t.map(|v| v + first)));
    for (way, surface) in ways(bench, hole.clone(), &shell)? {
        // Not along the diagonal: the walls are pressed unequally.
        let down = -DVec3::new(1.0, 0.8, 1.3).normalize();
        add("corner of a hole", way, surface, corner, down, 3.0);
    }
    let formula: Shared = Arc::new(screw);
    let face = 0.075 + 0.5 * size.thickness;
    let guess = DVec3::new(face + touch, -(size.shaft + touch), 0.0);
    let corner = nestled(&formula, guess, touch);
    let down = into(&formula, corner, touch);
    for (way, surface) in ways(bench, formula, &Mesh::from(screw.mesh(1e-5)))? {
        add(
            "corner of shaft and flight",
            way,
            surface,
            corner,
            down,
            2.0,
        );
    }
    Ok(beds)
}

/// Elastic energy over m g d of a grain put where it would touch the true surface.
fn pressed(bench: &Bench, bed: &Bed) -> f64 {
    let dt = bench.period() / USUAL_STEPS;
    let lab = bench.lab(&bed.surface, Motion::default(), RESTITUTION, FRICTION, dt);
    let world = lab.grain(bed.place, DVec3::ZERO).world();
    let scale = bench.kind.weight * GRAVITY * bench.kind.diameter();
    world.energies().elastic_walls / scale
}

/// The largest kinetic energy seen in the second half, and the most by which the energy held rose over the start; over m g d.
fn lie(bench: &Bench, bed: &Bed, steps: u64) -> (f64, f64, f64) {
    let dt = bench.period() / USUAL_STEPS;
    let mut lab = bench
        .lab(&bed.surface, Motion::default(), RESTITUTION, FRICTION, dt)
        .grain(bed.start, DVec3::ZERO);
    lab.gravity = bed.down * GRAVITY;
    let mut world = lab.world();
    let scale = bench.kind.weight * GRAVITY * bench.kind.diameter();
    let before = world.energies().held();
    let (mut moving, mut gained) = (0.0f64, f64::NEG_INFINITY);
    let looks = 200;
    for look in 0..looks {
        world.advance(steps / looks);
        let now = world.energies();
        if look >= looks / 2 {
            moving = moving.max(now.kinetic / scale);
        }
        gained = gained.max((now.held() - before) / scale);
    }
    let way = (world.position(0) - bed.start).length() / bench.kind.diameter();
    (moving, gained, way)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let bench = Bench::as_run()?;
    let dt = bench.period() / USUAL_STEPS;
    let steps = if report.full() { 1_000_000 } else { 100_000 };
    let bound = 0.5 * GRAVITY * dt * dt / bench.kind.diameter();
    for bed in beds(&bench)? {
        let (moving, gained, way) = lie(&bench, &bed, steps);
        let name = &bed.name;
        let note = if bed.in_turn > 1.0 {
            "½ m (n gΔt)²: one contact at a time, each of n faces holds it every n-th step"
        } else {
            "½ m (gΔt)²: what weight gives in one step"
        };
        report.check(
            format!("rest, {name}: largest kinetic energy over mgd, second half of {steps} steps"),
            bound * bed.in_turn.powi(2),
            moving,
            Tolerance::AtMost,
            note,
        );
        report.check(
            format!("rest, {name}: largest rise of the energy held over the start, over mgd"),
            1e-10,
            gained,
            Tolerance::AtMost,
            "rounding of 1e5 to 1e6 sums",
        );
        report.tell(format!("rest, {name}: how far it crept, over d"), way, "");
        let lift = (bed.start - bed.place).length() / bench.kind.diameter();
        if lift > 1e-3 {
            report.tell(
                format!(
                    "rest, {name}: how much further out it lies than in the true corner, over d"
                ),
                lift,
                "the interpolant rounds a concave corner off",
            );
            report.tell(
                format!(
                    "rest, {name}: elastic energy of a grain put into the true corner, over mgd"
                ),
                pressed(&bench, &bed),
                "such a grain overlaps the grid's wall and is thrown out",
            );
        }
    }
    Ok(())
}
