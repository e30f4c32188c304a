//! The rules of the motion of walls.

use glam::DVec3;

use super::Rules;
use super::room::periods;
use super::vectors::{lengths, numbers};
use crate::raw::{RawBegin, RawMotion, RawShift, RawTurn};
use crate::scene::{Begin, Course, Domain, Motion, Shape, Shift, Space, Turn};

/// How far from parallel a direction may be: the rounding of a direction that was brought to length 1.
const PARALLEL: f64 = 1e-12;

impl Rules<'_> {
    pub(super) fn motion(
        &mut self,
        path: &str,
        raw: &RawMotion,
        shape: &Shape,
        domain: &Domain,
    ) -> Motion {
        let turn = raw
            .turn
            .as_ref()
            .map(|turn| self.turn(&format!("{path}.turn"), turn));
        if let (Some(turn), Shape::HalfSpace { outward, .. }) = (&turn, shape) {
            self.stays_parallel(&format!("{path}.turn.axis"), turn, *outward, domain);
        }
        let raw_shifts = raw.shifts.as_deref().unwrap_or_default();
        let shifts: Vec<Shift> = raw_shifts
            .iter()
            .enumerate()
            .map(|(i, shift)| self.shift(&format!("{path}.shifts[{i}]"), shift))
            .collect();
        if turn.is_none() && shifts.is_empty() {
            self.refuse(
                path,
                "this motion has neither a turn nor a shift",
                "add turn: (point: …, axis: …, rate: …) or shifts: [(direction: …, speed: …)], or remove the motion",
            );
        }
        let begins = match raw.begins {
            None => Begin::default(),
            Some(RawBegin::WhenStill) => Begin::WhenStill,
            Some(RawBegin::At(time)) => Begin::At(self.not_negative(
                &format!("{path}.begins[0]"),
                "the time when the motion begins",
                time.0,
            )),
        };
        let lasts = raw.lasts.map(|time| {
            self.above_zero(
                &format!("{path}.lasts"),
                "how long the motion lasts",
                time.0,
            )
        });
        Motion {
            turn,
            shifts,
            begins,
            lasts,
        }
    }

    fn turn(&mut self, path: &str, raw: &RawTurn) -> Turn {
        let point = lengths(&raw.point);
        self.in_plane(&format!("{path}.point"), point);
        let axis_path = format!("{path}.axis");
        let example = "write the direction of the axis, such as (1, 0, 0)";
        let axis = self.direction(&axis_path, "axis of the turn", example, &raw.axis);
        let [x, _, z] = numbers(&raw.axis).to_array();
        if self.space == Space::Plane && (x != 0.0 || z != 0.0) {
            self.refuse(
                axis_path,
                "this turn leads out of the plane",
                "in a plane scene the axis is along y: (0, 1, 0) or (0, -1, 0)",
            );
        }
        Turn {
            point,
            axis,
            rate: raw.rate.0,
        }
    }

    /// Refuses a turn that would tilt a half-space out of a periodic axis. Its shifts cannot.
    fn stays_parallel(&mut self, path: &str, turn: &Turn, outward: DVec3, domain: &Domain) {
        let along = |one: DVec3, other: DVec3| one.cross(other).length() <= PARALLEL;
        for (i, name, _) in periods(domain) {
            if !along(turn.axis, DVec3::AXES[i]) && !along(turn.axis, outward) {
                self.refuse(
                    path,
                    format!("this wall would not stay parallel to the periodic axis {name}"),
                    format!(
                        "turn it about {name} or about its normal, or write {name}: Open in the domain"
                    ),
                );
            }
        }
    }

    fn shift(&mut self, path: &str, raw: &RawShift) -> Shift {
        let direction_path = format!("{path}.direction");
        self.in_plane(&direction_path, numbers(&raw.direction));
        let example = "write where it goes, such as (0, 0, 1)";
        let direction = self.direction(
            &direction_path,
            "direction of the shift",
            example,
            &raw.direction,
        );
        let remedy = "write speed for a steady shift, or amplitude and frequency for a swing";
        let course = match (raw.speed, raw.amplitude, raw.frequency) {
            (Some(speed), None, None) => Course::Steady(speed.0),
            (None, Some(amplitude), Some(frequency)) => Course::Swing {
                amplitude: amplitude.0,
                frequency: self.above_zero(
                    &format!("{path}.frequency"),
                    "the frequency",
                    frequency.0,
                ),
            },
            (speed, amplitude, _) => {
                let (field, what) = match (speed.is_some(), amplitude.is_some()) {
                    (true, true) => (".amplitude", "this shift has both a speed and an amplitude"),
                    (true, false) => (".frequency", "this shift has both a speed and a frequency"),
                    (false, true) => ("", "this shift has an amplitude, but no frequency"),
                    (false, false) if raw.frequency.is_some() => {
                        ("", "this shift has a frequency, but no amplitude")
                    }
                    (false, false) => ("", "this shift has neither a speed nor an amplitude"),
                };
                self.refuse(format!("{path}{field}"), what, remedy);
                Course::Steady(0.0)
            }
        };
        Shift { direction, course }
    }
}
