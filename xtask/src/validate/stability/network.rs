//! A network of linearised contacts as matrices, and the longest step that each scheme bears on it.
//!
//! Written out from the definitions and solved by a dense library, so that neither the engine's power method nor the
//! closed forms of `integrate` are held against themselves.

use glam::{DMat3, DVec3};
use nalgebra::{DMatrix, DVector};
use tsubu_integrate::Scheme;
use tsubu_model::Kind;

/// One contact: stiffness and damping along and across its normal, which points to grain `i`.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    pub i: usize,
    /// The other grain; `None` is a wall.
    pub j: Option<usize>,
    pub normal: DVec3,
    /// k and η in N/m and kg/s.
    pub along: [f64; 2],
    pub across: [f64; 2],
    /// Distance of the two centres from the contact in m; 0 for grains that do not turn.
    pub arms: [f64; 2],
}

/// Which of x, y, z and the turns about them move.
pub type Free = [bool; 6];

/// Along one axis; in the plane of two; everything.
pub fn only(axes: &[usize]) -> Free {
    std::array::from_fn(|a| axes.contains(&a))
}

/// Stiffness, damping and 1/inertia of every coordinate that moves.
pub struct Network {
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
    inverse: DVector<f64>,
    /// Sum of the dampings of the contacts of a coordinate's grain, as the sweeps of a solve take it.
    diagonal: DVector<f64>,
}

impl Network {
    /// Of equal grains. A grain of infinite mass would be a wall here.
    pub fn new(grains: usize, kind: &Kind, links: &[Link], free: Free) -> Self {
        let size = 6 * grains;
        let mut all = [DMatrix::zeros(size, size), DMatrix::zeros(size, size)];
        let mut diagonal = DVector::zeros(size);
        for link in links {
            let (n, flat) = (link.normal, outer(link.normal));
            // Velocity of the contact: u_i − u_j + n × (r_i ω_i + r_j ω_j).
            let mut ends = vec![(link.i, 1.0, link.arms[0])];
            ends.extend(link.j.map(|j| (j, -1.0, link.arms[1])));
            for (matrix, which) in all.iter_mut().zip(0..) {
                let (along, across) = (link.along[which], link.across[which]);
                let push = flat * along + (DMat3::IDENTITY - flat) * across;
                for &(a, sign_a, arm_a) in &ends {
                    for &(b, sign_b, arm_b) in &ends {
                        let (of_a, of_b) = (blocks(n, sign_a, arm_a), blocks(n, sign_b, arm_b));
                        for (p, left) in of_a.iter().enumerate() {
                            for (q, right) in of_b.iter().enumerate() {
                                add(
                                    matrix,
                                    [6 * a + 3 * p, 6 * b + 3 * q],
                                    left.transpose() * push * *right,
                                );
                            }
                        }
                    }
                }
            }
            for &(a, _, _) in &ends {
                for axis in 0..3 {
                    diagonal[6 * a + axis] += link.along[1].max(link.across[1]);
                }
            }
        }
        let kept: Vec<usize> = (0..size).filter(|c| free[c % 6]).collect();
        let inverse = |c: &usize| 1.0 / if c % 6 < 3 { kind.mass } else { kind.inertia };
        let part = |m: &DMatrix<f64>| m.select_rows(&kept).select_columns(&kept);
        Self {
            stiffness: part(&all[0]),
            damping: part(&all[1]),
            inverse: DVector::from_iterator(kept.len(), kept.iter().map(inverse)),
            diagonal: diagonal.select_rows(&kept),
        }
    }

    /// Share of the limit that a step uses: stable below 1.
    ///
    /// Schemes with the old velocity: a fourth of the largest eigenvalue of W^½(Δt²K + 2ΔtC)W^½ with W = M^-1. A solve of S
    /// sweeps over h turns M^-1 into W = Σ_{s<S} J^s N^-1, N = M + hD, J = 1 − N^-1(M + hC): put v = u + W h F(u) into the
    /// sweeps. Explicit Euler, for damping in proportion to stiffness: the larger of K/C and C/(2 + K/2) over the modes.
    pub fn used(&self, scheme: Scheme, dt: f64) -> f64 {
        let old = &self.stiffness * (dt * dt) + &self.damping * (2.0 * dt);
        match scheme {
            Scheme::SymplecticEuler | Scheme::VerletOld => 0.25 * largest(self.scaled(&old)),
            Scheme::VerletAveraged { sweeps } => self.solved(&old, 0.5 * dt, sweeps),
            Scheme::DashpotImplicit { sweeps } => self.solved(&old, dt, sweeps),
            Scheme::ExplicitEuler => self.euler(dt),
        }
    }

