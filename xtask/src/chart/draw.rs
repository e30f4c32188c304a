//! A chart as a figure, a table of numbers and words on its front.

use super::front::{Point, above, front};
use super::scene::SceneChart;
use crate::validate::scenes::keep;
use std::fmt::Write as _;
use std::path::Path;
use tsubu_picture::Figure;

/// Standard errors by which the default may lie above the front.
const NEAR: f64 = 2.0;

/// Draws the chart of a scene. True if there are points and a front enough and the default lies on it or near.
pub fn scene(root: &Path, name: &str, chart: &SceneChart) -> Result<bool, String> {
    eprintln!("{}: {} settings", chart.title, chart.settings.len());
    let (truth, points) = chart.points(root)?;
    println!(
        "{name}: {} of the reference ({}): {:.4} ± {:.4}",
        chart.subject.word, chart.reference.name, truth.0, truth.1
    );
    draw(
        root,
        name,
        chart.title,
        "cost: seconds of one core (s)",
        chart.subject.word,
        chart.subject.name,
        &points,
    )
}

/// Figure, CSV and table of a set of points, each of the front with its own mark.
fn draw(
    root: &Path,
    name: &str,
    title: &str,
    cost: &str,
    word: &str,
    file: &str,
    points: &[Point],
) -> Result<bool, String> {
    let best = front(points);
    let of = |keys: &[usize]| -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let x = keys.iter().map(|&k| points[k].cost).collect();
        let y = keys.iter().map(|&k| points[k].error.max(1e-4)).collect();
        (x, y, keys.iter().map(|&k| points[k].uncertainty).collect())
    };
    let others: Vec<usize> = (0..points.len())
        .filter(|k| !best.contains(k) && !points[*k].is_default)
        .collect();
    let mut figure = Figure::new(title, cost, &format!("error of one run in {word} (–)"))
        .log_x()
        .log_y();
    let (x, y, _) = of(&best);
    figure = figure.theory("front: nothing is both cheaper and nearer", &x, &y);
    let (x, y, e) = of(&others);
    figure = figure.points("other settings", &x, &y, Some(&e));
    for &k in &best {
        let (x, y, e) = of(&[k]);
        figure = figure.points(&points[k].name, &x, &y, Some(&e));
    }
    let default = points.iter().position(|p| p.is_default);
    if let Some(k) = default.filter(|k| !best.contains(k)) {
        let (x, y, e) = of(&[k]);
        figure = figure.points(&format!("as shipped: {}", points[k].name), &x, &y, Some(&e));
    }
    save(root, name, file, figure)?;
    table(root, name, file, points)
}

/// Writes a figure of the charts.
pub fn save(root: &Path, name: &str, file: &str, figure: Figure) -> Result<(), String> {
    let folder = root.join("docs/charts");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    figure
        .caption(&format!("cargo xtask chart {name}"))
        .save(&folder.join(file))
        .map_err(|e| e.to_string())?;
    Ok(())
}

/// Prints the points and writes them as CSV. True if there are enough, on a front long enough, and what is shipped lies on it
/// or near.
pub fn table(root: &Path, name: &str, file: &str, points: &[Point]) -> Result<bool, String> {
    let best = front(points);
    let default = points.iter().position(|p| p.is_default);
    let mut csv = "setting,gives up,cost,error,standard error,on the front,as shipped\n".to_owned();
    println!(
        "{:<44} {:>10} {:>9} {:>9}  gives up",
        "setting", "cost", "error", "±"
    );
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].cost.total_cmp(&points[b].cost));
    for k in order {
        let p = &points[k];
        let _ = writeln!(
            csv,
            "\"{}\",\"{}\",{:?},{:?},{:?},{},{}",
            p.name,
            p.gives_up,
            p.cost,
            p.error,
            p.uncertainty,
            best.contains(&k),
            p.is_default
        );
        let mark = match (best.contains(&k), p.is_default) {
            (true, true) => "front, shipped",
            (true, false) => "front",
            (false, true) => "shipped",
            (false, false) => "",
        };
        println!(
            "{:<44} {:>10.3} {:>9.4} {:>9.4}  {} {}",
            p.name,
            p.cost,
            p.error,
            p.uncertainty,
            p.gives_up,
            if mark.is_empty() {
                String::new()
            } else {
                format!("[{mark}]")
            }
        );
    }
    keep(&root.join(format!("docs/charts/{file}.csv")), &csv)?;
    let off = default.map_or(f64::INFINITY, |k| above(points, &best, k));
    let held = points.len() >= 25 && best.len() >= 4 && off <= NEAR;
    let shipped = match off {
        0.0 => "as shipped on it".to_owned(),
        off if off.is_finite() => format!("as shipped {off:.1} standard errors above it"),
        _ => "as shipped above it".to_owned(),
    };
    println!(
        "{name}: {} points, {} on the front; {shipped}; docs/charts/{file}.svg\n",
        points.len(),
        best.len()
    );
    Ok(held)
}
