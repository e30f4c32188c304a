//! What happens when, in the input language that LAMMPS and LIGGGHTS share: settling, walls that go, bodies that start.

use super::RELEASED;
use super::ready::Ready;
use tsubu_scene::{Begin, Removal, SceneError, Still};

/// Something that happens between two steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// A wall is taken away.
    Remove(usize),
    /// A body begins to move.
    Start(usize),
    /// It rests again.
    Stop(usize),
    /// The full damping acts from now on.
    FullDamping,
}

/// The acts of a scene in order.
pub struct Timeline {
    settle: Option<Still>,
    at_start: Vec<Act>,
    at_release: Vec<Act>,
    /// Counted in steps from the start, or from the release.
    later: Vec<(u64, Act)>,
}

impl Timeline {
    pub fn of(ready: &Ready) -> Result<Self, SceneError> {
        let scene = ready.scene();
        let settle = scene.still;
        let mut line = Self {
            settle,
            at_start: Vec::new(),
            at_release: Vec::new(),
            later: Vec::new(),
        };
        let steps = |time: f64| (time / ready.constants.dt).round() as u64;
        let clash = |path: String| {
            let what = "is told of times from the start, or of times from the moment of stillness, not of both";
            ready.refuse(
                &path,
                what,
                "let it wait for stillness too, or begin at 0 s without end",
            )
        };
        if settle.is_some_and(|still| still.damping != 1.0) {
            line.at_release.push(Act::FullDamping);
        }
        for (number, wall) in scene.walls.iter().enumerate() {
            match wall.removed {
                Removal::Never => {}
                Removal::WhenStill => line.at_release.push(Act::Remove(number)),
                Removal::At(_) if settle.is_some() => {
                    return Err(clash(format!("walls[{number}].removed")));
                }
                Removal::At(time) => line.later.push((steps(time), Act::Remove(number))),
            }
            let Some(motion) = &wall.motion else { continue };
            let path = || format!("walls[{number}].motion");
            let (begin, start) = match motion.begins {
                Begin::WhenStill => (0.0, &mut line.at_release),
                Begin::At(time) if time > 0.0 && settle.is_some() => return Err(clash(path())),
                Begin::At(time) => (time, &mut line.at_start),
            };
            if begin > 0.0 {
                line.later.push((steps(begin), Act::Start(number)));
            } else {
                start.push(Act::Start(number));
            }
            if let Some(lasts) = motion.lasts {
                if settle.is_some() && motion.begins != Begin::WhenStill {
                    return Err(clash(path()));
                }
                line.later.push((steps(begin + lasts), Act::Stop(number)));
            }
        }
        line.later.retain(|(at, _)| *at < ready.steps);
        line.later.sort_by_key(|(at, _)| *at);
        Ok(line)
    }

    /// The share of the damping that acts at the start.
    pub fn damping(&self) -> f64 {
        self.settle.map_or(1.0, |still| still.damping)
    }

    /// The commands: `act` says how the target does an act, `each` what it does between stretches of steps.
    pub fn commands(
        &self,
        ready: &Ready,
        act: &dyn Fn(Act) -> Vec<String>,
        run: &dyn Fn(&str) -> Vec<String>,
    ) -> Vec<String> {
        let all = |acts: &[Act]| acts.iter().flat_map(|a| act(*a)).collect::<Vec<_>>();
        let mut lines = all(&self.at_start);
        if let Some(still) = &self.settle {
            lines.extend(self.settling(ready, still, run));
            lines.extend(all(&self.at_release));
        }
        let mut now = 0;
        for &(at, what) in &self.later {
            if at > now {
                lines.extend(run(&(at - now).to_string()));
            }
            now = at;
            lines.extend(act(what));
        }
        lines.push(format!(
            "variable steps index {}",
            ready.steps.saturating_sub(now)
        ));
        lines.extend(run("${steps}"));
        lines
    }

    /// Steps until the kinetic energy per grain has stayed below the scene's share of m g d for long enough: the loop looks
    /// as often as a run here does.
    fn settling(
        &self,
        ready: &Ready,
        still: &Still,
        run: &dyn Fn(&str) -> Vec<String>,
    ) -> Vec<String> {
        let kind = &ready.constants.kind;
        let unit = kind.weight * ready.scene().gravity * kind.diameter();
        let look = ((0.1 * still.for_at_least / ready.constants.dt) as u64).clamp(1, 1000);
        let asked = still.kinetic_energy;
        let mut lines = vec![
            String::new(),
            format!(
                "# Settle until the kinetic energy per grain is below {asked:?} m g d for {:?} s.",
                still.for_at_least
            ),
            format!("variable agitation equal c_ke/(count(grains)*{unit:?})"),
            "variable calm equal -1".into(),
            "label settle".into(),
        ];
        lines.extend(run(&look.to_string()));
        lines.extend([
            // Two commands: LIGGGHTS stumbles over an `elif` that does not hold.
            format!("if \"$(v_agitation) >= {asked:?}\" then \"variable calm equal -1\""),
            format!(
                "if \"$(v_agitation) < {asked:?} && $(v_calm) < 0\" then \"variable calm equal $(step*dt)\""
            ),
            format!("if \"$(step*dt) > {:?}\" then \"print 'The grains were not still in time.'\" quit", still.at_most),
            "if \"$(v_calm) < 0\" then \"jump SELF settle\"".into(),
            format!("if \"$(step*dt-v_calm) < {:?}\" then \"jump SELF settle\"", still.for_at_least),
            format!("print \"$(step)\" file {RELEASED}"),
            String::new(),
        ]);
        lines
    }
}
