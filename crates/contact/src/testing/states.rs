//! The states that the suite tries, in the law's own scales.

use super::report::{Breach, Check};
use glam::DVec3;
use tsubu_model::{ContactLaw, Dim, Kind, Numbers, Push, SpinState, Touch, Vector};

/// Overlaps over the range. The smallest still leaves the force twelve digits above rounding.
pub(super) const OVERLAPS: [f64; 4] = [1e-4, 1e-3, 1e-2, 5e-2];

/// A law for one pair of kinds, with the scales that its states are measured in.
pub(super) struct Case<'a, D: Dim, S: SpinState, L: ContactLaw<D, S>> {
    pub law: &'a L,
    pub a: &'a Kind,
    pub b: &'a Kind,
    pub pair: L::Pair,
    /// Distance from which on there is no force, m.
    pub range: f64,
    /// Stiffness at 1 % overlap, N/m.
    pub stiffness: f64,
    /// Reduced mass, kg.
    pub mass: f64,
    /// √(k/m*), 1/s.
    pub rate: f64,
    /// A step that resolves the contact: about 300 to a period, s.
    pub dt: f64,
}

/// One state of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct State<D: Dim, S: SpinState> {
    pub apart: D::V,
    pub velocity: D::V,
    /// r_a ω_a + r_b ω_b, m/s.
    pub spin: S::Turn<D>,
    /// ω_a − ω_b, 1/s.
    pub roll: S::Turn<D>,
}

impl<D: Dim, S: SpinState> State<D, S> {
    /// Without spin.
    pub(super) fn moving(apart: D::V, velocity: D::V) -> Self {
        Self {
            apart,
            velocity,
            spin: Default::default(),
            roll: Default::default(),
        }
    }

    /// Nothing moves.
    pub(super) fn at_rest(apart: D::V) -> Self {
        Self::moving(apart, D::V::ZERO)
    }

    /// Unit vector from the partner to this grain.
    pub(super) fn normal(&self) -> D::V {
        self.apart * (1.0 / self.apart.length())
    }

    /// Velocity of the two surfaces against each other at the contact: v + n × spin.
    pub(super) fn surface_velocity(&self) -> D::V {
        self.velocity + rolled::<D, S>(self.normal(), self.spin)
    }

    /// The same contact seen from the partner.
    pub(super) fn other_side(self) -> Self {
        Self {
            apart: -self.apart,
            velocity: -self.velocity,
            spin: self.spin,
            roll: -self.roll,
        }
    }
}

impl<'a, D: Dim, S: SpinState, L: ContactLaw<D, S>> Case<'a, D, S, L> {
    pub(super) fn new(law: &'a L, a: &'a Kind, b: &'a Kind) -> Result<Self, Breach> {
        let pair = law.pair(a, b);
        let range = L::range(&pair);
        let mass = 1.0 / (1.0 / a.mass + 1.0 / b.mass);
        let mut case = Self {
            law,
            a,
            b,
            pair,
            range,
            stiffness: 0.0,
            mass,
            rate: 0.0,
            dt: 1.0,
        };
        let shallow = case.at(State::at_rest(axis::<D::V>(0) * (0.99 * range)));
        case.stiffness = L::linear(&pair, &shallow, case.dt).normal_stiffness;
        case.rate = (case.stiffness / mass).sqrt();
        case.dt = 0.02 / case.rate;
        let sound = |x: f64| x.is_finite() && x > 0.0;
        if sound(range) && sound(case.stiffness) && sound(case.rate) {
            return Ok(case);
        }
        let stiffness = case.stiffness;
        let found = format!(
            "range = {range:e} m, stiffness at 1 % overlap = {stiffness:e} N/m, reduced mass = {mass:e} kg"
        );
        Err(Breach {
            check: Check::Scales,
            excess: f64::INFINITY,
            found,
        })
    }

    /// True if the partner is a wall: then there is no second grain to change places with.
    pub(super) fn is_wall(&self) -> bool {
        self.b.radius == 0.0
    }

    /// The contact as the law sees it.
    pub(super) fn at(&self, state: State<D, S>) -> Touch<D, S> {
        touch(state, reach(self.a, self.b))
    }

    /// The force of a contact that has just begun.
    pub(super) fn push(&self, state: State<D, S>) -> Push<D, S> {
        L::force(&self.pair, &self.at(state), &mut L::Memory::zero(), self.dt)
    }

    /// The stored energy of a contact that has just begun.
    pub(super) fn stored(&self, state: State<D, S>) -> f64 {
        L::stored(&self.pair, &self.at(state), &L::Memory::zero())
    }

    /// Contacts of every overlap in [`OVERLAPS`] from `least` up, in many directions, at rest and moving.
    pub(super) fn states(
        &self,
        least: f64,
    ) -> impl Iterator<Item = State<D, S>> + use<'_, 'a, D, S, L> {
        let speed = 0.01 * self.range * self.rate;
        let overlaps = OVERLAPS
            .into_iter()
            .filter(move |&overlap| overlap >= least);
        overlaps.flat_map(move |overlap| {
            directions::<D::V>()
                .enumerate()
                .flat_map(move |(i, direction)| {
                    let apart = direction * (self.range * (1.0 - overlap));
                    let wander = scattered::<D::V>(1000 + i as u64);
                    let turn = scattered::<S::Turn<D>>(2000 + i as u64);
                    let roll = scattered::<S::Turn<D>>(3000 + i as u64) * (1.0 / self.range);
                    [0.0, 1e-3, 1.0].map(|fast| State {
                        apart,
                        velocity: wander * (fast * speed),
                        spin: turn * (fast * speed),
                        roll: roll * (fast * speed),
                    })
                })
        })
    }

