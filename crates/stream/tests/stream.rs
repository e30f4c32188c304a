//! The stream over a run: when the datum is found, what is saved, and what is refused.

use glam::DVec2;
use tsubu_model::Plane;
use tsubu_stream::{
    Bed, Datum, Grains, LogLaw, NoBed, Profile, Sediment, Setting, Stream, Table, TransportCurve,
    Turbulence, Water, bed_load_rate,
};

const D: f64 = 1e-3;

fn setting(datum: Datum) -> Setting {
    Setting {
        datum,
        ..Setting::over_grains(D, 0.1, 3)
    }
}

/// A level bed at this height, with one grain leaping ten diameters above it.
fn bed(height: f64) -> impl Iterator<Item = (f64, u32)> + Clone {
    [
        (height, 3),
        (height, 2),
        (height + 10.0 * D, 0),
        (height + 9.0 * D, 1),
    ]
    .into_iter()
}

/// Renewed at switches, 20 ms apart, and only there; kept while every grain is up in the water.
#[test]
fn a_renewed_datum_follows_the_bed_at_switches() {
    let mut stream = Stream::new(setting(Datum::Renewed)).unwrap();
    assert_eq!(stream.renew(0.0, bed(0.0)), Ok(true));
    assert_eq!(stream.renew(0.019, bed(1.0)), Ok(false));
    assert_eq!(stream.bed().level, Some(0.0));
    assert!(!stream.is_due(0.019) && stream.is_due(0.020));
    assert_eq!(stream.renew(0.021, bed(1.0)), Ok(true));
    assert_eq!(stream.bed().level, Some(1.0));
    // All grains leap: the datum stays, and is looked for again at the next switch.
    assert_eq!(stream.renew(0.041, [(5.0, 0)].into_iter()), Ok(false));
    assert_eq!(stream.bed().level, Some(1.0));
    assert!(!stream.is_due(0.059) && stream.is_due(0.061));
}

/// With 0 contacts every grain counts, and the one that leaps ten diameters up, alone with the other, is the bed.
#[test]
fn contacts_keep_leaping_grains_out_of_the_bed() {
    let level = |bed_contacts: u32| {
        let mut stream = Stream::new(Setting {
            bed_contacts,
            ..setting(Datum::Frozen)
        })
        .unwrap();
        stream.renew(0.0, bed(0.0)).unwrap();
        stream.bed().level.unwrap()
    };
    assert_eq!(level(2), 0.0);
    assert!((level(0) - 9.5 * D).abs() < 1e-15);
}

#[test]
fn a_frozen_datum_stays_and_a_given_one_needs_no_grains() {
    let mut frozen = Stream::new(setting(Datum::Frozen)).unwrap();
    assert_eq!(frozen.renew(0.0, bed(0.5)), Ok(true));
    assert_eq!(frozen.renew(7.0, bed(1.0)), Ok(false));
    assert_eq!(frozen.bed().level, Some(0.5));

    let mut given = Stream::new(setting(Datum::Given(0.25))).unwrap();
    assert!(!given.is_due(0.0));
    assert_eq!(given.renew(0.0, bed(1.0)), Ok(false));
    assert_eq!(given.bed().level, Some(0.25));
}

/// Without a bed there is no water: an error that says what to do, and no force.
#[test]
fn water_without_a_bed_is_refused_and_pushes_nothing() {
    let mut stream = Stream::new(setting(Datum::Renewed)).unwrap();
    let refused = stream.renew(0.0, [(0.0, 1)].into_iter()).unwrap_err();
    assert_eq!(refused, NoBed { contacts: 2 });
    assert!(
        refused.to_string().contains("let the grains settle"),
        "{refused}"
    );
    assert!(stream.at(0.0).is_none());
    assert_eq!(force(&stream, 0.0), DVec2::ZERO);
}

/// The force on one grain that lies one diameter above y = 0.
fn force(stream: &Stream, time: f64) -> DVec2 {
    let mut force = [DVec2::ZERO];
    let grains = Grains::<Plane> {
        position: &[DVec2::new(0.0, D)],
        velocity: &[DVec2::ZERO],
        identity: &[4],
        diameter: &[D],
    };
    stream.push(time, grains, &mut force).unwrap();
    force[0]
}

/// `Bed` is all the state there is: a new stream with the saved one does the same, to the bit.
#[test]
fn a_restored_stream_goes_on_as_before() {
    let mut stream = Stream::new(setting(Datum::Renewed)).unwrap();
    stream.renew(0.105, bed(-0.2 * D)).unwrap();
    let saved: Bed = stream.bed();
    let mut other = Stream::new(setting(Datum::Renewed)).unwrap();
    other.restore(saved);
    for time in [0.107, 0.119, 0.121, 0.5] {
        let due = stream.is_due(time);
        assert_eq!(due, other.is_due(time));
        assert_eq!(
            stream.renew(time, bed(-0.1 * D)),
            other.renew(time, bed(-0.1 * D))
        );
        assert_eq!(force(&stream, time), force(&other, time));
        assert_ne!(force(&stream, time), DVec2::ZERO);
    }
}

