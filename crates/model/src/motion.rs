//! How a body moves: rigidly, prescribed in time. Rotation about one axis, and shifts that carry the axis along.

use crate::{Damaged, Saved, Words};
use glam::{DMat3, DVec3};

/// From when to when, in s. Before `start` and after `stop` the body rests where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Beginning in s.
    pub start: f64,
    /// End in s; infinite if there is none.
    pub stop: f64,
}

impl Span {
    /// From the first moment on, without end.
    pub const ALWAYS: Self = Self {
        start: 0.0,
        stop: f64::INFINITY,
    };

    /// How long the motion has been on at time `t`.
    fn elapsed(&self, t: f64) -> f64 {
        (t.min(self.stop) - self.start).max(0.0)
    }

    fn is_on(&self, t: f64) -> bool {
        t >= self.start && t < self.stop
    }
}

/// Rotation about an axis, counter-clockwise seen against `axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// A point of the axis in m.
    pub point: DVec3,
    /// Direction of the axis, of length 1.
    pub axis: DVec3,
    /// Angular speed in rad/s; negative turns the other way.
    pub rate: f64,
    /// When it turns.
    pub span: Span,
}

/// How far a shift has gone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// At this speed in m/s.
    Steady(f64),
    /// amplitude · sin(2π f (t − start)); amplitude in m, frequency in Hz.
    Swing {
        /// Amplitude in m.
        amplitude: f64,
        /// Frequency in Hz.
        frequency: f64,
    },
}

/// A shift along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// Direction, of length 1.
    pub direction: DVec3,
    /// How far.
    pub course: Course,
    /// When.
    pub span: Span,
}

impl Shift {
    /// Distance gone and speed at time `t`.
    fn at(&self, t: f64) -> (f64, f64) {
        let (gone, on) = (self.span.elapsed(t), self.span.is_on(t));
        let (distance, speed) = match self.course {
            Course::Steady(speed) => (speed * gone, speed),
            Course::Swing {
                amplitude,
                frequency,
            } => {
                let rate = std::f64::consts::TAU * frequency;
                (
                    amplitude * (rate * gone).sin(),
                    amplitude * rate * (rate * gone).cos(),
                )
            }
        };
        (distance, if on { speed } else { 0.0 })
    }

    fn top_speed(&self) -> f64 {
        match self.course {
            Course::Steady(speed) => speed.abs(),
            Course::Swing {
                amplitude,
                frequency,
            } => (amplitude * std::f64::consts::TAU * frequency).abs(),
        }
    }
}

/// The prescribed motion of a body; the default is rest.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::{Motion, Span, Turn};
/// // A screw along x at 60 r/min: after a quarter of a second, a quarter turn.
/// let turn = Turn { point: DVec3::ZERO, axis: DVec3::X, rate: std::f64::consts::TAU, span: Span::ALWAYS };
/// let pose = Motion { turn: Some(turn), shifts: Vec::new() }.at(0.25);
/// assert!((pose.to_world(DVec3::Y) - DVec3::Z).length() < 1e-12);
/// assert!((pose.velocity_at(DVec3::Z) + DVec3::Y * std::f64::consts::TAU).length() < 1e-12); // m/s
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Rotation, if it turns.
    pub turn: Option<Turn>,
    /// Shifts; they add up and carry the axis of rotation along.
    pub shifts: Vec<Shift>,
}

impl Motion {
    /// True if the body never moves.
    pub fn is_rest(&self) -> bool {
        self.turn.is_none() && self.shifts.is_empty()
    }

    /// Where the body is at time `t` in s, and how it moves.
    pub fn at(&self, t: f64) -> Pose {
        let mut pose = Pose::default();
        if let Some(turn) = self.turn {
            pose.pivot = turn.point;
            pose.turn = DMat3::from_axis_angle(turn.axis, turn.rate * turn.span.elapsed(t));
            if turn.span.is_on(t) {
                pose.spin = turn.axis * turn.rate;
            }
        }
        for shift in &self.shifts {
            let (distance, speed) = shift.at(t);
            pose.shift += shift.direction * distance;
            pose.velocity += shift.direction * speed;
        }
        pose
    }

    /// No point of the body that is within `reach` (m) of the axis ever moves faster, in m/s.
    pub fn top_speed(&self, reach: f64) -> f64 {
        let turning = self.turn.map_or(0.0, |t| t.rate.abs() * reach);
        turning + self.shifts.iter().map(Shift::top_speed).sum::<f64>()
    }

    /// The same motion begun `by` seconds later: for what waits for a moment that is not known before.
    pub fn delayed(&self, by: f64) -> Self {
        let later = |span: Span| Span {
            start: span.start + by,
            stop: span.stop + by,
        };
        Self {
            turn: self.turn.map(|t| Turn {
                span: later(t.span),
                ..t
            }),
            shifts: self
                .shifts
                .iter()
                .map(|s| Shift {
                    span: later(s.span),
                    ..*s
                })
                .collect(),
        }
    }
}

