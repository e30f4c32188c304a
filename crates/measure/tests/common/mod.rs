//! A simulation that does not run: grains placed by hand, and fills of known shape.

// Every test binary compiles this file, and each uses a part of it.
#![allow(dead_code)]

use tsubu_model::{
    BodyState, Dim, Energies, Kind, Nothing, Passage, Pose, Reading, Still, TouchingPair, Vector,
    View,
};

/// Grains, their touching pairs and a clock.
pub struct Fake<D: Dim> {
    pub time: f64,
    pub grains: Vec<D::V>,
    /// Velocity at a place; 2 m/s along x unless said otherwise.
    pub velocity: Box<dyn Fn(glam::DVec3) -> glam::DVec3>,
    pub kinds: Vec<Kind>,
    pub pairs: Vec<(usize, usize, f64)>,
    pub bodies: Vec<BodyState<D>>,
    pub passages: Vec<Passage>,
}

/// A body at rest that feels this force.
pub fn body<D: Dim>(name: &str, force: D::V, removed_at: Option<f64>) -> BodyState<D> {
    BodyState {
        name: name.into(),
        removed_at,
        force,
        torque: glam::DVec3::ZERO,
        pose: Pose::default(),
    }
}

impl<D: Dim> Fake<D> {
    /// Grains of one diameter.
    pub fn of(diameter: f64, grains: Vec<D::V>) -> Self {
        let kinds = vec![Kind::sphere(diameter, 1000.0); grains.len()];
        Self {
            time: 0.0,
            grains,
            velocity: Box::new(|_| glam::DVec3::new(2.0, 0.0, 0.0)),
            kinds,
            pairs: Vec::new(),
            bodies: Vec::new(),
            passages: Vec::new(),
        }
    }
}

impl<D: Dim> View<D, Still> for Fake<D> {
    fn time(&self) -> f64 {
        self.time
    }
    fn len(&self) -> usize {
        self.grains.len()
    }
    fn position(&self, i: usize) -> D::V {
        self.grains[i]
    }
    fn velocity(&self, i: usize) -> D::V {
        D::from_space((self.velocity)(D::to_space(self.grains[i])))
    }
    fn spin(&self, _i: usize) -> Nothing {
        Nothing
    }
    fn kind(&self, i: usize) -> &Kind {
        &self.kinds[i]
    }
    fn identity(&self, i: usize) -> u32 {
        i as u32
    }
    fn bodies(&self) -> Vec<BodyState<D>> {
        self.bodies.clone()
    }
    fn passages(&self) -> Vec<Passage> {
        self.passages.clone()
    }
    fn gravity(&self) -> D::V {
        D::from_space(glam::DVec3::new(0.0, 0.0, -9.81))
    }
    fn energies(&self) -> Energies {
        Energies::default()
    }
    fn touching(&self, each: &mut dyn FnMut(TouchingPair)) {
        for &(i, j, overlap) in &self.pairs {
            each(TouchingPair { i, j, overlap });
        }
    }
}

/// Numbers in [0, 1) from a counter (splitmix64).
pub struct Dice(pub u64);

impl Dice {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Random sequential fill: centres in [0, `length`] × [0, `height`] where `surface(x)` is above them,
/// none closer than `d` to another; y is periodic. Reaches about 0.5 in the plane, 0.33 in space.
/// A larger box is filled and then cut, since such a fill is denser at its own edges.
pub fn random_fill<D: Dim>(
    seed: u64,
    d: f64,
    [length, depth, height]: [f64; 3],
    surface: impl Fn(f64) -> f64,
) -> Vec<D::V> {
    let mut dice = Dice(seed);
    let mut cells: std::collections::HashMap<[i64; 3], Vec<glam::DVec3>> = Default::default();
    let flat = D::V::AXES == 2;
    let rows = if flat { 1 } else { (depth / d).floor() as i64 };
    let cell = [d, depth / rows as f64, d];
    let key = |p: glam::DVec3| [0, 1, 2].map(|a| (p[a] / cell[a]).floor() as i64);
    let margin = 3.0 * d;
    let tries = 30.0 * (length + 2.0 * margin) * (height + 2.0 * margin) / (d * d) * rows as f64;
    let mut grains = Vec::new();
    for _ in 0..tries as usize {
        let p = glam::DVec3::new(
            dice.next() * (length + 2.0 * margin) - margin,
            if flat { 0.0 } else { dice.next() * depth },
            dice.next() * (height + 2.0 * margin) - margin,
        );
        let at = key(p);
        let free = (0..27).all(|n| {
            let near = [
                at[0] + n % 3 - 1,
                (at[1] + n / 3 % 3 - 1).rem_euclid(rows),
                at[2] + n / 9 - 1,
            ];
            cells.get(&near).is_none_or(|list| {
                list.iter().all(|q| {
                    let mut apart = p - *q;
                    apart.y -= depth * (apart.y / depth).round();
                    apart.length_squared() >= d * d
                })
            })
        });
        if free {
            cells.entry(at).or_default().push(p);
            if p.x >= 0.0 && p.x <= length && p.z >= 0.0 && p.z <= surface(p.x).min(height) {
                grains.push(D::from_space(p));
            }
        }
    }
    grains
}

/// Simple cubic (square) lattice of spacing d, centres where `surface(x)` is above them.
pub fn lattice<D: Dim>(
    d: f64,
    [length, depth, height]: [f64; 3],
    surface: impl Fn(f64) -> f64,
) -> Vec<D::V> {
    let count = |l: f64| (l / d).round() as usize;
    let at = |k: usize| (k as f64 + 0.5) * d;
    let mut grains = Vec::new();
    for i in 0..count(length) {
        for k in 0..count(height) {
            for j in 0..if D::V::AXES == 2 { 1 } else { count(depth) } {
                if at(k) <= surface(at(i)) {
                    grains.push(D::from_space(glam::DVec3::new(at(i), at(j), at(k))));
                }
            }
        }
    }
    grains
}

/// The value of a reading.
pub fn named(readings: &[Reading], name: &str) -> f64 {
    readings
        .iter()
        .find(|r| r.name == name)
        .map_or(f64::NAN, |r| r.value)
}
