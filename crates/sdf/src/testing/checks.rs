//! The checks of the suite, one function each.

use super::points::{Trial, chance};
use super::report::{Check, Worst};
use tsubu_model::{Dim, Hit, HitBuffer, Vector};

pub(super) fn finite<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Finite);
    for &x in &trial.points {
        let bound = trial.surface.lower_bound(x);
        worst.demand(bound.is_finite(), || {
            format!("lower_bound at {x:?} is {bound}")
        });
        for hit in trial.hits(x, trial.options.reach) {
            worst.demand(hit.is_finite(), || format!("at {x:?}: {hit:?}"));
            worst.see((hit.normal.length() - 1.0).abs(), 1e-12, || {
                format!("at {x:?} the normal {:?} has not length 1", hit.normal)
            });
        }
    }
    worst
}

pub(super) fn within_reach<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Reach);
    for (k, &x) in trial.points.iter().enumerate() {
        let distance = trial.distance(x).unwrap_or(trial.size);
        let reaches = [
            distance * 0.5,
            distance,
            distance * 1.5,
            0.2 * trial.size * chance(k as u64, 90),
        ];
        for reach in reaches {
            for hit in trial.hits(x, reach) {
                worst.demand(hit.distance < reach, || {
                    format!(
                        "at {x:?} a hit at {} m with a reach of {reach} m",
                        hit.distance
                    )
                });
            }
        }
    }
    worst
}

pub(super) fn found<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Found);
    for (k, &x) in trial.points.iter().enumerate() {
        let Some(distance) = trial.distance(x) else {
            // Far from the surface: then its own bound must not say that it is near and inside.
            worst.demand(
                trial.surface.lower_bound(x) >= 0.0 || trial.options.reach < trial.size,
                || format!("no hit at {x:?} at any reach"),
            );
            continue;
        };
        let over = trial.slack + 0.1 * trial.size * chance(k as u64, 91);
        for reach in [distance + over, distance + 0.01 * trial.size] {
            if reach > trial.options.reach {
                continue;
            }
            let hits = trial.hits(x, reach);
            let nearest = hits.iter().map(|h| (h.distance - distance).abs());
            worst.see(
                nearest.fold(f64::INFINITY, f64::min),
                trial.slack.max(1e-14 * trial.size),
                || format!("at {x:?}, {distance} m away, a reach of {reach} m finds {hits:?}"),
            );
        }
    }
    worst
}

pub(super) fn batch<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Batch);
    let reach: Vec<f64> = (0..trial.points.len())
        .map(|k| 0.3 * trial.size * chance(k as u64, 92))
        .collect();
    let mut out = HitBuffer::default();
    // What another surface left in the buffer stays there.
    let before = Hit {
        of: 77,
        distance: 0.5,
        normal: trial.direction(0),
        feature: 99,
    };
    out.hits.push(before);
    trial.surface.hits(&trial.points, &reach, &mut out);
    let same = |a: &Hit<D>, b: &Hit<D>, of: u32| {
        a.of == of && a.distance == b.distance && a.normal == b.normal && a.feature == b.feature
    };
    worst.demand(
        out.hits.first().is_some_and(|h| same(h, &before, 77)),
        || "what the buffer held before is gone".into(),
    );
    for (k, (&x, &reach)) in trial.points.iter().zip(&reach).enumerate() {
        let alone = trial.hits(x, reach);
        let of = k as u32;
        let mine: Vec<_> = out.hits.iter().skip(1).filter(|h| h.of == of).collect();
        let equal =
            mine.len() == alone.len() && mine.iter().zip(&alone).all(|(a, b)| same(a, b, of));
        worst.demand(equal, || {
            format!("at {x:?} alone {alone:?}, among many {mine:?}")
        });
    }
    worst
}

pub(super) fn lipschitz<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Lipschitz);
    let mut compare = |x: D::V, y: D::V| {
        if let (Some(a), Some(b)) = (trial.distance(x), trial.distance(y)) {
            let way = (x - y).length();
            worst.see((a - b).abs() - way, trial.slack, || {
                format!("from {x:?} to {y:?}, {way} m, the distance goes from {a} to {b}")
            });
        }
    };
    for (k, &x) in trial.points.iter().enumerate() {
        let k = k as u64;
        // Short steps find jumps, long ones a slope that is wrong on the whole.
        compare(x, x + trial.direction(k) * (1e-4 * trial.size));
        let way = 10f64.powf(-4.0 * chance(k, 93)) * 0.5 * trial.size;
        compare(x, x + trial.direction(k + 1_000_000) * way);
    }
    worst
}

pub(super) fn bound<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Bound);
    for &x in &trial.points {
        let bound = trial.surface.lower_bound(x);
        // Where the surface finds nothing the distance is at least the reach: any bound is true.
        if let Some(distance) = trial.distance(x) {
            worst.see(bound - distance, trial.slack, || {
                format!("at {x:?} the bound is {bound} m, the distance {distance} m")
            });
        }
    }
    worst
}

