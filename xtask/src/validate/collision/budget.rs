//! The energy budget of a small pile that collapses: everything lost is summed, nothing is inferred.

use crate::validate::check::Tolerance;
use crate::validate::lab::{Draw, Lab, name};
use crate::validate::report::Report;
use crate::validate::wca::{GAMMA, Wca, coke, grain};
use glam::DVec3;
use tsubu_integrate::Scheme;
use tsubu_model::View;
use tsubu_picture::Figure;

/// Softening of the law: E over so much, γ over its root, so that ζ and e stay.
const SOFTEN: f64 = 1e4;

/// A block of `counts` grains on the floor z = 0, a little loose and uneven, moving a little, so that
/// it collapses; walls rub and rebound as in paper A. A wall stands at its left side.
pub fn block(counts: [usize; 3], scheme: Scheme, steps_per_period: f64) -> Lab {
    let root = 1.0 / SOFTEN.sqrt();
    let law = coke(GAMMA).softened(SOFTEN, root, root);
    let wca = Wca::of(&law);
    let dt = wca.period(0.5 * grain().mass) / steps_per_period;
    let mut lab = Lab::new(grain(), law, scheme, dt)
        .wall(DVec3::ZERO, DVec3::Z, Some(0.5), 0.413)
        .wall(DVec3::ZERO, DVec3::X, Some(0.5), 0.413);
    lab.gravity = DVec3::Z * -9.80665;
    let (pitch, mut draw) = (1.02 * wca.range(), Draw(7));
    for k in 0..counts[2] {
        for j in 0..counts[1] {
            for i in 0..counts[0] {
                let place = DVec3::new(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5) * pitch;
                let jitter =
                    DVec3::new(draw.next(), draw.next(), draw.next()) * (0.01 * wca.range());
                let velocity = DVec3::new(draw.normal(), draw.normal(), draw.normal()) * 0.02;
                lab = lab.grain(place + jitter, velocity);
            }
        }
    }
    lab
}

/// What the books miss, over what was lost, after the wall was taken away and the pile fell.
fn gap(scheme: Scheme, steps_per_period: f64) -> Result<f64, String> {
    let lab = block([6, 5, 10], scheme, steps_per_period);
    let dt = lab.dt;
    let mut world = lab.tallied();
    let before = world.energies().total();
    world.advance((0.03 / dt) as u64);
    world.remove_body(1);
    world.advance((0.12 / dt) as u64);
    if !world.health().is_fine() {
        return Err(format!(
            "the pile of the energy budget ran away: {:?}",
            world.health()
        ));
    }
    let e = world.energies();
    let lost = e.lost_damping + e.lost_wall_damping + e.lost_wall_friction + e.taken_by_removal;
    Ok((e.total() - before) / lost)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let steps_per_period = [20.0, 40.0, 80.0];
    let mut figure = Figure::new(
        "Energy budget of a collapsing pile",
        "steps per period (–)",
        "|missing| over lost (–)",
    )
    .log_x()
    .log_y();
    for scheme in [
        Scheme::SymplecticEuler,
        Scheme::VerletOld,
        Scheme::VerletAveraged { sweeps: 4 },
    ] {
        let mut gaps = Vec::new();
        for n in steps_per_period {
            gaps.push(gap(scheme, n)?.abs());
        }
        let scheme_name = name(scheme);
        let what = format!("energy missing over energy lost, 300 grains, T/20, {scheme_name}");
        report.check(
            what,
            0.01,
            gaps[0],
            Tolerance::AtMost,
            "1 % asked by the issue",
        );
        report.check(
            format!("  the same at T/80 over T/20, {scheme_name}"),
            0.5,
            gaps[2] / gaps[0],
            Tolerance::AtMost,
            "closer with Δt: first order at worst gives ¼; the collapse is chaotic, so ½",
        );
        figure = figure
            .points(&scheme_name, &steps_per_period, &gaps, None)
            .line(&scheme_name, &steps_per_period, &gaps);
    }
    report.figure("collision_budget", figure)
}
