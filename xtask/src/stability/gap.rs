//! Coarse grains through a slot of the wall: what flows against the slot's width in coarse diameters.

use super::Sheet;
use crate::validate::lab::Draw;
use crate::validate::wca::{GAMMA, coke, grain};
use glam::DVec2;
use std::fmt::Write as _;
use std::sync::Arc;
use tsubu_coarsen::{Level, Renormalised, coarsen};
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_engine::{Body, Lanes, NoTally, OneKind, Placed, Setup, TouchesAt, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Motion, Plane, Still, View};
use tsubu_picture::Figure;
use tsubu_sdf::Cuboid;

/// E is divided by this; the heaps here are a few centimetres high.
const SOFTEN: f64 = 1000.0;
const GRAVITY: f64 = 9.80665;
/// Layers of grains above the slot at the start.
const LAYERS: u32 = 24;
/// Width of the box beyond the slot, in diameters.
const BESIDE: f64 = 12.0;
/// Slots in diameters of the coarse grain.
const SLOTS: [f64; 10] = [0.9, 1.05, 1.25, 1.5, 2.0, 3.0, 4.0, 6.0, 9.0, 12.0];
/// Coarse levels.
const LEVELS: [u32; 3] = [2, 3, 4];
/// Starts that are averaged.
const SEEDS: u64 = 3;
/// Diameters lost at the rim of a slot (Beverloo's k).
const RIM: f64 = 1.4;
/// Free fall times √(d/g) after which a slot that has let nothing through is shut.
const PATIENCE: f64 = 60.0;

type Bin = World<Plane, Still, OneKind, Repulsion, RepulsiveWall, NoTally>;

/// A box that repeats sideways with a slot of `width` m in its floor, filled.
fn bin(kind: Kind, law: Repulsion, width: f64, seed: u64) -> Result<Bin, String> {
    let d = kind.diameter();
    let length = width + BESIDE * d;
    let wall = RepulsiveWall {
        grains: law,
        restitution: Some(0.5),
        friction: 0.413,
    };
    let shelf = |name: &str, from: f64, to: f64| -> Result<Body<Plane, RepulsiveWall>, String> {
        let block = Cuboid::<Plane>::new(DVec2::new(from, -2.0 * d), DVec2::new(to, 0.0));
        Ok(Body {
            name: name.into(),
            surface: Arc::new(block.map_err(|e| e.to_string())?),
            law: wall,
            touches_at: TouchesAt::Surface,
            removed_at: None,
            motion: Motion::default(),
            waits: false,
        })
    };
    let left = 0.5 * (length - width);
    // Both reach beyond the period, so that a grain at its edge feels the other's side.
    let bodies = vec![
        shelf("left shelf", -3.0 * d, left)?,
        shelf("right shelf", left + width, length + 3.0 * d)?,
    ];
    let columns = (length / (1.1 * d)).floor();
    let pitch = length / columns;
    let mut draw = Draw(seed);
    let mut grains = Vec::new();
    for layer in 0..LAYERS {
        for column in 0..columns as u32 {
            let shake = 0.04 * d;
            let x = (f64::from(column) + 0.25 + 0.5 * f64::from(layer % 2)) * pitch;
            let jitter = DVec2::new(draw.next() - 0.5, draw.next() - 0.5) * shake;
            grains.push(Placed {
                position: DVec2::new(x, (0.6 + 1.06 * f64::from(layer)) * d) + jitter,
                velocity: DVec2::ZERO,
                kind: 0,
            });
        }
    }
    let period = 2.0 * std::f64::consts::PI * (0.5 * kind.mass / law.stiffness()).sqrt();
    Ok(World::new(Setup {
        kinds: OneKind([kind]),
        law,
        bodies,
        domain: Domain {
            period: DVec2::new(length, f64::INFINITY),
        },
        gravity: DVec2::NEG_Y * GRAVITY,
        scheme: Scheme::SymplecticEuler,
        dt: period / 20.0,
        skin: None,
        lanes: Lanes::best(),
        pool: None,
        grains,
        gates: Vec::new(),
    }))
}

