//! What contacts remember, beside the list of a chunk, and how it finds its way into the next list.

use crate::{ChunkList, LANES};

/// One number of the eight contacts of a block, a cache line of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Eight(pub [f64; LANES]);

/// The numbers that a law remembers of each listed contact, in blocks of eight as the list has them.
#[derive(Clone, Debug, Default)]
pub struct ChunkMemory {
    numbers: usize,
    values: Vec<Eight>,
}

impl ChunkMemory {
    /// Room for a list, `numbers` for each contact, all zero.
    pub fn fit(&mut self, list: &ChunkList, numbers: usize) {
        self.numbers = numbers;
        self.values.clear();
        self.values
            .resize(list.blocks().len() * numbers, Eight::default());
    }

    /// Everything: number m of block b is `[b · numbers + m]`.
    #[inline(always)]
    pub fn values_mut(&mut self) -> &mut [Eight] {
        &mut self.values
    }

    /// Number m of a lane of a block.
    pub fn get(&self, block: usize, lane: usize, m: usize) -> f64 {
        self.values[block * self.numbers + m].0[lane]
    }

    /// Sets number m of a lane of a block.
    pub fn set(&mut self, block: usize, lane: usize, m: usize, value: f64) {
        self.values[block * self.numbers + m].0[lane] = value;
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of::<Eight>() * self.values.capacity()
    }
}

/// The contacts of one chunk that remember something, while lists are built anew: by the slot of the grain
/// and the identity of its partner.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    numbers: usize,
    /// Where the contacts of each slot begin, and the end.
    starts: Vec<u32>,
    partners: Vec<u32>,
    values: Vec<f64>,
}

impl Kept {
    /// Takes what is not zero from the memory of a list over `grains` grains. `identity` is that of a sorted grain;
    /// a pair for which `forget` holds is left out.
    pub fn take(
        &mut self,
        list: &ChunkList,
        memory: &ChunkMemory,
        grains: usize,
        identity: impl Fn(usize) -> u32,
        forget: impl Fn(usize, u32) -> bool,
    ) {
        let numbers = memory.numbers;
        self.numbers = numbers;
        let found = || {
            list.entries_in_blocks()
                .filter_map(|(block, lane, slot, j)| {
                    let empty = (0..numbers).all(|m| memory.get(block, lane, m) == 0.0);
                    let partner = identity(j);
                    (!empty && !forget(slot, partner)).then_some((block, lane, slot, partner))
                })
        };
        // A counting sort by slot: first how many each has, then where those of each begin.
        self.starts.clear();
        self.starts.resize(grains + 1, 0);
        for (_, _, slot, _) in found() {
            self.starts[slot + 1] += 1;
        }
        for slot in 0..grains {
            self.starts[slot + 1] += self.starts[slot];
        }
        let all = self.starts[grains] as usize;
        self.partners.clear();
        self.partners.resize(all, 0);
        self.values.clear();
        self.values.resize(all * numbers, 0.0);
        let mut next = self.starts.clone();
        for (block, lane, slot, partner) in found() {
            let at = next[slot] as usize;
            next[slot] += 1;
            self.partners[at] = partner;
            for m in 0..numbers {
                self.values[at * numbers + m] = memory.get(block, lane, m);
            }
        }
    }

    /// What the grain at `slot` remembers of its contact with `partner`.
    fn find(&self, slot: usize, partner: u32) -> Option<&[f64]> {
        let (from, to) = (self.starts[slot] as usize, self.starts[slot + 1] as usize);
        let at = from + self.partners[from..to].iter().position(|&p| p == partner)?;
        Some(&self.values[at * self.numbers..(at + 1) * self.numbers])
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        4 * (self.starts.capacity() + self.partners.capacity()) + 8 * self.values.capacity()
    }
}

