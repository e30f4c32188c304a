//! Figures of a run: the observers' curves, and the rows that people look at first.

use crate::rows::Rows;
use crate::trouble::Trouble;
use std::path::PathBuf;
use tsubu::assemble::Simulation;
use tsubu::picture::Figure;
use tsubu::record::RunFolder;

/// Rows drawn together: file name, title, axis label, columns and their labels.
type Together = (
    &'static str,
    &'static str,
    &'static str,
    &'static [(&'static str, &'static str)],
);

const FROM_ROWS: [Together; 3] = [
    (
        "angle",
        "Angle of the heap",
        "angle (deg)",
        &[
            ("angle_flank", "line over 15–85 % of the flank"),
            ("angle_runout", "height over run-out"),
        ],
    ),
    (
        "energies",
        "Where the energy is",
        "energy (J)",
        &[
            ("kinetic", "kinetic"),
            ("gravitational", "gravitational"),
            ("lost_damping", "lost between grains"),
            ("lost_wall_damping", "lost to wall damping"),
            ("lost_wall_friction", "lost to wall friction"),
            ("total", "sum"),
        ],
    ),
    (
        "coordination",
        "Contacts per grain",
        "coordination number",
        &[("coordination", "grains inside the deposit")],
    ),
];

/// Draws what there is to draw; returns the files (SVG).
pub fn draw(
    folder: &RunFolder,
    run: &dyn Simulation,
    rows: &Rows,
    command: &str,
) -> Result<Vec<PathBuf>, Trouble> {
    let mut files = Vec::new();
    let curves = run.curves();
    let mut names: Vec<&str> = curves.iter().map(|c| c.figure).collect();
    names.dedup();
    for name in names {
        let of: Vec<_> = curves.iter().filter(|c| c.figure == name).collect();
        let Some(first) = of.first() else { continue };
        let mut figure = Figure::new(&capital(name), first.axes[0], first.axes[1]).caption(command);
        for curve in of {
            figure = figure.line(&curve.label, &curve.x, &curve.y);
        }
        files.push(save(folder, name, &figure)?);
    }
    let zero = run.released_at().unwrap_or(0.0);
    let axis = if run.released_at().is_some() {
        "time after release (s)"
    } else {
        "time (s)"
    };
    let time: Vec<f64> = rows
        .column("time")
        .unwrap_or(&[])
        .iter()
        .map(|t| t - zero)
        .collect();
    for (name, title, label, columns) in FROM_ROWS {
        let there: Vec<_> = columns
            .iter()
            .filter_map(|(column, label)| Some((rows.column(column)?, label)))
            .collect();
        if there
            .iter()
            .all(|(values, _)| values.iter().all(|v| !v.is_finite()))
        {
            continue;
        }
        let mut figure = Figure::new(title, axis, label).caption(command);
        for (values, label) in there {
            let there = |i: &usize| values[*i].is_finite();
            let x: Vec<f64> = (0..values.len()).filter(there).map(|i| time[i]).collect();
            let y: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
            figure = figure.line(label, &x, &y);
        }
        files.push(save(folder, name, &figure)?);
    }
    Ok(files)
}

/// Saves a figure of a run; returns the SVG.
pub fn save(folder: &RunFolder, name: &str, figure: &Figure) -> Result<PathBuf, Trouble> {
    let [svg, _png] = figure.save(&folder.path(format!("figures/{name}")))?;
    Ok(svg)
}

/// The name of a figure as its title.
pub fn capital(name: &str) -> String {
    let words = name.replace('_', " ");
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
