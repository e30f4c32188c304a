//! Bodies and the wall pass: the same kind of law as between grains, with a `Touch` made from a surface's hit.

use crate::chunk::{CHUNK, Chunk, Load, WallMemory, WallPart};
use crate::kinds::{KindSet, pick};
use crate::line::{Layout, Line, has_second_line};
use crate::world::Tally;
use glam::DVec3;
use std::sync::Arc;
use tsubu_model::{
    ContactLaw, Kind, Linear, MOST_NUMBERS, Motion, Numbers, Pose, Push, SpinState, Surface, Touch,
    Vector,
};

/// Where a grain touches a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TouchesAt {
    /// At its surface: s = distance of the centre + d/2.
    Surface,
    /// At its centre, the literal reading of paper A: s = distance of the centre.
    Centre,
    /// The surface is that of wall grains of this radius in m, the partners of the law:
    /// s = distance of the centre + radius, the distance of the two centres.
    WallGrains(f64),
}

/// A body: a surface, the law of grains against it, and what the grains do to it.
pub struct Body<D: Layout, W> {
    /// Name in the scene.
    pub name: String,
    /// Its surface.
    pub surface: Arc<dyn Surface<D>>,
    /// Law of grains against it.
    pub law: W,
    /// Where a grain touches it.
    pub touches_at: TouchesAt,
    /// When it was taken away, in s.
    pub removed_at: Option<f64>,
    /// How it moves.
    pub motion: Motion,
    /// True while the motion waits for [`World::start_body`](crate::World::start_body).
    pub waits: bool,
}

/// Constants of a body against one kind of grain.
#[derive(Clone, Copy)]
pub(crate) struct WallPair<P> {
    pub pair: P,
    /// Added to the distance of the centre to get s, in m.
    pub offset: f64,
    /// Distance of the centre from which on there is no force, in m.
    pub reach: f64,
    /// Radius of the partner in m: of a wall grain, or of the grain's mirror in a surface.
    pub partner: f64,
    /// How far behind the surface the partner's velocity is taken and its reaction acts, in m:
    /// at the centre of a wall grain, at the surface itself else.
    pub behind: f64,
    /// s is not let below this, so that a grain whose centre is inside is still pushed out, in m.
    pub least: f64,
}

impl<D: Layout, W> Body<D, W> {
    /// Where the body is at time `t`, and how it moves.
    pub(crate) fn pose(&self, t: f64) -> Pose {
        if self.waits {
            return self.motion.at(f64::NEG_INFINITY);
        }
        self.motion.at(t)
    }

    /// True if the body's frame is not the world's.
    pub(crate) fn is_moved(&self) -> bool {
        !self.motion.is_rest()
    }

    /// A speed in m/s that no point of its surface exceeds; infinite for a surface without end that turns.
    pub(crate) fn top_speed(&self) -> f64 {
        if self.waits {
            return 0.0;
        }
        let Some(turn) = self.motion.turn else {
            return self.motion.top_speed(0.0);
        };
        let furthest = self.surface.bounds().map_or(f64::INFINITY, |[low, high]| {
            let from_axis = |corner: DVec3| {
                let arm = corner - turn.point;
                (arm - turn.axis * arm.dot(turn.axis)).length()
            };
            (0..8)
                .map(|k| {
                    let pick = |bit: usize, a: f64, b: f64| if k >> bit & 1 == 0 { a } else { b };
                    from_axis(DVec3::new(
                        pick(0, low.x, high.x),
                        pick(1, low.y, high.y),
                        pick(2, low.z, high.z),
                    ))
                })
                .fold(0.0, f64::max)
        });
        self.motion.top_speed(furthest)
    }

    pub(crate) fn pairs<S: SpinState>(&self, kinds: &[Kind]) -> Vec<WallPair<W::Pair>>
    where
        W: ContactLaw<D, S>,
    {
        kinds
            .iter()
            .map(|kind| {
                let pair = self.law.pair(kind, &Kind::immovable());
                let (offset, partner, behind) = match self.touches_at {
                    TouchesAt::Surface => (kind.radius, kind.radius, 0.0),
                    TouchesAt::Centre => (0.0, kind.radius, 0.0),
                    TouchesAt::WallGrains(radius) => (radius, radius, radius),
                };
                let range = W::range(&pair);
                WallPair {
                    pair,
                    offset,
                    reach: range - offset,
                    partner,
                    behind,
                    least: 0.1 * range,
                }
            })
            .collect()
    }
}

/// What the wall pass reads.
pub(crate) struct WallJob<'a, D: Layout, S: SpinState, W: ContactLaw<D, S>> {
    pub bodies: &'a [Body<D, W>],
    /// Per body, per kind.
    pub pairs: &'a [Vec<WallPair<W::Pair>>],
    /// Where each body is.
    pub poses: &'a [Pose],
    /// How far each body may have moved since the grains near it were noted, in m.
    pub moved: &'a [f64],
    pub dt: f64,
    /// True if the step is taken, so that contacts remember it.
    pub keep: bool,
}

