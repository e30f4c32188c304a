//! Two free grains collide, each computing the contact for itself: momentum and angular momentum of the two.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, frame, moment, scattered, turns};
use glam::DVec3;
use tsubu_model::{ContactLaw, Dim, Kind, Numbers, SpinState, Vector};

/// Steps to half a period. What is checked holds at any step.
const STEPS: f64 = 500.0;

/// A free grain, and what it remembers of the contact.
struct Grain<D: Dim, S: SpinState, M> {
    kind: Kind,
    x: D::V,
    v: D::V,
    w: S::Turn<D>,
    memory: M,
}

impl<D: Dim, S: SpinState, M> Grain<D, S, M> {
    fn momentum(&self) -> D::V {
        self.v * self.kind.mass
    }

    /// About the origin.
    fn angular_momentum(&self) -> DVec3 {
        moment::<D>(self.x, self.momentum()) + S::to_space::<D>(self.w) * self.kind.inertia
    }
}

/// Momentum is kept to rounding. Angular momentum about a point outside is kept up to what the lever arms leave: they are the
/// radii, their ends are δ = r_a + r_b − r apart along n, and the two tangential forces have the moment δ n × f. So it changes
/// by at most ∫δ|f_t|dt; symplectic Euler adds nothing, because x × m dv and Δt v × m v are exact in it.
///
/// Rounding: 1e-11 of the sizes of what is summed, for 1e4 steps of 1e-16 each and a margin of ten.
pub(super) fn kept<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Momentum);
    if !turns::<D, S>() || case.is_wall() || !case.b.mass.is_finite() {
        return None;
    }
    for number in 0..6 {
        for degrees in [0.0, 25.0, 50.0, 70.0, 85.0] {
            collide(case, number, degrees, &mut worst);
        }
    }
    worst.breach()
}

fn collide<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    number: u64,
    degrees: f64,
    worst: &mut Worst,
) {
    let (n, t) = frame::<D::V>(number);
    let (sin, cos) = f64::to_radians(degrees).sin_cos();
    let speed = 1e-2 * case.range * case.rate;
    let dt = std::f64::consts::PI / (case.rate * STEPS);
    // Both drift past the origin, three ranges away.
    let centre = scattered::<D::V>(number + 20) * (3.0 * case.range);
    let drift = scattered::<D::V>(number + 40) * speed;
    let spun = |k: u64, kind: &Kind| {
        scattered::<S::Turn<D>>(number + k) * (speed * (number % 3) as f64 / kind.radius)
    };
    let grain = |kind: &Kind, x: D::V, v: D::V, k: u64| Grain::<D, S, L::Memory> {
        kind: *kind,
        x: centre + x,
        v: drift + v,
        w: spun(k, kind),
        memory: L::Memory::zero(),
    };
    let flight = n * (-speed * cos) + t * (speed * sin);
    let apart = n * (case.range * (1.0 + 1e-9));
    let mut one = grain(case.a, apart * 0.5, flight * 0.5, 60);
    let mut other = grain(case.b, apart * -0.5, flight * -0.5, 80);
    let back = case.law.pair(case.b, case.a);

    let before = (
        one.momentum() + other.momentum(),
        one.angular_momentum() + other.angular_momentum(),
    );
    let (mut allowed, mut touched) = (0.0, false);
    for _ in 0..4 * STEPS as usize {
        let spin = one.w * one.kind.radius + other.w * other.kind.radius;
        let state = State::<D, S> {
            apart: one.x - other.x,
            velocity: one.v - other.v,
            spin,
            roll: one.w - other.w,
        };
        let inside = state.apart.length() < case.range;
        if touched && !inside {
            break;
        }
        touched |= inside;
        let there = case.at(state.other_side());
        let on_one = L::force(&case.pair, &case.at(state), &mut one.memory, dt);
        let on_other = L::force(&back, &there, &mut other.memory, dt);
        let force = on_one.total();
        let across = force - state.normal() * force.dot(state.normal());
        let overlap = there.reach - state.apart.length();
        allowed += overlap.abs() * across.length() * dt;
        for (grain, push) in [(&mut one, on_one), (&mut other, on_other)] {
            grain.v += push.total() * (dt / grain.kind.mass);
            let torque = push.twist * grain.kind.radius + push.couple;
            grain.w += torque * (dt / grain.kind.inertia);
            grain.x += grain.v * dt;
        }
    }
    let words = || format!("{degrees}° off the normal at {speed:e} m/s, collision number {number}");
    worst.demand(touched, || format!("the grains do not meet, {}", words()));
    let mass = one.kind.mass + other.kind.mass;
    let scale = mass * (speed + drift.length());
    let lost = (one.momentum() + other.momentum() - before.0).length();
    worst.see(lost, 1e-11 * scale, || {
        format!("momentum changes by {lost:e} kg m/s, {}", words())
    });
    let lost = (one.angular_momentum() + other.angular_momentum() - before.1).length();
    let rounding = 1e-11 * scale * (centre.length() + case.range);
    worst.see(lost, allowed * (1.0 + 1e-9) + rounding, || {
        format!(
            "angular momentum changes by {lost:e} kg m²/s, at most ∫δ|f_t|dt = {allowed:e} expected, {}",
            words()
        )
    });
}
