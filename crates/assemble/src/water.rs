//! Water over a bed as a load on the grains of a run.

use crate::constants::Constants;
use crate::grain::{clear_water, sediment};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tsubu_model::{Damaged, Dim, Load, Saved, Seen, SpinState, Vector, View, Words};
use tsubu_scene as scene;
use tsubu_scene::{Checked, SceneError};
use tsubu_stream::{
    Bed, Datum, LogLaw, Profile, Setting, Shelter, Stream, Table, Turbulence, Unphysical,
};

/// The water of a run.
pub(crate) struct Flow {
    stream: Stream,
    /// When it begins, s; its own time counts from there.
    begins: f64,
    /// Drag of a grain over that of one of its size.
    factor: f64,
    /// Set when it found no bed to flow over.
    pub lost_bed: Arc<AtomicBool>,
}

impl Flow {
    /// The water that the scene asks for.
    pub fn of(
        checked: &Checked,
        water: &scene::Water,
        constants: &Constants,
    ) -> Result<Self, SceneError> {
        let scene = &checked.scene;
        let setting = setting(scene, water, constants)
            .map_err(|e| checked.problem("water", e.to_string(), "change this value"))?;
        let stream = Stream::new(setting)
            .map_err(|e| checked.problem("water", e.to_string(), "change this value"))?;
        Ok(Self {
            stream,
            begins: water.begins,
            // λ³ grains of area 1/λ² each.
            factor: if water.drag_by_volume {
                constants.lambda
            } else {
                1.0
            },
            lost_bed: Arc::default(),
        })
    }
}

/// u* in m/s at the start of the flow.
pub(crate) fn friction_velocity(
    scene: &scene::Scene,
    water: &scene::Water,
) -> Result<f64, Unphysical> {
    Ok(match &water.flow {
        scene::Flow::Shields(shields) => clear_water(water, scene.gravity)
            .friction_velocity(&sediment(&scene.grains), *shields)?,
        scene::Flow::FrictionVelocity(speed) => *speed,
        scene::Flow::OverTime(rows) => rows.iter().map(|row| row[1]).fold(0.0, f64::max),
    })
}

fn setting(
    scene: &scene::Scene,
    water: &scene::Water,
    constants: &Constants,
) -> Result<Setting, Unphysical> {
    let diameter = constants.kind.diameter();
    let speed = friction_velocity(scene, water)?;
    let usual = Setting::over_grains(diameter, speed, 1);
    Ok(Setting {
        water: clear_water(water, scene.gravity),
        profile: match &water.profile {
            scene::FlowProfile::Log { karman } => Profile::Log(LogLaw {
                karman: *karman,
                ..LogLaw::over_grains(diameter)
            }),
            scene::FlowProfile::Given(rows) => Profile::measured(rows, speed)?,
        },
        friction_velocity: match &water.flow {
            scene::Flow::OverTime(rows) => Table::new(rows.clone())?,
            _ => Table::constant(speed),
        },
        turbulence: match water.turbulence {
            scene::Turbulence::Off => Turbulence::none(),
            scene::Turbulence::Switched {
                frequency,
                depth,
                seed,
            } => Turbulence {
                frequency,
                depth,
                ..Turbulence::open_channel(seed)
            },
        },
        shelter: Shelter {
            floor: water.shelter,
            ..Shelter::among_grains(diameter)
        },
        bed_contacts: water.bed_contacts,
        datum: match water.datum {
            scene::Datum::Renewed => Datum::Renewed,
            scene::Datum::Frozen => Datum::Frozen,
            scene::Datum::Given(height) => Datum::Given(height),
        },
        ..usual
    })
}

/// Its random numbers come from the seed, the grain and the number of the switch, so the bed is all that it knows.
impl Saved for Flow {
    fn save(&self, words: &mut Words) {
        words.put_part("water");
        let bed = self.stream.bed();
        words.put_maybe(bed.level);
        words.put_flag(bed.switch.is_some());
        words.put_whole(bed.switch.unwrap_or(0));
        words.put_flag(self.lost_bed.load(Ordering::Relaxed));
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("water")?;
        let level = words.take_maybe()?;
        let looked = words.take_flag()?;
        let switch = words.take_whole()?;
        self.stream.restore(Bed {
            level,
            switch: looked.then_some(switch),
        });
        self.lost_bed.store(words.take_flag()?, Ordering::Relaxed);
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Load<D, S> for Flow {
    fn is_due(&self, t: f64) -> bool {
        t >= self.begins && self.stream.is_due(t - self.begins)
    }

    fn renew(&mut self, view: &dyn View<D, S>, t: f64) {
        let mut contacts = vec![0u32; view.len()];
        view.touching(&mut |pair| {
            contacts[pair.i] += 1;
            contacts[pair.j] += 1;
        });
        // A fixed row is no bed of its own: water over it alone would have carried everything away.
        let grains = (0..view.len())
            .filter(|&i| view.kind(i).mass.is_finite())
            .map(|i| (view.position(i).axis(D::UP), contacts[i]));
        if self.stream.renew(t - self.begins, grains).is_err() {
            self.lost_bed.store(true, Ordering::Relaxed);
        }
    }

    fn push(&self, t: f64, grains: &[Seen<D>], force: &mut [D::V]) {
        let Some(current) = self.stream.at(t - self.begins).filter(|_| t >= self.begins) else {
            return;
        };
        for (grain, force) in grains.iter().zip(force) {
            let drag = current.force::<D>(
                grain.position,
                grain.velocity,
                grain.identity,
                2.0 * grain.radius,
            );
            *force += drag * self.factor;
        }
    }
}
