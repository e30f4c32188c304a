//! Where the run-time choices become types: dimension, damping, tally.

use crate::constants::Constants;
use crate::flow::{InletGate, OutletGate};
use crate::gate::{WallChanges, at_release, removed_at};
use crate::in_box::bodies_stay;
use crate::observers::observers_of;
use crate::plan::Plan;
use crate::simulation::{Release, Running, Simulation};
use crate::start;
use crate::surfaces::{Shaped, Shapes};
use crate::water::Flow;
use std::path::PathBuf;
use std::sync::Arc;
use tsubu_engine::{Body, KindSet, Lanes, Layout, Placed, Setup, Tally, TouchesAt, World};
use tsubu_measure::Slices;
use tsubu_model::{
    ContactLaw, Course, Dim, Domain, Gate, Motion, Plane, Shift, Space, Span, SpinState, Surface,
    Turn,
};
use tsubu_scene as scene;
use tsubu_scene::{Axis, Checked, Removal, SceneError};

/// What the caller chooses about the machine, not about the physics. No choice changes a bit of the result.
#[derive(Clone, Debug, Default)]
pub struct Choices {
    /// Threads; `None` takes as many as pay for the number of grains.
    pub threads: Option<usize>,
    /// Vector path; `None` takes the widest.
    pub lanes: Option<Lanes>,
    /// Runs a scene whose step is over its limit.
    pub allow_unstable: bool,
    /// Folder where grids of distances are kept for the next run; `None` builds them every time.
    pub grids: Option<PathBuf>,
    /// Hears how far the building of a grid is.
    pub watch: Option<Watch>,
}

/// Hears the name of a wall and the share of its grid that is built, from any thread.
#[derive(Clone)]
pub struct Watch(pub Arc<Hearer>);

/// What a [`Watch`] calls.
pub type Hearer = dyn Fn(&str, f64) + Send + Sync;

impl std::fmt::Debug for Watch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Watch")
    }
}

/// A scene ready to run.
pub struct Built {
    /// The simulation at time 0.
    pub simulation: Box<dyn Simulation>,
    /// What it models.
    pub plan: Plan,
}

/// Grains per thread below which another thread costs more than it gives
/// (`cargo run -p tsubu-engine --example packing` with 1 and 2 threads on heads of packing.csv).
const GRAINS_PER_THREAD: usize = 2500;

/// Steps after which the packing of a dry scene that may be over its limit is first held against it: that costs some
/// hundred steps.
const WEIGH_FROM: u64 = 10_000;

/// Builds the simulation of a checked scene.
pub fn build(checked: &Checked, choices: &Choices) -> Result<Built, SceneError> {
    match checked.scene.space {
        scene::Space::Space => in_dimension::<Space>(checked, choices),
        scene::Space::Plane => in_dimension::<Plane>(checked, choices),
    }
}

fn in_dimension<D: Shaped + Slices>(
    checked: &Checked,
    choices: &Choices,
) -> Result<Built, SceneError> {
    let constants = Constants::of(checked)?;
    let domain = domain_of::<D>(checked, &constants)?;
    let shapes = Shapes {
        checked,
        choices,
        diameter: constants.kind.diameter(),
    };
    let (mut surfaces, mut wall_grains) = (Vec::new(), Vec::new());
    for wall in 0..checked.scene.walls.len() {
        let made = D::surface(&shapes, wall)?;
        surfaces.push(made.surface);
        wall_grains.push(made.wall_grains);
    }
    let of_grains: Vec<bool> = wall_grains.iter().map(Option::is_some).collect();
    bodies_stay::<D>(checked, &surfaces, &of_grains, &domain, constants.dt)?;
    let grains = start::grains::<D>(checked, &constants, &domain, &surfaces)?;
    let threads = choices
        .threads
        .unwrap_or_else(|| threads_that_pay(grains.len()))
        .max(1);
    let lanes = choices.lanes.unwrap_or_else(Lanes::best);
    let mut plan = Plan::of(checked, &constants, grains.len(), threads, lanes.name());
    plan.say_wall_grains(checked, &wall_grains);
    let pool = if threads > 1 {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        Some(Arc::new(pool.map_err(|e| {
            checked.problem(
                "",
                format!("{threads} threads could not be started: {e}"),
                "ask for fewer with --threads",
            )
        })?))
    } else {
        None
    };
    let water = match &checked.scene.water {
        Some(water) => Some(Flow::of(checked, water, &constants)?),
        None => None,
    };
    let parts = Parts {
        checked,
        water,
        allow_unstable: choices.allow_unstable,
        bounded: plan.is_bounded(),
        constants: &constants,
        surfaces,
        domain,
        grains,
        lanes,
        pool,
    };
    let share = checked.scene.still.map_or(1.0, |s| s.damping);
    // The order that `start` and `bed` count on: populations, or the one kind, and the fixed row last.
    let mut kinds = constants.populations.clone();
    if kinds.is_empty() {
        kinds.push(constants.kind);
    }
    kinds.extend(constants.fixed);
    let simulation = constants.law.run(parts, kinds, share);
    plan.weigh(&*simulation);
    if !choices.allow_unstable {
        plan.refuse_unstable(checked, &*simulation)?;
    }
    Ok(Built { simulation, plan })
}

