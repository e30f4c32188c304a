//! Two grains of `Repulsion` head-on: how fast they may meet at which step.
//!
//! The potential stiffens with the overlap, so a step that is stable at touch is not at the deepest point of a fast impact.

use super::Sheet;
use crate::validate::collision::pair::head_on;
use crate::validate::wca::{Wca, coke, grain};
use std::fmt::Write as _;
use tsubu_integrate::Scheme;
use tsubu_picture::Figure;

/// Speeds and steps of the map, and phases of the first touch.
const SPEEDS: u32 = 22;
const STEPS: u32 = 22;
const PHASES: u32 = 16;
/// Energy won that counts as failure.
const GAIN: f64 = 0.1;
/// Overlap over the range at which a run of this law stops.
const DEEP: f64 = 0.3;
/// Energy won that breaks a scene within a few collisions.
const BREAKS: f64 = 1.0;

/// Between two numbers, evenly in the logarithm.
fn between(low: f64, high: f64, k: u32, of: u32) -> f64 {
    low * (high / low).powf(f64::from(k) / f64::from(of - 1))
}

/// The map.
pub fn run(sheet: &Sheet) -> Result<bool, String> {
    let law = coke(0.0);
    let wca = Wca::of(&law);
    let mass = 0.5 * grain().mass;
    let omega = (wca.edge_stiffness() / mass).sqrt();
    // Speed at which a linear spring would be pressed by a whole diameter.
    let unit = omega * wca.range();
    let mut csv = "v/(omega d),omega dt,largest energy after over before\n".to_owned();
    let mut classes = [(); 4].map(|()| (Vec::new(), Vec::new()));
    for row in 0..STEPS {
        let turn = between(0.05, 2.5, row, STEPS);
        for column in 0..SPEEDS {
            let speed = between(1e-3, 3.0, column, SPEEDS);
            let dt = turn / omega;
            let most = (0..PHASES)
                .map(|k| {
                    let phase = (f64::from(k) + 0.5) / f64::from(PHASES);
                    head_on(
                        grain(),
                        &law,
                        Scheme::SymplecticEuler,
                        dt,
                        speed * unit,
                        phase,
                    )
                    .map_or(f64::INFINITY, |r| r.restitution.powi(2))
                })
                .fold(0.0, f64::max);
            let class = match most - 1.0 {
                gain if gain <= 0.01 => 0,
                gain if gain <= GAIN => 1,
                gain if gain <= BREAKS => 2,
                _ => 3,
            };
            classes[class].0.push(speed);
            classes[class].1.push(turn);
            let _ = writeln!(csv, "{speed:?},{turn:?},{most:?}");
        }
    }
    // Stiffness at the deepest point over that at touch.
    let speeds: Vec<f64> = (0..200).map(|k| between(1e-3, 3.0, k, 200)).collect();
    let stiffer = |speed: &f64| {
        let (closest, _) = wca.undamped_collision(mass, speed * unit);
        wca.stiffness(closest) / wca.edge_stiffness()
    };
    let line = |k: f64| -> Vec<f64> { speeds.iter().map(|v| (k / stiffer(v)).sqrt()).collect() };
    let stable = line(4.0);
    // A collision begins and ends at a kink, which wins K/4 of the energy at most, K at touch.
    let gains = (4.0 * GAIN).sqrt();
    // Where a run stops for too deep an overlap.
    let deep = (2.0 * wca.potential((1.0 - DEEP) * wca.range()) / mass).sqrt() / unit;
    let runaway: Vec<f64> = speeds.iter().map(|v| 0.5 / v).collect();
    let mut figure = Figure::new(
        "Two undamped grains of Repulsion head-on, SymplecticEuler",
        "impact speed over ωd, ω = √(k/m*) (–)",
        "ωΔt (–)",
    )
    .log_x()
    .log_y()
    .x_range(9e-4, 3.3)
    .y_range(0.045, 2.7);
    let words = ["energy won ≤ 1 %", "≤ 10 %", "≤ 100 %", "more, or lost"];
    for (words, (x, y)) in words.iter().zip(&classes) {
        if !x.is_empty() {
            figure = figure.points(words, x, y, None);
        }
    }
    figure = figure
        .theory("K = 4 at the deepest point", &speeds, &stable)
        .line("K/4 = 10 % at touch", &[9e-4, 3.3], &[gains, gains])
        .line("overlap 0.3 d: a run stops", &[deep, deep], &[0.045, 2.7])
        .line("vΔt = d/2: reported as runaway", &speeds, &runaway);
    sheet.write("impact", figure, &csv)?;
    for v in [1e-3, 1e-2, 0.1, 0.3, 1.0] {
        let (closest, _) = wca.undamped_collision(mass, v * unit);
        println!(
            "v/ωd = {v}: overlap {:.3} d, stiffness {:.3} times that at touch, K = 4 at ωΔt = {:.3}",
            1.0 - closest / wca.range(),
            stiffer(&v),
            (4.0 / stiffer(&v)).sqrt()
        );
    }
    println!("ωd of coke: {unit:.0} m/s; softened by s it is that over √s");
    Ok(true)
}
