//! Walls that move: a rebound does not know which of the two moved, and a turning shaft drags.

use super::bench::{Bench, FRICTION, GRAVITY, RESTITUTION, Throw, USUAL_STEPS};
use super::shapes::{self, Shared};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use std::sync::Arc;
use tsubu_model::{Course, Motion, Shift, Space, Span, Turn, View};
use tsubu_sdf::{Cylinder, HalfSpace};

fn steady(velocity: DVec3) -> Motion {
    Motion {
        turn: None,
        shifts: vec![Shift {
            direction: velocity.normalize(),
            course: Course::Steady(velocity.length()),
            span: Span::ALWAYS,
        }],
    }
}

fn carried(report: &mut Report, bench: &Bench) -> Result<(), String> {
    let mesh = shapes::cuboid(DVec3::new(-0.04, -0.04, -0.03), DVec3::new(0.04, 0.04, 0.0))?;
    let cell = shapes::usual_cell(&mesh, bench.kind.diameter());
    let band = bench.kind.radius + 2.5 * cell;
    let ways: [(&str, Shared); 3] = [
        (
            "formula",
            Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z)),
        ),
        ("grid", Arc::new(shapes::grid(&mesh, cell, band, false)?)),
        ("triangles", Arc::new(shapes::exact(&mesh)?)),
    ];
    for (way, surface) in ways {
        let mut worst = 0.0f64;
        for degrees in [0.0, 30.0, 60.0, 80.0] {
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            let still = Throw::new(
                DVec3::new(3e-3, 2e-3, bench.touch()),
                DVec3::Z,
                DVec3::new(sin, 0.0, -cos),
            );
            let velocity = DVec3::new(0.4, -0.3, 0.8);
            let moved = Throw {
                motion: steady(velocity),
                carried: velocity,
                ..still.clone()
            };
            let apart = match (still.at(bench, &surface), moved.at(bench, &surface)) {
                (Some(a), Some(b)) => (a - b).length(),
                _ => f64::INFINITY,
            };
            worst = worst.max(apart);
        }
        report.check(
            format!("wall moving at 0.94 m/s, {way}: rebound in its frame less that at rest (m/s)"),
            0.0,
            worst,
            Tolerance::Absolute(1e-8),
            "rounding: 1e-16 of 0.01 m beside an overlap of 5e-5 m, and the nodes' 6e-8 of a value that changes nothing",
        );
    }
    Ok(())
}

fn dragged(report: &mut Report, bench: &Bench) -> Result<(), String> {
    let radius = 0.0275;
    let shaft =
        Cylinder::new(DVec3::X * -0.03, DVec3::X * 0.03, radius).map_err(|e| e.to_string())?;
    let mesh = shapes::mesh(shaft.mesh(1e-6));
    let cell = shapes::usual_cell(&mesh, bench.kind.diameter());
    let band = bench.kind.radius + 2.5 * cell;
    let ways: [(&str, Shared); 2] = [
        ("formula", Arc::new(shaft)),
        (
            "grid that asks its triangles",
            Arc::new(shapes::grid(&mesh, cell, band, true)?),
        ),
    ];
    let dt = bench.period() / USUAL_STEPS;
    for (way, surface) in ways {
        for rate in [40.0, -40.0] {
            let turn = Turn {
                point: DVec3::ZERO,
                axis: DVec3::X,
                rate,
                span: Span::ALWAYS,
            };
            let motion = Motion {
                turn: Some(turn),
                shifts: Vec::new(),
            };
            let over = bench.touch() - bench.overlap_under(bench.kind.weight * GRAVITY);
            let mut lab = bench
                .lab(&surface, motion, RESTITUTION, FRICTION, dt)
                .grain(DVec3::Z * (radius + over), DVec3::ZERO);
            lab.gravity = DVec3::Z * -GRAVITY;
            let mut world = lab.world();
            let steps = (5e-3 / dt).round();
            world.advance(steps as u64);
            // The top of a shaft that turns about x moves along −y. It slides all the time: 1.1 m/s against 0.02.
            report.check(
                format!("grain on a shaft turning at {rate} rad/s, {way}: dv/dt along its surface (m/s²)"),
                -FRICTION * GRAVITY * rate.signum(),
                world.velocity(0).y / (steps * dt),
                Tolerance::Relative(0.01),
                "μg; after 5 ms v²/R takes 0.1 % of the weight, the slope under it nothing yet",
            );
        }
    }
    Ok(())
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let bench = Bench::new()?;
    carried(report, &bench)?;
    dragged(report, &bench)
}
