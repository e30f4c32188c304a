//! From an STL file to distances: the doctor's report, the grid, distance and normal at some points.
//!
//! ```text
//! cargo run -p tsubu-sdf --example stl_to_distance -- body.stl 0.001 [cell in mm]
//! ```
//!
//! The number is the file's length unit in metres. Without arguments a ring of 300 mm is made and used.

use glam::DVec3;
use std::f64::consts::TAU;
use std::time::Instant;
use tsubu_model::{HitBuffer, Surface};
use tsubu_sdf::mesh::{Mesh, Report, parse_stl, write_stl};
use tsubu_sdf::{DistanceGrid, ExactMesh, GridOptions};

fn main() {
    if let Err(error) = run() {
        eprintln!("{error}");
        std::process::exit(2);
    }
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mesh = match arguments.as_slice() {
        // Written and read again, as if it came from a CAD program that thinks in millimetres.
        [] => parse_stl(&write_stl(&ring(), "ring"), 1e-3)?,
        [path] => Mesh::read(path, 1e-3)?,
        [path, unit, ..] => Mesh::read(path, unit.parse()?)?,
    };
    let report = Report::of(&mesh);
    println!("{report}\n");

    let cell = match arguments.get(2) {
        Some(cell) => 1e-3 * cell.parse::<f64>()?,
        None => report.cell_advice().ok_or("give a cell in mm")?.cell,
    };
    // Grains of two cells' radius.
    let reach = 2.0 * cell;
    let start = Instant::now();
    let grid = DistanceGrid::build(&mesh, &GridOptions::new(cell, reach + 2.0 * cell), &|_| ())?;
    let [nx, ny, nz] = grid.counts();
    println!(
        "grid        {nx} × {ny} × {nz} nodes, {:.1} MB, built in {:.2} s",
        grid.bytes() as f64 / 1e6,
        start.elapsed().as_secs_f64()
    );
    let bytes = grid.to_bytes();
    let start = Instant::now();
    DistanceGrid::from_bytes(&bytes)?;
    println!(
        "cache       read and checked in {:.2} s",
        start.elapsed().as_secs_f64()
    );

    let exact = ExactMesh::body(&mesh)?;
    let points = points(&report, 200_000);
    println!(
        "\n{:>30} {:>11} {:>11}  normal",
        "x, y, z (mm)", "grid (mm)", "exact (mm)"
    );
    let near = |x: &&DVec3| {
        grid.value_and_gradient(**x)
            .is_some_and(|(d, _)| d.abs() < reach)
    };
    for x in points.iter().filter(near).take(8) {
        let (Some((distance, normal)), Some((truth, ..))) =
            (grid.distance_and_normal(*x), exact.closest(*x, f64::MAX))
        else {
            continue;
        };
        let place = format!("{:.1}, {:.1}, {:.1}", 1e3 * x.x, 1e3 * x.y, 1e3 * x.z);
        println!(
            "{place:>30} {:>11.4} {:>11.4}  {:+.3} {:+.3} {:+.3}",
            1e3 * distance,
            1e3 * truth,
            normal.x,
            normal.y,
            normal.z
        );
    }
    errors(&grid, &exact, &points, reach);
    speed("grid", &grid, &points, reach);
    speed("exact mesh", &exact, &points, reach);
    Ok(())
}

/// The grid's error against the mesh within reach of the surface.
fn errors(grid: &DistanceGrid, exact: &ExactMesh, points: &[DVec3], reach: f64) {
    let mut found: Vec<f64> = points
        .iter()
        .filter_map(|&x| Some((grid.value_and_gradient(x)?.0, x)))
        .filter(|(value, _)| value.abs() < reach)
        .take(20_000)
        .filter_map(|(value, x)| Some((value - exact.closest(x, f64::MAX)?.0).abs()))
        .collect();
    found.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| {
        found
            .get((share * (found.len() as f64 - 1.0)) as usize)
            .copied()
            .unwrap_or(0.0)
    };
    let cell = grid.options().cell;
    println!(
        "\nerror       median {:.4}, 99 % {:.4}, largest {:.4} cells, over {} points within reach",
        at(0.5) / cell,
        at(0.99) / cell,
        at(1.0) / cell,
        found.len()
    );
}

fn speed(name: &str, surface: &impl Surface<tsubu_model::Space>, points: &[DVec3], reach: f64) {
    let reaches = vec![reach; points.len()];
    let mut out = HitBuffer::default();
    let start = Instant::now();
    surface.hits(points, &reaches, &mut out);
    println!(
        "{name:<11} {:.0} ns per grain anywhere in the box ({} hits of {} grains)",
        1e9 * start.elapsed().as_secs_f64() / points.len() as f64,
        out.hits.len(),
        points.len()
    );
}

/// Points spread evenly over the box, by multiples of irrational numbers.
fn points(report: &Report, count: usize) -> Vec<DVec3> {
    let step = DVec3::new(
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_3,
    );
    let [low, size] = [report.bounds[0], report.size()];
    (1..=count)
        .map(|k| low + size * (k as f64 * step).fract())
        .collect()
}

/// A ring of 300 mm with a section of 60 mm, in mm.
fn ring() -> Mesh {
    let (around, along) = (96, 48);
    let at = |i: usize, j: usize| {
        let (u, v) = (
            TAU * i as f64 / around as f64,
            TAU * j as f64 / along as f64,
        );
        let r = 120.0 + 30.0 * v.cos();
        DVec3::new(r * u.cos(), r * u.sin(), 30.0 * v.sin())
    };
    let mut mesh = Mesh::default();
    for i in 0..around {
        for j in 0..along {
            mesh.vertices.push(at(i, j));
            let index = |i: usize, j: usize| ((i % around) * along + j % along) as u32;
            let (a, b, c, d) = (
                index(i, j),
                index(i + 1, j),
                index(i + 1, j + 1),
                index(i, j + 1),
            );
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}
