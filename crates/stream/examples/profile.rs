//! Paper B's water over its grain (d = 0.5 mm, ρs/ρ = 2.65) at a Shields number: profile, shelter, drag.
//!
//! ```text
//! cargo run -p tsubu-stream --example profile -- 0.1
//! ```
//!
//! Heights are in diameters above the bed's datum. The last column is the drag of the mean flow on a grain at rest over
//! its submerged weight: a grain that friction μ = 0.577 holds moves where that column exceeds 0.577.

use std::error::Error;
use tsubu_stream::{Sediment, Setting, Stream, TransportCurve};

fn main() -> Result<(), Box<dyn Error>> {
    let shields = std::env::args()
        .nth(1)
        .map_or(Ok(0.1), |word| word.parse())?;
    let (sand, friction) = (Sediment::quartz(0.5e-3), 0.577);
    let d = sand.diameter;
    let speed = Setting::over_grains(d, 0.0, 1)
        .water
        .friction_velocity(&sand, shields)?;
    let stream = Stream::new(Setting::over_grains(d, speed, 1))?;
    let Setting {
        water,
        profile,
        shelter,
        turbulence,
        ..
    } = stream.setting();
    let grain = water.grain(&sand)?;

    println!("d = 0.5 mm, rho_s/rho = 2.65, tau* = {shields}: u* = {speed:.4} m/s");
    println!(
        "mass with added mass {:.3e} kg, submerged weight {:.3e} N",
        grain.mass,
        grain.weight * water.gravity
    );
    println!("\n  y/d     U, m/s   rms u'   rms v'   shelter  drag, N     drag/weight");
    for quarters in [-4, -2, -1, 0, 1, 2, 4, 8, 20, 40] {
        let y = 0.25 * f64::from(quarters) * d;
        let shape = profile.over_friction_velocity(y);
        let (mean, decay) = (shape * speed, turbulence.decay(y, shape > 0.0) * speed);
        let drag = water.drag(d, shelter.factor(y), glam::DVec2::new(mean, 0.0));
        println!(
            "  {:<6.2}  {mean:<7.4}  {:<7.4}  {:<7.4}  {:<7.4}  {:<10.3e}  {:.3}",
            y / d,
            turbulence.along * decay,
            turbulence.up * decay,
            shelter.factor(y),
            drag.x,
            stream.drag_over_weight(y) * shields,
        );
    }

    println!("\nWhat you see:");
    for (place, y) in [("half a diameter up", 0.5 * d), ("level with the bed", 0.0)] {
        let threshold = stream.threshold(y, friction)?;
        let verb = if shields > threshold {
            "moves"
        } else {
            "rests"
        };
        println!("  a grain {place} {verb}: the mean flow moves it from tau* = {threshold:.3} on");
    }
    let gusts =
        turbulence.along * turbulence.decay(0.0, true) / profile.over_friction_velocity(0.0);
    println!(
        "  gusts (rms) are {:.0} % of the flow level with the bed: they move grains below those thresholds",
        100.0 * gusts
    );
    for curve in [
        TransportCurve::MEYER_PETER_MULLER,
        TransportCurve::WONG_PARKER,
    ] {
        let rate = curve.transport(shields)? * water.transport_unit(&sand)?;
        println!(
            "  {} expects qB* = {:.3e}, {rate:.3e} m2/s of grains",
            curve.name,
            curve.transport(shields)?
        );
    }
    Ok(())
}
