//! Which grains are near which body: noted at each list build and again when a body has moved.

use crate::chunk::{CHUNK, Chunk, Near, each_chunk};
use crate::kinds::{KindSet, pick};
use crate::line::Layout;
use crate::world::{Tally, World};
use tsubu_model::{ContactLaw, SpinState};

/// How far a body may move, as a share of the law's range, before the grains near it are noted anew.
/// Wider notes more grains that turn out to be far; narrower notes them more often.
const ALLOWANCE: f64 = 0.15;

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    /// After a drift: sums how far grains and bodies may have moved since the grains near bodies were noted.
    /// True if a body has used up its allowance, so that they have to be noted anew.
    pub(crate) fn near_is_due(&mut self) -> bool {
        for chunk in &mut self.chunks {
            chunk.moved += chunk.fastest2.sqrt() * self.dt;
        }
        let mut due = false;
        for (moved, body) in self.body_moved.iter_mut().zip(&self.bodies) {
            if body.is_moved() && body.removed_at.is_none() {
                *moved += body.top_speed() * self.dt;
                due |= *moved > ALLOWANCE * self.range;
            }
        }
        due
    }

    /// Notes for every chunk which of its grains may touch which body before the next time.
    ///
    /// Since the lists were built a grain has gone half the skin at most, and will go as far at most
    /// before they are built again: so none comes closer than a skin. The room between the two is kept: the
    /// wall pass asks the surface only once that may be used up.
    pub(crate) fn note_near_bodies(&mut self) {
        let n = self.identity.len();
        let t = self.time_of_positions();
        for (pose, body) in self.poses.iter_mut().zip(&self.bodies) {
            *pose = body.pose(t);
        }
        let (lines, bodies, pairs, poses) =
            (&self.lines, &self.bodies, &self.wall_pairs, &self.poses);
        let (skin, allowance) = (self.skin, ALLOWANCE * self.range);
        let work = |number: usize, chunk: &mut Chunk<D>| {
            let own = number * CHUNK..((number + 1) * CHUNK).min(n);
            chunk.near.clear();
            chunk.moved = 0.0;
            for (body, wall) in bodies.iter().enumerate() {
                if wall.removed_at.is_some() {
                    continue;
                }
                let (pose, moved) = (&poses[body], wall.is_moved());
                let margin = if moved { skin + allowance } else { skin };
                for i in own.clone() {
                    let mut x = lines[i].position::<D>();
                    if moved {
                        x = D::from_space(pose.to_body(D::to_space(x)));
                    }
                    let reach = pick::<K, _>(&pairs[body], lines[i].kind::<D>()).reach;
                    let room = wall.surface.room(x, reach);
                    if room < margin {
                        chunk.near.push(Near {
                            body: body as u32,
                            slot: (i - own.start) as u32,
                            asleep_until: room,
                        });
                    }
                }
            }
        };
        each_chunk(&mut self.chunks, n, work);
        self.body_moved.fill(0.0);
    }
}
