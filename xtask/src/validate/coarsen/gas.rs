//! A gas of grains that cools by its collisions: rate 1/λ, and so does the loss; Radl's rule keeps the loss.
//!
//! Every level fills the same box at the same solid fraction and granular temperature. The damping acts
//! along the contact only, as in the theory (Enskog's rate, Haff's law), and is light, so that Radl's
//! rule has values up to n = 3. A contact lasts 2 % of the time between collisions.

use super::{Coarse, level, rules};
use crate::validate::check::Tolerance;
use crate::validate::collision::order::slope;
use crate::validate::lab::{Directed, Draw, Lab};
use crate::validate::report::Report;
use crate::validate::wca::Wca;
use glam::DVec3;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use tsubu_coarsen::CoarseRule;
use tsubu_contact::restitution::at_zero_overlap;
use tsubu_integrate::Scheme;
use tsubu_model::View;
use tsubu_picture::Figure;

/// e = 0.97.
const ZETA: f64 = 0.0097;
const FRACTION: f64 = 0.3;
/// One component's root mean square speed at the start, m/s.
const SPEED: f64 = 2.0;
/// Grains along an edge of the box at n = 3.
const EDGE: u32 = 6;

/// What a gas did, free of its temperature.
#[derive(Clone, Copy, Debug, Default)]
struct Rates {
    /// Collisions of one grain over ∫√(kT/m)dt, in 1/m.
    collisions: f64,
    /// Growth of 1/√(kT/m), in 1/m: Haff's law.
    cooling: f64,
}

fn gas(coarse: &Coarse, edge: u32, seed: u64) -> Directed {
    let range = Wca::of(&coarse.law).range();
    let pitch = range * (PI / 6.0 / FRACTION).cbrt();
    let mut lab = Lab::new(coarse.kind, coarse.law, Scheme::VerletOld, coarse.dt);
    lab.period = DVec3::splat(pitch * f64::from(edge));
    let mut draw = Draw(seed);
    let places = (0..edge.pow(3)).map(|i| {
        [i % edge, i / edge % edge, i / edge / edge].map(|c| (f64::from(c) + 0.5) * pitch)
    });
    lab.grains = places
        .map(|x| {
            (
                DVec3::from(x),
                DVec3::new(draw.normal(), draw.normal(), draw.normal()) * SPEED,
            )
        })
        .collect();
    let drift = lab.grains.iter().map(|g| g.1).sum::<DVec3>() / lab.grains.len() as f64;
    lab.grains.iter_mut().for_each(|g| g.1 -= drift);
    lab.without_tangential_damping()
}

/// √(kT/m): root mean square of one component.
fn thermal_speed(world: &Directed) -> f64 {
    let n = world.len();
    ((0..n)
        .map(|i| world.velocity(i).length_squared())
        .sum::<f64>()
        / (3 * n) as f64)
        .sqrt()
}

/// Rates over about `collisions` collisions per grain, after the lattice has melted for as many.
fn rates(coarse: &Coarse, edge: u32, seed: u64, collisions: f64) -> Rates {
    let mut world = gas(coarse, edge, seed);
    let apart = 1.0 / (enskog(coarse) * SPEED);
    world.advance((collisions * apart / coarse.dt) as u64);
    let begin = thermal_speed(&world);
    let start = world.now();
    // A contact lasts half a period: looked at five times, none is missed.
    let period = Wca::of(&coarse.law).period(0.5 * coarse.kind.mass);
    let stride = ((0.1 * period / coarse.dt) as u64).max(1);
    let (mut path, mut count, mut before) = (0.0, 0_usize, BTreeSet::new());
    while world.now() - start < collisions * apart {
        world.advance(stride);
        path += thermal_speed(&world) * stride as f64 * coarse.dt;
        let mut now = BTreeSet::new();
        world.touching(&mut |pair| {
            let (i, j) = (world.identity(pair.i), world.identity(pair.j));
            now.insert((i.min(j), i.max(j)));
        });
        count += now.difference(&before).count();
        before = now;
    }
    let elapsed = world.now() - start;
    let end = thermal_speed(&world);
    Rates {
        collisions: 2.0 * count as f64 / world.len() as f64 / path,
        cooling: (1.0 / end - 1.0 / begin) / elapsed,
    }
}

/// Enskog's collisions of one grain over its thermal path: 4√π n d² g(d), g by Carnahan and Starling.
fn enskog(coarse: &Coarse) -> f64 {
    let d = Wca::of(&coarse.law).range();
    let contact = (1.0 - 0.5 * FRACTION) / (1.0 - FRACTION).powi(3);
    4.0 * PI.sqrt() * (6.0 * FRACTION / PI) / d * contact
}

