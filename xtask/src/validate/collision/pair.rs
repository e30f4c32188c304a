//! Two grains head-on against the quadrature: closest approach, time in contact, restitution.

use crate::validate::check::Tolerance;
use crate::validate::lab::{Dry, Lab};
use crate::validate::report::Report;
use crate::validate::wca::{GAMMA, Wca, coke, grain};
use glam::DVec3;
use tsubu_contact::Repulsion;
use tsubu_integrate::Scheme;
use tsubu_model::{Kind, View};

/// Speed in m/s; r_min/r₀; t_c in s without damping; e with γ = 0.1257 kg/s: the printed table of the
/// theory note, digits beyond which it says nothing.
const TABLE: [(f64, f64, f64, f64); 3] = [
    (0.1, 0.999_963_96, 1.528_792e-6, 0.896_77),
    (1.0, 0.999_640_02, 1.526_586e-6, 0.896_86),
    (10.0, 0.996_440_39, 1.504_921e-6, 0.897_74),
];

/// What a head-on collision did.
#[derive(Clone, Copy, Debug)]
pub struct Rebound {
    /// Speed after over speed before.
    pub restitution: f64,
    /// Smallest distance of the centres in m, by a parabola through the three lowest samples.
    pub closest: f64,
    /// Time within the range in s; both ends interpolated in the free flight that borders them.
    pub duration: f64,
}

/// Two grains that meet at `speed` m/s; the first touch falls `phase` of a step before a sample. `None` if they do not part.
pub fn head_on(
    kind: Kind,
    law: &Repulsion,
    scheme: Scheme,
    dt: f64,
    speed: f64,
    phase: f64,
) -> Option<Rebound> {
    let range = Wca::of(law).range();
    let start = 0.5 * (range + speed * dt * (3.0 - phase));
    let (x, v) = (DVec3::X * start, DVec3::X * (-0.5 * speed));
    let mut world = Lab::new(kind, *law, scheme, dt)
        .grain(x, v)
        .grain(-x, -v)
        .world();
    // Identity 0 is the grain on the right, whatever the order in memory.
    let gap = |world: &Dry| -> (f64, f64) {
        let right = usize::from(world.identity(0) != 0);
        let apart = world.position(right) - world.position(1 - right);
        (
            apart.x,
            (world.velocity(right) - world.velocity(1 - right)).x,
        )
    };
    let (mut before, mut now) = (f64::INFINITY, gap(&world).0);
    let (mut closest, mut touch) = (now, None);
    for step in 0..4_000_000_u64 {
        world.advance(1);
        let (next, rate) = gap(&world);
        // Through each other, or too fast for the step.
        if next <= 0.0 || !world.health().is_fine() {
            return None;
        }
        let crossing = (range - now) / (next - now);
        if touch.is_none() && next < range {
            touch = Some(step as f64 + crossing);
        }
        if let (Some(touch), true) = (touch, next >= range) {
            let duration = (step as f64 + crossing - touch) * dt;
            return Some(Rebound {
                restitution: rate / speed,
                closest,
                duration,
            });
        }
        if now <= before && now <= next && before.is_finite() {
            let (down, up) = (before - now, next - now);
            let bend = down + up;
            let lowest = if bend > 0.0 {
                now - (down - up).powi(2) / (8.0 * bend)
            } else {
                now
            };
            closest = closest.min(lowest);
        }
        (before, now) = (now, next);
    }
    None
}

/// The checks.
pub fn run(report: &mut Report) {
    // The damping jumps at the touch, so e is off by at most half a step of it: C/2 = γΔt/2m* = 1.1e-5
    // at 20 000 steps per period. Positions are second order: (2π/20000)²/24 = 4e-9.
    let scheme = Scheme::VerletAveraged { sweeps: 4 };
    let steps_per_period = 20_000.0;
    let mass = 0.5 * grain().mass;
    let tolerance = Tolerance::Relative(1e-4);
    for (speed, table_closest, table_duration, table_e) in TABLE {
        let wca = Wca::of(&coke(0.0));
        let dt = wca.period(mass) / steps_per_period;
        let (r_min, t_c) = wca.undamped_collision(mass, speed);
        let range = wca.range();
        let free = head_on(grain(), &coke(0.0), scheme, dt, speed, 0.37);
        let (closest, duration, e) = free.map_or([f64::NAN; 3].into(), |f| {
            (f.closest, f.duration, f.restitution)
        });
        let at = format!("{speed} m/s");
        report.check(
            format!("deepest overlap, {at} (m), quadrature"),
            range - r_min,
            range - closest,
            tolerance,
            "1e-4 of the overlap, which is far stricter than 1e-4 of the distance",
        );
        report.check(
            format!("closest approach over r0, {at}, printed table"),
            table_closest,
            closest / range,
            Tolerance::Absolute(5e-9),
            "half a unit of the last printed digit",
        );
        report.check(
            format!("time in contact, {at} (s), quadrature"),
            t_c,
            duration,
            tolerance,
            "asked by the issue",
        );
        report.check(
            format!("time in contact, {at} (s), printed table"),
            table_duration,
            duration,
            Tolerance::Relative(1e-6),
            "a unit of the last printed digit",
        );
        report.check(
            format!("restitution without damping, {at}"),
            1.0,
            e,
            Tolerance::Absolute(1e-6),
            "the spring begins with a kink: an energy of order (2π/20000)² = 1e-7 is lost or won at it",
        );
        let damped = head_on(grain(), &coke(GAMMA), scheme, dt, speed, 0.37)
            .map_or(f64::NAN, |r| r.restitution);
        let exact = wca.restitution(mass, GAMMA, speed);
        report.check(
            format!("restitution, {at}, fine integration"),
            exact,
            damped,
            tolerance,
            "asked by the issue",
        );
        report.check(
            format!("restitution, {at}, printed table"),
            table_e,
            damped,
            tolerance,
            "asked by the issue; the table has five digits",
        );
    }
}
