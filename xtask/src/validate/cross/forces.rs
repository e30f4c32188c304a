//! Forces on a packing of 99 200 grains.

use super::two::{Two, with_forces};
use crate::peers::Peer;
use crate::validate::check::Tolerance;
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use crate::validate::scenes::{changed, keep};
use glam::DVec3;
use std::fmt::Write as _;
use tsubu::export::Target;

/// Grains that move: both engines add the same contacts in another order, in double precision, some 1e-14 of the largest
/// part of the sum.
const MOVING: f64 = 1e-10;
/// A bed at rest: an overlap is a difference of two lengths near d, so a force is known to k d 1e-16 = 1e-15 N, which is 1e-10
/// of the mean force that is left where contacts balance.
const AT_REST: f64 = 1e-9;

/// Law `Repulsion`, with grains that move, so that the damping is tried too.
pub fn lammps(report: &mut Report, peer: &Peer) -> Result<(), String> {
    let file = report.root().join("target/validate/cross/moving.csv");
    keep(&file, &moving(report)?)?;
    let sets = [
        format!("initial.file={}", file.display()),
        "time.steps=1".into(),
    ];
    let scene = "benches/scenes/repulsion.ron";
    compare(
        report,
        peer,
        Target::Lammps,
        ("Repulsion", MOVING),
        scene,
        &sets,
    )?;
    springs(report, peer, Target::Lammps)
}

/// Law `SpringDashpot`; LIGGGHTS has no other of ours.
pub fn liggghts(report: &mut Report, peer: &Peer) -> Result<(), String> {
    springs(report, peer, Target::Liggghts)
}

/// At rest: what tangential springs begin with is counted at other moments of the first step.
fn springs(report: &mut Report, peer: &Peer, target: Target) -> Result<(), String> {
    // The packing lay with its centres on the floor.
    let sets = [
        "walls.floor.touches_at=Centre".to_owned(),
        "time.steps=1".into(),
    ];
    let scene = "benches/scenes/spring_dashpot.ron";
    compare(
        report,
        peer,
        target,
        ("SpringDashpot", AT_REST),
        scene,
        &sets,
    )
}

/// packing.csv with a velocity for each grain, normal deviates of 10 mm/s.
fn moving(report: &Report) -> Result<String, String> {
    let path = report.root().join("benches/scenes/packing.csv");
    let places = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut draw = Draw(7);
    let mut text = "x,y,z,vx,vy,vz\n".to_owned();
    for line in places.lines().skip(1) {
        let v: [f64; 3] = std::array::from_fn(|_| 0.01 * draw.normal());
        let _ = writeln!(text, "{line},{:?},{:?},{:?}", v[0], v[1], v[2]);
    }
    Ok(text)
}

fn compare(
    report: &mut Report,
    peer: &Peer,
    target: Target,
    (law, tolerance): (&str, f64),
    scene: &str,
    sets: &[String],
) -> Result<(), String> {
    let name = format!("forces_{}_{law}", target.name());
    let source = changed(&report.root().join(scene), sets)?;
    let mut two = Two::of(report.root(), &name, target, &source, 1, with_forces)?;
    two.run(peer, &[("steps", "0".into())])?;
    let theirs = two.forces()?;
    let before = two.ours.state();
    two.ours.advance(1);
    let after = two.ours.state();
    // The first step of symplectic Euler changes a velocity by Δt/m times the force at the start.
    let ours: Vec<DVec3> = before
        .iter()
        .zip(&after)
        .map(|(a, b)| (b.1 - a.1) * (two.mass / two.dt))
        .collect();
    if ours.len() != theirs.len() {
        return Err(format!(
            "{name}: {} forces against {}",
            ours.len(),
            theirs.len()
        ));
    }
    let mean = |of: &[DVec3]| of.iter().map(|f| f.length()).sum::<f64>() / of.len() as f64;
    let worst = ours
        .iter()
        .zip(&theirs)
        .map(|(a, b)| (*a - *b).length())
        .fold(0.0, f64::max);
    report.cross_code(
        format!(
            "{law}: largest difference of a force from {}'s over the mean force",
            target.title()
        ),
        0.0,
        worst / mean(&theirs),
        Tolerance::Absolute(tolerance),
        "rounding: the constants MOVING and AT_REST say how much",
    );
    Ok(())
}