impl ChunkMemory {
    /// Room for a new list, and in it what its contacts remembered. `former` gives the chunk's former contacts and slot of
    /// the grain that now has this slot, if it had any; `identity` is that of a sorted grain.
    pub fn recall<'k>(
        &mut self,
        list: &ChunkList,
        numbers: usize,
        former: impl Fn(usize) -> Option<(&'k Kept, usize)>,
        identity: impl Fn(usize) -> u32,
    ) {
        self.fit(list, numbers);
        for (block, lane, slot, j) in list.entries_in_blocks() {
            let found = former(slot).and_then(|(kept, was)| kept.find(was, identity(j)));
            for (m, &value) in found.unwrap_or_default().iter().enumerate() {
                self.set(block, lane, m, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CellGrid;
    use glam::DVec2;
    use proptest::prelude::*;
    use std::collections::BTreeMap;
    use tsubu_model::{Domain, Plane};

    /// A list in two chunks over points, the grain at place k being `identity[k]`.
    fn lists(points: &[DVec2], half: usize, cut: f64) -> (Vec<u32>, [ChunkList; 2]) {
        let domain = Domain::<Plane>::open();
        let grid = CellGrid::new(&domain, points.len(), |i| points[i], cut);
        let sorted: Vec<DVec2> = grid.order.iter().map(|&o| points[o as usize]).collect();
        let mut lists = [ChunkList::default(), ChunkList::default()];
        for (list, own) in lists.iter_mut().zip([0..half, half..points.len()]) {
            list.build(&grid, &domain, own, |i| sorted[i], cut, points.len() as u32);
        }
        (grid.order, lists)
    }

    proptest! {
        /// Grains move at random between two lists; whoever is listed again remembers, whoever is not does not.
        #[test]
        fn memory_survives_a_rebuild(
            steps in prop::collection::vec((0.0..4.0f64, 0.0..4.0f64, -0.3..0.3f64, -0.3..0.3f64), 2..60), gone in 0u32..60,
        ) {
            let before: Vec<DVec2> = steps.iter().map(|s| DVec2::new(s.0, s.1)).collect();
            let after: Vec<DVec2> = steps.iter().map(|s| DVec2::new(s.0 + s.2, s.1 + s.3)).collect();
            let half = steps.len() / 2;
            let (order, old) = lists(&before, half, 0.8);
            let (mut truth, mut kept) = (BTreeMap::new(), Vec::new());
            for (list, first) in old.iter().zip([0, half]) {
                let mut memory = ChunkMemory::default();
                memory.fit(list, 2);
                for (block, lane, slot, j) in list.entries_in_blocks() {
                    let (own, partner) = (order[first + slot], order[j]);
                    // Every third has not touched and remembers nothing.
                    if (own + partner) % 3 > 0 {
                        let value = f64::from(100 * own + partner);
                        memory.set(block, lane, 0, value);
                        memory.set(block, lane, 1, -value);
                        truth.insert((own, partner), value);
                    }
                }
                let grains = if first == 0 { half } else { steps.len() - half };
                let mut taken = Kept::default();
                let lost = |slot: usize, partner| partner == gone || order[first + slot] == gone;
                taken.take(list, &memory, grains, |i| order[i], lost);
                kept.push(taken);
            }
            let (now, new) = lists(&after, half, 0.8);
            // Where each grain was in the old order.
            let was: BTreeMap<u32, usize> = order.iter().enumerate().map(|(at, &id)| (id, at)).collect();
            for (list, first) in new.iter().zip([0, half]) {
                let mut memory = ChunkMemory::default();
                let former = |slot: usize| {
                    let at = was[&now[first + slot]];
                    Some(if at < half { (&kept[0], at) } else { (&kept[1], at - half) })
                };
                memory.recall(list, 2, former, |i| now[i]);
                for (block, lane, slot, j) in list.entries_in_blocks() {
                    let pair = (now[first + slot], now[j]);
                    let lost = pair.0 == gone || pair.1 == gone;
                    let expected = truth.get(&pair).filter(|_| !lost).copied().unwrap_or(0.0);
                    prop_assert_eq!(memory.get(block, lane, 0), expected);
                    prop_assert_eq!(memory.get(block, lane, 1), -expected);
                }
            }
        }
    }
}
