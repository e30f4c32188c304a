//! Kicks, drifts and the sweeps of the solve, chunk by chunk.

use crate::chunk::Chunk;
use crate::kinds::{KindSet, pick};
use crate::line::{Layout, Line};
use crate::world::Tally;
use tsubu_integrate::{Drift, correction};
use tsubu_model::{Kind, Vector};

/// One kick of length `h` and perhaps a drift of length `dt`.
#[derive(Clone, Copy)]
pub(crate) struct Kick<'a> {
    pub kinds: &'a [Kind],
    pub h: f64,
    pub dt: f64,
    /// With which velocity positions move now; `None` if they stay.
    pub drift: Option<Drift>,
    /// Square of the speed above which a grain is in trouble.
    pub too_fast2: f64,
}

impl Kick<'_> {
    /// v += F h/m, then the drift. The work of the dissipative forces is summed with the mean of the
    /// old and the new velocity: with it, Δ(½mv²) = F·v̄ h holds to rounding.
    pub fn run<D: Layout, K: KindSet, T: Tally>(
        &self,
        chunk: &mut Chunk<D>,
        lines: &mut [Line],
        force: &[D::V],
        viscous: &[D::V],
    ) {
        let mut fastest2 = 0.0f64;
        let mut trouble = None;
        let mut lost = 0.0;
        for (slot, line) in lines.iter_mut().enumerate() {
            let mass = pick::<K, _>(self.kinds, line.kind::<D>()).mass;
            let old = line.velocity::<D>();
            let new = old + force[slot] * (self.h / mass);
            if T::ON {
                lost += viscous[slot].dot(old + new);
            }
            line.set_velocity::<D>(new);
            self.drift::<D>(line, old, new, slot, &mut fastest2, &mut trouble);
        }
        if T::ON {
            chunk.books[0] -= 0.5 * self.h * lost;
            let mut walls = [0.0; 3];
            for part in &chunk.wall_parts {
                let line = &lines[part.slot as usize];
                let mass = pick::<K, _>(self.kinds, line.kind::<D>()).mass;
                let mean =
                    line.velocity::<D>() + force[part.slot as usize] * (-0.5 * self.h / mass);
                // What is lost is the work against the wall; what the wall moves, it works.
                let against = mean - part.wall;
                walls[0] += part.viscous.dot(against);
                walls[1] += part.slip.dot(against);
                walls[2] += part.total.dot(part.wall);
            }
            chunk.books[1] -= self.h * walls[0];
            chunk.books[2] -= self.h * walls[1];
            chunk.books[3] += self.h * walls[2];
        }
        self.note(chunk, fastest2, trouble);
    }

    /// One Jacobi sweep of the solve (see `tsubu_integrate::correction`).
    pub fn sweep<D: Layout, K: KindSet>(
        &self,
        chunk: &mut Chunk<D>,
        lines: &mut [Line],
        force: &[D::V],
        base: &[D::V],
        damping: &[f64],
    ) {
        let mut most = 0.0f64;
        for (slot, line) in lines.iter_mut().enumerate() {
            let mass = pick::<K, _>(self.kinds, line.kind::<D>()).mass;
            let (u, v) = (base[slot], line.velocity::<D>());
            let step = D::V::from_axes(|a| {
                correction(
                    mass,
                    u.axis(a),
                    v.axis(a),
                    force[slot].axis(a),
                    damping[slot],
                    self.h,
                )
            });
            most = most.max(step.length_squared());
            line.set_velocity::<D>(v + step);
        }
        chunk.last_sweep2 = most;
    }

    /// After the sweeps: the force becomes the one that led from the base velocity to the solution,
    /// the difference to the last evaluation counts as viscous; then the drift.
    pub fn finish_solve<D: Layout, K: KindSet, T: Tally>(
        &self,
        chunk: &mut Chunk<D>,
        lines: &mut [Line],
        force: &mut [D::V],
        viscous: &mut [D::V],
        base: &[D::V],
    ) {
        for (slot, line) in lines.iter_mut().enumerate() {
            let mass = pick::<K, _>(self.kinds, line.kind::<D>()).mass;
            let solved = (line.velocity::<D>() - base[slot]) * (mass / self.h);
            if T::ON {
                viscous[slot] += solved - force[slot];
            }
            force[slot] = solved;
            line.set_velocity::<D>(base[slot]);
        }
        self.run::<D, K, T>(chunk, lines, force, viscous);
    }

    #[inline(always)]
    fn drift<D: Layout>(
        &self,
        line: &mut Line,
        old: D::V,
        new: D::V,
        slot: usize,
        fastest2: &mut f64,
        trouble: &mut Option<usize>,
    ) {
        let Some(drift) = self.drift else { return };
        let v = if drift == Drift::WithOldVelocity {
            old
        } else {
            new
        };
        line.set_position::<D>(line.position::<D>() + v * self.dt);
        let speed2 = v.length_squared();
        // NaN is not sound either.
        let sound = speed2 <= self.too_fast2;
        if !sound && trouble.is_none() {
            *trouble = Some(slot);
        }
        *fastest2 = fastest2.max(speed2);
    }

    fn note<D: Layout>(&self, chunk: &mut Chunk<D>, fastest2: f64, trouble: Option<usize>) {
        if self.drift.is_some() {
            chunk.fastest2 = fastest2;
            chunk.trouble = trouble;
        }
    }
}
