//! No impact gains energy, however it grazes, spins or damps.

use super::impact::Impact;
use super::theory::{Hertz, Material, material};
use crate::validate::check::Tolerance;
use crate::validate::lab::name;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_contact::HertzMindlin;
use tsubu_integrate::Scheme;

/// Soft, so that the overlap is some percent of the radius and the contact turns while it lasts.
const BALL: Material = material(0.01, 0.3, 500.0);
const OTHER: Material = material(0.05, 0.45, 2500.0);

/// Angles of incidence in degrees from the normal.
const ANGLES: [f64; 12] = [
    0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0, 88.0, 89.0, 89.5,
];

/// Speed in m/s.
const SPEED: f64 = 1.0;

/// Energy after over before.
fn kept(
    law: HertzMindlin,
    ratio: Option<f64>,
    degrees: f64,
    turns: f64,
    (scheme, steps, phase): (Scheme, f64, f64),
) -> f64 {
    let ball = BALL.sphere(1e-3);
    let partner = ratio.map(|ratio| OTHER.sphere(ratio * 1e-3));
    let hertz = Hertz::of((&ball, &BALL.elastic), (partner.as_ref(), &OTHER.elastic));
    let (sin, cos) = degrees.to_radians().sin_cos();
    // Backspin and topspin in the plane of the impact, with a part out of it.
    let spin = DVec3::new(0.3, 1.0, 0.2) * turns * SPEED / ball.radius;
    let other = ratio.map_or(DVec3::ZERO, |ratio| {
        DVec3::new(-0.5, 0.4, 0.1) * spin.y / ratio
    });
    let velocity = DVec3::new(sin, 0.0, -cos) * SPEED;
    let mut impact = Impact::new(law, ball, velocity, hertz.duration(SPEED * cos), steps)
        .on(partner)
        .spinning(spin, other);
    (impact.scheme, impact.phase) = (scheme, phase);
    impact.run().map_or(f64::NAN, |rebound| rebound.energy)
}

/// The most energy that is kept over all partners, angles, frictions, spins and phases of the first touch, at these restitutions.
fn most(restitutions: &[f64], scheme: Scheme, steps: f64) -> f64 {
    let mut most = 0.0f64;
    for &e in restitutions {
        for friction in [0.0, 0.1, 0.3, 0.6, 1.0] {
            let law = HertzMindlin::between(&BALL.elastic, &OTHER.elastic, e, friction);
            for ratio in [None, Some(1.0), Some(5.0), Some(0.2)] {
                for degrees in ANGLES {
                    for turns in [0.0, 1.0, -1.0] {
                        for phase in [0.05, 0.5, 0.95] {
                            let kept = kept(law, ratio, degrees, turns, (scheme, steps, phase));
                            if kept.is_nan() {
                                return kept;
                            }
                            most = most.max(kept);
                        }
                    }
                }
            }
        }
    }
    most
}

/// The checks.
pub fn run(report: &mut Report) {
    let averaged = Scheme::VerletAveraged { sweeps: 4 };
    for (scheme, steps) in [
        (Scheme::VerletOld, 500.0),
        (Scheme::VerletOld, 30.0),
        (Scheme::SymplecticEuler, 30.0),
        (averaged, 30.0),
    ] {
        let words = format!("{}, {steps} steps to a contact", name(scheme));
        report.check(
            format!("0 to 89.5 deg, μ 0 to 1, e 0.1 to 0.9, {words}: most energy kept"),
            1.0,
            most(&[0.1, 0.5, 0.9], scheme, steps),
            Tolerance::AtMost,
            "no impact may gain energy",
        );
        report.check(
            format!("  the same, e = 1, {words}"),
            1.0 + (std::f64::consts::PI / steps).powi(2) / 4.0,
            most(&[1.0], scheme, steps),
            Tolerance::AtMost,
            "K/4: what the phase of the first touch gives a linear spring that begins with a kink; Hertz begins smoother",
        );
    }
}
