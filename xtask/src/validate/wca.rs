//! The repulsion of paper A written out once more, from the paper and not from the code under test:
//! potential, force and stiffness, its collision by quadrature and by a fine integration.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use tsubu_contact::Repulsion;
use tsubu_model::Kind;

/// Paper A's coke: ε (J), σ (m), γ (kg/s), d (m), density (kg/m³).
pub const EPSILON: f64 = 9.434e-2;
/// σ in m.
pub const SIGMA: f64 = 1.203e-3;
/// γ in kg/s.
pub const GAMMA: f64 = 0.1257;
/// d in m.
pub const DIAMETER: f64 = 1.350e-3;

/// Paper A's grain.
pub fn grain() -> Kind {
    Kind::sphere(DIAMETER, 1370.0)
}

/// Paper A's law with another damping (kg/s).
pub fn coke(damping: f64) -> Repulsion {
    Repulsion::new(EPSILON, SIGMA, damping, damping, DIAMETER)
}

/// φ(r) = 4ε[(σ/r)^12 − (σ/r)^6] + ε below 2^(1/6) σ.
#[derive(Clone, Copy)]
pub struct Wca {
    /// ε in J.
    pub epsilon: f64,
    /// σ in m.
    pub sigma: f64,
}

impl Wca {
    /// The potential of a law.
    pub fn of(law: &Repulsion) -> Self {
        Self {
            epsilon: law.epsilon,
            sigma: law.sigma,
        }
    }

    /// Where it ends, in m.
    pub fn range(self) -> f64 {
        2f64.powf(1.0 / 6.0) * self.sigma
    }

    /// φ in J.
    pub fn potential(self, r: f64) -> f64 {
        if r >= self.range() {
            return 0.0;
        }
        let s6 = (self.sigma / r).powi(6);
        4.0 * self.epsilon * (s6 * s6 - s6) + self.epsilon
    }

    /// −φ' in N.
    pub fn push(self, r: f64) -> f64 {
        if r >= self.range() {
            return 0.0;
        }
        let s6 = (self.sigma / r).powi(6);
        24.0 * self.epsilon / r * (2.0 * s6 * s6 - s6)
    }

    /// φ'' in N/m, inside the range.
    pub fn stiffness(self, r: f64) -> f64 {
        let s6 = (self.sigma / r).powi(6);
        24.0 * self.epsilon / (r * r) * (26.0 * s6 * s6 - 7.0 * s6)
    }

    /// φ'' at the edge of the range.
    pub fn edge_stiffness(self) -> f64 {
        self.stiffness(self.range())
    }

    /// Undamped period 2π√(m*/k) in s.
    pub fn period(self, reduced_mass: f64) -> f64 {
        TAU * (reduced_mass / self.edge_stiffness()).sqrt()
    }

    /// The distance at which the force is `push`, by Newton's method.
    pub fn at_rest_under(self, push: f64) -> f64 {
        let mut r = self.range() - push / self.edge_stiffness();
        for _ in 0..60 {
            r += (self.push(r) - push) / self.stiffness(r);
        }
        r
    }

    /// Closest approach in m and time in contact in s of an undamped head-on collision:
    /// r_min = σ(½ + u)^(−1/6), t_c = (σu/3v)∫₀^{π/2}(½ + u sin θ)^(−7/6)dθ, u = ½√(E/ε), E = ½m*v².
    /// The integrand is smooth: 200 intervals of Simpson's rule give it to 1e-12.
    pub fn undamped_collision(self, reduced_mass: f64, speed: f64) -> (f64, f64) {
        let u = 0.5 * (0.5 * reduced_mass * speed * speed / self.epsilon).sqrt();
        let f = |theta: f64| (0.5 + u * theta.sin()).powf(-7.0 / 6.0);
        let n = 200;
        let h = FRAC_PI_2 / f64::from(n);
        let inner: f64 = (1..n)
            .map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * f(h * f64::from(i)))
            .sum();
        let integral = h / 3.0 * (f(0.0) + inner + f(FRAC_PI_2));
        (
            self.sigma * (0.5 + u).powf(-1.0 / 6.0),
            self.sigma * u / (3.0 * speed) * integral,
        )
    }

    /// Restitution of a damped head-on collision that ends where the range ends: Runge–Kutta of fourth
    /// order, 4000 steps to half a period, the last one cut at the edge. Good to 1e-9.
    pub fn restitution(self, reduced_mass: f64, damping: f64, speed: f64) -> f64 {
        self.integrated(reduced_mass, damping, speed, false)
    }

    /// The same for a contact that may not pull: it ends where the force vanishes.
    pub fn restitution_without_pull(self, mass: f64, damping: f64, speed: f64) -> f64 {
        self.integrated(mass, damping, speed, true)
    }

    fn integrated(self, reduced_mass: f64, damping: f64, speed: f64, clamped: bool) -> f64 {
        let range = self.range();
        // The branch inside the range, continued past it: the last step must not feel the jump.
        let rate = |x: f64, v: f64| {
            let s6 = (self.sigma / x).powi(6);
            (24.0 * self.epsilon / x * (2.0 * s6 * s6 - s6) - damping * v) / reduced_mass
        };
        let step = |x: f64, v: f64, h: f64| {
            let (v1, a1) = (v, rate(x, v));
            let (v2, a2) = (v + 0.5 * h * a1, rate(x + 0.5 * h * v1, v + 0.5 * h * a1));
            let (v3, a3) = (v + 0.5 * h * a2, rate(x + 0.5 * h * v2, v + 0.5 * h * a2));
            let (v4, a4) = (v + h * a3, rate(x + h * v3, v + h * a3));
            (
                x + h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4),
                v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
            )
        };
        let h = PI * (reduced_mass / self.edge_stiffness()).sqrt() / 4000.0;
        // What ends the contact when it is used up: the overlap, or the force.
        let left = |(x, v): (f64, f64)| if clamped { rate(x, v) } else { range - x };
        let mut state = (range, -speed);
        for _ in 0..400_000 {
            let next = step(state.0, state.1, h);
            if left(next) <= 0.0 {
                let (mut low, mut high) = (0.0, h);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if left(step(state.0, state.1, middle)) > 0.0 {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                return step(state.0, state.1, high).1 / speed;
            }
            state = next;
        }
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_and_stiffness_are_slopes_of_the_potential() {
        let wca = Wca {
            epsilon: EPSILON,
            sigma: SIGMA,
        };
        let (r, h) = (0.995 * wca.range(), 1e-9);
        let slope = (wca.potential(r + h) - wca.potential(r - h)) / (2.0 * h);
        assert!((wca.push(r) / -slope - 1.0).abs() < 1e-6);
        let slope = (wca.push(r + h) - wca.push(r - h)) / (2.0 * h);
        assert!((wca.stiffness(r) / -slope - 1.0).abs() < 1e-6);
        assert!((wca.push(wca.at_rest_under(3.0)) / 3.0 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_stiff_limit_is_the_linear_spring() {
        let wca = Wca {
            epsilon: EPSILON,
            sigma: SIGMA,
        };
        let mass = 0.5 * grain().mass;
        let zeta = 0.35;
        let damping = 2.0 * zeta * (wca.edge_stiffness() * mass).sqrt();
        let e = wca.restitution(mass, damping, 1e-3);
        assert!((e - tsubu_contact::restitution::at_zero_overlap(zeta)).abs() < 1e-4);
        let e = wca.restitution_without_pull(mass, damping, 1e-3);
        assert!((e - tsubu_contact::restitution::at_zero_force(zeta)).abs() < 1e-4);
    }
}
