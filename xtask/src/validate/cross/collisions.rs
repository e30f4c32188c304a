//! Single collisions: places and velocities over ten thousand steps.

use super::two::Two;
use crate::peers::Peer;
use crate::validate::check::Tolerance;
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use std::fmt::Write as _;
use tsubu::export::Target;
use tsubu_scene::Source;

/// Steps in all, and between two looks.
const STEPS: (u64, u64) = (10_000, 100);
/// Pairs that collide, each with a speed and an offset of its own.
const PAIRS: usize = 24;

/// Both laws.
pub fn lammps(report: &mut Report, peer: &Peer) -> Result<(), String> {
    let repulsion = "Repulsion(stiffness: YoungModulus(\"3.096 GPa\"), damping: Parts(normal: \"0.1257 kg/s\", tangential: \"0.05 kg/s\"))";
    compare(
        report,
        peer,
        "Repulsion",
        repulsion,
        1e-8,
        "the same scheme (VerletOld) in double precision; rounding grows by less than a hundred over a collision",
    )?;
    // Friction that no collision here reaches: sliding contacts remember differently (the deck's README says how).
    let springs = "SpringDashpot(constants: Given(normal_stiffness: \"3.7e6 N/m\", normal_damping: \"0.1257 kg/s\"), friction: 20)";
    compare(
        report,
        peer,
        "SpringDashpot without slip",
        springs,
        1e-6,
        "LAMMPS projects the spring onto the tangent plane in each step where tsubu turns it: the square of the angle per step",
    )
}

fn scene(law: &str) -> String {
    let mut draw = Draw(11);
    let mut grains = String::new();
    for pair in 0..PAIRS {
        // Pairs stand ten diameters apart and meet in the middle of the run, head-on to nearly grazing.
        let (x, y) = (13.5 * (pair % 5) as f64, 13.5 * (pair / 5) as f64);
        let offset = 1.2 * pair as f64 / PAIRS as f64;
        let (speed, turn) = (0.3 + draw.next(), std::f64::consts::TAU * draw.next());
        let (c, s) = (turn.cos(), turn.sin());
        // Within the first half of the run, whatever the speed.
        let gap = (1.35_f64.powi(2) - offset * offset).sqrt() + 0.02 + 0.04 * draw.next();
        for side in [0.5, -0.5] {
            let along = gap * side;
            let _ = write!(
                grains,
                "(at: (\"{:?} mm\", \"{:?} mm\", \"{:?} mm\"), velocity: (\"{:?} m/s\", \"{:?} m/s\", \"0.1 m/s\")), ",
                x + along * c,
                y + along * s,
                offset * side,
                -2.0 * side * speed * c,
                -2.0 * side * speed * s,
            );
        }
    }
    format!(
        "(title: \"Collisions\", gravity: \"0 m/s2\",
          grains: (diameter: \"1.35 mm\", density: \"1370 kg/m3\", law: {law}),
          initial: (grains: [{grains}]),
          time: (step: Exactly(\"2e-8 s\"), integrator: VerletOld, steps: {}))",
        STEPS.0
    )
}

fn compare(
    report: &mut Report,
    peer: &Peer,
    law: &str,
    text: &str,
    tolerance: f64,
    why: &str,
) -> Result<(), String> {
    let source = Source::from_text("collisions.ron", &scene(text));
    let name = format!("collisions_{}", law.replace(' ', "_"));
    let mut two = Two::of(
        report.root(),
        &name,
        Target::Lammps,
        &source,
        STEPS.1,
        str::to_owned,
    )?;
    two.run(peer, &[])?;
    let moments = two.moments()?;
    let start = two.ours.state();
    let (mut place, mut speed, mut met) = (0.0_f64, 0.0_f64, 0);
    for moment in &moments {
        two.ours.advance(moment.step - two.ours.steps());
        for (ours, theirs) in two.ours.state().iter().zip(&moment.atoms) {
            place = place.max((ours.0 - theirs.position).length() / two.diameter);
            speed = speed.max((ours.1 - theirs.velocity).length());
        }
    }
    for ((_, before), (_, after)) in start.iter().zip(two.ours.state()) {
        met += usize::from((*before - after).length() > 0.01);
    }
    let last = moments.last().map_or(0, |m| m.step);
    if last != STEPS.0 || met < 2 * PAIRS * 3 / 4 {
        return Err(format!(
            "{name}: {met} of {} grains collided in {last} steps",
            2 * PAIRS
        ));
    }
    report.cross_code(
        format!(
            "{law}: largest distance from LAMMPS's places over d in {} steps",
            STEPS.0
        ),
        0.0,
        place,
        Tolerance::Absolute(tolerance),
        why,
    );
    report.cross_code(
        format!("{law}: largest difference of a velocity, in m/s"),
        0.0,
        speed,
        Tolerance::Absolute(tolerance),
        why,
    );
    Ok(())
}
