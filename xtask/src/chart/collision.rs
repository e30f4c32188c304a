//! Single collisions and a small packing: error against instructions, scheme by scheme.
//!
//! Instructions are counted by callgrind (`valgrind`, which must be there), so that the chart repeats.

use super::draw::{save, table};
use super::front::Point;
use crate::validate::collision::pair::head_on;
use crate::validate::lab::{Draw, Lab, name};
use crate::validate::wca::{Wca, coke, grain};
use glam::DVec3;
use std::path::Path;
use std::process::Command;
use tsubu_integrate::Scheme;
use tsubu_model::View;
use tsubu_picture::Figure;

/// The name of the command that callgrind looks at.
pub const COUNTED: &str = "counted-steps";

const SCHEMES: [Scheme; 7] = [
    Scheme::SymplecticEuler,
    Scheme::VerletOld,
    Scheme::VerletAveraged { sweeps: 1 },
    Scheme::VerletAveraged { sweeps: 2 },
    Scheme::VerletAveraged { sweeps: 4 },
    Scheme::DashpotImplicit { sweeps: 2 },
    Scheme::DashpotImplicit { sweeps: 4 },
];
/// Steps per period of the pair, Δt/T = 1/10 … 1/100.
const STEPS: [f64; 8] = [10.0, 14.0, 20.0, 28.0, 40.0, 57.0, 80.0, 100.0];
/// Damping ratio of a pair: stiff coke, and ten times that.
const ZETA: [f64; 2] = [0.035, 0.35];
const PHASES: u32 = 64;
const SPEED: f64 = 0.1;
/// Grains along an edge of the packing.
const EDGE: usize = 4;

fn pair_mass() -> f64 {
    0.5 * grain().mass
}

fn damping(zeta: f64) -> f64 {
    2.0 * zeta * (Wca::of(&coke(0.0)).edge_stiffness() * pair_mass()).sqrt()
}

fn period() -> f64 {
    Wca::of(&coke(0.0)).period(pair_mass())
}

/// Root mean square error of the restitution over the phases of first touch, over the restitution, and its standard error.
fn of_collision(scheme: Scheme, zeta: f64, steps: f64) -> (f64, f64) {
    let law = coke(damping(zeta));
    let exact = Wca::of(&law).restitution(pair_mass(), damping(zeta), SPEED);
    let squares: Vec<f64> = (0..PHASES)
        .map(|k| {
            let phase = (f64::from(k) + 0.5) / f64::from(PHASES);
            let got = head_on(grain(), &law, scheme, period() / steps, SPEED, phase);
            let e = got.map_or(f64::NAN, |r| r.restitution);
            (e / exact - 1.0).powi(2)
        })
        .collect();
    let n = f64::from(PHASES);
    let mean = squares.iter().sum::<f64>() / n;
    let scatter = squares.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (n * (n - 1.0));
    (mean.sqrt(), scatter.sqrt() / (2.0 * mean.sqrt()))
}

/// A cubic lattice pressed by its own periods, its grains set in motion at random, so slowly that contacts stay closed.
fn lattice(scheme: Scheme, zeta: f64, steps: f64) -> Lab {
    let law = coke(damping(zeta));
    let pitch = 0.999 * Wca::of(&law).range();
    let mut lab = Lab::new(grain(), law, scheme, period() / steps);
    lab.period = DVec3::splat(EDGE as f64 * pitch);
    let mut draw = Draw(3);
    for k in 0..EDGE.pow(3) {
        let site = [k % EDGE, k / EDGE % EDGE, k / EDGE / EDGE];
        let place = DVec3::from_array(site.map(|i| (i as f64 + 0.5) * pitch));
        let velocity = DVec3::new(draw.normal(), draw.normal(), draw.normal());
        // 1e-5 of the range in a period.
        lab = lab.grain(place, velocity * (1e-5 * pitch / period()));
    }
    lab
}

/// Displacements of the packing after one period of a pair.
fn displaced(scheme: Scheme, zeta: f64, steps: f64) -> Vec<DVec3> {
    let lab = lattice(scheme, zeta, steps);
    let start: Vec<DVec3> = lab.grains.iter().map(|g| g.0).collect();
    let mut world = lab.world();
    world.advance(steps as u64);
    let mut moved = vec![DVec3::ZERO; start.len()];
    for i in 0..start.len() {
        let who = world.identity(i) as usize;
        moved[who] = world.position(i) - start[who];
    }
    moved
}

/// Error of the displacements against those of a step of a 4000th of the period, root mean square over their own.
fn of_packing(scheme: Scheme, zeta: f64, steps: f64, truth: &[DVec3]) -> f64 {
    let got = displaced(scheme, zeta, steps);
    let square = |v: &mut dyn Iterator<Item = DVec3>| v.map(|x| x.length_squared()).sum::<f64>();
    let off = square(&mut got.iter().zip(truth).map(|(a, b)| *a - *b));
    (off / square(&mut truth.iter().copied())).sqrt()
}

/// What callgrind is asked to count: so many steps of the packing.
pub fn counted(scheme: usize, steps: u64) -> Result<bool, String> {
    let scheme = SCHEMES.get(scheme).ok_or("there is no such scheme")?;
    let mut world = lattice(*scheme, ZETA[0], 20.0).world();
    world.advance(steps);
    Ok(world.health().is_fine())
}