/// Everything but the law and the tally.
pub(crate) struct Parts<'a, D: Layout> {
    checked: &'a Checked,
    constants: &'a Constants,
    water: Option<Flow>,
    allow_unstable: bool,
    /// True if no packing of these grains can be over its limit.
    bounded: bool,
    surfaces: Vec<Arc<dyn Surface<D>>>,
    domain: Domain<D>,
    grains: Vec<Placed<D>>,
    lanes: Lanes,
    pool: Option<Arc<rayon::ThreadPool>>,
}

impl<D: Layout + Slices> Parts<'_, D> {
    /// True if the scene asks for energies.
    pub fn wants_energies(&self) -> bool {
        self.checked.scene.output.energies
    }

    /// `settling` is the law until the release, `law` from then on; without a release `law` throughout.
    pub fn run<S, K, L, W, T>(
        self,
        kinds: K,
        law: L,
        settling: L,
        walls: Vec<W>,
    ) -> Box<dyn Simulation>
    where
        S: SpinState,
        K: KindSet,
        L: ContactLaw<D, S> + 'static,
        W: ContactLaw<D, S> + 'static,
        T: Tally,
    {
        let scene = &self.checked.scene;
        let bodies = scene
            .walls
            .iter()
            .zip(&self.surfaces)
            .zip(walls)
            .map(|((wall, surface), law)| Body {
                name: wall.name.clone(),
                surface: surface.clone(),
                law,
                touches_at: match (wall.shape.wall_grains(), wall.touches_at) {
                    (Some(radius), _) => TouchesAt::WallGrains(radius),
                    (None, scene::TouchesAt::Surface) => TouchesAt::Surface,
                    (None, scene::TouchesAt::Centre) => TouchesAt::Centre,
                },
                removed_at: None,
                motion: motion_of(wall),
                waits: wall
                    .motion
                    .as_ref()
                    .is_some_and(|m| m.begins == scene::Begin::WhenStill),
            })
            .collect();
        let release = release_of(scene);
        let (law, law_after) = if release.is_some() {
            (settling, Some(law))
        } else {
            (law, None)
        };
        let mut world = World::new(Setup {
            kinds,
            law,
            bodies,
            domain: self.domain,
            gravity: D::from_space(gravity_of(scene)),
            scheme: self.constants.scheme,
            dt: self.constants.dt,
            skin: scene
                .skin
                .map(|share| share * self.constants.kind.diameter()),
            lanes: self.lanes,
            pool: self.pool,
            grains: self.grains,
            gates: scene
                .outlets
                .iter()
                .map(|o| o.name.clone())
                .chain(scene.inlets.iter().map(|i| i.name.clone()))
                .collect(),
        });
        let water = self.water.map(|water| {
            let lost_bed = water.lost_bed.clone();
            world.add_load(Box::new(water));
            lost_bed
        });
        let begins = scene.water.as_ref().map(|water| water.begins);
        let weigh_again = !self.bounded && begins.is_none();
        let movers: Vec<bool> = scene.walls.iter().map(|w| w.motion.is_some()).collect();
        let works = water.is_some() || movers.contains(&true);
        let watches_energy = !works && scene.outlets.is_empty() && scene.inlets.is_empty();
        Box::new(Running::<D, S, K, L, W, T> {
            shells: self
                .surfaces
                .iter()
                .map(|s| s.shell().map(Arc::new))
                .collect(),
            observers: observers_of(scene, self.constants, &self.domain, &self.surfaces, &movers),
            movers,
            gates: gates_of(scene, self.constants),
            surfaces: self.surfaces,
            gate_every: gate_every(scene, self.constants.dt),
            end: scene.time.end,
            release,
            trouble: None,
            deep: self.constants.law.deep(),
            watches_energy,
            books: None,
            lost_bed: water,
            // Grains that turn have stiffer motions than the tables of limits know.
            weighs_released: !self.bounded,
            weigh_at: begins
                .map(|t| (t / self.constants.dt).round() as u64)
                .or(weigh_again.then_some(WEIGH_FROM)),
            weigh_again,
            refuse_unstable: !self.allow_unstable,
            used: None,
            law_after,
            at_release: at_release(scene),
            removed_at: removed_at(scene),
            world,
        })
    }
}

