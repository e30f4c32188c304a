//! Which constants and readings come nearest to Meyer-Peter and Müller's relation and to measured transport.

use super::beds::{Bed, Beds, Mean, Reading};
use super::flume;
use super::transport::{SEEDS, resolved, told, with_relations};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use tsubu_picture::Figure;

/// Where the map is made, and where its best is held against both.
const COARSE: [f64; 3] = [0.2, 0.5, 1.0];
const FINE: [f64; 5] = [0.2, 0.35, 0.5, 0.7, 1.0];

const BETA: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 15.8];
const FRICTION: [f64; 2] = [0.577, 0.9];
/// Seeds of a place of the map.
const MAP_SEEDS: u64 = 1;

/// The largest factor between a set of means and the relation.
fn off_the_relation(beds: &[Bed], means: &[Mean]) -> f64 {
    let off = |(bed, mean): (&Bed, &Mean)| mean.over_theory(bed.shields).0.ln().abs();
    worst(beds.iter().zip(means).map(off))
}

/// The largest factor between a set of means and the measured 10–90 % band; 1 if all lie in it.
fn off_the_band(beds: &[Bed], means: &[Mean]) -> f64 {
    let off = |(bed, mean): (&Bed, &Mean)| {
        let [low, high] = flume::band(bed.shields).unwrap_or([f64::NAN; 2]);
        (low / mean.transport)
            .ln()
            .max((mean.transport / high).ln())
            .max(0.0)
    };
    worst(beds.iter().zip(means).map(off))
}

/// e to the largest; infinite if one is no number.
fn worst(logs: impl Iterator<Item = f64>) -> f64 {
    logs.map(|x| if x.is_nan() { f64::INFINITY } else { x })
        .fold(0.0, f64::max)
        .exp()
}

/// The map, its best place in the plane and in space.
pub fn run(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let readings = [
        ("no_pull", Reading::NoPull, false),
        ("as_printed", Reading::AsPrinted, false),
        ("no_pull, datum frozen", Reading::NoPull, true),
    ];
    let mut figure = Figure::new(
        "How far transport is from Meyer-Peter & Müller's over τ* = 0.2–1 (plane bed, converged)",
        "β (–)",
        "largest factor between the two (–)",
    )
    .log_x()
    .log_y()
    .theory("aim: a factor of 1.5", &[1.0, 15.8], &[1.5, 1.5]);
    let mut best = (f64::INFINITY, Bed::of(0.5), String::new());
    for (name, reading, frozen_datum) in readings {
        for friction in FRICTION {
            let mut factors = Vec::new();
            for beta in BETA {
                let place = COARSE.map(|shields| Bed {
                    beta,
                    friction,
                    reading,
                    frozen_datum,
                    ..Bed::of(shields)
                });
                let means = beds.means(&place, MAP_SEEDS)?;
                let (factor, band) = (
                    off_the_relation(&place, &means),
                    off_the_band(&place, &means),
                );
                let name = format!("{name}, μ = {friction}, β = {beta}");
                report.tell(
                    format!("map, {name}: largest factor to Meyer-Peter and Müller's"),
                    factor,
                    &format!("τ* = 0.2, 0.5, 1, one seed; {band:.2} to the measured 10–90 % band"),
                );
                if factor < best.0 {
                    best = (factor, place[1], name);
                }
                factors.push(factor);
            }
            figure = figure.points(&format!("{name}, μ = {friction}"), &BETA, &factors, None);
        }
        report.progress(&format!("map, {name}"));
    }
    report.figure("bedload_map", figure)?;
    let (_, best, name) = best;
    let mut figure = with_relations(Figure::new(
        "The constants nearest to Meyer-Peter & Müller's relation, in the plane and in space",
        "Shields number τ* (–)",
        "transport qB* (–)",
    ));
    for (place, in_space, seeds) in [("plane", false, SEEDS), ("space", true, 1)] {
        for (name, bed) in [
            (name.as_str(), best),
            ("the shipped constants", Bed::of(0.5)),
        ] {
            let shields: &[f64] = if in_space { &COARSE } else { &FINE };
            let all: Vec<Bed> = shields
                .iter()
                .map(|&shields| Bed {
                    shields,
                    in_space,
                    ..bed
                })
                .collect();
            let means = beds.means(&all, seeds)?;
            let name = format!("{place}, {name}");
            told(report, &name, &all, &means);
            resolved(report, &name, &means);
            report.tell(
                format!("{name}: largest factor to Meyer-Peter and Müller's"),
                off_the_relation(&all, &means),
                &format!(
                    "aim: 1.5; {:.2} to the measured 10–90 % band",
                    off_the_band(&all, &means)
                ),
            );
            let (y, e): (Vec<f64>, Vec<f64>) = means.iter().map(|m| (m.transport, m.error)).unzip();
            figure = figure.points(&name, shields, &y, Some(&e));
        }
        report.progress(&format!("nearest, {place}"));
    }
    report.figure("bedload_nearest", figure)?;
    // What the map says is nearest is nearer than what the paper chose.
    let of = |bed: Bed| -> Result<f64, String> {
        let all = FINE.map(|shields| Bed { shields, ..bed });
        Ok(off_the_relation(&all, &beds.means(&all, SEEDS)?))
    };
    report.check(
        "nearest constants: their factor to the relation over that of the shipped ones",
        1.0,
        of(best)? / of(Bed::of(0.5))?,
        Tolerance::AtMost,
        "on more Shields numbers and seeds than the map chose them by",
    );
    Ok(())
}