/// Place and velocity of a body at one moment. The body's frame is the world's at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Rotation about the pivot.
    pub turn: DMat3,
    /// A point of the axis before any shift, in m.
    pub pivot: DVec3,
    /// Shift in m.
    pub shift: DVec3,
    /// Angular velocity in rad/s.
    pub spin: DVec3,
    /// Velocity of the pivot in m/s.
    pub velocity: DVec3,
}

impl Default for Pose {
    fn default() -> Self {
        Self {
            turn: DMat3::IDENTITY,
            pivot: DVec3::ZERO,
            shift: DVec3::ZERO,
            spin: DVec3::ZERO,
            velocity: DVec3::ZERO,
        }
    }
}

impl Saved for Pose {
    fn save(&self, words: &mut Words) {
        for number in self.turn.to_cols_array() {
            words.put_number(number);
        }
        for vector in [self.pivot, self.shift, self.spin, self.velocity] {
            words.put_vector(vector);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        let mut turn = [0.0; 9];
        for number in &mut turn {
            *number = words.take_number()?;
        }
        self.turn = DMat3::from_cols_array(&turn);
        for vector in [
            &mut self.pivot,
            &mut self.shift,
            &mut self.spin,
            &mut self.velocity,
        ] {
            *vector = words.take_vector()?;
        }
        Ok(())
    }
}

impl Pose {
    /// A point of the world in the body's frame.
    pub fn to_body(&self, x: DVec3) -> DVec3 {
        self.turn.transpose() * (x - self.shift - self.pivot) + self.pivot
    }

    /// A point of the body's frame in the world.
    pub fn to_world(&self, x: DVec3) -> DVec3 {
        self.turn * (x - self.pivot) + self.pivot + self.shift
    }

    /// A direction of the body's frame in the world.
    pub fn direction(&self, n: DVec3) -> DVec3 {
        self.turn * n
    }

    /// Velocity of the body's point that is at `x` in the world, in m/s.
    pub fn velocity_at(&self, x: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(self.arm(x))
    }

    /// From the pivot, where it is now, to `x`: the arm of a force that acts there, in m.
    pub fn arm(&self, x: DVec3) -> DVec3 {
        x - self.shift - self.pivot
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn motion(rate: f64, speed: f64, amplitude: f64, frequency: f64) -> Motion {
        let span = Span {
            start: 0.5,
            stop: 3.0,
        };
        Motion {
            turn: Some(Turn {
                point: DVec3::new(0.1, 0.2, 0.3),
                axis: DVec3::new(1.0, 2.0, -2.0) / 3.0,
                rate,
                span,
            }),
            shifts: vec![
                Shift {
                    direction: DVec3::Z,
                    course: Course::Steady(speed),
                    span,
                },
                Shift {
                    direction: DVec3::Y,
                    course: Course::Swing {
                        amplitude,
                        frequency,
                    },
                    span,
                },
            ],
        }
    }

    proptest! {
        #[test]
        fn a_point_of_the_body_moves_with_the_velocity_that_is_said_and_the_map_goes_back(
            x in prop::array::uniform3(-1.0..1.0f64), t in 0.51..2.99f64,
            rate in -9.0..9.0f64, speed in -1.0..1.0f64, amplitude in -0.2..0.2f64, frequency in 0.0..3.0f64,
        ) {
            let motion = motion(rate, speed, amplitude, frequency);
            let (x, h) = (DVec3::from(x), 1e-5);
            let pose = motion.at(t);
            let went = (motion.at(t + h).to_world(x) - motion.at(t - h).to_world(x)) / (2.0 * h);
            let said = pose.velocity_at(pose.to_world(x));
            prop_assert!((went - said).length() < 1e-6 * (1.0 + said.length()) * (1.0 + rate.abs().powi(3)));
            prop_assert!((pose.to_body(pose.to_world(x)) - x).length() < 1e-12);
            // Points within 2 m of the axis: the bound holds.
            prop_assert!(said.length() <= motion.top_speed(2.5) + 1e-12);
        }
    }

    #[test]
    fn outside_its_span_a_body_rests_where_it_is_and_a_delayed_motion_is_the_same_later() {
        let motion = motion(2.0, 0.3, 0.1, 1.0);
        assert_eq!(
            motion.at(0.2),
            Pose {
                pivot: DVec3::new(0.1, 0.2, 0.3),
                ..Pose::default()
            }
        );
        let (end, later) = (motion.at(3.0), motion.at(9.0));
        assert_eq!(end, later);
        assert_eq!(end.spin, DVec3::ZERO);
        let x = DVec3::ONE;
        let (a, b) = (motion.at(1.25), motion.delayed(0.5).at(1.75));
        assert!((a.to_world(x) - b.to_world(x)).length() < 1e-14);
    }
}