/// Downwards, and leaning by the slope of the bed.
fn gravity_of(scene: &scene::Scene) -> glam::DVec3 {
    let slope = scene.water.as_ref().map_or(0.0, |water| water.slope);
    let along = glam::DVec3::new(slope, 0.0, -1.0);
    if slope == 0.0 {
        return along * scene.gravity;
    }
    along.normalize() * scene.gravity
}

/// The motion of a wall, counted from the start, or from the moment for which it waits.
fn motion_of(wall: &scene::Wall) -> Motion {
    let Some(motion) = &wall.motion else {
        return Motion::default();
    };
    let start = match motion.begins {
        scene::Begin::At(time) => time,
        scene::Begin::WhenStill => 0.0,
    };
    let span = Span {
        start,
        stop: motion.lasts.map_or(f64::INFINITY, |lasts| start + lasts),
    };
    Motion {
        turn: motion.turn.map(|turn| Turn {
            point: turn.point,
            axis: turn.axis,
            rate: turn.rate,
            span,
        }),
        shifts: motion
            .shifts
            .iter()
            .map(|shift| Shift {
                direction: shift.direction,
                course: match shift.course {
                    scene::Course::Steady(speed) => Course::Steady(speed),
                    scene::Course::Swing {
                        amplitude,
                        frequency,
                    } => Course::Swing {
                        amplitude,
                        frequency,
                    },
                },
                span,
            })
            .collect(),
    }
}

/// True if the wall waits for stillness, to go or to move.
fn waits(wall: &scene::Wall) -> bool {
    let starts = |m: &scene::Motion| m.begins == scene::Begin::WhenStill;
    wall.removed == Removal::WhenStill || wall.motion.as_ref().is_some_and(starts)
}

fn domain_of<D: Dim>(checked: &Checked, constants: &Constants) -> Result<Domain<D>, SceneError> {
    let axes = checked.scene.domain;
    let length = |axis: Axis| match axis {
        Axis::Periodic(length) => length,
        Axis::Open => f64::INFINITY,
    };
    // A grain must not see itself or one partner twice.
    for (name, axis) in [
        ("domain.x", axes.x),
        ("domain.y", axes.y),
        ("domain.z", axes.z),
    ] {
        if length(axis) < 3.0 * constants.kind.diameter() {
            let what = format!(
                "the period is {:.2} grain diameters; it must be at least 3, or a grain meets itself",
                length(axis) / constants.kind.diameter()
            );
            return Err(checked.problem(name, what, "lengthen the period or lower grains.coarse"));
        }
    }
    Ok(Domain {
        period: D::from_space(glam::DVec3::new(
            length(axes.x),
            length(axes.y),
            length(axes.z),
        )),
    })
}

fn release_of(scene: &scene::Scene) -> Option<Release> {
    let body = scene.walls.iter().position(waits)?;
    let still = scene.still?;
    Some(Release {
        body,
        at_most: still.at_most,
        asked: still.kinetic_energy,
        at_step: None,
    })
}

/// A tenth of the time for which the grains must be still, or a thousand steps.
fn gate_every(scene: &scene::Scene, dt: f64) -> u64 {
    let still = scene
        .still
        .map_or(u64::MAX, |s| (0.1 * s.for_at_least / dt) as u64);
    still.clamp(1, 1000)
}

fn gates_of<D: Dim, S: SpinState>(
    scene: &scene::Scene,
    constants: &Constants,
) -> Vec<Box<dyn Gate<D, S>>> {
    let mut gates: Vec<Box<dyn Gate<D, S>>> = Vec::new();
    let changes = WallChanges::of(scene);
    if changes.is_needed() {
        gates.push(Box::new(changes));
    }
    for (number, outlet) in scene.outlets.iter().enumerate() {
        gates.push(Box::new(OutletGate {
            outlet: outlet.clone(),
            number,
        }));
    }
    for (number, inlet) in scene.inlets.iter().enumerate() {
        gates.push(Box::new(InletGate {
            inlet: inlet.clone(),
            number: scene.outlets.len() + number,
            diameter: constants.kind.diameter(),
        }));
    }
    gates
}

/// As many threads as pay for this number of grains.
pub fn threads_that_pay(grains: usize) -> usize {
    let here = std::thread::available_parallelism().map_or(1, |n| n.get());
    (grains / GRAINS_PER_THREAD).clamp(1, here)
}