/// Grains per second through the slot while the second to the fifth tenth of them pass; 0 if it is shut.
fn rate(kind: Kind, law: Repulsion, width: f64, seed: u64) -> Result<f64, String> {
    let mut world = bin(kind, law, width, seed)?;
    let d = kind.diameter();
    let (all, fall) = (world.len() as f64, (d / GRAVITY).sqrt());
    let mut times = [f64::NAN; 2];
    let look = (0.1 * fall / world.dt()).max(1.0) as u64;
    loop {
        world.advance(look);
        if !world.health().is_fine() {
            return Err(format!("a slot of {width} m: {:?}", world.health()));
        }
        let below = (0..world.len())
            .filter(|&i| world.position(i).y < -2.0 * d)
            .count() as f64;
        for (time, share) in times.iter_mut().zip([0.1, 0.4]) {
            if time.is_nan() && below >= share * all {
                *time = world.now();
            }
        }
        if times[1].is_finite() {
            return Ok(0.3 * all / (times[1] - times[0]));
        }
        // What has not let a tenth through by then is not going to.
        if times[0].is_nan() && world.now() > PATIENCE * fall {
            return Ok(0.0);
        }
        if world.now() > 10.0 * PATIENCE * fall {
            return Ok(0.0);
        }
    }
}

/// The map.
pub fn run(sheet: &Sheet) -> Result<bool, String> {
    let refused = |e: tsubu_coarsen::TooCoarse| e.to_string();
    let mut csv =
        "level,slot over coarse diameter,flow over sqrt(g) D^1.5 (grains' area),standard error of 3 starts\n".to_owned();
    let mut figure = Figure::new(
        "Coarse grains through a slot, in the plane",
        "slot over the coarse diameter, D/λd (–)",
        "area that flows over √g D^1.5 (–)",
    )
    .log_x();
    let mut widest: f64 = 0.0;
    for level in LEVELS {
        let soft = coke(GAMMA).softened(SOFTEN, 1.0 / SOFTEN.sqrt(), 1.0 / SOFTEN.sqrt());
        let law = coarsen(&Renormalised, &soft, Level::new(level)).map_err(refused)?;
        let kind = coarsen(&Renormalised, &grain(), Level::new(level)).map_err(refused)?;
        let d = kind.diameter();
        let (mut flows, mut errors) = (Vec::new(), Vec::new());
        for slot in SLOTS {
            let flow = |seed: u64| -> Result<f64, String> {
                let grains = rate(kind, law, slot * d, seed)?;
                let area = grains * 0.25 * std::f64::consts::PI * d * d;
                Ok(area / (GRAVITY.sqrt() * (slot * d).powf(1.5)))
            };
            let tries: Vec<f64> = (1..=SEEDS).map(flow).collect::<Result<_, _>>()?;
            let n = SEEDS as f64;
            let flow = tries.iter().sum::<f64>() / n;
            let scatter = tries.iter().map(|f| (f - flow).powi(2)).sum::<f64>();
            let error = (scatter / (n * (n - 1.0))).sqrt();
            println!("n = {level}, D = {slot} d': {flow:.3} ± {error:.3}");
            let _ = writeln!(csv, "{level},{slot},{flow:?},{error:?}");
            errors.push(error);
            flows.push(flow);
        }
        widest = widest.max(flows[SLOTS.len() - 1]);
        figure = figure.points(
            &format!("n = {level}, d' = {:.1} mm", d * 1e3),
            &SLOTS,
            &flows,
            Some(&errors),
        );
    }
    let slots: Vec<f64> = (0..100)
        .map(|k| 0.9 * (12.0f64 / 0.9).powf(f64::from(k) / 99.0))
        .collect();
    let last = SLOTS[SLOTS.len() - 1];
    let share = |slot: f64| (1.0 - RIM / slot).max(0.0).powf(1.5);
    let beverloo: Vec<f64> = slots
        .iter()
        .map(|&slot| widest * share(slot) / share(last))
        .collect();
    figure = figure.theory(
        "Beverloo: (1 − 1.4 λd/D)^1.5, through the widest slot",
        &slots,
        &beverloo,
    );
    sheet.write("gap", figure, &csv)?;
    Ok(true)
}
