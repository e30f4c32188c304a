//! Head-on collisions at a fine step: restitution, duration and closest approach as measured.

use super::states::{Case, State, axis};
use tsubu_model::{ContactLaw, Dim, Kind, Numbers, SpinState, Spins, Still, Vector};

/// Speeds in m/s at which [`rebounds_with`] tries a law.
pub const SPEEDS: [f64; 4] = [0.01, 0.1, 1.0, 10.0];

/// Steps to half a period. The leapfrog damps with the velocity half a step old, which costs
/// ζπ/20000 of e: 1e-4 at ζ = 1.
const STEPS: f64 = 20_000.0;

/// What a head-on collision gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// Speed after over speed before.
    pub restitution: f64,
    /// Time within the range in s.
    pub duration: f64,
    /// Least distance of the centres in m.
    pub closest: f64,
}

/// A head-on collision at this speed in m/s, followed until the grains are out of range.
/// `None` if they do not part within fifty half periods: an overdamped law that may pull.
///
/// ```
/// use tsubu_contact::{Repulsion, testing::collide};
/// use tsubu_model::{Kind, Space};
/// let coke = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
/// let grain = Kind::sphere(1.350e-3, 1370.0);
/// let rebound = collide::<Space, _>(&coke, &grain, &grain, 1.0).unwrap();
/// assert!((rebound.restitution - 0.89686).abs() < 1e-4);
/// ```
pub fn collide<D: Dim, L: ContactLaw<D, Still>>(
    law: &L,
    a: &Kind,
    b: &Kind,
    speed: f64,
) -> Option<Rebound> {
    head_on::<D, Still, L>(law, a, b, speed)
}

/// As [`collide`], for a law of grains that turn. They do not, head-on.
pub fn collide_spinning<D: Dim, L: ContactLaw<D, Spins>>(
    law: &L,
    a: &Kind,
    b: &Kind,
    speed: f64,
) -> Option<Rebound> {
    head_on::<D, Spins, L>(law, a, b, speed)
}

fn head_on<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    law: &L,
    a: &Kind,
    b: &Kind,
    speed: f64,
) -> Option<Rebound> {
    let case = Case::<D, S, L>::new(law, a, b).ok()?;
    let n = axis::<D::V>(D::UP);
    let dt = std::f64::consts::PI / (rate_at(&case, speed) * STEPS);
    let mut x = n * (case.range * (1.0 - 1e-12));
    let mut v = n * -speed;
    let mut memory = L::Memory::zero();
    let mut closest = case.range;
    for step in 0..50 * STEPS as u64 {
        let touch = case.at(State::moving(x, v));
        if touch.r() >= case.range {
            let restitution = v.dot(n) / speed;
            return Some(Rebound {
                restitution,
                duration: step as f64 * dt,
                closest,
            });
        }
        closest = closest.min(touch.r());
        v += L::force(&case.pair, &touch, &mut memory, dt).total() * (dt / case.mass);
        x += v * dt;
    }
    None
}

/// √(k/m*) at the overlap that this speed reaches, found by trying: overlap = v/ω, ω from there.
fn rate_at<D: Dim, S: SpinState, L: ContactLaw<D, S>>(case: &Case<D, S, L>, speed: f64) -> f64 {
    (0..8).fold(case.rate, |rate, _| {
        let overlap = (speed / rate).min(0.3 * case.range);
        let apart = axis::<D::V>(D::UP) * (case.range - overlap);
        let touch = case.at(State::at_rest(apart));
        let stiffness = L::linear(&case.pair, &touch, case.dt).normal_stiffness;
        if stiffness > 0.0 {
            (stiffness / case.mass).sqrt()
        } else {
            rate
        }
    })
}

/// Panics unless a head-on collision returns the restitution asked for, within an absolute
/// tolerance, at every speed of [`SPEEDS`]: `rebounds_with::<Space, _>(&law, &grain, &wall, 0.5, 0.01)`.
///
/// The tolerance belongs to the law: a spring that stiffens with overlap damps less at high speed.
#[track_caller]
pub fn rebounds_with<D: Dim, L: ContactLaw<D, Still>>(
    law: &L,
    a: &Kind,
    b: &Kind,
    e: f64,
    tolerance: f64,
) {
    rebounds::<L>(e, tolerance, |speed| collide::<D, L>(law, a, b, speed));
}

/// As [`rebounds_with`], for a law of grains that turn.
#[track_caller]
pub fn rebounds_spinning_with<D: Dim, L: ContactLaw<D, Spins>>(
    law: &L,
    a: &Kind,
    b: &Kind,
    e: f64,
    tolerance: f64,
) {
    rebounds::<L>(e, tolerance, |speed| {
        collide_spinning::<D, L>(law, a, b, speed)
    });
}

#[track_caller]
fn rebounds<L>(e: f64, tolerance: f64, collide: impl Fn(f64) -> Option<Rebound>) {
    let wrong: String = SPEEDS
        .into_iter()
        .filter_map(|speed| match collide(speed) {
            Some(rebound) if (rebound.restitution - e).abs() <= tolerance => None,
            Some(rebound) => Some(format!("\n  at {speed} m/s: {:.5}", rebound.restitution)),
            None => Some(format!("\n  at {speed} m/s: the grains do not part")),
        })
        .collect();
    let law = std::any::type_name::<L>();
    assert!(
        wrong.is_empty(),
        "{law}: restitution {e} asked for, tolerance {tolerance}{wrong}"
    );
}
