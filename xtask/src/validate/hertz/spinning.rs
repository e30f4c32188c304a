//! Spheres that turn when they meet: tests 6, 7 and 8 of the benchmark.
//!
//! Below gross sliding the rebound depends on the tangential damping, which the benchmark does not state: there is no closed form and
//! the curves are those of one choice. Ours is held against a plain integration with ours, and the curve stands beside it.

use super::curves::{curve, off, reading};
use super::impact::Impact;
use super::largest;
use super::on_wall::{OnWall, slip};
use super::theory::{Hertz, Material, Spring, material};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_contact::{Elastic, HertzMindlin};
use tsubu_picture::Figure;

const RADIUS: f64 = 0.1;
/// Speed into the contact in m/s.
const INTO: f64 = 0.2;
const RESTITUTION: f64 = 0.5;
const FRICTION: f64 = 0.4;
/// (7/2) μ (1 + e): the slip over v_n from which on the sphere slides throughout.
const SLIDES: f64 = 3.5 * FRICTION * (1.0 + RESTITUTION);

const ALLOY: Material = material(70.0, 0.33, 2700.0);
const NYLON: Material = material(2.5, 0.4, 1000.0);

/// What the sphere meets.
#[derive(Clone, Copy)]
enum Meets {
    Wall,
    /// A sphere of 0.5 m, a thousand times as dense and as stiff.
    Boulder,
}

/// Ratio of slips −v_s'/v_s and tangent of the recoil v_s'/v_n', against ψ = v_s/v_n of a sphere that only turns.
fn spun(material: Material, meets: Meets, psi: f64) -> [f64; 2] {
    // It turns so that its surface moves along +x.
    let spin = -psi * INTO / RADIUS;
    let case = on_wall(material);
    let got = match meets {
        Meets::Wall => case.impact(0.0, INTO, spin),
        Meets::Boulder => {
            let (ball, own) = (material.sphere(RADIUS), material.elastic);
            let hard = Material {
                elastic: Elastic {
                    young: 1e3 * own.young,
                    poisson: own.poisson,
                },
                density: 1e3 * material.density,
            };
            let boulder = hard.sphere(0.5);
            let law = HertzMindlin::between(&own, &hard.elastic, RESTITUTION, FRICTION);
            let hertz = Hertz::of((&ball, &own), (Some(&boulder), &hard.elastic));
            Impact::new(law, ball, DVec3::Z * -INTO, hertz.duration(INTO), 10_000.0)
                .on(Some(boulder))
                .spinning(DVec3::Y * spin, DVec3::ZERO)
                .run()
        }
    };
    got.map_or([f64::NAN; 2], |r| {
        let after = slip(&r);
        [-after / (psi * INTO), after / r.velocity.z]
    })
}

fn on_wall(material: Material) -> OnWall {
    OnWall {
        material,
        radius: RADIUS,
        restitution: RESTITUTION,
        friction: FRICTION,
    }
}

