//! The checked scene: plain SI numbers, every choice an enum, every default filled in.

mod flow;
mod grains;
mod hertz_mindlin;
mod initial;
mod motion;
mod seeds;
mod springs;
mod wall;
mod water;

pub use flow::{BedMeasure, Conveying, Discharge, Fate, Inlet, Measures, Opening, Outlet, Region};
pub use grains::{
    CoarseRule, Damping, Grains, Law, Material, PairOf, Population, SoftenedDamping, Stiffness,
};
pub use hertz_mindlin::{HertzMindlin, Resistance, RollingResistance};
pub use initial::{Bed, Fill, Initial, StartingGrain};
pub use motion::{Begin, Course, Motion, Shift, Turn};
pub use springs::{NormalForce, Slip, SpringConstants, SpringDashpot, Tension};
pub use wall::{Hand, MeshFile, MeshSurface, Removal, Shape, Thin, TouchesAt, Wall};
pub use water::{Datum, Flow, FlowProfile, Turbulence, Water};

/// A scene that has passed every check of this crate; all numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What the scene shows, for plots and summaries.
    pub title: String,
    /// Space (3D), or the vertical plane of x and z.
    pub space: Space,
    /// Acceleration of gravity, m/s², not negative; along −z but for the slope of the water's bed.
    pub gravity: f64,
    /// The grains.
    pub grains: Grains,
    /// Which axes are periodic.
    pub domain: Domain,
    /// Walls in the order of the file; names are unique.
    pub walls: Vec<Wall>,
    /// Where the grains are at the start.
    pub initial: Initial,
    /// Where grains leave, in the order of the file.
    pub outlets: Vec<Outlet>,
    /// Where grains come in, in the order of the file.
    pub inlets: Vec<Inlet>,
    /// The water that flows over the grains, if there is any.
    pub water: Option<Water>,
    /// When the grains count as still; present exactly when a wall waits for it, to be removed or to move.
    pub still: Option<Still>,
    /// The step, the scheme and the end.
    pub time: Time,
    /// Skin of the neighbour list as a share of the grain's diameter; `None`: the program chooses.
    pub skin: Option<f64>,
    /// What is measured beside the usual.
    pub measures: Measures,
    /// What is written.
    pub output: Output,
}

/// The dimension of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// Three dimensions, z up.
    #[default]
    Space,
    /// The vertical plane of x and z, spheres one grain deep; every y of the scene is zero.
    Plane,
}

/// The periodic axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Domain {
    /// Along x.
    pub x: Axis,
    /// Along y; `Open` in the plane.
    pub y: Axis,
    /// Along z.
    pub z: Axis,
}

/// One axis of the domain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Axis {
    /// Without end.
    #[default]
    Open,
    /// Repeating; runs from 0 to this length, m.
    Periodic(f64),
}

/// When the grains count as still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Still {
    /// Kinetic energy per grain, as a share of m g d.
    pub kinetic_energy: f64,
    /// For how long it stays below, s.
    pub for_at_least: f64,
    /// The run fails when they are not still by this time from the start, s.
    pub at_most: f64,
    /// Share of the grains' damping while they settle, in (0, 1]: creep to rest is faster with less.
    /// The full damping acts from the moment of stillness on.
    pub damping: f64,
}

/// Time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// How the step is chosen.
    pub step: Step,
    /// The scheme.
    pub integrator: Integrator,
    /// When the run ends.
    pub end: End,
}

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A twentieth of the period of a contact, or less where damping or packing ask for it.
    Automatic,
    /// This many steps per period of a contact.
    PerPeriod(f64),
    /// Δt at coarse level 0, s; multiplied by what the coarse rule says.
    Seconds(f64),
    /// Δt as it is used, s.
    Exactly(f64),
}

/// The scheme of integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Explicit Euler: never stable without damping; for the charts.
    ExplicitEuler,
    /// Velocities first, then positions.
    #[default]
    SymplecticEuler,
    /// Velocity Verlet, damping from the old velocity.
    VerletOld,
    /// Velocity Verlet, damping from the mean of old and new velocity.
    VerletAveraged {
        /// Sweeps of the pairwise solution.
        sweeps: u32,
    },
    /// Damping from the new velocity.
    DashpotImplicit {
        /// Sweeps of the pairwise solution.
        sweeps: u32,
    },
}

/// The end of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// At this time, s, from the moment of stillness if a wall waits for it, else from the start.
    Until(f64),
    /// After this many steps, counted from the same moment.
    Steps(u64),
}

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output {
    /// Interval of the rows of the series, s; `None`: 100 rows over the run.
    pub every: Option<f64>,
    /// Whether frames are written.
    pub frames: bool,
    /// Interval of the frames, s; `None`: as the rows.
    pub frames_every: Option<f64>,
    /// Whether the energies are tallied.
    pub energies: bool,
    /// Whether an animation is drawn.
    pub animation: bool,
}

impl Default for Output {
    fn default() -> Self {
        Output {
            every: None,
            frames: true,
            frames_every: None,
            energies: false,
            animation: true,
        }
    }
}

impl Scene {
    /// Whether a wall waits for the grains to be still, to be removed or to begin to move.
    pub fn waits_for_stillness(&self) -> bool {
        self.removes_when_still() || self.moves_when_still()
    }

    pub(crate) fn removes_when_still(&self) -> bool {
        self.walls
            .iter()
            .any(|wall| wall.removed == Removal::WhenStill)
    }

    pub(crate) fn moves_when_still(&self) -> bool {
        let waits = |motion: &Motion| motion.begins == Begin::WhenStill;
        self.walls
            .iter()
            .any(|wall| wall.motion.as_ref().is_some_and(waits))
    }
}
