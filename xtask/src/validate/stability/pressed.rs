//! Arrangements whose contacts a load keeps closed, their networks, and whether a small disturbance of one grows.
//!
//! Contacts only push, so growth of a contact that opens saturates. Here a grain or a column lies on a floor under gravity, a
//! pair is pressed together by a field that pulls its grains in opposite directions, and a lattice by a period a little too
//! short for it. The overlap is 4e-6 d and the disturbance at most a thousandth of that, so the contacts are linear; it begins where the
//! rounding of a position is still a ten-thousandth of it.
//! Growth is looked for in the second difference of the positions: a drift has none, and in the mode that alternates from
//! step to step the full-step velocity of a leapfrog is zero.

use super::network::{Free, Link, Network, only};
use crate::validate::lab::Draw;
use crate::validate::wca::{Wca, coke, grain};
use glam::DVec3;
use std::collections::BTreeMap;
use std::sync::Arc;
use tsubu_contact::restitution::at_zero_force;
use tsubu_contact::{Repulsion, RepulsiveWall, SpringDashpot};
use tsubu_engine::{Body, Lanes, ManyKinds, NoTally, Placed, Setup, TouchesAt, World};
use tsubu_integrate::Scheme;
use tsubu_model::{ContactLaw, Domain, Kind, Motion, Space, SpinState, Spins, Still, View};
use tsubu_sdf::HalfSpace;

/// Overlap of a contact under one grain's weight, over its range.
const OVERLAP: f64 = 4e-6;
/// Where a disturbance begins, and where it has grown, over the overlap.
const BEGINS: f64 = 7e-7;
const GROWN: f64 = 2e-4;

/// What is pressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arrangement {
    /// So many grains on a floor under gravity; one = a wall contact.
    Column(u32),
    /// Two grains.
    Pair,
    /// 6 × 6 grains in a plane, periodic, six contacts each.
    Hexagonal,
    /// Face-centred cubic, 3 × 3 × 3 cells of four grains, periodic, twelve contacts each.
    FaceCentredCubic,
}

/// The law of its contacts. All have paper A's coke and its stiffness at touch.
#[derive(Clone, Copy, Debug)]
pub enum Contact {
    /// Repulsion with ζ = γ/2√(km) on one grain's mass in every direction: C = 2ζ√K.
    Repulsion(f64),
    /// The same along the contact only.
    Along(f64),
    /// Springs and dashpots with spin, of grains whose moment of inertia is this share of m d²/10: added mass does not turn.
    Springs(SpringDashpot, f64),
}

/// A scheme on an arrangement.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub scheme: Scheme,
    pub arrangement: Arrangement,
    pub contact: Contact,
}

/// k of a coke contact at touch in N/m.
pub fn stiffness() -> f64 {
    Wca::of(&coke(0.0)).edge_stiffness()
}

/// √(k/m) of one grain on a wall, in 1/s.
pub fn frequency() -> f64 {
    (stiffness() / grain().mass).sqrt()
}

/// Springs as stiff as coke: ζ and the share of the tangential stiffness and damping. Friction holds whatever the load.
pub fn springs(zeta: f64, stiff: f64, damped: f64) -> Contact {
    let damping = 2.0 * zeta * grain().mass * frequency();
    let law = SpringDashpot::new(
        stiffness(),
        stiff * stiffness(),
        damping,
        damped * damping,
        if stiff > 0.0 || damped > 0.0 {
            1e3
        } else {
            0.0
        },
    );
    Contact::Springs(law, 1.0)
}

/// Paper B's: αcn is ζ of one grain's mass, ν = 0.3, and the sand in water turns with its own mass only.
pub fn paper_b(cn: f64, sticks: bool) -> Contact {
    let share = if sticks { 1.0 } else { 0.0 };
    match springs(cn, share / 2.6, share / 2.6f64.sqrt()) {
        Contact::Springs(law, _) => Contact::Springs(law, 2650.0 / (2650.0 + 0.5 * 1000.0)),
        other => other,
    }
}

impl Contact {
    fn damping(self) -> f64 {
        let unit = 2.0 * grain().mass * frequency();
        match self {
            Contact::Repulsion(zeta) | Contact::Along(zeta) => zeta * unit,
            Contact::Springs(law, _) => law.normal_damping,
        }
    }

