//! What a scene models and what not, and how far its step is from each limit.

use crate::constants::Constants;
use crate::simulation::Simulation;
use std::f64::consts::PI;
use tsubu_integrate::Scheme;
use tsubu_model::{Kind, Linear};
use tsubu_scene::{
    Axis, Begin, Checked, Course, End, Fate, Flow, Initial, MeshSurface, Motion, PairOf,
    Population, Scene, SceneError, Shape, Turbulence,
};

/// Name of the limit that is worked out for the very contacts of the start.
const PACKING: &str = "the packing as it lies";

/// Grains from which on the start is not weighed where cheaper bounds accept it: it costs as much as some hundred steps.
const MANY: usize = 10_000;

/// One limit of the step.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitLine {
    /// What it is the limit of.
    pub name: String,
    /// Share of it that the scene uses: stable below 1.
    pub used: f64,
}

impl LimitLine {
    /// True if the step keeps within it; NaN does not.
    pub fn holds(&self) -> bool {
        self.used < 1.0
    }
}

/// A scene in words and numbers, before it runs.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Number of grains.
    pub grains: usize,
    /// The constants that run.
    pub constants: Constants,
    /// What is modelled, a line each.
    pub modelled: Vec<String>,
    /// What is not, a line each.
    pub not_modelled: Vec<String>,
    /// Limits of the step.
    pub limits: Vec<LimitLine>,
    /// What the packing at the start bears, if it lies there already; then it alone decides.
    pub packing: Option<LimitLine>,
    /// Steps after the start or after the release of the waiting wall.
    pub steps: u64,
    /// Threads.
    pub threads: usize,
    /// Vector path.
    pub lanes: &'static str,
}

impl Plan {
    pub(crate) fn of(
        checked: &Checked,
        constants: &Constants,
        grains: usize,
        threads: usize,
        lanes: &'static str,
    ) -> Self {
        let scene = &checked.scene;
        Self {
            grains,
            modelled: modelled(scene, constants),
            not_modelled: constants.law.leaves_out(scene),
            limits: constants.limits(),
            packing: None,
            steps: match scene.time.end {
                End::Until(seconds) => (seconds / constants.dt).round().max(1.0) as u64,
                End::Steps(steps) => steps,
            },
            threads,
            lanes,
            constants: constants.clone(),
        }
    }

    /// Adds what is known of bodies built of grains once they are built; per wall the number of its grains.
    pub(crate) fn say_wall_grains(&mut self, checked: &Checked, counts: &[Option<usize>]) {
        for (wall, count) in checked.scene.walls.iter().zip(counts) {
            if let (Some(count), Some(radius)) = (count, wall.shape.wall_grains()) {
                self.modelled.push(format!(
                    "wall grains of `{}`: {count}, rs/rp = {:.4}",
                    wall.name,
                    radius / self.constants.kind.radius
                ));
            }
        }
    }

    /// Adds what the packing at the start bears, if it lies there already; many grains that the bounds accept are spared.
    pub(crate) fn weigh(&mut self, simulation: &dyn Simulation) {
        if self.grains > MANY && self.is_bounded() {
            return;
        }
        let used = simulation.used_by_packing(self.constants.dt);
        self.packing = used.map(|used| LimitLine {
            name: PACKING.into(),
            used,
        });
        self.limits.extend(self.packing.clone());
    }

    /// True if the limits of the constants alone say that no packing can be over its limit: those of still grains include
    /// the densest packing. Explicit Euler has no limit for a packing.
    pub(crate) fn is_bounded(&self) -> bool {
        let still = !self.constants.law.turns();
        let known = self.constants.scheme != Scheme::ExplicitEuler;
        !known || (still && self.limits.iter().all(LimitLine::holds))
    }

    /// The limit that decides: that of the packing as it lies, or while grains have yet to meet the one that is used most.
    pub fn tightest(&self) -> Option<&LimitLine> {
        let most = || self.limits.iter().max_by(|a, b| a.used.total_cmp(&b.used));
        self.packing.as_ref().or_else(most)
    }

