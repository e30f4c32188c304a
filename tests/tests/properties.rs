//! Random small scenes: what `check` calls stable runs without trouble, keeps the invariants, and knows no units.

use glam::DVec3;
use proptest::prelude::*;
use std::f64::consts::PI;
use tsubu::assemble::{Built, Choices, Stop, build};
use tsubu::scene::{Checked, Source};

/// Units of length, mass and time in SI.
#[derive(Clone, Copy, Debug)]
struct Units {
    metre: f64,
    kilogram: f64,
    second: f64,
}

const SI: Units = Units {
    metre: 1.0,
    kilogram: 1.0,
    second: 1.0,
};

/// A small scene in numbers of its own: diameter, mass and contact stiffness k are 1.
#[derive(Clone, Debug)]
struct Small {
    plane: bool,
    /// 2 ζ √(k m*) of a pair.
    damping_ratio: f64,
    /// γt/γn; 1 takes the law without projection.
    across: f64,
    integrator: &'static str,
    /// Steps per period of a pair.
    per_period: f64,
    /// Seeds of the speeds; the speed in units of d ω.
    agitation: f64,
    seed: u64,
    /// A floor under gravity (in units of d ω² / 1000), or neither.
    gravity: Option<f64>,
}

impl Small {
    /// The scene in given units, with the grain's diameter `d`, density and modulus as scales.
    fn text(&self, d: f64, density: f64, modulus: f64, units: Units) -> String {
        let mass = density * PI / 6.0 * d.powi(3);
        let stiffness = modulus * d / 2f64.powf(1.0 / 6.0);
        let omega = (stiffness / (0.5 * mass)).sqrt();
        let damping = 2.0 * self.damping_ratio * (stiffness * 0.5 * mass).sqrt();
        let (metre, speed) = (units.metre, units.metre / units.second);
        let mut random = Random(self.seed);
        let mut grains = String::new();
        let layers = if self.plane { 1 } else { 3 };
        for i in 0..27 {
            // A lattice with gaps of 2 %, loosened by 0.5 %: no two overlap, all soon touch.
            let cell = [i % 3, (i / 3) % layers, i / (3 * layers)];
            let at = cell.map(|c| (0.6 + 1.02 * c as f64 + 0.005 * random.next()) * d * metre);
            let v = [0; 3].map(|_| random.next() * self.agitation * omega * d * speed);
            let (y, vy) = if self.plane {
                (0.0, 0.0)
            } else {
                (at[1], v[1])
            };
            grains += &format!(
                "(at: (\"{:e} m\", \"{y:e} m\", \"{:e} m\"), velocity: (\"{:e} m/s\", \"{vy:e} m/s\", \"{:e} m/s\")), ",
                at[0], at[2], v[0], v[2]
            );
        }
        // Box of 3.2 d along x and y: the lattice meets itself through the boundary.
        let period = 3.2 * d * metre;
        let gravity = self.gravity.map_or(0.0, |g| 1e-3 * g * omega * omega * d) * units.metre
            / units.second.powi(2);
        let gamma = damping * units.kilogram / units.second;
        format!(
            r#"(
    title: "T",
    space: {},
    gravity: "{gravity:e} m/s2",
    grains: (
        diameter: "{:e} m", mass: "{:e} kg",
        law: Repulsion(stiffness: YoungModulus("{:e} Pa"), damping: Parts(normal: "{gamma:e} kg/s", tangential: "{:e} kg/s")),
    ),
    domain: (x: Periodic("{period:e} m"){}),
    walls: [{}],
    initial: (grains: [{grains}]),
    time: (step: PerPeriod({}), integrator: {}, steps: 200),
    output: (energies: true),
)"#,
            if self.plane { "Plane" } else { "Space" },
            d * units.metre,
            mass * units.kilogram,
            modulus * units.kilogram / (units.metre * units.second.powi(2)),
            gamma * self.across,
            if self.plane {
                String::new()
            } else {
                format!(", y: Periodic(\"{period:e} m\")")
            },
            if self.gravity.is_some() {
                r#"(name: "floor", shape: HalfSpace(point: ("0 m", "0 m", "0 m"), outward: (0, 0, 1)), restitution: 0.6, friction: 0.3)"#
            } else {
                ""
            },
            self.per_period,
            self.integrator,
        )
    }

    fn explicit(&self) -> bool {
        !self.integrator.contains("sweeps")
    }
}

