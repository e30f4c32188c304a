//! Every public law of grains that turn passes the conformance suite, in every reading.

use proptest::prelude::*;
use tsubu_contact::testing::{
    Breach, Claims, breaches_spinning, conforms_spinning, rebounds_spinning_with,
};
use tsubu_contact::{Normal, Slip, SpringDashpot, Tension};
use tsubu_model::{Kind, Plane, Space};

/// Paper B's sand: 0.5 mm, 2650 kg/m³, added mass C_M = 0.5 of the water's 1000 kg/m³ in the inertia of its motion only.
fn sand() -> Kind {
    let dry = Kind::sphere(0.5e-3, 2650.0);
    Kind {
        mass: Kind::sphere(0.5e-3, 3150.0).mass,
        weight: Kind::sphere(0.5e-3, 1650.0).mass,
        ..dry
    }
}

/// A grain of the bed that does not move: its own radius, infinite mass.
fn fixed() -> Kind {
    Kind {
        mass: f64::INFINITY,
        inertia: f64::INFINITY,
        weight: 0.0,
        ..sand()
    }
}

fn readings() -> impl Iterator<Item = (Tension, Slip, Normal)> {
    let tensions = [Tension::NoPull, Tension::AsPrinted];
    let slips = [Slip::Total, Slip::AsPrinted];
    let normals = [Normal::Closed, Normal::Incremental];
    tensions.into_iter().flat_map(move |tension| {
        slips.into_iter().flat_map(move |slip| {
            normals
                .into_iter()
                .map(move |normal| (tension, slip, normal))
        })
    })
}

/// What the law promises in its reading.
fn claims(law: &SpringDashpot) -> Claims {
    let claims = match law.slip {
        Slip::Total => Claims::default().friction(law.friction),
        Slip::AsPrinted => Claims::default().friction_of_springs(law.friction),
    };
    match law.tension {
        Tension::NoPull => claims.never_pulls(),
        Tension::AsPrinted => claims,
    }
}

/// In every reading against an equal grain and a wall; against a larger and a fixed grain in the default and in the paper's own.
fn conforms_in_every_reading(law: SpringDashpot) {
    for (tension, slip, normal) in readings() {
        let law = law.tension(tension).slip(slip).normal(normal);
        for partner in [sand(), Kind::immovable()] {
            conforms_spinning(&law, &sand(), &partner, claims(&law));
        }
    }
    let printed = law
        .tension(Tension::AsPrinted)
        .slip(Slip::AsPrinted)
        .normal(Normal::Incremental);
    for law in [law, printed] {
        for partner in [Kind::sphere(0.8e-3, 2650.0), fixed()] {
            conforms_spinning(&law, &sand(), &partner, claims(&law));
        }
    }
}

/// The constants of the paper: αtn = 20, αcn = 1.3, ν = 0.3, μ = 0.577; ζ = √2 αcn = 1.84 for a pair, αcn at a wall.
#[test]
fn the_springs_of_paper_b_conform() {
    let law = SpringDashpot::from_time_step(2.0e-5, sand().mass, 20.0, 1.3, 0.3, 0.577);
    conforms_in_every_reading(law);
}

/// β = 15.8, ζ = 29 for a pair.
#[test]
fn the_soft_springs_of_bed_load_conform() {
    let law = SpringDashpot::from_time_step(2.0e-5, sand().mass, 20.0, 1.3, 0.3, 0.577);
    conforms_in_every_reading(law.scaled_by(15.8));
}

/// Lightly damped, and not at all: here nothing hides a gain of energy.
#[test]
fn bouncing_springs_conform() {
    for (restitution, friction) in [(0.9, 0.1), (1.0, 0.577), (1.0, 1.0)] {
        let mass = 0.5 * sand().mass;
        let law = SpringDashpot::from_restitution(0.25, restitution, mass, 0.3, friction);
        conforms_in_every_reading(law);
    }
}

#[test]
fn smooth_springs_conform() {
    let mass = 0.5 * sand().mass;
    conforms_in_every_reading(SpringDashpot::from_restitution(0.25, 0.6, mass, 0.3, 0.0));
}

/// The restitution asked for is the one got, at any speed: the spring is linear. The suite's step costs
/// 2ζωΔt = 2ζπ/20000 of e.
#[test]
fn the_restitution_asked_for_is_got() {
    let wall = Kind::immovable();
    for e in [0.05, 0.3, 0.7, 1.0] {
        let law = SpringDashpot::from_restitution(1.0e3, e, sand().mass, 0.3, 0.577);
        let zeta = law.damping_ratio(sand().mass);
        let tolerance = 1e-6 + 2.0 * zeta * std::f64::consts::PI / 20_000.0 * e;
        rebounds_spinning_with::<Space, _>(&law, &sand(), &wall, e, tolerance);
        rebounds_spinning_with::<Plane, _>(&law, &sand(), &wall, e, tolerance);
    }
}

/// Breaches in both dimensions.
fn found(law: &SpringDashpot, a: &Kind, b: &Kind) -> Vec<Breach> {
    let mut found = breaches_spinning::<Space, _>(law, a, b, claims(law));
    found.extend(breaches_spinning::<Plane, _>(law, a, b, claims(law)));
    found
}

proptest! {
    // Each case is two full suites of a pair and two of a wall.
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Any grain from 10 µm to 1 m, soft or hard, damped lightly or heavily, in any reading.
    #[test]
    fn any_springs_conform(
        log_d in -5.0..0.0f64,
        log_stiffness in -2.0..6.0f64,
        density in 100.0..20_000.0f64,
        zeta in 0.0..3.0f64,
        poisson in 0.0..0.5f64,
        friction in 0.0..1.5f64,
        size_ratio in 0.3..3.0f64,
        reading in 0..8usize,
    ) {
        let d = 10f64.powf(log_d);
        let (a, b) = (Kind::sphere(d, density), Kind::sphere(d * size_ratio, density));
        let kn = 10f64.powf(log_stiffness);
        let ratio = 2.0 * (1.0 + poisson);
        let eta = zeta * 2.0 * (kn * 0.5 * a.mass).sqrt();
        let (tension, slip, normal) = readings().nth(reading).unwrap_or_default();
        let law = SpringDashpot::new(kn, kn / ratio, eta, eta / ratio.sqrt(), friction)
            .tension(tension).slip(slip).normal(normal);
        let of_pair = found(&law, &a, &b);
        prop_assert!(of_pair.is_empty(), "{of_pair:#?}");
        let of_wall = found(&law, &a, &Kind::immovable());
        prop_assert!(of_wall.is_empty(), "{of_wall:#?}");
    }
}
