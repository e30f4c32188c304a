//! A grain thrown at a plate of a flight's thickness that is known by a grid of distances only.

use super::Sheet;
use crate::validate::lab::Lab;
use crate::validate::sdf::bench::Bench;
use crate::validate::sdf::shapes::{cuboid, grid};
use crate::validate::wca::Wca;
use glam::DVec3;
use std::fmt::Write as _;
use std::sync::Arc;
use tsubu_integrate::Scheme;
use tsubu_model::{Motion, View};
use tsubu_picture::Figure;

/// Thickness of the feeder's flight in m.
const THICKNESS: f64 = 6e-3;
const CELLS: u32 = 20;
const SPEEDS: u32 = 20;
/// Steps per period of a contact with the wall.
const STEPS_PER_PERIOD: f64 = 20.0;

fn between(low: f64, high: f64, k: u32, of: u32) -> f64 {
    low * (high / low).powf(f64::from(k) / f64::from(of - 1))
}

/// How a throw ended.
#[derive(Clone, Copy, PartialEq)]
enum End {
    /// Came back with its energy to 5 % and straight: 20 steps per period are good to 2.5 %.
    Back,
    /// Came back with another energy.
    BackChanged,
    Through,
    /// The engine reported a grain too fast for its step.
    Reported,
}

/// A grain thrown along x at the plate from this speed in m/s.
fn throw(
    bench: &Bench,
    plate: &Arc<dyn tsubu_model::Surface<tsubu_model::Space>>,
    speed: f64,
) -> End {
    let dt = bench.period() / STEPS_PER_PERIOD;
    let start = 0.5 * THICKNESS + 2.0 * bench.kind.diameter();
    let mut lab = Lab::new(bench.kind, bench.law, Scheme::SymplecticEuler, dt);
    lab = lab.body(plate.clone(), Motion::default(), None, 0.0);
    // Off the nodes in y and z.
    let place = DVec3::new(-start, 0.3e-3, 0.2e-3);
    let mut world = lab.grain(place, DVec3::X * speed).world();
    for _ in 0..200_000 {
        world.advance(1);
        if !world.health().is_fine() {
            return End::Reported;
        }
        let x = world.position(0);
        if x.x > start {
            return End::Through;
        }
        let off = x - place;
        if x.x < -start || off.y.hypot(off.z) > 4.0 * bench.kind.diameter() {
            let energy = world.velocity(0).length_squared() / (speed * speed);
            let sideways = world.velocity(0).y.hypot(world.velocity(0).z);
            let sound = (energy - 1.0).abs() < 0.05 && sideways < 0.01 * speed;
            return if sound { End::Back } else { End::BackChanged };
        }
    }
    End::Through
}

/// The map.
pub fn run(sheet: &Sheet) -> Result<bool, String> {
    let bench = Bench::softened(100.0)?;
    let wca = Wca::of(&bench.law);
    let diameter = bench.kind.diameter();
    let omega = (wca.edge_stiffness() / bench.kind.mass).sqrt();
    let unit = omega * diameter;
    let half = DVec3::new(0.5 * THICKNESS, 6.0 * diameter, 6.0 * diameter);
    let mesh = cuboid(-half, half)?;
    let mut csv = "cell over thickness,speed over omega d,end\n".to_owned();
    let mut classes = [(); 4].map(|()| (Vec::new(), Vec::new()));
    for column in 0..CELLS {
        let ratio = between(0.25, 4.0, column, CELLS);
        let cell = ratio * THICKNESS;
        // An odd number of cells across: the middle of the plate lies in the middle of one, the worst that can be.
        let least = (diameter + 2.5 * cell).max(2.0 * cell);
        let mut cells = ((THICKNESS + 2.0 * least) / cell).ceil();
        if cells % 2.0 == 0.0 {
            cells += 1.0;
        }
        let band = 0.5 * (cells * cell - THICKNESS) * (1.0 - 1e-9);
        let plate: Arc<dyn tsubu_model::Surface<tsubu_model::Space>> =
            Arc::new(grid(&mesh, cell, band, false)?);
        for row in 0..SPEEDS {
            let speed = between(1e-3, 6.0, row, SPEEDS);
            let end = throw(&bench, &plate, speed * unit);
            let (class, word) = match end {
                End::Back => (0, "back"),
                End::BackChanged => (1, "back with another velocity"),
                End::Through => (2, "through"),
                End::Reported => (3, "reported"),
            };
            classes[class].0.push(ratio);
            classes[class].1.push(speed);
            let _ = writeln!(csv, "{ratio:?},{speed:?},{word}");
        }
    }
    // Between the two nodes beside the middle the interpolant is flat: R = (h − t)/2, s = R + d/2. What gets there is through.
    let unseen = (diameter + THICKNESS) / THICKNESS;
    let ratios: Vec<f64> = (0..200)
        .map(|k| between(0.25, 0.999 * unseen, k, 200))
        .collect();
    let barrier = |ratio: &f64| {
        let s = 0.5 * (ratio - 1.0) * THICKNESS + 0.5 * diameter;
        (2.0 * wca.potential(s) / bench.kind.mass).sqrt() / unit
    };
    let barriers: Vec<f64> = ratios.iter().map(barrier).collect();
    let dt = bench.period() / STEPS_PER_PERIOD;
    // From half a diameter per step on.
    let too_fast = 0.5 * wca.range() / dt / unit;
    let mut figure = Figure::new(
        "A grain of 10.8 mm at a 6 mm plate known by a grid",
        "cell over thickness of the plate (–)",
        "speed over ωd, ω = √(k/m) (–)",
    )
    .log_x()
    .log_y()
    .x_range(0.23, 4.4)
    .y_range(8e-4, 8.0);
    let words = [
        "comes back",
        "comes back otherwise",
        "through",
        "reported as runaway",
    ];
    for (words, (x, y)) in words.iter().zip(&classes) {
        if !x.is_empty() {
            figure = figure.points(words, x, y, None);
        }
    }
    figure = figure
        .theory(
            "½mv² = φ at the flat middle of the grid",
            &ratios,
            &barriers,
        )
        .line("vΔt = d/2", &[0.23, 4.4], &[too_fast, too_fast])
        .line(
            "cell = d + thickness: not felt",
            &[unseen, unseen],
            &[8e-4, 8.0],
        );
    sheet.write("tunnel", figure, &csv)?;
    println!(
        "ωd = {unit:.1} m/s at E/100; not felt from a cell of {unseen:.2} thicknesses on; too fast from {too_fast:.2} ωd on"
    );
    for ratio in [0.25, 1.0, 2.0, 2.5, 2.7] {
        println!(
            "cell = {ratio} thicknesses: through from v/ωd = {:.3e} on",
            barrier(&ratio)
        );
    }
    Ok(true)
}
