//! The gate that takes walls away: at a time, or once the grains are still.

use tsubu_model::{Change, Dim, Gate, SpinState, Vector, View};
use tsubu_scene::{Removal, Scene, Still};

/// Removes walls as the scene says.
pub(crate) struct WallRemoval {
    when: Vec<Removal>,
    still: Option<Still>,
    calm_since: Option<f64>,
}

impl WallRemoval {
    pub fn of(scene: &Scene) -> Self {
        Self {
            when: scene.walls.iter().map(|w| w.removed).collect(),
            still: scene.still,
            calm_since: None,
        }
    }

    /// True if some wall is still waiting at `time` for something other than never.
    pub fn is_needed(&self) -> bool {
        self.when.iter().any(|w| *w != Removal::Never)
    }
}

/// Kinetic energy per grain over m g d.
pub(crate) fn agitation<D: Dim, S: SpinState>(view: &dyn View<D, S>) -> f64 {
    let g = view.gravity().length();
    let (mut kinetic, mut scale) = (0.0, 0.0);
    for i in 0..view.len() {
        let kind = view.kind(i);
        kinetic += 0.5 * kind.mass * view.velocity(i).length_squared();
        scale += kind.weight * g * kind.diameter();
    }
    if scale > 0.0 { kinetic / scale } else { 0.0 }
}

impl<D: Dim, S: SpinState> Gate<D, S> for WallRemoval {
    fn decide(&mut self, view: &dyn View<D, S>, out: &mut Vec<Change>) {
        let now = view.time();
        let bodies = view.bodies();
        let waits = |k: usize, what: fn(&Removal) -> bool| {
            bodies[k].removed_at.is_none() && what(&self.when[k])
        };
        for (k, body) in bodies.iter().enumerate() {
            let due = matches!(self.when[k], Removal::At(time) if now >= time);
            if due && body.removed_at.is_none() {
                out.push(Change::RemoveBody(k));
            }
        }
        let waiting: Vec<usize> = (0..bodies.len())
            .filter(|&k| waits(k, |w| *w == Removal::WhenStill))
            .collect();
        let Some(still) = self.still.filter(|_| !waiting.is_empty()) else {
            return;
        };
        if agitation(view) >= still.kinetic_energy {
            self.calm_since = None;
            return;
        }
        let since = *self.calm_since.get_or_insert(now);
        if now - since >= still.for_at_least {
            out.extend(waiting.into_iter().map(Change::RemoveBody));
        }
    }
}
