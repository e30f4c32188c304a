//! The state of a world, saved and taken back: from there on it takes the steps that it would have taken.
//!
//! Lists are not written. They follow from the order of the grains, where each was when they were built, and the skin;
//! what contacts remember is written by partner and finds its place in the lists built again. Which grains are near
//! which body is noted anew: a list of them may only leave out grains that cannot touch, so it changes no bit.

use crate::chunk::{CHUNK, Chunk, Load, WallMemory, WallPart};
use crate::health::Health;
use crate::kinds::KindSet;
use crate::line::{Layout, Line, has_second_line};
use crate::walls::Body;
use crate::world::{Tally, World};
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use tsubu_model::{
    ContactLaw, Damaged, MOST_NUMBERS, Numbers, Pose, Saved, Span, SpinState, Vector, View, Words,
};

impl<D, S, K, L, W, T> Saved for World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    fn save(&self, words: &mut Words) {
        words.put_part("world");
        words.put_whole(self.steps);
        words.put_whole(self.built_at);
        words.put_whole(self.builds);
        words.put_number(self.skin);
        words.put_number(self.moved);
        words.put_number(self.taken_by_removal);
        words.put_number(self.brought_by_grains);
        for sum in self.closed_books {
            words.put_number(sum);
        }
        self.save_bodies(words);
        self.save_passages(words);
        self.save_grains(words);
        self.save_chunks(words);
        self.save_contacts(words);
        words.put_part("loads");
        words.put_whole(self.loads.len() as u64);
        for load in &self.loads {
            load.save(words);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("world")?;
        self.steps = words.take_whole()?;
        let (built_at, builds) = (words.take_whole()?, words.take_whole()?);
        self.take_skin(words)?;
        let moved = words.take_number()?;
        self.taken_by_removal = words.take_number()?;
        self.brought_by_grains = words.take_number()?;
        for sum in &mut self.closed_books {
            *sum = words.take_number()?;
        }
        let poses = self.take_bodies(words)?;
        self.take_passages(words)?;
        let (now, forces) = self.take_grains(words)?;
        self.drifted = false;
        self.health = Health::Fine;
        self.build_lists_again()?;
        // Now the grains go where they are.
        for (line, x) in self.lines.iter_mut().zip(&now) {
            line.set_position::<D>(*x);
        }
        [self.force, self.viscous] = forces;
        (self.moved, self.built_at, self.builds) = (moved, built_at, builds);
        self.in_pool(Self::note_near_bodies);
        self.poses = poses;
        self.take_chunks(words)?;
        self.take_contacts(words)?;
        words.take_part("loads")?;
        words.take_same(self.loads.len(), "loads")?;
        for load in &mut self.loads {
            load.restore(words)?;
        }
        Ok(())
    }
}

