//! An impact at n = 1, 2, 3 under `Renormalised` is that at n = 0 scaled: the law goes through the rule by its quantities alone.

use super::impact::Impact;
use super::theory::{Hertz, Material, material};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_coarsen::{CoarseRule, Level, Renormalised, coarsen};
use tsubu_contact::HertzMindlin;

const BALL: Material = material(3.0, 0.3, 1400.0);
const OTHER: Material = material(70.0, 0.22, 2500.0);

/// What an oblique impact comes to, in numbers that the rule keeps: normal and tangential speed over that of the impact, spin × d over
/// it, duration over λ, overlap over d, steps of contact.
fn numbers(n: u32, ratio: Option<f64>) -> Result<[f64; 6], String> {
    let level = Level::new(n);
    let words = |e: tsubu_coarsen::TooCoarse| e.to_string();
    let (fine, partner) = (
        BALL.sphere(1e-3),
        ratio.map(|ratio| OTHER.sphere(ratio * 1e-3)),
    );
    let law = HertzMindlin::between(&BALL.elastic, &OTHER.elastic, 0.6, 0.3);
    let lasts = Hertz::of((&fine, &BALL.elastic), (partner.as_ref(), &OTHER.elastic)).duration(1.0);
    let ball = coarsen(&Renormalised, &fine, level).map_err(words)?;
    let partner = partner
        .map(|kind| coarsen(&Renormalised, &kind, level))
        .transpose()
        .map_err(words)?;
    let law = coarsen(&Renormalised, &law, level).map_err(words)?;
    let lambda = level.lambda();
    let mut impact = Impact::new(law, ball, DVec3::new(0.7, 0.2, -1.0), lasts, 200.0).on(partner);
    impact.dt *= Renormalised.step_factor(lambda);
    let got = impact
        .run()
        .ok_or_else(|| format!("{level}: the spheres do not part"))?;
    Ok([
        got.velocity.z,
        got.velocity.x,
        got.after[0].spin.y * ball.diameter(),
        got.duration / lambda,
        got.deepest / ball.diameter(),
        got.touching as f64,
    ])
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    for (words, ratio) in [
        ("wall", None),
        ("sizes 1:1", Some(1.0)),
        ("sizes 1:5", Some(5.0)),
    ] {
        let fine = numbers(0, ratio)?;
        for n in 1..=3 {
            let coarse = numbers(n, ratio)?;
            let names = [
                "restitution",
                "tangential speed",
                "spin × d",
                "duration over λ",
                "overlap over d",
                "steps of contact",
            ];
            for (k, what) in names.into_iter().enumerate() {
                report.check(
                    format!("Renormalised, n = {n}, {words}: {what}"),
                    fine[k],
                    coarse[k],
                    Tolerance::Relative(1e-9),
                    "exactly similar; √λ rounds where n is odd",
                );
            }
        }
    }
    Ok(())
}
