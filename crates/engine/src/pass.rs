//! The force loop over one chunk of grains: eight contacts at a time.
#![allow(clippy::needless_range_loop)] // lanes of many arrays are indexed in step

use crate::kinds::KindSet;
use crate::lanes::Gather;
use crate::line::{Layout, Line, has_second_line};
use crate::world::Tally;
use std::marker::PhantomData;
use tsubu_model::{ContactLaw, Domain, MOST_NUMBERS, Numbers, SpinState, Touch, Vector};
use tsubu_neighbors::{ChunkList, LANES};

/// What the force loop of one chunk reads.
pub(crate) struct Job<'a, D: Layout, S: SpinState, K: KindSet, L: ContactLaw<D, S>, T: Tally> {
    /// All grains and the dummy at the end.
    pub lines: &'a [Line],
    /// Their spins where a line has no room for it, else empty.
    pub spins: &'a [Line],
    /// The chunk's list; every index in it is below `lines.len()`.
    pub list: &'a ChunkList,
    /// Index of the chunk's first grain.
    pub first: usize,
    /// Pair constants, kinds × kinds.
    pub pairs: &'a [L::Pair],
    /// Number of kinds.
    pub kinds: usize,
    /// True if all pairs are equal, such as those of free and fixed grains.
    pub alike: bool,
    /// Weight of each kind.
    pub weights: &'a [D::V],
    pub domain: Domain<D>,
    pub dt: f64,
    /// True if the step is taken, so that contacts remember it; else forces are only looked at.
    pub keep: bool,
    pub types: PhantomData<(S, K, T)>,
}

/// What the force loop of one chunk writes.
pub(crate) struct Out<'a, D: Layout, S: SpinState> {
    /// What the contacts of the list remember.
    pub memory: &'a mut [f64],
    pub force: &'a mut [D::V],
    /// Empty unless tallied.
    pub viscous: &'a mut [D::V],
    pub torque: &'a mut [S::Turn<D>],
}

