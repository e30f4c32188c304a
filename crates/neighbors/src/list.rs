//! The padded full list of one chunk of grains.

use crate::CellGrid;
use crate::halo::Halo;
use std::ops::Range;
use tsubu_model::{Dim, Domain, Vector};

/// Grains per group, and partners per block: the force loop works on eight contacts at once.
pub const LANES: usize = 8;

/// Eight grains of a run, one in each lane, and how many blocks of partners they have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// Slots of the grains; those beyond `grains` repeat the last and have no partners.
    pub slots: [u16; LANES],
    /// Blocks: partners of the grain that has most.
    pub blocks: u16,
    /// How many of the lanes have a grain.
    pub grains: u16,
}

/// Partners of a run of grains. Grains are taken eight at a time, one in each lane of a [`Group`]; block number b of a group
/// holds partner number b of each, so no sum over lanes is ever taken. Grains with equally many partners share a group,
/// so that few lanes are idle.
#[derive(Clone, Debug, Default)]
pub struct ChunkList {
    groups: Vec<Group>,
    blocks: Vec<[u32; LANES]>,
    /// Groups and blocks before these have no pair across a periodic face.
    inside: (usize, usize),
    entries: usize,
    dummy: u32,
}

impl ChunkList {
    /// Lists every grain within `cut` of each grain of `own` (indices in sorted order, at most 65536).
    /// `dummy` fills the lanes of grains with fewer partners: the index of a grain far away from everything.
    pub fn build<D: Dim>(
        &mut self,
        grid: &CellGrid<D>,
        domain: &Domain<D>,
        own: Range<usize>,
        position: impl Fn(usize) -> D::V,
        cut: f64,
        dummy: u32,
    ) {
        self.dummy = dummy;
        let cut2 = cut * cut;
        // Partners of all grains one after the other, where those of each end, and who has one across a periodic face.
        let mut partners: Vec<u32> = Vec::with_capacity(own.len() * 10);
        let mut ends: Vec<u32> = Vec::with_capacity(own.len());
        let mut order: Vec<(bool, u16, u16)> = Vec::with_capacity(own.len());
        let wide = grid.is_wide();
        let mut halo = Halo::new();
        for (slot, i) in own.enumerate() {
            let x = position(i);
            let before = partners.len();
            let mut across = false;
            if wide {
                let cell = grid.cell(x);
                halo.take(grid, domain, cell, &position);
                across = halo.partners::<D>((i, cell, x), cut2, &mut partners);
            } else {
                grid.near(x, |range| {
                    for j in range {
                        let straight = x - position(j);
                        if domain.nearest(straight).length_squared() < cut2 && j != i {
                            partners.push(j as u32);
                            across |= may_need_image(domain, straight, cut);
                        }
                    }
                });
            }
            ends.push(partners.len() as u32);
            order.push((across, (partners.len() - before) as u16, slot as u16));
        }
        self.entries = partners.len();
        // Most partners first inside, last across, so that where the two meet both are few; by slot where all else is equal.
        order.sort_unstable_by_key(|&(across, count, slot)| {
            (across, if across { count } else { u16::MAX - count }, slot)
        });
        self.lay(&order, &partners, &ends);
    }

    /// Puts grains in the given order into groups.
    fn lay(&mut self, order: &[(bool, u16, u16)], partners: &[u32], ends: &[u32]) {
        self.groups.clear();
        self.blocks.clear();
        self.inside = (0, 0);
        let blocks = |eight: &[(bool, u16, u16)]| eight.iter().map(|one| one.1).max();
        let all = order.chunks(LANES).filter_map(blocks).map(usize::from);
        let all = all.sum::<usize>();
        // As much as is needed, and no room for doubling; a little is kept between builds.
        if self.blocks.capacity() > all + all / 16 + 8 {
            self.blocks.shrink_to(all + all / 32);
        }
        self.blocks.reserve_exact(all);
        self.groups.reserve_exact(order.len().div_ceil(LANES));
        for eight in order.chunks(LANES) {
            let rows = usize::from(blocks(eight).unwrap_or(0));
            let last = eight[eight.len() - 1].2;
            let mut slots = [last; LANES];
            let first = self.blocks.len();
            self.blocks.resize(first + rows, [self.dummy; LANES]);
            for (lane, &(_, count, slot)) in eight.iter().enumerate() {
                slots[lane] = slot;
                let end = ends[usize::from(slot)] as usize;
                let own = &partners[end - usize::from(count)..end];
                for (block, &partner) in self.blocks[first..].iter_mut().zip(own) {
                    block[lane] = partner;
                }
            }
            self.groups.push(Group {
                slots,
                blocks: rows as u16,
                grains: eight.len() as u16,
            });
            if eight.iter().all(|one| !one.0) {
                self.inside = (self.groups.len(), self.blocks.len());
            }
        }
    }

