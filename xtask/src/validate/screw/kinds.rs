//! One screw made in four ways: what each conveys, how far that is from the formula's, what it holds in memory and costs.

use super::TUBE;
use super::cost::{Way, take_turns};
use super::runs::{Case, Kind};
use crate::validate::kept::Measured;
use crate::validate::report::Report;
use std::path::Path;
use tsubu_picture::Figure;
use tsubu_sdf::{DistanceGrid, GrainBody, GrainBodyOptions, GridOptions, Mesh, Screw};

/// Triangles are asked for every contact: n = 4 is what can be waited for.
const COARSE: u32 = 4;
const RPM: f64 = 60.0;
/// Radii of wall grains in µm: half and a quarter of the grains'.
const FINE: Kind = Kind::Grains(2_700);
const COARSER: Kind = Kind::Grains(5_400);

/// Bytes of the screw, without the tree that finds a triangle.
fn bytes(kind: Kind, mesh: &Mesh) -> Result<u64, String> {
    let diameter = 1.350e-3 * f64::from(1u32 << COARSE);
    Ok(match kind {
        Kind::Grid => {
            let cell = 2e-3;
            let options = GridOptions::new(cell, 1.35 * diameter + 2.0 * cell);
            DistanceGrid::build(mesh, &options, &|_| ())
                .map_err(|e| e.to_string())?
                .bytes()
        }
        Kind::Triangles => (24 * mesh.vertices.len() + 12 * mesh.triangles.len()) as u64,
        Kind::Analytic => size_of::<Screw>() as u64,
        Kind::Grains(radius) => {
            let options = GrainBodyOptions::new(f64::from(radius) * 1e-6, 1.35 * diameter);
            GrainBody::build(mesh, &options)
                .map_err(|e| e.to_string())?
                .bytes()
        }
    })
}

/// The feeder at n = 4 and 60 r/min with each; the screw of grains has its own contacts (no friction of a face).
pub fn run(
    report: &mut Report,
    root: &Path,
    print: u64,
    all: &impl Fn(&[Case]) -> Result<Vec<Measured>, String>,
) -> Result<(), String> {
    let kinds = [Kind::Analytic, Kind::Triangles, Kind::Grid, COARSER, FINE];
    let cases = kinds.map(|kind| Case {
        kind,
        ..Case::of(COARSE, RPM)
    });
    let measured = all(&cases)?;
    let mut ways = cases
        .iter()
        .map(|case| Way::in_flow(case, root, print, &case.kind.name(), &[]))
        .collect::<Result<Vec<_>, _>>()?;
    take_turns(&mut ways);
    let mesh =
        Mesh::read(root.join("scenarios/meshes/screw.stl"), 1e-3).map_err(|e| e.to_string())?;
    let mut figure = Figure::new(
        "One screw made in four ways: the feeder at n = 4, 60 r/min",
        "cost of a grain-step (ns)",
        "mass rate in the tube (kg/s)",
    );
    let (formula, formula_error) = measured[0].get(TUBE);
    for ((kind, measured), way) in kinds.into_iter().zip(&measured).zip(&ways) {
        let (rate, error) = measured.get(TUBE);
        let memory = bytes(kind, &mesh)? as f64 / 1e6;
        let name = format!("n = {COARSE}, {RPM} r/min, screw of {}", kind.name());
        report.tell(
            format!("{name}: rate in the tube over that with the formula"),
            rate / formula,
            &format!(
                "± {:.4}",
                rate / formula * (error / rate).hypot(formula_error / formula)
            ),
        );
        report.tell(
            format!("{name}: ns per grain-step"),
            way.cost,
            "in flow, one thread, the best of seven turns",
        );
        report.tell(
            format!("{name}: memory (MB)"),
            memory,
            "nodes of the grid; corners and triangles; wall grains and their cells",
        );
        let label = match kind {
            Kind::Analytic => kind.name(),
            _ => format!("{}, {memory:.2} MB", kind.name()),
        };
        figure = figure.points(&label, &[way.cost], &[rate], Some(&[error]));
    }
    report.figure("screw_kinds", figure)
}