/// Numbers in [−1, 1), the same for the same seed.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn small() -> impl Strategy<Value = Small> {
    let integrator = prop_oneof![
        Just("SymplecticEuler"),
        Just("VerletOld"),
        Just("VerletAveraged(sweeps: 8)"),
        Just("DashpotImplicit(sweeps: 8)")
    ];
    // Without damping nothing hides a gain.
    let damping_ratio = prop_oneof![Just(0.0), 0.0..0.5f64];
    let across = prop_oneof![Just(1.0), 0.0..1.0f64];
    let gravity = proptest::option::of(0.1..2.0f64);
    (
        any::<bool>(),
        damping_ratio,
        across,
        integrator,
        8.0..120.0f64,
        1e-3..0.03f64,
        any::<u64>(),
        gravity,
    )
        .prop_map(
            |(plane, damping_ratio, across, integrator, per_period, agitation, seed, gravity)| {
                Small {
                    plane,
                    damping_ratio,
                    across,
                    integrator,
                    per_period,
                    agitation,
                    seed,
                    gravity,
                }
            },
        )
}

/// Diameter, density, modulus over decades.
fn scales() -> impl Strategy<Value = (f64, f64, f64)> {
    let decades = |low: f64, high: f64| (low..high).prop_map(|power| 10f64.powf(power));
    (decades(-5.0, 1.0), decades(2.0, 4.2), decades(4.0, 11.0))
}