    /// The groups in order, and the blocks of all one after the other: first those without a pair across a periodic
    /// face, for which the nearest image of a difference is the difference itself, then the others.
    #[inline(always)]
    pub fn parts(&self) -> [(&[Group], &[[u32; LANES]]); 2] {
        let (inside, across) = self.groups.split_at(self.inside.0);
        let (of_inside, of_across) = self.blocks.split_at(self.inside.1);
        [(inside, of_inside), (across, of_across)]
    }

    /// All blocks.
    #[inline(always)]
    pub fn blocks(&self) -> &[[u32; LANES]] {
        &self.blocks
    }

    /// Every entry as (slot, partner), without the padding.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize)> {
        self.entries_in_blocks().map(|(_, _, slot, j)| (slot, j))
    }

    /// Every entry as (block, lane, slot, partner), without the padding.
    pub fn entries_in_blocks(&self) -> impl Iterator<Item = (usize, usize, usize, usize)> {
        let dummy = self.dummy;
        let groups = self.groups.iter();
        let owners = groups.flat_map(|group| (0..group.blocks).map(move |_| group.slots));
        let blocks = owners.zip(&self.blocks).enumerate();
        blocks.flat_map(move |(number, (slots, block))| {
            let lanes = block.iter().enumerate();
            lanes
                .filter(move |&(_, &j)| j != dummy)
                .map(move |(lane, &j)| (number, lane, usize::from(slots[lane]), j as usize))
        })
    }

    /// Entries without padding.
    pub fn entries(&self) -> usize {
        self.entries
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of::<Group>() * self.groups.capacity() + 4 * LANES * self.blocks.capacity()
    }
}

/// True if the nearest image of a difference may become another than the difference itself, before either grain has moved
/// by half of `cut`.
fn may_need_image<D: Dim>(domain: &Domain<D>, straight: D::V, cut: f64) -> bool {
    (0..D::V::AXES).any(|a| straight.axis(a).abs() + cut > 0.5 * domain.period.axis(a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;
    use std::collections::BTreeSet;
    use tsubu_model::{Plane, Space};

    fn lists_are_all_pairs<D: Dim>(
        points: Vec<D::V>,
        domain: Domain<D>,
        cut: f64,
    ) -> Result<(), TestCaseError> {
        let n = points.len();
        let wrapped: Vec<D::V> = points.iter().map(|&p| domain.wrap(p)).collect();
        let grid = CellGrid::new(&domain, n, |i| wrapped[i], cut);
        let sorted: Vec<D::V> = grid.order.iter().map(|&o| wrapped[o as usize]).collect();
        prop_assert_eq!(
            grid.order.iter().copied().collect::<BTreeSet<_>>().len(),
            n,
            "the order is a permutation"
        );
        let mut list = ChunkList::default();
        list.build(&grid, &domain, 0..n, |i| sorted[i], cut, n as u32);
        for i in 0..n {
            let found: Vec<u32> = list
                .iter()
                .filter(|e| e.0 == i)
                .map(|e| e.1 as u32)
                .collect();
            let expected: BTreeSet<u32> = (0..n)
                .filter(|&j| {
                    j != i && domain.nearest(sorted[i] - sorted[j]).length_squared() < cut * cut
                })
                .map(|j| j as u32)
                .collect();
            prop_assert_eq!(found.len(), expected.len(), "each partner once");
            prop_assert_eq!(found.into_iter().collect::<BTreeSet<_>>(), expected);
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn space(points in prop::collection::vec((0.0..4.0f64, 0.0..4.0f64, -3.0..9.0f64), 0..120), cut in 0.3..1.9f64, open in any::<bool>()) {
            let period = if open { DVec3::INFINITY } else { DVec3::new(4.0, 4.0, f64::INFINITY) };
            let points = points.into_iter().map(|(x, y, z)| DVec3::new(x, y, z)).collect();
            lists_are_all_pairs::<Space>(points, Domain { period }, cut)?;
        }

        #[test]
        fn plane_with_a_stray_far_away(points in prop::collection::vec((0.0..4.0f64, 0.0..4.0f64), 1..80), far in 1e3..1e7f64) {
            let mut points: Vec<DVec2> = points.into_iter().map(|(x, y)| DVec2::new(x, y)).collect();
            points.push(DVec2::new(1.0, far));
            lists_are_all_pairs::<Plane>(points, Domain { period: DVec2::new(4.0, f64::INFINITY) }, 1.1)?;
        }
    }
}
