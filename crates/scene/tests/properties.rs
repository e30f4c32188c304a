//! What holds of every text and of every scene.

use glam::DVec3;
use proptest::prelude::*;
use tsubu_scene::*;

const SCENE: &str = include_str!("../../../tests/scenes/good/walls_and_comments.ron");

/// A text is checked, or refused with a message that can be drawn.
fn ends_well(source: &Source) {
    match source.check() {
        Ok(checked) => assert!(!checked.scene.to_resolved_ron().is_empty()),
        Err(error) => {
            assert!(!error.headline().is_empty());
            assert!(error.to_string().starts_with("error: "));
            assert!(error.render(true).len() > 20);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_text_ends_well(text in "([(){}\\[\\],:\"'/*#r!a1. \n]|title|grains|.){0,60}", spec in ".{0,30}") {
        let mut source = Source::from_text("x", &text);
        ends_well(&source);
        let _ = source.set(&spec);
        ends_well(&source);
    }

    /// A good scene with a part cut out, and another text put there.
    #[test]
    fn a_damaged_scene_ends_well(from in 0_usize..1800, length in 0_usize..40, with in "([(){}\\[\\],:\"1. \n]|None|inf|-1e400|.){0,4}") {
        let mut signs: Vec<char> = SCENE.chars().collect();
        let from = from.min(signs.len());
        let to = (from + length).min(signs.len());
        signs.splice(from..to, with.chars());
        ends_well(&Source::from_text("x", &signs.into_iter().collect::<String>()));
    }

    #[test]
    fn any_override_ends_well(
        path in "(grains|walls|time|initial|title|still|x)((\\.|\\[)(coarse|floor|0|name|shape|point|until|grains|law|\\]){0,3}){0,3}",
        value in "([(){}\\[\\],:\"/'1. \n]|None|\"2 mm\"|Open|.){0,8}",
    ) {
        let mut source = Source::from_text("x", SCENE);
        if source.set(&format!("{path}={value}")).is_ok() {
            ends_well(&source);
        }
    }

    #[test]
    fn a_resolved_scene_reads_back(scene in scene()) {
        let text = scene.to_resolved_ron();
        match Source::from_text("resolved", &text).check() {
            Ok(again) => prop_assert_eq!(again.scene, scene),
            Err(error) => prop_assert!(false, "{}\n{}", error, text),
        }
    }
}

/// A number above zero of any usual size, with all its digits.
fn size() -> impl Strategy<Value = f64> + Clone {
    (1.0_f64..10.0, -30_i32..30).prop_map(|(digits, power)| digits * 10_f64.powi(power))
}

fn vector() -> impl Strategy<Value = DVec3> {
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
                    law,
                    soften,
                    softened_damping,
                    coarse,
                    coarse_rule,
                }
            },
        )
}

fn wall() -> impl Strategy<Value = Wall> {
    let touches_at = prop_oneof![Just(TouchesAt::Surface), Just(TouchesAt::Centre)];
    let removed = prop_oneof![
        Just(Removal::Never),
        Just(Removal::WhenStill),
        size().prop_map(Removal::At)
    ];
    let outward = vector().prop_filter_map("not zero", DVec3::try_normalize);
    let share = proptest::option::of(1e-6_f64..=1.0);
    (vector(), outward, share.clone(), share, touches_at, removed).prop_map(
        |(point, outward, restitution, friction, touches_at, removed)| {
            let shape = Shape::HalfSpace { point, outward };
            Wall {
                name: String::new(),
                shape,
                restitution,
                friction,
                touches_at,
                removed,
            }
        },
    )
}

fn time() -> impl Strategy<Value = Time> {
    let step = prop_oneof![
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
    let grain = (vector(), vector()).prop_map(|(at, velocity)| StartingGrain { at, velocity });
    let fill = (vector(), 1e-3_f64..1e3, 1e-6_f64..0.36, any::<u64>()).prop_map(
        |(min, size, solid_fraction, seed)| Fill {
            min,
            max: min + DVec3::splat(size),
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

fn scene() -> impl Strategy<Value = Scene> {
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
        .prop_map(
            |(title, gravity, grains, skin, (mut walls, initial, time, output))| {
                for (i, wall) in walls.iter_mut().enumerate() {
                    wall.name = format!("wall {i}");
                }
                let waits = walls.iter().any(|wall| wall.removed == Removal::WhenStill);
                let still = waits.then_some(Still {
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
                    still,
                    time,
                    skin,
                    output,
                }
            },
        )
}
