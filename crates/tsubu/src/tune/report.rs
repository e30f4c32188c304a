//! What a tuning leaves: the tuned scene, a chart, a table and a paragraph.

use super::knobs::{Notch, turned};
use super::verdict::{Mean, off};
use super::{Tried, Tuning, distance};
use crate::run::command_line;
use crate::trouble::Trouble;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;
use tsubu::picture::Figure;
use tsubu::record::write_whole;

/// A setting in one line.
pub fn line(tried: &Tried, truth: Mean) -> String {
    let words = &tried.notch.words;
    match &tried.mean {
        Ok(mean) => {
            let (off, error) = off(*mean, truth);
            format!(
                "{words}: {:+.1} ± {:.1} % off, {:.1} core-seconds, {} run(s){}",
                100.0 * off,
                100.0 * error,
                mean.cost,
                tried.runs,
                if tried.within { ": it holds" } else { "" }
            )
        }
        Err(why) => format!("{words}: does not run ({why})"),
    }
}

/// Writes everything and says the outcome.
pub fn write(
    out: &Path,
    tuning: &Tuning<'_>,
    reference: &Notch,
    truth: Mean,
    tried: &[Tried],
    scene: &Path,
    spent: Duration,
) -> Result<(), Trouble> {
    let found = tried.iter().find(|t| t.within);
    let percent = 100.0 * tuning.tolerance;
    let mut text = format!(
        "# Tuning {} for {} within {percent} %\n\nThe reference is the scene with {}: {} = {:.6} ± {:.6} ({:.1} core-seconds a run).\n\
         {} settings of at most two knobs were tried, cheapest first, each with one to four seeds, in {:.0} s.\n\n",
        scene.display(),
        tuning.quantity,
        reference.words,
        tuning.quantity,
        truth.value,
        truth.error,
        truth.cost,
        tried.len(),
        spent.as_secs_f64()
    );
    let mut csv = "setting,off,standard error,core-seconds,runs,within\n".to_owned();
    for one in tried {
        let _ = writeln!(text, "- {}", line(one, truth));
        let (off, error) = distance(one, truth).unwrap_or((f64::NAN, f64::NAN));
        let cost = one.mean.as_ref().map_or(f64::NAN, |m| m.cost);
        let _ = writeln!(
            csv,
            "\"{}\",{off:?},{error:?},{cost:?},{},{}",
            one.notch.words, one.runs, one.within
        );
    }
    let outcome = match found {
        Some(one) => {
            let source = turned(&tuning.source, &one.notch)?;
            let file = out.join("tuned.ron");
            write_whole(&file, source.check()?.scene.to_resolved_ron().as_bytes())?;
            let sets: String = one
                .notch
                .sets
                .iter()
                .map(|set| format!(" --set '{set}'"))
                .collect();
            let (off, error) = distance(one, truth).unwrap_or((f64::NAN, f64::NAN));
            let cost = one.mean.as_ref().map_or(f64::NAN, |m| m.cost);
            format!(
                "{} holds: {} is {:+.1} ± {:.1} % off the reference, at {:.1} times less than it costs.\n  scene   {}\n  run it  tsubu run {}{sets}",
                one.notch.words,
                tuning.quantity,
                100.0 * off,
                100.0 * error,
                truth.cost / cost,
                file.display(),
                scene.display(),
            )
        }
        None => {
            let near = |t: &&Tried| {
                distance(t, truth).map_or(f64::INFINITY, |(off, error)| off.abs() + error)
            };
            let nearest = tried.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
            format!(
                "No setting keeps {} within {percent} % of the reference with its statistical error counted; nearest: {}",
                tuning.quantity,
                nearest.map_or("none ran".to_owned(), |t| line(t, truth))
            )
        }
    };
    let _ = writeln!(text, "\n{outcome}");
    write_whole(&out.join("tune.md"), text.as_bytes())?;
    write_whole(&out.join("tune.csv"), csv.as_bytes())?;
    let figure = chart(tuning, truth, tried);
    figure.save(&out.join("tune"))?;
    say!(
        "{outcome}\n  chart   {}\n  report  {}",
        out.join("tune.svg").display(),
        out.join("tune.md").display()
    );
    Ok(())
}

fn chart(tuning: &Tuning<'_>, truth: Mean, tried: &[Tried]) -> Figure {
    let ran: Vec<(&Tried, f64, f64, f64)> = tried
        .iter()
        .filter_map(|t| {
            let (off, error) = distance(t, truth)?;
            let cost = t.mean.as_ref().ok()?.cost;
            Some((t, cost, 100.0 * off.abs(), 100.0 * error))
        })
        .collect();
    let ends = [
        ran.iter().map(|r| r.1).fold(truth.cost, f64::min),
        ran.iter().map(|r| r.1).fold(truth.cost, f64::max),
    ];
    let percent = 100.0 * tuning.tolerance;
    let of = |within: bool| -> [Vec<f64>; 3] {
        let chosen: Vec<_> = ran.iter().filter(|r| r.0.within == within).collect();
        [
            chosen.iter().map(|r| r.1).collect(),
            chosen.iter().map(|r| r.2).collect(),
            chosen.iter().map(|r| r.3).collect(),
        ]
    };
    let ([x, y, e], [xt, yt, et]) = (of(false), of(true));
    Figure::new(
        &format!(
            "What keeps {} within {percent} % of a converged run",
            tuning.quantity
        ),
        "cost of a run (core-seconds)",
        &format!("{} off the reference (%)", tuning.quantity),
    )
    .log_x()
    .theory("tolerance", &ends, &[percent, percent])
    .points("tried", &x, &y, Some(&e))
    .points("tuned", &xt, &yt, Some(&et))
    .caption(&command_line())
}