/// The forces of [`contacts`], with a table of pairs only if they differ: the compiler makes no vector code of a look-up.
#[inline(always)]
pub(crate) fn chunk_forces<D, S, K, L, T, G, const WIDE: usize>(
    job: &Job<'_, D, S, K, L, T>,
    out: Out<'_, D, S>,
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    T: Tally,
    G: Gather,
{
    if K::INDEXED && !job.alike {
        contacts::<D, S, K, L, T, G, WIDE, true>(job, out);
    } else {
        contacts::<D, S, K, L, T, G, WIDE, false>(job, out);
    }
}

/// Contact forces and weight of the chunk's grains into `force`; their viscous part into `viscous` if tallied; their torque
/// and their memory if they have any.
///
/// Inlined into one function per vector path (`lanes`), so the compiler makes the loop over the
/// lanes vector code. Each block of eight is folded by a fixed tree and added to its grain in the
/// order of the list, so every path gives the same bits. `WIDE` lanes are in flight: with 32 registers
/// two blocks at once hide each other's latency, with 16 they would spill.
#[inline(always)]
fn contacts<D, S, K, L, T, G, const WIDE: usize, const TABLE: bool>(
    job: &Job<'_, D, S, K, L, T>,
    out: Out<'_, D, S>,
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    T: Tally,
    G: Gather,
{
    const { assert!(<L::Memory as Numbers>::N <= MOST_NUMBERS) };
    let numbers = const { <L::Memory as Numbers>::N };
    let axes = const { <S::Turn<D> as Vector>::AXES };
    let Out {
        memory,
        force,
        viscous,
        torque,
    } = out;
    let only = job.pairs[0];
    let domain = job.domain;
    for (slot, out) in force.iter_mut().enumerate() {
        *out = if K::INDEXED {
            job.weights[job.lines[job.first + slot].kind::<D>()]
        } else {
            job.weights[0]
        };
    }
    if T::ON {
        viscous.fill(D::V::ZERO);
    }
    torque.fill(S::Turn::<D>::ZERO);
    let together = const { WIDE / LANES };
    let blocks = job.list.blocks().chunks_exact(together);
    let owners = job.list.owners().chunks_exact(together);
    for (pass, (blocks, owners)) in blocks.zip(owners).enumerate() {
        let mut own = [[0.0f64; WIDE]; 8];
        let mut other = [[0.0f64; WIDE]; 8];
        for b in 0..together {
            let line = &job.lines[job.first + owners[b] as usize];
            for c in 0..8 {
                own[c][b * LANES..(b + 1) * LANES].fill(line.0[c]);
            }
            let columns = G::gather(job.lines, &blocks[b]);
            for c in 0..8 {
                other[c][b * LANES..(b + 1) * LANES].copy_from_slice(&columns.0[c]);
            }
        }
        let mut own_spin = [[0.0f64; WIDE]; 3];
        let mut other_spin = [[0.0f64; WIDE]; 3];
        if const { has_second_line::<D, S>() } {
            for b in 0..together {
                let line = &job.spins[job.first + owners[b] as usize];
                let columns = G::gather(job.spins, &blocks[b]);
                for c in 0..axes {
                    own_spin[c][b * LANES..(b + 1) * LANES].fill(line.0[D::SPIN + c]);
                    other_spin[c][b * LANES..(b + 1) * LANES]
                        .copy_from_slice(&columns.0[D::SPIN + c]);
                }
            }
        } else if axes > 0 {
            own_spin[0] = own[D::SPIN];
            other_spin[0] = other[D::SPIN];
        }
        let mut remembered = [[0.0f64; WIDE]; MOST_NUMBERS];
        let place = |b: usize, m: usize| ((pass * together + b) * numbers + m) * LANES;
        for b in 0..together {
            for m in 0..numbers {
                remembered[m][b * LANES..(b + 1) * LANES]
                    .copy_from_slice(&memory[place(b, m)..place(b, m) + LANES]);
            }
        }
        let mut twist_of = [[0.0f64; WIDE]; 3];
        let mut couple_of = [[0.0f64; WIDE]; 3];
        let mut push_of = [[0.0f64; WIDE]; 3];
        let mut lost_of = [[0.0f64; WIDE]; 3];
        for k in 0..WIDE {
            let apart = domain.nearest(D::V::from_axes(|a| {
                own[D::POSITION + a][k] - other[D::POSITION + a][k]
            }));
            let velocity = D::V::from_axes(|a| own[D::VELOCITY + a][k] - other[D::VELOCITY + a][k]);
            let touch = Touch::<D, S> {
                apart,
                velocity,
                r2: apart.length_squared(),
                reach: own[D::RADIUS][k] + other[D::RADIUS][k],
                spin: turn_sum::<D, S, WIDE>(
                    [own[D::RADIUS][k], other[D::RADIUS][k]],
                    [&own_spin, &other_spin],
                    k,
                ),
                roll: S::Turn::<D>::from_axes(|a| own_spin[a][k] - other_spin[a][k]),
            };
            let pair = if TABLE {
                job.pairs[own[D::KIND][k] as usize * job.kinds + other[D::KIND][k] as usize]
            } else {
                only
            };
            let mut memory = remember::<L::Memory, WIDE>(&remembered, k);
            let push = L::force(&pair, &touch, &mut memory, job.dt);
            keep(&mut remembered, k, &memory);
            put(&mut push_of, k, push.total());
            put(&mut twist_of, k, push.twist);
            if const { L::ROLLS } {
                put(&mut couple_of, k, push.couple);
            }
            if T::ON {
                put(&mut lost_of, k, push.viscous);
            }
        }
        if numbers > 0 && job.keep {
            for b in 0..together {
                for m in 0..numbers {
                    memory[place(b, m)..place(b, m) + LANES]
                        .copy_from_slice(&remembered[m][b * LANES..(b + 1) * LANES]);
                }
            }
        }
        for b in 0..together {
            let slot = owners[b] as usize;
            if axes > 0 {
                let twist = S::Turn::<D>::from_axes(|a| fold::<G, WIDE>(&twist_of[a], b));
                torque[slot] += twist * own[D::RADIUS][b * LANES];
                if const { L::ROLLS } {
                    torque[slot] += S::Turn::<D>::from_axes(|a| fold::<G, WIDE>(&couple_of[a], b));
                }
            }
            force[slot] += D::V::from_axes(|a| fold::<G, WIDE>(&push_of[a], b));
            if T::ON {
                viscous[slot] += D::V::from_axes(|a| fold::<G, WIDE>(&lost_of[a], b));
            }
        }
    }
}

/// Lane `k` of a vector, coordinate by coordinate: written out, since a loop here would keep the
/// loop over the lanes from becoming vector code.
#[inline(always)]
fn put<V: Vector, const WIDE: usize>(lanes: &mut [[f64; WIDE]; 3], k: usize, v: V) {
    if V::AXES > 0 {
        lanes[0][k] = v.axis(0);
    }
    if V::AXES > 1 {
        lanes[1][k] = v.axis(1);
    }
    if V::AXES > 2 {
        lanes[2][k] = v.axis(2);
    }
}

/// r_i ω_i + r_j ω_j of lane `k`.
#[inline(always)]
fn turn_sum<D: Layout, S: SpinState, const WIDE: usize>(
    radii: [f64; 2],
    spins: [&[[f64; WIDE]; 3]; 2],
    k: usize,
) -> S::Turn<D> {
    S::Turn::<D>::from_axes(|a| radii[0] * spins[0][a][k] + radii[1] * spins[1][a][k])
}

/// Memory of lane `k`, written out as in [`put`].
#[inline(always)]
fn remember<M: Numbers, const WIDE: usize>(lanes: &[[f64; WIDE]; MOST_NUMBERS], k: usize) -> M {
    let mut memory = M::zero();
    macro_rules! number {
        ($($m:literal)*) => { $(if M::N > $m { memory.set($m, lanes[$m][k]); })* };
    }
    number!(0 1 2 3 4 5 6 7);
    memory
}

/// Puts the memory of lane `k` back.
#[inline(always)]
fn keep<M: Numbers, const WIDE: usize>(
    lanes: &mut [[f64; WIDE]; MOST_NUMBERS],
    k: usize,
    memory: &M,
) {
    macro_rules! number {
        ($($m:literal)*) => { $(if M::N > $m { lanes[$m][k] = memory.get($m); })* };
    }
    number!(0 1 2 3 4 5 6 7);
}

/// The sum over the eight lanes of block `b`.
#[inline(always)]
fn fold<G: Gather, const WIDE: usize>(lanes: &[f64; WIDE], b: usize) -> f64 {
    let mut eight = [0.0; LANES];
    eight.copy_from_slice(&lanes[b * LANES..(b + 1) * LANES]);
    G::fold(eight)
}