fn read(text: &str) -> Checked {
    Source::from_text("random", text)
        .check()
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The scene built, or `None` if its step is refused.
fn stable(text: &str) -> Option<Built> {
    match build(
        &read(text),
        &Choices {
            threads: Some(1),
            ..Choices::default()
        },
    ) {
        Ok(built) => Some(built),
        Err(error) => {
            assert!(error.headline().contains("is over its limit"), "{error}");
            None
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// What `check` calls stable runs; nothing is gained with γ ≥ 0, and without walls the momentum stays.
    ///
    /// Energy, with ω the stiffest mode: at most twice that of a pair (eigenvalue 8 against 2), and 1.5 times more where
    /// the law has stiffened at the deepest overlaps. Velocities half a step off make the held energy swing by
    /// ½ Δt |v·F| ≤ ωΔt √(K U) for contacts, which is nothing while none is closed, and by ½ Δt m g |v| for the weight.
    /// What stays for good is of second order, (ωΔt)²/8 of what moves: a collision begins and ends between two steps.
    /// A grain has a few collisions within the run, and their errors have either sign: twice all this is allowed.
    ///
    /// Momentum: explicit schemes to 1e-12 of Σ|p|. A solve that stops early is off by no more than the change of its
    /// last sweep for each grain and half step.
    #[test]
    fn what_check_calls_stable_keeps_the_invariants(small in small(), (d, density, modulus) in scales()) {
        let text = small.text(d, density, modulus, SI);
        let Some(Built { mut simulation, plan }) = stable(&text) else { return Ok(()) };
        let mass = plan.constants.kind.mass;
        let start = simulation.energies();
        let lowest = start.gravitational - mass * simulation.grains() as f64 * read(&text).scene.gravity * d;
        let momentum = |state: &[(DVec3, DVec3)]| state.iter().fold(DVec3::ZERO, |sum, (_, v)| sum + *v);
        let before = momentum(&simulation.state());
        let size: f64 = simulation.state().iter().map(|(_, v)| v.length()).sum();
        let mut off = 1e-12 * size;
        let phase = 2.0 * PI * plan.constants.dt / plan.constants.period * 2.0 * 1.5;
        let half_off = if small.integrator.starts_with("Verlet") { 0.0 } else { 1.0 };
        let weight = 0.5 * plan.constants.dt * mass * read(&text).scene.gravity;
        while !simulation.is_over() {
            simulation.advance(1);
            off += 2.0 * simulation.grains() as f64 * simulation.solve_residual();
            let now = simulation.energies();
            let moving = start.held() - lowest.min(now.gravitational);
            let speeds: f64 = simulation.state().iter().map(|(_, v)| v.length()).sum();
            let swing = half_off * (phase * (now.kinetic * (now.elastic + now.elastic_walls)).sqrt() + weight * speeds);
            let gained = now.held() - start.held();
            prop_assert!(gained <= 2.0 * (swing + phase * phase / 8.0 * moving), "gained {gained:e} of {moving:e}, swing {swing:e}");
            if small.gravity.is_none() {
                let gone = (momentum(&simulation.state()) - before).length();
                prop_assert!(gone <= off, "momentum gone: {gone:e} of {size:e}, allowed {off:e}");
            }
        }
        prop_assert_eq!(simulation.stop(), Some(Stop::Over));
        prop_assert!(simulation.state().iter().all(|(x, v)| x.is_finite() && v.is_finite()));
        prop_assert!(small.gravity.is_some() || small.explicit() || off < 0.2 * size, "the solve does not converge: {off:e} of {size:e}");
    }

    /// The same scene in other units has the same trajectories in those units, to 1e-9 of a diameter and of d/Δt. Grains
    /// are chaotic: without damping 1e-16 has been seen to grow to 1e-9 in the 25 periods that 200 of the longest steps
    /// last. Half as long leaves it the square root of that growth, some 1e-12.
    #[test]
    fn trajectories_know_no_units(small in small(), (d, density, modulus) in scales(), powers in [-4.0..4.0f64, -4.0..4.0f64, -4.0..4.0f64]) {
        let [metre, kilogram, second] = powers.map(|power| 10f64.powf(power));
        let other = small.text(d, density, modulus, Units { metre, kilogram, second });
        let text = small.text(d, density, modulus, SI);
        let (Some(mut a), Some(mut b)) = (stable(&text), stable(&other)) else {
            // Refused in one, refused in the other.
            prop_assert!(stable(&text).is_none() && stable(&other).is_none());
            return Ok(());
        };
        let dt = a.plan.constants.dt;
        prop_assert!((b.plan.constants.dt / second / dt - 1.0).abs() < 1e-12);
        a.simulation.advance(100);
        b.simulation.advance(100);
        for ((x, v), (y, w)) in a.simulation.state().into_iter().zip(b.simulation.state()) {
            prop_assert!((x - y / metre).length() < 1e-9 * d, "{x} and {}", y / metre);
            prop_assert!((v - w * (second / metre)).length() * dt < 1e-9 * d);
        }
    }

    /// A fill at any coarse level falls on a floor: stable by the check, sound to the end, in the box it fell into.
    #[test]
    fn a_coarse_fill_falls_without_trouble(plane in any::<bool>(), n in 0u32..3, seed in any::<u64>(), rule in prop_oneof![Just("Renormalised"), Just("SakaiKoshizuka"), Just("RadlRestitution")], power in -4.0..0.0f64) {
        let d = 10f64.powf(power);
        let length = |factor: f64| format!("\"{:e} m\"", factor * d);
        let (space, y, axis) = if plane { ("Plane", "\"0 m\"".to_owned(), String::new()) } else { ("Space", length(14.0), format!(", y: Periodic({})", length(14.0))) };
        // The damping of ζ = 0.02, and a gravity that moves a grain by its diameter within 100 steps.
        let (mass, stiffness) = (PI / 6.0 * 2500.0 * d.powi(3), 1e7 * d / 2f64.powf(1.0 / 6.0));
        let period = 2.0 * PI * (0.5 * mass / stiffness).sqrt();
        let gravity = 2.0 * d / (5.0 * period).powi(2) / f64::from(1 << n);
        let text = format!(r#"(
            title: "T", space: {space}, gravity: "{gravity:e} m/s2",
            grains: (diameter: {}, density: "2500 kg/m3", coarse: {n}, coarse_rule: {rule},
                law: Repulsion(stiffness: YoungModulus("10 MPa"), damping: Equal("{:e} kg/s"))),
            domain: (x: Periodic({}){axis}),
            walls: [(name: "floor", shape: HalfSpace(point: ("0 m", "0 m", "0 m"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.4)],
            initial: (fill: (region: (min: ("0 m", "0 m", "0 m"), max: ({}, {y}, {})), solid_fraction: 0.2, seed: {seed})),
            time: (step: PerPeriod(40), steps: 200),
        )"#, length(1.0), 0.04 * (stiffness * 0.5 * mass).sqrt(), length(14.0), length(14.0), length(30.0));
        let Some(Built { mut simulation, .. }) = stable(&text) else { return Ok(()) };
        tsubu_tests::run_out(&mut *simulation);
        prop_assert_eq!(simulation.stop(), Some(Stop::Over));
        // Nothing falls through the floor, by more than a tenth of a coarse grain.
        let least = (0.5 - 0.1) * d * f64::from(1 << n);
        prop_assert!(simulation.state().iter().all(|(x, _)| x.z > least && x.z < 31.0 * d));
        let overlap = simulation.look().into_iter().find(|r| r.name == "overlap_max").map_or(f64::NAN, |r| r.value);
        prop_assert!(overlap < 0.3, "{overlap}");
    }
}
