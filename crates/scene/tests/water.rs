//! Every field of grains of springs and dashpots, of their beds and of the water over them.

use tsubu_scene::*;

const SCENE: &str = r#"(
    title: "T",
    space: Plane,
    grains: (
        diameter: "0.5 mm",
        density: "2650 kg/m3",
        law: SpringDashpot(constants: FromTimeStep(step: "20 us", tn: 20, cn: 1.3), friction: 0.577),
    ),
    domain: (x: Periodic("20 mm")),
    initial: (bed: (layers: 10)),
    water: (shields: 0.5, begins: "0.4 s"),
    time: (step: PerPeriod(20), until: "1 s"),
)"#;

fn with(overrides: &[&str]) -> Result<Scene, SceneError> {
    let mut source = Source::from_text("bed.ron", SCENE);
    for spec in overrides {
        source.set(spec)?;
    }
    source.check().map(|checked| checked.scene)
}

/// A scene that is good, and that reads back from its resolved text.
fn good(overrides: &[&str]) -> Scene {
    let scene = with(overrides).unwrap_or_else(|error| panic!("{overrides:?}:\n{error}"));
    let resolved = scene.to_resolved_ron();
    let again = Source::from_text("resolved", &resolved)
        .check()
        .unwrap_or_else(|error| panic!("{error}\n{resolved}"))
        .scene;
    assert_eq!(again, scene);
    assert_eq!(again.to_resolved_ron(), resolved);
    scene
}

fn water(overrides: &[&str]) -> Water {
    good(overrides).water.expect("there is water")
}

fn law(overrides: &[&str]) -> SpringDashpot {
    match good(overrides).grains.law {
        Law::SpringDashpot(law) => law,
        other => panic!("another law: {other:?}"),
    }
}

#[test]
fn what_is_left_out_has_its_default() {
    let scene = good(&[]);
    let usual = SpringDashpot {
        constants: SpringConstants::FromTimeStep {
            step: 2e-5,
            tn: 20.0,
            cn: 1.3,
            beta: 1.0,
        },
        poisson: 0.3,
        friction: 0.577,
        tension: Tension::NoPull,
        slip: Slip::Total,
        normal_force: NormalForce::Closed,
    };
    assert_eq!(scene.grains.law, Law::SpringDashpot(usual));
    assert_eq!(scene.grains.populations, []);
    let bed = Bed {
        layers: 10,
        spacing: 1.07,
        vacancies: 0.1,
        roughness: 1.0 / 3.0,
        seed: 1,
    };
    assert_eq!(scene.initial, Initial::Bed(bed));
    let water = Water {
        flow: Flow::Shields(0.5),
        begins: 0.4,
        density: 1000.0,
        added_mass: 0.5,
        drag: 0.4,
        profile: FlowProfile::Log { karman: 0.4 },
        turbulence: Turbulence::Switched {
            frequency: 50.0,
            depth: 0.2,
            seed: 1,
        },
        shelter: 0.4,
        datum: Datum::Renewed,
        bed_contacts: 2,
        slope: 0.0,
        drag_by_volume: false,
    };
    assert_eq!(scene.water, Some(water));
    assert_eq!(scene.measures.bed, Some(BedMeasure { skip: 0.25 }));
    assert_eq!(good(&["water=None"]).measures.bed, None);
    // The words of the defaults are those of the types.
    let readings = (Tension::default(), Slip::default(), NormalForce::default());
    assert_eq!(readings, (usual.tension, usual.slip, usual.normal_force));
    assert_eq!(Datum::default(), Datum::Renewed);
}

#[test]
fn constants_are_what_is_written() {
    let beta = law(&["grains.law.constants.beta=15.8"]).constants;
    assert!(matches!(beta, SpringConstants::FromTimeStep { beta, .. } if beta == 15.8));
    let given =
        r#"grains.law.constants=Given(normal_stiffness: "0.2 N/m", normal_damping: "0.46 g/s")"#;
    let normal_only = SpringConstants::Given {
        normal_stiffness: 0.2,
        normal_damping: 4.6e-4,
        tangential_stiffness: None,
        tangential_damping: None,
    };
    assert_eq!(law(&[given]).constants, normal_only);
    let across = "grains.law.constants.tangential_stiffness=98 mN/m";
    assert_eq!(law(&[given, across, "grains.law.poisson=0"]).poisson, 0.0);
    let all = [
        given,
        across,
        "grains.law.constants.tangential_damping=0 kg/s",
    ];
    let all_given = SpringConstants::Given {
        normal_stiffness: 0.2,
        normal_damping: 4.6e-4,
        tangential_stiffness: Some(0.098),
        tangential_damping: Some(0.0),
    };
    assert_eq!(law(&all).constants, all_given);
    let rebound =
        r#"grains.law.constants=FromRestitution(normal_stiffness: "1 kN/m", restitution: 0.5)"#;
    let from_restitution = SpringConstants::FromRestitution {
        normal_stiffness: 1000.0,
        restitution: 0.5,
    };
    assert_eq!(law(&[rebound]).constants, from_restitution);
}