/// The grains of a chunk as the wall pass sees them.
#[derive(Clone, Copy)]
pub(crate) struct Own<'a> {
    pub lines: &'a [Line],
    /// Their spins where a line has no room for it, else empty.
    pub spins: &'a [Line],
    pub identity: &'a [u32],
}

impl<'a> Own<'a> {
    /// The chunk of this number, which has so many grains.
    pub fn of_chunk<D: Layout, S: SpinState>(
        number: usize,
        grains: usize,
        lines: &'a [Line],
        spins: &'a [Line],
        identity: &'a [u32],
    ) -> Self {
        let own = number * CHUNK..number * CHUNK + grains;
        Self {
            lines: &lines[own.clone()],
            spins: if const { has_second_line::<D, S>() } {
                &spins[own.clone()]
            } else {
                &[]
            },
            identity: &identity[own],
        }
    }

    fn spin<D: Layout, S: SpinState>(&self, slot: usize) -> S::Turn<D> {
        if const { has_second_line::<D, S>() } {
            self.spins[slot].spin::<D, S>()
        } else {
            self.lines[slot].spin::<D, S>()
        }
    }
}

/// One contact of a grain with a body, in the world's frame.
struct Contact<'p, D: Layout, S: SpinState, P> {
    body: usize,
    slot: usize,
    feature: u32,
    radius: f64,
    touch: Touch<D, S>,
    pair: &'p P,
    /// Velocity of the wall at the contact.
    wall: D::V,
    /// From the body's pivot to the contact.
    arm: DVec3,
}

