//! Which step a bed bears (paper B's fig. 11): three diameters and three depths, constants of 20 µs.

use super::beds::{Bed, Beds, meyer_peter_mueller};
use super::knobs::fine_step;
use super::transport::PAPERS_STEP;
use crate::validate::report::Report;
use rayon::prelude::*;
use tsubu_picture::Figure;

const DIAMETERS: [f64; 3] = [0.2, 0.5, 2.0];
const LAYERS: [u32; 3] = [10, 20, 30];
/// Steps in µs at which transport is measured besides the fine one, and the Shields number.
const STEPS: [f64; 4] = [6.0, 12.0, PAPERS_STEP, 40.0];
const SHIELDS: f64 = 0.5;
const SEEDS: u64 = 2;

/// What steps one bed bears, in µs.
struct Steps {
    /// λmax = 4 for the packing as it lay when the water began.
    theory: f64,
    /// The largest at which the bed came to rest.
    rests: f64,
    /// The largest at which transport is within 10 % or two standard errors of that at the fine step.
    accurate: f64,
    /// Where transport meets Meyer-Peter and Müller's relation; NaN if nowhere between the fine step and the largest.
    matches: f64,
}

/// Root mean square speed over √(g d) below which a bed is at rest: one that creeps is slower, one that boils faster.
const RESTS: f64 = 0.01;

fn steps(beds: &Beds<'_>, diameter: f64, layers: u32) -> Result<(Steps, Vec<(f64, f64)>), String> {
    let fine = Bed {
        diameter,
        layers,
        step: fine_step(diameter, layers),
        ..Bed::of(SHIELDS)
    };
    let mut all = vec![fine];
    all.extend(STEPS.map(|step| Bed { step, ..fine }));
    let means = beds.means(&all, SEEDS)?;
    let theory = fine.step / means[0].over_limit;
    let (reference, reference_error) = (means[0].transport, means[0].error);
    let close = |k: usize| {
        let (off, error) = (
            (means[k].transport - reference).abs(),
            means[k].error.hypot(reference_error),
        );
        off <= (0.1 * reference).max(2.0 * error)
    };
    let accurate = (0..all.len())
        .take_while(|&k| close(k))
        .last()
        .map_or(f64::NAN, |k| all[k].step);
    let ratio: Vec<f64> = means
        .iter()
        .map(|m| m.transport / meyer_peter_mueller(SHIELDS))
        .collect();
    let crossing = (1..all.len()).find(|&k| (ratio[k - 1] - 1.0) * (ratio[k] - 1.0) <= 0.0);
    let matches = crossing.map_or(f64::NAN, |k| {
        let share = ratio[k - 1].ln() / (ratio[k - 1] / ratio[k]).ln();
        all[k - 1].step * (all[k].step / all[k - 1].step).powf(share)
    });
    let at_rest =
        |step: f64| -> Result<bool, String> { Ok(beds.agitation(&Bed { step, ..fine })? < RESTS) };
    // Bisection between a step far below the limit and one far above; NaN if the bed still moves at the lower.
    let (mut rests, mut boils) = (0.3 * theory, 10.0 * theory);
    if !at_rest(rests)? {
        rests = f64::NAN;
    }
    while boils / rests > 1.06 {
        let middle = (rests * boils).sqrt();
        if at_rest(middle)? {
            rests = middle;
        } else {
            boils = middle;
        }
    }
    let told = ratio
        .iter()
        .zip(&all)
        .map(|(r, bed)| (bed.step, *r))
        .collect();
    Ok((
        Steps {
            theory,
            rests,
            accurate,
            matches,
        },
        told,
    ))
}

/// The figure.
pub fn run(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let mut figure = Figure::new(
        "Usable steps: constants of 20 µs, αcn = 1.3, β = 15.8, τ* = 0.5",
        "layers (–)",
        "step Δt (µs)",
    )
    .log_y();
    for diameter in DIAMETERS {
        let all: Vec<_> = LAYERS
            .par_iter()
            .map(|&layers| steps(beds, diameter, layers))
            .collect::<Result<_, _>>()?;
        for (layers, (steps, ratios)) in LAYERS.iter().zip(&all) {
            let name = format!("d = {diameter} mm, {layers} layers");
            for (what, value) in [
                ("λmax = 4 of its packing", steps.theory),
                ("largest step at which it comes to rest", steps.rests),
                (
                    "largest step whose transport is within 10 % of converged",
                    steps.accurate,
                ),
                (
                    "step at which transport meets Meyer-Peter and Müller's",
                    steps.matches,
                ),
            ] {
                report.tell(format!("{name}: {what} (µs)"), value, "NaN: none");
            }
            for (step, ratio) in ratios {
                report.tell(
                    format!("{name}, Δt = {step:.3} µs: qB* over Meyer-Peter and Müller's"),
                    *ratio,
                    "",
                );
            }
        }
        let x = LAYERS.map(f64::from);
        let column =
            |pick: fn(&Steps) -> f64| -> Vec<f64> { all.iter().map(|(s, _)| pick(s)).collect() };
        figure = figure
            .theory(
                &format!("λmax = 4, d = {diameter} mm"),
                &x,
                &column(|s| s.theory),
            )
            .points(
                &format!("comes to rest, d = {diameter} mm"),
                &x,
                &column(|s| s.rests),
                None,
            )
            .points(
                &format!("transport within 10 %, d = {diameter} mm"),
                &x,
                &column(|s| s.accurate),
                None,
            )
            .points(
                &format!("transport meets MPM, d = {diameter} mm"),
                &x,
                &column(|s| s.matches),
                None,
            );
        report.progress(&format!("usable steps, d = {diameter} mm"));
    }
    report.figure("bedload_usable_step", figure)
}
