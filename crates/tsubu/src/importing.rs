//! `tsubu import`: what another engine computed of a scene is measured, drawn and filmed as a run here is.

use crate::arguments::{ImportWish, LanesWish, MachineWish, SceneWish};
use crate::ending::{self, Pictures};
use crate::figures;
use crate::outputs::Outputs;
use crate::run::{choices, command_line, read, stem};
use crate::trouble::Trouble;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use tsubu::assemble::{Choices, Moment, build};
use tsubu::dump::{Dump, DumpMoment};
use tsubu::export::RELEASED;
use tsubu::record::{RunFolder, write_whole};

/// The type of the grains in a deck of ours; other types are those of walls.
const GRAINS: u32 = 1;

/// `tsubu import`.
pub fn import(wish: &ImportWish) -> Result<u8, Trouble> {
    let scene = SceneWish {
        scene: wish.scene.clone(),
        set: wish.set.clone(),
        until: None,
        machine: MachineWish {
            threads: None,
            lanes: LanesWish(None),
        },
        // Who computed the moments chose the step.
        allow_unstable: true,
    };
    let dump = &wish.dump;
    let here = |what: String| Trouble::Arguments(format!("{}: {what}", dump.display()));
    let file = File::open(dump).map_err(|e| here(format!("cannot be opened: {e}")))?;
    let mut moments = Dump::new(BufReader::with_capacity(1 << 20, file));
    let mut next = || moments.next().transpose().map_err(|e| here(e.to_string()));
    let released = match wish.released {
        Some(step) => Some(step),
        None => released_beside(dump)?,
    };
    let checked = read(&scene)?;
    let built = build(
        &checked,
        &Choices {
            allow_unstable: true,
            ..choices(&scene, wish.out.as_deref())
        },
    )?;
    let (mut run, plan) = (built.simulation, built.plan);
    if checked.scene.waits_for_stillness() && released.is_none() {
        tell!(
            "note: the scene waits for the grains to be still, and no {RELEASED} beside the dump says when they were; give the step with --released"
        );
    }
    let Some(first) = next()? else {
        return Err(here("holds no moment".into()));
    };
    let folder = RunFolder::create(wish.out.as_deref(), &stem(&scene), wish.force)?;
    write_whole(
        &folder.path("scene.resolved.ron"),
        checked.scene.to_resolved_ron().as_bytes(),
    )?;
    folder.make("figures")?;
    let output = checked.scene.output;
    let (mut count, mut last) = (0usize, None);
    let mut outputs: Option<Outputs> = None;
    let mut moment = Some(first);
    while let Some(dumped) = moment {
        if last.is_some_and(|step| step >= dumped.step) {
            return Err(here(format!(
                "step {} comes after step {}: moments have to come in order, each once",
                dumped.step,
                last.unwrap_or_default()
            )));
        }
        last = Some(dumped.step);
        run.show(&shown(&dumped, released).map_err(here)?);
        match &mut outputs {
            Some(outputs) => outputs.moment(&mut *run)?,
            None => outputs = Some(Outputs::start(&folder, &output, &plan, &mut *run)?),
        }
        count += 1;
        moment = next()?;
    }
    let Some(outputs) = outputs else { return Ok(0) };
    let film = match outputs.film() {
        Some(film) => film.draw(&folder, run.released_at())?,
        None => None,
    };
    let rows = outputs.rows();
    let pictures = Pictures {
        film: film.map(|drawn| drawn.0),
        figures: figures::draw(&folder, &*run, rows, &command_line())?,
    };
    let scene = &checked.scene;
    let summary = ending::summary(&folder, scene, &plan, &*run, rows, None, "imported")?;
    outputs.finish()?;
    say!(
        "{}\n{count} moments up to t = {:.4} s, {} grains; results in {}{}",
        ending::result(&summary),
        run.time(),
        run.grains(),
        folder.root().display(),
        pictures.listed()
    );
    Ok(0)
}

/// A moment of a dump as the scene knows it: its grains from 0 on.
fn shown(dumped: &DumpMoment, released: Option<u64>) -> Result<Moment, String> {
    let grains = dumped.atoms.iter().filter(|atom| atom.kind == GRAINS);
    let grain = |atom: &tsubu::dump::Atom| {
        let identity = atom.id.checked_sub(1).and_then(|id| u32::try_from(id).ok());
        let identity = identity.ok_or_else(|| format!("no grain has the id {}", atom.id))?;
        Ok((identity, atom.position, atom.velocity))
    };
    Ok(Moment {
        steps: dumped.step,
        released,
        grains: grains.map(grain).collect::<Result<_, String>>()?,
    })
}

/// The step that a deck of ours leaves beside its dump once the grains are still.
fn released_beside(dump: &Path) -> Result<Option<u64>, Trouble> {
    let file = dump.with_file_name(RELEASED);
    let Ok(text) = std::fs::read_to_string(&file) else {
        return Ok(None);
    };
    match text.trim().parse() {
        Ok(step) => Ok(Some(step)),
        Err(_) => Err(Trouble::Arguments(format!(
            "{}: expected one step, found `{}`\nhelp: mend the file, or give the step with --released",
            file.display(),
            text.trim()
        ))),
    }
}
