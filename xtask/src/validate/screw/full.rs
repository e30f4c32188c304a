//! The feeder with the paper's 200 000 grains at 100 r/min, on two threads: about two hours.

use super::TUBE;
use super::runs::Case;
use crate::validate::kept::Measured;
use crate::validate::report::Report;
use crate::validate::scenes::changed;
use std::path::Path;

/// The shipped scene.
pub const SCENE: &str = "scenarios/screw_feeder_full.ron";

/// What the run measured, from the folder of finished runs or run now, beside the feeder with a seventh of the grains.
pub fn run(
    report: &mut Report,
    root: &Path,
    print: u64,
    small: &Measured,
) -> Result<Measured, String> {
    let until = Case::of(4, 100.0).until();
    let file = root.join(format!(
        "target/validate/screw/{print:016x}-full-100rpm-{until:.2}s.csv"
    ));
    let full = match Measured::kept(&file) {
        Some(measured) => measured,
        None => {
            eprintln!("  200 000 grains at 100 r/min …");
            let sets = [format!("time.until={until} s")];
            Measured::of_run(&changed(&root.join(SCENE), &sets)?, &file, None, 2)?
        }
    };
    let ((a, da), (b, db)) = (small.get(TUBE), full.get(TUBE));
    report.tell(
        "200 000 grains at 100 r/min: rate in the tube over that of the default scene",
        b / a,
        &format!("± {:.3}", b / a * (da / a).hypot(db / b)),
    );
    Ok(full)
}
