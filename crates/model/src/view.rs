//! How observers and gates look at a running simulation, and what they may say.

use crate::{Damaged, Dim, Kind, Saved, SpinState, Words};
use std::borrow::Cow;

/// Energies in J. Everything that leaves is summed step by step, nothing is inferred as a remainder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Σ ½ m v².
    pub kinetic: f64,
    /// Σ −m g·x.
    pub gravitational: f64,
    /// Elastic energy between grains.
    pub elastic: f64,
    /// Elastic energy of grains against walls.
    pub elastic_walls: f64,
    /// Lost so far to damping between grains.
    pub lost_damping: f64,
    /// Lost so far to damping at walls.
    pub lost_wall_damping: f64,
    /// Lost so far to friction at walls.
    pub lost_wall_friction: f64,
    /// Elastic energy that left with a removed wall.
    pub taken_by_removal: f64,
    /// Work that moving bodies have done on the grains so far.
    pub work_of_bodies: f64,
    /// What the grains that came brought, less what those that went took along.
    pub brought_by_grains: f64,
}

impl Energies {
    /// What the run still holds plus what it has lost less what it was given: constant if the books close.
    pub fn total(&self) -> f64 {
        self.held() - self.work_of_bodies - self.brought_by_grains
            + self.lost_damping
            + self.lost_wall_damping
            + self.lost_wall_friction
            + self.taken_by_removal
    }

    /// Kinetic, gravitational and elastic energy.
    pub fn held(&self) -> f64 {
        self.kinetic + self.gravitational + self.elastic + self.elastic_walls
    }
}

impl Energies {
    /// Every entry, in the order in which they are saved.
    fn entries(&mut self) -> [&mut f64; 10] {
        [
            &mut self.kinetic,
            &mut self.gravitational,
            &mut self.elastic,
            &mut self.elastic_walls,
            &mut self.lost_damping,
            &mut self.lost_wall_damping,
            &mut self.lost_wall_friction,
            &mut self.taken_by_removal,
            &mut self.work_of_bodies,
            &mut self.brought_by_grains,
        ]
    }
}

impl Saved for Energies {
    fn save(&self, words: &mut Words) {
        let mut all = *self;
        for value in all.entries() {
            words.put_number(*value);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        for value in self.entries() {
            *value = words.take_number()?;
        }
        Ok(())
    }
}

/// A pair of touching grains.
#[derive(Clone, Copy, Debug)]
pub struct TouchingPair {
    /// Index of one grain.
    pub i: usize,
    /// Index of the other.
    pub j: usize,
    /// Range of the law minus the distance of the centres, in m.
    pub overlap: f64,
}

/// A body as observers see it.
#[derive(Clone, Debug)]
pub struct BodyState<D: Dim> {
    /// Its name in the scene.
    pub name: String,
    /// When it was taken away, if it was, in s.
    pub removed_at: Option<f64>,
    /// Sum of the forces of all grains on it, in N.
    pub force: D::V,
    /// Their torque about the body's pivot (a point of its axis of rotation), in N m.
    pub torque: glam::DVec3,
    /// Where it is and how it moves.
    pub pose: crate::Pose,
}

impl<D: Dim> BodyState<D> {
    /// Power in W that the body's drive gives to the grains: −(force · velocity + torque · spin).
    pub fn power(&self) -> f64 {
        -(D::to_space(self.force).dot(self.pose.velocity) + self.torque.dot(self.pose.spin))
    }
}

/// Grains that came or went through one gate since the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// The gate's name in the scene.
    pub name: String,
    /// How many came into the scene.
    pub came: u64,
    /// How many went out of it.
    pub went: u64,
    /// How many it moved to another place: gone and come in one.
    pub moved: u64,
    /// Mass of those that went or were moved, in kg.
    pub mass: f64,
}

impl Passage {
    /// A gate through which no grain has come or gone yet.
    pub fn of(name: String) -> Self {
        Self {
            name,
            came: 0,
            went: 0,
            moved: 0,
            mass: 0.0,
        }
    }
}

