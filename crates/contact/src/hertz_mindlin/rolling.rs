//! Resistance to rolling of Hertz–Mindlin contacts, as a type: grains that roll freely remember nothing of it.

use crate::tangential::{carried, share};
use std::fmt::Debug;
use tsubu_model::{Dim, Nothing, Quantity, Vector};

/// Whether something resists rolling.
pub trait Rolling: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// True if it does.
    const RESISTS: bool;
    /// A couple, N m, or nothing.
    type Couple<D: Dim>: Vector;

    /// Its constants by name, quantity and value.
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)>;
    /// The same with each constant replaced.
    fn mapped(&self, f: impl FnMut(Quantity, f64) -> f64) -> Self;
    /// The constants of a pair.
    fn pair(&self, contact: &Contact) -> RollingPair;
    /// The couple on this grain, and what of it is a spring.
    fn couple<D: Dim>(
        pair: &RollingPair,
        now: &Now<D>,
        spring: Self::Couple<D>,
    ) -> (D::W, Self::Couple<D>);
    /// The energy of the spring at √δ, in J.
    fn stored<D: Dim>(pair: &RollingPair, root: f64, spring: Self::Couple<D>) -> f64;
}

/// What rolling needs to know of two kinds.
pub struct Contact {
    /// R* in m.
    pub radius: f64,
    /// (4/3) E* √R* in N/m^(3/2).
    pub hertz: f64,
    /// Reduced moment of inertia about the point of contact in kg m².
    pub inertia: f64,
}

/// Constants of rolling for one pair of kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RollingPair {
    /// μr R* in m: the couple is at most this times f_n.
    pub arm: f64,
    /// kr/√δ in N √m.
    pub stiffness: f64,
    /// Damping over δ^(1/4), in N m s/m^(1/4).
    pub damping: f64,
    /// I_r in kg m².
    pub inertia: f64,
    /// True for a couple of constant size.
    pub constant: bool,
}

/// A contact at this moment, as rolling sees it.
pub struct Now<D: Dim> {
    /// Unit vector to this grain.
    pub n: D::V,
    /// ω_i − ω_j across n in rad/s.
    pub roll: D::W,
    /// f_n in N.
    pub press: f64,
    /// √δ in √m, its own root, and its share of the former √δ, at most 1.
    pub root: f64,
    /// δ^(1/4).
    pub quarter: f64,
    /// min(√δ over that of the step before, 1).
    pub shrink: f64,
    /// The step in s.
    pub dt: f64,
}

/// Grains roll freely.
///
/// ```
/// use tsubu_contact::{Freely, Rolling};
/// assert!(!Freely::RESISTS);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Freely;

/// Grains are held back from rolling, by a couple of at most μr R* f_n.
///
/// ```text
/// Constant:       M = −μr R* f_n ω/|ω|,   but no more than stops the rolling within two steps
/// ElasticPlastic: M ← M · min(√δ/√δ before, 1) − kr ω Δt,  |M| ≤ μr R* f_n,   kr = 2.25 μr² R*² (4/3) E* √(R* δ)
///                 and a dashpot 2 ηr √(I_r kr) while the spring is not at its limit
/// ω = ω_i − ω_j across n,   1/I_r = 1/(I_i + m_i r_i²) + 1/(I_j + m_j r_j²)
/// ```
///
/// μr: rolling friction (pure number); ηr: damping ratio of rolling (pure number); M in N m. The constant couple is directed against
/// what rolls and so does not hold a heap at rest; the elastic–plastic one does.
///
/// Source: `Ai2011`, types A and C.
///
/// ```
/// use tsubu_contact::{Resistance, Resisted};
/// let rough = Resisted { friction: 0.1, damping: 0.3, by: Resistance::ElasticPlastic };
/// assert_eq!(rough.friction, 0.1);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resisted {
    /// μr.
    pub friction: f64,
    /// ηr; of a constant couple nothing reads it.
    pub damping: f64,
    /// How.
    pub by: Resistance,
}

/// How rolling is resisted.
///
/// Source: `Ai2011`.
///
/// ```
/// assert_eq!(tsubu_contact::Resistance::default(), tsubu_contact::Resistance::ElasticPlastic);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resistance {
    /// Type A: a couple of constant size against the rolling.
    Constant,
    /// Type C: a spring with a limit, and a dashpot.
    #[default]
    ElasticPlastic,
}

impl Rolling for Freely {
    const RESISTS: bool = false;
    type Couple<D: Dim> = Nothing;

    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        Vec::new()
    }

    fn mapped(&self, _f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Freely
    }

    fn pair(&self, _contact: &Contact) -> RollingPair {
        RollingPair::default()
    }

    #[inline(always)]
    fn couple<D: Dim>(_pair: &RollingPair, _now: &Now<D>, _spring: Nothing) -> (D::W, Nothing) {
        (D::W::ZERO, Nothing)
    }

    fn stored<D: Dim>(_pair: &RollingPair, _root: f64, _spring: Nothing) -> f64 {
        0.0
    }
}

impl Rolling for Resisted {
    const RESISTS: bool = true;
    type Couple<D: Dim> = D::W;

    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        vec![
            ("rolling_friction", Quantity::Number, self.friction),
            ("rolling_damping", Quantity::Number, self.damping),
        ]
    }

    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            friction: f(Quantity::Number, self.friction),
            damping: f(Quantity::Number, self.damping),
            by: self.by,
        }
    }

    fn pair(&self, contact: &Contact) -> RollingPair {
        let arm = self.friction * contact.radius;
        let stiffness = 2.25 * arm * arm * contact.hertz;
        RollingPair {
            arm,
            stiffness,
            damping: 2.0 * self.damping * (contact.inertia * stiffness).sqrt(),
            inertia: contact.inertia,
            constant: self.by == Resistance::Constant,
        }
    }

    #[inline(always)]
    fn couple<D: Dim>(pair: &RollingPair, now: &Now<D>, spring: D::W) -> (D::W, D::W) {
        let limit = pair.arm * now.press;
        // Type A: half of what would stop it in one step, so that at rest it does not drive to and fro.
        let stops = 0.5 * pair.inertia / now.dt;
        let against = (limit / now.roll.length().max(f64::MIN_POSITIVE)).min(stops);
        // Type C.
        let stiffness = pair.stiffness * now.root;
        let trial = carried::<D>(spring, now.n) * now.shrink - now.roll * (stiffness * now.dt);
        let length = trial.length();
        let held = trial * share(limit, length);
        let damping = if length > limit {
            0.0
        } else {
            pair.damping * now.quarter
        };
        let both = held - now.roll * damping;
        let part = share(limit, both.length());
        let [constant, elastic] = if pair.constant {
            [1.0, 0.0]
        } else {
            [0.0, part]
        };
        let spring = held * elastic;
        (both * elastic - now.roll * (against * constant), spring)
    }

    fn stored<D: Dim>(pair: &RollingPair, root: f64, spring: D::W) -> f64 {
        let stiffness = pair.stiffness * root;
        if stiffness > 0.0 {
            0.5 * spring.length_squared() / stiffness
        } else {
            0.0
        }
    }
}
