//! Paper B's constants: the αcn at which an arrangement begins to grow, over αtn.
//!
//! Its constants come from the step, so Δt cancels: K = 2π²/αtn² and C = 2√2 π αcn/αtn of one grain.

use super::Sheet;
use crate::validate::stability::pressed::{Arrangement, Case, frequency, paper_b};
use std::f64::consts::{PI, SQRT_2};
use std::fmt::Write as _;
use tsubu_integrate::Scheme;
use tsubu_picture::Figure;

const TN: [f64; 8] = [4.0, 6.0, 10.0, 20.0, 40.0, 80.0, 160.0, 316.0];
const STEPS: u64 = 3000;
/// Measured and theory may differ by this.
const TOLERANCE: f64 = 0.01;

fn case(arrangement: Arrangement, sticks: bool, cn: f64) -> Case {
    Case {
        // The paper's scheme: the damping sees the old velocity.
        scheme: Scheme::SymplecticEuler,
        arrangement,
        contact: paper_b(cn, sticks),
    }
}

/// Δt√(k/m) = √K.
fn step(tn: f64) -> f64 {
    SQRT_2 * PI / tn / frequency()
}

/// Where `over` begins to hold between two values, by halving of their logarithm.
fn border(mut low: f64, mut high: f64, halvings: u32, over: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..halvings {
        let middle = (low * high).sqrt();
        if over(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    (low * high).sqrt()
}

/// αcn at the limit of the network; `None` if it grows without damping.
fn theory(arrangement: Arrangement, sticks: bool, tn: f64) -> Option<f64> {
    let over = |cn: f64| {
        let case = case(arrangement, sticks, cn);
        case.network().used(case.scheme, step(tn)) >= 1.0
    };
    (!over(1e-4)).then(|| border(1e-4, 1e3, 40, over))
}

/// αcn at which the engine begins to grow, near that of the theory.
fn found(arrangement: Arrangement, sticks: bool, tn: f64, near: f64) -> f64 {
    let over = |cn: f64| case(arrangement, sticks, cn).grows(step(tn), STEPS);
    let (low, high) = (0.85 * near, 1.15 * near);
    if over(low) || !over(high) {
        return f64::NAN;
    }
    border(low, high, 9, over)
}

/// The map.
pub fn run(sheet: &Sheet) -> Result<bool, String> {
    let arrangements = [
        ("a wall, rolling", Arrangement::Column(1), true),
        ("a pair, pressing", Arrangement::Pair, false),
        ("a pair, rolling", Arrangement::Pair, true),
        ("a column of 20, smooth", Arrangement::Column(20), false),
        ("hexagonal, smooth", Arrangement::Hexagonal, false),
        ("hexagonal, rolling", Arrangement::Hexagonal, true),
    ];
    let mut csv = "arrangement,alpha_tn,alpha_cn of the theory,alpha_cn found\n".to_owned();
    let mut figure = Figure::new(
        "Paper B's constants: lines theory, points found",
        "αtn, steps per period (–)",
        "αcn at which growth begins (–)",
    )
    .log_x()
    .log_y();
    let mut worst = 0.0f64;
    for (words, arrangement, sticks) in arrangements {
        let (mut x, mut line, mut points) = (Vec::new(), Vec::new(), Vec::new());
        for tn in TN {
            let Some(limit) = theory(arrangement, sticks, tn) else {
                let _ = writeln!(csv, "\"{words}\",{tn},0,");
                continue;
            };
            let got = found(arrangement, sticks, tn, limit);
            let off = (got / limit - 1.0).abs();
            worst = worst.max(if off.is_nan() { f64::INFINITY } else { off });
            x.push(tn);
            line.push(limit);
            points.push(got);
            let _ = writeln!(csv, "\"{words}\",{tn},{limit:?},{got:?}");
            if tn == 20.0 {
                println!("αtn = 20, {words}: αcn {limit:.4} by theory, {got:.4} found");
            }
        }
        figure = figure
            .line(words, &x, &line)
            .points(words, &x, &points, None);
    }
    // β multiplies both: from packing to bed load along a straight line.
    let (beta, cn) = (15.8, 1.3);
    figure = figure
        .measured(
            "the paper's 1.3 at 20, and β = 15.8",
            &[20.0, 20.0 * beta],
            &[cn, cn * beta],
        )
        .x_range(3.5, 400.0)
        .y_range(0.03, 100.0);
    sheet.write("springs", figure, &csv)?;
    println!(
        "paper B: αcn found is within {:.2} % of theory",
        100.0 * worst
    );
    Ok(worst < TOLERANCE)
}
