//! The end of a run: the summary, and one paragraph for the person who waited.

use crate::keep::Spent;
use crate::rows::Rows;
use crate::trouble::Trouble;
use std::path::{Path, PathBuf};
use tsubu::assemble::{Plan, Simulation, Stop};
use tsubu::engine::Health;
use tsubu::record::{RunFolder, Summary};
use tsubu::scene::Scene;

/// What was drawn of a run.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// The animation.
    pub film: Option<PathBuf>,
    /// The figures, the most important first.
    pub figures: Vec<PathBuf>,
}

impl Pictures {
    /// The animation and the first figure, a line each.
    pub fn listed(&self) -> String {
        let mut text = String::new();
        if let Some(film) = &self.film {
            text += &format!("\n  animation  {}", film.display());
        }
        if let Some(figure) = self.figures.first() {
            text += &format!("\n  figure     {}", figure.display());
        }
        text
    }
}

/// Writes `summary.json`, and returns it. What was not stepped here has spent no time.
pub fn summary(
    folder: &RunFolder,
    scene: &Scene,
    plan: &Plan,
    run: &dyn Simulation,
    rows: &Rows,
    spent: Option<Spent>,
    ended: &str,
) -> Result<Summary, Trouble> {
    let mut summary = Summary::new();
    summary.text("title", &scene.title);
    summary.text("version", env!("CARGO_PKG_VERSION"));
    summary.text("ended", ended);
    for reading in run.report() {
        summary.measured(
            &reading.name,
            reading.value,
            reading.uncertainty,
            reading.unit,
        );
    }
    summary.plain("time", run.time(), "s");
    if let Some(released) = run.released_at() {
        summary.plain("released_at", released, "s");
    }
    summary.plain("steps", run.steps() as f64, "");
    summary.plain("step", plan.constants.dt, "s");
    summary.plain("grains", run.grains() as f64, "");
    let count = run.count();
    summary.plain("grains_inserted", count.inserted as f64, "");
    summary.plain("grains_deleted", count.deleted as f64, "");
    summary.plain("grains_lost", count.lost() as f64, "");
    summary.plain("spin", f64::from(u8::from(plan.constants.law.turns())), "");
    if let Some(spent) = spent {
        summary.plain("grain_steps_per_second", spent.rate(run), "1/s");
        summary.plain("wall_time", spent.wall.as_secs_f64(), "s");
    }
    summary.plain("bytes_per_grain", run.bytes_per_grain(), "B");
    summary.plain("threads", plan.threads as f64, "");
    summary.text("lanes", plan.lanes);
    summary.text("integrator", plan.constants.scheme.name());
    if plan.constants.scheme.sweeps() > 0 {
        summary.plain("solve_residual", run.solve_residual(), "m/s");
    }
    summary.list("sources", &plan.constants.sources);
    summary.table("series_units", &rows.units());
    summary.write(folder)?;
    Ok(summary)
}

/// The closing words of a run that reached its end, or of several with their means: `result` is its [`result`], `wall` the
/// seconds it took.
pub fn words(
    result: &str,
    summary: &Summary,
    wall: f64,
    lambda: f64,
    folder: &Path,
    pictures: &Pictures,
    scene_file: &Path,
) -> String {
    let number = |name: &str| summary.value(name).map_or(f64::NAN, |v| v.0);
    let threads = number("threads");
    let mut text = format!(
        "{result}\n{wall:.1} s of wall time, {:.1} million grain-steps/s on {threads} thread{}; results in {}",
        number("grain_steps_per_second") / 1e6,
        if threads == 1.0 { "" } else { "s" },
        folder.display()
    );
    text += &pictures.listed();
    let next = if summary.value("transport").is_some() {
        "water.shields=0.2".to_owned()
    } else {
        // A level up is sixteen times cheaper, a level down sixteen times dearer.
        let level = lambda.log2().round() as u32;
        let next = match summary.value("mass_rate") {
            Some(_) => level + 1,
            None if level > 2 => 2,
            None => 3,
        };
        format!("grains.coarse={next}")
    };
    text += &format!(
        "\nNext, try:  tsubu run {} --set {next}",
        scene_file.display()
    );
    text
}

