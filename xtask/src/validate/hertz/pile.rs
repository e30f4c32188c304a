//! Three spheres of two sizes, 1:5, piled on a floor: they stand where statics lets them and stay for a million steps.
//!
//! Statics: a sphere on two others, the line of centres at α from the vertical, is held by contacts with tan(α/2) of friction, the same
//! for the upper contact of each lower sphere, whose moment only the floor's friction can balance.
//! The pile rolls freely as a whole, so it is built symmetric: a speed that it has would stay. One that resists rolling is knocked.

use super::lab::{Ball, Bench, GRAVITY, Lab, seen};
use super::largest;
use super::theory::{Material, material};
use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use glam::DVec3;
use tsubu_contact::{HertzMindlin, Resistance, Resisted, Rolling};
use tsubu_engine::Layout;
use tsubu_integrate::Scheme;
use tsubu_model::{Plane, Space};

const STONE: Material = material(0.01, 0.3, 2500.0);
/// Radii in m.
const SMALL: f64 = 1e-3;
const BIG: f64 = 5e-3;
/// Step in s: a fortieth of the shortest period of these piles.
const DT: f64 = 1e-5;
/// Steps between two looks whether it is still, and the most that are waited for. The big sphere on two small ones that resist rolling
/// swings with a period of seconds, which their dashpots damp slowly.
const SETTLING: u64 = 200_000;
const MOST_SETTLING: u64 = 6_000_000;
/// Still: the fastest sphere or surface is slower than this times √(gd).
const STILL: f64 = 1e-10;
const STEPS: u64 = 1_000_000;
/// The largest way of any sphere in the million steps that passes as standing, in diameters of the small one. It was set beforehand: a
/// spring that creeps by a rounding (1e-16) of its stretch in each step would come to 1e-10.
const DRIFT: f64 = 1e-6;

/// Two spheres that touch on the floor and one on top.
struct Pile {
    words: &'static str,
    below: f64,
    above: f64,
}

const PILES: [Pile; 2] = [
    Pile {
        words: "big on two small",
        below: SMALL,
        above: BIG,
    },
    Pile {
        words: "small on two big",
        below: BIG,
        above: SMALL,
    },
];

impl Pile {
    /// α in rad.
    fn lean(&self) -> f64 {
        (self.below / (self.below + self.above)).asin()
    }

    /// The least friction with which it stands.
    fn needs(&self) -> f64 {
        (0.5 * self.lean()).tan()
    }

    /// Of spheres that roll freely or not, the top one at `speed` m/s to the right.
    fn built<D: Layout, R: Rolling>(&self, law: HertzMindlin<R>, speed: f64) -> Lab<D, R> {
        let bench = Bench {
            law,
            floor: Some(law),
            gravity: DVec3::Z * -GRAVITY,
            scheme: Scheme::SymplecticEuler,
            dt: DT,
        };
        let low = |side: f64| {
            Ball::at(
                STONE.sphere(self.below),
                DVec3::new(side * self.below, 0.0, self.below),
            )
        };
        let height = self.below + (self.below + self.above) * self.lean().cos();
        let top = Ball {
            velocity: DVec3::X * speed,
            ..Ball::at(STONE.sphere(self.above), DVec3::Z * height)
        };
        bench.world::<D>(&[low(-1.0), low(1.0), top])
    }
}

fn law(friction: f64) -> HertzMindlin {
    HertzMindlin::between(&STONE.elastic, &STONE.elastic, 0.3, friction)
}

/// The furthest that any sphere is from where it was, in small diameters; not a number if one is lost.
fn apart(from: &[Ball], to: &[Ball]) -> f64 {
    let way = |(a, b): (&Ball, &Ball)| (a.place - b.place).length() / (2.0 * SMALL);
    largest(from.iter().zip(to).map(way))
}

/// Speed of the fastest sphere or surface over √(gd).
fn fastest(balls: &[Ball]) -> f64 {
    let speed = |ball: &Ball| ball.velocity.length() + ball.kind.radius * ball.spin.length();
    largest(balls.iter().map(speed)) / (2.0 * GRAVITY * SMALL).sqrt()
}

fn stands<D: Layout, R: Rolling>(report: &mut Report, mut run: Lab<D, R>, tag: &str) {
    let built = seen(&run);
    let mut settling = 0;
    while settling < MOST_SETTLING && (settling == 0 || fastest(&seen(&run)) > STILL) {
        run.advance(SETTLING);
        settling += SETTLING;
    }
    let settled = seen(&run);
    let ways = (0..20).map(|_| {
        run.advance(STEPS / 20);
        apart(&settled, &seen(&run))
    });
    report.check(
        format!("{tag}: way in 10⁶ steps over the small diameter"),
        DRIFT,
        largest(ways),
        Tolerance::AtMost,
        "set beforehand; rounding in every step would come to 1e-10",
    );
    report.check(
        format!("{tag}: fastest sphere or surface at the end over √(gd)"),
        STILL,
        fastest(&seen(&run)),
        Tolerance::AtMost,
        "at rest: ten seconds at this speed are 1e-7 d",
    );
    report.tell(
        format!("  way while it settles over the small diameter, {settling} steps"),
        apart(&built, &settled),
        "overlaps under its weight, and friction that builds up",
    );
}

/// The checks.
pub fn run(report: &mut Report) {
    // A twentieth of the speed of a fall by a small diameter: it shakes the pile and does not throw it down.
    let knock = 0.05 * (2.0 * GRAVITY * 2.0 * SMALL).sqrt();
    let rough = Resisted {
        friction: 0.1,
        damping: 1.0,
        by: Resistance::ElasticPlastic,
    };
    for pile in &PILES {
        let (enough, words) = (1.2 * pile.needs(), pile.words);
        let plane = pile.built::<Plane, _>(law(enough), 0.0);
        stands(report, plane, &format!("{words}, plane, μ = 1.2 tan(α/2)"));
        let knocked = pile.built::<Space, _>(law(1.5 * enough).resisting(rough), knock);
        stands(report, knocked, &format!("{words}, space, knocked, type C"));
        let mut run = pile.built::<Plane, _>(law(0.8 * pile.needs()), 0.0);
        let built = seen(&run);
        run.advance(SETTLING);
        report.check(
            format!("{words}, μ = 0.8 tan(α/2): way in {SETTLING} steps over the small diameter"),
            0.1,
            apart(&built, &seen(&run)),
            Tolerance::AtLeast,
            "statics lets it fall",
        );
    }
}
