//! No impact wins energy: 0° to 89°, smooth to rough, on a formula, a grid and triangles.

use super::bench::{Bench, EXACT, FRICTION, RESTITUTION, Throw, USUAL, USUAL_STEPS, impulse};
use super::shapes::{self, Shared};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::{DMat3, DVec3};
use std::sync::Arc;
use tsubu_model::Space;
use tsubu_picture::Figure;
use tsubu_sdf::HalfSpace;

/// Share of the energy that rounding may win.
const ROUNDING: f64 = 1e-12;

fn angles() -> Vec<f64> {
    (0..17)
        .map(|k| 5.0 * f64::from(k))
        .chain((85..90).map(f64::from))
        .collect()
}

/// Energy after over before for a throw at `degrees` against `normal`; 1 if it never touches.
fn kept(bench: &Bench, surface: &Shared, throw: &Throw) -> f64 {
    let after = throw.at(bench, surface).unwrap_or(DVec3::NAN);
    after.length_squared() / throw.velocity.length_squared()
}

fn velocity(degrees: f64, normal: DVec3) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    // A direction that lies along no axis of a grid.
    let along = normal.cross(DVec3::new(0.3, -0.8, 0.2)).normalize();
    along * sin - normal * cos
}

/// The largest energy after over before, less 1.
fn excess(bench: &Bench, surface: &Shared, contact: DVec3, normal: DVec3, gap: Option<f64>) -> f64 {
    let mut most = f64::NEG_INFINITY;
    let runs = [(USUAL, USUAL_STEPS), (EXACT, USUAL_STEPS), (EXACT, 200.0)];
    for (scheme, steps) in runs {
        let bench = &Bench { scheme, ..*bench };
        for restitution in [0.1, RESTITUTION, 0.9] {
            for friction in [0.0, 0.1, FRICTION, 0.7, 1.0] {
                for degrees in angles() {
                    let velocity = velocity(degrees, normal);
                    let usual = -2.63 * velocity.dot(normal) * bench.period() / steps;
                    let throw = Throw {
                        gap: gap.unwrap_or(usual),
                        may_miss: gap.is_some(),
                        restitution,
                        friction,
                        steps,
                        ..Throw::new(contact, normal, velocity)
                    };
                    let excess = kept(bench, surface, &throw) - 1.0;
                    // A grain that does not come back must not be lost in a maximum.
                    most = most.max(if excess.is_nan() {
                        f64::INFINITY
                    } else {
                        excess
                    });
                }
            }
        }
    }
    most
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let bench = Bench::new()?;
    // A plane that lies along no axis of the grid.
    let turn = DMat3::from_axis_angle(DVec3::new(2.0, -1.0, 2.0) / 3.0, 0.6);
    let low = DVec3::new(-0.04, -0.04, -0.04);
    let mesh = shapes::cuboid(low, DVec3::new(0.04, 0.04, 0.0))?;
    let mesh = shapes::placed(mesh, turn, DVec3::ZERO);
    let cell = shapes::usual_cell(&mesh, bench.kind.diameter());
    let band = bench.kind.radius + 2.5 * cell;
    let normal = turn * DVec3::Z;
    let grid: Shared = Arc::new(shapes::grid(&mesh, cell, band, false)?);
    let planes: [(&str, Shared); 3] = [
        (
            "formula",
            Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, normal)),
        ),
        ("grid", grid.clone()),
        ("triangles", Arc::new(shapes::exact(&mesh)?)),
    ];
    let note = "no impact may gain energy: three e, five μ, 22 angles, 20 steps per period in two schemes and 200";
    for (way, plane) in &planes {
        report.check(
            format!("grazing a plane, {way}: largest relative gain of energy"),
            ROUNDING,
            excess(&bench, plane, normal * bench.touch(), normal, None),
            Tolerance::AtMost,
            note,
        );
    }
    let ball = shapes::ball(0.05, &shapes::even(180), 360);
    let cell = shapes::usual_cell(&ball, bench.kind.diameter());
    let round: Shared = Arc::new(shapes::grid(&ball, cell, band, false)?);
    let mut most = f64::NEG_INFINITY;
    for direction in [DVec3::new(0.2, 0.1, 1.0), DVec3::new(-1.0, 0.7, 0.4)] {
        let normal = direction.normalize();
        let contact = normal * (0.05 + bench.touch());
        // The grid's ball may be met a little late: h²κ/8 = 2e-5 m.
        most = most.max(excess(&bench, &round, contact, normal, Some(5e-5)));
    }
    report.check(
        "grazing a ball, grid: largest relative gain of energy",
        ROUNDING,
        most,
        Tolerance::AtMost,
        "as for the plane; the grid's ball may be missed at 89°, which counts as a gain of 0",
    );
    against_theory(report, &bench, &grid, normal)
}

/// The energy kept against the rigid impact, drawn.
fn against_theory(
    report: &mut Report,
    bench: &Bench,
    grid: &Shared,
    normal: DVec3,
) -> Result<(), String> {
    let mut figure = Figure::new(
        "An impact on a wall, e = 0.5",
        "angle from the normal (deg)",
        "energy after over before (–)",
    );
    let mut worst = 0.0f64;
    for friction in [0.0, 0.1, FRICTION, 1.0] {
        let (mut got, mut theory) = (Vec::new(), Vec::new());
        for degrees in angles() {
            let velocity = velocity(degrees, normal);
            let throw = Throw {
                friction,
                gap: -2.63 * velocity.dot(normal) * bench.period() / 1000.0,
                ..Throw::new(normal * bench.touch(), normal, velocity)
            };
            got.push(kept(bench, grid, &throw));
            theory.push(impulse(velocity, normal, RESTITUTION, friction).length_squared());
            let e = bench.restitution_at(-velocity.dot(normal));
            let exact = impulse(velocity, normal, e, friction).length_squared();
            let off = (got[got.len() - 1] - exact).abs();
            worst = worst.max(if off.is_nan() { f64::INFINITY } else { off });
        }
        figure = figure
            .theory("rigid impact, e = 0.5", &angles(), &theory)
            .points(&format!("μ = {friction}"), &angles(), &got, None);
    }
    report.check(
        "impacts on a grid's plane, 0–89°, μ 0–1: energy kept, largest |got − rigid impact|",
        0.0,
        worst,
        Tolerance::Absolute(4e-3),
        "e by fine integration; v_n and μ(1 + e)v_n are each off by half a step of the damping, 1.7e-3, at 1000 steps per period",
    );
    report.figure("sdf_impact", figure)
}
