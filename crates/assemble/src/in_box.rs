//! Bodies with ends in a box that repeats: only one of them is there, so it must not reach across a face of the box.

use glam::DVec3;
use std::sync::Arc;
use tsubu_model::{Dim, Domain, Surface};
use tsubu_scene::{Checked, Course, End, Motion, SceneError, Wall};

/// Refuses a body that sticks out of a periodic box at some time. One that is longer than the box at both ends
/// fills it all the time, as a tube along the axis does, and stays right, unless it is built of grains.
pub(crate) fn bodies_stay<D: Dim>(
    checked: &Checked,
    surfaces: &[Arc<dyn Surface<D>>],
    of_grains: &[bool],
    domain: &Domain<D>,
    dt: f64,
) -> Result<(), SceneError> {
    let end = match checked.scene.time.end {
        End::Until(time) => time,
        End::Steps(steps) => steps as f64 * dt,
    };
    let bodies = checked.scene.walls.iter().zip(surfaces).enumerate();
    for (number, (wall, surface)) in bodies {
        let Some(bounds) = surface.bounds() else {
            continue;
        };
        for a in 0..3 {
            let length = period_along(domain, a);
            if !(length.is_finite() && length > 0.0) {
                continue;
            }
            let slack = 1e-9 * length;
            let [low, high] = turned(wall, bounds, a);
            let [back, forth] = shifted(wall, end, a);
            let stays = low + back >= -slack && high + forth <= length + slack;
            let fills = low + forth <= slack && high + back >= length - slack;
            // Wall grains lie on a lattice of their own, which is another one after a period.
            if fills && !stays && of_grains[number] {
                let axis = ["x", "y", "z"][a];
                let what = format!(
                    "the wall `{}` is built of grains, which do not repeat with the periodic box along {axis}",
                    wall.name
                );
                let remedy = format!(
                    "keep it within the box, write surface: Grid(…) or Exact, or {axis}: Open in the domain"
                );
                return Err(checked.problem(&format!("walls[{number}].shape"), what, remedy));
            }
            if !(stays || fills) {
                let axis = ["x", "y", "z"][a];
                let what = format!(
                    "the wall `{}` leaves the periodic box along {axis}: it reaches from {:.4} m to {:.4} m, the box from 0 to {length:?} m, and its other side is not repeated there",
                    wall.name,
                    low + back,
                    high + forth,
                );
                let remedy = format!(
                    "keep it within the box, let it reach beyond the box at both ends, or write {axis}: Open in the domain"
                );
                return Err(checked.problem(&format!("walls[{number}].shape"), what, remedy));
            }
        }
    }
    Ok(())
}

/// The period along an axis of space; infinite along one that does not repeat, zero along one that is not there.
fn period_along<D: Dim>(domain: &Domain<D>, a: usize) -> f64 {
    D::to_space(domain.period).to_array()[a]
}

/// How far the body reaches along an axis of space, whatever its turn.
fn turned(wall: &Wall, [low, high]: [DVec3; 2], a: usize) -> [f64; 2] {
    let Some(turn) = wall.motion.as_ref().and_then(|m| m.turn) else {
        return [low[a], high[a]];
    };
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for k in 0..8 {
        let pick = |bit: usize| if k >> bit & 1 == 0 { low } else { high };
        let arm = DVec3::new(pick(0).x, pick(1).y, pick(2).z) - turn.point;
        let along = turn.axis * arm.dot(turn.axis);
        let middle = turn.point[a] + along[a];
        let swing = (arm - along).length() * (1.0 - turn.axis[a].powi(2)).max(0.0).sqrt();
        least = least.min(middle - swing);
        most = most.max(middle + swing);
    }
    [least, most]
}

/// The furthest that shifts carry the body against and along an axis of space until `end`, in m.
fn shifted(wall: &Wall, end: f64, a: usize) -> [f64; 2] {
    let Some(Motion { shifts, lasts, .. }) = &wall.motion else {
        return [0.0; 2];
    };
    let mut reach = [0.0; 2];
    for shift in shifts {
        let (from, to) = match shift.course {
            Course::Steady(speed) => (0.0, speed * lasts.unwrap_or(end).min(end)),
            Course::Swing { amplitude, .. } => (-amplitude, amplitude),
        };
        let (from, to) = (from * shift.direction[a], to * shift.direction[a]);
        reach[0] += from.min(to);
        reach[1] += from.max(to);
    }
    reach
}
