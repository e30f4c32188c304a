//! Figures of several seeds: the result of each beside theory, and the curves of all in one.

use crate::course::Ran;
use crate::figures::{capital, save};
use crate::trouble::Trouble;
use std::path::PathBuf;
use tsubu::model::Curve;
use tsubu::picture::Figure;
use tsubu::record::{RunFolder, Summary};

/// A result worth a figure: its name in the summary, title, axis, and what theory says.
type Result = (
    &'static str,
    &'static str,
    &'static str,
    fn(&Summary) -> Vec<(&'static str, f64)>,
);

const RESULTS: [Result; 3] = [
    (
        "transport",
        "Transport of each seed",
        "transport qB*",
        |mean| {
            [
                ("Meyer-Peter & Müller 1948", "transport_meyer_peter_mueller"),
                ("Wong & Parker 2006", "transport_wong_parker"),
            ]
            .into_iter()
            .filter_map(|(label, name)| Some((label, mean.value(name)?.0)))
            .collect()
        },
    ),
    (
        "ratio_to_theory",
        "Mass rate of each seed",
        "mass rate over theory at a = 1",
        |_| vec![("theory", 1.0)],
    ),
    (
        "angle_of_repose",
        "Angle of repose of each seed",
        "angle (deg)",
        |_| Vec::new(),
    ),
];

/// Draws what there is to draw of runs and their mean; returns the files (SVG).
pub fn draw(
    folder: &RunFolder,
    runs: &[(u64, &Ran)],
    mean: &Summary,
    command: &str,
) -> std::result::Result<Vec<PathBuf>, Trouble> {
    let mut files = Vec::new();
    for result in RESULTS {
        if let Some(figure) = each(result, runs, mean) {
            files.push(save(folder, "seeds", &figure.caption(command))?);
            break;
        }
    }
    let Some((_, first)) = runs.first() else {
        return Ok(files);
    };
    let mut names: Vec<&str> = first.curves.iter().map(|c| c.figure).collect();
    names.dedup();
    for name in names {
        if let Some(figure) = together(name, runs) {
            files.push(save(folder, name, &figure.caption(command))?);
        }
    }
    Ok(files)
}

/// The result of each run with its own error, their mean as a band, and theory.
fn each(
    (name, title, axis, theory): Result,
    runs: &[(u64, &Ran)],
    mean: &Summary,
) -> Option<Figure> {
    let (value, error) = mean.value(name).filter(|v| v.0.is_finite())?;
    let seeds: Vec<String> = runs.iter().map(|(seed, _)| seed.to_string()).collect();
    let x: Vec<f64> = (1..=runs.len()).map(|k| k as f64).collect();
    let values: Vec<_> = runs
        .iter()
        .filter_map(|(_, ran)| ran.summary.value(name))
        .collect();
    let y: Vec<f64> = values.iter().map(|v| v.0).collect();
    let own: Vec<f64> = values.iter().map(|v| v.1.unwrap_or(0.0)).collect();
    let ends = [0.5, runs.len() as f64 + 0.5];
    let mut figure = Figure::new(title, &format!("run, of seeds {}", seeds.join(", ")), axis)
        .x_range(ends[0], ends[1]);
    for (label, level) in theory(mean) {
        // Theory is black, so two of them differ by the number.
        figure = figure.theory(&format!("{label}: {level:.3}"), &ends, &[level; 2]);
    }
    let (label, error) = ("mean and its standard error", error.unwrap_or(0.0));
    Some(
        figure
            .band(label, &ends, &[value - error; 2], &[value + error; 2])
            .line(label, &ends, &[value; 2])
            .points("a run and its own error", &x, &y, Some(&own)),
    )
}

/// The curves of all runs in one figure, if a run has one curve of its own there; those that all have alike come once.
fn together(name: &str, runs: &[(u64, &Ran)]) -> Option<Figure> {
    let (_, first) = runs.first()?;
    let same = |a: &Curve, b: &Curve| a.label == b.label && a.x == b.x && a.y == b.y;
    let (mut alike, mut own) = (Vec::new(), Vec::new());
    for curve in first.curves.iter().filter(|c| c.figure == name) {
        let in_all = runs.iter().all(|(_, ran)| {
            ran.curves
                .iter()
                .any(|c| c.figure == name && same(c, curve))
        });
        if in_all { &mut alike } else { &mut own }.push(curve);
    }
    let [own] = own[..] else { return None };
    let mut figure = Figure::new(&capital(name), own.axes[0], own.axes[1]);
    for (seed, ran) in runs {
        let mine = |c: &&Curve| c.figure == name && c.label == own.label;
        if let Some(curve) = ran.curves.iter().find(mine) {
            figure = figure.line(&format!("seed {seed}"), &curve.x, &curve.y);
        }
    }
    for curve in alike {
        figure = figure.line(&curve.label, &curve.x, &curve.y);
    }
    Some(figure)
}
