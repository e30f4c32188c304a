//! The observer of a collapsing heap.

use crate::slope::{Measured, Stand, crest_height, flank_angle, front, runout_angle};
use crate::{Deposit, Profile, Slices};
use tsubu_model::{Curve, Damaged, Observer, Reading, Saved, SpinState, View, Words};

/// What a [`Heap`] needs to know of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct HeapOptions {
    /// Grain diameter in m (of this level of coarse-graining): the width of a bin of the profile.
    pub diameter: f64,
    /// Period along y in m; `None` = walled or open: the extent of the grains. Ignored in the plane.
    pub depth: Option<f64>,
    /// x of the standing wall in m.
    pub back: f64,
    /// x of the opposite wall in m, if the deposit may reach one.
    pub far: Option<f64>,
    /// Name of the body whose removal starts the clock; `None` = the clock of the simulation.
    pub release: Option<String>,
    /// Times after the release in s at which the profile is kept, at the first look then or later.
    pub snapshots: Vec<f64>,
}

/// Profile, front and angle of repose of a heap against time.
///
/// Rows: `time_since_release` (s), `angle_flank`, `angle_runout` (deg), `front`, `crest_height`,
/// `centre_x`, `centre_z` (m). Before the release time and angles are NaN.
/// Methods: [`flank_angle`], [`runout_angle`], [`front`] on a [`Profile`] with bins one diameter wide;
/// loose grains are left out of all values as [`Deposit`] says.
///
/// Report, of the last look: `angle_of_repose` (the flank angle: line fitted between 85 % and 15 % of the height of the crest),
/// `angle_runout`, `front`, `centre_of_mass_x`, `centre_of_mass_z`. A model without static friction creeps:
/// an angle means something only with its time after the release, so that is reported too.
#[derive(Clone, Debug)]
pub struct Heap {
    options: HeapOptions,
    /// Snapshots still to come, the latest first.
    waiting: Vec<f64>,
    kept: Vec<(f64, Profile)>,
    last: Option<Look>,
}

/// What one look found.
#[derive(Clone, Debug, Default)]
struct Look {
    time: f64,
    profile: Profile,
    flank: Measured,
    runout: Measured,
    front: Measured,
    centre: [f64; 2],
}

impl Heap {
    /// An observer that has not looked yet.
    pub fn new(options: HeapOptions) -> Self {
        let mut waiting: Vec<f64> = options
            .snapshots
            .iter()
            .copied()
            .filter(|t| t.is_finite())
            .collect();
        waiting.sort_unstable_by(|a, b| b.total_cmp(a));
        Self {
            options,
            waiting,
            kept: Vec::new(),
            last: None,
        }
    }

    /// The profile of the last look.
    pub fn profile(&self) -> Option<&Profile> {
        self.last.as_ref().map(|look| &look.profile)
    }

    /// Seconds since the release; NaN before.
    fn since_release<D: Slices, S: SpinState>(&self, view: &dyn View<D, S>) -> f64 {
        let Some(name) = &self.options.release else {
            return view.time();
        };
        let removed = view
            .bodies()
            .into_iter()
            .find(|body| body.name == *name)
            .and_then(|body| body.removed_at);
        removed
            .map(|at| view.time() - at)
            .filter(|since| *since >= 0.0)
            .unwrap_or(f64::NAN)
    }

    /// Keeps the profile if a snapshot is due; a look serves all that are.
    fn keep(&mut self, time: f64, profile: &Profile) {
        let due = |at: f64| time >= at - 1e-9 * at.abs();
        if !self.waiting.last().is_some_and(|at| due(*at)) {
            return;
        }
        self.waiting.retain(|at| !due(*at));
        self.kept.push((time, profile.clone()));
    }

    fn curve(&self, time: f64, profile: &Profile, note: &str) -> Curve {
        let label = match (&self.options.release, time.is_nan()) {
            (Some(name), true) => format!("before the removal of {name}"),
            (Some(name), false) => format!("{time:.2} s after the removal of {name}{note}"),
            (None, _) => format!("{time:.2} s{note}"),
        };
        Curve {
            figure: "profile",
            label,
            axes: ["x (m)", "height (m)"],
            x: profile.x.clone(),
            y: profile.height.clone(),
        }
    }
}

