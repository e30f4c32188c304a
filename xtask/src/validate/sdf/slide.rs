//! A grain on an incline made of a mesh: g (sin θ − μ cos θ), or rest.

use super::bench::{Bench, FRICTION, GRAVITY, RESTITUTION, USUAL_STEPS};
use super::shapes::{self, Shared};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::{DMat3, DVec3};
use std::sync::Arc;
use tsubu_model::{Motion, View};

/// How long a grain slides, in s.
const TIME: f64 = 0.2;

/// Acceleration and final speed along the slope in m/s² and m/s, and the step.
fn slide(bench: &Bench, surface: &Shared, tilt: DMat3, start: DVec3) -> (f64, f64, f64) {
    let dt = bench.period() / USUAL_STEPS;
    let mut lab = bench
        .lab(surface, Motion::default(), RESTITUTION, FRICTION, dt)
        .grain(start, DVec3::ZERO);
    lab.gravity = DVec3::Z * -GRAVITY;
    let mut world = lab.world();
    let steps = (TIME / dt).round();
    world.advance(steps as u64);
    let down = tilt * DVec3::X;
    let time = steps * dt;
    let way = (world.position(0) - start).dot(down);
    (2.0 * way / (time * time), world.velocity(0).length(), dt)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let bench = Bench::as_run()?;
    let weight = bench.kind.weight * GRAVITY;
    for degrees in [5.0, 15.0, 21.0, 24.0, 30.0, 45.0, 60.0] {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        // The slope falls along x; a turn about z keeps the grid from lying along the way down.
        let tilt = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_y(f64::to_radians(degrees));
        let (low, high) = (DVec3::new(-0.03, -0.03, -0.03), DVec3::new(0.25, 0.03, 0.0));
        let mesh = shapes::placed(shapes::cuboid(low, high)?, tilt, DVec3::ZERO);
        let cell = shapes::usual_cell(&mesh, bench.kind.diameter());
        let band = bench.kind.radius + 2.5 * cell;
        let over = bench.touch() - bench.overlap_under(weight * cos);
        let start = tilt * DVec3::Z * over;
        let ways: [(&str, Shared); 2] = [
            ("grid", Arc::new(shapes::grid(&mesh, cell, band, false)?)),
            ("triangles", Arc::new(shapes::exact(&mesh)?)),
        ];
        for (way, surface) in ways {
            let (got, speed, dt) = slide(&bench, &surface, tilt, start);
            if sin > FRICTION * cos {
                report.check(
                    format!("incline of {degrees}°, {way}: acceleration (m/s²)"),
                    GRAVITY * (sin - FRICTION * cos),
                    got,
                    Tolerance::Relative(0.01),
                    "asked by the issue",
                );
            } else {
                report.check(
                    format!("incline of {degrees}°, {way}: speed of a grain that stays (m/s)"),
                    GRAVITY * sin * dt,
                    speed,
                    Tolerance::Relative(0.01),
                    "friction is kinetic: it stops the slip of the step before, so what one step of weight gives is left: g sin θ Δt",
                );
            }
        }
    }
    Ok(())
}