/// u* over time drives mean flow and gusts alike: force on a grain at rest goes with u*². Four roundings: 1e-14.
#[test]
fn the_force_goes_with_the_square_of_a_changing_friction_velocity() {
    let flood = Table::new(vec![[0.0, 0.1], [0.02, 0.3]]).unwrap();
    let steady = Stream::new(setting(Datum::Given(0.0))).unwrap();
    let rising = Stream::new(Setting {
        friction_velocity: flood,
        ..setting(Datum::Given(0.0))
    })
    .unwrap();
    for (time, factor) in [(0.0, 1.0), (0.01, 4.0), (0.0199999999, 9.0)] {
        let (one, other) = (force(&steady, time) * factor, force(&rising, time));
        assert!(
            (one - other).length() < 1e-7 * one.length(),
            "{one} {other}"
        );
    }
}

/// push adds to what is there.
#[test]
fn push_adds_and_refuses_unequal_slices() {
    let stream = Stream::new(setting(Datum::Given(0.0))).unwrap();
    let mut force = [DVec2::new(1.0, 2.0)];
    let grains = Grains::<Plane> {
        position: &[DVec2::new(0.0, D)],
        velocity: &[DVec2::ZERO],
        identity: &[4],
        diameter: &[D],
    };
    stream.push(0.0, grains, &mut force).unwrap();
    assert_eq!(force[0], DVec2::new(1.0, 2.0) + self::force(&stream, 0.0));
    let short = Grains {
        identity: &[],
        ..grains
    };
    let refused = stream.push(0.0, short, &mut force).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the number of identities is 0: give 1, one for each force"
    );
}

/// Every number that water cannot have, with the words that name it.
#[test]
fn unphysical_numbers_are_refused_by_name() {
    type Damage = fn(&mut Setting);
    let broken: [(&str, Damage); 17] = [
        ("density of the water is 0", |s| s.water.density = 0.0),
        ("density of the water is NaN", |s| {
            s.water.density = f64::NAN
        }),
        ("gravity is -9.8", |s| s.water.gravity = -9.8),
        ("drag coefficient is -1", |s| s.water.drag = -1.0),
        ("added-mass coefficient is -0.5", |s| {
            s.water.added_mass = -0.5
        }),
        ("roughness is 0", |s| {
            s.profile = Profile::Log(LogLaw::over_grains(0.0))
        }),
        ("Kármán constant is -0.4", |s| {
            s.profile = Profile::Log(LogLaw {
                karman: -0.4,
                ..LogLaw::over_grains(D)
            })
        }),
        ("offset of the logarithm is inf", |s| {
            s.profile = Profile::Log(LogLaw {
                offset: f64::INFINITY,
                ..LogLaw::over_grains(D)
            })
        }),
        ("friction velocity is -0.1", |s| {
            s.friction_velocity = Table::constant(-0.1)
        }),
        ("intensity along the flow is -2.3", |s| {
            s.turbulence.along = -2.3
        }),
        ("intensity across the flow is NaN", |s| {
            s.turbulence.across = f64::NAN
        }),
        ("depth of the water is 0", |s| s.turbulence.depth = 0.0),
        ("frequency of the switches is 0", |s| {
            s.turbulence.frequency = 0.0
        }),
        ("shelter's floor is 1.5", |s| s.shelter.floor = 1.5),
        ("shelter's roughness is -1", |s| s.shelter.roughness = -1.0),
        ("diameter of the largest grain is 0", |s| {
            s.largest_diameter = 0.0
        }),
        ("height of the bed is NaN", |s| {
            s.datum = Datum::Given(f64::NAN)
        }),
    ];
    for (words, damage) in broken {
        let mut setting = setting(Datum::Renewed);
        damage(&mut setting);
        let refused = Stream::new(setting).unwrap_err().to_string();
        assert!(
            refused.contains(words) && refused.contains(": give "),
            "{refused} / {words}"
        );
    }
    let water = Water::fresh();
    let sand = Sediment::quartz(D);
    let floating = Sediment {
        density: 900.0,
        ..sand
    };
    let flat = Sediment {
        diameter: 0.0,
        ..sand
    };
    for refused in [
        water.grain(&flat).map(|_| 0.0),
        water.grain(&floating).map(|_| 0.0),
        water.shields(&floating, 0.1),
        water.shields(&sand, -0.1),
        water.friction_velocity(&sand, -0.1),
        water.friction_velocity_of_slope(0.2, -1e-3),
        water.transport(&flat, 1.0),
        bed_load_rate([(D, 1.0)].into_iter(), 0.0, D),
        TransportCurve::WONG_PARKER.transport(-0.1),
        TransportCurve::WONG_PARKER.transport(f64::NAN),
        Profile::measured(&[[0.0, 1.0]], 0.0).map(|_| 0.0),
        Profile::measured(&[[0.0, -1.0]], 0.1).map(|_| 0.0),
        Table::new(vec![]).map(|_| 0.0),
        Table::new(vec![[0.0, 1.0], [0.0, 2.0]]).map(|_| 0.0),
        Table::new(vec![[0.0, f64::NAN]]).map(|_| 0.0),
        Stream::new(setting(Datum::Renewed)).and_then(|s| s.threshold(D, -1.0)),
    ] {
        let words = refused.unwrap_err().to_string();
        assert!(words.contains(": give "), "{words}");
    }
    // No flow and no turbulence is water too.
    let still = Setting {
        friction_velocity: Table::constant(0.0),
        turbulence: Turbulence::none(),
        ..setting(Datum::Given(0.0))
    };
    assert_eq!(force(&Stream::new(still).unwrap(), 0.0), DVec2::ZERO);
}
