//! `tsubu check`: what a scene models, how far its step is from the limits, what it will cost.

use crate::arguments::CheckWish;
use crate::run::{choices, read};
use crate::trouble::Trouble;
use std::time::{Duration, Instant};
use tsubu::assemble::{Choices, build};

/// How long the speed is tried.
const TRIAL: Duration = Duration::from_millis(700);

/// `tsubu check`.
pub fn check(wish: &CheckWish) -> Result<u8, Trouble> {
    let checked = read(&wish.scene)?;
    // The limits are shown even where they are broken; the refusal comes at the end.
    let built = build(
        &checked,
        &Choices {
            allow_unstable: true,
            ..choices(&wish.scene, None)
        },
    )?;
    let (mut run, plan) = (built.simulation, built.plan);
    let c = &plan.constants;
    say!("{}", checked.scene.title);
    say!("\nModelled");
    plan.modelled.iter().for_each(|line| say!("  {line}"));
    say!("Not modelled");
    plan.not_modelled.iter().for_each(|line| say!("  {line}"));
    say!("\nStep");
    say!(
        "  {:.4e} s = {:.1} steps per contact period of {:.4e} s, {}",
        c.dt,
        c.period / c.dt,
        c.period,
        c.scheme.name()
    );
    say!(
        "  K = k dt^2/m = {}, C = gamma dt/m = {}",
        small(c.k()),
        small(c.c())
    );
    for limit in &plan.limits {
        say!(
            "  {:>6.1} % of the limit for {}",
            100.0 * limit.used,
            limit.name
        );
    }
    say!("\nSize");
    say!(
        "  {} grains, {:.0} bytes each, lists included: {:.1} MB",
        plan.grains,
        run.bytes_per_grain(),
        plan.grains as f64 * run.bytes_per_grain() / 1e6
    );
    say!("  {} thread(s), {} vectors", plan.threads, plan.lanes);
    let stable = plan.limits.iter().all(|l| l.used < 1.0);
    if stable || wish.scene.allow_unstable {
        let (start, mut steps) = (Instant::now(), 0);
        while start.elapsed() < TRIAL && !run.is_over() {
            steps += run.advance(20);
        }
        let rate = plan.grains as f64 * steps as f64 / start.elapsed().as_secs_f64();
        let seconds = plan.grains as f64 * plan.steps as f64 / rate.max(1.0);
        let settling = if checked.scene.waits_for_stillness() {
            ", and the settling before"
        } else {
            ""
        };
        say!("\nCost");
        say!(
            "  {} steps{settling}: {:.2e} grain-steps",
            plan.steps,
            plan.grains as f64 * plan.steps as f64
        );
        say!(
            "  about {} at {:.1} million grain-steps/s, tried just now on the first {steps} steps",
            duration(seconds),
            rate / 1e6
        );
    }
    if !wish.scene.allow_unstable && !stable {
        build(&checked, &choices(&wish.scene, None))?;
    }
    Ok(0)
}

/// Four decimals, or two digits where these would be all zeros.
fn small(x: f64) -> String {
    if x == 0.0 || x.abs() >= 1e-3 {
        format!("{x:.4}")
    } else {
        format!("{x:.1e}")
    }
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}
