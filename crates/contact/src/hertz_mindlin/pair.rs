//! The force of [`HertzMindlin`]: one formula for the plane and for space, without branches.

use super::rolling::{Contact, Now, RollingPair};
use super::{Bristle, HertzMindlin, Rolling};
use crate::restitution::ratio_from_restitution;
use crate::tangential::{carried, is_flat, mirrored, share};
use tsubu_model::{ContactLaw, Dim, Kind, Linear, Push, Spins, Touch, Vector};

/// Constants of [`HertzMindlin`] for one pair of kinds. Powers of the overlap are left out of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzMindlinPair {
    /// (4/3) E* √R*: e_n over δ^(3/2), in N/m^(3/2).
    pub hertz: f64,
    /// 8 G* √R*: kt over √δ, in N/m^(3/2).
    pub mindlin: f64,
    /// Normal damping over δ^(1/4), in kg/s/m^(1/4).
    pub normal_damping: f64,
    /// Tangential damping over δ^(1/4), in kg/s/m^(1/4).
    pub tangential_damping: f64,
    /// μ.
    pub friction: f64,
    /// Sum of the radii, or the grain's diameter against a wall, in m.
    pub range: f64,
    /// Of rolling.
    pub rolling: RollingPair,
}

/// ab/(a + b), the other one where one is infinite, and 0 where both are: two things that do not move damp nothing.
fn reduced(a: f64, b: f64) -> f64 {
    match (a.is_finite(), b.is_finite()) {
        (true, true) => a * b / (a + b),
        (true, false) => a,
        (false, true) => b,
        (false, false) => 0.0,
    }
}

impl<D: Dim, R: Rolling> ContactLaw<D, Spins> for HertzMindlin<R> {
    type Pair = HertzMindlinPair;
    type Memory = Bristle<D, R>;
    const ROLLS: bool = R::RESISTS;

    fn pair(&self, a: &Kind, b: &Kind) -> HertzMindlinPair {
        let curvature = |kind: &Kind| {
            if is_flat(kind) {
                f64::INFINITY
            } else {
                kind.radius
            }
        };
        let about_contact = |kind: &Kind| kind.inertia + kind.mass * kind.radius * kind.radius;
        // 0 × ∞ is not a number: a flat wall does not turn.
        let turned = |kind: &Kind| {
            if kind.mass.is_finite() {
                about_contact(kind)
            } else {
                f64::INFINITY
            }
        };
        let radius = reduced(curvature(a), curvature(b));
        let mass = reduced(a.mass, b.mass);
        let hertz = 4.0 / 3.0 * self.modulus * radius.sqrt();
        let mindlin = 8.0 * self.shear * radius.sqrt();
        let ratio = ratio_from_restitution(self.restitution);
        HertzMindlinPair {
            hertz,
            mindlin,
            normal_damping: 2.0 * ratio * (1.25 * hertz * mass).sqrt(),
            tangential_damping: 2.0 * ratio * (5.0 / 6.0 * mindlin * mass).sqrt(),
            friction: self.friction,
            range: mirrored(a, b) + mirrored(b, a),
            rolling: self.rolling.pair(&Contact {
                radius,
                hertz,
                inertia: reduced(turned(a), turned(b)),
            }),
        }
    }

    fn range(pair: &HertzMindlinPair) -> f64 {
        pair.range
    }

    #[inline(always)]
    fn force(
        pair: &HertzMindlinPair,
        touch: &Touch<D, Spins>,
        memory: &mut Bristle<D, R>,
        dt: f64,
    ) -> Push<D, Spins> {
        let r = touch.r();
        let n = touch.apart * (1.0 / r);
        let v_n = touch.velocity.dot(n);
        // All that follows is zero where the overlap is.
        let overlap = (pair.range - r).max(0.0);
        let root = overlap.sqrt();
        let quarter = root.sqrt();

        let spring = pair.hertz * (overlap * root);
        let dashpot = (-(pair.normal_damping * quarter) * v_n).max(-spring);
        let f_n = spring + dashpot;

        // Across n all is in axial form, q = n × f: one number in the plane, and the same for both grains.
        let v_s = D::moment(n, touch.velocity) - D::across(touch.spin, n);
        let shrink = (root / memory.root.max(f64::MIN_POSITIVE)).min(1.0);
        let stiffness = pair.mindlin * root;
        let trial = carried::<D>(memory.tangential, n) * shrink - v_s * (stiffness * dt);
        let (length, limit) = (trial.length(), pair.friction * spring);
        let e_s = trial * share(limit, length);
        let d_s = v_s * -(pair.tangential_damping * quarter);
        let both = e_s + d_s;
        let part = share(pair.friction * f_n, both.length());
        let slides = (length > limit) | (part < 1.0);
        let (e_s, f_s) = (e_s * part, both * part);

        let now = Now::<D> {
            n,
            roll: D::across(touch.roll, n),
            press: f_n,
            root,
            quarter,
            shrink,
            dt,
        };
        let (couple, rolling) = R::couple::<D>(&pair.rolling, &now, memory.couple);

        memory.root = root;
        memory.tangential = e_s;
        memory.couple = rolling;
        let stuck = if slides { 0.0 } else { 1.0 };
        Push {
            elastic: n * spring + D::turned(e_s * stuck, n),
            viscous: n * dashpot + D::turned(d_s * stuck, n),
            slip: D::turned(f_s * (1.0 - stuck), n),
            twist: -f_s,
            couple,
        }
    }

    fn stored(pair: &HertzMindlinPair, touch: &Touch<D, Spins>, memory: &Bristle<D, R>) -> f64 {
        let overlap = (pair.range - touch.r()).max(0.0);
        if overlap == 0.0 {
            return 0.0;
        }
        let root = overlap.sqrt();
        let stiffness = pair.mindlin * root;
        let across = if stiffness > 0.0 {
            0.5 * memory.tangential.length_squared() / stiffness
        } else {
            0.0
        };
        0.4 * pair.hertz * overlap * overlap * root
            + across
            + R::stored::<D>(&pair.rolling, root, memory.couple)
    }

    fn linear(pair: &HertzMindlinPair, touch: &Touch<D, Spins>, _dt: f64) -> Linear {
        let overlap = (pair.range - touch.r()).max(0.0);
        if overlap == 0.0 {
            return Linear::default();
        }
        let root = overlap.sqrt();
        Linear {
            normal_stiffness: 1.5 * pair.hertz * root,
            tangential_stiffness: pair.mindlin * root,
            normal_damping: pair.normal_damping * root.sqrt(),
            tangential_damping: pair.tangential_damping * root.sqrt(),
        }
    }
}
