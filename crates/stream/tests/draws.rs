//! The random velocities: their distribution, and that nothing but seed, identity and switch decides them.

use glam::{DVec2, DVec3};
use tsubu_model::{Plane, Space};
use tsubu_stream::{Datum, Draw, Grains, Setting, Stream, Turbulence};

/// Unit normal deviates along, up and across.
fn unit(seed: u64) -> Turbulence {
    Turbulence {
        along: 1.0,
        up: 1.0,
        across: 1.0,
        ..Turbulence::open_channel(seed)
    }
}

/// Mean 0, variance 1, skewness 0, kurtosis 3, 5 % beyond 1.95996, and no correlation between components, grains or
/// switches. Bounds: five standard errors of each for n = 200 000 independent normal deviates.
#[test]
fn deviates_are_normal_and_independent() {
    let n = 200_000u32;
    let error = |variance: f64| 5.0 * (variance / f64::from(n)).sqrt();
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / f64::from(n);
    let water = unit(2001);
    for by_switch in [false, true] {
        let draws: Vec<[f64; 3]> = (0..n)
            .map(|i| {
                if by_switch {
                    water.fluctuations(7, u64::from(i))
                } else {
                    water.fluctuations(i, 7)
                }
            })
            .collect();
        for axis in 0..3 {
            let moment = |power: i32| mean(&mut draws.iter().map(|draw| draw[axis].powi(power)));
            // Variances of x, x², x³, x⁴ of a normal x: 1, 2, 15, 96.
            assert!(moment(1).abs() < error(1.0), "{}", moment(1));
            assert!((moment(2) - 1.0).abs() < error(2.0), "{}", moment(2));
            assert!(moment(3).abs() < error(15.0), "{}", moment(3));
            assert!((moment(4) - 3.0).abs() < error(96.0), "{}", moment(4));
            let beyond = mean(
                &mut draws
                    .iter()
                    .map(|draw| f64::from(draw[axis].abs() > 1.95996)),
            );
            assert!((beyond - 0.05).abs() < error(0.05 * 0.95), "{beyond}");
            let other = (axis + 1) % 3;
            let between = mean(&mut draws.iter().map(|draw| draw[axis] * draw[other]));
            assert!(between.abs() < error(1.0), "{between}");
            let next = mean(&mut draws.windows(2).map(|w| w[0][axis] * w[1][axis]));
            assert!(next.abs() < error(1.0), "{next}");
        }
    }
}

/// Intensities at the bed are 2.30 u* and 1.27 u*: the rms of what the stream itself gives, within five standard
/// errors of an rms, 1/√(2n).
#[test]
fn the_stream_has_the_printed_intensities() {
    let (n, u, d) = (100_000u32, 0.05, 0.5e-3);
    let setting = Setting {
        datum: Datum::Given(0.0),
        ..Setting::over_grains(d, u, 5)
    };
    let stream = Stream::new(setting).unwrap();
    let current = stream.at(1.0).unwrap();
    let mean = u * 5.045577026587349;
    let sum = (0..n).fold(DVec2::ZERO, |sum, i| {
        let gust = current.velocity::<Plane>(DVec2::ZERO, i) - DVec2::new(mean, 0.0);
        sum + gust * gust
    });
    let rms = [sum.x, sum.y].map(|sum| (sum / f64::from(n)).sqrt() / u);
    let share = 5.0 / (2.0 * f64::from(n)).sqrt();
    assert!((rms[0] / 2.30 - 1.0).abs() < share, "{rms:?}");
    assert!((rms[1] / 1.27 - 1.0).abs() < share, "{rms:?}");
}

/// Order, slices and threads do not matter: forwards, backwards and one by one give the same bits, and a plane
/// stream is the space stream without its level axis.
#[test]
fn the_order_of_asking_does_not_matter() {
    let (n, d) = (300usize, 1e-3);
    let setting = Setting {
        datum: Datum::Given(0.2e-3),
        ..Setting::over_grains(d, 0.1, 99)
    };
    let stream = Stream::new(setting).unwrap();
    let mut position: Vec<DVec2> = (0..n)
        .map(|i| DVec2::new(i as f64, (i as f64 / 50.0 - 1.0) * d))
        .collect();
    let mut identity: Vec<u32> = (0..n as u32).map(|i| i * 977).collect();
    let (velocity, diameter) = (vec![DVec2::new(0.1, -0.02); n], vec![d; n]);
    let push = |position: &[DVec2], identity: &[u32]| {
        let mut force = vec![DVec2::ZERO; position.len()];
        let grains = Grains::<Plane> {
            position,
            velocity: &velocity,
            identity,
            diameter: &diameter,
        };
        stream.push(0.123, grains, &mut force).unwrap();
        force
    };
    let forwards = push(&position, &identity);
    let current = stream.at(0.123).unwrap();
    for i in 0..n {
        let alone = current.force::<Plane>(position[i], velocity[i], identity[i], d);
        assert_eq!(alone, forwards[i]);
        let (x, v) = (position[i], velocity[i]);
        let (x, v) = (DVec3::new(x.x, 0.0, x.y), DVec3::new(v.x, 0.0, v.y));
        let space = current.force::<Space>(x, v, identity[i], d);
        assert_eq!((space.x, space.y, space.z), (alone.x, 0.0, alone.y));
    }
    position.reverse();
    identity.reverse();
    let mut backwards = push(&position, &identity);
    backwards.reverse();
    assert_eq!(forwards, backwards);
}

/// Seeds, grains and switches differ; a shared draw is the same for all grains and still changes at switches.
#[test]
fn who_shares_a_draw() {
    let own = unit(1);
    assert_ne!(own.fluctuations(1, 1), unit(2).fluctuations(1, 1));
    assert_ne!(own.fluctuations(1, 1), own.fluctuations(2, 1));
    let shared = Turbulence {
        draw: Draw::Together,
        ..own
    };
    assert_eq!(shared.fluctuations(1, 1), shared.fluctuations(u32::MAX, 1));
    assert_ne!(shared.fluctuations(1, 1), shared.fluctuations(1, 2));
    assert_eq!(Turbulence::none().fluctuations(1, 1), [0.0; 3]);
}

/// Switch k begins at k/50 s, whether that time was multiplied or summed up over steps: 100 steps of 0.2 ms are one.
#[test]
fn switches_come_at_their_frequency() {
    let water = unit(1);
    for k in 0..10_000u64 {
        assert_eq!(water.switch(k as f64 / 50.0), k);
        assert_eq!(water.switch((100 * k) as f64 * 2.0e-4), k);
        assert_eq!(water.switch((k as f64 + 0.999) / 50.0), k);
    }
    assert_eq!(water.switch(-1.0), 0);
}
