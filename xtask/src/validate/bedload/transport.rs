//! Transport against the Shields number (paper B's fig. 5): readings, at the step of the paper and at one that resolves.

use super::beds::{Bed, Beds, Mean, Reading, meyer_peter_mueller};
use super::flume;
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use tsubu_picture::Figure;
use tsubu_stream::TransportCurve;

/// Seeds of bed and turbulence of each point.
pub const SEEDS: u64 = 3;
/// Shields numbers of the figure.
const SHIELDS: [f64; 7] = [0.05, 0.1, 0.2, 0.35, 0.5, 1.0, 1.5];
/// The step of paper B's section 3 in µs, from which its constants are.
pub const PAPERS_STEP: f64 = 20.0;

/// The shipped bed in short, two seeds.
pub fn shipped(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let [mean] = beds.means(&[Bed::of(0.5)], 2)?[..] else {
        return Err("one bed has one mean".to_owned());
    };
    report.beside(
        "no_pull, β = 15.8, τ* = 0.5, Δt = 3 µs: qB*, two seeds",
        meyer_peter_mueller(0.5),
        mean.transport,
        &format!("expected: Meyer-Peter and Müller; ± {:.3}", mean.error),
    );
    Ok(())
}

/// Converged in the step, and near the relation at τ* = 0.5.
pub fn converged(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let bed = Bed::of(0.5);
    let finer = Bed { step: 1.5, ..bed };
    let [coarse, fine] = beds.means(&[bed, finer], 8)?[..] else {
        return Err("two beds have two means".to_owned());
    };
    report.check(
        "no_pull, β = 15.8, τ* = 0.5: qB* at Δt = 3 µs over that at 1.5 µs",
        1.0,
        coarse.transport / fine.transport,
        Tolerance::Absolute(
            3.0 * (coarse.error / coarse.transport).hypot(fine.error / fine.transport),
        ),
        "converged in the step: three standard errors of eight seeds each",
    );
    let (ratio, error) = fine.over_theory(0.5);
    report.check(
        "no_pull, β = 15.8, τ* = 0.5: qB* over Meyer-Peter and Müller's",
        1.0,
        ratio,
        Tolerance::Absolute(0.2),
        &format!("as asked; ± {error:.3}, eight seeds at 1.5 µs"),
    );
    Ok(())
}

/// Rows of a set of means over Meyer-Peter and Müller's.
pub fn told(report: &mut Report, name: &str, beds: &[Bed], means: &[Mean]) {
    for (bed, mean) in beds.iter().zip(means) {
        let (ratio, error) = mean.over_theory(bed.shields);
        let state = match (mean.broken, mean.over_limit > 1.0) {
            (0, false) => String::new(),
            (0, true) => format!("; step at {:.1} of its limit", mean.over_limit),
            (broken, _) => format!("; {broken} runs broke"),
        };
        report.tell(
            format!(
                "{name}, τ* = {}: qB* over Meyer-Peter and Müller's",
                bed.shields
            ),
            ratio,
            &format!("± {error:.3}{state}"),
        );
    }
}

/// Every run that claims to be converged keeps its step below the limit of its packing.
pub fn resolved(report: &mut Report, name: &str, means: &[Mean]) {
    let most = means.iter().map(|m| m.over_limit).fold(0.0, f64::max);
    report.check(
        format!("{name}: the largest share that a step took of its packing's limit"),
        1.0,
        most,
        Tolerance::AtMost,
        "λmax of the contacts as they lay when the water began",
    );
}

/// Curves and measured rows that every figure of transport shows.
pub fn with_relations(figure: Figure) -> Figure {
    let x: Vec<f64> = (0..=60).map(|k| 0.05 * 1.06f64.powi(k)).collect();
    let curve = |c: TransportCurve| -> Vec<f64> {
        x.iter()
            .map(|&s| c.transport(s).unwrap_or(f64::NAN))
            .collect()
    };
    let [others, sand] = flume::points();
    figure
        .log_x()
        .log_y()
        .x_range(0.04, 2.0)
        .y_range(1e-3, 50.0)
        .measured("flumes, slope ≤ 0.02", &others.0, &others.1)
        .measured("Gilbert 1914, 0.5 mm", &sand.0, &sand.1)
        .theory(
            "Meyer-Peter & Müller 1948",
            &x,
            &curve(TransportCurve::MEYER_PETER_MULLER),
        )
        .theory(
            "Wong & Parker 2006",
            &x,
            &curve(TransportCurve::WONG_PARKER),
        )
}

/// Paper B's figure 5.
pub fn against_shields(report: &mut Report, beds: &Beds<'_>) -> Result<(), String> {
    let base = Bed::of(0.5);
    let printed = Bed {
        reading: Reading::AsPrinted,
        ..base
    };
    let stiff = |bed: Bed| Bed { beta: 1.0, ..bed };
    let at_papers_step = |bed: Bed| Bed {
        step: PAPERS_STEP,
        ..bed
    };
    let sets = [
        ("no_pull, β = 15.8", base),
        (
            "no_pull, β = 15.8, slip as printed",
            Bed {
                reading: Reading::NoPullSlipAsPrinted,
                ..base
            },
        ),
        ("no_pull, β = 1", stiff(base)),
        ("as_printed, β = 1", stiff(printed)),
        ("as_printed, β = 15.8", printed),
        ("no_pull, β = 15.8, Δt = 20 µs", at_papers_step(base)),
        (
            "as_printed, β = 1, Δt = 20 µs",
            at_papers_step(stiff(printed)),
        ),
        ("as_printed, β = 15.8, Δt = 20 µs", at_papers_step(printed)),
    ];
    let empty = |title| {
        with_relations(Figure::new(
            title,
            "Shields number τ* (–)",
            "transport qB* (–)",
        ))
    };
    let mut fine = empty("Transport of a bed of 0.5 mm sand, converged in the step");
    let mut coarse = empty("Transport of the same bed at the paper's step of 20 µs");
    for (name, base) in sets {
        let all = SHIELDS.map(|shields| Bed { shields, ..base });
        let means = beds.means(&all, SEEDS)?;
        told(report, name, &all, &means);
        if base.step < PAPERS_STEP {
            resolved(report, name, &means);
        }
        let (y, e): (Vec<f64>, Vec<f64>) = means.iter().map(|m| (m.transport, m.error)).unzip();
        let figure = if base.step < PAPERS_STEP {
            &mut fine
        } else {
            &mut coarse
        };
        *figure = figure.clone().points(name, &SHIELDS, &y, Some(&e));
        report.progress(name);
    }
    report.figure("bedload_transport", fine)?;
    report.figure("bedload_transport_papers_step", coarse)
}
