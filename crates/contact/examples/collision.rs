//! Two grains of coke collide: the crate used alone, without an engine or a scene.
//!
//! ```text
//! cargo run -p tsubu-contact --example collision
//! ```
//!
//! Prints closest approach, duration and restitution beside theory. For the repulsion, energy alone
//! gives the first two (without damping), and the linear spring of the same stiffness gives e.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use tsubu_contact::{Repulsion, restitution};
use tsubu_model::{ContactLaw, Kind, Space, Still, Touch};

/// What is measured of a collision.
struct Collision {
    closest: f64,
    duration: f64,
    restitution: f64,
}

fn main() {
    let grain = Kind::sphere(1.350e-3, 1370.0);
    let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
    let undamped = Repulsion::new(coke.epsilon, coke.sigma, 0.0, 0.0, coke.diameter);
    let reduced = 0.5 * grain.mass;
    let range = 2f64.powf(1.0 / 6.0) * coke.sigma;
    let zeta = coke.damping_ratio(reduced);

    println!(
        "Two coke grains, d = 1.350 mm, m = {:.4e} kg, k = {:.4e} N/m, zeta = {zeta:.4}",
        grain.mass,
        coke.stiffness()
    );
    println!(
        "{:>9} {:>26} {:>30} {:>22}",
        "", "closest approach, r/range", "duration, us", "restitution"
    );
    println!(
        "{:>9} {:>13} {:>12} {:>15} {:>14} {:>11} {:>10}",
        "v, m/s", "run", "theory", "run", "theory", "run", "linear"
    );
    for speed in [0.1, 1.0, 10.0] {
        let run = collide(&undamped, &grain, speed);
        let damped = collide(&coke, &grain, speed);
        let (closest, duration) = theory(&coke, reduced, speed);
        println!(
            "{speed:>9} {:>13.8} {:>12.8} {:>15.6} {:>14.6} {:>11.5} {:>10.5}",
            run.closest / range,
            closest / range,
            run.duration * 1e6,
            duration * 1e6,
            damped.restitution,
            restitution::at_zero_overlap(zeta),
        );
    }
    println!("Approach and duration are those without damping; restitution is that with it.");
}

/// One grain flies at another along x. A law needs only distance and velocity: the loop is ours.
fn collide(law: &Repulsion, grain: &Kind, speed: f64) -> Collision {
    let reduced = 0.5 * grain.mass;
    let pair = <Repulsion as ContactLaw<Space, Still>>::pair(law, grain, grain);
    let range = <Repulsion as ContactLaw<Space, Still>>::range(&pair);
    let dt = PI * (reduced / law.stiffness()).sqrt() / 20_000.0;
    let (mut apart, mut velocity) = (DVec3::X * range * (1.0 - 1e-12), DVec3::X * -speed);
    let (mut duration, mut closest) = (0.0, range);
    while apart.x < range {
        let touch = Touch {
            apart,
            velocity,
            r2: apart.length_squared(),
            reach: grain.diameter(),
            spin: Default::default(),
            roll: Default::default(),
        };
        let push = <Repulsion as ContactLaw<Space, Still>>::force(&pair, &touch, &mut [], dt);
        velocity += push.total() * (dt / reduced);
        apart += velocity * dt;
        duration += dt;
        closest = closest.min(apart.x);
    }
    Collision {
        closest,
        duration,
        restitution: velocity.x / speed,
    }
}

/// r_min = σ(½ + u)^(−1/6) and t_c = (σu/3v)∫(½ + u sin θ)^(−7/6)dθ over 0…π/2, u = ½√(½m*v²/ε).
fn theory(law: &Repulsion, reduced: f64, speed: f64) -> (f64, f64) {
    let u = 0.5 * (0.5 * reduced * speed * speed / law.epsilon).sqrt();
    // The midpoint rule converges fast enough on this smooth integrand.
    let n = 10_000;
    let h = FRAC_PI_2 / f64::from(n);
    let sum: f64 = (0..n)
        .map(|i| (0.5 + u * (h * (f64::from(i) + 0.5)).sin()).powf(-7.0 / 6.0))
        .sum();
    (
        law.sigma * (0.5 + u).powf(-1.0 / 6.0),
        law.sigma * u / (3.0 * speed) * h * sum,
    )
}