impl Saved for Look {
    fn save(&self, words: &mut Words) {
        words.put_number(self.time);
        self.profile.save(words);
        for measured in [&self.flank, &self.runout, &self.front] {
            measured.save(words);
        }
        self.centre.iter().for_each(|c| words.put_number(*c));
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        self.time = words.take_number()?;
        self.profile.restore(words)?;
        for measured in [&mut self.flank, &mut self.runout, &mut self.front] {
            measured.restore(words)?;
        }
        self.centre = [words.take_number()?, words.take_number()?];
        Ok(())
    }
}

impl Saved for Heap {
    fn save(&self, words: &mut Words) {
        words.put_part("heap");
        words.put_numbers(&self.waiting);
        words.put_whole(self.kept.len() as u64);
        for (time, profile) in &self.kept {
            words.put_number(*time);
            profile.save(words);
        }
        words.put_flag(self.last.is_some());
        if let Some(look) = &self.last {
            look.save(words);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("heap")?;
        self.waiting = words.take_numbers()?;
        self.kept.clear();
        for _ in 0..words.take_count(6)? {
            let (time, mut profile) = (words.take_number()?, Profile::default());
            profile.restore(words)?;
            self.kept.push((time, profile));
        }
        self.last = None;
        if words.take_flag()? {
            let mut look = Look::default();
            look.restore(words)?;
            self.last = Some(look);
        }
        Ok(())
    }
}

impl<D: Slices, S: SpinState> Observer<D, S> for Heap {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let HeapOptions {
            diameter,
            back,
            far,
            depth,
            ..
        } = self.options;
        let stand = Stand {
            diameter,
            back,
            far,
        };
        let time = self.since_release(view);
        let deposit = Deposit::of(view, depth);
        let profile = Profile::of_deposit(view, &deposit, diameter, back);
        let nothing = Measured {
            value: f64::NAN,
            uncertainty: None,
        };
        let released = !time.is_nan();
        let look = Look {
            time,
            flank: if released {
                flank_angle(&profile, &stand)
            } else {
                nothing
            },
            runout: if released {
                runout_angle(&profile, &stand)
            } else {
                nothing
            },
            front: front(&profile, &stand),
            centre: [deposit.centre_x, deposit.centre_z],
            profile,
        };
        self.keep(time, &look.profile);
        let row = vec![
            Reading::new("time_since_release", time, "s"),
            reading("angle_flank", look.flank, "deg"),
            reading("angle_runout", look.runout, "deg"),
            reading("front", look.front, "m"),
            Reading::new("crest_height", crest_height(&look.profile), "m"),
            Reading::new("centre_x", look.centre[0], "m"),
            Reading::new("centre_z", look.centre[1], "m"),
        ];
        self.last = Some(look);
        row
    }

    fn report(&self) -> Vec<Reading> {
        let Some(look) = &self.last else {
            return Vec::new();
        };
        vec![
            reading("angle_of_repose", look.flank, "deg"),
            reading("angle_runout", look.runout, "deg"),
            Reading::new("time_since_release", look.time, "s"),
            reading("front", look.front, "m"),
            Reading::new("centre_of_mass_x", look.centre[0], "m"),
            Reading::new("centre_of_mass_z", look.centre[1], "m"),
        ]
    }

    fn curves(&self) -> Vec<Curve> {
        let mut curves: Vec<Curve> = self
            .kept
            .iter()
            .map(|(time, profile)| self.curve(*time, profile, ""))
            .collect();
        if let Some(look) = &self.last
            && self.kept.last().is_none_or(|(time, _)| *time != look.time)
        {
            curves.push(self.curve(look.time, &look.profile, " (end)"));
        }
        curves
    }
}

/// A reading with its uncertainty, if known.
fn reading(name: &'static str, measured: Measured, unit: &'static str) -> Reading {
    Reading {
        name: name.into(),
        value: measured.value,
        uncertainty: measured.uncertainty,
        unit,
    }
}
