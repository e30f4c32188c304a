//! The force of [`SpringDashpot`]: one formula for the plane and for space, without branches.

use super::{Normal, Slip, SpringDashpot, Stretch, Tension};
use crate::tangential::{carried, mirrored, share};
use tsubu_model::{ContactLaw, Dim, Kind, Linear, Push, Spins, Touch, Vector};

/// Constants of [`SpringDashpot`] for one pair of kinds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDashpotPair {
    /// kn in N/m.
    pub normal_stiffness: f64,
    /// ks in N/m.
    pub tangential_stiffness: f64,
    /// ηn in kg/s.
    pub normal_damping: f64,
    /// ηs in kg/s.
    pub tangential_damping: f64,
    /// μ.
    pub friction: f64,
    /// Sum of the radii, or the grain's diameter against a wall, in m.
    pub range: f64,
    /// How far the normal force may pull, in N: zero, or infinity as printed.
    pub pull: f64,
    /// True if friction limits spring and dashpot together, false if the spring alone.
    pub limits_both: bool,
    /// True if the normal spring is summed up step by step.
    pub incremental: bool,
}

impl SpringDashpotPair {
    /// e_n after this step in N, for a contact at distance r (m) with v_n (m/s).
    #[inline(always)]
    fn normal_spring(&self, former: f64, r: f64, v_n: f64, dt: f64) -> f64 {
        if self.incremental {
            former - self.normal_stiffness * (v_n * dt)
        } else {
            self.normal_stiffness * (self.range - r)
        }
    }
}

impl<D: Dim> ContactLaw<D, Spins> for SpringDashpot {
    type Pair = SpringDashpotPair;
    type Memory = Stretch<D>;

    fn pair(&self, a: &Kind, b: &Kind) -> SpringDashpotPair {
        SpringDashpotPair {
            normal_stiffness: self.normal_stiffness,
            tangential_stiffness: self.tangential_stiffness,
            normal_damping: self.normal_damping,
            tangential_damping: self.tangential_damping,
            friction: self.friction,
            range: mirrored(a, b) + mirrored(b, a),
            pull: match self.tension {
                Tension::NoPull => 0.0,
                Tension::AsPrinted => f64::INFINITY,
            },
            limits_both: self.slip == Slip::Total,
            incremental: self.normal == Normal::Incremental,
        }
    }

    fn range(pair: &SpringDashpotPair) -> f64 {
        pair.range
    }

    #[inline(always)]
    fn force(
        pair: &SpringDashpotPair,
        touch: &Touch<D, Spins>,
        memory: &mut Stretch<D>,
        dt: f64,
    ) -> Push<D, Spins> {
        let r = touch.r();
        let n = touch.apart * (1.0 / r);
        let v_n = touch.velocity.dot(n);
        let inside = r < pair.range;

        let e_n = pair.normal_spring(memory.normal, r, v_n, dt);
        let presses = inside & (e_n >= 0.0);
        let spring = if presses { e_n } else { 0.0 };
        let floor = -spring - pair.pull;
        let dashpot = (-pair.normal_damping * v_n).max(floor);
        let dashpot = if presses { dashpot } else { 0.0 };
        let f_n = spring + dashpot;

        // Across n all is in axial form, q = n × f: one number in the plane, and the same for both grains.
        let v_s = D::moment(n, touch.velocity) - D::across(touch.spin, n);
        let trial = carried::<D>(memory.tangential, n) - v_s * (pair.tangential_stiffness * dt);
        let (length, limit) = (trial.length(), pair.friction * spring);
        let slips = length > limit;
        let e_s = trial * share(limit, length);
        let damped = presses & (pair.limits_both | !slips);
        let d_s = v_s
            * if damped {
                -pair.tangential_damping
            } else {
                0.0
            };
        let both = e_s + d_s;
        // A contact that does not press holds nothing; as printed it is e_n alone that says whether it does.
        let held = if (f_n > 0.0) | (pair.pull > 0.0) {
            1.0
        } else {
            0.0
        };
        let part = if pair.limits_both {
            share(pair.friction * f_n.max(0.0), both.length())
        } else {
            held
        };
        let slides = slips | (part < 1.0);
        let (e_s, f_s) = (e_s * part, both * part);

        memory.normal = if inside { e_n } else { 0.0 };
        memory.tangential = e_s;
        let stuck = if slides { 0.0 } else { 1.0 };
        Push {
            elastic: n * spring + D::turned(e_s * stuck, n),
            viscous: n * dashpot + D::turned(d_s * stuck, n),
            slip: D::turned(f_s * (1.0 - stuck), n),
            twist: -f_s,
            couple: D::W::ZERO,
        }
    }

    fn stored(pair: &SpringDashpotPair, touch: &Touch<D, Spins>, memory: &Stretch<D>) -> f64 {
        let r = touch.r();
        if r >= pair.range {
            return 0.0;
        }
        let half_over = |stiffness: f64| {
            if stiffness > 0.0 {
                0.5 / stiffness
            } else {
                0.0
            }
        };
        let e_n = pair.normal_spring(memory.normal, r, 0.0, 0.0).max(0.0);
        half_over(pair.normal_stiffness) * e_n * e_n
            + half_over(pair.tangential_stiffness) * memory.tangential.length_squared()
    }

    fn linear(pair: &SpringDashpotPair, touch: &Touch<D, Spins>, _dt: f64) -> Linear {
        if touch.r() >= pair.range {
            return Linear::default();
        }
        Linear {
            normal_stiffness: pair.normal_stiffness,
            tangential_stiffness: pair.tangential_stiffness,
            normal_damping: pair.normal_damping,
            tangential_damping: pair.tangential_damping,
        }
    }
}
