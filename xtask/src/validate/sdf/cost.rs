//! What a query costs on a piece of the feeder's screw, and how far off it is: told, not checked.

use super::bench::Bench;
use super::shapes::{self, Shared};
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use glam::DVec3;
use std::sync::Arc;
use std::time::Instant;
use tsubu_model::{HitBuffer, Space, Surface};
use tsubu_picture::Figure;
use tsubu_sdf::{Hand, Mesh, Screw, ScrewSize};

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

/// The distance of each point by this surface less that by the formula, root mean square and largest, in m.
fn apart(surface: &Shared, truth: &Screw, points: &[DVec3], reach: f64) -> (f64, f64) {
    let nearest = |surface: &dyn Surface<Space>, x: DVec3| {
        let mut out = HitBuffer::<Space>::default();
        surface.hits(&[x], &[reach], &mut out);
        out.hits.iter().map(|h| h.distance).reduce(f64::min)
    };
    let (mut sum, mut most, mut count) = (0.0, 0.0f64, 0);
    for &x in points {
        if let (Some(a), Some(b)) = (nearest(&**surface, x), nearest(truth, x)) {
            sum += (a - b).powi(2);
            most = most.max((a - b).abs());
            count += 1;
        }
    }
    ((sum / f64::from(count)).sqrt(), most)
}

/// A way to hold the screw, what a query costs in ns, and how far it is off in mm.
struct Way {
    name: String,
    cost: f64,
    most: f64,
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
    let mesh = Mesh::from(screw.mesh(5e-5));
    let radius = bench.kind.radius;
    let usual = shapes::usual_cell(&mesh, bench.kind.diameter());
    let shares: &[f64] = if report.full() {
        &[2.0, 4.0 / 3.0, 1.0, 2.0 / 3.0]
    } else {
        &[2.0, 4.0 / 3.0]
    };
    let points = points(&screw, radius, 20_000);
    let (corners, triangles) = (mesh.vertices.len(), mesh.triangles.len());
    let mut try_way = |name: String, surface: Shared, bytes: f64| -> Way {
        let (cost, hits) = time(&surface, &points, bench.touch());
        let (mean, most) = apart(&surface, &screw, &points, bench.touch());
        let told = [
            (
                "ns per query near it",
                cost,
                "best of five rounds of 20 000 on this machine; a ratio between rows means more than a row",
            ),
            (
                "contacts per query",
                hits,
                "a grid gives one, the others one for each face touched",
            ),
            (
                "distance against the formula, root mean square (mm)",
                mean * 1e3,
                "points a grain's centre can have near the screw, edges included",
            ),
            (
                "distance against the formula, largest (mm)",
                most * 1e3,
                "at the edges of the flight, which a plain grid rounds off",
            ),
            (
                "memory (MB)",
                bytes / 1e6,
                "nodes of the grid; corners and triangles of the mesh, without its tree",
            ),
        ];
        for (what, value, note) in told {
            report.tell(
                format!("1.3 turns of the feeder's screw, {name}: {what}"),
                value,
                note,
            );
        }
        Way {
            name,
            cost,
            most: most * 1e3,
        }
    };
    try_way("formula".into(), Arc::new(screw), 0.0);
    let (mut plain, mut asking) = (Vec::new(), Vec::new());
    let of_mesh = (24 * corners + 12 * triangles) as f64;
    for share in shares {
        let cell = share * usual;
        let band = radius + 2.5 * cell;
        let grid = shapes::grid(&mesh, cell, band, false)?;
        let bytes = grid.bytes() as f64;
        let name = format!("grid of {:.2} mm", cell * 1e3);
        plain.push(try_way(name.clone(), Arc::new(grid), bytes));
        let grid = shapes::grid(&mesh, cell, band, true)?;
        asking.push(try_way(
            format!("{name} that asks its triangles"),
            Arc::new(grid),
            bytes + of_mesh,
        ));
    }
    let exact = try_way(
        format!("{triangles} triangles"),
        Arc::new(shapes::exact(&mesh)?),
        of_mesh,
    );
    let column =
        |ways: &[Way]| -> (Vec<f64>, Vec<f64>) { ways.iter().map(|w| (w.cost, w.most)).unzip() };
    let cells: Vec<&str> = plain
        .iter()
        .map(|w| w.name.trim_start_matches("grid of "))
        .collect();
    let ((px, py), (ax, ay)) = (column(&plain), column(&asking));
    let figure = Figure::new(
        "What asking the triangles near the surface gains and costs",
        "cost of a query near the screw (ns)",
        "largest error of the distance (mm)",
    )
    .log_x()
    .log_y()
    .points(&format!("grids of {}", cells.join(", ")), &px, &py, None)
    .points(
        "the same, asking their triangles (exact_edges)",
        &ax,
        &ay,
        None,
    )
    .points("all triangles", &[exact.cost], &[exact.most], None);
    report.figure("sdf_refinement", figure)
}
