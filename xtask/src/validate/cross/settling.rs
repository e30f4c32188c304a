//! A bed falls together and lies: energies on the way, and the pressure on the floor at the end.

use super::two::Two;
use crate::peers::Peer;
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use tsubu::export::Target;
use tsubu_picture::Figure;
use tsubu_scene::Source;

/// Beds, alike but for their seed.
const SEEDS: u64 = 4;
/// Steps in all, between two looks, and from which on the pressure is averaged.
const STEPS: (u64, u64, u64) = (40_000, 1000, 30_000);
/// Standard errors by which the mean curves may differ where the beds have parted by chaos. With 40 looks the largest of
/// as many draws is expected near 3 with four beds (t of 3 degrees of freedom has long tails).
const ERRORS: f64 = 6.0;

fn scene(seed: u64) -> String {
    format!(
        "(title: \"A bed settles\",
          grains: (diameter: \"1.350 mm\", mass: \"1.7649e-6 kg\",
            law: Repulsion(stiffness: Energy(epsilon: \"9.434e-5 J\", sigma: \"1.203 mm\"), damping: Equal(\"3.975e-3 kg/s\"))),
          domain: (x: Periodic(\"10.8 mm\"), y: Periodic(\"10.8 mm\"), z: Open),
          walls: [(name: \"floor\", shape: HalfSpace(point: (\"0 mm\", \"0 mm\", \"0 mm\"), outward: (0, 0, 1)))],
          initial: (fill: (region: (min: (\"0 mm\", \"0 mm\", \"1 mm\"), max: (\"10.8 mm\", \"10.8 mm\", \"26 mm\")), solid_fraction: 0.28, seed: {seed})),
          time: (step: Exactly(\"4.8e-6 s\"), integrator: VerletOld, steps: {}))",
        STEPS.0
    )
}

/// Kinetic energy and mean height of each look, in J and m, and the mean force on the floor, in N.
struct Bed {
    kinetic: Vec<f64>,
    height: Vec<f64>,
    floor: f64,
    weight: f64,
}

/// Sums of a bed's state.
fn sums(grains: impl Iterator<Item = (glam::DVec3, glam::DVec3)>, mass: f64) -> (f64, f64) {
    let (mut kinetic, mut height, mut n) = (0.0, 0.0, 0.0_f64);
    for (x, v) in grains {
        kinetic += 0.5 * mass * v.length_squared();
        height += x.z;
        n += 1.0;
    }
    (kinetic, height / n.max(1.0))
}

pub fn lammps(report: &mut Report, peer: &Peer) -> Result<(), String> {
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for seed in 1..=SEEDS {
        let [a, b] = both(report, peer, seed)?;
        ours.push(a);
        theirs.push(b);
    }
    let time: Vec<f64> = (0..ours[0].kinetic.len())
        .map(|k| k as f64 * STEPS.1 as f64 * 4.8e-6)
        .collect();
    for (what, unit, of) in [
        (
            "kinetic energy",
            "J",
            (|b: &Bed| &b.kinetic) as fn(&Bed) -> &Vec<f64>,
        ),
        ("mean height", "m", |b: &Bed| &b.height),
    ] {
        let (mut worst, mut means) = (0.0_f64, [Vec::new(), Vec::new()]);
        for k in 0..time.len() {
            let at = |beds: &[Bed]| -> Vec<f64> { beds.iter().map(|b| of(b)[k]).collect() };
            let [(a, ea), (b, eb)] = [mean(&at(&ours)), mean(&at(&theirs))];
            means[0].push(a);
            means[1].push(b);
            // Until chaos parts them the beds are the same to many digits, and their spread is that of the seeds.
            worst = worst.max((a - b).abs() / (ea * ea + eb * eb).sqrt().max(1e-6 * a.abs()));
        }
        report.cross_code(
            format!(
                "settling: {what} over time, largest difference in standard errors of {SEEDS} beds"
            ),
            0.0,
            worst,
            Tolerance::Absolute(ERRORS),
            "beds part by chaos after some hundred collisions each: only means can agree",
        );
        let figure = Figure::new(
            "A bed settles in two engines",
            "time (s)",
            &format!("{what} ({unit})"),
        )
        .theory("LAMMPS", &time, &means[1])
        .points("tsubu", &time, &means[0], None);
        report.figure(&format!("cross_{}", what.replace(' ', "_")), figure)?;
    }
    let over = |beds: &[Bed]| mean(&beds.iter().map(|b| b.floor / b.weight).collect::<Vec<_>>()).0;
    report.cross_code(
        "settled: mean pressure on the floor over LAMMPS's",
        1.0,
        over(&ours) / over(&theirs),
        Tolerance::Relative(1e-3),
        "both carry the same weight; what still swings averages out over ten thousand steps",
    );
    report.check(
        "settled: mean pressure on the floor over weight by area",
        1.0,
        over(&ours),
        Tolerance::Relative(1e-3),
        "a bed at rest weighs what it weighs",
    );
    Ok(())
}

fn both(report: &Report, peer: &Peer, seed: u64) -> Result<[Bed; 2], String> {
    let source = Source::from_text("settling.ron", &scene(seed));
    let often = |deck: &str| deck.replace("thermo 1000", "thermo 50");
    let mut two = Two::of(
        report.root(),
        &format!("settling_{seed}"),
        Target::Lammps,
        &source,
        STEPS.1,
        often,
    )?;
    let log = two.run(peer, &[])?;
    let weight = two.ours.grains() as f64 * two.mass * 9.80665;
    let moments = two.moments()?;
    let (mut kinetic, mut height) = (Vec::new(), Vec::new());
    for moment in &moments {
        let (k, z) = sums(
            moment.atoms.iter().map(|a| (a.position, a.velocity)),
            two.mass,
        );
        kinetic.push(k);
        height.push(z);
    }
    let (steps, force) = (log.column("Step"), log.column("f_wall_floor[1]"));
    let late: Vec<f64> = steps
        .iter()
        .zip(&force)
        .filter(|(step, _)| **step >= STEPS.2 as f64)
        .map(|(_, f)| f.abs())
        .collect();
    let theirs = Bed {
        kinetic,
        height,
        floor: mean(&late).0,
        weight,
    };
    let (mut kinetic, mut height, mut late) = (Vec::new(), Vec::new(), Vec::new());
    let run = &mut *two.ours;
    loop {
        if run.steps() % STEPS.1 == 0 {
            let (k, z) = sums(run.state().into_iter(), two.mass);
            kinetic.push(k);
            height.push(z);
        }
        if run.steps() >= STEPS.2 {
            late.push(run.body_forces()[0].1.z.abs());
        }
        if run.is_over() {
            break;
        }
        run.advance(50);
    }
    if kinetic.len() != theirs.kinetic.len() {
        return Err(format!(
            "{} looks against {}",
            kinetic.len(),
            theirs.kinetic.len()
        ));
    }
    Ok([
        Bed {
            kinetic,
            height,
            floor: mean(&late).0,
            weight,
        },
        theirs,
    ])
}

/// Mean and its standard error.
fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / n;
    let spread = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    (mean, (spread / n).sqrt())
}