#[test]
fn readings_are_set_by_name() {
    let law = law(&[
        "grains.law.tension=AsPrinted",
        "grains.law.slip=AsPrinted",
        "grains.law.normal_force=Incremental",
        "grains.law.poisson=0.5",
        "grains.law.friction=0",
    ]);
    let readings = (law.tension, law.slip, law.normal_force);
    let expected = (
        Tension::AsPrinted,
        Slip::AsPrinted,
        NormalForce::Incremental,
    );
    assert_eq!(readings, expected);
    assert_eq!((law.poisson, law.friction), (0.5, 0.0));
}

#[test]
fn plain_schemes_turn_grains() {
    for (name, integrator) in [
        ("ExplicitEuler", Integrator::ExplicitEuler),
        ("SymplecticEuler", Integrator::SymplecticEuler),
        ("VerletOld", Integrator::VerletOld),
    ] {
        let scene = good(&[&format!("time.integrator={name}")]);
        assert_eq!(scene.time.integrator, integrator);
    }
    assert!(!good(&["output.energies=false"]).output.energies);
}

#[test]
fn walls_may_leave_their_constants_to_the_grains() {
    let scene = good(&[
        r#"walls=[(name: "lid", shape: HalfSpace(point: ("0 m", "0 m", "1 m"), outward: (0, 0, -1)))]"#,
    ]);
    assert_eq!(scene.walls[0].restitution, None);
    assert_eq!(scene.walls[0].friction, None);
    let wrong = "walls.lid.restitution=2";
    let mut source = Source::from_text("resolved", &scene.to_resolved_ron());
    source.set(wrong).expect("in form");
    let error = source.check().expect_err("out of range").to_string();
    assert!(error.contains("the grains' own damping"), "{error}");
}

#[test]
fn sizes_keep_their_order_and_the_mass_of_the_largest() {
    let sizes = r#"grains.populations=[(diameter: "0.3 mm", share: 0.25), (diameter: "0.5 mm", share: 0.75)]"#;
    let dry = ["water=None", sizes];
    let grains = good(&dry).grains;
    let expected = [
        Population {
            diameter: 3e-4,
            density: grains.density(),
            share: 0.25,
            material: 0,
        },
        Population {
            diameter: 5e-4,
            density: grains.density(),
            share: 0.75,
            material: 0,
        },
    ];
    assert_eq!(grains.populations, expected);
    assert_eq!(grains.mass, good(&["water=None"]).grains.mass);
    // A millionth of the mass may be lost to rounding, and no more.
    let third = r#"(diameter: "0.3 mm", share: 0.3333333), (diameter: "0.4 mm", share: 0.3333333), (diameter: "0.5 mm", share: "#;
    assert_eq!(
        good(&[&format!("grains.populations=[{third}0.3333333)]")])
            .grains
            .populations
            .len(),
        3
    );
    assert!(with(&[&format!("grains.populations=[{third}0.3333)]")]).is_err());
}

#[test]
fn a_density_is_written_for_sizes_that_gives_the_mass_to_the_bit() {
    for i in 0..2000 {
        let density = format!("grains.density={} kg/m3", 1000.0 + 1.2345678 * f64::from(i));
        let diameter = format!("{} um", 300.0 + 0.7654321 * f64::from(i));
        let sizes = format!("grains.populations=[(diameter: \"{diameter}\", share: 1)]");
        let diameter = format!("grains.diameter={diameter}");
        good(&["water=None", &density, &diameter, &sizes]);
    }
}

#[test]
fn the_bed_takes_the_place_of_another_start() {
    let bed = "initial.bed=(layers: 2, spacing: 1, vacancies: 0, roughness: 0, seed: 9)";
    let listed = r#"initial.grains=[(at: ("1 mm", "0 mm", "1 mm"))]"#;
    let dry = [listed, "water=None"];
    assert!(matches!(good(&dry).initial, Initial::Grains(_)));
    let scene = good(&[listed, bed]);
    let expected = Bed {
        layers: 2,
        spacing: 1.0,
        vacancies: 0.0,
        roughness: 0.0,
        seed: 9,
    };
    assert_eq!(scene.initial, Initial::Bed(expected));
    let edges = ["initial.bed=(layers: 1, spacing: 2, vacancies: 0.5, roughness: 1)"];
    assert!(with(&edges).is_ok());
    let mut source = Source::from_text("bed.ron", SCENE);
    source.set("initial.bed.layers=20").expect("a field");
    let grains = source.check().and_then(|checked| checked.starting_grains());
    assert_eq!(grains.expect("a bed is laid later"), None);
}

