//! Grains of springs and dashpots, their beds, and the water over them.

use proptest::collection::vec;
use proptest::option::of;
use proptest::prelude::*;
use tsubu_scene::*;

use super::size;

/// What makes a scene of springs of a scene of repulsion.
#[derive(Clone, Debug)]
pub struct Springs {
    law: SpringDashpot,
    /// Elastic spheres of one or two materials instead, and what the two make of each other.
    hertz: Option<([HertzMindlin; 2], Option<PairOf>)>,
    /// Ratios of the smaller diameters to the largest, and the parts of the mass of all.
    mixture: Option<Vec<(f64, f64)>>,
    bed: Option<Bed>,
    water: Option<Water>,
    /// Density over that of the water.
    heavier: f64,
    plane: bool,
    skip: f64,
}

pub fn springs() -> impl Strategy<Value = Springs> {
    let mixture = vec((0.01_f64..0.99, 0.1_f64..1.0), 1..4);
    let parts = (1.01_f64..5.0, any::<bool>(), 0.0_f64..1.0);
    (
        law(),
        of(hertz()),
        of(mixture),
        of(bed()),
        of(water()),
        parts,
    )
        .prop_map(
            |(law, hertz, mixture, bed, water, (heavier, plane, skip))| Springs {
                law,
                hertz,
                mixture,
                bed,
                water,
                heavier,
                plane,
                skip,
            },
        )
}

/// Two materials that resist rolling alike, and their pair if the second is there.
fn hertz() -> impl Strategy<Value = ([HertzMindlin; 2], Option<PairOf>)> {
    let one = (size(), -0.99_f64..0.5, 1e-6_f64..=1.0, 0.0_f64..2.0, size());
    let by = prop_oneof![Just(Resistance::ElasticPlastic), Just(Resistance::Constant)];
    ([one.clone(), one], of(by), any::<bool>()).prop_map(|(two, by, both)| {
        let laws = two.map(
            |(young, poisson, restitution, friction, rolling)| HertzMindlin {
                young,
                poisson,
                restitution,
                friction,
                rolling: by.map(|by| RollingResistance {
                    friction: rolling,
                    damping: match by {
                        Resistance::ElasticPlastic => rolling,
                        // What the program takes where the scene may not say.
                        Resistance::Constant => 0.3,
                    },
                    by,
                }),
            },
        );
        let pair = PairOf {
            of: [0, 1],
            restitution: Some(laws[0].restitution),
            friction: laws[1].friction,
            rolling_friction: by.map(|_| 0.1),
        };
        (laws, both.then_some(pair))
    })
}

/// A scene without walls and gates, whose grains are those of the springs.
pub fn of_springs(mut scene: Scene, springs: Springs) -> Scene {
    scene.walls.clear();
    scene.outlets.clear();
    scene.inlets.clear();
    scene.still = None;
    scene.measures = Measures::default();
    scene.output.energies = false;
    if matches!(
        scene.time.integrator,
        Integrator::VerletAveraged { .. } | Integrator::DashpotImplicit { .. }
    ) {
        scene.time.integrator = Integrator::SymplecticEuler;
    }
    scene.grains.law = Law::SpringDashpot(springs.law);
    if let Some(([own, other], pair)) = springs.hertz {
        scene.grains.law = Law::HertzMindlin(own);
        if let Some(pair) = pair {
            scene.grains.materials = vec![Material {
                name: "steel".into(),
                law: Law::HertzMindlin(other),
            }];
            scene.grains.pairs = vec![pair];
        }
    }
    scene.grains.soften = 1.0;
    scene.grains.softened_damping = SoftenedDamping::Kept;
    // What is placed in a box is inside the periods.
    scene.domain.x = Axis::Periodic(1e5);
    let starts_flat = matches!(scene.initial, Initial::File(_));
    if springs.plane && starts_flat {
        scene.space = Space::Plane;
    } else {
        scene.domain.y = Axis::Periodic(1e5);
    }
    if let Initial::Fill(fill) = &mut scene.initial
        && let Some(region) = &mut fill.region
    {
        region.min += 1e4;
        region.max += 1e4;
    }
    if let Some(bed) = springs.bed {
        scene.initial = Initial::Bed(bed);
    }
    if let Some(mut water) = springs.water.filter(|_| springs.bed.is_some()) {
        water.drag_by_volume = scene.grains.coarse > 0;
        scene.grains.mass = springs.heavier * water.density * scene.grains.volume();
        scene.measures.bed = Some(BedMeasure { skip: springs.skip });
        scene.water = Some(water);
    }
    let drawn = matches!(scene.initial, Initial::Fill(_) | Initial::Bed(_));
    if let Some(mixture) = springs.mixture.filter(|_| drawn) {
        // A mixture is not coarse, and its mass follows from a density.
        scene.grains.coarse = 0;
        if let Some(water) = &mut scene.water {
            water.drag_by_volume = false;
        } else {
            scene.grains.mass = springs.heavier * scene.grains.volume();
        }
        scene.grains.populations =
            populations(&mixture, scene.grains.diameter, scene.grains.density());
        if let Some(last) = scene.grains.populations.last_mut() {
            last.material = scene.grains.materials.len();
        }
    }
    scene
}

