//! How fast the stiffest motion of the packing is: the number that an explicit step must respect.

use crate::chunk::{CHUNK, Chunk};
use crate::kinds::{KindSet, pick};
use crate::line::Layout;
use crate::walls::{Own, WallJob, wall_linear};
use crate::world::{Tally, World};
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
    /// Δt² k + 2 Δt η along and across.
    along: f64,
    across: f64,
}

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// The largest eigenvalue of M^-½(Δt²K + 2ΔtC)M^-½ for the contacts of this moment: K and C are their stiffness
    /// and damping, M the masses and, for grains that turn, the moments of inertia. Symplectic Euler and Verlet with the
    /// old velocity are stable below 4. Contacts that slide are taken to stick: then their springs act, so the value is
    /// an upper one.
    ///
    /// By the power method from a fixed start, so it comes from below: by 1 % at most where the two largest
    /// eigenvalues do not lie together, and then it is right anyway. 0 without contacts. Costs as much as some hundred steps.
    /// Source: `OSullivan2004` for the question; the matrix is derived in the book.
    pub fn stiffest_mode(&self) -> f64 {
        let bonds = self.bonds();
        let n = self.identity.len();
        let inverse = |x: f64| {
            if x.is_finite() && x > 0.0 {
                1.0 / x
            } else {
                0.0
            }
        };
        let weight: Vec<[f64; 2]> = (0..n)
            .map(|i| {
                let kind = pick::<K, _>(self.kinds.all(), self.lines[i].kind::<D>());
                [inverse(kind.mass).sqrt(), inverse(kind.inertia).sqrt()]
            })
            .collect();
        let dice = |i: usize, a: usize| uniform(1, self.identity[i].into(), a as u64) - 0.5;
        let mut x: Vec<(D::V, S::Turn<D>)> = (0..n)
            .map(|i| {
                (
                    D::V::from_axes(|a| dice(i, a)),
                    S::Turn::<D>::from_axes(|a| dice(i, 8 + a)),
                )
            })
            .collect();
        let (mut last, mut found) = (0.0, 0.0);
        for round in 0..MOST {
            let norm = x
                .iter()
                .map(|(u, w)| u.length_squared() + w.length_squared())
                .sum::<f64>()
                .sqrt();
            if norm == 0.0 {
                return 0.0;
            }
            for (u, w) in &mut x {
                (*u, *w) = (*u * (1.0 / norm), *w * (1.0 / norm));
            }
            let y = stiffened::<D, S>(&bonds, &weight, &x);
            found = x
                .iter()
                .zip(&y)
                .map(|(x, y)| x.0.dot(y.0) + x.1.dot(y.1))
                .sum();
            x = y;
            if round % 10 == 9 {
                if found - last <= ENOUGH * found {
                    break;
                }
                last = found;
            }
        }
        found
    }

    /// Every contact once.
    fn bonds(&self) -> Vec<Bond<D>> {
        let (dt, mut bonds) = (self.dt, Vec::new());
        let stiffness = |linear: &Linear| {
            (
                dt * (dt * linear.normal_stiffness + 2.0 * linear.normal_damping),
                dt * (dt * linear.tangential_stiffness + 2.0 * linear.tangential_damping),
            )
        };
        let pairs = self.pairs();
        self.pairs_once(|i, j, _| {
            let (pair, touch) = pairs.touch::<S, K>(i, j);
            let (along, across) = stiffness(&L::linear(pair, &touch, dt));
            if along > 0.0 || across > 0.0 {
                bonds.push(Bond {
                    i,
                    j: Some(j),
                    normal: touch.normal(),
                    radii: [i, j].map(|k| self.lines[k].0[D::RADIUS]),
                    along,
                    across,
                });
            }
        });
        let walls = WallJob::<D, S, W> {
            bodies: &self.bodies,
            pairs: &self.wall_pairs,
            poses: &self.poses,
            moved: &self.body_moved,
            dt,
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
                let (along, across) = stiffness(linear);
                bonds.push(Bond {
                    i: first + slot,
                    j: None,
                    normal,
                    radii: [self.lines[first + slot].0[D::RADIUS], 0.0],
                    along,
                    across,
                });
            });
        }
        bonds
    }
}

/// M^-½ B M^-½ x for the bonds' matrix B.
fn stiffened<D: Dim, S: SpinState>(
    bonds: &[Bond<D>],
    weight: &[[f64; 2]],
    x: &[(D::V, S::Turn<D>)],
) -> Vec<(D::V, S::Turn<D>)> {
    let mut y = vec![(D::V::ZERO, S::Turn::<D>::ZERO); x.len()];
    for bond in bonds {
        let (i, n) = (bond.i, bond.normal);
        let mut apart = x[i].0 * weight[i][0];
        let mut turn = x[i].1 * (weight[i][1] * bond.radii[0]);
        if let Some(j) = bond.j {
            apart = apart - x[j].0 * weight[j][0];
            turn += x[j].1 * (weight[j][1] * bond.radii[1]);
        }
        let moved = apart + S::at_contact::<D>(n, turn);
        let along = n * moved.dot(n);
        let side = (moved - along) * bond.across;
        let push = along * bond.along + side;
        let twist = S::twist::<D>(n, side);
        y[i].0 += push * weight[i][0];
        y[i].1 += twist * (bond.radii[0] * weight[i][1]);
        if let Some(j) = bond.j {
            y[j].0 += push * -weight[j][0];
            y[j].1 += twist * (bond.radii[1] * weight[j][1]);
        }
    }
    y
}