/// Where the grains are, and the forces and their viscous parts of the last step.
type Taken<V> = (Vec<V>, [Vec<V>; 2]);

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    fn take_skin(&mut self, words: &mut Words) -> Result<(), Damaged> {
        let skin = words.take_number()?;
        let sound = if self.skin_is_fixed {
            skin == self.skin
        } else {
            skin > 0.0 && skin <= 0.35 * self.range
        };
        if !sound {
            return Err(Damaged(format!(
                "the skin of the lists, {skin} m, is none that this scene can have"
            )));
        }
        self.skin = skin;
        Ok(())
    }

    fn save_bodies(&self, words: &mut Words) {
        words.put_part("bodies");
        words.put_whole(self.bodies.len() as u64);
        for (body, pose) in self.bodies.iter().zip(&self.poses) {
            words.put_maybe(body.removed_at);
            words.put_flag(body.waits);
            for span in spans(body) {
                words.put_number(span.start);
                words.put_number(span.stop);
            }
            pose.save(words);
        }
    }

    fn take_bodies(&mut self, words: &mut Words) -> Result<Vec<Pose>, Damaged> {
        words.take_part("bodies")?;
        words.take_same(self.bodies.len(), "bodies")?;
        let mut poses = Vec::with_capacity(self.bodies.len());
        for body in &mut self.bodies {
            body.removed_at = words.take_maybe()?;
            body.waits = words.take_flag()?;
            let turn = body.motion.turn.iter_mut().map(|turn| &mut turn.span);
            for span in turn.chain(body.motion.shifts.iter_mut().map(|shift| &mut shift.span)) {
                (span.start, span.stop) = (words.take_number()?, words.take_number()?);
            }
            let mut pose = Pose::default();
            pose.restore(words)?;
            poses.push(pose);
        }
        Ok(poses)
    }

    fn save_passages(&self, words: &mut Words) {
        words.put_part("passages");
        words.put_whole(self.passages.len() as u64);
        for gate in &self.passages {
            gate.save(words);
        }
    }

    fn take_passages(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("passages")?;
        words.take_same(self.passages.len(), "gates")?;
        for gate in &mut self.passages {
            gate.restore(words)?;
        }
        Ok(())
    }

    fn save_grains(&self, words: &mut Words) {
        words.put_part("grains");
        words.put_whole(u64::from(self.next_identity));
        words.put_whole(self.identity.len() as u64);
        for (i, &identity) in self.identity.iter().enumerate() {
            let line = &self.lines[i];
            words.put_whole(u64::from(identity));
            words.put_whole(line.kind::<D>() as u64);
            words.put_vector(line.position::<D>());
            words.put_vector(line.velocity::<D>());
            words.put_vector(View::spin(self, i));
            words.put_vector(self.home[i]);
            // The next kick may begin with the forces of this step.
            words.put_vector(self.force[i]);
            words.put_vector(self.torque[i]);
            if T::ON {
                words.put_vector(self.viscous[i]);
            }
        }
    }

    /// Puts every grain in its place in the order, where it was when the lists were built; gives where it is now.
    fn take_grains(&mut self, words: &mut Words) -> Result<Taken<D::V>, Damaged> {
        words.take_part("grains")?;
        let next = words.take_index(u32::MAX as usize, "grain to come")?;
        let n = words.take_count(2 + 4 * D::V::AXES)?;
        if n > next {
            return Err(Damaged(format!("there are {n} grains of {next} numbers")));
        }
        let radii: Vec<f64> = self.kinds.all().iter().map(|kind| kind.radius).collect();
        let mut now = Vec::with_capacity(n);
        let (mut force, mut viscous) = (Vec::with_capacity(n), Vec::new());
        let mut met = HashSet::with_capacity(n);
        self.next_identity = next as u32;
        self.identity.clear();
        self.lines.clear();
        self.spins.clear();
        self.home.clear();
        self.torque.clear();
        for _ in 0..n {
            let identity = words.take_index(next, "grain")? as u32;
            if !met.insert(identity) {
                return Err(Damaged(format!("grain {identity} is there twice")));
            }
            let kind = words.take_index(radii.len(), "kind")?;
            now.push(words.take_vector::<D::V>()?);
            let velocity = words.take_vector::<D::V>()?;
            let spin = words.take_vector::<S::Turn<D>>()?;
            let home = words.take_vector::<D::V>()?;
            let mut line = Line::new::<D>(home, velocity, radii[kind], kind);
            if const { has_second_line::<D, S>() } {
                let mut second = Line([0.0; 8]);
                second.set_spin::<D, S>(spin);
                self.spins.push(second);
            } else {
                line.set_spin::<D, S>(spin);
            }
            self.identity.push(identity);
            self.lines.push(line);
            self.home.push(home);
            force.push(words.take_vector::<D::V>()?);
            self.torque.push(words.take_vector::<S::Turn<D>>()?);
            if T::ON {
                viscous.push(words.take_vector::<D::V>()?);
            }
        }
        self.lines.push(Line::dummy::<D>());
        if const { has_second_line::<D, S>() } {
            self.spins.push(Line([0.0; 8]));
        }
        Ok((now, [force, viscous]))
    }

    /// Builds the lists of the saved order; nothing that an earlier state remembers gets into them.
    fn build_lists_again(&mut self) -> Result<(), Damaged> {
        let n = self.identity.len();
        let bodies = self.bodies.len();
        let chunks = (0..n.div_ceil(CHUNK)).map(|_| Chunk::new(bodies));
        self.chunks = chunks.collect();
        self.force.resize(n, D::V::ZERO);
        self.viscous.resize(if T::ON { n } else { 0 }, D::V::ZERO);
        let solves = if self.scheme.sweeps() > 0 { n } else { 0 };
        self.base.resize(solves, D::V::ZERO);
        self.damping.resize(solves, 0.0);
        self.kept.clear();
        self.wall_kept.clear();
        self.origin = vec![u32::MAX; n];
        self.memory_is_taken = true;
        let saved = self.identity.clone();
        self.in_pool(Self::build_lists);
        self.memory_is_taken = false;
        if self.identity != saved {
            return Err(Damaged(
                "this program puts the grains in another order than the one that saved them".into(),
            ));
        }
        Ok(())
    }

    fn save_chunks(&self, words: &mut Words) {
        words.put_part("chunks");
        words.put_whole(self.chunks.len() as u64);
        for chunk in &self.chunks {
            for sum in chunk.books {
                words.put_number(sum);
            }
            words.put_number(chunk.last_sweep2);
            for load in &chunk.on_bodies {
                words.put_vector(load.force);
                words.put_vector(load.torque);
            }
            words.put_whole(chunk.wall_parts.len() as u64);
            for part in &chunk.wall_parts {
                words.put_whole(u64::from(part.slot));
                for vector in [part.viscous, part.slip, part.total, part.wall] {
                    words.put_vector(vector);
                }
            }
        }
    }

    fn take_chunks(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("chunks")?;
        words.take_same(self.chunks.len(), "chunks")?;
        let n = self.identity.len();
        for (number, chunk) in self.chunks.iter_mut().enumerate() {
            for sum in &mut chunk.books {
                *sum = words.take_number()?;
            }
            chunk.last_sweep2 = words.take_number()?;
            for load in &mut chunk.on_bodies {
                *load = Load {
                    force: words.take_vector()?,
                    torque: words.take_vector::<DVec3>()?,
                };
            }
            let grains = CHUNK.min(n - number * CHUNK);
            let parts = words.take_count(1 + 4 * D::V::AXES)?;
            chunk.wall_parts.clear();
            for _ in 0..parts {
                chunk.wall_parts.push(WallPart {
                    slot: words.take_index(grains, "slot")? as u32,
                    viscous: words.take_vector()?,
                    slip: words.take_vector()?,
                    total: words.take_vector()?,
                    wall: words.take_vector()?,
                });
            }
        }
        Ok(())
    }

    /// What contacts remember, bit by bit: a number that is zero only by its value is a number too.
    fn save_contacts(&self, words: &mut Words) {
        words.put_part("contacts");
        for (number, chunk) in self.chunks.iter().enumerate() {
            let mut entries = Words::new();
            let mut count = 0;
            for (block, lane, slot, j) in chunk.list.entries_in_blocks() {
                let numbers = || (0..L::Memory::N).map(|m| chunk.memory.get(block, lane, m));
                if numbers().all(|value| value.to_bits() == 0) {
                    continue;
                }
                count += 1;
                entries.put_whole((number * CHUNK + slot) as u64);
                entries.put_whole(u64::from(self.identity[j]));
                numbers().for_each(|value| entries.put_number(value));
            }
            words.put_whole(count);
            words.put_all(&entries);
            words.put_whole(chunk.wall_memory[0].len() as u64);
            for entry in &chunk.wall_memory[0] {
                for id in [entry.grain, entry.body, entry.feature] {
                    words.put_whole(u64::from(id));
                }
                entry.numbers[..W::Memory::N]
                    .iter()
                    .for_each(|&value| words.put_number(value));
            }
        }
    }

    fn take_contacts(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("contacts")?;
        let (identity, bodies) = (&self.identity, self.bodies.len());
        for (number, chunk) in self.chunks.iter_mut().enumerate() {
            let first = number * CHUNK;
            let count = words.take_count(2 + L::Memory::N)?;
            let mut kept = HashMap::with_capacity(count);
            for _ in 0..count {
                let grain = words.take_index(identity.len(), "grain in the order")?;
                let partner = words.take_index(self.next_identity as usize, "partner")? as u32;
                kept.insert((grain, partner), take_numbers(words, L::Memory::N)?);
            }
            chunk.memory.fit(&chunk.list, L::Memory::N);
            if L::Memory::N > 0 {
                for (block, lane, slot, j) in chunk.list.entries_in_blocks() {
                    if let Some(numbers) = kept.remove(&(first + slot, identity[j])) {
                        for (m, &value) in numbers[..L::Memory::N].iter().enumerate() {
                            chunk.memory.set(block, lane, m, value);
                        }
                    }
                }
            }
            if !kept.is_empty() {
                return Err(Damaged(format!(
                    "{} contacts are remembered that no list has",
                    kept.len()
                )));
            }
            let walls = words.take_count(3 + W::Memory::N)?;
            chunk.wall_memory[0].clear();
            for _ in 0..walls {
                chunk.wall_memory[0].push(WallMemory {
                    grain: words.take_index(self.next_identity as usize, "grain")? as u32,
                    body: words.take_index(bodies, "body")? as u32,
                    feature: words.take_index(u32::MAX as usize + 1, "feature")? as u32,
                    numbers: take_numbers(words, W::Memory::N)?,
                });
            }
        }
        Ok(())
    }
}

fn take_numbers(words: &mut Words, count: usize) -> Result<[f64; MOST_NUMBERS], Damaged> {
    let mut numbers = [0.0; MOST_NUMBERS];
    for number in &mut numbers[..count] {
        *number = words.take_number()?;
    }
    Ok(numbers)
}

/// When each part of a body's motion is on: what waits for a moment that was not known has learnt it.
fn spans<D: Layout, W>(body: &Body<D, W>) -> impl Iterator<Item = Span> {
    let turn = body.motion.turn.iter().map(|turn| turn.span);
    turn.chain(body.motion.shifts.iter().map(|shift| shift.span))
}