    fn kind(self) -> Kind {
        let kind = grain();
        match self {
            Contact::Springs(_, share) => Kind {
                inertia: share * kind.inertia,
                ..kind
            },
            _ => kind,
        }
    }

    fn turns(self) -> bool {
        matches!(self, Contact::Springs(law, _) if law.friction > 0.0)
    }

    fn stiffness_at(self, r: f64) -> f64 {
        match self {
            Contact::Springs(law, _) => law.normal_stiffness,
            _ => Wca::of(&coke(0.0)).stiffness(r),
        }
    }

    /// Distance at which two grains, or a grain and its mirror in a wall, are pressed by so many loads.
    fn at_rest_under(self, loads: f64) -> f64 {
        let load = loads * self.load();
        match self {
            Contact::Springs(law, _) => self.range() - load / law.normal_stiffness,
            _ => Wca::of(&coke(0.0)).at_rest_under(load),
        }
    }

    /// The force that presses a contact by [`OVERLAP`].
    fn load(self) -> f64 {
        let stiffness = match self {
            Contact::Springs(law, _) => law.normal_stiffness,
            _ => stiffness(),
        };
        OVERLAP * self.range() * stiffness
    }

    fn range(self) -> f64 {
        match self {
            Contact::Springs(..) => grain().diameter(),
            _ => Wca::of(&coke(0.0)).range(),
        }
    }
}

/// Where the grains lie, in what box, and what presses them.
struct Rest {
    places: Vec<DVec3>,
    period: DVec3,
    gravity: DVec3,
}

impl Case {
    /// Coordinates that the disturbance moves: what is left out stays at rest to the bit. In a plane the turn is about y
    /// for a column and about z for a lattice and a pair.
    fn free(&self) -> Free {
        match (self.arrangement, self.contact.turns()) {
            (Arrangement::Column(_), false) => only(&[2]),
            (Arrangement::Column(_), true) => only(&[0, 2, 4]),
            (Arrangement::Pair, false) => only(&[0]),
            (Arrangement::Pair, true) | (Arrangement::Hexagonal, true) => only(&[0, 1, 5]),
            (Arrangement::Hexagonal, false) => only(&[0, 1]),
            (Arrangement::FaceCentredCubic, false) => only(&[0, 1, 2]),
            (Arrangement::FaceCentredCubic, true) => only(&[0, 1, 2, 3, 4, 5]),
        }
    }

