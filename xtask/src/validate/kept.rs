//! Runs whose results are kept under `target/validate/`, so that the long version can be stopped and
//! taken up again. The name of a file holds a fingerprint of the physics, so a change of the code, of the scene or of
//! its meshes starts anew.

use crate::validate::scenes::{
    build_anyway, build_on, build_on_one_thread, keep, places, until_released,
};
use std::fmt::Write as _;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use tsubu_assemble::{Built, Simulation, Stop};
use tsubu_scene::Source;

/// Seconds of simulated time between two looks.
const LOOK: f64 = 0.01;

/// What a run measured: name, value, uncertainty (NaN if there is none).
#[derive(Clone, Debug)]
pub struct Measured(Vec<(String, f64, f64)>);

/// Where the grains are after a while, for runs that start there.
pub struct Flow {
    /// Seconds after the release.
    pub after: f64,
    /// A grain file.
    pub file: PathBuf,
}

impl Measured {
    /// Value and uncertainty by name; NaN if it was not measured.
    pub fn get(&self, name: &str) -> (f64, f64) {
        self.0
            .iter()
            .find(|r| r.0 == name)
            .map_or((f64::NAN, f64::NAN), |r| (r.1, r.2))
    }

    /// What is kept in a file; `None` if there is none that reads.
    pub fn kept(file: &Path) -> Option<Self> {
        read(&std::fs::read_to_string(file).ok()?)
    }

    /// Runs a scene to its end, looking every 10 ms of it, and keeps what it reports, and its flow if that is wanted.
    pub fn of_run(
        source: &Source,
        file: &Path,
        flow: Option<&Flow>,
        threads: usize,
    ) -> Result<Self, String> {
        let (measured, text, stop) = Self::of_built(build_on(source, threads)?, flow, LOOK)?;
        if let Some(stop) = stop {
            return Err(format!("{}: {stop:?}", file.display()));
        }
        keep(file, &text)?;
        Ok(measured)
    }

    /// The same without release and flow on one thread, looking so often, also where the step is over its limit: a run that
    /// breaks is kept with the reading `broken`.
    pub fn of_unstable_run(source: &Source, file: &Path, look: f64) -> Result<Self, String> {
        let (mut measured, mut text, stop) = Self::of_built(build_anyway(source)?, None, look)?;
        if stop.is_some() {
            measured.0.push(("broken".to_owned(), 1.0, f64::NAN));
            text.push_str("broken,1.0,NaN\n");
        }
        keep(file, &text)?;
        Ok(measured)
    }

    /// What a run measured, the same as text, and what stopped it before its end.
    fn of_built(
        built: Built,
        flow: Option<&Flow>,
        look: f64,
    ) -> Result<(Self, String, Option<Stop>), String> {
        let (mut run, dt) = (built.simulation, built.plan.constants.dt);
        let each = (look / dt).round() as u64;
        run.look();
        while !run.is_over() {
            let to_look = each - run.steps() % each;
            let to_flow = run
                .released_at()
                .zip(flow)
                .map_or(u64::MAX, |(start, flow)| {
                    ((start + flow.after - run.time()) / dt).round() as u64
                });
            run.advance(match to_flow {
                0 => to_look,
                _ => to_look.min(to_flow),
            });
            if let Some(flow) = flow.filter(|_| to_flow > 0 && to_flow <= to_look) {
                keep(&flow.file, &places(&*run))?;
            }
            if run.steps() % each == 0 {
                run.look();
            }
        }
        let stop = run.stop().filter(|stop| *stop != Stop::Over);
        let mut text = String::new();
        for reading in run.report() {
            let uncertainty = reading.uncertainty.unwrap_or(f64::NAN);
            let _ = writeln!(text, "{},{:?},{uncertainty:?}", reading.name, reading.value);
        }
        let measured = read(&text).ok_or_else(|| "the results do not read back".to_owned())?;
        Ok((measured, text, stop))
    }
}

fn read(text: &str) -> Option<Measured> {
    let line = |line: &str| {
        let mut words = line.split(',');
        Some((
            words.next()?.to_owned(),
            words.next()?.parse().ok()?,
            words.next()?.parse().ok()?,
        ))
    };
    text.lines()
        .map(line)
        .collect::<Option<Vec<_>>>()
        .map(Measured)
}

/// The bits of a scene, which is to be a cheap one, 16 000 steps after the start, or after the stillness that it waits for: they change with the
/// physics, the scene, its meshes and what is measured. A new rule for what is steady may not show so early: then the
/// folder of kept runs is to be emptied by hand.
pub fn fingerprint(source: &Source) -> Result<u64, String> {
    let waits = source
        .check()
        .map_err(|e| e.to_string())?
        .scene
        .waits_for_stillness();
    let mut run = build_on_one_thread(source)?.simulation;
    if waits {
        until_released(&mut *run)?;
    }
    for _ in 0..40 {
        run.advance(400);
        run.look();
    }
    Ok(bits_of(&mut *run))
}

/// The bits of a run as it is, and of what is measured of it.
pub fn bits_of(run: &mut dyn Simulation) -> u64 {
    let mut hasher = DefaultHasher::new();
    for (x, v) in run.state() {
        for value in x.to_array().into_iter().chain(v.to_array()) {
            value.to_bits().hash(&mut hasher);
        }
    }
    for reading in run.look().into_iter().chain(run.report()) {
        reading.value.to_bits().hash(&mut hasher);
    }
    hasher.finish()
}