/// Calls `each` for every contact of the chunk's grains with bodies.
fn contacts<D, S, K, W>(
    job: &WallJob<'_, D, S, W>,
    own: Own<'_>,
    chunk: &mut Chunk<D>,
    mut each: impl FnMut(&mut Chunk<D>, Contact<'_, D, S, W::Pair>),
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    W: ContactLaw<D, S>,
{
    let lines = own.lines;
    let mut from = 0;
    while from < chunk.near.len() {
        let number = chunk.near[from].body as usize;
        let to = from
            + chunk.near[from..]
                .iter()
                .take_while(|n| n.body as usize == number)
                .count();
        if job.bodies[number].removed_at.is_none() {
            let (pose, moved) = (&job.poses[number], job.bodies[number].is_moved());
            let gone = chunk.moved + job.moved[number];
            chunk.asked.clear();
            chunk.points.clear();
            chunk.reaches.clear();
            chunk.hits.hits.clear();
            for entry in from..to {
                let near = chunk.near[entry];
                if gone < near.asleep_until {
                    continue;
                }
                chunk.asked.push(entry as u32);
                let line = &lines[near.slot as usize];
                let x = line.position::<D>();
                chunk.points.push(if moved {
                    D::from_space(pose.to_body(D::to_space(x)))
                } else {
                    x
                });
                chunk
                    .reaches
                    .push(pick::<K, _>(&job.pairs[number], line.kind::<D>()).reach);
            }
            job.bodies[number]
                .surface
                .hits(&chunk.points, &chunk.reaches, &mut chunk.hits);
            put_to_sleep(chunk, &*job.bodies[number].surface, gone);
            for h in 0..chunk.hits.hits.len() {
                let hit = chunk.hits.hits[h];
                let slot = chunk.near[chunk.asked[hit.of as usize] as usize].slot as usize;
                let line = &lines[slot];
                let wall = pick::<K, _>(&job.pairs[number], line.kind::<D>());
                let s = (hit.distance + wall.offset).max(wall.least);
                let normal = if moved {
                    D::from_space(pose.direction(D::to_space(hit.normal)))
                } else {
                    hit.normal
                };
                let contact =
                    D::to_space(line.position::<D>() - normal * (hit.distance + wall.behind));
                let motion = if moved {
                    D::from_space(pose.velocity_at(contact))
                } else {
                    D::V::ZERO
                };
                let spin = own.spin::<D, S>(slot);
                let touch = Touch {
                    apart: normal * s,
                    velocity: line.velocity::<D>() - motion,
                    r2: s * s,
                    reach: line.0[D::RADIUS] + wall.partner,
                    spin: spin * line.0[D::RADIUS],
                    roll: if moved {
                        spin - S::from_space::<D>(pose.spin)
                    } else {
                        spin
                    },
                };
                each(
                    chunk,
                    Contact {
                        body: number,
                        slot,
                        feature: hit.feature,
                        radius: line.0[D::RADIUS],
                        touch,
                        pair: &wall.pair,
                        wall: motion,
                        arm: pose.arm(contact),
                    },
                );
            }
        }
        from = to;
    }
}

/// Grains that were asked and do not touch sleep until they and the body may have used up the room between.
fn put_to_sleep<D: Layout>(chunk: &mut Chunk<D>, surface: &dyn Surface<D>, gone: f64) {
    let mut hits = chunk.hits.hits.iter().map(|hit| hit.of).peekable();
    for (of, &entry) in chunk.asked.iter().enumerate() {
        let mut touches = false;
        while hits.next_if_eq(&(of as u32)).is_some() {
            touches = true;
        }
        if !touches {
            let room = surface.room(chunk.points[of], chunk.reaches[of]);
            chunk.near[entry as usize].asleep_until = gone + room;
        }
    }
}

/// What contacts with bodies remember, found again: they come in the same order as in the step before, but for
/// those that begin or end.
struct Recall {
    next: usize,
}

impl Recall {
    fn find<M: Numbers>(&mut self, all: &[WallMemory], grain: u32, body: usize, feature: u32) -> M {
        let mut memory = M::zero();
        let key = (grain, body as u32, feature);
        let is_it = |entry: &WallMemory| (entry.grain, entry.body, entry.feature) == key;
        let (behind, ahead) = all.split_at(self.next.min(all.len()));
        let found = match ahead.iter().position(is_it) {
            Some(k) => Some(self.next + k),
            None => behind.iter().position(is_it),
        };
        if let Some(at) = found {
            for m in 0..M::N {
                memory.set(m, all[at].numbers[m]);
            }
            self.next = at + 1;
        }
        memory
    }
}

/// Forces of the bodies on the chunk's grains, added to `force`, and their torques; the reactions go to the chunk.
pub(crate) fn wall_forces<D, S, K, W, T>(
    job: &WallJob<'_, D, S, W>,
    own: Own<'_>,
    chunk: &mut Chunk<D>,
    force: &mut [D::V],
    torque: &mut [S::Turn<D>],
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    W: ContactLaw<D, S>,
    T: Tally,
{
    chunk.wall_parts.clear();
    chunk.on_bodies.fill(Load::default());
    chunk.wall_memory[1].clear();
    let mut recall = Recall { next: 0 };
    contacts::<D, S, K, W>(job, own, chunk, |chunk, at| {
        let mut memory = W::Memory::zero();
        if const { <W::Memory as Numbers>::N > 0 } {
            memory = recall.find(
                &chunk.wall_memory[0],
                own.identity[at.slot],
                at.body,
                at.feature,
            );
        }
        let push: Push<D, S> = W::force(at.pair, &at.touch, &mut memory, job.dt);
        if const { <W::Memory as Numbers>::N > 0 } {
            let mut numbers = [0.0; MOST_NUMBERS];
            for (m, number) in numbers.iter_mut().enumerate().take(W::Memory::N) {
                *number = memory.get(m);
            }
            if numbers.iter().any(|&number| number != 0.0) {
                chunk.wall_memory[1].push(WallMemory {
                    grain: own.identity[at.slot],
                    body: at.body as u32,
                    feature: at.feature,
                    numbers,
                });
            }
        }
        let total = push.total();
        force[at.slot] += total;
        torque[at.slot] += push.twist * at.radius;
        let load = &mut chunk.on_bodies[at.body];
        load.force += -total;
        load.torque -= at.arm.cross(D::to_space(total));
        if const { W::ROLLS } {
            torque[at.slot] += push.couple;
            load.torque -= S::to_space::<D>(push.couple);
        }
        if T::ON {
            chunk.wall_parts.push(WallPart {
                slot: at.slot as u32,
                viscous: push.viscous,
                slip: push.slip,
                total,
                wall: at.wall,
            });
        }
    });
    if job.keep {
        chunk.wall_memory.swap(0, 1);
    }
}

/// Calls `each` with the slot, the normal and the linearised law of every contact with a body.
pub(crate) fn wall_linear<D, S, K, W>(
    job: &WallJob<'_, D, S, W>,
    own: Own<'_>,
    chunk: &mut Chunk<D>,
    mut each: impl FnMut(usize, D::V, &Linear),
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    W: ContactLaw<D, S>,
{
    contacts::<D, S, K, W>(job, own, chunk, |_, at| {
        let linear = W::linear(at.pair, &at.touch, job.dt);
        each(at.slot, at.touch.normal(), &linear);
    });
}

/// Elastic energy of the chunk's grains against each body, added to `stored`.
pub(crate) fn wall_energy<D, S, K, W>(
    job: &WallJob<'_, D, S, W>,
    own: Own<'_>,
    chunk: &mut Chunk<D>,
    stored: &mut [f64],
) where
    D: Layout,
    S: SpinState,
    K: KindSet,
    W: ContactLaw<D, S>,
{
    let mut recall = Recall { next: 0 };
    contacts::<D, S, K, W>(job, own, chunk, |chunk, at| {
        let grain = own.identity[at.slot];
        let memory = recall.find(&chunk.wall_memory[0], grain, at.body, at.feature);
        stored[at.body] += W::stored(at.pair, &at.touch, &memory);
    });
}

/// The larger damping of a contact: an upper bound of its diagonal block, so the sweeps still converge.
pub(crate) fn strongest(linear: &Linear) -> f64 {
    linear.normal_damping.max(linear.tangential_damping)
}
