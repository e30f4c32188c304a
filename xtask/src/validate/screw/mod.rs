//! Suite `screw`: paper A's screw feeder (sections 4 and 6) against theory and against itself.
//!
//! Two things hold whatever the grains: a plug that cannot turn advances one pitch per turn, and what
//! leaves is what the tube holds times its axial speed. The rate itself has no closed form; Q = a A p n ρb is
//! a definition of a, and how near a is to 1 is what the charts say.

mod cost;
mod friction;
mod full;
mod grains;
mod kinds;
mod ladder;
mod levels;
mod plug;
mod runs;
mod section;
mod turning;

use super::check::Tolerance;
use super::kept::Measured;
use super::report::Report;
use rayon::prelude::*;
use runs::{Case, Kind, fingerprint};
use tsubu_picture::Figure;

/// Seven speeds at n = 3, the same with a screw of grains and two with the other reading of walls, more screws of grains,
/// comparisons at n = 4, the ladder, and 200 000 grains, which are a third of it.
pub const FULL_GRAIN_STEPS: f64 = 7.5e11 + ladder::GRAIN_STEPS + friction::GRAIN_STEPS;

/// The rate that is compared: that in the tube. It is that of the outlet (a check below) with a smaller error.
const TUBE: &str = "mass_rate_from_section";

/// Paper A's speeds, r/min (fig. 8).
const SPEEDS: [f64; 7] = [20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0];

/// The suite.
pub fn run(report: &mut Report) -> Result<(), String> {
    plug::run(report)?;
    let root = report.root().to_owned();
    let print = fingerprint(&root)?;
    report.progress("the bed at n = 4 is settled");
    let all = |cases: &[Case]| -> Result<Vec<Measured>, String> {
        cases
            .par_iter()
            .map(|case| {
                eprintln!("  screw {case:?} …");
                case.measured(&root, print)
            })
            .collect()
    };
    // This run first, for its bed: cases that run side by side share it.
    let base = Case::of(4, 60.0);
    let one = all(&[base])?;
    identities(report, &base.name(), &one[0]);
    ladder::run(report, &one[0])?;
    if !report.full() {
        return Ok(());
    }
    let mut cases: Vec<Case> = SPEEDS.iter().map(|&rpm| Case::of(3, rpm)).collect();
    cases.extend([60.0, 100.0].map(|rpm| Case::of(3, rpm).touching_at_centres()));
    let measured = all(&cases)?;
    for (case, measured) in cases.iter().zip(&measured) {
        identities(report, &case.name(), measured);
    }
    let (surface, centre) = measured.split_at(SPEEDS.len());
    for (rpm, centre) in [60.0, 100.0].into_iter().zip(centre) {
        let surface = SPEEDS.iter().position(|&s| s == rpm).map(|k| &surface[k]);
        if let Some(surface) = surface {
            offsets(report, rpm, surface, centre);
        }
    }
    report.progress("all speeds at n = 3");
    levels::feeder(report, &surface[2], &one[0]);
    let compared = comparisons(report, &base, &one[0], &all)?;
    report.progress(&format!("{compared} comparisons at n = 4"));
    kinds::run(report, &root, print, &all)?;
    cost::run(report, &root, print)?;
    friction::run(report, &root, print, &all)?;
    grains::run(report, &all)?;
    let of_grains = grains::at_speeds(report, &SPEEDS, &all)?;
    against_speed(report, surface, &of_grains)?;
    let hundred = SPEEDS.iter().position(|&s| s == 100.0).unwrap_or(0);
    let full = full::run(report, &root, print, &surface[hundred])?;
    identities(report, "200 000 grains, 100 r/min", &full);
    Ok(())
}

/// The two readings of where a grain touches a wall, at n = 3.
fn offsets(report: &mut Report, rpm: f64, surface: &Measured, centre: &Measured) {
    let ((a, da), (b, db)) = (surface.get(TUBE), centre.get(TUBE));
    report.tell(
        format!("n = 3, {rpm} r/min: rate in the tube with s = R over that with s = R + d/2"),
        b / a,
        &format!("± {:.3}", b / a * (da / a).hypot(db / b)),
    );
}

