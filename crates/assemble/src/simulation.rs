//! A running scene behind one object, whatever its types: what the command, the validations and the tests hold.

mod saved;

use crate::books::Books;
use crate::gate::agitation;
use glam::DVec3;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tsubu_engine::{Health, KindSet, Layout, Tally, World};
use tsubu_integrate::Scheme;
use tsubu_model::{
    Change, ContactLaw, Curve, Dim, Energies, Gate, Observer, Pose, Reading, Saved, Shell,
    SpinState, Surface, Vector, View,
};
use tsubu_scene::End;

/// Steps between two looks for deep overlaps, and one at the end: fixed, so that the cadence of outputs decides nothing.
const DEPTH_EVERY: u64 = 1000;

/// A moment of the same scene that another engine computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Steps since the start.
    pub steps: u64,
    /// The step at which the grains were still, once it is past.
    pub released: Option<u64>,
    /// Identity, place in m and velocity in m/s of every grain that is there.
    pub grains: Vec<(u32, DVec3, DVec3)>,
}

/// Why a run goes no further.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// It has reached its end.
    Over,
    /// The numbers are no longer physics.
    Trouble(Health),
    /// The grains were not still by the time the scene allows.
    NeverStill {
        /// When the run gave up, in s.
        time: f64,
        /// Kinetic energy per grain over m g d at that time.
        agitation: f64,
        /// What the scene asks for.
        asked: f64,
    },
    /// The water found no bed to flow over.
    NoBed {
        /// When it looked, in s.
        time: f64,
    },
    /// The grains hold more energy than they can have: nothing works on them.
    EnergyGrows {
        /// When it was looked at, in s.
        time: f64,
        /// Energy that came from nowhere, in J.
        gained: f64,
        /// Energy that has moved since the start, in J.
        moved: f64,
        /// The fastest grain.
        grain: u32,
        /// Where it is, x y z in m.
        place: [f64; 3],
        /// Its speed in m/s.
        speed: f64,
    },
    /// The step is over the limit of the packing as it lies.
    UnstablePacking {
        /// When it was looked at, in s.
        time: f64,
        /// Share of the limit that it uses.
        used: f64,
    },
}

/// Where all the grains are that there have ever been.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// At the start and through inlets.
    pub inserted: u64,
    /// In the scene now.
    pub present: u64,
    /// Taken away by outlets.
    pub deleted: u64,
}

impl Count {
    /// Gone without a word; zero, always.
    pub fn lost(&self) -> i64 {
        self.inserted as i64 - self.present as i64 - self.deleted as i64
    }
}

/// One grain of a snapshot, in single precision, for frames and pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Identity.
    pub identity: u32,
    /// Centre in m.
    pub position: [f32; 3],
    /// Velocity in m/s.
    pub velocity: [f32; 3],
    /// Radius in m.
    pub radius: f32,
}

/// All grains at one moment, in order of identity.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Simulated time in s.
    pub time: f64,
    /// The grains.
    pub grains: Vec<Grain>,
}

/// A body that is there, as frames and pictures show it.
#[derive(Clone, Debug)]
pub struct Machine {
    /// Number of the body in the order of the scene.
    pub number: usize,
    /// Its triangles in its own frame; `None` if it is drawn by its outline.
    pub shell: Option<Arc<Shell>>,
    /// Where it is.
    pub pose: Pose,
    /// True if it moves at some time.
    pub moves: bool,
}