    /// The state in words, in the law's scales.
    pub(super) fn words(&self, state: State<D, S>) -> String {
        let State {
            apart,
            velocity,
            spin,
            roll,
        } = state;
        let overlap = 1.0 - apart.length() / self.range;
        let turning = if turns::<D, S>() {
            format!(", r_a ω_a + r_b ω_b = {spin:?} m/s, ω_a − ω_b = {roll:?} 1/s")
        } else {
            String::new()
        };
        format!(
            "at overlap {overlap:.3e} of the range, apart = {apart:?} m, velocity = {velocity:?} m/s{turning}"
        )
    }
}

/// True if the grains turn.
pub(super) fn turns<D: Dim, S: SpinState>() -> bool {
    <S::Turn<D> as Vector>::AXES > 0
}

/// Sum of the radii; a wall is the grain's mirror.
pub(super) fn reach(a: &Kind, b: &Kind) -> f64 {
    a.radius + if b.radius == 0.0 { a.radius } else { b.radius }
}

pub(super) fn touch<D: Dim, S: SpinState>(state: State<D, S>, reach: f64) -> Touch<D, S> {
    let State {
        apart,
        velocity,
        spin,
        roll,
    } = state;
    Touch {
        apart,
        velocity,
        r2: apart.length_squared(),
        reach,
        spin,
        roll,
    }
}

/// The parts of a push by name.
pub(super) fn parts<D: Dim, S: SpinState>(push: &Push<D, S>) -> [(&'static str, D::V); 3] {
    [
        ("elastic", push.elastic),
        ("viscous", push.viscous),
        ("slip", push.slip),
    ]
}

/// Sizes of the parts of a force together: the scale of its rounding.
pub(super) fn size<D: Dim, S: SpinState>(push: &Push<D, S>) -> f64 {
    push.elastic.length() + push.viscous.length() + push.slip.length()
}

/// n × spin, through space, where both dimensions are the same.
pub(super) fn rolled<D: Dim, S: SpinState>(n: D::V, spin: S::Turn<D>) -> D::V {
    D::from_space(D::to_space(n).cross(S::to_space::<D>(spin)))
}

/// arm × force as a vector of space.
pub(super) fn moment<D: Dim>(arm: D::V, force: D::V) -> DVec3 {
    D::to_space(arm).cross(D::to_space(force))
}

/// A unit vector along a coordinate axis.
pub(super) fn axis<V: Vector>(which: usize) -> V {
    V::from_axes(|a| if a == which { 1.0 } else { 0.0 })
}

/// Unit vectors: along the axes, where coordinates are exactly zero, and scattered.
pub(super) fn directions<V: Vector>() -> impl Iterator<Item = V> {
    let axes = (0..V::AXES).flat_map(|a| [axis::<V>(a), -axis::<V>(a)]);
    axes.chain((0..24).map(|i| {
        let v = scattered::<V>(i);
        v * (1.0 / v.length())
    }))
}

/// A vector with coordinates in ±1 and a length of at least 0.3, always the same for the same number.
pub(super) fn scattered<V: Vector>(number: u64) -> V {
    let mut seed = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    loop {
        let v = V::from_axes(|_| {
            // One round of SplitMix64: well mixed bits from a counter.
            seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        });
        if v.length() > 0.3 || V::AXES == 0 {
            return v;
        }
    }
}

/// Two unit vectors at right angles, in no special direction: the plane of a collision.
pub(super) fn frame<V: Vector>(number: u64) -> (V, V) {
    let (u, w) = (scattered::<V>(number), scattered::<V>(number + 77));
    let u = u * (1.0 / u.length());
    let w = w - u * w.dot(u);
    (u, w * (1.0 / w.length()))
}

/// The vector turned about every axis in turn by an awkward angle. Turns axial vectors too: all of space, none of the plane.
pub(super) fn turned<V: Vector>(v: V) -> V {
    let (sin, cos) = 0.7_f64.sin_cos();
    (1..V::AXES).fold(v, |v, last| {
        let (x, y) = (v.axis(last - 1), v.axis(last));
        V::from_axes(|a| match a {
            _ if a == last - 1 => cos * x - sin * y,
            _ if a == last => sin * x + cos * y,
            _ => v.axis(a),
        })
    })
}

/// The vector in a mirror across the first axis.
pub(super) fn mirrored<V: Vector>(v: V) -> V {
    V::from_axes(|a| if a == 0 { -v.axis(a) } else { v.axis(a) })
}

/// An axial vector in the same mirror: what lies along the first axis stays, what is across it turns round. All of the plane's is across.
pub(super) fn mirrored_axial<W: Vector>(w: W) -> W {
    W::from_axes(|a| {
        if a == 0 && W::AXES == 3 {
            w.axis(a)
        } else {
            -w.axis(a)
        }
    })
}
