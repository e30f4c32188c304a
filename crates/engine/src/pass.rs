//! The force loop over one chunk of grains: eight contacts at a time.
#![allow(clippy::needless_range_loop)] // lanes of many arrays are indexed in step

use crate::kinds::KindSet;
use crate::lanes::{self, Gather};
use crate::line::{Layout, Line, has_second_line};
use crate::world::Tally;
use std::marker::PhantomData;
use tsubu_model::{ContactLaw, Domain, MOST_NUMBERS, Numbers, SpinState, Touch, Vector};
use tsubu_neighbors::{ChunkList, Eight, Group, LANES};

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
    pub memory: &'a mut [Eight],
    pub force: &'a mut [D::V],
    /// Empty unless tallied.
    pub viscous: &'a mut [D::V],
    pub torque: &'a mut [S::Turn<D>],
}

/// Contact forces and weight of the chunk's grains into `force`; their viscous part into `viscous` if tallied; their torque
/// and their memory if they have any.
///
/// Inlined into one function per vector path (`lanes`), so the compiler makes the loop over the
/// lanes vector code. Each lane of a group is one grain and adds its contacts in the order of the list, so every path gives
/// the same bits and nothing is summed across lanes.
#[inline(always)]
pub(crate) fn chunk_forces<D, S, K, L, T, G>(job: &Job<'_, D, S, K, L, T>, out: Out<'_, D, S>)
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    T: Tally,
    G: Gather,
{
    const { assert!(<L::Memory as Numbers>::N <= MOST_NUMBERS) };
    let mut out = out;
    for (slot, force) in out.force.iter_mut().enumerate() {
        *force = if K::INDEXED {
            job.weights[job.lines[job.first + slot].kind::<D>()]
        } else {
            job.weights[0]
        };
    }
    // A group without a pair across a periodic face needs no image; pairs are looked up only if they differ.
    let [inside, across] = job.list.parts();
    let (near, far) = out
        .memory
        .split_at_mut(inside.1.len() * numbers::<D, S, L>());
    out.memory = near;
    if K::INDEXED && !job.alike {
        groups::<D, S, K, L, T, G, true, false>(job, inside, &mut out);
        out.memory = far;
        groups::<D, S, K, L, T, G, true, true>(job, across, &mut out);
    } else {
        groups::<D, S, K, L, T, G, false, false>(job, inside, &mut out);
        out.memory = far;
        groups::<D, S, K, L, T, G, false, true>(job, across, &mut out);
    }
}

/// How many numbers a contact remembers.
const fn numbers<D: Layout, S: SpinState, L: ContactLaw<D, S>>() -> usize {
    <L::Memory as Numbers>::N
}

/// How many blocks ahead lines are asked for where a block is long work, so that the machine itself does not look that far.
const AHEAD: usize = 3;

/// One number of each lane.
type Lane = [f64; LANES];

