//! Where a scheme is stable, as functions tested against the schemes as built.

use crate::{Scheme, relative_mode_gain};
use std::f64::consts::PI;

/// The stability limit of a scheme for m ẍ = −k x − η ẋ, with K = kΔt²/m and C = ηΔt/m
/// (m the reduced mass for a pair), and for many contacts at once.
///
/// | scheme | one contact | many contacts: largest eigenvalue below 4 of |
/// |---|---|---|
/// | symplectic Euler, Verlet with the old velocity | K + 2C < 4 | M^-½(Δt²K + 2ΔtC)M^-½ |
/// | Verlet with the averaged velocity | K < 4 | as above, less strict |
/// | dashpot implicit | K < 4 + 2C | as above, less strict still |
/// | explicit Euler | K < C and C < 2 + K/2 | – |
///
/// The solves run a fixed number of sweeps. Stopped early, a mode is damped as if stiffness and
/// damping were multiplied by a gain ([`relative_mode_gain`]); an even number of sweeps never makes
/// the limit stricter than the exact solve, an odd one does, and the limit counts it.
/// Source: `OSullivan2004` for packings; derivation in the book.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    scheme: Scheme,
}

impl Limit {
    /// The limit of `scheme`.
    pub fn of(scheme: Scheme) -> Self {
        Self { scheme }
    }

    /// Share of the limit that one contact uses: stable while below 1.
    /// For explicit Euler the larger of its two conditions (infinite without damping).
    ///
    /// ```
    /// use tsubu_integrate::Scheme;
    /// assert_eq!(Scheme::SymplecticEuler.limit().used(1.0, 0.5), 0.5);
    /// assert_eq!(Scheme::DashpotImplicit { sweeps: 4 }.limit().used(5.0, 0.5), 1.0);
    /// ```
    pub fn used(&self, k: f64, c: f64) -> f64 {
        match self.scheme {
            Scheme::SymplecticEuler | Scheme::VerletOld => (k + 2.0 * c) / 4.0,
            Scheme::VerletAveraged { sweeps } => solved(k, c, 0.5, sweeps),
            Scheme::DashpotImplicit { sweeps } => solved(k, c, 1.0, sweeps),
            Scheme::ExplicitEuler => {
                let slow = if k == 0.0 { 0.0 } else { k / c };
                slow.max(c / (2.0 + 0.5 * k))
            }
        }
    }

    /// True if one contact with these numbers does not grow.
    pub fn is_stable(&self, k: f64, c: f64) -> bool {
        self.used(k, c) < 1.0
    }

    /// Share of the limit that a packing uses, from its largest stiffness and damping eigenvalues in
    /// units of k/m and η/m of one grain (`stiffness_modes`, `damping_modes`; see [`Packing`]).
    pub fn used_by_packing(&self, k: f64, c: f64, packing: Packing) -> f64 {
        let (ks, cs) = packing.modes();
        self.used(ks * k, cs * c)
    }

    /// Steps per period T = 2π√(m*/k) of a pair that put `used` = 1 without damping: π.
    pub fn undamped_steps_per_period() -> f64 {
        PI
    }
}

/// Share of the limit with the damping taken at old + θ (new − old) velocity: the solve divides
/// stiffness and damping by 1 + θC, and multiplies them by its gain if it stops early on the wrong side.
fn solved(k: f64, c: f64, theta: f64, sweeps: u32) -> f64 {
    relative_mode_gain(theta * c, sweeps).max(1.0) * (k + 2.0 * c) / (4.0 * (1.0 + theta * c))
}

/// Arrangements whose largest eigenvalues are known in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    /// One grain against a wall.
    OneWallContact,
    /// Two grains of equal mass.
    Pair,
    /// A column of this many grains on a floor.
    Column(u32),
    /// Face-centred cubic, twelve contacts, central springs, equal damping in every direction:
    /// the densest packing, so a bound for disordered ones in practice.
    FaceCentredCubic,
}

impl Packing {
    /// Largest eigenvalues of stiffness and of damping in units of k/m and γ/m of one grain,
    /// for γn = γt: a chain of n on a floor has 2 + 2cos(2π/(2n+1)); fcc has 8 and 16.
    pub fn modes(self) -> (f64, f64) {
        match self {
            Packing::OneWallContact => (1.0, 1.0),
            Packing::Pair => (2.0, 2.0),
            Packing::Column(n) => {
                let factor = 2.0 + 2.0 * (2.0 * PI / (2.0 * f64::from(n) + 1.0)).cos();
                (factor, factor)
            }
            Packing::FaceCentredCubic => (8.0, 16.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest growth per step of one oscillator under the scheme, from the trace and determinant of
    /// its amplification matrix. Written out from the definition of the scheme, not from its limit.
    fn growth(scheme: Scheme, k: f64, c: f64) -> f64 {
        // State (x, vΔt). Columns of the matrix are its action on (1, 0) and (0, 1).
        let step = |x: f64, w: f64| -> (f64, f64) {
            match scheme {
                Scheme::ExplicitEuler => (x + w, w - k * x - c * w),
                Scheme::SymplecticEuler => {
                    let w = w - k * x - c * w;
                    (x + w, w)
                }
                // Leapfrog with half-step velocities: force at (x, w_half).
                Scheme::VerletOld => {
                    let w = w - k * x - c * w;
                    (x + w, w)
                }
                Scheme::VerletAveraged { .. } => {
                    let w = ((1.0 - 0.5 * c) * w - k * x) / (1.0 + 0.5 * c);
                    (x + w, w)
                }
                Scheme::DashpotImplicit { .. } => {
                    let w = (w - k * x) / (1.0 + c);
                    (x + w, w)
                }
            }
        };
        let ((a, b), (cc, d)) = (step(1.0, 0.0), step(0.0, 1.0));
        let (trace, det) = (a + d, a * d - b * cc);
        let disc = trace * trace / 4.0 - det;
        if disc < 0.0 {
            det.sqrt()
        } else {
            (trace / 2.0).abs() + disc.sqrt()
        }
    }

    #[test]
    fn limits_are_the_eigenvalues_of_the_schemes() {
        for scheme in Scheme::ALL {
            for i in 0..120 {
                for j in 0..60 {
                    let (k, c) = (0.05 + 0.08 * f64::from(i), 0.003 + 0.09 * f64::from(j));
                    let used = scheme.limit().used(k, c);
                    if (used - 1.0).abs() < 1e-9 {
                        continue;
                    }
                    let grows = growth(scheme, k, c) > 1.0 + 1e-12;
                    assert_eq!(grows, used > 1.0, "{scheme:?} at K = {k}, C = {c}");
                }
            }
        }
    }

    #[test]
    fn a_column_of_one_is_a_wall_contact_and_a_long_one_tends_to_four() {
        assert!((Packing::Column(1).modes().0 - 1.0).abs() < 1e-12);
        assert!((Packing::Column(2).modes().0 - 2.618).abs() < 1e-3);
        assert!((Packing::Column(1000).modes().0 - 4.0).abs() < 1e-4);
    }
}
