//! The gate that takes walls away or lets them start: at a time, or once the grains are still.

use tsubu_model::{Change, Damaged, Dim, Gate, Saved, SpinState, Vector, View, Words};
use tsubu_scene::{Begin, Removal, Scene, Still};

/// Removes walls, and starts those that wait for it, as the scene says.
pub(crate) struct WallChanges {
    when: Vec<Removal>,
    /// Which walls wait for stillness to move.
    starts: Vec<bool>,
    started: bool,
    still: Option<Still>,
    calm_since: Option<f64>,
}

impl WallChanges {
    pub fn of(scene: &Scene) -> Self {
        Self {
            when: scene.walls.iter().map(|w| w.removed).collect(),
            starts: scene
                .walls
                .iter()
                .map(|w| {
                    let begins = w.motion.as_ref().map(|m| m.begins);
                    begins == Some(Begin::WhenStill)
                })
                .collect(),
            started: false,
            still: scene.still,
            calm_since: None,
        }
    }

    /// True if some wall is still waiting at `time` for something other than never.
    pub fn is_needed(&self) -> bool {
        self.when.iter().any(|w| *w != Removal::Never) || self.starts.contains(&true)
    }
}

/// What changes once the grains are still.
pub(crate) fn at_release(scene: &Scene) -> Vec<Change> {
    let gates = WallChanges::of(scene);
    let removed = (0..gates.when.len()).filter(|&k| gates.when[k] == Removal::WhenStill);
    let started = (0..gates.starts.len()).filter(|&k| gates.starts[k]);
    let removed = removed.map(Change::RemoveBody);
    removed.chain(started.map(Change::StartBody)).collect()
}

/// Walls that go at a time in s.
pub(crate) fn removed_at(scene: &Scene) -> Vec<(usize, f64)> {
    let walls = scene.walls.iter().enumerate();
    walls
        .filter_map(|(k, wall)| match wall.removed {
            Removal::At(time) => Some((k, time)),
            _ => None,
        })
        .collect()
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

impl Saved for WallChanges {
    fn save(&self, words: &mut Words) {
        words.put_part("wall changes");
        words.put_flag(self.started);
        words.put_maybe(self.calm_since);
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("wall changes")?;
        self.started = words.take_flag()?;
        self.calm_since = words.take_maybe()?;
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Gate<D, S> for WallChanges {
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
        let mut waiting: Vec<Change> = (0..bodies.len())
            .filter(|&k| waits(k, |w| *w == Removal::WhenStill))
            .map(Change::RemoveBody)
            .collect();
        if !self.started {
            let starting = (0..bodies.len()).filter(|&k| self.starts[k]);
            waiting.extend(starting.map(Change::StartBody));
        }
        let Some(still) = self.still.filter(|_| !waiting.is_empty()) else {
            return;
        };
        if agitation(view) >= still.kinetic_energy {
            self.calm_since = None;
            return;
        }
        let since = *self.calm_since.get_or_insert(now);
        if now - since >= still.for_at_least {
            self.started = true;
            out.append(&mut waiting);
        }
    }
}