/// A running scene.
pub trait Simulation: Saved + Send {
    /// Takes up to `steps` steps; stops at the end of the run or at trouble. Returns how many were taken.
    fn advance(&mut self, steps: u64) -> u64;
    /// Why it goes no further, if it does not.
    fn stop(&self) -> Option<Stop>;
    /// True if it goes no further.
    fn is_over(&self) -> bool {
        self.stop().is_some()
    }
    /// Steps taken.
    fn steps(&self) -> u64;
    /// The step at which the run ends, once that is known.
    fn last_step(&self) -> Option<u64>;
    /// Simulated time in s.
    fn time(&self) -> f64;
    /// When the wall that waits for stillness was removed, in s.
    fn released_at(&self) -> Option<f64>;
    /// Number of grains.
    fn grains(&self) -> usize;
    /// Where all the grains are that there have ever been.
    fn count(&self) -> Count;
    /// Kinetic energy per grain over m g d.
    fn agitation(&self) -> f64;
    /// Puts a moment that another engine computed in the place of the present one, for the observers to look at. Moments
    /// come in order of time; walls go and bodies start as the scene says. A run cannot go on from it.
    fn show(&mut self, moment: &Moment);
    /// Observers look: one row of readings, always the same names.
    fn look(&mut self) -> Vec<Reading>;
    /// What the observers say at the end.
    fn report(&self) -> Vec<Reading>;
    /// Curves worth a figure.
    fn curves(&self) -> Vec<Curve>;
    /// Energies now; the losses are summed only if the scene asks for energies.
    fn energies(&self) -> Energies;
    /// All grains now.
    fn snapshot(&self) -> Snapshot;
    /// Edges of the bodies that are still there, cut to the box `low`–`high`.
    fn outlines(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]>;
    /// The bodies that are still there.
    fn machines(&self) -> Vec<Machine>;
    /// Bytes held per grain.
    fn bytes_per_grain(&self) -> f64;
    /// Force of the grains on each body in the last step, by name, in N.
    fn body_forces(&self) -> Vec<(String, DVec3)>;
    /// Positions and velocities in full, in order of identity, in m and m/s.
    fn state(&self) -> Vec<(DVec3, DVec3)>;
    /// How far the last solve was from its end, in m/s; zero for explicit schemes.
    fn solve_residual(&self) -> f64;
    /// Share of the limit that the packing as it lies now uses at a step of `dt` s; `None` while a grain touches nothing,
    /// and for explicit Euler, whose limit is another.
    fn used_by_packing(&self, dt: f64) -> Option<f64>;
}

/// The one implementation.
pub(crate) struct Running<
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
> {
    pub world: World<D, S, K, L, W, T>,
    pub surfaces: Vec<Arc<dyn Surface<D>>>,
    /// Triangles of the surfaces that have some.
    pub shells: Vec<Option<Arc<Shell>>>,
    /// Which bodies move at some time.
    pub movers: Vec<bool>,
    pub gates: Vec<Box<dyn Gate<D, S>>>,
    pub observers: Vec<Box<dyn Observer<D, S>>>,
    /// Steps between two looks of the gates.
    pub gate_every: u64,
    pub end: End,
    /// The body whose removal or start starts the clock, and the time by which that must have come.
    pub release: Option<Release>,
    pub trouble: Option<Stop>,
    /// Overlap over the law's range above which a run stops.
    pub deep: f64,
    /// Set by the water when it finds no bed.
    pub lost_bed: Option<Arc<AtomicBool>>,
    /// The next step at which the limit of the packing as it lies is worked out.
    pub weigh_at: Option<u64>,
    /// True if it is worked out at the release.
    pub weighs_released: bool,
    /// True if it is worked out again after twice as many steps each time, so that it costs ever less.
    pub weigh_again: bool,
    /// True if a step over that limit ends the run.
    pub refuse_unstable: bool,
    /// The largest share of the limit that the packing used then.
    pub used: Option<f64>,
    /// True if nothing works on the grains, so that their energy may not grow.
    pub watches_energy: bool,
    /// The energy at the start, once it was looked at.
    pub books: Option<Books>,
    /// What changes at the release.
    pub at_release: Vec<Change>,
    /// Bodies that go at a time in s.
    pub removed_at: Vec<(usize, f64)>,
    /// The law from the release on, if another one holds while the grains settle.
    pub law_after: Option<L>,
}

/// The wait for stillness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Release {
    pub body: usize,
    pub at_most: f64,
    pub asked: f64,
    pub at_step: Option<u64>,
}