/// Interval of 99.73 % over that of 68.27 % by Student's t, for the mean of so many turns. A rate that is not steady is the
/// mean of blocks, eight at least, and has no turns: then 3.
/// From a table of t: 235.8/1.837, 19.21/1.321, 9.219/1.197, 6.620/1.142, 5.507/1.111, 4.904/1.091, 4.530/1.077.
fn surely(turns: f64) -> f64 {
    const RATIO: [f64; 7] = [128.4, 14.54, 7.70, 5.80, 4.96, 4.49, 4.21];
    match turns as usize {
        0 | 1 => 3.0,
        turns => RATIO[(turns - 2).min(RATIO.len() - 1)],
    }
}

/// What must hold in any feeder.
fn identities(report: &mut Report, name: &str, measured: &Measured) {
    let (rate, rate_error) = measured.get("mass_rate");
    let (section, section_error) = measured.get("mass_rate_from_section");
    let turns = measured.get("steady_turns").0;
    report.check(
        format!("{name}: rate at the outlet against tube mass per length × axial speed, in σ"),
        surely(turns),
        (rate - section).abs() / rate_error.hypot(section_error),
        Tolerance::AtMost,
        &format!("continuity of a steady flow; both errors at 68.27 %, the bound at 99.73 % by Student's t of {turns} turns"),
    );
    report.tell(
        format!("{name}: rate at the outlet over that in the tube"),
        rate / section,
        &format!(
            "± {:.4}",
            (rate_error / section).hypot(section_error / section)
        ),
    );
    report.check(
        format!("{name}: grains missing from the count"),
        0.0,
        measured.get("grains_missing").0,
        Tolerance::Absolute(0.0),
        "start + came − went − present",
    );
    // What a plug in the whole of the casing would carry: (casing² − shaft²)/(Ds² − ds²) of theory.
    let most = (0.2296f64.powi(2) - 0.055f64.powi(2)) / (0.205f64.powi(2) - 0.055f64.powi(2));
    let room = std::f64::consts::PI / 4.0 * (0.2296f64.powi(2) - 0.055f64.powi(2));
    let tube = measured.get("solid_fraction").0 * 1370.0;
    let (ratio, ratio_error) = measured.get("ratio_to_theory");
    report.check(
        format!("{name}: rate over theory at a = 1, less three of its errors"),
        most * tube / measured.get("hopper_bulk_density").0,
        ratio - 3.0 * ratio_error,
        Tolerance::AtMost,
        &format!("the tube of {room:.4} m² at its density, one pitch per turn"),
    );
    for (what, note) in [
        ("ratio_to_theory", "rate over theory at a = 1"),
        ("fill_ratio", "the measured a"),
        (
            "ratio_to_theory_measured_a",
            "rate over theory at the measured a",
        ),
        ("axial_efficiency", "axial speed over p n"),
        ("steady", "1 if the rate was steady"),
    ] {
        let (value, error) = measured.get(what);
        report.tell(
            format!("{name}: {what}"),
            value,
            &format!("{note}; ± {error:.3}"),
        );
    }
}

/// Comparisons that are told, at n = 4 where a run takes a minute: how much each choice moves the rate.
fn comparisons(
    report: &mut Report,
    base: &Case,
    one: &Measured,
    all: &impl Fn(&[Case]) -> Result<Vec<Measured>, String>,
) -> Result<usize, String> {
    let cases = [
        (
            "screw as an analytic surface",
            Case {
                kind: Kind::Analytic,
                ..*base
            },
        ),
        (
            "E/10",
            Case {
                soften: 10.0,
                ..*base
            },
        ),
        (
            "E/1",
            Case {
                soften: 1.0,
                ..*base
            },
        ),
        (
            "E/10, γn/√10",
            Case {
                soften: 10.0,
                keeps_restitution: true,
                ..*base
            },
        ),
        (
            "E/100, γn/10",
            Case {
                keeps_restitution: true,
                ..*base
            },
        ),
        (
            "γt/8",
            Case {
                tangential: 0.125,
                ..*base
            },
        ),
        (
            "μ = 0.2",
            Case {
                friction: 0.2,
                ..*base
            },
        ),
        (
            "μ = 0.6",
            Case {
                friction: 0.6,
                ..*base
            },
        ),
        (
            "walls touched at the centre, s = R",
            base.touching_at_centres(),
        ),
    ];
    let measured = all(&cases.map(|c| c.1))?;
    let (rate, error) = one.get(TUBE);
    for ((name, _), other) in cases.iter().zip(&measured) {
        let (value, other_error) = other.get(TUBE);
        let spread = value / rate * (error / rate).hypot(other_error / value);
        report.tell(
            format!("n = 4, 60 r/min, {name}: rate in the tube over that of the base case"),
            value / rate,
            &format!("± {spread:.3}"),
        );
        let (ratio, _) = other.get("ratio_to_theory");
        report.tell(
            format!("n = 4, 60 r/min, {name}: rate over theory at a = 1"),
            ratio,
            "",
        );
    }
    if let Some(at_centres) = measured.last() {
        ladder::offsets_of_feeder(report, base.coarse, one, at_centres);
    }
    Ok(cases.len())
}

