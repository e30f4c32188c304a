//! Scenes of every kind that pass the checks.

mod flow;
mod springs;
mod walls;

use flow::{conveying, fitting, flow};
use glam::DVec3;
use proptest::prelude::*;
use springs::{of_springs, springs};
use tsubu_scene::*;
use walls::{mesh_file, waits, wall};

/// A number above zero of any usual size, with all its digits.
fn size() -> impl Strategy<Value = f64> + Clone {
    (1.0_f64..10.0, -30_i32..30).prop_map(|(digits, power)| digits * 10_f64.powi(power))
}

fn direction() -> impl Strategy<Value = DVec3> + Clone {
    vector().prop_filter_map("not zero", DVec3::try_normalize)
}

fn region() -> impl Strategy<Value = Region> {
    (vector(), 1e-3_f64..1e3).prop_map(|(min, size)| Region {
        min,
        max: min + DVec3::splat(size),
    })
}

fn vector() -> impl Strategy<Value = DVec3> + Clone {
    (-1e3_f64..1e3, -1e3_f64..1e3, -1e3_f64..1e3).prop_map(DVec3::from)
}

fn grains() -> impl Strategy<Value = Grains> {
    let stiffness = prop_oneof![
        size().prop_map(|modulus| (Some(modulus), 0.0)),
        size().prop_map(|epsilon| (None, epsilon)),
    ];
    let damping = prop_oneof![
        size().prop_map(Damping::Equal),
        (size(), size()).prop_map(|(normal, tangential)| Damping::Parts { normal, tangential }),
    ];
    let softened = prop_oneof![
        Just(SoftenedDamping::Kept),
        Just(SoftenedDamping::Scaled),
        Just(SoftenedDamping::NormalScaled)
    ];
    let rule = prop_oneof![
        Just(CoarseRule::Renormalised),
        Just(CoarseRule::SakaiKoshizuka),
        Just(CoarseRule::RadlRestitution)
    ];
    (
        size(),
        size(),
        stiffness,
        damping,
        1.0_f64..1e6,
        softened,
        0_u32..=8,
        rule,
    )
        .prop_map(
            |(
                diameter,
                mass,
                (modulus, epsilon),
                damping,
                soften,
                softened_damping,
                coarse,
                coarse_rule,
            )| {
                let energy = Stiffness::Energy {
                    epsilon,
                    sigma: diameter / 1.1225,
                };
                let stiffness = modulus.map_or(energy, Stiffness::YoungModulus);
                let law = Law::Repulsion { stiffness, damping };
                Grains {
                    diameter,
                    mass,
                    material: "grains".into(),
                    populations: Vec::new(),
                    law,
                    materials: Vec::new(),
                    pairs: Vec::new(),
                    soften,
                    softened_damping,
                    coarse,
                    coarse_rule,
                }
            },
        )
}

fn time() -> impl Strategy<Value = Time> {
    let step = prop_oneof![
        Just(Step::Automatic),
        size().prop_map(Step::PerPeriod),
        size().prop_map(Step::Seconds),
        size().prop_map(Step::Exactly)
    ];
    let integrator = prop_oneof![
        Just(Integrator::ExplicitEuler),
        Just(Integrator::SymplecticEuler),
        Just(Integrator::VerletOld),
        (1_u32..=100).prop_map(|sweeps| Integrator::VerletAveraged { sweeps }),
        (1_u32..=100).prop_map(|sweeps| Integrator::DashpotImplicit { sweeps }),
    ];
    let end = prop_oneof![size().prop_map(End::Until), (1_u64..).prop_map(End::Steps)];
    (step, integrator, end).prop_map(|(step, integrator, end)| Time {
        step,
        integrator,
        end,
    })
}

fn initial() -> impl Strategy<Value = Initial> {
    let grain = (vector(), vector()).prop_map(|(at, velocity)| StartingGrain {
        at,
        velocity,
        population: 0,
    });
    let room = prop_oneof![
        region().prop_map(|region| (Some(region), None)),
        mesh_file().prop_map(|mesh| (None, Some(mesh))),
        (region(), mesh_file()).prop_map(|(region, mesh)| (Some(region), Some(mesh))),
    ];
    let fill = (room, 1e-6_f64..0.36, any::<u64>()).prop_map(
        |((region, within), solid_fraction, seed)| Fill {
            region,
            within,
            solid_fraction,
            seed,
        },
    );
    prop_oneof![
        "/[ -~é粒]{1,20}".prop_map(|path| Initial::File(path.into())),
        fill.prop_map(Initial::Fill),
        proptest::collection::vec(grain, 1..4).prop_map(Initial::Grains),
    ]
}

/// A scene that passes every check.
pub fn scene() -> impl Strategy<Value = Scene> {
    (repulsion(), proptest::option::of(springs())).prop_map(|(scene, springs)| match springs {
        Some(springs) => of_springs(scene, springs),
        None => scene,
    })
}

fn repulsion() -> impl Strategy<Value = Scene> {
    let output = (
        proptest::option::of(size()),
        any::<bool>(),
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(|(every, frames, energies, animation)| Output {
            every,
            frames,
            frames_every: every.filter(|_| frames),
            energies,
            animation,
        });
    let parts = (
        proptest::collection::vec(wall(), 0..4),
        flow(),
        proptest::option::of(conveying()),
        initial(),
        time(),
        output,
    );
    (
        ".{0,20}",
        size(),
        grains(),
        proptest::option::of(1e-3_f64..=1.0),
        parts,
    )
        .prop_map(|(title, gravity, grains, skin, parts)| {
            let (mut walls, (outlets, inlets), conveying, initial, time, output) = parts;
            for (i, wall) in walls.iter_mut().enumerate() {
                wall.name = format!("wall {i}");
            }
            let measures = Measures {
                conveying: conveying.and_then(|measure| fitting(measure, &walls, outlets.len())),
                bed: None,
                discharge: None,
            };
            let still = walls.iter().any(waits).then_some(Still {
                kinetic_energy: 1e-4,
                for_at_least: 0.01,
                at_most: gravity + 0.01,
                damping: 0.5,
            });
            let (space, domain) = (Space::Space, Domain::default());
            Scene {
                title,
                space,
                gravity,
                grains,
                domain,
                walls,
                initial,
                outlets,
                inlets,
                water: None,
                still,
                time,
                skin,
                measures,
                output,
            }
        })
}