impl<D, S, K, L, W, T> Running<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    fn end_after(&self) -> u64 {
        match self.end {
            End::Until(seconds) => (seconds / self.world.dt()).round().max(1.0) as u64,
            End::Steps(steps) => steps,
        }
    }

    fn is_bed_lost(&self) -> bool {
        self.lost_bed
            .as_ref()
            .is_some_and(|lost| lost.load(Ordering::Relaxed))
    }

    /// Looks whether energy has grown that no work explains.
    fn audit(&mut self) {
        let Some(books) = &mut self.books else {
            return;
        };
        let view: &dyn View<D, S> = &self.world;
        let Some((gained, moved)) = books.grown(view) else {
            return;
        };
        let speed = |i: usize| view.velocity(i).length();
        let fastest = (0..view.len()).max_by(|&a, &b| speed(a).total_cmp(&speed(b)));
        if let Some(i) = fastest {
            self.trouble = Some(Stop::EnergyGrows {
                time: view.time(),
                gained,
                moved,
                grain: view.identity(i),
                place: D::to_space(view.position(i)).to_array(),
                speed: speed(i),
            });
        }
    }

    /// How much of the limit the packing uses as it lies now.
    fn weigh(&mut self) {
        let used = self.world.stiffest_mode() / 4.0;
        self.used = Some(self.used.map_or(used, |before| before.max(used)));
        if used >= 1.0 && self.refuse_unstable {
            self.trouble = Some(Stop::UnstablePacking {
                time: self.world.now(),
                used,
            });
        }
    }

    fn decide(&mut self) {
        let mut changes = Vec::new();
        for gate in &mut self.gates {
            gate.decide(&self.world, &mut changes);
        }
        self.world.apply(&changes);
        let waited_for = |change: &Change| {
            self.release.is_some_and(|release| {
                let body = release.body;
                *change == Change::RemoveBody(body) || *change == Change::StartBody(body)
            })
        };
        if changes.iter().any(waited_for) {
            let now = self.world.steps();
            if let Some(release) = self.release.as_mut().filter(|r| r.at_step.is_none()) {
                release.at_step = Some(now);
            }
            if let Some(law) = self.law_after.take() {
                self.world.set_law(&law);
            }
            if self.weighs_released {
                self.weigh();
            }
        }
        if let Some(release) = self.release.filter(|r| r.at_step.is_none())
            && self.world.now() > release.at_most
        {
            self.trouble = Some(Stop::NeverStill {
                time: self.world.now(),
                agitation: self.agitation(),
                asked: release.asked,
            });
        }
    }
}

