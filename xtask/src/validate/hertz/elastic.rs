//! The elastic contact of any two materials against Hertz: overlap, force and duration; tests 1 and 2 of the benchmark.

use super::curves::{curve, off, reading};
use super::impact::{Impact, Rebound};
use super::theory::{Hertz, Material, material};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_contact::{Elastic, HertzMindlin};
use tsubu_picture::Figure;

/// From rubber to steel, one that grows thicker when it is pulled, and one that is barely more than incompressible.
const MATERIALS: [Material; 5] = [
    material(48.0, 0.2, 2800.0),
    material(210.0, 0.3, 7850.0),
    material(1.0, 0.4, 1400.0),
    material(0.01, 0.499, 1100.0),
    material(5.0, -0.4, 300.0),
];

/// Steps to a contact.
const STEPS: f64 = 20_000.0;

/// Deviations of overlap, force and duration from the closed form.
fn deviations(hertz: &Hertz, speed: f64, got: Option<&Rebound>) -> [f64; 3] {
    got.map_or([f64::NAN; 3], |got| {
        [
            got.deepest / hertz.deepest(speed) - 1.0,
            got.force / hertz.force(speed) - 1.0,
            got.duration / hertz.duration(speed) - 1.0,
        ]
    })
}

/// Every material against every other, as spheres of three ratios of size and as a wall.
fn any_two(report: &mut Report) {
    let radius = 5e-3;
    for (words, ratio) in [
        ("sphere on sphere, sizes 1:1", Some(1.0)),
        ("sphere on sphere, sizes 1:5", Some(5.0)),
        ("sphere on sphere, sizes 5:1", Some(0.2)),
        ("sphere on wall", None),
    ] {
        let mut worst = [0.0f64; 3];
        for a in &MATERIALS {
            for b in &MATERIALS {
                for speed in [0.01, 1.0, 5.0] {
                    let ball = a.sphere(radius);
                    let partner = ratio.map(|ratio| b.sphere(ratio * radius));
                    let hertz = Hertz::of((&ball, &a.elastic), (partner.as_ref(), &b.elastic));
                    let law = HertzMindlin::between(&a.elastic, &b.elastic, 1.0, 0.4);
                    let got =
                        Impact::new(law, ball, DVec3::Z * -speed, hertz.duration(speed), STEPS)
                            .on(partner)
                            .run();
                    for (worst, by) in worst
                        .iter_mut()
                        .zip(deviations(&hertz, speed, got.as_ref()))
                    {
                        // `max` would lose what is not a number.
                        *worst = if by.is_nan() { by } else { worst.max(by.abs()) };
                    }
                }
            }
        }
        for (what, worst) in ["overlap", "force", "duration"].into_iter().zip(worst) {
            report.check(
                format!("elastic, {words}: {what}, largest relative deviation"),
                0.0,
                worst,
                Tolerance::Absolute(1e-4),
                "Hertz in closed form, 1e-4 asked by the issue; 25 pairs of materials, 0.01 to 5 m/s",
            );
        }
    }
}

/// A case of test 1 or 2: two equal spheres, or a sphere on a rigid wall.
struct Case {
    test: u32,
    name: &'static str,
    material: Material,
    radius: f64,
    /// Speed of approach in m/s.
    speed: f64,
}

const CASES: [Case; 4] = [
    Case {
        test: 1,
        name: "glass",
        material: material(48.0, 0.2, 2800.0),
        radius: 0.01,
        speed: 20.0,
    },
    Case {
        test: 1,
        name: "limestone",
        material: material(20.0, 0.25, 2500.0),
        radius: 0.01,
        speed: 20.0,
    },
    Case {
        test: 2,
        name: "Al alloy",
        material: material(70.0, 0.3, 2699.0),
        radius: 0.1,
        speed: 0.2,
    },
    Case {
        test: 2,
        name: "Mg alloy",
        material: material(40.0, 0.35, 1800.0),
        radius: 0.1,
        speed: 0.2,
    },
];

/// Worked in the reference pages for the cases above: overlap in µm, force in kN, duration in µs.
const WORKED: [[f64; 3]; 4] = [
    [274.11, 10.697, 40.34],
    [368.30, 7.108, 54.20],
    [49.72, 11.370, 731.7],
    [52.12, 7.233, 767.1],
];

fn benchmark(report: &mut Report) -> Result<(), String> {
    let mut figure = Figure::new(
        "Elastic impact, tests 1 and 2 of Chung and Ooi",
        "overlap (µm)",
        "normal force (kN)",
    );
    for (case, worked) in CASES.iter().zip(WORKED) {
        let ball = case.material.sphere(case.radius);
        let (partner, other) = if case.test == 1 {
            (Some(ball), case.material.elastic)
        } else {
            (None, Elastic::RIGID)
        };
        let law = HertzMindlin::between(&case.material.elastic, &other, 1.0, 0.4);
        let hertz = Hertz::of((&ball, &case.material.elastic), (partner.as_ref(), &other));
        let lasts = hertz.duration(case.speed);
        let got = Impact::new(law, ball, DVec3::Z * -case.speed, lasts, STEPS)
            .on(partner)
            .run()
            .ok_or_else(|| format!("{}: the spheres do not part", case.name))?;
        let measured = [got.deepest * 1e6, got.force * 1e-3, got.duration * 1e6];
        let words = ["overlap, µm", "force, kN", "duration, µs"];
        for ((what, expected), got) in words.into_iter().zip(worked).zip(measured) {
            report.check(
                format!("test {}, {}: {what}", case.test, case.name),
                expected,
                got,
                Tolerance::Relative(2e-4),
                "Hertz in closed form, printed to four digits",
            );
        }
        let read = curve(case.test, "normal", case.name);
        let fine: Vec<(f64, f64)> = got.path.iter().map(|p| (p.0 * 1e6, p.1 * 1e-3)).collect();
        let at = |x: f64| {
            // There and back is the same line; a reading beyond the deepest overlap belongs to its end.
            fine.iter()
                .find(|p| p.0 >= x)
                .map_or(got.force * 1e-3, |p| p.1)
        };
        if !read.0.is_empty() {
            report.cross_code(
                format!(
                    "test {}, {}: largest |force − curve as read|, kN",
                    case.test, case.name
                ),
                0.0,
                off(&read, |_| true, at),
                Tolerance::Absolute(reading(case.test, "normal")),
                "2 % of the axis",
            );
        }
        let line: Vec<f64> = (0..=100)
            .map(|k| f64::from(k) / 100.0 * got.deepest)
            .collect();
        let force: Vec<f64> = line
            .iter()
            .map(|d| hertz.stiffness * d.powf(1.5) * 1e-3)
            .collect();
        let line: Vec<f64> = line.iter().map(|d| d * 1e6).collect();
        let thin = fine.iter().step_by(fine.len() / 24);
        let (x, y): (Vec<f64>, Vec<f64>) = thin.copied().unzip();
        figure = figure.theory("Hertz", &line, &force).points(
            &format!("tsubu, {}", case.name),
            &x,
            &y,
            None,
        );
        if !read.0.is_empty() {
            figure = figure.measured("theory as read from the paper", &read.0, &read.1);
        }
    }
    report.figure("hertz_force", figure)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    any_two(report);
    benchmark(report)
}
