//! Gates through which grains come and go: outlets that delete or recycle, inlets that keep a region filled.

use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::PI;
use tsubu_model::{Change, Damaged, Dim, Gate, Saved, SpinState, Vector, View, Words, uniform};
use tsubu_scene::{Fate, Inlet, Outlet, Region};

/// Places tried for one grain before it has to wait for the next time.
const TRIES: u64 = 200;

/// Deletes the grains whose centre is in a region, or puts them back elsewhere.
pub(crate) struct OutletGate {
    pub outlet: Outlet,
    /// Its number among the gates.
    pub number: usize,
}

/// It decides by the moment alone; what has passed is counted by the world.
impl Saved for OutletGate {
    fn save(&self, _words: &mut Words) {}

    fn restore(&mut self, _words: &mut Words) -> Result<(), Damaged> {
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Gate<D, S> for OutletGate {
    fn decide(&mut self, view: &dyn View<D, S>, out: &mut Vec<Change>) {
        let leaving = within(view, &self.outlet.region);
        if leaving.is_empty() {
            return;
        }
        match &self.outlet.then {
            Fate::Delete => out.extend(leaving.iter().map(|&i| Change::Remove {
                identity: view.identity(i),
                gate: self.number,
            })),
            Fate::Recycle { into, seed } => {
                let mut room = Room::new(view, into, view.kind(leaving[0]).diameter());
                for i in leaving {
                    let identity = view.identity(i);
                    let salt = [*seed, u64::from(identity), view.time().to_bits()];
                    // Without room the grain falls on and is asked again next time.
                    if let Some(position) = room.place(salt) {
                        out.push(Change::Move {
                            identity,
                            position,
                            gate: self.number,
                        });
                    }
                }
            }
        }
    }
}

/// Keeps a region at its solid fraction: new grains come wherever there is room.
pub(crate) struct InletGate {
    pub inlet: Inlet,
    /// Its number among the gates.
    pub number: usize,
    /// Diameter of the grains that come, m.
    pub diameter: f64,
}

/// It decides by the moment alone, its random places too.
impl Saved for InletGate {
    fn save(&self, _words: &mut Words) {}

    fn restore(&mut self, _words: &mut Words) -> Result<(), Damaged> {
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Gate<D, S> for InletGate {
    fn decide(&mut self, view: &dyn View<D, S>, out: &mut Vec<Change>) {
        let region = &self.inlet.region;
        let size = region.max - region.min;
        let (room, grain) = if D::V::AXES == 3 {
            (size.x * size.y * size.z, PI / 6.0 * self.diameter.powi(3))
        } else {
            (size.x * size.z, PI / 4.0 * self.diameter.powi(2))
        };
        let wanted = (self.inlet.solid_fraction * room / grain) as usize;
        let missing = wanted.saturating_sub(within(view, region).len());
        if missing == 0 {
            return;
        }
        let mut room = Room::new(view, region, self.diameter);
        for k in 0..missing as u64 {
            let Some(position) = room.place([self.inlet.seed, k, view.time().to_bits()]) else {
                break;
            };
            out.push(Change::Add {
                position,
                kind: 0,
                gate: self.number,
            });
        }
    }
}

/// Grains whose centre is in the region, in order of identity, so that nothing depends on the order in memory.
fn within<D: Dim, S: SpinState>(view: &dyn View<D, S>, region: &Region) -> Vec<usize> {
    let inside = |x: DVec3| x.cmpge(region.min).all() && x.cmple(region.max).all();
    let mut found: Vec<usize> = (0..view.len())
        .filter(|&i| inside(D::to_space(view.position(i))))
        .collect();
    found.sort_unstable_by_key(|&i| view.identity(i));
    found
}

/// A box with the grains that are in it or reach into it, and those promised a place since.
struct Room {
    low: DVec3,
    size: DVec3,
    diameter: f64,
    taken: HashMap<[i64; 3], Vec<DVec3>>,
}

impl Room {
    fn new<D: Dim, S: SpinState>(view: &dyn View<D, S>, region: &Region, diameter: f64) -> Self {
        // A plane scene has no depth, and a box narrower than a grain has room along its middle only.
        let size = (region.max - region.min - diameter).max(DVec3::ZERO);
        let mut room = Self {
            low: 0.5 * (region.min + region.max - size),
            size,
            diameter,
            taken: HashMap::new(),
        };
        let near = Region {
            min: region.min - diameter,
            max: region.max + diameter,
        };
        for i in within(view, &near) {
            room.take(D::to_space(view.position(i)));
        }
        room
    }

    fn cell(&self, x: DVec3) -> [i64; 3] {
        ((x - self.low) / self.diameter)
            .floor()
            .to_array()
            .map(|c| c as i64)
    }

    fn take(&mut self, x: DVec3) {
        let cell = self.cell(x);
        self.taken.entry(cell).or_default().push(x);
    }

    /// A random place where a grain overlaps none, if one is found.
    fn place(&mut self, [seed, identity, moment]: [u64; 3]) -> Option<DVec3> {
        let draw = |tried: u64, axis: u64| uniform(seed ^ moment, identity, 3 * tried + axis);
        let place = (0..TRIES)
            .map(|t| self.low + self.size * DVec3::new(draw(t, 0), draw(t, 1), draw(t, 2)))
            .find(|&x| self.is_free(x))?;
        self.take(place);
        Some(place)
    }

    fn is_free(&self, x: DVec3) -> bool {
        let [a, b, c] = self.cell(x);
        let around = (-1..=1).flat_map(move |i| {
            (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [a + i, b + j, c + k]))
        });
        around
            .filter_map(|cell| self.taken.get(&cell))
            .flatten()
            .all(|other| other.distance_squared(x) >= self.diameter * self.diameter)
    }
}
