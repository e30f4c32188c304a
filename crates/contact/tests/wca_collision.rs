//! Collisions of the repulsion against its exact quadrature: closest approach, duration, restitution.
//!
//! ```text
//! E = ½ m* v²,  u = ½ √(E/ε)
//! r_min = σ (½ + u)^(−1/6)
//! t_c   = (σ u / 3v) ∫₀^{π/2} (½ + u sin θ)^(−7/6) dθ   →  π √(m*/k) as v → 0
//! ```
//!
//! Both follow from energy alone, without a time step. There is no closed form for the restitution
//! with damping; its reference is the table of the project's theory note, section 4.4.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use tsubu_contact::{Repulsion, testing};
use tsubu_model::{ContactLaw, Kind, Space, Still, Touch};

const EPSILON: f64 = 9.434e-2;
const SIGMA: f64 = 1.203e-3;

/// Speed in m/s; r_min/r₀; t_c in s without damping; e with γ = 0.1257 kg/s. Theory note, section 4.4.
const TABLE: [(f64, f64, f64, f64); 3] = [
    (0.1, 0.999_963_96, 1.528_792e-6, 0.896_77),
    (1.0, 0.999_640_02, 1.526_586e-6, 0.896_86),
    (10.0, 0.996_440_39, 1.504_921e-6, 0.897_74),
];

fn coke(damping: f64) -> Repulsion {
    Repulsion::new(EPSILON, SIGMA, damping, damping, 1.350e-3)
}

fn grain() -> Kind {
    Kind::sphere(1.350e-3, 1370.0)
}

fn reduced_mass() -> f64 {
    0.5 * grain().mass
}

/// r_min and t_c by quadrature. The integrand is smooth: 200 intervals of Simpson's rule give it to 1e-12.
fn quadrature(speed: f64) -> (f64, f64) {
    let u = 0.5 * (0.5 * reduced_mass() * speed * speed / EPSILON).sqrt();
    let f = |theta: f64| (0.5 + u * theta.sin()).powf(-7.0 / 6.0);
    let n = 200;
    let h = FRAC_PI_2 / f64::from(n);
    let inner: f64 = (1..n)
        .map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * f(h * f64::from(i)))
        .sum();
    let integral = h / 3.0 * (f(0.0) + inner + f(FRAC_PI_2));
    (
        SIGMA * (0.5 + u).powf(-1.0 / 6.0),
        SIGMA * u / (3.0 * speed) * integral,
    )
}

/// Closest approach, time within the range and restitution of a head-on collision: Runge–Kutta of
/// fourth order, 2000 steps to a contact, the last one cut where the range is reached again.
fn collide(law: &Repulsion, speed: f64) -> (f64, f64, f64) {
    let pair = <Repulsion as ContactLaw<Space, Still>>::pair(law, &grain(), &grain());
    let range = <Repulsion as ContactLaw<Space, Still>>::range(&pair);
    let acceleration = |x: f64, v: f64| {
        // One hair inside the range: the stages of the last step must not feel the jump of the dashpot.
        let x = x.min(range * (1.0 - 1e-14));
        let (apart, velocity) = (DVec3::X * x, DVec3::X * v);
        let touch = Touch {
            apart,
            velocity,
            r2: x * x,
            reach: 1.350e-3,
            spin: Default::default(),
            roll: Default::default(),
        };
        let push = <Repulsion as ContactLaw<Space, Still>>::force(&pair, &touch, &mut [], 1e-9);
        push.total().x / reduced_mass()
    };
    let step = |x: f64, v: f64, h: f64| {
        let (v1, a1) = (v, acceleration(x, v));
        let (v2, a2) = (
            v + 0.5 * h * a1,
            acceleration(x + 0.5 * h * v1, v + 0.5 * h * a1),
        );
        let (v3, a3) = (
            v + 0.5 * h * a2,
            acceleration(x + 0.5 * h * v2, v + 0.5 * h * a2),
        );
        let (v4, a4) = (v + h * a3, acceleration(x + h * v3, v + h * a3));
        (
            x + h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4),
            v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
        )
    };
    let h = PI * (reduced_mass() / law.stiffness()).sqrt() / 2000.0;
    let (mut t, mut x, mut v, mut closest) = (0.0, range, -speed, range);
    loop {
        let (next_x, next_v) = step(x, v, h);
        if next_x >= range {
            let rest = (range - x) / (0.5 * (v + next_v));
            let (_, v) = step(x, v, rest);
            return (closest, t + rest, v / speed);
        }
        (t, x, v) = (t + h, next_x, next_v);
        closest = closest.min(x);
    }
}

/// The quadrature itself against the table, to the digits printed.
#[test]
fn the_quadrature_gives_the_printed_numbers() {
    let range = 2f64.powf(1.0 / 6.0) * SIGMA;
    for (speed, closest, duration, _) in TABLE {
        let (r_min, t_c) = quadrature(speed);
        assert!(
            (r_min / range - closest).abs() < 1e-8,
            "{speed} m/s: {}",
            r_min / range
        );
        assert!((t_c - duration).abs() < 1e-12, "{speed} m/s: {t_c:e}");
    }
    // The harmonic limit π√(m*/k).
    let limit = quadrature(1e-6).1;
    assert!((limit - 1.529_038e-6).abs() < 1e-12, "{limit:e}");
}

/// Tolerance 1e-4 of the overlap and of the duration. The closest of 2000 samples misses the
/// turning point by at most (π/4000)²/2 = 3e-7 of the overlap; the rest is Runge–Kutta's.
#[test]
fn undamped_collisions_follow_the_quadrature() {
    let range = 2f64.powf(1.0 / 6.0) * SIGMA;
    for (speed, ..) in TABLE {
        let (r_min, t_c) = quadrature(speed);
        let (closest, duration, restitution) = collide(&coke(0.0), speed);
        let (overlap, expected) = (1.0 - closest / range, 1.0 - r_min / range);
        assert!(
            (overlap / expected - 1.0).abs() < 1e-4,
            "{speed} m/s: overlap {overlap:e}, {expected:e}"
        );
        assert!(
            (duration / t_c - 1.0).abs() < 1e-4,
            "{speed} m/s: {duration:e} s, {t_c:e} s"
        );
        assert!(
            (restitution - 1.0).abs() < 1e-6,
            "{speed} m/s: e = {restitution}"
        );
    }
}

/// Restitution with the paper's damping against the table, to 1e-4, by this file's integrator and by
/// the conformance suite's own leapfrog.
#[test]
fn damped_collisions_rebound_as_in_the_table() {
    for (speed, _, _, expected) in TABLE {
        let (_, _, e) = collide(&coke(0.1257), speed);
        assert!(
            (e / expected - 1.0).abs() < 1e-4,
            "{speed} m/s: {e}, table {expected}"
        );
        let suite = testing::collide::<Space, _>(&coke(0.1257), &grain(), &grain(), speed);
        let e = suite.map_or(f64::NAN, |rebound| rebound.restitution);
        assert!(
            (e / expected - 1.0).abs() < 1e-4,
            "suite, {speed} m/s: {e}, table {expected}"
        );
    }
}
