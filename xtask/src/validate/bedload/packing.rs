//! How fast a bed of 5 × 10 grains falls together (paper B's figs 3 and 4), with constants of Δt = 20 µs.

use super::beds::SCENE;
use crate::validate::report::Report;
use crate::validate::scenes::{build_anyway, changed};
use rayon::prelude::*;
use std::path::Path;
use tsubu_picture::Figure;

/// The paper's step, from which the constants are, and one that resolves, in µs.
const STEPS: [f64; 2] = [20.0, 2.0];
/// Beds over which times to settle are averaged.
const SEEDS: u64 = 8;
/// Every so many ms the centre of mass is looked at.
const LOOK: f64 = 1.0;
/// The end of the packing in ms.
const UNTIL: f64 = 400.0;
/// Share of the diameter within which the centre of mass stays once it has settled.
const SETTLED: f64 = 0.01;

const TN: [f64; 6] = [5.0, 10.0, 15.0, 20.0, 30.0, 40.0];
const CN: [f64; 6] = [0.5, 0.8, 1.0, 1.3, 1.6, 2.0];

/// Height of the centre of mass over d, once every [`LOOK`].
fn history(root: &Path, tn: f64, cn: f64, step: f64, seed: u64) -> Result<Vec<f64>, String> {
    let sets = [
        "domain.x=Periodic(\"2.675 mm\")".to_owned(),
        format!("grains.law.constants=FromTimeStep(step: \"20 us\", tn: {tn}, cn: {cn})"),
        format!("initial.bed.seed={seed}"),
        // It never begins here: the grains weigh what they do under water.
        "water.begins=10 s".to_owned(),
        format!("time.until={UNTIL} ms"),
        format!("time.step=Exactly(\"{step} us\")"),
        "output.frames=false".to_owned(),
    ];
    let source = changed(&root.join(SCENE), &sets)?;
    let mut run = build_anyway(&source)?.simulation;
    let each = (LOOK * 1e3 / step).round() as u64;
    let mut heights = Vec::new();
    while !run.is_over() {
        let row = run.look();
        let centre = row.iter().find(|r| r.name == "centre_of_mass");
        heights.push(centre.map_or(f64::NAN, |r| r.value / 0.5e-3));
        run.advance(each);
    }
    Ok(heights)
}

/// When the centre of mass came to stay where it is in the last quarter, in ms; NaN if it did not in the first three.
fn settled(heights: &[f64]) -> f64 {
    let last = heights.len() * 3 / 4;
    let end = heights[last..].iter().sum::<f64>() / (heights.len() - last) as f64;
    match heights
        .iter()
        .rposition(|y| (y - end).abs() > SETTLED || y.is_nan())
    {
        Some(k) if k >= last => f64::NAN,
        Some(k) => (k + 1) as f64 * LOOK,
        None => 0.0,
    }
}

/// Mean time to settle in ms with its standard error; NaN if a bed did not.
fn time_to_settle(root: &Path, tn: f64, cn: f64, step: f64) -> Result<(f64, f64), String> {
    let times: Vec<f64> = (1..=SEEDS)
        .into_par_iter()
        .map(|seed| history(root, tn, cn, step, seed).map(|h| settled(&h)))
        .collect::<Result<_, String>>()?;
    let n = SEEDS as f64;
    let mean = times.iter().sum::<f64>() / n;
    let scatter = times.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
    Ok((mean, scatter.sqrt()))
}

/// Both figures, and the fastest pair of constants.
pub fn run(report: &mut Report) -> Result<(), String> {
    let root = report.root().to_owned();
    for step in STEPS {
        let fine = if step == STEPS[0] { "" } else { "_fine" };
        let curves = |title: &str, file: &str, cases: &[(String, f64, f64)]| {
            let mut figure = Figure::new(
                &format!("{title}; constants of 20 µs, step {step} µs"),
                "time (ms)",
                "height of the centre of mass over d (–)",
            );
            for (name, tn, cn) in cases {
                let heights = history(&root, *tn, *cn, step, 1)?;
                let t: Vec<f64> = (0..heights.len()).map(|k| k as f64 * LOOK).collect();
                figure = figure.line(name, &t, &heights);
            }
            report.figure(
                &format!("{file}{fine}"),
                figure.x_range(0.0, 200.0).y_range(3.0, 8.0),
            )
        };
        let cases = TN.map(|tn| (format!("αtn = {tn}"), tn, 1.0));
        curves(
            "Packing of 5 × 10 grains, αcn = 1",
            "bedload_packing_tn",
            &cases,
        )?;
        let cases = [0.5, 1.0, 1.3, 2.0].map(|cn| (format!("αcn = {cn}"), 20.0, cn));
        curves(
            "Packing of 5 × 10 grains, αtn = 20",
            "bedload_packing_cn",
            &cases,
        )?;
    }
    for step in STEPS {
        let mut best = (f64::NAN, f64::NAN, f64::INFINITY, 0.0);
        for tn in TN {
            for cn in CN {
                let (time, error) = time_to_settle(&root, tn, cn, step)?;
                if cn == 1.0 || tn == 20.0 {
                    report.tell(
                        format!("packing, αtn = {tn}, αcn = {cn}, Δt = {step} µs: ms to settle"),
                        time,
                        &format!(
                            "± {error:.0}, eight beds; NaN: one never did within a hundredth of d"
                        ),
                    );
                }
                if time < best.2 {
                    best = (tn, cn, time, error);
                }
            }
        }
        report.tell(
            format!(
                "packing, Δt = {step} µs: ms to settle of the fastest, αtn = {}, αcn = {}",
                best.0, best.1
            ),
            best.2,
            &format!("± {:.0}; the paper's choice is (20, 1.3)", best.3),
        );
    }
    report.progress("packing");
    Ok(())
}