fn tests_6_and_8(report: &mut Report) -> Result<(), String> {
    let cases = [
        (6, "Al alloy", ALLOY, Meets::Wall),
        (6, "nylon", NYLON, Meets::Wall),
        (8, "two spheres", ALLOY, Meets::Boulder),
    ];
    let panels = [
        ("beta", "−slip after over before"),
        ("tan_recoil", "tangent of recoil"),
    ];
    for (k, (quantity, what)) in panels.into_iter().enumerate() {
        // The first panel is drawn over (7/2) μ (1 + e) v_n/v_s, the second over v_s/v_n.
        let psi_of = |x: f64| if k == 0 { SLIDES / x } else { x };
        let mut figure = Figure::new(
            "A spinning sphere, tests 6 and 8 of Chung and Ooi",
            [
                "3.5 μ (1 + e) v_n over slip before (–)",
                "slip before over v_n (–)",
            ][k],
            &format!("{what} (–)"),
        );
        if k == 0 {
            figure = figure.log_x();
        }
        let line: Vec<f64> = (0..=20)
            .map(|n| f64::from(n) / 20.0)
            .map(|s| [0.17 + 0.83 * s, SLIDES + (7.1 - SLIDES) * s][k])
            .collect();
        let closed = |&x: &f64| [-1.0 + x, (x - SLIDES) / RESTITUTION][k];
        let theory: Vec<f64> = line.iter().map(closed).collect();
        figure = figure.theory("gross sliding", &line, &theory);
        for (test, name, material, meets) in cases {
            let tag = format!("test {test}, {name}: {what}");
            let got = |x: f64| spun(material, meets, psi_of(x))[k];
            let slides = |x: f64| psi_of(x) >= SLIDES;
            let by = [2.1, 2.5, 3.0, 5.0, 12.0].map(|psi| {
                let closed = [-1.0 + SLIDES / psi, (psi - SLIDES) / RESTITUTION][k];
                (spun(material, meets, psi)[k] - closed) / [1.0, psi / RESTITUTION][k]
            });
            report.check(
                format!("{tag}, sliding: largest deviation of its scale"),
                0.0,
                largest(by.into_iter()),
                Tolerance::Absolute(5e-3),
                "closed form, 1 % asked by the issue; e is met to 1e-3 and enters with 3.5 μ/(1 + e) and 1/e",
            );
            if matches!(meets, Meets::Wall) {
                let rule = on_wall(material).integrated(Spring::Shrinks, 1.0);
                let by = [0.1, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.0].map(|psi| {
                    let after = rule.impact(psi);
                    let expected = [-after.slip / psi, after.slip / after.normal][k];
                    spun(material, meets, psi)[k] - expected
                });
                report.check(
                    format!("{tag}, below: off a plain integration"),
                    0.0,
                    largest(by.into_iter()),
                    Tolerance::Absolute(5e-3),
                    "the same formula in reduced coordinates, as above",
                );
            }
            let read = curve(test, quantity, name);
            let error = reading(test, quantity);
            report.cross_code(
                format!("{tag}, largest |ours − curve|, sliding"),
                0.0,
                off(&read, slides, got),
                Tolerance::Absolute(error),
                "2 % of the axis",
            );
            report.beside(
                "  below sliding, beside the error of reading",
                error,
                off(&read, |x| !slides(x), got),
                "the tangential damping behind the curve is not stated",
            );
            let x: Vec<f64> = (1..=60)
                .map(|n| f64::from(n) / 60.0)
                .map(|s| [0.17 * (24.0f64 / 0.17).powf(s), 7.1 * s][k])
                .collect();
            let y: Vec<f64> = x.iter().map(|&x| got(x)).collect();
            figure = figure.line(&format!("tsubu, {name}"), &x, &y).measured(
                &format!("their code, {name}"),
                &read.0,
                &read.1,
            );
        }
        report.figure(["hertz_spin_ratio", "hertz_spin_recoil"][k], figure)?;
    }
    Ok(())
}

/// Two equal spheres that turn against each other do not slip where they touch: they part as smooth ones would.
fn test_7(report: &mut Report) {
    for (name, material) in [("Al alloy", ALLOY), ("nylon", NYLON)] {
        let ball = material.sphere(RADIUS);
        let law =
            HertzMindlin::between(&material.elastic, &material.elastic, RESTITUTION, FRICTION);
        let hertz = Hertz::of((&ball, &material.elastic), (Some(&ball), &material.elastic));
        let (mut along, mut change) = (0.0f64, 0.0f64);
        for spin in [0.175, 3.0, 24.0] {
            let lasts = hertz.duration(2.0 * INTO);
            let got = Impact::new(law, ball, DVec3::Z * -2.0 * INTO, lasts, 10_000.0)
                .on(Some(ball))
                .spinning(DVec3::Y * spin, DVec3::Y * -spin)
                .run();
            let (v, w) = got.map_or((f64::NAN, f64::NAN), |r| {
                let change = (r.after[0].spin.y - spin).abs() + (r.after[1].spin.y + spin).abs();
                (r.velocity.x.abs() / INTO, change / spin)
            });
            along = if v.is_nan() { v } else { along.max(v) };
            change = if w.is_nan() { w } else { change.max(w) };
        }
        for (what, got) in [
            ("speed along the contact over that into it", along),
            ("change of spin", change),
        ] {
            report.check(
                format!("test 7, {name}: {what}"),
                0.0,
                got,
                Tolerance::Absolute(1e-9),
                "nothing slips, so nothing but rounding",
            );
        }
    }
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    tests_6_and_8(report)?;
    test_7(report);
    Ok(())
}