    /// Refuses a step over its limit.
    pub(crate) fn refuse_unstable(
        &self,
        checked: &Checked,
        simulation: &dyn Simulation,
    ) -> Result<(), SceneError> {
        let Some(worst) = self.tightest().filter(|l| !l.holds()) else {
            return Ok(());
        };
        let scheme = self.constants.scheme;
        let what = format!(
            "the step of {:.3e} s is over its limit for {}: it is {} of what {} bears",
            self.constants.dt,
            worst.name,
            if worst.used.is_finite() {
                format!("{:.0} %", 100.0 * worst.used)
            } else {
                "more than all".into()
            },
            scheme.name(),
        );
        let remedy = match self.stable_step(simulation) {
            Some(dt) => format!(
                "use a step below {dt:.3e} s (time.step: PerPeriod({:.0}) or more), another integrator, or --allow-unstable to see it fail",
                (self.constants.period / dt).ceil()
            ),
            None => format!(
                "{} has no stable step here: use another integrator, or --allow-unstable to see it fail",
                scheme.name()
            ),
        };
        Err(checked.problem("time.step", what, remedy))
    }

    /// A step under the limits that decide, within some percent of the largest.
    fn stable_step(&self, simulation: &dyn Simulation) -> Option<f64> {
        if self.packing.is_some() {
            let bears = |dt: f64| {
                simulation
                    .used_by_packing(dt)
                    .is_some_and(|used| used < 1.0)
            };
            let (mut low, mut high) = (0.5 * self.constants.dt, self.constants.dt);
            while !bears(low) {
                (low, high) = (0.5 * low, low);
                if low < 1e-6 * self.constants.dt {
                    return None;
                }
            }
            for _ in 0..6 {
                let middle = (low * high).sqrt();
                if bears(middle) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            // Off the edge, which the power method knows to 1 % only.
            return Some(0.98 * low);
        }
        let stable = |share: f64| {
            let mut constants = self.constants.clone();
            constants.dt *= share;
            constants.limits().iter().all(LimitLine::holds)
        };
        let mut share = 1.0;
        for _ in 0..2000 {
            if stable(share) {
                return Some(share * self.constants.dt);
            }
            share *= 0.99;
        }
        None
    }
}

/// The largest share of a limit that the program itself chooses.
const CHOSEN: f64 = 0.9;
/// The same for grains that turn, of the limits of pairs: a packing of them bears a fifth of what a pair does (26.2 to 5.84,
/// `Modes` of a hexagonal one), and its own limit is worked out when it lies.
const CHOSEN_OF_PAIRS: f64 = 0.15;

impl Constants {
    /// What the step uses of each limit that is known before there is a packing.
    pub fn limits(&self) -> Vec<LimitLine> {
        self.law.limits(self)
    }