/// Instructions per step and grain of each scheme on the packing.
fn instructions(root: &Path) -> Result<Vec<f64>, String> {
    let own = std::env::current_exe().map_err(|e| e.to_string())?;
    let count = |scheme: usize, steps: u64| -> Result<f64, String> {
        let out = root.join(format!("target/chart/callgrind-{scheme}-{steps}"));
        std::fs::create_dir_all(root.join("target/chart")).map_err(|e| e.to_string())?;
        let done = Command::new("valgrind")
            .arg("--tool=callgrind")
            .arg(format!("--callgrind-out-file={}", out.display()))
            .arg(&own)
            .args([COUNTED, &scheme.to_string(), &steps.to_string()])
            .output()
            .map_err(|e| {
                format!("valgrind does not start ({e}); install it (apt-get install valgrind)")
            })?;
        let text = std::fs::read_to_string(&out).map_err(|e| format!("{}: {e}", out.display()))?;
        let line = text
            .lines()
            .find_map(|l| l.strip_prefix("summary: ").or(l.strip_prefix("totals: ")))
            .filter(|_| done.status.success());
        line.and_then(|l| l.trim().parse().ok()).ok_or_else(|| {
            format!(
                "callgrind counted nothing: {}",
                String::from_utf8_lossy(&done.stderr)
            )
        })
    };
    let grains = EDGE.pow(3) as f64;
    (0..SCHEMES.len())
        .map(|scheme| Ok((count(scheme, 600)? - count(scheme, 200)?) / (400.0 * grains)))
        .collect()
}

/// Both charts, and who errs least at equal cost.
pub fn run(root: &Path) -> Result<bool, String> {
    let cost = instructions(root)?;
    for (scheme, cost) in SCHEMES.iter().zip(&cost) {
        println!(
            "{}: {cost:.0} instructions a grain and step (vector path without AVX-512)",
            name(*scheme)
        );
    }
    for zeta in ZETA {
        // A contact lasts half a period.
        let collision = points(&cost, 0.5, |scheme, steps| {
            of_collision(scheme, zeta, steps)
        });
        let title = format!("Restitution of a pair, ζ = {zeta}, 64 phases of first touch");
        let file = format!("collision_{zeta}");
        let figure = by_scheme(
            &title,
            "instructions a grain and contact (–)",
            "error of one collision's restitution (–)",
            &collision,
        );
        save(root, "collision", &file, figure)?;
        table(root, "collision", &file, &collision)?;
        say_who_is_best(&format!("restitution, ζ = {zeta}"), &collision);
        let truth = displaced(Scheme::VerletAveraged { sweeps: 4 }, zeta, 4000.0);
        let packing = points(&cost, 1.0, |scheme, steps| {
            (of_packing(scheme, zeta, steps, &truth), 0.0)
        });
        let title = format!("Displacements in a pressed packing after a period, ζ = {zeta}");
        let file = format!("packing_{zeta}");
        let figure = by_scheme(
            &title,
            "instructions a grain and period (–)",
            "error of the displacements (–)",
            &packing,
        );
        save(root, "collision", &file, figure)?;
        table(root, "collision", &file, &packing)?;
        say_who_is_best(&format!("packing, ζ = {zeta}"), &packing);
    }
    Ok(true)
}

/// A curve for each scheme, from T/10 to T/100. What a step over its limit makes is left out.
fn by_scheme(title: &str, cost: &str, error: &str, points: &[Point]) -> Figure {
    let mut figure = Figure::new(title, cost, error).log_x().log_y();
    for (scheme, points) in SCHEMES.iter().zip(points.chunks(STEPS.len())) {
        let stable = points.iter().filter(|p| p.error < 1.0);
        let (mut x, mut y, mut e) = (Vec::new(), Vec::new(), Vec::new());
        for p in stable {
            x.push(p.cost);
            y.push(p.error);
            e.push(p.uncertainty);
        }
        figure = figure
            .line(&name(*scheme), &x, &y)
            .points(&name(*scheme), &x, &y, Some(&e));
    }
    figure
}

fn points(cost: &[f64], periods: f64, error: impl Fn(Scheme, f64) -> (f64, f64)) -> Vec<Point> {
    let mut points = Vec::new();
    for (scheme, cost) in SCHEMES.iter().zip(cost) {
        for steps in STEPS {
            let (error, uncertainty) = error(*scheme, steps);
            points.push(Point {
                name: format!("{}, T/{steps}", name(*scheme)),
                gives_up: String::new(),
                cost: cost * steps * periods,
                error,
                uncertainty,
                is_default: *scheme == Scheme::SymplecticEuler && steps == 20.0,
            });
        }
    }
    points
}

/// The error of each scheme at the cost of the default at each of its steps, by interpolation between the scheme's own.
fn say_who_is_best(what: &str, points: &[Point]) {
    let of = |k: usize| &points[k * STEPS.len()..(k + 1) * STEPS.len()];
    let at = |k: usize, cost: f64| -> Option<f64> {
        let two = of(k)
            .windows(2)
            .find(|two| (two[0].cost..=two[1].cost).contains(&cost))?;
        let share = (cost / two[0].cost).ln() / (two[1].cost / two[0].cost).ln();
        Some(two[0].error * (two[1].error / two[0].error).powf(share))
    };
    for (steps, default) in STEPS.iter().zip(of(0)) {
        let others = (0..SCHEMES.len()).filter_map(|k| Some((k, at(k, default.cost)?)));
        if let Some((best, error)) = others.min_by(|a, b| a.1.total_cmp(&b.1)) {
            println!(
                "{what}: at the cost of SymplecticEuler at T/{steps} ({:.4}) the least error is {error:.4}, of {}",
                default.error,
                name(SCHEMES[best])
            );
        }
    }
    println!();
}
