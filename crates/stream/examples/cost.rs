//! What the water costs per grain and step, in the flow and in the standing water of the bed.
//!
//! ```text
//! cargo run --release -p tsubu-stream --example cost
//! ```

use glam::{DVec2, DVec3};
use std::error::Error;
use std::time::Instant;
use tsubu_model::{Dim, Plane, Space, Vector};
use tsubu_stream::{Datum, Grains, Setting, Stream, Turbulence};

const GRAINS: usize = 2000;
const STEPS: usize = 500;

fn main() -> Result<(), Box<dyn Error>> {
    let d = 0.5e-3;
    let setting = Setting {
        datum: Datum::Given(0.0),
        ..Setting::over_grains(d, 0.05, 1)
    };
    let mean_only = Setting {
        turbulence: Turbulence::none(),
        ..setting.clone()
    };
    let (full, mean) = (Stream::new(setting)?, Stream::new(mean_only)?);
    for (place, height) in [("one diameter up", d), ("five diameters deep", -5.0 * d)] {
        let (plane, space) = (DVec2::new(0.0, height), DVec3::new(0.0, 0.0, height));
        println!(
            "{place:<20}  plane {:5.1} ns  space {:5.1} ns  plane without turbulence {:5.1} ns",
            time::<Plane>(&full, plane)?,
            time::<Space>(&full, space)?,
            time::<Plane>(&mean, plane)?
        );
    }
    Ok(())
}

/// Nanoseconds per grain and step; the best of five.
fn time<D: Dim>(stream: &Stream, place: D::V) -> Result<f64, Box<dyn Error>> {
    let (position, velocity) = (vec![place; GRAINS], vec![D::V::ZERO; GRAINS]);
    let (identity, diameter) = ((0..GRAINS as u32).collect::<Vec<_>>(), [0.5e-3; GRAINS]);
    let grains = Grains::<D> {
        position: &position,
        velocity: &velocity,
        identity: &identity,
        diameter: &diameter,
    };
    let mut force = vec![D::V::ZERO; GRAINS];
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        for step in 0..STEPS {
            stream.push(1e-3 * step as f64, grains, &mut force)?;
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(best * 1e9 / (GRAINS * STEPS) as f64)
}
