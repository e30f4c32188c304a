//! No energy from nothing: closed paths at constant speed, and collisions at every angle.

use super::report::{Breach, Check, Worst};
use super::states::{Case, State, frame, rolled, scattered, turns};
use tsubu_model::{ContactLaw, Dim, Kind, Numbers, SpinState, Vector};

/// Length of a piece of a closed path over the range, and the most pieces to an edge.
const PIECE: f64 = 5e-5;
const MOST_PIECES: f64 = 1000.0;
/// Steps to half a period in a collision.
const STEPS: f64 = 2000.0;

/// A corner of a closed path: where the grain is, and how far the spins have turned the surfaces, in m.
type Corner<D, S> = (<D as Dim>::V, <S as SpinState>::Turn<D>);

/// Work of the contact along closed paths that begin and end out of range, walked both ways.
/// Grains that turn are also rubbed by their spins on the way.
///
/// Each piece is at most 1e-4 of the range against an overlap of 1e-2: the kink at the range and the
/// curvature of the force leave 1e-5 of the stored energy, so 1e-4 of it is the tolerance. The slow
/// walk shows a force that is no gradient, the fast one a dashpot or a friction that drives.
pub(super) fn closed_paths<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Loop);
    let (n, t) = frame::<D::V>(5);
    let none = S::Turn::<D>::ZERO;
    let point = |u: f64, w: f64| ((n * u + t * w) * case.range, none);
    let circle = (0..48).map(|i| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 48.0).sin_cos();
        point(1.0 + 0.04 * cos, 0.04 * sin)
    });
    let mut paths: Vec<(&str, Vec<Corner<D, S>>)> = vec![
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
    if turns::<D, S>() {
        let turn = scattered::<S::Turn<D>>(705);
        let length = case.range / rolled::<D, S>(n, turn).length();
        let rubbed = |u: f64, w: f64, s: f64| (point(u, w).0, turn * (s * length));
        for (name, far) in [("rubbed a little", 0.002), ("rubbed far", 0.05)] {
            paths.push((
                name,
                vec![
                    rubbed(1.02, 0.0, 0.0),
                    rubbed(0.98, 0.0, 0.0),
                    rubbed(0.98, 0.0, far),
                    rubbed(0.99, 0.0, 0.0),
                    rubbed(0.97, 0.02, -far),
                    rubbed(0.99, 0.0, far),
                    rubbed(1.02, 0.0, far),
                ],
            ));
        }
    }
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

/// Work of the contact on the grains along a closed polygon, and the largest energy stored on the way.
fn work_along<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    corners: &[Corner<D, S>],
    speed: f64,
) -> (f64, f64) {
    let mut memory = L::Memory::zero();
    let (mut work, mut most) = (0.0, 0.0_f64);
    for (i, &(from, _)) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let (edge, turn) = (next.0 - from, next.1 - corners[i].1);
        let length = edge.length().max(turn.length());
        if length == 0.0 {
            continue;
        }
        let pieces = (length / (PIECE * case.range)).ceil().min(MOST_PIECES);
        let (piece, turned) = (edge * (1.0 / pieces), turn * (1.0 / pieces));
        let rolled = turned * (1.0 / case.range);
        let dt = length / (pieces * speed);
        for j in 0..pieces as usize {
            let touch = case.at(State {
                apart: from + edge * ((j as f64 + 0.5) / pieces),
                velocity: piece * (1.0 / dt),
                spin: turned * (1.0 / dt),
                // Rolled as far as rubbed: what one spin alone does, the partner's being none.
                roll: rolled * (1.0 / dt),
            });
            let push = L::force(&case.pair, &touch, &mut memory, dt);
            work += push.total().dot(piece) + push.twist.dot(turned) + push.couple.dot(rolled);
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

/// Collisions of every angle up to grazing, on a sphere and on a flat surface; of grains that turn with spins of every kind, on the
/// sphere if the partner is one and on the flat surface if it is a wall. All that moves is free to.
/// The leapfrog's own error is (π/2000)² ≈ 2.5e-6 of the energy; 1e-5 is the tolerance.
pub(super) fn collisions<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
) -> Option<Breach> {
    let mut worst = Worst::of(Check::Collision);
    let spins: &[[f64; 2]] = if turns::<D, S>() {
        // Of the grain and its partner over the speed; signs and sizes.
        &[[0.0, 0.0], [-0.7, -0.7], [3.0, -2.0]]
    } else {
        &[[0.0, 0.0]]
    };
    for against in [Against::Sphere, Against::Flat] {
        if turns::<D, S>() && case.is_wall() != matches!(against, Against::Flat) {
            continue;
        }
        for speed in [1e-3, 1e-2].map(|s| s * case.range * case.rate) {
            for degrees in [
                0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 76.0, 80.0, 85.0, 88.0, 89.5,
            ] {
                for &spin in spins {
                    let gain = gain(case, against, speed, degrees, spin);
                    let words = || {
                        format!(
                            "{against:?}, {degrees}° off the normal, {speed:e} m/s, spins {spin:?}: gained {gain:e} of the energy"
                        )
                    };
                    worst.see(gain.max(0.0), 1e-5, words);
                    worst.demand(!gain.is_nan(), words);
                }
            }
        }
    }
    worst.breach()
}

/// Energy after a collision over that before, less one. A contact that does not end (an overdamped
/// law may creep for ever) is judged by what it then holds.
fn gain<D: Dim, S: SpinState, L: ContactLaw<D, S>>(
    case: &Case<D, S, L>,
    against: Against,
    speed: f64,
    degrees: f64,
    spins: [f64; 2],
) -> f64 {
    let (n, t) = frame::<D::V>(9);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let dt = std::f64::consts::PI / (case.rate * STEPS);
    let mut x = n * (case.range * (1.0 + 1e-9));
    let mut v = n * (-speed * cos) + t * (speed * sin);
    // What cannot be turned does not turn.
    let free = |kind: &Kind| kind.inertia.is_finite() && kind.radius > 0.0;
    let mut turning = [(case.a, spins[0], 31), (case.b, spins[1], 32)].map(|(kind, spin, k)| {
        let spin = if free(kind) {
            spin * speed / kind.radius
        } else {
            0.0
        };
        (kind, scattered::<S::Turn<D>>(k) * spin)
    });
    let moving = |v: D::V, turning: &[(&Kind, S::Turn<D>)]| {
        let turned = turning.iter().filter(|(kind, _)| free(kind));
        0.5 * case.mass * v.length_squared()
            + turned
                .map(|(kind, w)| 0.5 * kind.inertia * w.length_squared())
                .sum::<f64>()
    };
    let before = moving(v, &turning);
    let mut memory = L::Memory::zero();
    let mut stored = 0.0;
    let mut touched = false;
    for _ in 0..10 * STEPS as usize {
        let apart = match against {
            Against::Sphere => x,
            Against::Flat => n * x.dot(n),
        };
        let [(a, w), (b, u)] = turning;
        let touch = case.at(State {
            apart,
            velocity: v,
            spin: w * a.radius + u * b.radius,
            roll: w - u,
        });
        let push = L::force(&case.pair, &touch, &mut memory, dt);
        stored = L::stored(&case.pair, &touch, &memory);
        let inside = touch.r() < case.range;
        if touched && !inside {
            break;
        }
        touched |= inside;
        v += push.total() * (dt / case.mass);
        let couples = [push.couple, -push.couple];
        for ((kind, w), couple) in turning.iter_mut().zip(couples) {
            *w += (push.twist * kind.radius + couple) * (dt / kind.inertia);
        }
        x += v * dt;
    }
    (moving(v, &turning) + stored) / before - 1.0
}
