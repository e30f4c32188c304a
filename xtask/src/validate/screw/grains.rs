//! The screw as a body built of grains (paper A's fig. 4), beside the same screw as a surface.
//!
//! The paper's case: 100 r/min, a casing of faces that only repel, wall grains from coarse to fine. Its n = 1 is out of
//! reach, and n = 2 takes hours; here are n = 4 and 3. One pitch without ends would be cheaper, but wall grains do not
//! repeat with it.

use super::TUBE;
use super::runs::{Case, Kind};
use crate::validate::kept::Measured;
use crate::validate::report::Report;
use tsubu_picture::Figure;

/// Speed of the comparison, r/min.
const RPM: f64 = 100.0;
/// Coarse level and radii of wall grains in µm: the grains' own (10.8 and 5.4 mm), a half and a quarter of it.
const RADII: [(u32, [u32; 3]); 2] = [(4, [10_800, 5_400, 2_700]), (3, [5_400, 2_700, 1_350])];

fn in_repelling_casing(kind: Kind, coarse: u32, rpm: f64) -> Case {
    Case {
        kind,
        smooth: true,
        ..Case::of(coarse, rpm)
    }
}

fn tell(report: &mut Report, case: &Case, measured: &Measured) {
    let name = format!(
        "{}, repelling casing, screw of {}",
        case.name(),
        case.kind.name()
    );
    let told = [
        ("mass_rate", "mass rate through the outlet, kg/s"),
        (TUBE, "mass rate in the tube, kg/s"),
        ("ratio_to_theory", "rate over theory at a = 1"),
        ("fill_ratio", "filling ratio a"),
        ("axial_efficiency", "axial speed over p n"),
    ];
    for (reading, what) in told {
        let (value, error) = measured.get(reading);
        report.tell(format!("{name}: {what}"), value, &format!("± {error:.3}"));
    }
}

/// The finest screw of grains at n = 3 at these speeds.
pub fn at_speeds(
    report: &mut Report,
    speeds: &[f64],
    all: &impl Fn(&[Case]) -> Result<Vec<Measured>, String>,
) -> Result<Vec<Measured>, String> {
    let (coarse, [.., finest]) = RADII[1];
    // Fast screws first: their turns are short.
    let cases: Vec<Case> = speeds
        .iter()
        .rev()
        .map(|&rpm| in_repelling_casing(Kind::Grains(finest), coarse, rpm))
        .collect();
    let mut measured = all(&cases)?;
    for (case, measured) in cases.iter().zip(&measured) {
        tell(report, case, measured);
    }
    measured.reverse();
    Ok(measured)
}

/// The rate against rs/rp: the rates in the tube, whose errors are smaller than those of the outlet.
pub fn run(
    report: &mut Report,
    all: &impl Fn(&[Case]) -> Result<Vec<Measured>, String>,
) -> Result<(), String> {
    let mut figure = Figure::new(
        "Paper A's screw feeder with a screw built of grains, 100 r/min",
        "radius of wall grains over that of grains, rs/rp (–)",
        "mass rate in the tube (kg/s)",
    )
    .log_x();
    for (coarse, radii) in RADII {
        let case = |kind| in_repelling_casing(kind, coarse, RPM);
        let mut cases: Vec<Case> = radii.iter().map(|&r| case(Kind::Grains(r))).collect();
        cases.push(case(Kind::Grid));
        let measured = all(&cases)?;
        for (case, measured) in cases.iter().zip(&measured) {
            tell(report, case, measured);
        }
        let tube = |m: &Measured| m.get(TUBE);
        let rp = 0.675 * f64::from(1u32 << coarse);
        let x = radii.map(|r| f64::from(r) * 1e-3 / rp);
        let (y, e): (Vec<f64>, Vec<f64>) = measured[..3].iter().map(tube).unzip();
        let grid = tube(&measured[3]).0;
        let theory = measured[3].get("mass_rate").0 / measured[3].get("ratio_to_theory").0;
        figure = figure
            .points(&format!("n = {coarse}, screw of grains"), &x, &y, Some(&e))
            .line(
                &format!("n = {coarse}, screw as a grid of distances"),
                &[0.2, 1.0],
                &[grid, grid],
            )
            .theory(
                &format!("n = {coarse}, theory, a = 1"),
                &[0.2, 1.0],
                &[theory, theory],
            );
    }
    report.figure("screw_of_grains", figure)
}
