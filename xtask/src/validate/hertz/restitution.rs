//! Restitution asked for is restitution got: any speed, ratio of sizes and materials; test 3 of the benchmark.

use super::impact::Impact;
use super::largest;
use super::theory::{Hertz, Material, material};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_contact::{Elastic, HertzMindlin};
use tsubu_picture::Figure;

const BALL: Material = material(3.0, 0.3, 1400.0);
const OTHER: Material = material(70.0, 0.22, 2500.0);

/// Restitution of a head-on impact; `ratio` is the partner's size over the ball's, `None` a wall.
fn got(asked: f64, radius: f64, ratio: Option<f64>, speed: f64, steps: f64) -> f64 {
    let ball = BALL.sphere(radius);
    let partner = ratio.map(|ratio| OTHER.sphere(ratio * radius));
    let law = HertzMindlin::between(&BALL.elastic, &OTHER.elastic, asked, 0.4);
    let hertz = Hertz::of((&ball, &BALL.elastic), (partner.as_ref(), &OTHER.elastic));
    Impact::new(law, ball, DVec3::Z * -speed, hertz.duration(speed), steps)
        .on(partner)
        .run()
        .map_or(f64::NAN, |rebound| rebound.velocity.z / speed)
}

fn any_size_and_speed(report: &mut Report) -> Result<(), String> {
    let asked: Vec<f64> = (1..=10).map(|tenth| 0.1 * f64::from(tenth)).collect();
    let all = |ratio: Option<f64>, speed: f64, steps: f64| -> Vec<f64> {
        let of = |&e: &f64| got(e, 1e-3, ratio, speed, steps) - e;
        asked.iter().map(of).collect()
    };
    for (words, ratio) in [
        ("sizes 1:1", Some(1.0)),
        ("sizes 1:5", Some(5.0)),
        ("sizes 5:1", Some(0.2)),
        ("wall", None),
    ] {
        for speed in [1e-3, 0.1, 10.0] {
            report.check(
                format!("restitution 0.1 to 1, {words}, {speed} m/s: largest |got − asked|"),
                0.0,
                largest(all(ratio, speed, 10_000.0).into_iter()),
                Tolerance::Absolute(1e-3),
                "asked by the issue; the contact ends without force",
            );
        }
    }
    let mut figure = Figure::new(
        "Restitution of Hertz–Mindlin contacts",
        "restitution asked for (–)",
        "restitution got less that asked for (–)",
    )
    .theory("exact", &[0.1, 1.0], &[0.0, 0.0]);
    for steps in [20.0, 50.0, 200.0] {
        let by = all(None, 0.1, steps);
        figure = figure.points(&format!("{steps} steps to a contact"), &asked, &by, None);
        report.tell(
            format!("  the same, wall, {steps} steps to a contact"),
            largest(by.into_iter()),
            "what the step costs: damping from the velocity of half a step before",
        );
    }
    report.figure("hertz_restitution", figure)
}

/// Test 3: R = 2.5 mm at 3.9 m/s on a rigid wall.
fn test_3(report: &mut Report) {
    for (name, material) in [
        ("Al oxide", material(380.0, 0.23, 4000.0)),
        ("cast iron", material(100.0, 0.25, 7000.0)),
    ] {
        let ball = material.sphere(0.0025);
        let lasts = Hertz::of((&ball, &material.elastic), (None, &Elastic::RIGID)).duration(3.9);
        let by = [0.2, 0.4, 0.6, 0.8, 1.0].map(|e| {
            let law = HertzMindlin::between(&material.elastic, &Elastic::RIGID, e, 0.4);
            let rebound = Impact::new(law, ball, DVec3::Z * -3.9, lasts, 10_000.0).run();
            rebound.map_or(f64::NAN, |r| r.velocity.z / 3.9) - e
        });
        report.check(
            format!("test 3, {name}, e = 0.2 to 1: largest |got − asked|"),
            0.0,
            largest(by.into_iter()),
            Tolerance::Absolute(1e-3),
            "as asked for every restitution",
        );
    }
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    any_size_and_speed(report)?;
    test_3(report);
    Ok(())
}