/// Mean over as many seeds as make the number of collisions alike at every level.
fn mean(report: &Report, rule: &dyn CoarseRule, n: u32, seeds: u64) -> Result<Rates, String> {
    let coarse = level(rule, 1.0, ZETA, 20.0, n)?;
    let mut sum = Rates::default();
    for seed in 0..seeds {
        let one = rates(&coarse, EDGE << (3 - n), 100 + seed, 4.0);
        sum.collisions += one.collisions / seeds as f64;
        sum.cooling += one.cooling / seeds as f64;
    }
    report.progress(&format!("gas, {}, n = {n}", rule.name()));
    Ok(sum)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let e = at_zero_overlap(ZETA);
    let mut figure = Figure::new(
        "A cooling gas at equal solid fraction",
        "λ (–)",
        "per path of a grain (1/m)",
    )
    .log_x()
    .log_y();
    for (number, rule) in rules(ZETA)?.iter().enumerate() {
        let (mut lambda, mut collisions, mut cooling, mut theory) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for n in 1..=3 {
            // 13 824 grains at n = 1 and as many in all at n = 2 and 3; the rivals fewer in the quick version.
            let seeds = 8_u64.pow(n - 1) / if number == 0 || report.full() { 1 } else { 8 };
            if seeds == 0 {
                continue;
            }
            let got = match mean(report, rule.as_ref(), n, seeds) {
                Ok(got) => got,
                Err(refused) => {
                    report.progress(&refused);
                    continue;
                }
            };
            let expected = enskog(&level(rule.as_ref(), 1.0, ZETA, 20.0, n)?);
            // Radl's rule means to keep the loss of the real grains.
            let kept = if number == 2 {
                2f64.powi(n as i32)
            } else {
                1.0
            };
            let (of_collisions, of_cooling) = (
                format!("collisions per path (1/m), {}, n = {n}", rule.name()),
                format!("Haff's cooling (1/m), {}, n = {n}", rule.name()),
            );
            if number == 0 {
                let note = "Enskog with Carnahan–Starling: good to 1 %; a contact lasts 2 % of the time between two; 1 % of chance";
                report.check(
                    of_collisions,
                    expected,
                    got.collisions,
                    Tolerance::Relative(0.05),
                    note,
                );
                report.check(of_cooling, (1.0 - e * e) / 6.0 * expected, got.cooling, Tolerance::Relative(0.08), "as above; e is off by 1 % of 1 − e² per touch at 20 steps per period, chance 2 %");
            } else {
                report.beside(of_collisions, expected, got.collisions, "");
                report.beside(
                    of_cooling,
                    (1.0 - e * e) / 6.0 * expected * kept,
                    got.cooling,
                    "Haff's law; under Radl's rule the rate of n = 0",
                );
            }
            lambda.push(2f64.powi(n as i32));
            collisions.push(got.collisions);
            cooling.push(got.cooling);
            theory.push(expected);
        }
        let powers = [
            ("collision rate", slope(&lambda, &collisions)),
            ("loss to collisions", slope(&lambda, &cooling)),
        ];
        for (what, power) in powers {
            let name = format!("power of λ of the {what}, {}", rule.name());
            if number == 0 {
                report.check(
                    name,
                    -1.0,
                    power,
                    Tolerance::Absolute(0.05),
                    "1/λ; chance of 2 % at each end of a factor 4 is 0.02",
                );
            } else {
                let expected = if number == 2 && what.starts_with("loss") {
                    0.0
                } else {
                    -1.0
                };
                report.beside(name, expected, power, "");
            }
        }
        if number == 0 {
            let haff: Vec<f64> = theory
                .iter()
                .map(|rate| (1.0 - e * e) / 6.0 * rate)
                .collect();
            let kept: Vec<f64> = lambda
                .iter()
                .zip(&haff)
                .map(|(lambda, rate)| lambda * rate)
                .collect();
            let label = "Enskog; Haff with e kept; Haff at n = 0";
            figure = figure
                .theory(label, &lambda, &theory)
                .theory(label, &lambda, &haff)
                .theory(label, &lambda, &kept);
        }
        figure = figure
            .points(
                &format!("collisions, {}", rule.name()),
                &lambda,
                &collisions,
                None,
            )
            .points(
                &format!("cooling, {}", rule.name()),
                &lambda,
                &cooling,
                None,
            );
    }
    report.figure("coarsen_gas", figure)
}
