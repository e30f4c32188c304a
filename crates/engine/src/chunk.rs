//! A chunk: a fixed run of grains in sorted order, the unit of work of a thread.
//! Sums are kept chunk by chunk and added in order, so the number of threads changes no bit.

use glam::DVec3;
use rayon::prelude::*;
use tsubu_model::{Dim, HitBuffer, MOST_NUMBERS, Seen};
use tsubu_neighbors::{ChunkList, ChunkMemory};

/// Grains per chunk.
pub(crate) const CHUNK: usize = 512;

/// A grain that may touch a body before the next list build.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    pub body: u32,
    /// Position within the chunk.
    pub slot: u32,
    /// The two cannot touch until the chunk's grains and the body together may have moved so far, in m.
    pub asleep_until: f64,
}

/// The dissipative parts of one wall contact, kept for the tally until the kick.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallPart<D: Dim> {
    pub slot: u32,
    pub viscous: D::V,
    pub slip: D::V,
    pub total: D::V,
    /// Velocity of the wall at the contact.
    pub wall: D::V,
}

/// What a contact with a body remembers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallMemory {
    /// Identity of the grain.
    pub grain: u32,
    pub body: u32,
    /// Which part of the body's surface.
    pub feature: u32,
    pub numbers: [f64; MOST_NUMBERS],
}

/// What the grains of a chunk do to a body.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Load<V> {
    pub force: V,
    /// About the body's pivot.
    pub torque: DVec3,
}

/// Work space and partial sums of a chunk. Vectors are cleared and reused: a step allocates nothing.
#[derive(Debug)]
pub(crate) struct Chunk<D: Dim> {
    pub list: ChunkList,
    /// What the contacts of the list remember.
    pub memory: ChunkMemory,
    /// What contacts with bodies remember: before this step, and being written in it. In the order of the wall pass.
    pub wall_memory: [Vec<WallMemory>; 2],
    /// The grains as loads see them.
    pub seen: Vec<Seen<D>>,
    pub near: Vec<Near>,
    /// How far its grains may have moved since `near` was noted, in m.
    pub moved: f64,
    /// Entries of `near` that are asked in this step.
    pub asked: Vec<u32>,
    pub points: Vec<D::V>,
    pub reaches: Vec<f64>,
    pub hits: HitBuffer<D>,
    pub wall_parts: Vec<WallPart<D>>,
    /// Energy lost since the start to damping between grains, wall damping, wall friction, and the
    /// work that bodies have done, in J.
    pub books: [f64; 4],
    /// Force and torque on each body in the last step.
    pub on_bodies: Vec<Load<D::V>>,
    /// Square of the largest drift speed of the last step.
    pub fastest2: f64,
    /// Square of the largest change of velocity in the last sweep of the last solve.
    pub last_sweep2: f64,
    /// Slot of a grain that was not finite or too fast in the last drift.
    pub trouble: Option<usize>,
}

/// Grains from which on lists are built by the threads of the pool that runs the step, if there is one.
const MANY: usize = 4 * CHUNK;

/// Work on every chunk of `n` grains, by the threads of the pool where that pays.
pub(crate) fn each_chunk<D: Dim>(
    chunks: &mut [Chunk<D>],
    n: usize,
    work: impl Fn(usize, &mut Chunk<D>) + Sync + Send,
) {
    if n >= MANY && rayon::current_thread_index().is_some() {
        let chunks = chunks.par_iter_mut().enumerate();
        chunks.for_each(|(number, chunk)| work(number, chunk));
    } else {
        for (number, chunk) in chunks.iter_mut().enumerate() {
            work(number, chunk);
        }
    }
}

impl<D: Dim> Chunk<D> {
    pub fn new(bodies: usize) -> Self {
        Self {
            list: ChunkList::default(),
            memory: ChunkMemory::default(),
            wall_memory: [Vec::new(), Vec::new()],
            seen: Vec::new(),
            near: Vec::new(),
            moved: 0.0,
            asked: Vec::new(),
            points: Vec::new(),
            reaches: Vec::new(),
            hits: HitBuffer::default(),
            wall_parts: Vec::new(),
            books: [0.0; 4],
            on_bodies: vec![Load::default(); bodies],
            fastest2: 0.0,
            last_sweep2: 0.0,
            trouble: None,
        }
    }

    pub fn bytes(&self) -> usize {
        let wall_memory: usize = self.wall_memory.iter().map(Vec::capacity).sum();
        self.list.bytes()
            + self.memory.bytes()
            + wall_memory * size_of::<WallMemory>()
            + self.seen.capacity() * size_of::<Seen<D>>()
            + size_of::<Self>()
            + self.near.capacity() * size_of::<Near>()
            + self.asked.capacity() * 4
            + self.points.capacity() * size_of::<D::V>()
            + self.on_bodies.capacity() * size_of::<Load<D::V>>()
            + self.reaches.capacity() * 8
            + self.hits.hits.capacity() * size_of::<tsubu_model::Hit<D>>()
            + self.wall_parts.capacity() * size_of::<WallPart<D>>()
    }
}