fn populations(mixture: &[(f64, f64)], largest: f64, density: f64) -> Vec<Population> {
    let parts = || std::iter::once(&(1.0, 0.5)).chain(mixture);
    let sum: f64 = parts().map(|(_, part)| part).sum();
    let populations = parts().map(|(ratio, part)| Population {
        diameter: largest * ratio,
        density,
        share: part / sum,
        material: 0,
    });
    populations.collect()
}

fn law() -> impl Strategy<Value = SpringDashpot> {
    let constants = prop_oneof![
        (size(), size(), size(), size()).prop_map(|(step, tn, cn, beta)| {
            SpringConstants::FromTimeStep { step, tn, cn, beta }
        }),
        (size(), size(), of(size()), of(size())).prop_map(
            |(normal_stiffness, normal_damping, tangential_stiffness, tangential_damping)| {
                SpringConstants::Given {
                    normal_stiffness,
                    normal_damping,
                    tangential_stiffness,
                    tangential_damping,
                }
            }
        ),
        (size(), 1e-6_f64..=1.0).prop_map(|(normal_stiffness, restitution)| {
            SpringConstants::FromRestitution {
                normal_stiffness,
                restitution,
            }
        }),
    ];
    let tension = prop_oneof![Just(Tension::NoPull), Just(Tension::AsPrinted)];
    let slip = prop_oneof![Just(Slip::AsPrinted), Just(Slip::Total)];
    let normal = prop_oneof![Just(NormalForce::Closed), Just(NormalForce::Incremental)];
    let numbers = (0.0_f64..=0.5, 0.0_f64..2.0);
    (constants, numbers, tension, slip, normal).prop_map(
        |(constants, (poisson, friction), tension, slip, normal_force)| {
            let needless = matches!(
                constants,
                SpringConstants::Given {
                    tangential_stiffness: Some(_),
                    tangential_damping: Some(_),
                    ..
                }
            );
            SpringDashpot {
                constants,
                poisson: if needless { 0.3 } else { poisson },
                friction,
                tension,
                slip,
                normal_force,
            }
        },
    )
}

fn bed() -> impl Strategy<Value = Bed> {
    let shares = (1.0_f64..=2.0, 0.0_f64..=0.5, 0.0_f64..=1.0);
    (1_usize..=10_000, shares, any::<u64>()).prop_map(
        |(layers, (spacing, vacancies, roughness), seed)| Bed {
            layers,
            spacing,
            vacancies,
            roughness,
            seed,
        },
    )
}

/// Rows whose first value rises from zero on and whose second is above zero.
fn rows() -> impl Strategy<Value = Vec<[f64; 2]>> {
    vec((1e-3_f64..1.0, 1e-3_f64..1e3), 1..5).prop_map(|steps| {
        let mut at = 0.0;
        let row = |(step, value)| {
            at += step;
            [at, value]
        };
        steps.into_iter().map(row).collect()
    })
}

fn water() -> impl Strategy<Value = Water> {
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
        Just((Datum::Renewed, true)),
        Just((Datum::Frozen, true)),
        (-1e3_f64..1e3).prop_map(|height| (Datum::Given(height), false)),
    ];
    let numbers = (size(), size(), size(), size(), 0.0_f64..=1.0);
    let bed = (datum, 0_u32..=12, -0.999_f64..0.999);
    (flow, profile, turbulence, numbers, bed).prop_map(
        |(flow, profile, turbulence, numbers, ((datum, found), bed_contacts, slope))| {
            let (begins, density, added_mass, drag, shelter) = numbers;
            Water {
                flow,
                begins,
                density,
                added_mass,
                drag,
                profile,
                turbulence,
                shelter,
                datum,
                bed_contacts: if found { bed_contacts } else { 2 },
                slope,
                drag_by_volume: false,
            }
        },
    )
}
