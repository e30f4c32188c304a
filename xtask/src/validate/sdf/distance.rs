//! The grid against the formula: distance, normal and sign at random points.
//!
//! The interpolant of a function with second derivatives f_ii is off by at most h²/8 Σ|f_ii|, so the
//! distance is of second order in the cell h. Its gradient is a difference over one cell, right in the
//! middle of it only: off by up to h/2 |f_ii| along axis i, of first order. For a distance Σ|f_ii| is at
//! most |κ₁| + |κ₂|, the principal curvatures of the parallel surface through the point.

use super::shapes;
use super::trial::{CHORD, Trial, Truth, smooth_shapes, within};
use crate::validate::check::Tolerance;
use crate::validate::collision::order::slope;
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use glam::{DMat3, DVec3};
use tsubu_model::{HitBuffer, Space, Surface};
use tsubu_picture::Figure;
use tsubu_sdf::{Cuboid, DistanceGrid};

/// Root mean squares and the largest error.
struct Errors {
    rms: f64,
    largest: f64,
    /// Of the normal, in rad.
    turned: f64,
}

fn errors(grid: &DistanceGrid, points: &[(DVec3, Truth)]) -> Errors {
    let (mut squares, mut largest, mut turned) = (0.0, 0.0f64, 0.0);
    for (x, truth) in points {
        let (value, normal) = grid
            .distance_and_normal(*x)
            .unwrap_or((f64::NAN, DVec3::ZERO));
        let error = value - truth.distance;
        squares += error * error;
        // A NaN must not be lost in a maximum.
        largest = if error.is_nan() {
            f64::INFINITY
        } else {
            largest.max(error.abs())
        };
        turned += (normal - truth.normal).length_squared();
    }
    let mean = |sum: f64| (sum / points.len() as f64).sqrt();
    Errors {
        rms: mean(squares),
        largest,
        turned: mean(turned),
    }
}

/// Points further than a cell from the surface with the wrong sign, among 1e5 of the grid's box.
fn wrong_signs(trial: &Trial, grid: &DistanceGrid, cell: f64) -> (usize, usize) {
    let (mut draw, mut out) = (Draw(11), HitBuffer::default());
    let [low, high] = trial.box_around();
    let (mut wrong, mut asked) = (0, 0);
    while asked < 100_000 {
        let x = within(&mut draw, low, high);
        let truth = trial.truth(x, &mut out).distance;
        if truth.abs() > cell {
            asked += 1;
            let value = grid.value_and_gradient(x).map_or(f64::NAN, |v| v.0);
            wrong += usize::from(value.is_nan() || (value < 0.0) != (truth < 0.0));
        }
    }
    (wrong, asked)
}

fn smooth(report: &mut Report, figures: &mut [Figure; 2], trial: &Trial) -> Result<(), String> {
    let points = trial.points(20_000);
    report.tell(
        format!("{}: points asked in the band", trial.name),
        points.len() as f64,
        "those at which a cube of a coarsest cell to each side sees one smooth face",
    );
    let cells = [trial.cell, 0.5 * trial.cell, 0.25 * trial.cell];
    let (mut rms, mut turned) = (Vec::new(), Vec::new());
    for cell in cells {
        let grid = trial.grid(cell)?;
        let found = errors(&grid, &points);
        let at = format!("{}, cell {} mm", trial.name, cell * 1e3);
        report.tell(
            format!("{at}: rms error of the distance (m)"),
            found.rms,
            "",
        );
        report.tell(
            format!("{at}: rms error of the normal (deg)"),
            found.turned.to_degrees(),
            "",
        );
        let bent = (trial.curvature)(trial.band + cell * 3f64.sqrt());
        report.check(
            format!("{at}: largest error of the distance (m)"),
            cell * cell / 8.0 * bent + CHORD,
            found.largest,
            Tolerance::AtMost,
            "h²/8 (|κ₁| + |κ₂|) in the band, and 3e-6 m for the mesh's chords",
        );
        if cell == cells[1] {
            let (wrong, _) = wrong_signs(trial, &grid, cell);
            report.check(
                format!("{at}: wrong signs at 1e5 points over a cell away"),
                0.0,
                wrong as f64,
                Tolerance::Absolute(0.0),
                "the interpolant is off by h√3/2 at most",
            );
        }
        rms.push(found.rms);
        turned.push(found.turned);
    }
    report.check(
        format!("{}: order of the distance in the cell", trial.name),
        2.0,
        slope(&cells, &rms),
        Tolerance::Absolute(0.3),
        "trilinear interpolation of a smooth function; 0.3 for the mesh and the band",
    );
    report.check(
        format!("{}: order of the normal in the cell", trial.name),
        1.0,
        slope(&cells, &turned),
        Tolerance::Absolute(0.3),
        "the gradient is a difference over one cell",
    );
    let square: Vec<f64> = cells
        .iter()
        .map(|h| rms[0] * (h / cells[0]).powi(2))
        .collect();
    let straight: Vec<f64> = cells.iter().map(|h| turned[0] * h / cells[0]).collect();
    let slot = &mut figures[0];
    *slot = slot
        .clone()
        .theory("slope 2", &cells, &square)
        .points(trial.name, &cells, &rms, None);
    let slot = &mut figures[1];
    *slot = slot
        .clone()
        .theory("slope 1", &cells, &straight)
        .points(trial.name, &cells, &turned, None);
    Ok(())
}

