//! Walls that move: a rebound does not know which of the two moved, and a turning shaft drags.

use super::bench::{Bench, FRICTION, GRAVITY, RESTITUTION, Throw, USUAL_STEPS};
use super::shapes::{self, Shared};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use std::sync::Arc;
use tsubu_model::{Course, Motion, Shift, Space, Span, Turn, View};
use tsubu_sdf::{Cylinder, HalfSpace, Mesh};

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

/// dv/dt in m/s² along y of a grain laid on top of a shaft that turns about x at `rate` rad/s.
fn dragged_by(bench: &Bench, surface: &Shared, radius: f64, rate: f64) -> f64 {
    let dt = bench.period() / USUAL_STEPS;
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
        .lab(surface, motion, RESTITUTION, FRICTION, dt)
        .grain(DVec3::Z * (radius + over), DVec3::ZERO);
    lab.gravity = DVec3::Z * -GRAVITY;
    let mut world = lab.world();
    let steps = (5e-3 / dt).round();
    world.advance(steps as u64);
    world.velocity(0).y / (steps * dt)
}

fn dragged(report: &mut Report, bench: &Bench) -> Result<(), String> {
    let radius = 0.0275;
    let (from, to) = (DVec3::X * -0.03, DVec3::X * 0.03);
    let shaft = Cylinder::new(from, to, radius).map_err(|e| e.to_string())?;
    // 3684 sides: at 10 rad/s a facet's tilt of 0.05° kicks the grain by 2.3e-4 m/s, (1 + e) times
    // that is 0.7 % of what weight gives in 5 ms.
    let mesh = Mesh::from(shaft.mesh(1e-8));
    let cell = shapes::usual_cell(&mesh, bench.kind.diameter());
    let band = bench.kind.radius + 2.5 * cell;
    let fine: [(&str, Shared); 2] = [
        ("formula", Arc::new(shaft)),
        ("triangles", Arc::new(shapes::exact(&mesh)?)),
    ];
    let grid: Shared = Arc::new(shapes::grid(&mesh, cell, band, false)?);
    for rate in [10.0f64, -10.0] {
        // The top of a shaft that turns about x moves along −y, at 0.28 m/s: the grain slides all the time.
        for (way, surface) in &fine {
            report.check(
                format!("grain on a shaft turning at {rate} rad/s, {way}: dv/dt along y (m/s²)"),
                -FRICTION * GRAVITY * rate.signum(),
                dragged_by(bench, surface, radius, rate),
                Tolerance::Relative(0.01),
                "μg; after 5 ms v²/R takes 0.15 % of the weight, facets give 0.7 %",
            );
        }
        report.check(
            format!("grain on a shaft turning at {rate} rad/s, grid of {:.1} mm: dv/dt with the surface (m/s²)", cell * 1e3),
            0.0,
            -rate.signum() * dragged_by(bench, &grid, radius, rate),
            Tolerance::AtLeast,
            "only the sign: the grid's shaft has bumps of h²κ/8 = 0.03 mm, which toss the grain for longer than 5 ms",
        );
    }
    Ok(())
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let bench = Bench::new()?;
    carried(report, &bench)?;
    dragged(report, &Bench::as_run()?)
}