    /// Shortens the step until it uses no more of its limits than the program chooses; a scheme that bears no step keeps it,
    /// and is refused.
    pub(crate) fn shorten_step(&mut self) {
        let most = if self.law.turns() {
            CHOSEN_OF_PAIRS
        } else {
            CHOSEN
        };
        let longest = self.dt;
        let holds = |constants: &Self| constants.limits().iter().all(|l| l.used <= most);
        for _ in 0..2000 {
            if holds(self) {
                return;
            }
            self.dt *= 0.99;
        }
        self.dt = longest;
    }
}

fn line(name: &str, used: f64) -> LimitLine {
    LimitLine {
        name: name.into(),
        used,
    }
}

/// The limit of a pair of grains.
pub(crate) fn pair(used: f64) -> LimitLine {
    line("a pair of grains", used)
}

/// The limit of a column of ten grains.
pub(crate) fn column(used: f64) -> LimitLine {
    line("a column of ten", used)
}

/// The limit of the densest packing.
pub(crate) fn densest(used: f64) -> LimitLine {
    line("the densest packing, twelve contacts a grain", used)
}

/// Limits of grains that turn. Rolling on each other is stiffer than pressing: a torque turns a sphere more easily than a
/// force moves it. What the packing itself bears is worked out when it lies.
pub(crate) fn of_turning(
    constants: &Constants,
    grains: &Linear,
    walls: impl Iterator<Item = Linear>,
) -> Vec<LimitLine> {
    let (limit, kind) = (constants.scheme.limit(), constants.quickest);
    let per_mass = constants.dt / kind.mass;
    // A tangential force acts on m and, through r, on I: 1/m + r²/I.
    let turning = 1.0 + kind.mass * kind.radius * kind.radius / kind.inertia;
    let of = |law: &Linear, factor: f64| {
        let k = |k: f64, f: f64| f * k * constants.dt * per_mass;
        let c = |c: f64, f: f64| f * c * per_mass;
        [
            limit.used(
                k(law.normal_stiffness, factor),
                c(law.normal_damping, factor),
            ),
            limit.used(
                k(law.tangential_stiffness, factor * turning),
                c(law.tangential_damping, factor * turning),
            ),
        ]
    };
    let [along, across] = of(grains, 2.0);
    let mut lines = vec![pair(along), line("a pair that rolls on itself", across)];
    let at_walls = walls
        .flat_map(|law| of(&law, 1.0))
        .reduce(f64::max)
        .map(|used| line("a grain at a wall", used));
    lines.extend(at_walls);
    lines
}

fn water_words(water: &tsubu_scene::Water) -> String {
    let flow = match &water.flow {
        Flow::Shields(shields) => format!("Shields number {shields}"),
        Flow::FrictionVelocity(speed) => format!("friction velocity {speed} m/s"),
        Flow::OverTime(rows) => format!("friction velocity over time, {} rows", rows.len()),
    };
    let turbulence = match water.turbulence {
        Turbulence::Off => "no turbulence".to_owned(),
        Turbulence::Switched {
            frequency, seed, ..
        } => format!("turbulence at {frequency} Hz, seed {seed}"),
    };
    format!(
        "water along x from {} s on: {flow}, {turbulence}, drag {}, added mass {}, slope {}",
        water.begins, water.drag, water.added_mass, water.slope
    )
}

fn modelled(scene: &Scene, constants: &Constants) -> Vec<String> {
    let mut lines = vec![
        match scene.space {
            tsubu_scene::Space::Space => "space: three coordinates, z up".to_owned(),
            tsubu_scene::Space::Plane => {
                "plane: two coordinates, x and z, spheres one grain deep".to_owned()
            }
        },
        format!(
            "grains: {}, d = {:.4} mm, m = {:.4e} kg{}",
            match constants.populations.len() {
                0 => "one kind".to_owned(),
                many => format!("{many} populations, the largest"),
            },
            constants.kind.diameter() * 1e3,
            constants.kind.mass,
            if scene.grains.coarse > 0 {
                format!(
                    " (n = {}, lambda = {}, rule {})",
                    scene.grains.coarse, constants.lambda, constants.rule
                )
            } else {
                String::new()
            }
        ),
        constants.law.words(constants),
    ];
    lines.extend(mixture(scene, constants));
    if scene.grains.soften > 1.0 {
        lines.push(format!(
            "softened: stiffness divided by {}",
            scene.grains.soften
        ));
    }
    if scene.gravity > 0.0 {
        lines.push(format!("weight: {} m/s2 downwards", scene.gravity));
    }
    for wall in &scene.walls {
        let part = |x: Option<f64>, name: &str, none: &str| {
            x.map_or(none.to_owned(), |x| format!("{name} {x}"))
        };
        let [bare, smooth] = constants.law.at_bare_walls();
        let friction = if constants.law.turns() {
            "friction"
        } else {
            "kinetic friction"
        };
        let material = match wall.material {
            _ if wall.shape.wall_grains().is_some() => "touched as a grain".to_owned(),
            Some(number) => format!("of {}", scene.grains.material_name(number)),
            None => format!(
                "{}, {}",
                part(wall.restitution, "restitution", bare),
                part(wall.friction, friction, smooth),
            ),
        };
        lines.push(format!(
            "wall `{}`: {}, {material}{}",
            wall.name,
            shape(&wall.shape),
            wall.motion.as_ref().map_or(String::new(), motion),
        ));
    }
    for outlet in &scene.outlets {
        let then = match outlet.then {
            Fate::Delete => "go",
            Fate::Recycle { .. } => "come back at a random place of its box",
        };
        lines.push(format!(
            "outlet `{}`: grains that reach it are counted and {then}",
            outlet.name
        ));
    }
    for inlet in &scene.inlets {
        lines.push(format!(
            "inlet `{}`: kept at a solid fraction of {}, seed {}",
            inlet.name, inlet.solid_fraction, inlet.seed
        ));
    }
    for (name, axis) in [
        ("x", scene.domain.x),
        ("y", scene.domain.y),
        ("z", scene.domain.z),
    ] {
        if let Axis::Periodic(length) = axis {
            lines.push(format!(
                "periodic in {name}: {:.4} mm = {:.1} d'",
                length * 1e3,
                length / constants.kind.diameter()
            ));
        }
    }
    match &scene.initial {
        Initial::Fill(fill) => lines.push(format!("start: random places, seed {}", fill.seed)),
        Initial::Bed(bed) => lines.push(format!(
            "start: a fixed row and {} layers that fall on it, seed {}",
            bed.layers, bed.seed
        )),
        Initial::File(_) | Initial::Grains(_) => {}
    }
    if constants.law.turns() {
        lines.push("spin: grains turn, contacts remember their stretch".into());
    }
    lines.extend(scene.water.as_ref().map(water_words));
    lines
}

/// The populations and what unlike materials make of each other, a line each.
fn mixture(scene: &Scene, constants: &Constants) -> Vec<String> {
    let grains = &scene.grains;
    let population = |(kind, one): (&Kind, &Population)| {
        format!(
            "population: d = {:.4} mm, m = {:.4e} kg, {:.1} % of the mass, of {}",
            kind.diameter() * 1e3,
            kind.mass,
            100.0 * one.share,
            grains.material_name(one.material)
        )
    };
    let pair = |pair: &PairOf| {
        let [a, b] = pair.of.map(|number| grains.material_name(number));
        let number = |name: &str, value: Option<f64>| {
            value.map_or(String::new(), |value| format!(", {name} {value}"))
        };
        let friction = constants.law.turns().then_some(pair.friction);
        format!(
            "{a} and {b}{}{}{}",
            number("restitution", pair.restitution),
            number("friction", friction),
            number("rolling friction", pair.rolling_friction)
        )
    };
    let kinds = constants.populations.iter().zip(&grains.populations);
    kinds
        .map(population)
        .chain(grains.pairs.iter().map(pair))
        .collect()
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Mesh { mesh, surface, .. } => {
            let file = mesh.path.file_name().unwrap_or_default().to_string_lossy();
            match surface {
                MeshSurface::Exact => format!("triangles of {file}"),
                MeshSurface::Grains { radius, .. } => {
                    format!("{file} built of grains of {:.4} mm radius", radius * 1e3)
                }
                MeshSurface::Grid { cell, .. } => format!(
                    "{file} as a grid of distances{}",
                    cell.map_or(String::new(), |c| format!(", cell {:.3} mm", c * 1e3))
                ),
            }
        }
        other => other.name().to_owned(),
    }
}

fn motion(motion: &Motion) -> String {
    let mut text = String::new();
    if let Some(turn) = motion.turn {
        text += &format!("; turns at {:.2} r/min", turn.rate * 30.0 / PI);
    }
    for shift in &motion.shifts {
        text += &match shift.course {
            Course::Steady(speed) => format!("; moves at {speed} m/s"),
            Course::Swing {
                amplitude,
                frequency,
            } => format!("; swings by {:.3} mm at {frequency} Hz", amplitude * 1e3),
        };
    }
    text += &match motion.begins {
        Begin::At(0.0) => String::new(),
        Begin::At(time) => format!(" from {time} s on"),
        Begin::WhenStill => " once the grains are still".to_owned(),
    };
    text
}
