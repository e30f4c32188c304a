//! When and how the lists are built anew. Nothing here looks at a clock or a number of threads.

use crate::chunk::{CHUNK, Chunk, each_chunk};
use crate::kinds::KindSet;
use crate::line::{Layout, has_second_line};
use crate::world::{Tally, World};
use tsubu_model::{ContactLaw, Numbers, SpinState, Vector};
use tsubu_neighbors::{CellGrid, Kept, Reorder};

/// Lists that live shorter than this many steps get a wider skin, longer than the second a narrower one.
const LIFE: (u64, u64) = (24, 400);

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// After a drift: builds the lists anew if some grain may have moved by half the skin.
    /// The largest speed of each step bounds the path; the true displacements are looked at only
    /// when that bound is used up.
    pub(crate) fn keep_lists_valid(&mut self) {
        self.note_trouble();
        let fastest = self
            .chunks
            .iter()
            .map(|c| c.fastest2)
            .fold(0.0, f64::max)
            .sqrt();
        self.moved += fastest * self.dt();
        let near_is_due = self.near_is_due();
        if self.lists_are_due() {
            self.adapt_skin();
            self.build_lists();
        } else if near_is_due {
            self.note_near_bodies();
        }
    }

    /// True if some grain has moved by nearly half the skin since the lists were built.
    fn lists_are_due(&mut self) -> bool {
        let half = 0.5 * self.skin;
        if self.moved <= half {
            return false;
        }
        let furthest2 = self
            .lines
            .iter()
            .zip(&self.home)
            .map(|(line, home)| (line.position::<D>() - *home).length_squared())
            .fold(0.0, f64::max);
        self.moved = furthest2.sqrt();
        // Close to the end there would be a look at every step: build now.
        self.moved > 0.85 * half || self.moved.is_nan()
    }

    fn adapt_skin(&mut self) {
        if self.skin_is_fixed {
            return;
        }
        let lived = self.steps.saturating_sub(self.built_at);
        if lived < LIFE.0 {
            self.skin = (self.skin * 1.2).min(0.35 * self.range);
        } else if lived > LIFE.1 {
            self.skin = (self.skin * 0.85).max(0.03 * self.range);
        }
    }

    /// Wraps, sorts in space, builds the list of every chunk and notes who is near which body.
    pub(crate) fn build_lists(&mut self) {
        let n = self.identity.len();
        self.take_memory(|_| false);
        self.fit_chunks();
        for line in &mut self.lines[..n] {
            line.set_position::<D>(self.domain.wrap(line.position::<D>()));
        }
        let cut = self.range + self.skin;
        let lines = &self.lines;
        let grid = CellGrid::new(&self.domain, n, |i| lines[i].position::<D>(), cut);
        let mut reorder = Reorder::default();
        reorder.apply(&grid.order, &mut self.lines[..n]);
        reorder.apply(&grid.order, &mut self.identity);
        if const { has_second_line::<D, S>() } {
            reorder.apply(&grid.order, &mut self.spins[..n]);
        }
        let lines = &self.lines;
        for (home, line) in self.home.iter_mut().zip(lines) {
            *home = line.position::<D>();
        }
        let domain = self.domain;
        let work = |number: usize, chunk: &mut Chunk<D>| {
            let own = number * CHUNK..((number + 1) * CHUNK).min(n);
            chunk.list.build(
                &grid,
                &domain,
                own.clone(),
                |i| lines[i].position::<D>(),
                cut,
                n as u32,
            );
            // The fenced module reads lines by these indices without looking again.
            let list = &chunk.list;
            let slots = list.parts().into_iter().flat_map(|(groups, _)| groups);
            let mut slots = slots.flat_map(|group| group.slots);
            assert!(list.blocks().iter().flatten().all(|&j| j as usize <= n));
            assert!(slots.all(|slot| own.start + usize::from(slot) < own.end));
        };
        each_chunk(&mut self.chunks, n, work);
        self.recall_memory(&grid.order);
        self.note_near_bodies();
        self.build_scratch = grid.bytes() + reorder.bytes();
        self.moved = 0.0;
        self.built_at = self.steps;
        self.builds += 1;
    }

    /// Takes what contacts remember from the lists, unless that is done; those of a grain for which `forget` holds are
    /// left behind.
    pub(crate) fn take_memory(&mut self, forget: impl Fn(u32) -> bool + Sync) {
        if const { !remembers::<D, S, L, W>() } || self.memory_is_taken {
            return;
        }
        self.memory_is_taken = true;
        let n = self.identity.len();
        self.origin = (0..n as u32).collect();
        self.kept.resize_with(self.chunks.len(), Kept::default);
        let identity = &self.identity;
        for (number, (kept, chunk)) in self.kept.iter_mut().zip(&mut self.chunks).enumerate() {
            let first = number * CHUNK;
            let grains = CHUNK.min(n - first);
            let gone = |slot: usize, partner| forget(identity[first + slot]) || forget(partner);
            kept.take(&chunk.list, &chunk.memory, grains, |i| identity[i], gone);
            self.wall_kept.extend(
                chunk.wall_memory[0]
                    .drain(..)
                    .filter(|entry| !forget(entry.grain)),
            );
        }
        // Stable: the contacts of a grain keep their order.
        self.wall_kept.sort_by_key(|entry| entry.grain);
    }

    /// Puts what contacts remember beside the new lists; `order[new]` is the place before they were built.
    fn recall_memory(&mut self, order: &[u32]) {
        if const { !remembers::<D, S, L, W>() } {
            return;
        }
        let n = self.identity.len();
        let (kept, origin, identity, walls) =
            (&self.kept, &self.origin, &self.identity, &self.wall_kept);
        let work = |number: usize, chunk: &mut Chunk<D>| {
            let first = number * CHUNK;
            let former = |slot: usize| {
                let was = origin[order[first + slot] as usize] as usize;
                let kept = kept.get(was / CHUNK)?;
                Some((kept, was % CHUNK))
            };
            chunk
                .memory
                .recall(&chunk.list, L::Memory::N, former, |i| identity[i]);
            chunk.wall_memory[0].clear();
            for grain in &identity[first..(first + CHUNK).min(n)] {
                let from = walls.partition_point(|entry| entry.grain < *grain);
                let own = walls[from..]
                    .iter()
                    .take_while(|entry| entry.grain == *grain);
                chunk.wall_memory[0].extend(own);
            }
        };
        each_chunk(&mut self.chunks, n, work);
        self.memory_is_taken = false;
        self.wall_kept.clear();
    }
}

/// True if contacts of grains or of walls remember anything.
const fn remembers<D: Layout, S: SpinState, L: ContactLaw<D, S>, W: ContactLaw<D, S>>() -> bool {
    <L::Memory as Numbers>::N + <W::Memory as Numbers>::N > 0
}
