//! What a query costs on a piece of the feeder's screw: told, not checked.

use super::bench::Bench;
use super::shapes::{self, Shared};
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use glam::DVec3;
use std::sync::Arc;
use std::time::Instant;
use tsubu_model::{HitBuffer, Space, Surface};
use tsubu_sdf::{Hand, Screw, ScrewSize};

/// Grains asked for at once, as by the engine.
const BATCH: usize = 64;

/// Points that a grain's centre can have near the screw: from a quarter of its radius to just over its reach.
fn points(screw: &Screw, radius: f64, count: usize) -> Vec<DVec3> {
    let mut draw = Draw(3);
    let mut points = Vec::with_capacity(count);
    let mut out = HitBuffer::<Space>::default();
    while points.len() < count {
        let mut span = |low: f64, high: f64| low + (high - low) * draw.next();
        let x = DVec3::new(span(0.02, 0.18), span(-0.11, 0.11), span(-0.11, 0.11));
        out.hits.clear();
        screw.hits(&[x], &[1.2 * radius], &mut out);
        if out.hits.iter().any(|hit| hit.distance > 0.25 * radius) {
            points.push(x);
        }
    }
    points
}

/// ns per point, the best of five rounds, and hits per point.
fn time(surface: &Shared, points: &[DVec3], reach: f64) -> (f64, f64) {
    let reaches = [reach; BATCH];
    let mut out = HitBuffer::<Space>::default();
    let (mut best, mut hits) = (f64::INFINITY, 0);
    for _ in 0..5 {
        hits = 0;
        let start = Instant::now();
        for batch in points.chunks_exact(BATCH) {
            out.hits.clear();
            surface.hits(batch, &reaches, &mut out);
            hits += out.hits.len();
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    let asked = (points.len() / BATCH * BATCH) as f64;
    (best / asked * 1e9, hits as f64 / asked)
}

/// The readings.
pub fn run(report: &mut Report) -> Result<(), String> {
    let bench = Bench::new()?;
    let size = ScrewSize {
        shaft: 0.0275,
        outer: 0.1025,
        pitch: 0.150,
        thickness: 0.006,
    };
    let screw =
        Screw::new(DVec3::ZERO, DVec3::X * 0.2, size, Hand::Right).map_err(|e| e.to_string())?;
    let mesh = shapes::mesh(screw.mesh(5e-5));
    let radius = bench.kind.radius;
    let cell = shapes::usual_cell(&mesh, bench.kind.diameter());
    let cell = if report.full() { cell } else { 2.0 * cell };
    let band = radius + 2.5 * cell;
    let grid = shapes::grid(&mesh, cell, band, false)?;
    let bytes = grid.bytes();
    let (corners, triangles) = (mesh.vertices.len(), mesh.triangles.len());
    let ways: [(String, Shared); 4] = [
        ("formula".into(), Arc::new(screw)),
        (format!("grid of {:.2} mm", cell * 1e3), Arc::new(grid)),
        (
            "grid that asks its triangles".into(),
            Arc::new(shapes::grid(&mesh, cell, band, true)?),
        ),
        (
            format!("{triangles} triangles"),
            Arc::new(shapes::exact(&mesh)?),
        ),
    ];
    let points = points(&screw, radius, 20_000);
    for (way, surface) in ways {
        let (nanoseconds, hits) = time(&surface, &points, bench.touch());
        report.tell(
            format!("1.3 turns of the feeder's screw, {way}: ns per query near it"),
            nanoseconds,
            "best of five rounds of 20 000 on this machine; a ratio between rows means more than a row",
        );
        report.tell(
            format!("1.3 turns of the feeder's screw, {way}: contacts per query"),
            hits,
            "a grid gives one, the others one for each face touched",
        );
    }
    report.tell(
        "memory of the grid (MB)",
        bytes as f64 / 1e6,
        "4 bytes a node",
    );
    report.tell(
        "memory of the mesh's corners and triangles (MB)",
        (24 * corners + 12 * triangles) as f64 / 1e6,
        "without its tree",
    );
    Ok(())
}
