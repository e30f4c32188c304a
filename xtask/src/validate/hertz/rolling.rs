//! A sphere that slides ends up rolling; on an incline it rolls or slides; where something resists its rolling it stops, or stays.
//!
//! With a couple M = μr r N against the rolling of a solid sphere without slip, m r a + I a/r = M and I = 2/5 m r² give
//! a = 5/7 μr N/m: on the level v²/(2a) to a stop, on an incline 5/7 g (sin θ − μr cos θ), and rest up to tan θ = μr.

use super::lab::{Ball, Bench, GRAVITY, Lab, seen};
use super::theory::{Hertz, Material, material};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_contact::{HertzMindlin, Resistance, Resisted, Rolling};
use tsubu_integrate::Scheme;
use tsubu_model::Space;

const BALL: Material = material(0.01, 0.3, 2500.0);
const RADIUS: f64 = 1e-3;
const DT: f64 = 2e-6;

fn law(friction: f64) -> HertzMindlin {
    HertzMindlin::between(&BALL.elastic, &BALL.elastic, 0.5, friction)
}

/// A sphere that rests on the floor in gravity that leans by `lean` rad towards +x, moving at `speed` and rolling with `rolls` of it.
fn on_floor<R: Rolling>(law: HertzMindlin<R>, lean: f64, speed: f64, rolls: f64) -> Lab<Space, R> {
    let kind = BALL.sphere(RADIUS);
    let hertz = Hertz::of((&kind, &BALL.elastic), (None, &BALL.elastic));
    let pressed = (kind.weight * GRAVITY * lean.cos() / hertz.stiffness).powf(2.0 / 3.0);
    let bench = Bench {
        law,
        floor: Some(law),
        gravity: DVec3::new(lean.sin(), 0.0, -lean.cos()) * GRAVITY,
        scheme: Scheme::SymplecticEuler,
        dt: DT,
    };
    bench.world(&[Ball {
        velocity: DVec3::X * speed,
        spin: DVec3::Y * rolls * speed / RADIUS,
        ..Ball::at(kind, DVec3::Z * (RADIUS - pressed))
    }])
}

fn only<R: Rolling>(run: &Lab<Space, R>) -> Ball {
    seen(run)[0]
}

/// Runs for so many seconds.
fn after<R: Rolling>(run: &mut Lab<Space, R>, seconds: f64) -> Ball {
    run.advance((seconds / DT).round() as u64);
    only(run)
}

fn slides_then_rolls(report: &mut Report) {
    let (start, friction) = (0.1, 0.3);
    let mut run = on_floor(law(friction), 0.0, start, 0.0);
    let slides = 2.0 * start / (7.0 * friction * GRAVITY);
    let then = after(&mut run, 2.0 * slides);
    // The way while it slides, 12 v₀²/(49 μ g), and then as long again at 5/7 of the speed.
    let way = 12.0 * start * start / (49.0 * friction * GRAVITY) + 5.0 / 7.0 * start * slides;
    for (what, expected, got) in [
        (
            "speed once it rolls over v₀",
            5.0 / 7.0,
            then.velocity.x / start,
        ),
        (
            "rω/v once it rolls",
            1.0,
            RADIUS * then.spin.y / then.velocity.x,
        ),
        ("way in twice the time of sliding, m", way, then.place.x),
    ] {
        report.check(
            format!("a sphere that slides at v₀: {what}"),
            expected,
            got,
            Tolerance::Relative(1e-3),
            "closed form",
        );
    }
}

/// Accelerations along the floor and of the spin over the second half of `seconds` from rest.
fn accelerations<R: Rolling>(law: HertzMindlin<R>, lean: f64, seconds: f64) -> [f64; 2] {
    let mut run = on_floor(law, lean, 0.0, 0.0);
    let half = 0.5 * seconds;
    let (from, to) = (after(&mut run, half), after(&mut run, half));
    [
        (to.velocity.x - from.velocity.x) / half,
        (to.spin.y - from.spin.y) / half,
    ]
}

fn inclined(report: &mut Report) {
    let friction = 0.3;
    for degrees in [10.0f64, 40.0, 60.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let rolls = sin / cos <= 3.5 * friction;
        let expected = if rolls {
            let a = 5.0 / 7.0 * GRAVITY * sin;
            [a, a / RADIUS]
        } else {
            [
                GRAVITY * (sin - friction * cos),
                2.5 * friction * GRAVITY * cos / RADIUS,
            ]
        };
        let got = accelerations(law(friction), degrees.to_radians(), 0.05);
        for (k, what) in ["acceleration, m/s²", "angular acceleration, rad/s²"]
            .into_iter()
            .enumerate()
        {
            report.check(
                format!(
                    "incline of {degrees} deg, μ = {friction}, {}: {what}",
                    if rolls { "rolls" } else { "slides" }
                ),
                expected[k],
                got[k],
                Tolerance::Relative(1e-3),
                "closed form; rolls up to tan θ = 7μ/2",
            );
        }
    }
}

fn resisted(report: &mut Report) {
    let (rolling, start) = (0.1, 0.1);
    for (by, words) in [
        (Resistance::ElasticPlastic, "type C"),
        (Resistance::Constant, "type A"),
    ] {
        let law = law(0.5).resisting(Resisted {
            friction: rolling,
            damping: 0.3,
            by,
        });
        let slowing = 5.0 / 7.0 * rolling * GRAVITY;
        let mut run = on_floor(law, 0.0, start, 1.0);
        let there = after(&mut run, 1.5 * start / slowing);
        report.check(
            format!("{words}, μr = {rolling}, level: way to a stop, m"),
            0.5 * start * start / slowing,
            there.place.x,
            Tolerance::Relative(1e-3),
            "v²/(2a), a = 5/7 μr g; winding up and back over δ/(2.25 μr), some overlaps, is 4e-4 of it",
        );
        report.check(
            format!("{words}, level: speed left over v₀"),
            0.0,
            there.velocity.x.abs() / start,
            Tolerance::Absolute(1e-6),
            "it lies",
        );
        for above in [1.1, 2.0] {
            let lean = (above * rolling).atan();
            let expected = 5.0 / 7.0 * GRAVITY * (lean.sin() - rolling * lean.cos());
            report.check(
                format!("{words}, incline of {above} μr: acceleration, m/s²"),
                expected,
                accelerations(law, lean, 0.2)[0],
                Tolerance::Relative(1e-3),
                "5/7 g (sin θ − μr cos θ)",
            );
        }
        let lean = (0.95 * rolling).atan();
        let mut run = on_floor(law, lean, 0.0, 0.0);
        let (from, to) = (after(&mut run, 0.5), after(&mut run, 0.5));
        let way = (to.place.x - from.place.x) / (2.0 * RADIUS);
        let name = format!("{words}, incline of 0.95 μr: way in the second half of 1 s over d");
        if by == Resistance::ElasticPlastic {
            report.check(
                name,
                0.0,
                way,
                Tolerance::Absolute(1e-6),
                "it stays where its spring can hold it, tan θ below μr",
            );
        } else {
            report.beside(
                name,
                10.0 / 7.0 * GRAVITY * lean.sin() * DT * 0.5 / (2.0 * RADIUS),
                way,
                "type A cannot hold: it creeps at what stops within two steps, 10/7 g sin θ Δt",
            );
        }
    }
}

/// The checks.
pub fn run(report: &mut Report) {
    slides_then_rolls(report);
    inclined(report);
    resisted(report);
}
