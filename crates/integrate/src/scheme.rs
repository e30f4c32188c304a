//! The schemes and the parts of their step.

use crate::Limit;

/// How positions and velocities advance over Δt. Each variant states the velocity that the damping sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// x += v Δt with the old velocity, then v += a Δt. Here to fail: without damping it is never stable.
    ExplicitEuler,
    /// v += a Δt, then x += v Δt. Damping from the old velocity. First order in the damping.
    SymplecticEuler,
    /// Velocity Verlet with the force taken at the half-step velocity. Damping is first order,
    /// positions are those of leapfrog.
    VerletOld,
    /// Velocity Verlet with the damping at the velocity of the same instant, the average of the two
    /// half-step velocities. Second order. A linear solve in `sweeps` Jacobi sweeps.
    VerletAveraged {
        /// Sweeps of the solve per step.
        sweeps: u32,
    },
    /// Symplectic Euler with the dashpot taken at the new velocity. A linear solve in `sweeps` Jacobi sweeps.
    DashpotImplicit {
        /// Sweeps of the solve per step.
        sweeps: u32,
    },
}

/// When positions move within the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drift {
    /// Before the forces, after a half kick with the force of the step before.
    BeforeForces,
    /// After the kick, with the new velocity.
    AfterKick,
    /// With the velocity from before the kick.
    WithOldVelocity,
}

impl Scheme {
    /// Every scheme with its usual number of sweeps.
    pub const ALL: [Scheme; 5] = [
        Scheme::ExplicitEuler,
        Scheme::SymplecticEuler,
        Scheme::VerletOld,
        Scheme::VerletAveraged { sweeps: 4 },
        Scheme::DashpotImplicit { sweeps: 4 },
    ];

    /// Its name as scenes write it.
    pub fn name(self) -> &'static str {
        match self {
            Scheme::ExplicitEuler => "ExplicitEuler",
            Scheme::SymplecticEuler => "SymplecticEuler",
            Scheme::VerletOld => "VerletOld",
            Scheme::VerletAveraged { .. } => "VerletAveraged",
            Scheme::DashpotImplicit { .. } => "DashpotImplicit",
        }
    }

    /// When positions move.
    pub fn drift(self) -> Drift {
        match self {
            Scheme::ExplicitEuler => Drift::WithOldVelocity,
            Scheme::SymplecticEuler | Scheme::DashpotImplicit { .. } => Drift::AfterKick,
            Scheme::VerletOld | Scheme::VerletAveraged { .. } => Drift::BeforeForces,
        }
    }

    /// Share of Δt of the kick that follows the forces (and of the one before the drift, if there is one).
    pub fn kick(self) -> f64 {
        if self.drift() == Drift::BeforeForces {
            0.5
        } else {
            1.0
        }
    }

    /// Sweeps of the linear solve; 0 for the explicit schemes.
    pub fn sweeps(self) -> u32 {
        match self {
            Scheme::VerletAveraged { sweeps } | Scheme::DashpotImplicit { sweeps } => sweeps,
            _ => 0,
        }
    }

    /// How often the forces are computed in a step.
    pub fn force_passes(self) -> u32 {
        self.sweeps().max(1)
    }

    /// Where it is stable.
    pub fn limit(self) -> Limit {
        Limit::of(self)
    }
}
