//! The world: grains, lists and bodies of one scene, and one step of time.

use crate::chunk::{CHUNK, Chunk, WallMemory};
use crate::health::Health;
use crate::kick::Kick;
use crate::kinds::KindSet;
use crate::lanes::Lanes;
use crate::line::{Layout, Line, has_second_line};
use crate::walls::{Body, Own, WallJob, WallPair, wall_energy};
use rayon::prelude::*;
use std::marker::PhantomData;
use std::sync::Arc;
use tsubu_integrate::{Drift, Scheme};
use tsubu_model::{ContactLaw, Dim, Domain, Kind, Load, Passage, Pose, SpinState, Vector};
use tsubu_neighbors::Kept;

/// Whether the work of damping and friction is summed, as a type: a run that does not ask does not pay.
pub trait Tally: Send + Sync + 'static {
    /// True if it is.
    const ON: bool;
}

/// Energies are not tallied.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTally;
/// Energies are tallied in every step.
#[derive(Clone, Copy, Debug, Default)]
pub struct WithTally;

impl Tally for NoTally {
    const ON: bool = false;
}
impl Tally for WithTally {
    const ON: bool = true;
}

/// A grain at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<D: Dim> {
    /// Centre in m.
    pub position: D::V,
    /// Velocity in m/s.
    pub velocity: D::V,
    /// Number of its kind.
    pub kind: usize,
}

/// Everything a world is made from.
pub struct Setup<D: Layout, K, L, W> {
    /// Kinds of grains.
    pub kinds: K,
    /// Law between grains.
    pub law: L,
    /// Bodies, each with its own law value.
    pub bodies: Vec<Body<D, W>>,
    /// Periodic lengths.
    pub domain: Domain<D>,
    /// Gravity in m/s².
    pub gravity: D::V,
    /// Integrator.
    pub scheme: Scheme,
    /// Step in s.
    pub dt: f64,
    /// Skin of the lists in m; `None` lets the engine adapt it from the number of steps that lists live.
    pub skin: Option<f64>,
    /// Vector path.
    pub lanes: Lanes,
    /// Threads; `None` runs without a pool.
    pub pool: Option<Arc<rayon::ThreadPool>>,
    /// The grains; the index is the identity.
    pub grains: Vec<Placed<D>>,
    /// Names of the gates through which grains come and go; [`Change`](tsubu_model::Change) numbers them.
    pub gates: Vec<String>,
}

