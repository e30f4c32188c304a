//! The screw as a body built of grains (paper A's fig. 4), beside the same screw as a surface.
//!
//! The paper's case: 100 r/min, a casing of faces that only repel, wall grains from coarse to fine. Its n = 1 is out of
//! reach; here are n = 4, 3 and 2 in one pitch of the tube, which holds the same mass whatever the screw is made of, and
//! n = 4 in the whole feeder, where a thicker flight leaves less room.

use super::kept::{self, Measured};
use super::runs::{Case, Kind};
use super::section::{Found, Rung, SCENE};
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use rayon::prelude::*;
use tsubu_picture::Figure;

/// Speed of the comparison, r/min.
const RPM: f64 = 100.0;
/// Coarse level, turns of a run, and radii of wall grains in µm: the grains' own (10.8, 5.4 and 2.7 mm), a half of it …
const RADII: [(u32, f64, &[u32]); 3] = [
    (4, 8.0, &[10_800, 5_400, 2_700, 1_350]),
    (3, 8.0, &[5_400, 2_700, 1_350]),
    // Four turns: ten minutes of one core a run.
    (2, 4.0, &[2_700, 1_350]),
];

/// rs/rp of wall grains of this radius in µm at a level.
fn ratio(coarse: u32, radius: u32) -> f64 {
    f64::from(radius) * 1e-3 / (0.675 * f64::from(1u32 << coarse))
}

/// The section: axial speed against rs/rp.
pub fn in_the_section(report: &mut Report) -> Result<(), String> {
    let root = report.root().to_owned();
    let print = kept::fingerprint(&changed(&root.join(SCENE), &[])?)?;
    let rungs: Vec<Rung> = RADII
        .iter()
        .flat_map(|&(coarse, turns, radii)| {
            let grains = radii.iter().map(|&radius| Kind::Grains(radius));
            grains.chain([Kind::Grid]).map(move |kind| Rung {
                coarse,
                rpm: RPM,
                turns,
                at_centres: false,
                kind,
                smooth: true,
            })
        })
        .collect();
    let found = rungs
        .into_par_iter()
        .map(|rung| {
            let measured = rung.measured(&root, print)?;
            Ok(Found { rung, measured })
        })
        .collect::<Result<Vec<_>, String>>()?;
    report.progress("screws of grains in the section");
    let mut figure = Figure::new(
        "One pitch of the screw at 100 r/min, built of grains, casing that only repels",
        "radius of wall grains over that of grains, rs/rp (–)",
        "axial speed over p n (–)",
    )
    .log_x();
    for (coarse, _, radii) in RADII {
        let of_level = || found.iter().filter(|f| f.rung.coarse == coarse);
        for f in of_level() {
            let (value, error) = f.efficiency();
            report.tell(
                format!("{}: axial efficiency", f.rung.name()),
                value,
                &format!("axial speed over p n; ± {error:.4}"),
            );
        }
        let x: Vec<f64> = radii.iter().map(|&r| ratio(coarse, r)).collect();
        let of_grains = of_level().filter(|f| f.rung.kind != Kind::Grid);
        let (y, e): (Vec<f64>, Vec<f64>) = of_grains.map(Found::efficiency).unzip();
        figure = figure.points(&format!("n = {coarse}, screw of grains"), &x, &y, Some(&e));
        if let Some(grid) = of_level().find(|f| f.rung.kind == Kind::Grid) {
            let value = grid.efficiency().0;
            figure = figure.line(
                &format!("n = {coarse}, screw as a grid of distances"),
                &[0.2, 1.0],
                &[value, value],
            );
        }
    }
    report.figure("screw_of_grains", figure)
}

/// The whole feeder at n = 4: the rate against rs/rp, the paper's figure.
pub fn in_the_feeder(
    report: &mut Report,
    all: &impl Fn(&[Case]) -> Result<Vec<Measured>, String>,
) -> Result<(), String> {
    let (coarse, _, radii) = RADII[0];
    let case = |kind| Case {
        kind,
        smooth: true,
        ..Case::of(coarse, RPM)
    };
    let mut cases: Vec<Case> = radii[..3].iter().map(|&r| case(Kind::Grains(r))).collect();
    cases.push(case(Kind::Grid));
    let measured = all(&cases)?;
    let column =
        |name: &str| -> (Vec<f64>, Vec<f64>) { measured.iter().map(|m| m.get(name)).unzip() };
    let ((rate, error), (over, _)) = (column("mass_rate"), column("ratio_to_theory"));
    for (k, case) in cases.iter().enumerate() {
        let screw = case.kind.name();
        let name = format!("n = 4, 100 r/min, repelling casing, screw of {screw}");
        report.tell(
            format!("{name}: mass rate, kg/s"),
            rate[k],
            &format!("± {:.3}", error[k]),
        );
        report.tell(format!("{name}: rate over theory at a = 1"), over[k], "");
        report.tell(
            format!("{name}: filling ratio a"),
            measured[k].get("fill_ratio").0,
            "",
        );
    }
    let x: Vec<f64> = radii[..3].iter().map(|&r| ratio(coarse, r)).collect();
    let (grid, theory) = (rate[3], rate[3] / over[3]);
    let figure = Figure::new(
        "Paper A's screw feeder built of grains, n = 4, 100 r/min",
        "radius of wall grains over that of grains, rs/rp (–)",
        "mass rate (kg/s)",
    )
    .theory(
        "theory, a = 1, bulk density of the hopper",
        &[0.2, 1.0],
        &[theory, theory],
    )
    .line("screw as a grid of distances", &[0.2, 1.0], &[grid, grid])
    .points("screw of grains", &x, &rate[..3], Some(&error[..3]))
    .log_x();
    report.figure("screw_of_grains_rate", figure)
}
