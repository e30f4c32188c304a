//! River beds of every kind that pass the checks.

use super::size;
use proptest::prelude::*;
use tsubu_scene::*;

fn springs() -> impl Strategy<Value = SpringDashpot> {
    let constants = prop_oneof![
        (size(), size(), size(), size()).prop_map(|(step, tn, cn, beta)| {
            SpringConstants::FromTimeStep { step, tn, cn, beta }
        }),
        (size(), 1e-3_f64..=1.0).prop_map(|(normal_stiffness, restitution)| {
            SpringConstants::FromRestitution {
                normal_stiffness,
                restitution,
            }
        }),
        (
            size(),
            size(),
            proptest::option::of(size()),
            proptest::option::of(size())
        )
            .prop_map(
                |(normal_stiffness, normal_damping, tangential_stiffness, tangential_damping)| {
                    SpringConstants::Given {
                        normal_stiffness,
                        tangential_stiffness,
                        normal_damping,
                        tangential_damping,
                    }
                }
            ),
    ];
    let readings = (
        prop_oneof![Just(Tension::NoPull), Just(Tension::AsPrinted)],
        prop_oneof![Just(Slip::Total), Just(Slip::AsPrinted)],
        prop_oneof![Just(NormalForce::Closed), Just(NormalForce::Incremental)],
    );
    (constants, 0.0_f64..=0.5, 0.0_f64..2.0, readings).prop_map(
        |(constants, poisson, friction, (tension, slip, normal_force))| SpringDashpot {
            constants,
            poisson,
            friction,
            tension,
            slip,
            normal_force,
        },
    )
}

fn bed() -> impl Strategy<Value = Bed> {
    (
        1_usize..100,
        1.0_f64..=2.0,
        0.0_f64..=0.5,
        0.0_f64..=1.0,
        any::<u64>(),
    )
        .prop_map(|(layers, spacing, vacancies, roughness, seed)| Bed {
            layers,
            spacing,
            vacancies,
            roughness,
            seed,
        })
}

/// Its density is to be put below that of the grains, and its rule for coarse grains to suit them.
fn water() -> impl Strategy<Value = Water> {
    let rows = || {
        proptest::collection::vec((1e-3_f64..1.0, 0.0_f64..1.0), 1..4).prop_map(|steps| {
            let rise = steps.into_iter().scan(0.0, |x, (step, value)| {
                *x += step;
                Some([*x, value])
            });
            rise.collect::<Vec<_>>()
        })
    };
    let flow = prop_oneof![
        size().prop_map(Flow::Shields),
        size().prop_map(Flow::FrictionVelocity),
        rows().prop_map(Flow::OverTime),
    ];
    let profile = prop_oneof![
        size().prop_map(|karman| FlowProfile::Log { karman }),
        rows().prop_map(FlowProfile::Given),
    ];
    let turbulence = prop_oneof![
        Just(Turbulence::Off),
        (size(), size(), any::<u64>()).prop_map(|(frequency, depth, seed)| {
            Turbulence::Switched {
                frequency,
                depth,
                seed,
            }
        }),
    ];
    let datum = prop_oneof![
        Just(Datum::Renewed),
        Just(Datum::Frozen),
        (-1.0_f64..1.0).prop_map(Datum::Given),
    ];
    let numbers = (
        size(),
        size(),
        size(),
        0.0_f64..=1.0,
        -0.9_f64..0.9,
        0_u32..9,
    );
    (flow, profile, turbulence, datum, numbers).prop_map(
        |(flow, profile, turbulence, datum, numbers)| {
            let (begins, added_mass, drag, shelter, slope, bed_contacts) = numbers;
            Water {
                flow,
                begins,
                density: 1000.0,
                added_mass,
                drag,
                profile,
                turbulence,
                shelter,
                datum,
                bed_contacts,
                slope,
                drag_by_volume: false,
            }
        },
    )
}

/// Makes a river bed of a scene.
pub fn flooded(scene: Scene, (law, bed, water, skip): River) -> Scene {
    let water = Water {
        density: 0.5 * scene.grains.density(),
        drag_by_volume: scene.grains.coarse > 0,
        ..water
    };
    Scene {
        grains: Grains {
            law: Law::SpringDashpot(law),
            soften: 1.0,
            softened_damping: SoftenedDamping::Kept,
            ..scene.grains
        },
        domain: Domain {
            x: Axis::Periodic(1.5),
            y: Axis::Periodic(2.5),
            z: Axis::Open,
        },
        walls: Vec::new(),
        outlets: Vec::new(),
        inlets: Vec::new(),
        still: None,
        initial: Initial::Bed(bed),
        water: Some(water),
        measures: Measures {
            conveying: None,
            bed: Some(BedMeasure { skip }),
        },
        time: Time {
            integrator: Integrator::VerletOld,
            ..scene.time
        },
        output: Output {
            energies: false,
            ..scene.output
        },
        ..scene
    }
}

/// What [`flooded`] needs.
pub type River = (SpringDashpot, Bed, Water, f64);

pub fn river() -> impl Strategy<Value = River> {
    (springs(), bed(), water(), 0.0_f64..1.0)
}