/// The result in one sentence, with its error and beside the theory if there is one.
pub fn result(summary: &Summary) -> String {
    let find = |name: &str| summary.value(name);
    let measured = |name: &str| find(name).filter(|v| v.0.is_finite());
    let number = |name: &str| find(name).map_or(f64::NAN, |v| v.0);
    let give =
        |u: Option<f64>, digits: usize| u.map_or(String::new(), |u| format!(" ± {u:.digits$}"));
    if let Some((rate, error)) = find("mass_rate") {
        let theory = find("ratio_to_theory").map_or(String::new(), |(ratio, error)| {
            format!(
                ", {ratio:.3}{} of theory for a full screw (a = 1)",
                give(error, 3)
            )
        });
        let theory = find("ratio_to_beverloo").map_or(theory, |(ratio, error)| {
            format!(", {ratio:.3}{} of Beverloo's rate", give(error, 3))
        });
        // The share of the runs whose rate was steady.
        let steady = if number("steady") == 1.0 {
            ""
        } else {
            "; the rate was not steady yet: run longer with --until"
        };
        return format!(
            "Mass rate {rate:.3}{} kg/s{theory}{steady}.",
            give(error, 3)
        );
    }
    if let Some((transport, error)) = measured("transport") {
        let beside = measured("ratio_to_meyer_peter_mueller")
            .map_or(String::new(), |(ratio, error)| {
                format!(", {ratio:.2}{} of Meyer-Peter and Müller's", give(error, 2))
            });
        return format!(
            "Transport qB* = {transport:.3}{} at a Shields number of {:.3}{beside}.",
            give(error, 3),
            number("shields")
        );
    }
    match (measured("angle_of_repose"), find("released_at")) {
        (Some((angle, error)), Some((released, _))) => format!(
            "Angle of repose {angle:.1}{} deg, {:.2} s after the wall's removal; no theory gives it{}.",
            give(error, 1),
            number("time") - released,
            if number("spin") == 1.0 {
                ""
            } else {
                ": grains of this law creep, so the angle goes on falling"
            }
        ),
        _ => format!(
            "{} grains, {:.4} s of simulated time.",
            number("grains"),
            number("time")
        ),
    }
}

/// What to tell when the physics failed.
pub fn failure(stop: &Stop, plan: &Plan) -> String {
    let smaller = format!(
        "help: try a smaller step (now {:.3e} s, {:.0} per contact period), or a softer start; `tsubu check` shows the limits",
        plan.constants.dt,
        plan.constants.period / plan.constants.dt
    );
    let place = |p: &[f64; 3]| format!("({:.6}, {:.6}, {:.6}) m", p[0], p[1], p[2]);
    match stop {
        Stop::Over => "the run is over".to_owned(),
        Stop::NeverStill {
            time,
            agitation,
            asked,
        } => format!(
            "the grains were not still after {time:.3} s: kinetic energy per grain is {agitation:.2e} of m g d, the scene asks for {asked:.2e}\n\
             help: raise still.kinetic_energy or still.at_most"
        ),
        Stop::NoBed { time } => format!(
            "the water found no bed at t = {time:.3} s: no grain has as many contacts as it asks for\n\
             help: let the grains settle longer before it begins (water.begins), lower water.bed_contacts, or give water.datum"
        ),
        Stop::EnergyGrows {
            time,
            gained,
            moved,
            grain,
            place: at,
            speed,
        } => format!(
            "energy grows from nowhere: at t = {time:.6} s the grains hold {gained:.3e} J more than at the start, where {moved:.3e} J have moved; the fastest is grain {grain} with {speed:.3e} m/s, at {}\n{smaller}",
            place(at)
        ),
        Stop::UnstablePacking { time, used } => format!(
            "the step of {:.3e} s is over the limit of this packing: at t = {time:.3} s its stiffest motion uses {:.0} % of what the scheme bears\n\
             help: use a step below {:.3e} s (time.step), or --allow-unstable to see it fail",
            plan.constants.dt,
            100.0 * used,
            plan.constants.dt / used
        ),
        Stop::Trouble(Health::Runaway {
            grain,
            place: at,
            speed,
            time,
        }) => {
            format!(
                "grain {grain} ran away at t = {time:.6} s, at {}: its speed is {speed:.3e} m/s\n{smaller}",
                place(at)
            )
        }
        Stop::Trouble(Health::DeepOverlap {
            grain,
            partner,
            place: at,
            share,
            time,
        }) => format!(
            "grains {grain} and {partner} overlap by {:.0} % of their diameter at t = {time:.6} s, at {}: the law is not made for that\n\
             help: soften less (grains.soften), or lower the speed of impact",
            100.0 * share,
            place(at)
        ),
        Stop::Trouble(Health::Fine) => smaller,
    }
}
