//! A periodic row of grains: momentum, and the energy without damping.
//!
//! While the contacts of a pressed row stay closed the potential is smooth, leapfrog has a nearby
//! Hamiltonian of its own, and the energy error stays where it is. In a row of grains that part and
//! meet again it does not: φ'' jumps at the edge of the range, and every touch adds
//! ΔE/E = K [u'(1 − u') − u(1 − u)], u and u' the phases of its two ends, K = (2π/N)² at N steps per
//! period. Of order Δt² and of either sign, but it adds up like a random walk.

use super::pair::head_on;
use crate::validate::check::Tolerance;
use crate::validate::lab::{Draw, Lab, name};
use crate::validate::report::Report;
use crate::validate::wca::{GAMMA, Wca, coke, grain};
use glam::DVec3;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use tsubu_integrate::Scheme;
use tsubu_model::View;
use tsubu_picture::Figure;

const GRAINS: usize = 16;
/// Root mean square speed in m/s.
const SPEED: f64 = 0.3;
const STEPS_PER_PERIOD: [f64; 3] = [20.0, 40.0, 80.0];

/// A row with grains `gap` of a range apart (negative = pressed) and random velocities of no total momentum.
fn row(damping: f64, gap: f64, scheme: Scheme, steps_per_period: f64, seed: u64) -> Lab {
    let wca = Wca::of(&coke(0.0));
    let dt = wca.period(0.5 * grain().mass) / steps_per_period;
    let pitch = wca.range() * (1.0 + gap);
    let mut lab = Lab::new(grain(), coke(damping), scheme, dt);
    lab.period = DVec3::new(pitch * GRAINS as f64, f64::INFINITY, f64::INFINITY);
    let mut draw = Draw(seed);
    let speeds: Vec<f64> = (0..GRAINS).map(|_| SPEED * draw.normal()).collect();
    let mean = speeds.iter().sum::<f64>() / GRAINS as f64;
    for (i, speed) in speeds.iter().enumerate() {
        lab = lab.grain(
            DVec3::X * (pitch * (i as f64 + 0.5)),
            DVec3::X * (speed - mean),
        );
    }
    lab
}

/// Energy over the first one minus 1, every so many steps, and the momentum at the end over Σ m|v|.
fn history(lab: Lab, steps: u64) -> (Vec<f64>, f64) {
    let mut world = lab.world();
    let first = world.energies().held();
    // 19 steps: not in tune with any period here.
    let errors = (0..steps / 19)
        .map(|_| {
            world.advance(19);
            world.energies().held() / first - 1.0
        })
        .collect();
    let total = (0..GRAINS).fold(DVec3::ZERO, |sum, i| sum + world.velocity(i));
    let scale: f64 = (0..GRAINS).map(|i| world.velocity(i).length()).sum();
    (errors, total.length() / scale)
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |most, e| most.max(e.abs()))
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let steps: u64 = if report.full() { 1_000_000 } else { 100_000 };
    momentum(report, steps);
    let mut figure = Figure::new(
        "Energy of an undamped row",
        "steps (–)",
        "largest |E/E₀ − 1| so far (–)",
    )
    .log_x()
    .log_y();
    let mut largest = Vec::new();
    for n in STEPS_PER_PERIOD {
        let (errors, _) = history(row(0.0, -1e-3, Scheme::VerletOld, n, 1), steps);
        let half = errors.len() / 2;
        let growth = worst(&errors[half..]) / worst(&errors[..half]);
        let what = format!(
            "pressed row, T/{n}: largest energy error of the second half of {steps} steps over the first"
        );
        report.check(
            what,
            1.1,
            growth,
            Tolerance::AtMost,
            "bounded: later is no worse; a tenth for chance",
        );
        largest.push(worst(&errors));
        figure = with_envelope(figure, &format!("pressed, T/{n}"), &errors);
        report.progress(&format!("pressed row at T/{n}"));
    }
    report.tell("pressed row, T/20: largest energy error", largest[0], "");
    let ratio = largest[0] / largest[2];
    report.check(
        "pressed row: energy error at T/20 over that at T/80",
        16.0,
        ratio,
        Tolerance::Relative(0.1),
        "Δt²; the next order is K/12 = 1 %",
    );
    single_touch(report);
    figure = parting(report, steps, figure);
    report.figure("collision_row_energy", figure)
}

fn momentum(report: &mut Report, steps: u64) {
    for (words, gap) in [("pressed", -1e-3), ("parting", 1e-3)] {
        for scheme in [
            Scheme::SymplecticEuler,
            Scheme::VerletAveraged { sweeps: 4 },
        ] {
            let (_, momentum) = history(row(GAMMA * 1e-3, gap, scheme, 40.0, 2), steps / 10);
            report.check(
                format!("{words} row with damping, {}: momentum over Σ m|v|", name(scheme)),
                0.0,
                momentum,
                Tolerance::Absolute(1e-12),
                "round-off: forces are odd to the bit, each kick rounds to 1e-16 of the largest speed that was",
            );
        }
    }
}

