//! Numbers worked out by hand or measured in flumes, and what the crate says.

use glam::{DVec2, DVec3};
use tsubu_stream::{
    LogLaw, Sediment, Setting, Shelter, Stream, TransportCurve, Turbulence, Water, bed_load_rate,
};

const D: f64 = 0.5e-3;

fn paper() -> Stream {
    Stream::new(Setting::over_grains(D, 0.05, 1)).unwrap()
}

/// Relative difference.
fn off(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// U/u* and ε of paper B at y = d/2 and y = 0, from the formulas in another language; κ = 0.40.
#[test]
fn profile_and_shelter_of_the_papers_grain() {
    let (flow, shelter) = (LogLaw::over_grains(D), Shelter::among_grains(D));
    for (y, shape, factor) in [
        (0.5 * D, 7.792107748257623, 0.6581303051614462),
        (0.0, 5.045577026587349, 0.43635216231191454),
    ] {
        assert!(off(flow.over_friction_velocity(y), shape) < 1e-12);
        assert!(off(shelter.factor(y), factor) < 1e-12);
    }
    // Where the logarithm is zero: −0.25 d + d/30.1.
    assert!(off(flow.zero(), (-0.25 + 1.0 / 30.1) * D) < 1e-14);
}

/// The derived checks, to the digits printed: 12.0 τ* at y = d/2 (half a digit 0.05) and 3.33 τ* at y = 0 (0.005),
/// so that a grain of μ = 0.577 moves at τ* = 0.048 and 0.173 (0.0005 each).
#[test]
fn drag_over_weight_and_the_threshold_of_sliding() {
    let stream = paper();
    assert!((stream.drag_over_weight(0.5 * D) - 12.0).abs() < 0.05);
    assert!((stream.drag_over_weight(0.0) - 3.33).abs() < 0.005);
    assert!((stream.threshold(0.5 * D, 0.577).unwrap() - 0.048).abs() < 0.0005);
    assert!((stream.threshold(0.0, 0.577).unwrap() - 0.173).abs() < 0.0005);
    assert_eq!(stream.threshold(-D, 0.577).unwrap(), f64::INFINITY);
}

/// The same through forces and kinds: drag on a grain at rest over its submerged weight, for sizes, densities and
/// speeds, is the pure number times τ*. A dozen roundings: 1e-13.
#[test]
fn forces_agree_with_the_pure_number() {
    for (d, density, speed) in [
        (0.5e-3, 2650.0, 0.05),
        (1e-4, 1400.0, 0.01),
        (2e-2, 7800.0, 0.9),
    ] {
        let sediment = Sediment {
            diameter: d,
            density,
        };
        let mut stream = Stream::new(Setting {
            turbulence: Turbulence::none(),
            ..Setting::over_grains(d, speed, 1)
        })
        .unwrap();
        stream.renew(0.0, [(0.0, 2)].into_iter()).unwrap();
        let water = stream.setting().water;
        let weight = water.grain(&sediment).unwrap().weight * water.gravity;
        let place = DVec3::new(0.3, 0.1, 0.7 * d);
        let force = stream
            .at(0.0)
            .unwrap()
            .force::<tsubu_model::Space>(place, DVec3::ZERO, 3, d);
        let expected = stream.drag_over_weight(0.7 * d) * water.shields(&sediment, speed).unwrap();
        assert!(off(force.x / weight, expected) < 1e-13);
        assert_eq!((force.y, force.z), (0.0, 0.0));
    }
}

/// A sinking sphere reaches w = √(4 (ρs/ρ − 1) g d/(3 CD)): 0.1642 m/s for the paper's grain.
#[test]
fn drag_carries_the_weight_at_the_settling_speed() {
    let (water, sand) = (Water::fresh(), Sediment::quartz(D));
    let speed = (4.0 * 1.65 * 9.80665 * D / (3.0 * 0.4)).sqrt();
    assert!((speed - 0.1642).abs() < 5e-5);
    let drag = water.drag(D, 1.0, DVec2::new(0.0, speed));
    let weight = water.grain(&sand).unwrap().weight * water.gravity;
    assert!(off(drag.y, weight) < 1e-13);
}

/// (2650 + 500) and (2650 − 1000) kg/m³ times 6.544985e-11 m³; inertia 2650 π d⁵/60 = 4.336e-15 kg m².
#[test]
fn added_mass_moves_inertia_and_buoyancy_moves_weight() {
    let grain = Water::fresh().grain(&Sediment::quartz(D)).unwrap();
    assert_eq!(grain.diameter(), D);
    assert!(off(grain.mass, 2.061670e-7) < 1e-6);
    assert!(off(grain.weight, 1.079922e-7) < 1e-6);
    assert!(off(grain.inertia, 4.336052e-15) < 1e-6);
}

/// There and back, and the whole chain on one grain per d² of plane bed at 1 m/s: qB* = (π/6) u/√(1.65 g d).
#[test]
fn shields_and_transport_numbers() {
    let (water, sand) = (Water::fresh(), Sediment::quartz(D));
    for shields in [0.0, 0.047, 0.5, 3.0] {
        let speed = water.friction_velocity(&sand, shields).unwrap();
        assert!((water.shields(&sand, speed).unwrap() - shields).abs() < 1e-15 + 1e-14 * shields);
    }
    let rate = bed_load_rate([(D, 1.0); 40].into_iter(), 40.0 * D, D).unwrap();
    let expected = std::f64::consts::PI / 6.0 / (1.65 * 9.80665 * D).sqrt();
    assert!(off(water.transport(&sand, rate).unwrap(), expected) < 1e-13);
    // Against the flow it is negative.
    let back = bed_load_rate([(D, -1.0)].into_iter(), D, D).unwrap();
    assert!(water.transport(&sand, back).unwrap() < 0.0);
}

/// By hand: 8 · 0.453^1.5 = 2.43914, 3.97 · 0.4505^1.5 = 1.20042, 4.93 · 0.453^1.6 = 1.38869; nothing at a threshold.
#[test]
fn curves_at_half_and_at_their_thresholds() {
    use TransportCurve as T;
    for (curve, at_half) in [
        (T::MEYER_PETER_MULLER, 2.43914),
        (T::WONG_PARKER, 1.20042),
        (T::WONG_PARKER_FREE_EXPONENT, 1.38869),
    ] {
        assert!(
            off(curve.transport(0.5).unwrap(), at_half) < 1e-5,
            "{curve:?}: {:?}",
            curve.transport(0.5)
        );
        assert_eq!(curve.transport(curve.threshold).unwrap(), 0.0);
        assert_eq!(curve.transport(0.0).unwrap(), 0.0);
    }
    // Wong and Parker's abstract: their estimate is at most half of the uncorrected original's.
    for shields in (5..100).map(|hundredths| 0.01 * f64::from(hundredths)) {
        let (new, old) = (
            T::WONG_PARKER.transport(shields).unwrap(),
            T::MEYER_PETER_MULLER.transport(shields).unwrap(),
        );
        assert!(new <= 0.5 * old, "{shields}");
    }
}

/// Six of Gilbert's flume runs of 1914 with sand of 0.506 mm: slope, hydraulic radius over d, and the τ* and qB* that
/// the compilation prints. τ* through √(gRS), to the rounding of slope and radius (2e-4); the rate within
/// a factor of two of Meyer-Peter and Müller, as 98 % of his 202 runs at τ* 0.2 to 1 are.
#[test]
fn gilberts_flume() {
    let water = Water::fresh();
    let sand = Sediment::quartz(0.506e-3);
    for [slope, radius, shields, transport] in [
        [0.0126, 60.28, 0.4603, 3.88615],
        [0.0104, 117.36, 0.7397, 6.7315],
        [0.0117, 123.35, 0.8746, 9.07455],
        [0.0122, 63.41, 0.4689, 3.58605],
        [0.0097, 111.08, 0.653, 5.95349],
        [0.0109, 79.56, 0.5256, 4.61013],
    ] {
        let speed = water
            .friction_velocity_of_slope(radius * sand.diameter, slope)
            .unwrap();
        let found = water.shields(&sand, speed).unwrap();
        assert!(off(found, shields) < 2e-4, "{found} {shields}");
        let curve = TransportCurve::MEYER_PETER_MULLER.transport(found).unwrap();
        assert!(
            (0.5..2.0).contains(&(curve / transport)),
            "{curve} {transport}"
        );
    }
}