pub(super) fn room<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Room);
    for (k, &x) in trial.points.iter().enumerate() {
        let k = k as u64;
        let reach = trial.options.reach.min(0.1 * trial.size) * chance(k, 94);
        let room = trial.surface.room(x, reach);
        if room <= trial.slack {
            continue;
        }
        // To the very end of the room, in any direction and straight towards the surface.
        let ways = (0..6).map(|w| trial.direction(10 * k + w));
        let straight = trial.hits(x, reach + 2.0 * room);
        for way in ways.chain(straight.first().map(|h| -h.normal)) {
            let y = x + way * (room - trial.slack);
            worst.demand(trial.hits(y, reach).is_empty(), || {
                format!("at {x:?} the room is {room} m for a reach of {reach} m, but {y:?} is hit")
            });
        }
    }
    worst
}

pub(super) fn sign<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Sign);
    let Some(inside) = trial.options.inside else {
        return worst;
    };
    for &x in &trial.points {
        // A point outside a narrow band has no sign but that of its bound.
        let distance = trial.distance(x).unwrap_or(f64::INFINITY);
        let (is, says) = (inside(x), distance < 0.0);
        worst.demand(is == says || distance.abs() <= trial.slack, || {
            let place = if is { "inside" } else { "outside" };
            format!("{x:?} is {place}, its distance {distance} m")
        });
    }
    worst
}

pub(super) fn gradient<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Gradient);
    let tolerance = trial.options.tolerance.sqrt().max(1e-5);
    let step = (0.1 * tolerance).min(1e-3) * trial.size;
    for &x in &trial.points {
        let Some(hit) = trial.nearest(x) else {
            continue;
        };
        let mut smooth = true;
        let mut slopes = [0.0; 3];
        for (axis, slope) in slopes.iter_mut().enumerate().take(D::V::AXES) {
            let along = D::V::from_axes(|a| if a == axis { step } else { 0.0 });
            let (Some(after), Some(before)) =
                (trial.distance(x + along), trial.distance(x - along))
            else {
                smooth = false;
                break;
            };
            *slope = (after - before) / (2.0 * step);
            // At a crease, where two places are equally near, the two one-sided slopes differ.
            let bend = (after + before - 2.0 * hit.distance).abs() / step;
            smooth &= bend < 30.0 * tolerance;
        }
        if !smooth {
            continue;
        }
        let slope = D::V::from_axes(|a| slopes[a]);
        worst.see((slope - hit.normal).length(), 60.0 * tolerance, || {
            format!(
                "at {x:?} the normal is {:?}, the gradient {slope:?}",
                hit.normal
            )
        });
    }
    let asked = worst.asked();
    worst.demand(asked * 4 > trial.points.len(), || {
        "the distance is smooth almost nowhere".into()
    });
    worst
}

pub(super) fn foot<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Foot);
    for &x in &trial.points {
        for hit in trial.hits(x, trial.options.reach) {
            let foot = x - hit.normal * hit.distance;
            let distance = if trial.options.union {
                let there = trial.hits(foot, trial.options.reach);
                let same = there.iter().find(|h| h.feature == hit.feature);
                same.map_or(f64::INFINITY, |h| h.distance)
            } else {
                trial.distance(foot).unwrap_or(f64::INFINITY)
            };
            worst.see(distance.abs(), 4.0 * trial.slack, || {
                format!("at {x:?} {hit:?} points to {foot:?}, {distance} m off the surface")
            });
        }
    }
    worst
}

pub(super) fn expected<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Expected);
    for &(x, reach, count) in &trial.options.expected {
        let hits = trial.hits(x, reach);
        worst.demand(hits.len() == count, || {
            format!("at {x:?} with a reach of {reach} m {count} hits are stated: {hits:?}")
        });
    }
    worst
}

pub(super) fn drawing<D: Dim>(trial: &Trial<D>) -> Worst {
    let mut worst = Worst::of(Check::Drawing);
    let surface = trial.surface;
    if let Some([low, high]) = surface.bounds() {
        for &x in &trial.points {
            let Some(hit) = trial.nearest(x) else {
                continue;
            };
            let foot = D::to_space(x - hit.normal * hit.distance);
            let beyond = (low - foot).max(foot - high).max_element();
            worst.see(beyond, 4.0 * trial.slack, || {
                format!("{foot} of the surface is {beyond} m beyond the bounds {low} to {high}")
            });
        }
    }
    for corner in surface.shell().unwrap_or_default().vertices {
        let flat = D::from_space(corner);
        // A ball in the plane is drawn as a ball: only its corners in the plane can be asked.
        if D::to_space(flat) != corner {
            continue;
        }
        if let Some(distance) = trial.distance(flat) {
            // A pole of a cap or the middle of an end is on the surface, too.
            let off = distance.abs() - trial.options.drawn_within;
            worst.see(off, 4.0 * trial.slack, || {
                format!("the corner {corner} of the shell is {distance} m off the surface")
            });
        }
    }
    let (low, high) = trial.middle_box();
    for end in surface.outline(low, high).into_iter().flatten() {
        let beyond = (low - end).max(end - high).max_element();
        worst.see(beyond, 1e-12 * trial.size, || {
            format!("{end} of the outline is {beyond} m beyond its box {low} to {high}")
        });
    }
    worst
}
