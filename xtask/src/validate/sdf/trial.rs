//! The smooth shapes whose grids are held against their formulas, and the points at which.

use super::shapes::{self, Shared};
use crate::validate::lab::Draw;
use glam::DVec3;
use std::sync::Arc;
use tsubu_model::{HitBuffer, Space};
use tsubu_sdf::{Ball, DistanceGrid, Hand, Mesh, Screw, ScrewSize, Torus};
/// The farthest that a chord of the meshes is from its surface, in m: R(1 − cos(π/steps)) around both ways.
pub const CHORD: f64 = 3e-6;

/// What the formula says at a point.
pub struct Truth {
    /// In m.
    pub distance: f64,
    /// Outward.
    pub normal: DVec3,
    /// Number of the smooth face on which the foot lies; `None` on an edge.
    pub face: Option<u32>,
}

/// A shape on trial.
pub struct Trial {
    /// As the table calls it.
    pub name: &'static str,
    /// The formula.
    pub surface: Shared,
    /// The mesh of which grids are made.
    pub mesh: Mesh,
    /// The coarsest cell in m.
    pub cell: f64,
    /// Points up to this distance from the surface are asked, in m.
    pub band: f64,
    /// The face of a foot, from the foot and the feature of its hit.
    pub face: Box<dyn Fn(DVec3, u32) -> Option<u32>>,
    /// |κ₁| + |κ₂| at most, at a distance of so many m from the surface.
    pub curvature: Box<dyn Fn(f64) -> f64>,
}

impl Trial {
    /// The nearest foot.
    pub fn truth(&self, x: DVec3, out: &mut HitBuffer<Space>) -> Truth {
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
    pub fn points(&self, count: usize) -> Vec<(DVec3, Truth)> {
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

    /// The mesh's box and the band.
    pub fn box_around(&self) -> [DVec3; 2] {
        let [low, high] = self.mesh.bounds();
        [low - self.band, high + self.band]
    }

    /// The grid with this cell in m.
    pub fn grid(&self, cell: f64) -> Result<DistanceGrid, String> {
        shapes::grid(&self.mesh, cell, self.band + 2.0 * cell, false)
    }
}

/// A random point of a box.
pub fn within(draw: &mut Draw, low: DVec3, high: DVec3) -> DVec3 {
    low + (high - low) * DVec3::new(draw.next(), draw.next(), draw.next())
}

/// A ball, a torus and the flight of a screw.
pub fn smooth_shapes() -> Result<Vec<Trial>, String> {
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
            mesh: Mesh::from(screw.mesh(4e-7)),
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
