//! How a wall moves: rigidly, as prescribed.

use glam::DVec3;

/// The prescribed motion of a wall; it turns, or shifts, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Rotation, if it turns.
    pub turn: Option<Turn>,
    /// Shifts; they add up and carry the axis of rotation along. Not empty if there is no turn.
    pub shifts: Vec<Shift>,
    /// When it begins; the wall rests before.
    pub begins: Begin,
    /// How long it lasts from then, s, above zero; the wall rests where it is after. `None`: without end.
    pub lasts: Option<f64>,
}

/// Rotation about an axis, counter-clockwise seen against its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// A point of the axis, m.
    pub point: DVec3,
    /// Direction of the axis, of length 1; along y in the plane.
    pub axis: DVec3,
    /// Angular speed, rad/s; negative turns the other way.
    pub rate: f64,
}

/// A shift along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// Direction, of length 1.
    pub direction: DVec3,
    /// How far.
    pub course: Course,
}

/// How far a shift has gone a time t after it began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// At this speed, m/s; negative goes against the direction.
    Steady(f64),
    /// amplitude · sin(2π f t).
    Swing {
        /// Amplitude, m.
        amplitude: f64,
        /// Frequency f, Hz, above zero.
        frequency: f64,
    },
}

/// When a motion begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Begin {
    /// At this time from the start, s, not negative.
    At(f64),
    /// Once the grains are still, see [`Still`](super::Still).
    WhenStill,
}

impl Default for Begin {
    fn default() -> Self {
        Begin::At(0.0)
    }
}