#[test]
fn in_space_a_bed_that_says_nothing_of_y_is_six_columns_wide() {
    let y = r#"domain.y=Periodic("5 mm")"#;
    assert_eq!(good(&["space=Space", y]).domain.y, Axis::Periodic(5e-3));
    let scene = good(&["space=Space", "initial.bed.spacing=1.1"]);
    let Axis::Periodic(width) = scene.domain.y else {
        panic!("{:?}", scene.domain)
    };
    assert!((width / (6.0 * 1.1 * scene.grains.diameter) - 1.0).abs() < 1e-12);
    assert!(with(&["space=Space", "domain.y=Open"]).is_err());
}

#[test]
fn the_way_to_give_the_strength_that_is_set_last_is_taken() {
    assert_eq!(water(&["water.shields=0.1"]).flow, Flow::Shields(0.1));
    let speed = "water.friction_velocity=6 cm/s";
    assert_eq!(water(&[speed]).flow, Flow::FrictionVelocity(0.06));
    let rows = r#"water.friction_velocity_over_time=[("0 s", "0 m/s"), ["1 s", "0.06 m/s"]]"#;
    let over_time = Flow::OverTime(vec![[0.0, 0.0], [1.0, 0.06]]);
    assert_eq!(water(&[speed, rows]).flow, over_time);
    let set_in_a_row = [rows, "water.friction_velocity_over_time[1][0]=2 s"];
    let later = Flow::OverTime(vec![[0.0, 0.0], [2.0, 0.06]]);
    assert_eq!(water(&set_in_a_row).flow, later);
    let shields = ["water.shields=0.2"];
    assert_eq!(
        water(&[&[rows], &shields[..]].concat()).flow,
        Flow::Shields(0.2)
    );
}

#[test]
fn each_field_of_the_water_can_be_set() {
    let set = water(&[
        "water.begins=0.3 s",
        "water.density=1.03 g/cm3",
        "water.added_mass=0",
        "water.drag=1.2",
        r#"water.profile=[("-1 mm", "0 m/s"), ("2 mm", "40 cm/s")]"#,
        "water.turbulence=Off",
        "water.shelter=1",
        "water.bed_contacts=0",
        "water.slope=-0.02",
    ]);
    let expected = Water {
        flow: Flow::Shields(0.5),
        begins: 0.3,
        density: 1030.0,
        added_mass: 0.0,
        drag: 1.2,
        profile: FlowProfile::Given(vec![[-0.001, 0.0], [0.002, 0.4]]),
        turbulence: Turbulence::Off,
        shelter: 1.0,
        datum: Datum::Renewed,
        bed_contacts: 0,
        slope: -0.02,
        drag_by_volume: false,
    };
    assert_eq!(set, expected);
    let karman = water(&["water.karman=0.41"]).profile;
    assert_eq!(karman, FlowProfile::Log { karman: 0.41 });
    let seeded = water(&[
        "water.turbulence=Switched(seed: 7)",
        "water.turbulence.depth=10 cm",
    ]);
    let expected = Turbulence::Switched {
        frequency: 50.0,
        depth: 0.1,
        seed: 7,
    };
    assert_eq!(seeded.turbulence, expected);
    let frozen = water(&["water.datum=Frozen", "water.bed_contacts=12"]);
    assert_eq!((frozen.datum, frozen.bed_contacts), (Datum::Frozen, 12));
    let given = water(&[r#"water.datum=Given("5 mm")"#]);
    assert_eq!((given.datum, given.bed_contacts), (Datum::Given(0.005), 2));
}

#[test]
fn coarse_grains_name_their_drag() {
    let rule = "water.coarse_drag=ByVolume";
    assert!(water(&["grains.coarse=2", rule]).drag_by_volume);
    let error = with(&["grains.coarse=2"]).expect_err("no rule");
    assert_eq!(error.line_column(), Some((1, 15)), "{error}");
}

#[test]
fn the_transport_is_measured_where_there_is_water() {
    let skip = |overrides: &[&str]| good(overrides).measures.bed.map(|bed| bed.skip);
    assert_eq!(skip(&["measures.bed.skip=0"]), Some(0.0));
    assert_eq!(skip(&["measures.bed=()"]), Some(0.25));
    assert_eq!(skip(&["measures=()"]), Some(0.25));
    assert!(with(&["water=None", "measures.bed=()"]).is_err());
}

/// Paper B lets ten layers of 0.5 mm fall for 0.4 s.
#[test]
fn water_that_finds_its_bed_waits_until_there_is_one() {
    let now = "water.begins=0 s";
    let error = with(&[now]).expect_err("no bed at the start").to_string();
    for words in ["find no bed", "begins: \"400 ms\"", "datum: Given"] {
        assert!(error.contains(words), "{error}");
    }
    assert!(with(&[now, "water.datum=Frozen"]).is_err());
    assert_eq!(water(&[now, r#"water.datum=Given("3 mm")"#]).begins, 0.0);
    // Every grain counts as bed then, contacts or not.
    assert_eq!(water(&[now, "water.bed_contacts=0"]).begins, 0.0);
    assert_eq!(water(&["water.begins=1 us"]).begins, 1e-6);
}