    /// The step that uses the limit up; `None` if there is none below `most`.
    pub fn limit(&self, scheme: Scheme, most: f64) -> Option<f64> {
        // A false position in the logarithms: `used` is close to a power of the step.
        let excess = |dt: f64| self.used(scheme, dt).ln();
        let (mut low, mut high) = (1e-3 * most, most);
        let (mut at_low, mut at_high) = (excess(low), excess(high));
        if !(at_low < 0.0 && at_high > 0.0) {
            return None;
        }
        for _ in 0..60 {
            let share = at_low / (at_low - at_high);
            let middle = low * (high / low).powf(share.clamp(0.01, 0.99));
            let at_middle = excess(middle);
            if at_middle.abs() < 1e-7 || high / low < 1.0 + 1e-9 {
                return Some(middle);
            }
            if at_middle < 0.0 {
                (low, at_low, at_high) = (middle, at_middle, 0.5 * at_high);
            } else {
                (high, at_high, at_low) = (middle, at_middle, 0.5 * at_low);
            }
        }
        Some(low)
    }

    /// Largest eigenvalue of M^-½ K M^-½ in 1/s².
    pub fn stiffest(&self) -> f64 {
        largest(self.scaled(&self.stiffness))
    }

    /// M^-½ A M^-½.
    fn scaled(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let root = self.inverse.map(f64::sqrt);
        DMatrix::from_fn(root.len(), root.len(), |r, c| {
            root[r] * matrix[(r, c)] * root[c]
        })
    }

    fn solved(&self, old: &DMatrix<f64>, h: f64, sweeps: u32) -> f64 {
        let n = self.inverse.len();
        let one = DMatrix::<f64>::identity(n, n);
        let inertia = DMatrix::from_diagonal(&self.inverse.map(f64::recip));
        let guess = &inertia + DMatrix::from_diagonal(&self.diagonal) * h;
        let back = guess.map_with_location(|r, c, x| if r == c { 1.0 / x } else { 0.0 });
        let sweep = &one - &back * (&inertia + &self.damping * h);
        let (mut sum, mut term) = (DMatrix::zeros(n, n), back);
        for _ in 0..sweeps {
            sum += &term;
            term = &sweep * term;
        }
        let even = (&sum + sum.transpose()) * 0.5;
        even.cholesky().map_or(f64::NAN, |half| {
            0.25 * largest(half.l().transpose() * old * half.l())
        })
    }

    fn euler(&self, dt: f64) -> f64 {
        let (k, c) = (&self.stiffness, &self.damping);
        let ratio = c.norm() / k.norm();
        // The loads along a column make its contacts unequal by 1.7e-3 at most.
        let off = (c - k * ratio).norm() / c.norm();
        if off.is_nan() || off > 3e-3 {
            return f64::NAN;
        }
        let modes = self.scaled(k).symmetric_eigenvalues();
        let stiff = modes.iter().filter(|&&mode| mode > 1e-9 * modes.max());
        let of = |mode: &f64| {
            Scheme::ExplicitEuler
                .limit()
                .used(mode * dt * dt, mode * ratio * dt)
        };
        stiff.map(of).fold(0.0, f64::max)
    }
}

/// n nᵀ.
fn outer(n: DVec3) -> DMat3 {
    DMat3::from_cols(n * n.x, n * n.y, n * n.z)
}

/// What the velocity and the spin of an end add to the velocity of the contact.
fn blocks(n: DVec3, sign: f64, arm: f64) -> [DMat3; 2] {
    let cross = DMat3::from_cols(n.cross(DVec3::X), n.cross(DVec3::Y), n.cross(DVec3::Z));
    [DMat3::IDENTITY * sign, cross * arm]
}

fn add(matrix: &mut DMatrix<f64>, at: [usize; 2], block: DMat3) {
    for row in 0..3 {
        for column in 0..3 {
            matrix[(at[0] + row, at[1] + column)] += block.col(column)[row];
        }
    }
}

fn largest(symmetric: DMatrix<f64>) -> f64 {
    symmetric.symmetric_eigenvalues().max()
}
