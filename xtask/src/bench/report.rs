//! What the bench says: a table, a CSV and a figure of how the cost grows.

use super::cases::Case;
use crate::peers::Engine;
use crate::validate::scenes::keep;
use std::fmt::Write as _;
use std::path::Path;
use tsubu_picture::Figure;

/// One engine on one scene with so many threads.
pub struct Row {
    scene: &'static str,
    law: &'static str,
    grains: usize,
    threads: usize,
    engine: &'static str,
    /// Median rate in million grain-steps per second.
    rate: f64,
    /// Our rate over this one: median, smallest, largest.
    ratio: [f64; 3],
}

/// Smallest, median, largest.
fn spread(values: &[f64]) -> [f64; 3] {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let n = sorted.len();
    if n == 0 {
        return [f64::NAN; 3];
    }
    let median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
    [sorted[0], median, sorted[n - 1]]
}

impl Row {
    /// Ours alone.
    pub fn own(case: &Case, threads: usize, own: &[f64]) -> Self {
        Self {
            scene: case.scene,
            law: case.law,
            grains: case.grains,
            threads,
            engine: "tsubu",
            rate: spread(own)[1],
            ratio: [1.0; 3],
        }
    }

    /// Another engine; ratios are of the same round.
    pub fn against(
        case: &Case,
        threads: usize,
        engine: Engine,
        own: &[f64],
        theirs: &[f64],
    ) -> Self {
        let ratios: Vec<f64> = own.iter().zip(theirs).map(|(a, b)| a / b).collect();
        let [low, median, high] = spread(&ratios);
        Self {
            engine: engine.name(),
            rate: spread(theirs)[1],
            ratio: [median, low, high],
            ..Self::own(case, threads, own)
        }
    }

    /// A line of the table.
    pub fn words(&self) -> String {
        let [median, low, high] = self.ratio;
        let ratio = if self.engine == "tsubu" {
            String::new()
        } else {
            format!("{median:7.2} ({low:.2}–{high:.2})")
        };
        format!(
            "{:<7} {:<14} {:>8} grains {} thread(s)  {:<9} {:8.2} M grain-steps/s {ratio}",
            self.scene, self.law, self.grains, self.threads, self.engine, self.rate
        )
    }
}

/// Writes docs/charts/bench.csv and a figure for each scene and law that has several sizes.
pub fn write(root: &Path, rows: &[Row]) -> Result<(), String> {
    let mut csv = "scene,law,grains,threads,engine,million grain-steps per second,ratio,ratio smallest,ratio largest\n".to_owned();
    for r in rows {
        let [median, low, high] = r.ratio;
        let _ = writeln!(
            csv,
            "{},{},{},{},{},{:.4},{median:.4},{low:.4},{high:.4}",
            r.scene, r.law, r.grains, r.threads, r.engine, r.rate
        );
    }
    keep(&root.join("docs/charts/bench.csv"), &csv)?;
    let mut kinds: Vec<(&str, &str)> = rows.iter().map(|r| (r.scene, r.law)).collect();
    kinds.dedup();
    for (scene, law) in kinds {
        let of: Vec<&Row> = rows
            .iter()
            .filter(|r| r.scene == scene && r.law == law && r.threads == 1)
            .collect();
        growth(root, scene, law, &of)?;
    }
    Ok(())
}

/// Nanoseconds per grain and step over the number of grains, on one thread.
fn growth(root: &Path, scene: &str, law: &str, rows: &[&Row]) -> Result<(), String> {
    let mut engines: Vec<&str> = rows.iter().map(|r| r.engine).collect();
    engines.sort_unstable();
    engines.dedup();
    let title = format!("Cost of a grain in a step: {scene}, {law}, one thread");
    let mut figure = Figure::new(&title, "grains (–)", "time per grain and step (ns)")
        .log_x()
        .log_y();
    let mut most = 0;
    for engine in engines {
        let of: Vec<&&Row> = rows.iter().filter(|r| r.engine == engine).collect();
        let x: Vec<f64> = of.iter().map(|r| r.grains as f64).collect();
        let y: Vec<f64> = of.iter().map(|r| 1e3 / r.rate).collect();
        most = most.max(x.len());
        figure = figure.line(engine, &x, &y);
    }
    if most < 2 {
        return Ok(());
    }
    let folder = root.join("docs/charts");
    let name = format!("bench_{scene}_{}", law.to_lowercase());
    figure
        .caption("cargo xtask bench --against lammps,liggghts,yade")
        .save(&folder.join(&name))
        .map_err(|e| e.to_string())?;
    println!("docs/charts/{name}.svg");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_an_even_number_lies_between_two() {
        assert_eq!(spread(&[4.0, 1.0, 3.0, 2.0]), [1.0, 2.5, 4.0]);
        assert_eq!(spread(&[5.0]), [5.0; 3]);
        assert!(spread(&[])[1].is_nan());
    }
}