/// What has come and gone; the name is the scene's.
impl Saved for Passage {
    fn save(&self, words: &mut Words) {
        for count in [self.came, self.went, self.moved] {
            words.put_whole(count);
        }
        words.put_number(self.mass);
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        for count in [&mut self.came, &mut self.went, &mut self.moved] {
            *count = words.take_whole()?;
        }
        self.mass = words.take_number()?;
        Ok(())
    }
}

/// A running simulation, read only.
pub trait View<D: Dim, S: SpinState> {
    /// Simulated time in s.
    fn time(&self) -> f64;
    /// Number of grains.
    fn len(&self) -> usize;
    /// True if there are no grains.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Centre of grain `i` in m.
    fn position(&self, i: usize) -> D::V;
    /// Velocity of grain `i` in m/s.
    fn velocity(&self, i: usize) -> D::V;
    /// Angular velocity of grain `i` in rad/s.
    fn spin(&self, i: usize) -> S::Turn<D>;
    /// Kind of grain `i`.
    fn kind(&self, i: usize) -> &Kind;
    /// Identity of grain `i`: it never changes, whatever the order in memory.
    fn identity(&self, i: usize) -> u32;
    /// Bodies in the order of the scene.
    fn bodies(&self) -> Vec<BodyState<D>>;
    /// Grains that came and went, one entry per gate that can let them.
    fn passages(&self) -> Vec<Passage>;
    /// Gravity in m/s².
    fn gravity(&self) -> D::V;
    /// The energy budget; walks all contacts.
    fn energies(&self) -> Energies;
    /// Every touching pair once.
    fn touching(&self, each: &mut dyn FnMut(TouchingPair));
}

/// What a gate asks the engine to change at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Take away body number `.0`.
    RemoveBody(usize),
    /// Body number `.0`, which was waiting for it, begins its motion.
    StartBody(usize),
    /// A new grain, at rest.
    Add {
        /// Centre in m.
        position: glam::DVec3,
        /// Number of its kind.
        kind: usize,
        /// Through which gate.
        gate: usize,
    },
    /// A grain goes.
    Remove {
        /// Which.
        identity: u32,
        /// Through which gate.
        gate: usize,
    },
    /// A grain is put elsewhere, at rest, and forgets its contacts.
    Move {
        /// Which.
        identity: u32,
        /// New centre in m.
        position: glam::DVec3,
        /// Through which gate.
        gate: usize,
    },
}

/// Something that changes the scene while it runs: a wall that goes when the grains are still.
pub trait Gate<D: Dim, S: SpinState>: Saved + Send {
    /// Looks and decides; called every few steps at a fixed cadence.
    fn decide(&mut self, view: &dyn View<D, S>, out: &mut Vec<Change>);
}

/// One measured value.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Stable name, as in `summary.json`; what belongs to a body ends with its name: `torque_x_on_screw`.
    pub name: Cow<'static, str>,
    /// The value.
    pub value: f64,
    /// Its uncertainty (one standard deviation), if known.
    pub uncertainty: Option<f64>,
    /// Unit.
    pub unit: &'static str,
}

impl Reading {
    /// A value without a known uncertainty.
    pub fn new(name: impl Into<Cow<'static, str>>, value: f64, unit: &'static str) -> Self {
        Self {
            name: name.into(),
            value,
            uncertainty: None,
            unit,
        }
    }

    /// With a standard deviation.
    pub fn give_or_take(mut self, uncertainty: f64) -> Self {
        self.uncertainty = Some(uncertainty);
        self
    }
}

/// A curve to draw or tabulate, such as the profile of a heap at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The figure it belongs to, a stable name fit for a file: `profile`.
    pub figure: &'static str,
    /// Its own label: `0.50 s after the wall's removal`.
    pub label: String,
    /// Axis labels with units.
    pub axes: [&'static str; 2],
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
}

/// A measure: it looks at the simulation at the output cadence and reports numbers.
pub trait Observer<D: Dim, S: SpinState>: Saved + Send {
    /// Looks once and gives the values of this moment: one row of `series.csv`, always the same names in the same order.
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading>;
    /// What it has to say at the end: entries of `summary.json`.
    fn report(&self) -> Vec<Reading> {
        Vec::new()
    }
    /// Curves worth a figure at the end.
    fn curves(&self) -> Vec<Curve> {
        Vec::new()
    }
}
