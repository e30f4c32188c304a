//! What transport depends on besides the Shields number: paper B's figs 6 (β), 7 (d), 9 (layers), 8 and 10 (Δt).

use super::beds::{Bed, Beds, Reading};
use super::transport::{PAPERS_STEP, SEEDS, resolved, told};
use crate::validate::report::Report;
use tsubu_picture::Figure;

/// Shields numbers of the figures; deep beds are dear, and have the middle one.
const SHIELDS: [f64; 3] = [0.2, 0.5, 1.0];

/// A step in µs that the packings of this bed bear: soft grains deep in a bed have more contacts.
pub fn fine_step(diameter: f64, layers: u32) -> f64 {
    if layers > 20 || diameter < 0.2 {
        1.5
    } else {
        3.0
    }
}

/// Transport over the relation against one knob, a curve for each Shields number.
struct Sweep<'a> {
    title: &'a str,
    label: &'a str,
    file: &'a str,
    /// Begins the rows of the table where the label alone does not tell.
    subject: &'a str,
    values: &'a [f64],
    seeds: u64,
    shields: &'a [f64],
    /// The bed at a value of the knob.
    bed: &'a dyn Fn(f64) -> Bed,
    /// Its steps are to be below their limits.
    resolves: bool,
}

impl Sweep<'_> {
    fn curves(
        &self,
        report: &mut Report,
        beds: &Beds<'_>,
        mut figure: Figure,
        name: &str,
    ) -> Result<Figure, String> {
        for &shields in self.shields {
            let all: Vec<Bed> = self
                .values
                .iter()
                .map(|&v| Bed {
                    shields,
                    ..(self.bed)(v)
                })
                .collect();
            let means = beds.means(&all, self.seeds)?;
            for ((value, bed), mean) in self.values.iter().zip(&all).zip(&means) {
                told(
                    report,
                    &format!("{name}{} = {value}", self.label),
                    &[*bed],
                    &[*mean],
                );
            }
            if self.resolves {
                resolved(
                    report,
                    &format!("{name}{}, τ* = {shields}", self.label),
                    &means,
                );
            }
            let (y, e): (Vec<f64>, Vec<f64>) = means.iter().map(|m| m.over_theory(shields)).unzip();
            figure = figure.points(&format!("{name}τ* = {shields}"), self.values, &y, Some(&e));
        }
        report.progress(self.title);
        Ok(figure)
    }

    fn figure(&self) -> Figure {
        let ends = [self.values[0], self.values[self.values.len() - 1]];
        Figure::new(
            self.title,
            self.label,
            "transport over Meyer-Peter & Müller's (–)",
        )
        .log_x()
        .log_y()
        .theory("Meyer-Peter & Müller 1948", &ends, &[1.0, 1.0])
    }

    fn run(&self, report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
        let figure = self.curves(report, beds, self.figure(), self.subject)?;
        report.figure(self.file, figure)
    }
}

/// The figures.
pub fn run(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let base = Bed::of(0.5);
    beta(report, beds)?;
    Sweep {
        title: "Transport against the diameter, constants of 20 µs for each",
        label: "diameter d (mm)",
        file: "bedload_diameter",
        subject: "",
        values: &[0.1, 0.2, 0.5, 1.0, 2.0, 5.0],
        seeds: SEEDS,
        shields: &SHIELDS,
        bed: &|diameter| Bed {
            diameter,
            step: fine_step(diameter, 10),
            ..base
        },
        resolves: true,
    }
    .run(report, beds)?;
    Sweep {
        title: "Transport against the step: d = 0.1 mm, constants of 20 µs",
        label: "step Δt (µs)",
        file: "bedload_step_fine_sand",
        subject: "d = 0.1 mm, ",
        values: &[1.5, 3.0, 9.0, PAPERS_STEP],
        seeds: SEEDS,
        shields: &SHIELDS,
        bed: &|step| Bed {
            diameter: 0.1,
            step,
            ..base
        },
        resolves: false,
    }
    .run(report, beds)?;
    Sweep {
        title: "Transport against the depth of the bed, d = 0.5 mm",
        label: "layers (–)",
        file: "bedload_layers",
        subject: "",
        values: &[10.0, 20.0, 30.0, 40.0, 50.0],
        seeds: 2,
        shields: &[0.5],
        bed: &|layers| Bed {
            layers: layers as u32,
            step: fine_step(0.5, layers as u32),
            ..base
        },
        resolves: true,
    }
    .run(report, beds)?;
    Sweep {
        title: "Transport against the step: 50 layers, d = 0.5 mm, constants of 20 µs",
        label: "step Δt (µs)",
        file: "bedload_step_deep_bed",
        subject: "50 layers, ",
        values: &[1.5, 3.0, 6.0, 12.0, PAPERS_STEP],
        seeds: 2,
        shields: &[0.5],
        bed: &|step| Bed {
            layers: 50,
            step,
            ..base
        },
        resolves: false,
    }
    .run(report, beds)
}

/// Figure 6, in both readings.
fn beta(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let with = |reading| {
        move |beta| Bed {
            beta,
            reading,
            ..Bed::of(0.5)
        }
    };
    let (no_pull, printed) = (with(Reading::NoPull), with(Reading::AsPrinted));
    let sweep = |bed| Sweep {
        title: "Transport against β, converged in the step",
        label: "β (–)",
        file: "bedload_beta",
        subject: "",
        values: &[1.0, 2.0, 4.0, 8.0, 15.8, 30.0],
        seeds: SEEDS,
        shields: &SHIELDS,
        bed,
        resolves: true,
    };
    let first = sweep(&no_pull);
    let figure = first.curves(report, beds, first.figure(), "no_pull, ")?;
    let figure = sweep(&printed).curves(report, beds, figure, "as_printed, ")?;
    report.figure(first.file, figure)
}
