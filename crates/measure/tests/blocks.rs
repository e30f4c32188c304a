//! Means of series of known law, and where they become steady.

mod common;

use common::Dice;
use proptest::prelude::*;
use tsubu_measure::{Blocked, Steady};

/// Noise of mean 0 and variance 1: the sum of twelve dice less six.
fn noise(dice: &mut Dice) -> f64 {
    (0..12).map(|_| dice.next()).sum::<f64>() - 6.0
}

/// First-order autoregression of variance 1: x' = φ x + √(1 − φ²) ε, begun in its stationary state.
fn correlated(seed: u64, phi: f64, count: usize) -> Vec<f64> {
    let mut dice = Dice(seed);
    let mut x = noise(&mut dice);
    (0..count)
        .map(|_| {
            x = phi * x + (1.0 - phi * phi).sqrt() * noise(&mut dice);
            x
        })
        .collect()
}

/// Variance of the mean of n values of that series: [(1 + φ)/(1 − φ) − 2φ(1 − φⁿ)/(n(1 − φ)²)]/n.
fn variance_of_mean(phi: f64, count: usize) -> f64 {
    let n = count as f64;
    ((1.0 + phi) / (1.0 - phi)
        - 2.0 * phi * (1.0 - phi.powi(count as i32)) / (n * (1.0 - phi).powi(2)))
        / n
}

fn clock(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64).collect()
}

/// A count whose rate in look i is `rate[i]`.
fn counted(rate: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut sum = 0.0;
    let mut count = vec![0.0];
    for r in rate {
        sum += r;
        count.push(sum);
    }
    (clock(rate.len() + 1), count)
}

/// Found steady, without drift.
fn steady(values: &[f64]) -> Option<Steady> {
    Steady::of(&clock(values.len()), values).filter(|s| !s.drift)
}

#[test]
fn the_error_of_a_correlated_mean_is_that_of_the_closed_form() {
    for (phi, count) in [
        (0.0, 64),
        (0.0, 1000),
        (0.5, 1000),
        (0.9, 2000),
        (0.97, 8000),
    ] {
        let runs = 200;
        let expected = variance_of_mean(phi, count);
        let (mut said, mut was) = (0.0, 0.0);
        for seed in 0..runs {
            let found = Blocked::of(&correlated(seed, phi, count)).unwrap();
            assert!(found.blocks >= 8);
            said += found.uncertainty.unwrap().powi(2) / runs as f64;
            was += found.mean.powi(2) / runs as f64;
        }
        println!(
            "φ {phi}, n {count}: said {:.3}, was {:.3}",
            said / expected,
            was / expected
        );
        // The scatter of the means themselves is the check of the closed form: 10 % for 200 runs.
        assert!(
            (was / expected - 1.0).abs() < 0.3,
            "{phi}: {}",
            was / expected
        );
        assert!(
            (said / expected - 1.0).abs() < 0.15,
            "{phi}: {}",
            said / expected
        );
    }
}

#[test]
fn anticorrelated_pulses_cost_less_than_independent_ones() {
    // A rate that pulses once in ten looks: its mean is known far better than s/√n = 0.05 says.
    let pulses: Vec<f64> = (0..200)
        .map(|i| 5.0 + (0.2 * f64::from(i) * std::f64::consts::PI).sin())
        .collect();
    assert!(Blocked::of(&pulses).unwrap().uncertainty.unwrap() < 0.04);
}

