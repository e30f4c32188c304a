//! The padded full list of one chunk of grains.

use crate::CellGrid;
use std::ops::Range;
use tsubu_model::{Dim, Domain, Vector};

/// Partners per block: the force loop works on eight contacts at once.
pub const LANES: usize = 8;

/// Partners of a run of grains, in blocks of eight. Each block belongs to one grain of the run (its
/// slot); the blocks of a grain follow each other, and the number of blocks is even.
#[derive(Clone, Debug, Default)]
pub struct ChunkList {
    blocks: Vec<[u32; LANES]>,
    owners: Vec<u16>,
    entries: usize,
    dummy: u32,
}

impl ChunkList {
    /// Lists every grain within `cut` of each grain of `own` (indices in sorted order, at most 65536).
    /// `dummy` fills the last block of a grain: the index of a grain far away from everything.
    pub fn build<D: Dim>(
        &mut self,
        grid: &CellGrid<D>,
        domain: &Domain<D>,
        own: Range<usize>,
        position: impl Fn(usize) -> D::V,
        cut: f64,
        dummy: u32,
    ) {
        self.blocks.clear();
        self.owners.clear();
        self.entries = 0;
        self.dummy = dummy;
        let cut2 = cut * cut;
        for (slot, i) in own.enumerate() {
            let x = position(i);
            let mut block = [dummy; LANES];
            let mut filled = 0;
            grid.near(x, |range| {
                for j in range {
                    let apart = domain.nearest(x - position(j));
                    if apart.length_squared() < cut2 && j != i {
                        block[filled] = j as u32;
                        filled += 1;
                        if filled == LANES {
                            self.push(slot, block, LANES);
                            block = [dummy; LANES];
                            filled = 0;
                        }
                    }
                }
            });
            if filled > 0 {
                self.push(slot, block, filled);
            }
        }
        if self.blocks.len() % 2 == 1 {
            self.push(
                self.owners.last().map_or(0, |&o| o as usize),
                [dummy; LANES],
                0,
            );
        }
        // Keep a little room for the next build, not the doubling of a growing vector.
        if self.blocks.capacity() > self.blocks.len() + self.blocks.len() / 16 + 8 {
            let room = self.blocks.len() + self.blocks.len() / 32;
            self.blocks.shrink_to(room);
            self.owners.shrink_to(room);
        }
    }

    fn push(&mut self, slot: usize, block: [u32; LANES], filled: usize) {
        self.blocks.push(block);
        self.owners.push(slot as u16);
        self.entries += filled;
    }

    /// Blocks, an even number.
    #[inline(always)]
    pub fn blocks(&self) -> &[[u32; LANES]] {
        &self.blocks
    }

    /// Slot of the grain that each block belongs to.
    #[inline(always)]
    pub fn owners(&self) -> &[u16] {
        &self.owners
    }

    /// Every entry as (slot, partner), without the padding.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize)> {
        self.entries_in_blocks().map(|(_, _, slot, j)| (slot, j))
    }

    /// Every entry as (block, lane, slot, partner), without the padding.
    pub fn entries_in_blocks(&self) -> impl Iterator<Item = (usize, usize, usize, usize)> {
        let dummy = self.dummy;
        let blocks = self.owners.iter().zip(&self.blocks).enumerate();
        blocks.flat_map(move |(number, (&slot, block))| {
            let lanes = block.iter().enumerate();
            lanes
                .filter(move |&(_, &j)| j != dummy)
                .map(move |(lane, &j)| (number, lane, slot as usize, j as usize))
        })
    }

    /// Entries without padding.
    pub fn entries(&self) -> usize {
        self.entries
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        2 * self.owners.capacity() + 4 * LANES * self.blocks.capacity()
    }
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
