//! The feeder at 60 r/min: the same STL files, fill and law `SpringDashpot` in both engines, each settling for itself.

use super::two::Two;
use crate::peers::Peer;
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use tsubu::export::{RELEASED, Target};
use tsubu_assemble::{Moment, Simulation};
use tsubu_model::Reading;

/// Simulated seconds from the start of the screw: four turns.
const UNTIL: f64 = 4.0;
/// Steps between two looks.
const LOOK: u64 = 400;
/// How far the axial speed may be off: sliding springs are read otherwise, and the tube fills by another packing.
const SPEED: f64 = 0.1;

/// Conveying speeds side by side.
pub fn liggghts(report: &mut Report, peer: &Peer) -> Result<(), String> {
    let sets = [
        "grains.coarse=4",
        "outlets.outlet.then=Delete",
        "still.damping=1",
        "grains.law=SpringDashpot(constants: FromRestitution(normal_stiffness: \"37252.4 N/m\", restitution: 0.5), poisson: 0.3, friction: 0.5)",
        "grains.soften=None",
        "grains.softened_damping=None",
        "walls.screw.motion.turn.rate=-60 rpm",
    ];
    let mut sets: Vec<String> = sets.map(str::to_owned).to_vec();
    sets.push(format!("time.until={UNTIL} s"));
    let source = changed(&report.root().join("scenarios/screw_feeder.ron"), &sets)?;
    let mut two = Two::of(
        report.root(),
        "screw",
        Target::Liggghts,
        &source,
        LOOK,
        str::to_owned,
    )?;
    two.run(peer, &[])?;
    report.progress("the same here");
    two.ours.look();
    while !two.ours.is_over() {
        two.ours.advance(LOOK);
        two.ours.look();
    }
    let ours = two.ours.report();
    let mut shown = Two::of(
        report.root(),
        "screw",
        Target::Liggghts,
        &source,
        LOOK,
        str::to_owned,
    )?;
    let released =
        std::fs::read_to_string(shown.folder().join(RELEASED)).map_err(|e| e.to_string())?;
    let released: u64 = released
        .trim()
        .parse()
        .map_err(|e| format!("{RELEASED}: {e}"))?;
    for moment in shown.moments()? {
        let grains = moment
            .atoms
            .iter()
            .map(|a| (a.id as u32 - 1, a.position, a.velocity));
        let moment = Moment {
            steps: moment.step,
            released: Some(released),
            grains: grains.collect(),
        };
        shown.ours.show(&moment);
        shown.ours.look();
    }
    let theirs = Simulation::report(&*shown.ours);
    let find = |all: &[Reading], name: &str| {
        let found = all.iter().find(|r| r.name == name);
        found
            .map(|r| (r.value, r.uncertainty.unwrap_or(0.0)))
            .ok_or_else(|| format!("the feeder does not measure {name}"))
    };
    let (a, b) = (
        find(&ours, "axial_efficiency")?,
        find(&theirs, "axial_efficiency")?,
    );
    let noise = 3.0 * (a.1 * a.1 + b.1 * b.1).sqrt();
    report.cross_code(
        "screw at 60 r/min: axial speed in the tube over p n",
        b.0,
        a.0,
        Tolerance::Absolute(SPEED * b.0 + noise),
        "a tenth for what the engines read otherwise, and three standard errors",
    );
    for name in ["mass_rate", "fill_ratio", "hopper_bulk_density"] {
        let (a, b) = (find(&ours, name)?, find(&theirs, name)?);
        report.beside(
            format!("screw at 60 r/min: {name}, LIGGGHTS beside"),
            b.0,
            a.0,
            "to read",
        );
    }
    Ok(())
}