#[test]
fn a_plateau_after_a_ramp_is_found_where_it_begins() {
    let (mut early, mut late, mut missed) = (0, 0, 0);
    for seed in 0..100 {
        let mut dice = Dice(seed);
        let rate: Vec<f64> = (0..400)
            .map(|i| (f64::from(i) / 150.0).min(1.0) * 4.0 + 0.3 * noise(&mut dice))
            .collect();
        let (time, count) = counted(&rate);
        for found in [
            Steady::of(&time[1..], &rate),
            Steady::of_count(&time, &count),
        ] {
            let Some(found) = found else {
                missed += 1;
                continue;
            };
            early += usize::from(found.from < 125.0);
            late += usize::from(found.from > 260.0);
            // Late is no harm but to the error; the mean must be that of the plateau.
            assert!(
                (found.mean - 4.0).abs() < 5.0 * 0.3 / 140f64.sqrt(),
                "{found:?}"
            );
        }
    }
    println!("early {early}, late {late}, missed {missed} of 200");
    assert!(early <= 2 && late <= 20 && missed <= 10);
}

#[test]
fn noise_is_steady_and_a_ramp_is_not() {
    let runs = 300;
    let (mut still, mut drifting) = (0, 0);
    for seed in 0..runs {
        let count = 60 + 2 * seed as usize;
        let flat: Vec<f64> = correlated(seed, 0.3, count)
            .iter()
            .map(|x| 3.0 + x)
            .collect();
        still += usize::from(steady(&flat).is_some());
        let ramp: Vec<f64> = flat
            .iter()
            .enumerate()
            .map(|(i, x)| x + 12.0 * i as f64 / count as f64)
            .collect();
        drifting += usize::from(steady(&ramp).is_none());
    }
    println!("noise steady {still}, ramp not steady {drifting} of {runs}");
    assert!(still as f64 > 0.93 * runs as f64, "{still} of {runs}");
    assert!(drifting as f64 > 0.95 * runs as f64, "{drifting} of {runs}");
    for count in [8, 20, 49, 50, 200, 1000] {
        assert_eq!(steady(&clock(count)), None, "a clean ramp of {count}");
        let (time, squares) = counted(&clock(count));
        assert!(
            Steady::of_count(&time, &squares).is_none_or(|s| s.drift),
            "{count}"
        );
    }
}

/// Rates of five periods; noise of 2 % is steady, its error holds in 68 of 100 cases, and a ramp that doubles is a drift.
#[test]
fn five_turns_know_how_little_they_know() {
    let (runs, periods) = (2000, 5);
    let time: Vec<f64> = (0..=periods).map(f64::from).collect();
    let of = |rates: &[f64]| {
        let mut mass = vec![0.0];
        mass.extend(rates.iter().scan(0.0, |sum, rate| {
            *sum += rate;
            Some(*sum)
        }));
        Steady::of_periods(&time, &mass, 1.0, 0.0).unwrap()
    };
    let (mut within, mut drift, mut seen) = (0, 0, 0);
    for seed in 0..runs {
        let flat: Vec<f64> = correlated(seed, 0.0, periods as usize)
            .iter()
            .map(|x| 3.0 + 0.06 * x)
            .collect();
        let found = of(&flat);
        within += usize::from((found.mean - 3.0).abs() < found.uncertainty);
        drift += usize::from(found.drift);
        let ramp: Vec<f64> = (1..).zip(&flat).map(|(k, x)| x * f64::from(k)).collect();
        seen += usize::from(of(&ramp).drift);
    }
    println!("within its error {within}, drift {drift}, ramp seen {seen} of {runs}");
    // Binomial: 1365 ± 21 of 2000, and 5.4 ± 2.3; five standard deviations.
    assert!((1260..1470).contains(&within), "{within}");
    assert!(drift <= 17, "{drift}");
    assert!(seen as f64 > 0.95 * runs as f64, "{seen}");
}

#[test]
fn a_plateau_of_the_last_fifth_is_too_short() {
    let values: Vec<f64> = (0..200).map(|i| f64::from(i.min(165))).collect();
    assert_eq!(steady(&values), None);
    let values: Vec<f64> = (0..200).map(|i| f64::from(i.min(100))).collect();
    assert!(steady(&values).is_some_and(|s| (s.from - 100.0).abs() <= 5.0));
}

#[test]
fn a_decay_at_the_end_is_not_steady() {
    let values: Vec<f64> = (0..200).map(|i| f64::from((200 - i).min(50))).collect();
    assert_eq!(steady(&values), None);
}