/// A running scene. `K`: one kind or several; `L`, `W`: laws between grains and against walls;
/// `T`: whether energies are tallied.
pub struct World<
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
> {
    pub(crate) kinds: K,
    pub(crate) pairs: Vec<L::Pair>,
    /// True if all pairs are equal, so that none has to be looked up.
    pub(crate) alike: bool,
    pub(crate) bodies: Vec<Body<D, W>>,
    pub(crate) wall_pairs: Vec<Vec<WallPair<W::Pair>>>,
    pub(crate) domain: Domain<D>,
    pub(crate) gravity: D::V,
    pub(crate) weights: Vec<D::V>,
    pub(crate) scheme: Scheme,
    pub(crate) dt: f64,
    pub(crate) lanes: Lanes,
    pub(crate) pool: Option<Arc<rayon::ThreadPool>>,

    /// Grains in sorted order, then the dummy.
    pub(crate) lines: Vec<Line>,
    /// Spins in the same order, where a line has no room for them; else empty.
    pub(crate) spins: Vec<Line>,
    pub(crate) identity: Vec<u32>,
    /// Positions at the last list build.
    pub(crate) home: Vec<D::V>,
    pub(crate) force: Vec<D::V>,
    pub(crate) viscous: Vec<D::V>,
    pub(crate) torque: Vec<S::Turn<D>>,
    pub(crate) base: Vec<D::V>,
    pub(crate) damping: Vec<f64>,
    pub(crate) chunks: Vec<Chunk<D>>,
    /// Where each body is, at the time of the last forces.
    pub(crate) poses: Vec<Pose>,
    /// How far each body may have moved since the grains near it were noted, in m.
    pub(crate) body_moved: Vec<f64>,
    pub(crate) passages: Vec<Passage>,
    pub(crate) next_identity: u32,
    pub(crate) loads: Vec<Box<dyn Load<D, S>>>,
    /// What contacts remember while lists are built anew, by the former chunks.
    pub(crate) kept: Vec<Kept>,
    /// Where each grain was when that was taken; `u32::MAX` for one that came or moved since.
    pub(crate) origin: Vec<u32>,
    /// True while the two above are in use.
    pub(crate) memory_is_taken: bool,
    /// What contacts with bodies remember meanwhile, by grain.
    pub(crate) wall_kept: Vec<WallMemory>,

    pub(crate) range: f64,
    pub(crate) skin: f64,
    pub(crate) skin_is_fixed: bool,
    /// No grain has moved further than this since the last list build.
    pub(crate) moved: f64,
    pub(crate) steps: u64,
    /// True from a drift to the end of its step.
    pub(crate) drifted: bool,
    pub(crate) built_at: u64,
    pub(crate) builds: u64,
    pub(crate) build_scratch: usize,
    pub(crate) taken_by_removal: f64,
    pub(crate) brought_by_grains: f64,
    /// The books of chunks that are no longer there.
    pub(crate) closed_books: [f64; 4],
    pub(crate) health: Health,
    types: PhantomData<(S, T)>,
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
    /// A world at rest at time 0, lists built and forces known.
    pub fn new(setup: Setup<D, K, L, W>) -> Self {
        let Setup {
            kinds,
            law,
            bodies,
            domain,
            gravity,
            scheme,
            dt,
            skin,
            lanes,
            pool,
            grains,
            gates,
        } = setup;
        let all = kinds.all();
        let pairs: Vec<L::Pair> = all
            .iter()
            .flat_map(|a| all.iter().map(|b| law.pair(a, b)))
            .collect();
        let range = pairs.iter().map(|p| L::range(p)).fold(0.0, f64::max);
        let wall_pairs = bodies.iter().map(|b| b.pairs::<S>(all)).collect();
        let weights = all.iter().map(|k| gravity * k.weight).collect();
        let n = grains.len();
        let mut lines: Vec<Line> = Vec::with_capacity(n + 1);
        lines.extend(grains.iter().map(|g| {
            Line::new::<D>(
                domain.wrap(g.position),
                g.velocity,
                all[g.kind].radius,
                g.kind,
            )
        }));
        lines.push(Line::dummy::<D>());
        let spins = if const { has_second_line::<D, S>() } {
            vec![Line([0.0; 8]); n + 1]
        } else {
            Vec::new()
        };
        let solves = if scheme.sweeps() > 0 { n } else { 0 };
        let mut world = Self {
            alike: pairs.windows(2).all(|two| two[0] == two[1]),
            pairs,
            wall_pairs,
            weights,
            chunks: (0..n.div_ceil(CHUNK))
                .map(|_| Chunk::new(bodies.len()))
                .collect(),
            poses: bodies.iter().map(|b| b.pose(0.0)).collect(),
            body_moved: vec![0.0; bodies.len()],
            passages: gates.into_iter().map(Passage::of).collect(),
            next_identity: n as u32,
            loads: Vec::new(),
            kept: Vec::new(),
            origin: Vec::new(),
            memory_is_taken: false,
            wall_kept: Vec::new(),
            bodies,
            domain,
            gravity,
            scheme,
            dt,
            lanes,
            pool,
            lines,
            spins,
            identity: (0..n as u32).collect(),
            home: vec![D::V::ZERO; n],
            force: vec![D::V::ZERO; n],
            viscous: vec![D::V::ZERO; if T::ON { n } else { 0 }],
            torque: vec![S::Turn::<D>::ZERO; n],
            base: vec![D::V::ZERO; solves],
            damping: vec![0.0; solves],
            range,
            skin: skin.unwrap_or(0.04 * range),
            skin_is_fixed: skin.is_some(),
            moved: 0.0,
            steps: 0,
            drifted: false,
            built_at: 0,
            builds: 0,
            build_scratch: 0,
            taken_by_removal: 0.0,
            brought_by_grains: 0.0,
            closed_books: [0.0; 4],
            health: Health::Fine,
            types: PhantomData,
            kinds,
        };
        world.in_pool(|world| {
            world.build_lists();
            world.forces(false);
        });
        world
    }

    /// Takes `steps` steps, or stops early when a grain runs away (see [`health`](Self::health)).
    pub fn advance(&mut self, steps: u64) {
        self.in_pool(|world| world.take(steps));
    }

    /// Runs `work` on the world's own threads, if it has some.
    pub(crate) fn in_pool(&mut self, work: impl FnOnce(&mut Self) + Send) {
        match self.pool.clone() {
            Some(pool) => pool.install(|| work(self)),
            None => work(self),
        }
    }

    fn take(&mut self, steps: u64) {
        for _ in 0..steps {
            self.step();
            if !self.health.is_fine() {
                break;
            }
        }
    }

    /// One step. The parts are those of [`Scheme`].
    fn step(&mut self) {
        let (scheme, h) = (self.scheme, self.scheme.kick() * self.dt);
        let drift = scheme.drift();
        if drift == Drift::BeforeForces {
            self.kick(h, Some(drift));
            self.drifted = true;
            self.keep_lists_valid();
        }
        // A solve looks at the forces several times and keeps what the last look remembers.
        self.forces(scheme.sweeps() <= 1);
        let later = (drift != Drift::BeforeForces).then_some(drift);
        if scheme.sweeps() > 0 {
            self.solve(h, scheme.sweeps(), later);
        } else {
            self.kick(h, later);
        }
        if later.is_some() {
            self.drifted = true;
            self.keep_lists_valid();
        }
        self.drifted = false;
        self.steps += 1;
    }

    /// Square of half a range per step: no grain of a sound run is that fast.
    pub(crate) fn too_fast2(&self) -> f64 {
        (0.5 * self.range / self.dt).powi(2)
    }

    fn kick(&mut self, h: f64, drift: Option<Drift>) {
        let kick = Kick {
            kinds: self.kinds.all(),
            h,
            dt: self.dt,
            drift,
            too_fast2: self.too_fast2(),
        };
        let n = self.identity.len();
        let (lines, force, viscous) = (&mut self.lines[..n], &self.force, &self.viscous);
        let part = |number: usize| {
            if T::ON {
                &viscous[number * CHUNK..((number + 1) * CHUNK).min(n)]
            } else {
                &[]
            }
        };
        let work = |number: usize, chunk: &mut Chunk<D>, lines: &mut [Line], force: &[D::V]| {
            kick.run::<D, K, T>(chunk, lines, force, part(number));
        };
        if self.pool.is_some() {
            self.chunks
                .par_iter_mut()
                .zip(lines.par_chunks_mut(CHUNK))
                .zip(force.par_chunks(CHUNK))
                .enumerate()
                .for_each(|(n, ((c, l), f))| work(n, c, l, f));
        } else {
            for (n, ((c, l), f)) in self
                .chunks
                .iter_mut()
                .zip(lines.chunks_mut(CHUNK))
                .zip(force.chunks(CHUNK))
                .enumerate()
            {
                work(n, c, l, f);
            }
        }
        self.kick_spins(h);
    }

    /// Elastic energy of the grains against each body.
    pub(crate) fn stored_in_walls(&self) -> Vec<f64> {
        let walls = WallJob::<D, S, W> {
            bodies: &self.bodies,
            pairs: &self.wall_pairs,
            poses: &self.poses,
            moved: &self.body_moved,
            dt: self.dt,
            keep: false,
        };
        let mut stored = vec![0.0; self.bodies.len()];
        for (number, chunk) in self.chunks.iter().enumerate() {
            let mut scratch = Chunk::new(self.bodies.len());
            scratch.near.clone_from(&chunk.near);
            scratch.wall_memory[0].clone_from(&chunk.wall_memory[0]);
            scratch.moved = chunk.moved;
            let grains = CHUNK.min(self.identity.len() - number * CHUNK);
            let own =
                Own::of_chunk::<D, S>(number, grains, &self.lines, &self.spins, &self.identity);
            wall_energy::<D, S, K, W>(&walls, own, &mut scratch, &mut stored);
        }
        stored
    }

    /// Takes a body away; its elastic energy leaves with it and is booked.
    pub fn remove_body(&mut self, number: usize) {
        if self
            .bodies
            .get(number)
            .is_none_or(|b| b.removed_at.is_some())
        {
            return;
        }
        self.taken_by_removal += self.stored_in_walls()[number];
        self.bodies[number].removed_at = Some(self.now());
        self.look_at_forces();
    }

    /// A body that waits for it begins its motion now.
    pub fn start_body(&mut self, number: usize) {
        let now = self.now();
        if let Some(body) = self.bodies.get_mut(number).filter(|b| b.waits) {
            body.motion = body.motion.delayed(now);
            body.waits = false;
            self.look_at_forces();
        }
    }

    /// Changes the constants of the law between grains; its range must stay.
    pub fn set_law(&mut self, law: &L) {
        let all = self.kinds.all();
        self.pairs = all
            .iter()
            .flat_map(|a| all.iter().map(|b| law.pair(a, b)))
            .collect();
        self.look_at_forces();
    }

    /// The time to which the positions belong: a step ahead of the clock from a drift to the end of its step.
    pub(crate) fn time_of_positions(&self) -> f64 {
        (self.steps + u64::from(self.drifted)) as f64 * self.dt
    }

    /// Simulated time in s.
    pub fn now(&self) -> f64 {
        self.steps as f64 * self.dt
    }

    /// Steps taken.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Integrator.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Step in s.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Grains that there have ever been: those of the start and those that came.
    pub fn inserted(&self) -> u64 {
        u64::from(self.next_identity)
    }

    /// Entries and blocks of all lists.
    pub fn list_counts(&self) -> (usize, usize) {
        self.chunks.iter().fold((0, 0), |s, c| {
            (s.0 + c.list.entries(), s.1 + c.list.blocks().len())
        })
    }

    /// Lists built so far.
    pub fn list_builds(&self) -> u64 {
        self.builds
    }

    /// Largest change of a velocity in the last sweep of the last solve, in m/s: how far the solve is
    /// from its end. Zero for explicit schemes.
    pub fn solve_residual(&self) -> f64 {
        self.chunks
            .iter()
            .map(|c| c.last_sweep2)
            .fold(0.0, f64::max)
            .sqrt()
    }

    /// Whether the numbers are still physics. The first trouble stays.
    pub fn health(&self) -> Health {
        self.health.clone()
    }

    /// Notes a grain in trouble before the lists, and with them the order of grains, change.
    pub(crate) fn note_trouble(&mut self) {
        let found = self
            .chunks
            .iter()
            .enumerate()
            .find_map(|(number, c)| c.trouble.map(|slot| number * CHUNK + slot));
        let Some(i) = found.filter(|_| self.health.is_fine()) else {
            return;
        };
        let line = &self.lines[i];
        self.health = Health::Runaway {
            grain: self.identity[i],
            place: D::to_space(line.position::<D>()).to_array(),
            speed: line.velocity::<D>().length(),
            time: self.now(),
        };
    }

    /// Bytes held per grain: lines, forces, lists, and the scratch of a list build at its peak.
    pub fn bytes_per_grain(&self) -> f64 {
        let vectors = self.home.capacity()
            + self.force.capacity()
            + self.viscous.capacity()
            + self.base.capacity();
        let kept: usize = self.kept.iter().map(Kept::bytes).sum();
        let total = (self.lines.capacity() + self.spins.capacity()) * size_of::<Line>()
            + self.torque.capacity().min(self.identity.len()) * size_of::<S::Turn<D>>()
            + kept
            + self.origin.capacity() * 4
            + vectors * size_of::<D::V>()
            + self.damping.capacity() * 8
            + self.identity.capacity() * 4
            + self.chunks.iter().map(Chunk::bytes).sum::<usize>()
            + self.build_scratch;
        total as f64 / self.identity.len().max(1) as f64
    }

    /// Lost to damping, wall damping and wall friction, and done by bodies.
    pub(crate) fn books(&self) -> [f64; 4] {
        self.chunks.iter().fold(self.closed_books, |sum, chunk| {
            std::array::from_fn(|k| sum[k] + chunk.books[k])
        })
    }

    pub(crate) fn taken(&self) -> f64 {
        self.taken_by_removal
    }

    pub(crate) fn kind_of(&self, i: usize) -> &Kind {
        crate::kinds::pick::<K, _>(self.kinds.all(), self.lines[i].kind::<D>())
    }
}