/// The contacts of some groups and their blocks, as in [`chunk_forces`].
#[inline(always)]
fn groups<D, S, K, L, T, G, const TABLE: bool, const IMAGES: bool>(
    job: &Job<'_, D, S, K, L, T>,
    (groups, blocks): (&[Group], &[[u32; LANES]]),
    out: &mut Out<'_, D, S>,
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    T: Tally,
    G: Gather,
{
    let numbers = const { numbers::<D, S, L>() };
    let axes = const { <S::Turn<D> as Vector>::AXES };
    let only = job.pairs[0];
    let domain = job.domain;
    let mut first_block = 0;
    for group in groups {
        let slots = group
            .slots
            .map(|slot| (job.first + usize::from(slot)) as u32);
        let own = G::gather(job.lines, &slots).0;
        let mut own_spin = [[0.0f64; LANES]; 3];
        if const { has_second_line::<D, S>() } {
            let columns = G::gather(job.spins, &slots);
            own_spin[..axes].copy_from_slice(&columns.0[D::SPIN..D::SPIN + axes]);
        } else if axes > 0 {
            own_spin[0] = own[D::SPIN];
        }
        let mut twist_of = [[0.0f64; LANES]; 3];
        let mut couple_of = [[0.0f64; LANES]; 3];
        let mut push_of = [[0.0f64; LANES]; 3];
        let mut lost_of = [[0.0f64; LANES]; 3];
        let last_block = first_block + usize::from(group.blocks);
        for (row, block) in blocks[first_block..last_block].iter().enumerate() {
            let other = G::gather(job.lines, block).0;
            let mut other_spin = [[0.0f64; LANES]; 3];
            if const { has_second_line::<D, S>() } {
                let columns = G::gather(job.spins, block);
                other_spin[..axes].copy_from_slice(&columns.0[D::SPIN..D::SPIN + axes]);
            } else if axes > 0 {
                other_spin[0] = other[D::SPIN];
            }
            let place = (first_block + row) * numbers;
            let later = blocks.get(first_block + row + AHEAD);
            if let Some(later) = later.filter(|_| const { has_second_line::<D, S>() }) {
                lanes::soon(job.lines, later);
                lanes::soon(job.spins, later);
            }
            let mut remembered = [[0.0f64; LANES]; MOST_NUMBERS];
            for m in 0..numbers {
                remembered[m] = out.memory[place + m].0;
            }
            // Looked up before the loop over the lanes, which a look-up would keep from becoming vector code.
            let pairs = if TABLE {
                std::array::from_fn(|k| {
                    let (of_own, of_other) = (own[D::KIND][k], other[D::KIND][k]);
                    job.pairs[of_own as usize * job.kinds + of_other as usize]
                })
            } else {
                [only; LANES]
            };
            for k in 0..LANES {
                let straight =
                    D::V::from_axes(|a| own[D::POSITION + a][k] - other[D::POSITION + a][k]);
                let apart = if IMAGES {
                    domain.nearest(straight)
                } else {
                    straight
                };
                let velocity =
                    D::V::from_axes(|a| own[D::VELOCITY + a][k] - other[D::VELOCITY + a][k]);
                let touch = Touch::<D, S> {
                    apart,
                    velocity,
                    r2: apart.length_squared(),
                    reach: own[D::RADIUS][k] + other[D::RADIUS][k],
                    spin: turn_sum::<D, S>(
                        [own[D::RADIUS][k], other[D::RADIUS][k]],
                        [&own_spin, &other_spin],
                        k,
                    ),
                    roll: S::Turn::<D>::from_axes(|a| own_spin[a][k] - other_spin[a][k]),
                };
                let pair = pairs[if TABLE { k } else { 0 }];
                let mut memory = remember::<L::Memory>(&remembered, k);
                let push = L::force(&pair, &touch, &mut memory, job.dt);
                keep(&mut remembered, k, &memory);
                add(&mut push_of, k, push.total());
                add(&mut twist_of, k, push.twist);
                if const { L::ROLLS } {
                    add(&mut couple_of, k, push.couple);
                }
                if T::ON {
                    add(&mut lost_of, k, push.viscous);
                }
            }
            if numbers > 0 && job.keep {
                for m in 0..numbers {
                    out.memory[place + m].0 = remembered[m];
                }
            }
        }
        first_block = last_block;
        for (k, &slot) in group
            .slots
            .iter()
            .enumerate()
            .take(usize::from(group.grains))
        {
            let slot = usize::from(slot);
            out.force[slot] += D::V::from_axes(|a| push_of[a][k]);
            if axes > 0 {
                out.torque[slot] = S::Turn::<D>::from_axes(|a| twist_of[a][k]) * own[D::RADIUS][k];
                if const { L::ROLLS } {
                    out.torque[slot] += S::Turn::<D>::from_axes(|a| couple_of[a][k]);
                }
            }
            if T::ON {
                out.viscous[slot] = D::V::from_axes(|a| lost_of[a][k]);
            }
        }
    }
}

/// Adds a vector to lane `k`, coordinate by coordinate: written out, since a loop here would keep the
/// loop over the lanes from becoming vector code.
#[inline(always)]
fn add<V: Vector>(lanes: &mut [Lane; 3], k: usize, v: V) {
    if V::AXES > 0 {
        lanes[0][k] += v.axis(0);
    }
    if V::AXES > 1 {
        lanes[1][k] += v.axis(1);
    }
    if V::AXES > 2 {
        lanes[2][k] += v.axis(2);
    }
}

/// r_i ω_i + r_j ω_j of lane `k`.
#[inline(always)]
fn turn_sum<D: Layout, S: SpinState>(
    radii: [f64; 2],
    spins: [&[Lane; 3]; 2],
    k: usize,
) -> S::Turn<D> {
    S::Turn::<D>::from_axes(|a| radii[0] * spins[0][a][k] + radii[1] * spins[1][a][k])
}

/// Memory of lane `k`, written out as in [`add`].
#[inline(always)]
fn remember<M: Numbers>(lanes: &[Lane; MOST_NUMBERS], k: usize) -> M {
    let mut memory = M::zero();
    macro_rules! number {
        ($($m:literal)*) => { $(if M::N > $m { memory.set($m, lanes[$m][k]); })* };
    }
    number!(0 1 2 3 4 5 6 7);
    memory
}

/// Puts the memory of lane `k` back.
#[inline(always)]
fn keep<M: Numbers>(lanes: &mut [Lane; MOST_NUMBERS], k: usize, memory: &M) {
    macro_rules! number {
        ($($m:literal)*) => { $(if M::N > $m { lanes[$m][k] = memory.get($m); })* };
    }
    number!(0 1 2 3 4 5 6 7);
}