/// Paper A's figure 8: the rate against the speed, with theory at a = 1 and at the measured a.
fn against_speed(
    report: &mut Report,
    measured: &[Measured],
    of_grains: &[Measured],
) -> Result<(), String> {
    let column = |set: &[Measured], name: &str| -> (Vec<f64>, Vec<f64>) {
        set.iter().map(|m| m.get(name)).unzip()
    };
    let (rate, rate_error) = column(measured, "mass_rate");
    let (tube, tube_error) = column(measured, TUBE);
    let (grains, grains_error) = column(of_grains, TUBE);
    let (outlet_ratio, _) = column(measured, "ratio_to_theory");
    let (a, a_error) = column(measured, "fill_ratio");
    let theory: Vec<f64> = rate.iter().zip(&outlet_ratio).map(|(q, r)| q / r).collect();
    let with_a: Vec<f64> = theory.iter().zip(&a).map(|(q, a)| q * a).collect();
    let over = |v: &[f64]| -> Vec<f64> { v.iter().zip(&theory).map(|(q, t)| q / t).collect() };
    let (ratio, ratio_error) = (over(&tube), over(&tube_error));
    let figure = Figure::new(
        "Paper A's screw feeder at n = 3",
        "speed of the screw (r/min)",
        "mass rate (kg/s)",
    )
    .line(
        "theory, a = 1, bulk density of the hopper",
        &SPEEDS,
        &theory,
    )
    .line("theory, measured a", &SPEEDS, &with_a)
    .points(
        "tsubu, through the outlet",
        &SPEEDS,
        &rate,
        Some(&rate_error),
    )
    .points(
        "tsubu, mass per length × axial speed in the tube",
        &SPEEDS,
        &tube,
        Some(&tube_error),
    )
    .points(
        "the same with a screw of grains, rs/rp = 1/4",
        &SPEEDS,
        &grains,
        Some(&grains_error),
    );
    report.figure("screw_rate", figure)?;
    let figure = Figure::new(
        "Filling and rate over theory at n = 3",
        "speed of the screw (r/min)",
        "ratio (–)",
    )
    .points(
        "rate over theory at a = 1",
        &SPEEDS,
        &ratio,
        Some(&ratio_error),
    )
    .points("filling ratio a", &SPEEDS, &a, Some(&a_error));
    report.figure("screw_fill", figure)?;
    // Linearity over 20–80 r/min: R² of the straight line through the rates in the tube, whose errors are smaller.
    let (x, y) = (&SPEEDS[..4], &tube[..4]);
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (mx, my) = (mean(x), mean(y));
    let sum = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(f).sum::<f64>();
    let (xy, xx, yy) = (
        sum(&|i| (x[i] - mx) * (y[i] - my)),
        sum(&|i| (x[i] - mx).powi(2)),
        sum(&|i| (y[i] - my).powi(2)),
    );
    report.tell(
        "n = 3: R² of the rate against speed, 20–80 r/min",
        xy * xy / (xx * yy),
        "",
    );
    for (speed, ratio) in SPEEDS.iter().zip(&ratio) {
        let inside = (0.70..=1.02).contains(ratio);
        report.tell(
            format!("n = 3, {speed} r/min: inside the band 0.70–1.02 of Coulomb theory"),
            f64::from(u8::from(inside)),
            "1 if it is; these grains are viscous, so it need not be",
        );
    }
    Ok(())
}