#[test]
fn short_series_say_that_they_are() {
    assert_eq!(Blocked::of(&[]), None);
    assert_eq!(Blocked::of(&[f64::NAN]), None);
    assert_eq!(
        Blocked::of(&[2.0]).map(|b| (b.mean, b.uncertainty)),
        Some((2.0, None))
    );
    assert_eq!(Blocked::of_count(&[1.0], &[1.0]), None);
    assert_eq!(Steady::of(&clock(7), &[1.0; 7]), None);
    assert_eq!(Steady::of_count(&clock(8), &clock(8)), None);
    assert!(Steady::of(&clock(8), &[1.0; 8]).is_some());
    assert_eq!(Steady::of(&[], &[]), None);
}

#[test]
fn a_rate_does_not_depend_on_when_one_looks() {
    // The same flow, looked at evenly and at odd moments; a short last look, as at the end of a run, is no outlier.
    let even = clock(101);
    let mut odd: Vec<f64> = (0..100)
        .map(|i| f64::from(i) + 0.4 * (f64::from(i) * 1.7).sin())
        .collect();
    odd[0] = 0.0;
    odd.extend([100.0 - 1e-9, 100.0]);
    for time in [even, odd] {
        let mass: Vec<f64> = time.iter().map(|t| 2.5 * (t - 20.0).max(0.0)).collect();
        let found = Steady::of_count(&time, &mass).unwrap();
        assert!(
            !found.drift && (found.from - 20.0).abs() <= 5.0 && (found.mean - 2.5).abs() < 1e-6,
            "{found:?}"
        );
    }
}

proptest! {
    #[test]
    fn a_constant_is_steady_from_the_start_with_no_error(value in -1e6..1e6f64, count in 8usize..300) {
        let found = steady(&vec![value; count]).unwrap();
        prop_assert_eq!(found.mean, value);
        prop_assert!(found.uncertainty == 0.0);
        prop_assert!(found.from < 5.0);
        // A count that grows evenly has rounding in its slopes; that is no drift and no start-up.
        let time: Vec<f64> = (0..=count).map(|i| 0.1 * i as f64).collect();
        let grown: Vec<f64> = time.iter().map(|t| value * t).collect();
        let found = Steady::of_count(&time, &grown).unwrap();
        prop_assert!(!found.drift && found.from == 0.0);
        prop_assert!((found.mean - value).abs() <= 1e-9 * value.abs());
    }

    #[test]
    fn the_unit_and_the_zero_of_the_scale_do_not_matter(
        values in prop::collection::vec(-1.0..1.0f64, 20..200), scale in 0.1..10.0f64, shift in -5.0..5.0f64,
    ) {
        let a = Blocked::of(&values).unwrap();
        let b = Blocked::of(&values.iter().map(|v| scale * v + shift).collect::<Vec<_>>()).unwrap();
        prop_assert!((b.mean - scale * a.mean - shift).abs() < 1e-9);
        prop_assert!((b.uncertainty.unwrap() / (scale * a.uncertainty.unwrap()) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn nothing_that_is_not_a_number_comes_out(
        mut values in prop::collection::vec(-1e3..1e3f64, 0..120), holes in prop::collection::vec(0usize..120, 0..9),
    ) {
        for hole in holes {
            if let Some(v) = values.get_mut(hole) {
                *v = if hole % 2 == 0 { f64::NAN } else { f64::INFINITY };
            }
        }
        let time = clock(values.len());
        for found in [Steady::of(&time, &values), Steady::of_count(&time, &values)].into_iter().flatten() {
            prop_assert!(found.mean.is_finite() && found.uncertainty.is_finite() && found.from.is_finite());
            prop_assert!(found.blocks >= 8);
        }
        if let Some(found) = Blocked::of(&values) {
            prop_assert!(found.mean.is_finite() && found.uncertainty.is_none_or(f64::is_finite));
        }
    }
}
