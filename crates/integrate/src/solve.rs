//! The linear solve for the velocity that the averaged and the implicit dashpot need.
//!
//! Both ask for v with (M + hC) v = M u + h F_elastic, where h is the length of the kick, u the
//! velocity before it and C the damping of all contacts. The engine runs a fixed number S of Jacobi
//! sweeps in a fixed order, starting from v = u: every sweep computes the whole force F(x, v) at the
//! present guess and moves each grain by [`correction`]. All grains move at once, so the answer does
//! not depend on the number of threads, and C never has to be stored.
//!
//! Jacobi converges always here: C is a sum over contacts of (e_i − e_j)(e_i − e_j)ᵀ ⊗ P with P ≥ 0,
//! so twice the diagonal minus the matrix is a sum of (e_i + e_j)(e_i + e_j)ᵀ ⊗ P plus M: positive.

/// By how much one sweep moves the velocity of one grain, per axis:
/// (m u − m v + h F)/(m + h D), D the sum of the dampings of its contacts.
#[inline(always)]
pub fn correction(mass: f64, base: f64, now: f64, force: f64, damping: f64, h: f64) -> f64 {
    (mass * (base - now) + h * force) / (mass + h * damping)
}

/// Gain on stiffness and damping of the relative mode of a pair after `sweeps` sweeps, over the
/// exact solve: 1 − (−ρ)^S with ρ = θC/2/(1 + θC/2). Below 1 for an even S: stopping early never
/// tightens the limit then. `theta_c` = h η/m* for the pair's reduced mass.
///
/// ```
/// let gain = tsubu_integrate::relative_mode_gain(0.2, 4);
/// assert!(gain < 1.0 && gain > 0.9999);
/// ```
pub fn relative_mode_gain(theta_c: f64, sweeps: u32) -> f64 {
    let rho = 0.5 * theta_c / (1.0 + 0.5 * theta_c);
    1.0 - (-rho).powi(sweeps as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// A chain of grains with random dampings: the sweeps reach the solution of the linear system,
        /// checked by putting it back into (M + hC) v = M u + h F.
        #[test]
        fn sweeps_converge_to_the_solution(
            gammas in prop::collection::vec(0.0..5.0f64, 5),
            u in prop::collection::vec(-1.0..1.0f64, 6),
            f in prop::collection::vec(-1.0..1.0f64, 6),
        ) {
            let (m, h, n) = (1.0, 0.3, u.len());
            let damping_force = |v: &[f64], i: usize| -> f64 {
                let left = if i > 0 { -gammas[i - 1] * (v[i] - v[i - 1]) } else { 0.0 };
                let right = if i + 1 < n { -gammas[i] * (v[i] - v[i + 1]) } else { 0.0 };
                left + right
            };
            let diagonal = |i: usize| (if i > 0 { gammas[i - 1] } else { 0.0 }) + (if i + 1 < n { gammas[i] } else { 0.0 });
            let mut v = u.clone();
            for _ in 0..400 {
                let old = v.clone();
                for i in 0..n {
                    v[i] += correction(m, u[i], old[i], f[i] + damping_force(&old, i), diagonal(i), h);
                }
            }
            for i in 0..n {
                let residual = m * (u[i] - v[i]) + h * (f[i] + damping_force(&v, i));
                prop_assert!(residual.abs() < 1e-9, "residual {residual}");
            }
        }
    }
}
