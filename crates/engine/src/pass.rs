//! The force loop over one chunk of grains: eight contacts at a time.
#![allow(clippy::needless_range_loop)] // lanes of many arrays are indexed in step

use crate::kinds::KindSet;
use crate::lanes::Gather;
use crate::line::{Layout, Line};
use crate::world::Tally;
use std::marker::PhantomData;
use tsubu_model::{ContactLaw, Domain, Numbers, SpinState, Touch, Vector};
use tsubu_neighbors::{ChunkList, LANES};

/// What the force loop of one chunk reads.
pub(crate) struct Job<'a, D: Layout, S: SpinState, K: KindSet, L: ContactLaw<D, S>, T: Tally> {
    /// All grains and the dummy at the end.
    pub lines: &'a [Line],
    /// The chunk's list; every index in it is below `lines.len()`.
    pub list: &'a ChunkList,
    /// Index of the chunk's first grain.
    pub first: usize,
    /// Pair constants, kinds × kinds.
    pub pairs: &'a [L::Pair],
    /// Number of kinds.
    pub kinds: usize,
    /// Weight of each kind.
    pub weights: &'a [D::V],
    pub domain: Domain<D>,
    pub dt: f64,
    pub types: PhantomData<(S, K, T)>,
}

/// Contact forces and weight of the chunk's grains into `force`; their viscous part into `viscous` if tallied.
///
/// Inlined into one function per vector path (`lanes`), so the compiler makes the loop over the
/// lanes vector code. Each block of eight is folded by a fixed tree and added to its grain in the
/// order of the list, so every path gives the same bits. `WIDE` lanes are in flight: with 32 registers
/// two blocks at once hide each other's latency, with 16 they would spill.
#[inline(always)]
pub(crate) fn chunk_forces<D, S, K, L, T, G, const WIDE: usize>(
    job: &Job<'_, D, S, K, L, T>,
    force: &mut [D::V],
    viscous: &mut [D::V],
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    T: Tally,
    G: Gather,
{
    const {
        assert!(
            <L::Memory as Numbers>::N == 0,
            "contact memory comes with the first law that has some"
        )
    };
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
    let together = const { WIDE / LANES };
    let blocks = job.list.blocks().chunks_exact(together);
    let owners = job.list.owners().chunks_exact(together);
    for (blocks, owners) in blocks.zip(owners) {
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
                spin: Default::default(),
            };
            let pair = if K::INDEXED {
                job.pairs[own[D::KIND][k] as usize * job.kinds + other[D::KIND][k] as usize]
            } else {
                only
            };
            let push = L::force(&pair, &touch, &mut L::Memory::zero(), job.dt);
            put(&mut push_of, k, push.total());
            if T::ON {
                put(&mut lost_of, k, push.viscous);
            }
        }
        for b in 0..together {
            let slot = owners[b] as usize;
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
    lanes[0][k] = v.axis(0);
    lanes[1][k] = v.axis(1);
    if V::AXES > 2 {
        lanes[2][k] = v.axis(2);
    }
}

/// The sum over the eight lanes of block `b`.
#[inline(always)]
fn fold<G: Gather, const WIDE: usize>(lanes: &[f64; WIDE], b: usize) -> f64 {
    let mut eight = [0.0; LANES];
    eight.copy_from_slice(&lanes[b * LANES..(b + 1) * LANES]);
    G::fold(eight)
}