/// A box that lies along no axis: its faces are flat, so that only rounding and edges are left.
fn block(report: &mut Report) -> Result<(), String> {
    let half = DVec3::new(0.05, 0.04, 0.03);
    let block = Cuboid::<Space>::new(-half, half).map_err(|e| e.to_string())?;
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -2.0) / 3.0, 0.7);
    let (cell, band) = (3e-3, 8e-3);
    let mesh = shapes::placed(shapes::cuboid(-half, half)?, turn, DVec3::ZERO);
    let grid = shapes::grid(&mesh, cell, band + 2.0 * cell, false)?;
    let truth = |x: DVec3| block.lower_bound(turn.transpose() * x);
    let mut draw = Draw(5);
    let [low, high] = mesh.bounds().map(|x| 1.3 * x);
    let (mut flat, mut edge, mut wrong, mut asked) = (0.0f64, 0.0f64, 0, 0);
    while asked < 100_000 {
        let x = within(&mut draw, low, high);
        let distance = truth(x);
        let value = grid.value_and_gradient(x).map_or(f64::NAN, |v| v.0);
        if distance.abs() > cell {
            asked += 1;
            let told = if value.is_nan() { 1.0 } else { value };
            wrong += usize::from((told < 0.0) != (distance < 0.0));
        }
        if distance.abs() > band {
            continue;
        }
        let error = (value - distance).abs();
        edge = if error.is_nan() {
            f64::INFINITY
        } else {
            edge.max(error)
        };
        // Over one face, two cells and the depth inside away from the edges' planes.
        let q = (turn.transpose() * x).abs() - half;
        let margin = 2.0 * cell + (-distance).max(0.0);
        let inner = q.to_array().iter().filter(|&&q| q < -margin).count();
        if inner == 2 {
            flat = flat.max(error);
        }
    }
    report.check(
        "box, cell 3 mm: largest error over its faces, two cells from edges (m)",
        8e-10,
        flat,
        Tolerance::AtMost,
        "a plane is interpolated exactly; nodes up to 14 mm away are stored to 2⁻²⁴ of it, 8e-10 m",
    );
    report.check(
        "box, cell 3 mm: largest error anywhere in the band, in cells",
        0.5 * 3f64.sqrt(),
        edge / cell,
        Tolerance::AtMost,
        "a distance changes by the way gone at most: half the diagonal of a cell",
    );
    report.check(
        "box, cell 3 mm: wrong signs at 1e5 points over a cell away",
        0.0,
        f64::from(wrong as u32),
        Tolerance::Absolute(0.0),
        "the interpolant is off by h√3/2 at most",
    );
    Ok(())
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let figure = |title: &str, label: &str| Figure::new(title, "cell (m)", label).log_x().log_y();
    let mut figures = [
        figure("Distance of a grid", "rms error (m)"),
        figure("Normal of a grid", "rms error (rad)"),
    ];
    for trial in smooth_shapes()? {
        report.progress(&format!(
            "{}, {} triangles",
            trial.name,
            trial.mesh.triangles.len()
        ));
        smooth(report, &mut figures, &trial)?;
    }
    block(report)?;
    let [distance, normal] = figures;
    report.figure("sdf_distance", distance)?;
    report.figure("sdf_normal", normal)
}
