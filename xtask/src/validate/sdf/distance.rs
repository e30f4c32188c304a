//! The grid against the formula: distance, normal and sign at random points.
//!
//! The interpolant of a function with second derivatives f_ii is off by at most h²/8 Σ|f_ii|, so the
//! distance is of second order in the cell h. Its gradient is a difference over one cell, right in the
//! middle of it only: off by up to h/2 |f_ii| along axis i, of first order. For a distance Σ|f_ii| is at
//! most |κ₁| + |κ₂|, the principal curvatures of the parallel surface through the point.

use super::shapes::{self, Shared};
use crate::validate::check::Tolerance;
use crate::validate::collision::order::slope;
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use glam::{DMat3, DVec3};
use std::sync::Arc;
use tsubu_model::{HitBuffer, Space, Surface};
use tsubu_picture::Figure;
use tsubu_sdf::{Ball, Cuboid, DistanceGrid, Hand, Mesh, Screw, ScrewSize, Torus};

/// The farthest that a chord of the meshes is from its surface, in m: R(1 − cos(π/steps)) around both ways.
const CHORD: f64 = 3e-6;

/// What the formula says at a point.
struct Truth {
    distance: f64,
    normal: DVec3,
    /// Number of the smooth face on which the foot lies; `None` on an edge.
    face: Option<u32>,
}

/// A shape on trial.
struct Trial {
    name: &'static str,
    surface: Shared,
    mesh: Mesh,
    /// The coarsest cell in m.
    cell: f64,
    /// Points up to this distance from the surface are asked, in m.
    band: f64,
    /// The face of a foot, from the foot and the feature of its hit.
    face: Box<dyn Fn(DVec3, u32) -> Option<u32>>,
    /// |κ₁| + |κ₂| at most, at a distance of so many m from the surface.
    curvature: Box<dyn Fn(f64) -> f64>,
}

impl Trial {
    /// The nearest foot.
    fn truth(&self, x: DVec3, out: &mut HitBuffer<Space>) -> Truth {
        out.hits.clear();
        self.surface.hits(&[x], &[f64::INFINITY], out);
        let nearest = out
            .hits
            .iter()
            .min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
        nearest.map_or(
            Truth {
                distance: f64::NAN,
                normal: DVec3::ZERO,
                face: None,
            },
            |hit| Truth {
                distance: hit.distance,
                normal: hit.normal,
                face: (self.face)(x - hit.normal * hit.distance, hit.feature),
            },
        )
    }

    /// Random points in the band at which a cube of a coarsest cell to each side has its feet on one smooth face.
    fn points(&self, count: usize) -> Vec<(DVec3, Truth)> {
        let mut draw = Draw(7);
        let mut out = HitBuffer::default();
        let mut points = Vec::with_capacity(count);
        let [low, high] = self.box_around();
        for _ in 0..400 * count {
            let x = within(&mut draw, low, high);
            let truth = self.truth(x, &mut out);
            if truth.distance.abs() > self.band || truth.face.is_none() {
                continue;
            }
            let side = |k: i32| self.cell * f64::from(k % 3 - 1);
            let smooth = (0..27).all(|k| {
                let corner = x + DVec3::new(side(k), side(k / 3), side(k / 9));
                self.truth(corner, &mut out).face == truth.face
            });
            if smooth {
                points.push((x, truth));
            }
            if points.len() == count {
                break;
            }
        }
        points
    }

    fn box_around(&self) -> [DVec3; 2] {
        let [low, high] = self.mesh.bounds();
        [low - self.band, high + self.band]
    }

    fn grid(&self, cell: f64) -> Result<DistanceGrid, String> {
        shapes::grid(&self.mesh, cell, self.band + 2.0 * cell, false)
    }
}

fn within(draw: &mut Draw, low: DVec3, high: DVec3) -> DVec3 {
    low + (high - low) * DVec3::new(draw.next(), draw.next(), draw.next())
}

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

fn smooth_shapes() -> Result<Vec<Trial>, String> {
    let wrong = |e: tsubu_sdf::Misshapen| e.to_string();
    let size = ScrewSize {
        shaft: 0.02,
        outer: 0.05,
        pitch: 0.1,
        thickness: 0.02,
    };
    let screw = Screw::new(DVec3::ZERO, DVec3::X * 0.1, size, Hand::Right).map_err(wrong)?;
    let rise = size.pitch / std::f64::consts::TAU;
    let torus = Torus::new(DVec3::ZERO, DVec3::Z, 0.06, 0.03).map_err(wrong)?;
    // Chords stay a tenth or so of the error of the finest grid.
    Ok(vec![
        Trial {
            name: "ball, R = 50 mm",
            surface: Arc::new(Ball::<Space>::new(DVec3::ZERO, 0.05).map_err(wrong)?),
            mesh: shapes::ball(0.05, &shapes::even(240), 480),
            cell: 6e-3,
            band: 8e-3,
            face: Box::new(|_, _| Some(0)),
            curvature: Box::new(|away| 2.0 / (0.05 - away)),
        },
        Trial {
            name: "torus, 60 and 30 mm",
            surface: Arc::new(torus),
            mesh: shapes::torus(0.06, 0.03, 560, 320),
            cell: 6e-3,
            band: 8e-3,
            face: Box::new(|_, _| Some(0)),
            curvature: Box::new(|away| 1.0 / (0.03 - away) + 1.0 / (0.03 - away)),
        },
        Trial {
            name: "screw's flight",
            surface: Arc::new(screw),
            mesh: shapes::mesh(screw.mesh(4e-7)),
            cell: 4e-3,
            band: 6e-3,
            // Front and back of the flight without their edges; the flight's ends are other features.
            face: Box::new(move |foot, feature| {
                let rho = foot.y.hypot(foot.z);
                let clear = rho > size.shaft + 1e-6 && rho < size.outer - 1e-6;
                (clear && (feature == 1 || feature == 2)).then_some(feature)
            }),
            curvature: Box::new(move |away| {
                let kappa = rise / (size.shaft * size.shaft + rise * rise);
                2.0 * kappa / (1.0 - kappa * away)
            }),
        },
    ])
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