impl<D, S, K, L, W, T> Simulation for Running<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    fn advance(&mut self, steps: u64) -> u64 {
        let start = self.world.steps();
        if self.watches_energy && start == 0 && self.books.is_none() {
            self.books = Some(Books::open(&self.world));
        }
        while self.stop().is_none() {
            let now = self.world.steps();
            let mut batch = (start + steps.min(u64::MAX - start)).saturating_sub(now);
            if batch == 0 {
                break;
            }
            if let Some(last) = self.last_step() {
                batch = batch.min(last - now);
            }
            if !self.gates.is_empty() {
                batch = batch.min(self.gate_every - now % self.gate_every);
            }
            batch = batch.min(DEPTH_EVERY - now % DEPTH_EVERY);
            if let Some(at) = self.weigh_at.filter(|&at| at > now) {
                batch = batch.min(at - now);
            }
            self.world.advance(batch);
            let mut health = self.world.health();
            let here = self.world.steps();
            if health.is_fine()
                && (here.is_multiple_of(DEPTH_EVERY) || self.last_step() == Some(here))
            {
                health = self.world.overlap_health(self.deep);
            }
            if !health.is_fine() {
                self.trouble = Some(Stop::Trouble(health));
            } else if self.is_bed_lost() {
                self.trouble = Some(Stop::NoBed {
                    time: self.world.now(),
                });
            } else {
                if here.is_multiple_of(DEPTH_EVERY) {
                    self.audit();
                }
                if self.weigh_at == Some(here) {
                    self.weigh();
                    self.weigh_at = self.weigh_again.then_some(2 * here);
                }
                let is_due = !self.gates.is_empty() && here.is_multiple_of(self.gate_every);
                if is_due && self.trouble.is_none() {
                    self.decide();
                }
            }
        }
        self.world.steps() - start
    }

    fn stop(&self) -> Option<Stop> {
        self.trouble.clone().or_else(|| {
            self.last_step()
                .filter(|&last| self.world.steps() >= last)
                .map(|_| Stop::Over)
        })
    }

    fn steps(&self) -> u64 {
        self.world.steps()
    }

    fn last_step(&self) -> Option<u64> {
        match self.release {
            Some(release) => release.at_step.map(|from| from + self.end_after()),
            None => Some(self.end_after()),
        }
    }

    fn time(&self) -> f64 {
        self.world.now()
    }

    fn released_at(&self) -> Option<f64> {
        self.release
            .and_then(|r| r.at_step)
            .map(|step| step as f64 * self.world.dt())
    }

    fn grains(&self) -> usize {
        self.world.len()
    }

    fn count(&self) -> Count {
        let gates = self.world.passages();
        Count {
            inserted: self.world.inserted(),
            present: self.world.len() as u64,
            deleted: gates.iter().map(|gate| gate.went).sum(),
        }
    }

    fn agitation(&self) -> f64 {
        agitation(&self.world as &dyn View<D, S>)
    }

    fn show(&mut self, moment: &Moment) {
        let grains: Vec<_> = moment
            .grains
            .iter()
            .map(|&(identity, x, v)| (identity, D::from_space(x), D::from_space(v)))
            .collect();
        let now = moment.steps;
        let waits = self.release.filter(|release| release.at_step.is_none());
        if let (Some(release), Some(at)) = (waits, moment.released.filter(|at| *at <= now)) {
            // What happens at the release is told its own time.
            self.world.replace(at, &grains);
            let changes = self.at_release.clone();
            self.world.apply(&changes);
            self.release = Some(Release {
                at_step: Some(at),
                ..release
            });
            if let Some(law) = self.law_after.take() {
                self.world.set_law(&law);
            }
        }
        self.world.replace(now, &grains);
        let due: Vec<Change> = self
            .removed_at
            .iter()
            .filter(|(_, time)| *time <= self.world.now())
            .map(|(body, _)| Change::RemoveBody(*body))
            .collect();
        self.world.apply(&due);
    }

    fn look(&mut self) -> Vec<Reading> {
        let world = &self.world;
        self.observers
            .iter_mut()
            .flat_map(|o| o.see(world))
            .collect()
    }

    fn report(&self) -> Vec<Reading> {
        let mut report: Vec<Reading> = self.observers.iter().flat_map(|o| o.report()).collect();
        report.extend(
            self.used
                .map(|used| Reading::new("step_over_limit", used, "1")),
        );
        report
    }

    fn curves(&self) -> Vec<Curve> {
        self.observers.iter().flat_map(|o| o.curves()).collect()
    }

    fn energies(&self) -> Energies {
        View::energies(&self.world)
    }

    fn snapshot(&self) -> Snapshot {
        let single = |v: D::V| <D as Dim>::to_space(v).as_vec3().to_array();
        let mut grains: Vec<Grain> = (0..self.world.len())
            .map(|i| Grain {
                identity: self.world.identity(i),
                position: single(self.world.position(i)),
                velocity: single(self.world.velocity(i)),
                radius: self.world.kind(i).radius as f32,
            })
            .collect();
        grains.sort_unstable_by_key(|g| g.identity);
        Snapshot {
            time: self.world.now(),
            grains,
        }
    }

    fn outlines(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
        let there = self
            .world
            .bodies()
            .into_iter()
            .zip(&self.surfaces)
            .filter(|(b, _)| b.removed_at.is_none());
        there
            .flat_map(|(body, surface)| {
                let place = move |x: DVec3| body.pose.to_world(x);
                let edges = surface.outline(low, high).into_iter();
                edges.map(move |[a, b]| [place(a), place(b)])
            })
            .collect()
    }

    fn machines(&self) -> Vec<Machine> {
        let there = self.world.bodies().into_iter().enumerate();
        there
            .filter(|(_, body)| body.removed_at.is_none())
            .map(|(number, body)| Machine {
                number,
                shell: self.shells[number].clone(),
                pose: body.pose,
                moves: self.movers[number],
            })
            .collect()
    }

    fn bytes_per_grain(&self) -> f64 {
        self.world.bytes_per_grain()
    }

    fn body_forces(&self) -> Vec<(String, DVec3)> {
        self.world
            .bodies()
            .into_iter()
            .map(|b| (b.name, D::to_space(b.force)))
            .collect()
    }

    fn state(&self) -> Vec<(DVec3, DVec3)> {
        let mut order: Vec<usize> = (0..self.world.len()).collect();
        order.sort_unstable_by_key(|&i| self.world.identity(i));
        order
            .into_iter()
            .map(|i| {
                (
                    D::to_space(self.world.position(i)),
                    D::to_space(self.world.velocity(i)),
                )
            })
            .collect()
    }

    fn solve_residual(&self) -> f64 {
        self.world.solve_residual()
    }

    fn used_by_packing(&self, dt: f64) -> Option<f64> {
        let modes = self.world.modes();
        let known = self.world.scheme() != Scheme::ExplicitEuler;
        (known && modes.all_touch()).then(|| modes.largest(dt) / 4.0)
    }
}
