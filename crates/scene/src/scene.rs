//! The checked scene: plain SI numbers, every choice an enum, every default filled in.

mod flow;
mod motion;
mod river;
mod wall;

use std::f64::consts::PI;
use std::path::PathBuf;

use glam::DVec3;

pub use flow::{Conveying, Fate, Inlet, Measures, Outlet, Region};
pub use motion::{Begin, Course, Motion, Shift, Turn};
pub use river::{
    Bed, BedMeasure, Datum, Flow, FlowProfile, NormalForce, Slip, SpringConstants, SpringDashpot,
    Tension, Turbulence, Water,
};
pub use wall::{Hand, MeshFile, MeshSurface, Removal, Shape, Thin, TouchesAt, Wall};

/// A scene that has passed every check of this crate; all numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What the scene shows, for plots and summaries.
    pub title: String,
    /// Space (3D), or the vertical plane of x and z.
    pub space: Space,
    /// Acceleration of gravity along −z, m/s², not negative.
    pub gravity: f64,
    /// The one kind of grain.
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
    /// The water over the bed, if there is any.
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

/// The grain at coarse level n = 0, and how it is softened and coarsened.
#[derive(Clone, Debug, PartialEq)]
pub struct Grains {
    /// Diameter, m, at n = 0.
    pub diameter: f64,
    /// Mass of one grain, kg, at n = 0 (from the density if the scene gives that).
    pub mass: f64,
    /// The law between grains, constants at n = 0 and before softening.
    pub law: Law,
    /// The stiffness is divided by this, at least 1.
    pub soften: f64,
    /// What softening does to the damping.
    pub softened_damping: SoftenedDamping,
    /// Number of renormalisations n, at most 8.
    pub coarse: u32,
    /// What one renormalisation does to the constants.
    pub coarse_rule: CoarseRule,
}

impl Grains {
    /// Volume of one grain at n = 0, m³.
    pub fn volume(&self) -> f64 {
        PI / 6.0 * self.diameter.powi(3)
    }

    /// Density, kg/m³; the same at every coarse level.
    pub fn density(&self) -> f64 {
        self.mass / self.volume()
    }

    /// λ = 2ⁿ, by which the coarse grain's diameter exceeds the real one's.
    pub fn lambda(&self) -> f64 {
        f64::from(1_u32 << self.coarse.min(31))
    }
}

/// A contact law with its constants.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Lennard-Jones repulsion with viscous damping.
    Repulsion {
        /// How stiff a contact is.
        stiffness: Stiffness,
        /// How a contact damps.
        damping: Damping,
    },
    /// Springs and dashpots with friction, for grains that spin.
    SpringDashpot(SpringDashpot),
}

/// The stiffness of law `Repulsion`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stiffness {
    /// Young's modulus, Pa; the law derives ε and σ from it and from the diameter.
    YoungModulus(f64),
    /// The law's own constants.
    Energy {
        /// ε, J.
        epsilon: f64,
        /// σ, m; the reach 2^(1/6) σ is the diameter within 1 %.
        sigma: f64,
    },
}

/// Viscous damping coefficients of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// γ in every direction, kg/s.
    Equal(f64),
    /// γ along and across the line of centres, kg/s.
    Parts {
        /// γn, kg/s.
        normal: f64,
        /// γt, kg/s.
        tangential: f64,
    },
}

/// What softening the stiffness by s does to the damping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SoftenedDamping {
    /// Nothing: creep stays as it is, the damping ratio grows by √s.
    #[default]
    Kept,
    /// Both parts are divided by √s: the restitution stays as it is, creep runs √s faster.
    Scaled,
    /// The normal part is divided by √s, the tangential part kept.
    NormalScaled,
}

/// The rule of coarse-graining.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoarseRule {
    /// The renormalisation of the paper: ε λ³, σ λ, γ λ², Δt λ.
    #[default]
    Renormalised,
    /// Sakai and Koshizuka: stiffness and damping λ³, Δt not enlarged.
    SakaiKoshizuka,
    /// Radl's corrected restitution.
    RadlRestitution,
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

/// Where the grains are at the start.
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// Read from this file (an absolute path), see [`GrainFile`](crate::GrainFile).
    File(PathBuf),
    /// Placed at random in a box or in a mesh.
    Fill(Fill),
    /// A bed on a fixed row.
    Bed(Bed),
    /// Listed in the scene.
    Grains(Vec<StartingGrain>),
}

/// Room to be filled with grains at random: a box, the inside of a mesh, or what both have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Fill {
    /// The box; `None` only with a mesh: the box around it.
    pub region: Option<Region>,
    /// Grains are only placed inside this closed mesh; `None`: anywhere in the box.
    pub within: Option<MeshFile>,
    /// Share of that room (in the plane: of its area) taken by grains.
    pub solid_fraction: f64,
    /// Seed of the random places.
    pub seed: u64,
}

impl Fill {
    /// Number of grains of this diameter (m) that the fill asks for in its box, see [`count_in`](Fill::count_in).
    /// Without a box it is 0: the room inside the mesh is known only once the mesh is read.
    pub fn count(&self, diameter: f64, space: Space) -> usize {
        let size = self
            .region
            .map_or(DVec3::ZERO, |region| region.max - region.min);
        let room = match space {
            Space::Space => size.x * size.y * size.z,
            Space::Plane => size.x * size.z,
        };
        self.count_in(room, diameter, space)
    }

    /// Number of grains of this diameter (m) that the fill asks for in so much room (m³, in the plane m²),
    /// rounded to the nearest; huge rooms saturate.
    pub fn count_in(&self, room: f64, diameter: f64, space: Space) -> usize {
        let grain = match space {
            Space::Space => PI / 6.0 * diameter.powi(3),
            Space::Plane => PI / 4.0 * diameter.powi(2),
        };
        (self.solid_fraction * (room / grain)).round() as usize
    }
}

/// A grain at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartingGrain {
    /// Its centre, m.
    pub at: DVec3,
    /// Its velocity, m/s.
    pub velocity: DVec3,
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
