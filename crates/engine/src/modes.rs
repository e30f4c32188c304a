//! How fast the stiffest motion of the packing is: the number that an explicit step must respect.

use crate::chunk::{CHUNK, Chunk};
use crate::kinds::{KindSet, pick};
use crate::line::Layout;
use crate::walls::{Own, WallJob, strongest, wall_linear};
use crate::world::{Tally, World};
use tsubu_integrate::Scheme;
use tsubu_model::{ContactLaw, Dim, Linear, SpinState, Vector, uniform};

/// Iterations of the power method, and the change of the estimate over ten of them at which it ends.
const MOST: usize = 600;
const ENOUGH: f64 = 1e-4;

/// One linearised contact of grain `i` with grain `j`, or with a body.
struct Bond<D: Dim> {
    i: usize,
    j: Option<usize>,
    normal: D::V,
    /// Radii of the two.
    radii: [f64; 2],
    linear: Linear,
}

/// The contacts of one moment, linearised. Contacts that slide are taken to stick: then their springs act, so what is
/// found is an upper value.
pub struct Modes<D: Dim, S: SpinState> {
    bonds: Vec<Bond<D>>,
    /// 1/m and 1/I of each grain.
    inverse: Vec<[f64; 2]>,
    /// Sum of the dampings of each grain's contacts.
    damping: Vec<f64>,
    /// Where the power method starts.
    start: Vec<Moved<D, S>>,
    scheme: Scheme,
}

/// Velocity and spin of a grain, or force and torque on it.
type Moved<D, S> = (<D as Dim>::V, <S as SpinState>::Turn<D>);

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// [`Modes::largest`] of the contacts of this moment at the world's own step.
    pub fn stiffest_mode(&self) -> f64 {
        self.modes().largest(self.dt)
    }

    /// The contacts of this moment.
    pub fn modes(&self) -> Modes<D, S> {
        let inverse = |x: f64| {
            if x.is_finite() && x > 0.0 {
                1.0 / x
            } else {
                0.0
            }
        };
        let n = self.identity.len();
        let inverse: Vec<[f64; 2]> = (0..n)
            .map(|i| {
                let kind = pick::<K, _>(self.kinds.all(), self.lines[i].kind::<D>());
                [inverse(kind.mass), inverse(kind.inertia)]
            })
            .collect();
        let bonds = self.bonds();
        let mut damping = vec![0.0; n];
        for bond in &bonds {
            for i in [Some(bond.i), bond.j].into_iter().flatten() {
                damping[i] += strongest(&bond.linear);
            }
        }
        let dice = |i: usize, a: usize| uniform(1, self.identity[i].into(), a as u64) - 0.5;
        let start = inverse
            .iter()
            .enumerate()
            .map(|(i, inverse)| {
                (
                    D::V::from_axes(|a| dice(i, a) * inverse[0].sqrt()),
                    S::Turn::<D>::from_axes(|a| dice(i, 8 + a) * inverse[1].sqrt()),
                )
            })
            .collect();
        Modes {
            bonds,
            inverse,
            damping,
            start,
            scheme: self.scheme,
        }
    }

    /// Every contact once.
    fn bonds(&self) -> Vec<Bond<D>> {
        let mut bonds = Vec::new();
        let acts = |linear: &Linear| {
            let parts = [
                linear.normal_stiffness,
                linear.normal_damping,
                linear.tangential_stiffness,
                linear.tangential_damping,
            ];
            parts.iter().any(|&part| part > 0.0)
        };
        let pairs = self.pairs();
        self.pairs_once(|i, j, _| {
            let (pair, touch) = pairs.touch::<S, K>(i, j);
            let linear = L::linear(pair, &touch, self.dt);
            if acts(&linear) {
                bonds.push(Bond {
                    i,
                    j: Some(j),
                    normal: touch.normal(),
                    radii: [i, j].map(|k| self.lines[k].0[D::RADIUS]),
                    linear,
                });
            }
        });
        let walls = WallJob::<D, S, W> {
            bodies: &self.bodies,
            pairs: &self.wall_pairs,
            poses: &self.poses,
            moved: &self.body_moved,
            dt: self.dt,
            keep: false,
        };
        for (number, chunk) in self.chunks.iter().enumerate() {
            let mut scratch = Chunk::new(self.bodies.len());
            scratch.near.clone_from(&chunk.near);
            scratch.moved = chunk.moved;
            let first = number * CHUNK;
            let grains = CHUNK.min(self.identity.len() - first);
            let own =
                Own::of_chunk::<D, S>(number, grains, &self.lines, &self.spins, &self.identity);
            wall_linear::<D, S, K, W>(&walls, own, &mut scratch, |slot, normal, linear| {
                if acts(linear) {
                    bonds.push(Bond {
                        i: first + slot,
                        j: None,
                        normal,
                        radii: [self.lines[first + slot].0[D::RADIUS], 0.0],
                        linear: *linear,
                    });
                }
            });
        }
        bonds
    }
}