/// The energy that one undamped collision wins or loses, over 64 phases of first touch.
fn single_touch(report: &mut Report) {
    let mass = 0.5 * grain().mass;
    let period = Wca::of(&coke(0.0)).period(mass);
    for n in [21.0, 81.0] {
        let change = (0..64).map(|k| {
            let phase = (f64::from(k) + 0.5) / 64.0;
            let e = head_on(
                grain(),
                &coke(0.0),
                Scheme::VerletOld,
                period / n,
                0.1,
                phase,
            )
            .map_or(f64::NAN, |r| r.restitution);
            (e * e - 1.0).abs()
        });
        let most = change.fold(0.0, f64::max);
        let bound = (TAU / n).powi(2) / 4.0;
        report.check(
            format!("one undamped collision, T/{n}: largest |ΔE/E| over 64 phases"),
            bound * 1.01,
            most,
            Tolerance::AtMost,
            "K/4, closed form for a spring that begins with a kink; 1 % for the potential's curvature and for (h'/h)²",
        );
    }
}

/// Rows of grains that part and meet, at equal time, against the walk that their touches make.
///
/// At 21, 41 and 81 steps half a period is half a step more than a whole number, so u' = u + ½ and one
/// touch adds K(¼ − u) of the pair's energy: variance K²/48 where u is even in 0…1. Pairs that meet have ⟨E²⟩ = 2(kT)², the row E₀ = (n − 1)kT/2, so after M touches
/// rms(E/E₀ − 1) = K √(2M/48) · 2/(n − 1) if the phases are independent. Equal grains in a row only
/// exchange velocities, so the same two meet again and again at phases that are spread more evenly than
/// chance: the walk is a bound.
fn parting(report: &mut Report, steps: u64, mut figure: Figure) -> Figure {
    let seeds = 24;
    let mut rms = Vec::new();
    for n in [21.0, 41.0, 81.0] {
        let steps = (steps as f64 / 4.0 * n / 81.0) as u64;
        let mut sum = 0.0;
        for seed in 0..seeds {
            let (errors, _) = history(row(0.0, 1e-3, Scheme::VerletOld, n, 10 + seed), steps);
            sum += errors.last().map_or(f64::NAN, |e| e * e);
            if seed == 0 {
                figure = with_envelope(figure, &format!("parting, T/{n}"), &errors);
            }
        }
        let touches =
            touches(row(0.0, 1e-3, Scheme::VerletOld, n, 10), steps.min(20_000)) * steps as f64;
        let walk = (TAU / n).powi(2) * (2.0 * touches / 48.0).sqrt() * 2.0 / (GRAINS - 1) as f64;
        let got = (sum / seeds as f64).sqrt();
        report.check(
            format!("parting row, T/{n}: rms energy error of 24 seeds after {steps} steps, {touches:.0} touches"),
            1.3 * walk,
            got,
            Tolerance::AtMost,
            "the walk of independent phases, which falls as Δt²; 0.3 is twice the chance of 24 walks",
        );
        rms.push(got);
        report.progress(&format!("parting row at T/{n}"));
    }
    let ratio = rms[0] / rms[2];
    report.beside(
        "parting row: rms energy error at T/21 over that at T/81, equal time",
        (81.0f64 / 21.0).powi(2),
        ratio,
        "Δt²",
    );
    figure
}

/// Touches that begin in the row per step.
fn touches(lab: Lab, steps: u64) -> f64 {
    let mut world = lab.world();
    let (mut count, mut before) = (0_usize, BTreeSet::new());
    // A touch lasts half a period, 10 steps and more.
    for _ in 0..steps / 4 {
        world.advance(4);
        let mut now = BTreeSet::new();
        world.touching(&mut |pair| {
            let (i, j) = (world.identity(pair.i), world.identity(pair.j));
            now.insert((i.min(j), i.max(j)));
        });
        count += now.difference(&before).count();
        before = now;
    }
    count as f64 / (steps / 4 * 4) as f64
}

/// The largest error so far, at 60 places even in the logarithm.
fn with_envelope(figure: Figure, label: &str, errors: &[f64]) -> Figure {
    let (mut x, mut y, mut most) = (Vec::new(), Vec::new(), 0.0f64);
    let mut next = 1.0;
    for (i, e) in errors.iter().enumerate() {
        most = most.max(e.abs());
        if most > 0.0 && (i + 1) as f64 >= next {
            x.push(19.0 * (i + 1) as f64);
            y.push(most);
            next = (i + 1) as f64 * 1.17;
        }
    }
    figure.line(label, &x, &y)
}