    fn rest(&self) -> Rest {
        let contact = self.contact;
        let pull = contact.load() / grain().mass;
        let open = |places, gravity| Rest {
            places,
            period: DVec3::INFINITY,
            gravity,
        };
        let pitch = contact.range() * (1.0 - OVERLAP);
        match self.arrangement {
            Arrangement::Column(n) => {
                let mut height = -grain().radius;
                let places = (0..n).map(|j| {
                    height += contact.at_rest_under(f64::from(n - j));
                    DVec3::Z * height
                });
                open(places.collect(), DVec3::Z * -pull)
            }
            Arrangement::Pair => {
                let half = DVec3::X * (0.5 * contact.at_rest_under(1.0));
                open(vec![-half, half], DVec3::X * pull)
            }
            Arrangement::Hexagonal => {
                let up = 0.75f64.sqrt() * pitch;
                let place = |k: u32| {
                    let (column, row) = (f64::from(k % 6), k / 6);
                    let shift = 0.5 * f64::from(row % 2);
                    DVec3::new(
                        (column + shift + 0.25) * pitch,
                        (f64::from(row) + 0.5) * up,
                        0.0,
                    )
                };
                Rest {
                    places: (0..36).map(place).collect(),
                    period: DVec3::new(6.0 * pitch, 6.0 * up, f64::INFINITY),
                    gravity: DVec3::ZERO,
                }
            }
            Arrangement::FaceCentredCubic => {
                let cell = 2f64.sqrt() * pitch;
                let corners = [
                    DVec3::ZERO,
                    DVec3::new(0.5, 0.5, 0.0),
                    DVec3::new(0.5, 0.0, 0.5),
                    DVec3::new(0.0, 0.5, 0.5),
                ];
                let place = |k: u32| {
                    let at = DVec3::new(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9));
                    corners.map(|corner| (at + corner + DVec3::splat(0.2)) * cell)
                };
                Rest {
                    places: (0..27).flat_map(place).collect(),
                    period: DVec3::splat(3.0 * cell),
                    gravity: DVec3::ZERO,
                }
            }
        }
    }

    /// The contacts as matrices.
    pub fn network(&self) -> Network {
        let rest = self.rest();
        let damping = self.contact.damping();
        let arm = if self.contact.turns() {
            grain().radius
        } else {
            0.0
        };
        let across = match self.contact {
            Contact::Repulsion(_) => [0.0, damping],
            Contact::Along(_) => [0.0; 2],
            Contact::Springs(law, _) => [law.tangential_stiffness, law.tangential_damping],
        };
        let link = |i: usize, j: Option<usize>, apart: DVec3| Link {
            i,
            j,
            normal: apart.normalize(),
            along: [self.contact.stiffness_at(apart.length()), damping],
            // A wall of coke is smooth.
            across: if j.is_none() && !self.contact.turns() {
                [0.0; 2]
            } else {
                across
            },
            arms: [arm, if j.is_some() { arm } else { 0.0 }],
        };
        let mut links = Vec::new();
        for (i, a) in rest.places.iter().enumerate() {
            for (j, b) in rest.places.iter().enumerate().skip(i + 1) {
                let apart = nearest(*a - *b, rest.period);
                if apart.length() < self.contact.range() {
                    links.push(link(i, Some(j), apart));
                }
            }
        }
        if let Arrangement::Column(_) = self.arrangement {
            links.push(link(0, None, rest.places[0] + DVec3::Z * grain().radius));
        }
        Network::new(rest.places.len(), &self.contact.kind(), &links, self.free())
    }

    /// The longest step of the theory for this very network.
    pub fn limit(&self) -> Option<f64> {
        self.network().limit(self.scheme, 50.0 / frequency())
    }

    /// K = kΔt²/m and C = ηΔt/m of one grain at this step; k at the overlap of one load.
    pub fn numbers(&self, dt: f64) -> (f64, f64) {
        let per_mass = dt / grain().mass;
        let stiffness = self.contact.stiffness_at(self.contact.at_rest_under(1.0));
        (stiffness * dt * per_mass, self.contact.damping() * per_mass)
    }

    /// Steps of this length after which a small disturbance has grown some hundredfold, to within 25; `None` if it
    /// has not after so many.
    pub fn grown_after(&self, dt: f64, steps: u64) -> Option<u64> {
        let far = GROWN * OVERLAP * self.contact.range();
        moves(&mut *self.world(dt), far, steps)
    }

    /// True if it does.
    pub fn grows(&self, dt: f64, steps: u64) -> bool {
        self.grown_after(dt, steps).is_some()
    }

    /// The largest Δt without growth over `around`, by halving between 0.8 and 1.25 of it; NaN if it is not between.
    pub fn found(&self, around: f64, steps: u64) -> f64 {
        let (mut low, mut high) = (0.8, 1.25);
        if self.grows(low * around, steps) || !self.grows(high * around, steps) {
            return f64::NAN;
        }
        for _ in 0..11 {
            let middle = 0.5 * (low + high);
            if self.grows(middle * around, steps) {
                high = middle;
            } else {
                low = middle;
            }
        }
        0.5 * (low + high)
    }

    /// Largest eigenvalue that the engine finds for the packing at rest with this step.
    pub fn stiffest_mode(&self, dt: f64) -> f64 {
        self.world(dt).stiffest()
    }

    /// The world at rest but for the disturbance.
    fn world(&self, dt: f64) -> Box<dyn Steps> {
        let law = coke(self.contact.damping());
        match self.contact {
            Contact::Repulsion(zeta) => {
                let wall = self.wall(law, zeta);
                Box::new(self.build::<Still, _, _>(law, wall, dt))
            }
            Contact::Along(zeta) => {
                let wall = self.wall(law, zeta);
                let law = law.softened(1.0, 1.0, 0.0).per_direction();
                Box::new(self.build::<Still, _, _>(law, wall, dt))
            }
            Contact::Springs(law, _) => Box::new(self.build::<Spins, _, _>(law, law, dt)),
        }
    }

    fn wall(&self, grains: Repulsion, zeta: f64) -> RepulsiveWall {
        RepulsiveWall {
            grains,
            restitution: (zeta > 0.0).then(|| at_zero_force(zeta)),
            friction: 0.0,
        }
    }

    fn build<S, L, W>(&self, law: L, wall: W, dt: f64) -> World<Space, S, ManyKinds, L, W, NoTally>
    where
        S: SpinState,
        L: ContactLaw<Space, S>,
        W: ContactLaw<Space, S>,
    {
        let rest = self.rest();
        let floor = Body {
            name: "floor".into(),
            surface: Arc::new(HalfSpace::<Space>::new(DVec3::ZERO, DVec3::Z)),
            law: wall,
            touches_at: TouchesAt::Surface,
            removed_at: None,
            motion: Motion::default(),
            waits: false,
        };
        let down = self.contact.kind();
        let up = Kind {
            weight: -down.weight,
            ..down
        };
        let is_pair = self.arrangement == Arrangement::Pair;
        // Both: a heavy dashpot eats a velocity before it has moved anything.
        let small = BEGINS * OVERLAP * self.contact.range();
        let free = self.free();
        let mut draw = Draw(3);
        let mut disturbance = |size: f64| {
            let one = |a: usize| if free[a] { 1.0 } else { 0.0 };
            let mut all: Vec<DVec3> = (0..rest.places.len())
                .map(|_| DVec3::from_array(std::array::from_fn(|a| one(a) * size * draw.normal())))
                .collect();
            if rest.period.x.is_finite() {
                let mean = all.iter().sum::<DVec3>() / all.len() as f64;
                all.iter_mut().for_each(|v| *v -= mean);
            }
            all
        };
        let velocities = disturbance(small / dt.max(1.0 / frequency()));
        let shifts = disturbance(small);
        World::new(Setup {
            kinds: ManyKinds(vec![down, up]),
            law,
            bodies: if let Arrangement::Column(_) = self.arrangement {
                vec![floor]
            } else {
                Vec::new()
            },
            domain: Domain {
                period: rest.period,
            },
            gravity: rest.gravity,
            scheme: self.scheme,
            dt,
            skin: None,
            lanes: Lanes::best(),
            pool: None,
            grains: (0..rest.places.len())
                .map(|i| Placed {
                    position: rest.places[i] + shifts[i],
                    velocity: velocities[i],
                    kind: if is_pair { i % 2 } else { 0 },
                })
                .collect(),
            gates: Vec::new(),
        })
    }
}

