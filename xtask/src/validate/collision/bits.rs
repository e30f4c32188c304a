//! The same bits for any number of threads and on every vector path.

use super::budget::block;
use crate::validate::check::Tolerance;
use crate::validate::lab::name;
use crate::validate::report::Report;
use glam::DVec3;
use std::sync::Arc;
use tsubu_engine::Lanes;
use tsubu_integrate::Scheme;
use tsubu_model::View;

const STEPS: u64 = 200;

/// Positions and velocities by identity as bits, and how often the lists were built.
fn state(scheme: Scheme, lanes: Lanes, threads: Option<usize>) -> Result<(Vec<u64>, u64), String> {
    let mut lab = block([20, 12, 21], scheme, 20.0);
    lab.period = DVec3::new(f64::INFINITY, 12.0 * 1.02 * 1.350_4e-3, f64::INFINITY);
    lab.lanes = lanes;
    if let Some(threads) = threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        lab.pool = Some(Arc::new(
            pool.map_err(|e| format!("no pool of {threads} threads: {e}"))?,
        ));
    }
    let mut world = lab.world();
    world.advance(STEPS);
    if !world.health().is_fine() {
        return Err(format!(
            "the pile of the comparison of bits ran away: {:?}",
            world.health()
        ));
    }
    let mut all: Vec<(u32, [DVec3; 2])> = (0..world.len())
        .map(|i| (world.identity(i), [world.position(i), world.velocity(i)]))
        .collect();
    all.sort_by_key(|grain| grain.0);
    let numbers = all
        .iter()
        .flat_map(|(_, [x, v])| [x.x, x.y, x.z, v.x, v.y, v.z]);
    Ok((numbers.map(f64::to_bits).collect(), world.list_builds()))
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    for scheme in [
        Scheme::SymplecticEuler,
        Scheme::VerletAveraged { sweeps: 2 },
    ] {
        let (reference, builds) = state(scheme, Lanes::Portable, None)?;
        let what = format!(
            "lists built during {STEPS} steps of 5040 grains, {}",
            name(scheme)
        );
        report.check(
            what,
            3.0,
            builds as f64,
            Tolerance::AtLeast,
            "the comparison of bits must see rebuilds",
        );
        for lanes in Lanes::ALL.into_iter().filter(|lanes| lanes.is_here()) {
            let mut differing = 0;
            for threads in [None, Some(1), Some(2), Some(3)] {
                let (bits, _) = state(scheme, lanes, threads)?;
                differing += bits.iter().zip(&reference).filter(|(a, b)| a != b).count();
            }
            report.check(
                format!(
                    "numbers that differ from portable without threads: {}, 0–3 threads, {}",
                    lanes.name(),
                    name(scheme)
                ),
                0.0,
                f64::from(u32::try_from(differing).unwrap_or(u32::MAX)),
                Tolerance::Absolute(0.0),
                "the same bits: nothing else will do",
            );
        }
    }
    Ok(())
}
