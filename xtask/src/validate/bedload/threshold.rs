//! The Shields number at which the mean flow moves a single grain on a flat floor, its spin locked.

use super::lab::{SAND, floor, lab};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec2;
use tsubu_contact::SpringDashpot;
use tsubu_model::{Damaged, Kind, Load, Plane, Saved, Seen, Spins, View, Words};
use tsubu_stream::{Datum, Sediment, Setting, Stream, Table, Turbulence, Water};

const GRAVITY: f64 = 9.80665;
const FRICTION: f64 = 0.577;
/// Time in s in which a grain just above its threshold moves visibly: at 1 % above it by some 0.6 mm.
const LONG: f64 = 0.25;

/// Water whose bottom is given.
struct Mean(Stream);

/// It knows nothing but its constants.
impl Saved for Mean {
    fn save(&self, _words: &mut Words) {}
    fn restore(&mut self, _words: &mut Words) -> Result<(), Damaged> {
        Ok(())
    }
}

impl Load<Plane, Spins> for Mean {
    fn is_due(&self, _t: f64) -> bool {
        false
    }
    fn renew(&mut self, _view: &dyn View<Plane, Spins>, _t: f64) {}
    fn push(&self, t: f64, grains: &[Seen<Plane>], force: &mut [DVec2]) {
        if let Some(current) = self.0.at(t) {
            for (grain, force) in grains.iter().zip(force) {
                let (x, v) = (grain.position, grain.velocity);
                *force += current.force::<Plane>(x, v, grain.identity, 2.0 * grain.radius);
            }
        }
    }
}

/// True if the grain, its centre `y` above the datum, is carried off.
fn moves(shields: f64, y: f64) -> Result<bool, String> {
    let sand = Sediment::quartz(SAND);
    let water = Water::fresh();
    let words = |e: tsubu_stream::Unphysical| e.to_string();
    let kind = Kind {
        inertia: f64::INFINITY,
        ..water.grain(&sand).map_err(words)?
    };
    let dt = 1e-5;
    let law = SpringDashpot::from_time_step(dt, kind.mass, 20.0, 0.3, 0.3, FRICTION);
    let rest = 0.5 * SAND - kind.weight * GRAVITY / law.normal_stiffness;
    let speed = water.friction_velocity(&sand, shields).map_err(words)?;
    let stream = Stream::new(Setting {
        friction_velocity: Table::constant(speed),
        turbulence: Turbulence::none(),
        datum: Datum::Given(rest - y),
        ..Setting::over_grains(SAND, speed, 1)
    })
    .map_err(words)?;
    let weight = DVec2::Y * -GRAVITY;
    let grains = [(DVec2::Y * rest, DVec2::ZERO)];
    let mut run = lab(kind, law, vec![floor(law)], weight, dt, &grains);
    run.add_load(Box::new(Mean(stream)));
    run.advance((LONG / dt) as u64);
    Ok(run.position(0).x > 0.2 * SAND)
}

/// Both heights, by bisection.
pub fn run(report: &mut Report) -> Result<(), String> {
    for (place, y, expected) in [("d/2", 0.5 * SAND, 0.048), ("0", 0.0, 0.173)] {
        let (mut low, mut high) = (0.01, 0.5);
        while high / low > 1.003 {
            let middle = f64::sqrt(low * high);
            if moves(middle, y)? {
                high = middle;
            } else {
                low = middle;
            }
        }
        report.check(
            format!("a grain on a flat floor, μ = {FRICTION}, spin locked, y = {place}: τ* that moves it"),
            expected,
            f64::sqrt(low * high),
            Tolerance::Relative(0.02),
            "μ over the drag per weight, to two digits; 2 % as asked",
        );
    }
    Ok(())
}