impl<D: Dim, S: SpinState> Modes<D, S> {
    /// True if no grain that forces move is without a contact: the packing lies, and what it bears can be worked out.
    pub fn all_touch(&self) -> bool {
        let mut touches = vec![false; self.inverse.len()];
        for bond in &self.bonds {
            for i in [Some(bond.i), bond.j].into_iter().flatten() {
                touches[i] = true;
            }
        }
        let mut each = touches.iter().zip(&self.inverse);
        !self.inverse.is_empty() && each.all(|(touches, inverse)| *touches || inverse[0] == 0.0)
    }

    /// The largest eigenvalue of W^½(Δt²K + 2ΔtC)W^½ at a step of `dt` s, stable below 4: K and C are the stiffness and
    /// damping of the contacts. For symplectic Euler and Verlet with the old velocity W = M^-1, M the masses and, for
    /// grains that turn, the moments of inertia. A solve of S sweeps over h gives the masses instead
    ///
    /// ```text
    /// W = Σ_{s<S} (1 − N^-1(M + hC))^s N^-1,   N = M + hD,   D the sum of the dampings of a grain's contacts
    /// ```
    ///
    /// since from the velocity u it leads to u − hW(Kx + Cu). It does not sweep spins, so for grains that turn this is an
    /// approximation. Explicit Euler has another limit.
    ///
    /// By the power method from a fixed start, so it comes from below: by 1 % at most where the two largest
    /// eigenvalues do not lie together, and then it is right anyway. 0 without contacts. Costs as much as some hundred steps.
    /// Source: `OSullivan2004` for the question; the matrix is derived in the book.
    pub fn largest(&self, dt: f64) -> f64 {
        let mut x = self.start.clone();
        let (mut last, mut found) = (0.0, 0.0);
        for round in 0..MOST {
            let push = self.push(&x, |k, c| dt * (dt * k + 2.0 * c));
            let held = dot::<D, S>(&x, &push);
            let y = self.moved(&push, dt);
            let norm = dot::<D, S>(&push, &y).sqrt();
            if !(held > 0.0 && norm > 0.0) {
                return 0.0;
            }
            found = norm * norm / held;
            x = y;
            for (u, w) in &mut x {
                (*u, *w) = (*u * (1.0 / norm), *w * (1.0 / norm));
            }
            if round % 10 == 9 {
                if found - last <= ENOUGH * found {
                    break;
                }
                last = found;
            }
        }
        found
    }

    /// The matrix of the contacts, each with `of`(stiffness, damping) along and across, times x.
    fn push(&self, x: &[Moved<D, S>], of: impl Fn(f64, f64) -> f64) -> Vec<Moved<D, S>> {
        let mut y = vec![(D::V::ZERO, S::Turn::<D>::ZERO); x.len()];
        for bond in &self.bonds {
            let (i, n, linear) = (bond.i, bond.normal, &bond.linear);
            let mut apart = x[i].0;
            let mut turn = x[i].1 * bond.radii[0];
            if let Some(j) = bond.j {
                apart = apart - x[j].0;
                turn += x[j].1 * bond.radii[1];
            }
            let moved = apart + S::at_contact::<D>(n, turn);
            let along = n * moved.dot(n);
            let side = (moved - along) * of(linear.tangential_stiffness, linear.tangential_damping);
            let push = along * of(linear.normal_stiffness, linear.normal_damping) + side;
            let twist = S::twist::<D>(n, side);
            y[i].0 += push;
            y[i].1 += twist * bond.radii[0];
            if let Some(j) = bond.j {
                y[j].0 += push * -1.0;
                y[j].1 += twist * bond.radii[1];
            }
        }
        y
    }

    /// W times the push.
    fn moved(&self, push: &[Moved<D, S>], dt: f64) -> Vec<Moved<D, S>> {
        let all = push.iter().zip(&self.inverse);
        let (h, sweeps) = (self.scheme.kick() * dt, self.scheme.sweeps());
        if sweeps == 0 {
            return all
                .map(|(p, inverse)| (p.0 * inverse[0], p.1 * inverse[1]))
                .collect();
        }
        // Each sweep: w += (push − (M + hC) w)/(m + hD), from w = 0.
        let still = S::Turn::<D>::ZERO;
        let mut w = vec![(D::V::ZERO, still); push.len()];
        for _ in 0..sweeps {
            let damped = self.push(&w, |_, c| h * c);
            for (i, w) in w.iter_mut().enumerate() {
                let inverse = self.inverse[i][0];
                let left = (push[i].0 - damped[i].0) * inverse - w.0;
                w.0 += left * (1.0 / (1.0 + h * self.damping[i] * inverse));
            }
        }
        let turned = all.map(|(p, inverse)| p.1 * inverse[1]);
        w.into_iter()
            .zip(turned)
            .map(|(w, turn)| (w.0, turn))
            .collect()
    }
}

fn dot<D: Dim, S: SpinState>(x: &[Moved<D, S>], y: &[Moved<D, S>]) -> f64 {
    let each = x.iter().zip(y);
    each.map(|(x, y)| x.0.dot(y.0) + x.1.dot(y.1)).sum()
}
