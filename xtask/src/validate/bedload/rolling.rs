//! A grain that slides ends up rolling, and one on an incline rolls or slides.

use super::lab::{floor, lab};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec2;
use tsubu_contact::SpringDashpot;
use tsubu_model::{Kind, View};

const D: f64 = 1e-3;
const MASS: f64 = 1e-6;
const GRAVITY: f64 = 9.80665;

fn law(friction: f64) -> SpringDashpot {
    SpringDashpot::from_restitution(100.0, 0.5, MASS, 0.3, friction)
}

/// Height at which a grain rests under this weight.
fn rest(weight: f64) -> DVec2 {
    DVec2::Y * (0.5 * D - weight / law(0.5).normal_stiffness)
}

/// Speed over the first one once it rolls, and that it does roll.
fn slid(report: &mut Report) {
    let start = 0.1;
    for dt in [4e-6, 1e-6] {
        let weight = DVec2::Y * -GRAVITY;
        let grain = (rest(MASS * GRAVITY), DVec2::X * start);
        let kind = Kind::with_mass(D, MASS);
        let mut run = lab(kind, law(0.5), vec![floor(law(0.5))], weight, dt, &[grain]);
        // Twice the time that sliding takes, 2v₀/(7μg).
        let slides = 2.0 * start / (7.0 * 0.5 * GRAVITY);
        run.advance((2.0 * slides / dt) as u64);
        report.check(
            format!("a grain that slides at v₀, Δt = {dt:.0e} s: speed once it rolls over v₀"),
            5.0 / 7.0,
            run.velocity(0).x / start,
            Tolerance::Relative(1e-3),
            "closed form, whatever friction and step",
        );
        report.check(
            format!("a grain that slides at v₀, Δt = {dt:.0e} s: −rω/v once it rolls"),
            1.0,
            -0.5 * D * run.spin(0) / run.velocity(0).x,
            Tolerance::Relative(1e-3),
            "rolling; to the right it turns clockwise, with z up",
        );
    }
}

/// Accelerations down an incline, below and above the angle to which a grain rolls.
fn inclined(report: &mut Report) {
    let friction = 0.3;
    for degrees in [10.0f64, 30.0, 60.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (dt, time) = (1e-6, 0.02);
        let gravity = DVec2::new(sin, -cos) * GRAVITY;
        let grain = (rest(MASS * GRAVITY * cos), DVec2::ZERO);
        let kind = Kind::with_mass(D, MASS);
        let bodies = vec![floor(law(friction))];
        let mut run = lab(kind, law(friction), bodies, gravity, dt, &[grain]);
        run.advance((0.5 * time / dt) as u64);
        let (v, w) = (run.velocity(0).x, run.spin(0));
        run.advance((0.5 * time / dt) as u64);
        let change = 0.5 * time;
        let (a, alpha) = ((run.velocity(0).x - v) / change, (w - run.spin(0)) / change);
        let rolls = degrees.to_radians().tan() <= 3.5 * friction;
        let (expected, turning) = if rolls {
            let a = 5.0 / 7.0 * GRAVITY * sin;
            (a, a / (0.5 * D))
        } else {
            (
                GRAVITY * (sin - friction * cos),
                5.0 * friction * GRAVITY * cos / D,
            )
        };
        for (what, expected, got) in [
            ("acceleration, m/s2", expected, a),
            ("angular acceleration, rad/s2", turning, alpha),
        ] {
            report.check(
                format!(
                    "incline of {degrees} deg, μ = {friction}, {}: {what}",
                    if rolls { "rolling" } else { "sliding" }
                ),
                expected,
                got,
                Tolerance::Relative(1e-3),
                "closed form; rolls up to tan θ = 7μ/2",
            );
        }
    }
}

/// Both.
pub fn run(report: &mut Report) {
    slid(report);
    inclined(report);
}