/// The shortest way between two places of a periodic box.
pub fn nearest(apart: DVec3, period: DVec3) -> DVec3 {
    let axis = |a: usize| {
        if period[a].is_finite() {
            apart[a] - period[a] * (apart[a] / period[a]).round()
        } else {
            apart[a]
        }
    };
    DVec3::new(axis(0), axis(1), axis(2))
}

/// Anything that steps and can be looked at.
trait Steps {
    fn go(&mut self, steps: u64);
    fn places(&self) -> BTreeMap<u32, DVec3>;
    fn is_fine(&self) -> bool;
    fn stiffest(&self) -> f64;
}

impl<S, L, W> Steps for World<Space, S, ManyKinds, L, W, NoTally>
where
    S: SpinState,
    L: ContactLaw<Space, S>,
    W: ContactLaw<Space, S>,
{
    fn go(&mut self, steps: u64) {
        self.advance(steps);
    }

    fn places(&self) -> BTreeMap<u32, DVec3> {
        (0..self.len())
            .map(|i| (self.identity(i), self.position(i)))
            .collect()
    }

    fn is_fine(&self) -> bool {
        self.health().is_fine()
    }

    fn stiffest(&self) -> f64 {
        self.stiffest_mode()
    }
}

/// When the second difference of a grain's positions exceeds `far`, looked at every few steps, odd and even ones.
fn moves(world: &mut dyn Steps, far: f64, steps: u64) -> Option<u64> {
    for look in 1..=steps / 25 {
        world.go(23);
        let (a, b, c) = {
            let a = world.places();
            world.go(1);
            let b = world.places();
            world.go(1);
            (a, b, world.places())
        };
        if !world.is_fine() {
            return Some(25 * look);
        }
        let bend = |id: &u32| (c[id] - 2.0 * b[id] + a[id]).length();
        // Written so that NaN counts as growth. A grain that is wrapped round the box meanwhile is left out.
        let bends = a
            .keys()
            .filter(|id| (c[id] - a[id]).length() < 0.5 * grain().radius || c[id].is_nan());
        if !bends.map(bend).all(|bend| bend <= far) {
            return Some(25 * look);
        }
    }
    None
}
