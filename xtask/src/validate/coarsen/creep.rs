//! Creep: the viscosity that the grains' damping gives to a packing, ×λ under renormalisation.
//!
//! A bar of face-centred cubic grains, a little compressed and periodic, rings in one transverse wave
//! of fixed length. Its layers obey m v̇ = 4γ(v₊ + v₋ − 2v) + elastic, so the wave's energy decays at
//! Γ = 16 (γ/m) sin²(π/N) with N layers to a wave: η_eff q²/ρ with η_eff = 2√2 γ/d for a fine lattice.
//! Elastic forces only make it ring; the decay is that of the damping alone. The lattice is exact, has
//! no noise, and its motion is the affine shear in which a heap creeps.

use super::{level, rules};
use crate::validate::check::Tolerance;
use crate::validate::collision::order::slope;
use crate::validate::lab::Lab;
use crate::validate::report::Report;
use crate::validate::wca::Wca;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tsubu_coarsen::CoarseRule;
use tsubu_integrate::Scheme;
use tsubu_model::View;
use tsubu_picture::Figure;

const ZETA: f64 = 0.0347;
/// Layers to a wave at n = 3.
const COARSEST: u32 = 12;

/// Γ in 1/s measured and by the formula.
fn decay(rule: &dyn CoarseRule, n: u32) -> Result<(f64, f64), String> {
    let coarse = level(rule, 1.0, ZETA, 20.0, n)?;
    let layers = COARSEST << (3 - n);
    let range = Wca::of(&coarse.law).range();
    let cell = 2f64.sqrt() * range * (1.0 - 1e-3);
    let height = 0.5 * cell * f64::from(layers);
    let mut lab = Lab::new(
        coarse.kind,
        coarse.law,
        Scheme::VerletAveraged { sweeps: 4 },
        coarse.dt,
    );
    lab.period = DVec3::new(3.0 * cell, 3.0 * cell, height);
    for k in 0..layers {
        let speed = 1e-4 * (TAU * (f64::from(k) + 0.5) / f64::from(layers)).sin();
        for j in 0..6 {
            for i in (0..6).filter(|i| (i + j + k) % 2 == 0) {
                let place = DVec3::new(f64::from(i) + 0.5, f64::from(j) + 0.5, f64::from(k) + 0.5)
                    * (0.5 * cell);
                lab = lab.grain(place, DVec3::X * speed);
            }
        }
    }
    let expected = 16.0 * coarse.law.tangential_damping / coarse.kind.mass
        * (PI / f64::from(layers)).sin().powi(2);
    // Thirty looks until the energy of the wave has fallen by e².
    let stride = ((2.0 / (expected * coarse.dt) / 30.0).ceil() as u64).max(1);
    let mut world = lab.world();
    let mut wave = Vec::new();
    for _ in 0..30 {
        world.advance(stride);
        let part = |i: usize| world.velocity(i).x * (TAU * world.position(i).z / height).sin();
        wave.push((0..world.len()).map(part).sum::<f64>());
    }
    let product =
        product_of_roots(&wave).ok_or("the wave of the creep check is not a damped oscillation")?;
    Ok((-product.ln() / (stride as f64 * coarse.dt), expected))
}

/// Prony's method: a damped oscillation obeys a₊ = s a − p a₋, p = exp(−Γτ); least squares for s and p.
fn product_of_roots(wave: &[f64]) -> Option<f64> {
    let (mut aa, mut ab, mut bb, mut ac, mut bc) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for w in wave.windows(3) {
        let (b, a, c) = (-w[0], w[1], w[2]);
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ac += a * c;
        bc += b * c;
    }
    let p = (aa * bc - ab * ac) / (aa * bb - ab * ab);
    (p > 0.0 && p < 1.0).then_some(p)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let mut figure = Figure::new(
        "Creep: decay of one shear wave",
        "λ (–)",
        "decay rate (1/s)",
    )
    .log_x()
    .log_y();
    for (number, rule) in rules(ZETA)?.iter().enumerate() {
        let (mut lambda, mut rate, mut theory) = (Vec::new(), Vec::new(), Vec::new());
        // The real grain is the same under every rule.
        for n in u32::from(number > 0)..=3 {
            let (got, expected) = match decay(rule.as_ref(), n) {
                Ok(both) => both,
                Err(refused) => {
                    report.progress(&refused);
                    continue;
                }
            };
            let what = format!("decay of a shear wave (1/s), {}, n = {n}", rule.name());
            if number == 0 {
                let note =
                    "closed form of the lattice; the step's own error is (ωΔt)²/12 = 0.8 % at most";
                report.check(what, expected, got, Tolerance::Relative(0.01), note);
            } else {
                report.beside(what, expected, got, "");
            }
            lambda.push(2f64.powi(n as i32));
            rate.push(got);
            theory.push(expected);
        }
        let power = slope(&lambda, &rate);
        if number == 0 {
            let note = "×λ; sin²(π/N) of the 12 layers at n = 3 takes 0.011 of the power";
            report.check(
                "power of λ of the creep viscosity, Renormalised",
                1.0,
                power,
                Tolerance::Absolute(0.03),
                note,
            );
        } else {
            report.tell(
                format!("power of λ of the creep viscosity, {}", rule.name()),
                power,
                "",
            );
        }
        figure = figure
            .theory("16 (γ'/m') sin²(π/N)", &lambda, &theory)
            .points(rule.name(), &lambda, &rate, None);
    }
    report.figure("coarsen_creep", figure)
}
