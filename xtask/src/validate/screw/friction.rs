//! The feeder with Coulomb friction between grains that turn, held against another program.
//!
//! Paper A's grains have viscous damping between them and no spin. An independent run of the same screw, with walls of
//! triangles, Hertz contacts and Coulomb friction between grains, conveyed at 0.91 ± 0.05 of p n in the tube at 60 r/min. Neither
//! its size of grain nor how much lay in its hopper is known, so two levels and two hoppers are held against it. Here law
//! `SpringDashpot` stands for its grains: e = 0.5 and μ = 0.413 between grains and at walls, no rolling friction.

use super::cost::{Way, take_turns};
use super::full::SCENE as LARGE;
use super::identities;
use super::runs::Case;
use super::section::SCENE as SECTION;
use super::turning;
use crate::validate::check::Tolerance;
use crate::validate::kept::{self, Measured};
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use rayon::prelude::*;
use std::path::Path;

/// What the other program gave, axial speed in the tube over p n at 60 r/min, and how well it is known.
const OTHER: f64 = 0.91;
const WITHIN: f64 = 0.05;

pub const RPM: f64 = 60.0;
/// Friction between grains, as at the walls.
pub const FRICTION: f64 = 0.413;
/// Level, and Young's modulus of the shipped scene's contact divided by this. n = 3 is run ten times softer than that scene, which
/// takes a third of the steps; n = 4 says what that changes.
const LEVELS: [(u32, f64); 3] = [(3, 1000.0), (4, 1000.0), (4, 100.0)];

/// Grain-steps of these runs, 1.6e10, each as dear as three of law Repulsion.
pub const GRAIN_STEPS: f64 = 5e10;

/// What is told of each run beside that of paper A's law.
const TOLD: [(&str, &str); 9] = [
    ("axial_efficiency", "axial speed over p n"),
    ("tangential_speed", "tangential speed in the tube, m/s"),
    ("mass_rate_from_section", "mass rate in the tube, kg/s"),
    ("ratio_to_theory", "rate over theory at a = 1"),
    ("fill_ratio", "filling ratio a"),
    ("hopper_bulk_density", "bulk density in the hopper, kg/m³"),
    ("coordination", "contacts of a grain at the last look"),
    ("overlap_max", "largest overlap over d at the last look"),
    ("screw_torque", "torque of the screw, N m"),
];

/// The feeder at 60 r/min, Coulomb grains against the other program and beside paper A's.
pub fn run(
    report: &mut Report,
    root: &Path,
    print: u64,
    all: &impl Fn(&[Case]) -> Result<Vec<Measured>, String>,
) -> Result<(), String> {
    let cases = LEVELS.map(|(coarse, soften)| {
        Case {
            soften,
            ..Case::of(coarse, RPM)
        }
        .with_coulomb(FRICTION)
    });
    let own = fingerprint(root)?;
    let measured = cases
        .par_iter()
        .map(|case| {
            eprintln!("  screw {case:?} …");
            case.measured(root, own)
        })
        .collect::<Result<Vec<_>, String>>()?;
    let viscous = all(&[Case::of(4, RPM), Case::of(3, RPM)])?;
    for (case, found) in cases.iter().zip(&measured) {
        let name = case.name();
        against(report, &name, found);
        identities(report, &name, found);
        let beside = &viscous[if case.coarse == 4 { 0 } else { 1 }];
        for (what, words) in TOLD {
            let (value, error) = found.get(what);
            let (other, _) = beside.get(what);
            report.beside(
                format!("{name}: {words}, beside that of law Repulsion"),
                other,
                value,
                &format!("± {error:.4}"),
            );
        }
        report.tell(
            format!("{name}: share of the limit of the step that the settled packing uses"),
            found.get("step_over_limit").0,
            "the stiffest mode of the packing over what the scheme bears",
        );
    }
    let large = under_much(root, own)?;
    let name = format!("{}, hopper of 181 kg", cases[1].name());
    against(report, &name, &large);
    identities(report, &name, &large);
    turning::run(report, root, own)?;
    price(report, root, print)
}

/// The check.
fn against(report: &mut Report, name: &str, found: &Measured) {
    let (efficiency, error) = found.get("axial_efficiency");
    report.cross_code(
        format!("{name}: axial speed in the tube over p n"),
        OTHER,
        efficiency,
        Tolerance::Absolute(WITHIN),
        &format!("another program: Hertz, walls of triangles; ± {error:.4} here"),
    );
}

/// n = 4 under the hopper with the mass of the paper's 200 000 grains, seven times that of the default scene: what the head of
/// the bed does to the tube. From its own fill, five and a half turns.
fn under_much(root: &Path, own: u64) -> Result<Measured, String> {
    let case = Case {
        soften: 1000.0,
        ..Case::of(4, RPM)
    }
    .with_coulomb(FRICTION);
    let file = root.join(format!(
        "target/validate/screw/{own:016x}-coulomb-full-n4-{RPM}rpm.csv"
    ));
    if let Some(measured) = Measured::kept(&file) {
        return Ok(measured);
    }
    eprintln!("  screw with 25 000 grains of n = 4 …");
    let mut sets = case.sets();
    sets.push("time.until=5.5 s".to_owned());
    Measured::of_run(&changed(&root.join(LARGE), &sets)?, &file, None, 1)
}

/// The bits of the section with grains that turn, since those of the shipped scene know nothing of their law. It also has the
/// screw, its grid and the measures.
fn fingerprint(root: &Path) -> Result<u64, String> {
    let sets = Case::of(4, RPM).with_coulomb(FRICTION).law(0);
    kept::fingerprint(&changed(&root.join(SECTION), &sets)?)
}

/// What spin, memory and friction cost in this scene: both laws from the same grains in the flow of law Repulsion. In their own a
/// grain of n = 4 may be caught between flight and casing, deeper in the wall than a start allows.
fn price(report: &mut Report, root: &Path, print: u64) -> Result<(), String> {
    let viscous = Case::of(4, RPM);
    let coulomb = viscous.with_coulomb(FRICTION);
    let mut ways = [
        Way::in_flow(&viscous, root, print, "Repulsion", &[])?,
        Way::of(
            "SpringDashpot",
            &coulomb.in_flow_of(&viscous, root, print, &[])?,
        )?,
    ];
    take_turns(&mut ways);
    for way in &ways {
        report.tell(
            format!("n = 4, {RPM} r/min, law {}: ns per grain-step", way.name),
            way.cost,
            "in flow, one thread, the best of seven turns; compare rows",
        );
    }
    Ok(())
}
