//! No energy from nothing: closed paths at constant speed, and collisions at every angle.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, frame};
use tsubu_model::{ContactLaw, Dim, Numbers, Still, Vector};

/// Pieces to each edge of a closed path.
const PIECES: usize = 1000;
/// Steps to half a period in a collision.
const STEPS: f64 = 4000.0;

/// Work of the contact along closed paths that begin and end out of range, walked both ways.
///
/// Each piece is at most 1e-4 of the range against an overlap of 1e-2: the kink at the range and the
/// curvature of the force leave 1e-5 of the stored energy, so 1e-4 of it is the tolerance. The slow
/// walk shows a force that is no gradient, the fast one a dashpot or a friction that drives.
pub(super) fn closed_paths<D: Dim, L: ContactLaw<D, Still>>(case: &Case<D, L>) -> Option<Breach> {
    let mut worst = Worst::of(Check::Loop);
    let (n, t) = frame::<D::V>(5);
    let point = |u: f64, w: f64| (n * u + t * w) * case.range;
    let circle = (0..48).map(|i| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 48.0).sin_cos();
        point(1.0 + 0.04 * cos, 0.04 * sin)
    });
    let paths: [(&str, Vec<D::V>); 3] = [
        ("in and out", vec![point(1.02, 0.0), point(0.98, 0.0)]),
        (
            "in, along and out",
            vec![
                point(1.02, 0.0),
                point(0.99, 0.0),
                point(0.97, 0.05),
                point(1.02, 0.05),
            ],
        ),
        ("round a circle", circle.collect()),
    ];
    for (name, corners) in paths {
        let back: Vec<_> = corners.iter().rev().copied().collect();
        for (way, corners) in [("forwards", &corners), ("backwards", &back)] {
            for speed in [1e-6, 3e-3].map(|s| s * case.range * case.rate) {
                let (work, most) = work_along(case, corners, speed);
                let scale = most.max(0.5 * case.stiffness * (1e-2 * case.range).powi(2));
                worst.see(work.max(0.0), 1e-4 * scale, || {
                    format!("{name}, {way}, at {speed:e} m/s: gained {work:e} J, stored at most {most:e} J on the way")
                });
                worst.demand(!work.is_nan(), || {
                    format!("{name}, {way}, at {speed:e} m/s: the work is {work}")
                });
            }
        }
    }
    worst.breach()
}

/// Work of the contact on the grain along a closed polygon, and the largest energy stored on the way.
fn work_along<D: Dim, L: ContactLaw<D, Still>>(
    case: &Case<D, L>,
    corners: &[D::V],
    speed: f64,
) -> (f64, f64) {
    let mut memory = L::Memory::zero();
    let (mut work, mut most) = (0.0, 0.0_f64);
    for (i, &from) in corners.iter().enumerate() {
        let edge = corners[(i + 1) % corners.len()] - from;
        let piece = edge * (1.0 / PIECES as f64);
        let dt = piece.length() / speed;
        for j in 0..PIECES {
            let apart = from + edge * ((j as f64 + 0.5) / PIECES as f64);
            let touch = case.at(State {
                apart,
                velocity: piece * (1.0 / dt),
            });
            work += L::force(&case.pair, &touch, &mut memory, dt)
                .total()
                .dot(piece);
            most = most.max(L::stored(&case.pair, &touch, &memory));
        }
    }
    (work, most)
}

/// What the grain flies against.
#[derive(Clone, Copy, Debug)]
enum Against {
    Sphere,
    Flat,
}

/// Collisions of every angle up to grazing, on a sphere and on a flat surface.
/// The leapfrog's own error is (π/4000)² ≈ 1e-6 of the energy; 1e-5 is the tolerance.
pub(super) fn collisions<D: Dim, L: ContactLaw<D, Still>>(case: &Case<D, L>) -> Option<Breach> {
    let mut worst = Worst::of(Check::Collision);
    for against in [Against::Sphere, Against::Flat] {
        for speed in [1e-3, 1e-2].map(|s| s * case.range * case.rate) {
            for degrees in [
                0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 76.0, 80.0, 85.0, 88.0, 89.5,
            ] {
                let gain = gain(case, against, speed, degrees);
                let words = || {
                    format!(
                        "{against:?}, {degrees}° off the normal, {speed:e} m/s: gained {gain:e} of the energy"
                    )
                };
                worst.see(gain.max(0.0), 1e-5, words);
                worst.demand(!gain.is_nan(), words);
            }
        }
    }
    worst.breach()
}

/// Energy after a collision over that before, less one. A contact that does not end (an overdamped
/// law may creep for ever) is judged by what it then holds.
fn gain<D: Dim, L: ContactLaw<D, Still>>(
    case: &Case<D, L>,
    against: Against,
    speed: f64,
    degrees: f64,
) -> f64 {
    let (n, t) = frame::<D::V>(9);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let dt = std::f64::consts::PI / (case.rate * STEPS);
    let mut x = n * (case.range * (1.0 + 1e-9));
    let mut v = n * (-speed * cos) + t * (speed * sin);
    let mut memory = L::Memory::zero();
    let mut stored = 0.0;
    let mut touched = false;
    for _ in 0..10 * STEPS as usize {
        let apart = match against {
            Against::Sphere => x,
            Against::Flat => n * x.dot(n),
        };
        let touch = case.at(State { apart, velocity: v });
        let push = L::force(&case.pair, &touch, &mut memory, dt);
        stored = L::stored(&case.pair, &touch, &memory);
        let inside = touch.r() < case.range;
        if touched && !inside {
            break;
        }
        touched |= inside;
        v += push.total() * (dt / case.mass);
        x += v * dt;
    }
    (0.5 * case.mass * v.length_squared() + stored) / (0.5 * case.mass * speed * speed) - 1.0
}
