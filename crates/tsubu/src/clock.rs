//! When rows and frames are due, in steps: the same for any machine and any number of threads.

use tsubu::assemble::Plan;
use tsubu::scene::Output;

/// Rows when the scene gives no interval.
const ROWS: u64 = 100;

/// Cadence of the outputs in steps.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Steps between rows.
    pub row: u64,
    /// Steps between frames.
    pub frame: u64,
}

impl Clock {
    /// From the scene's intervals and the length of the run.
    pub fn of(output: &Output, plan: &Plan) -> Self {
        let steps = |seconds: f64| ((seconds / plan.constants.dt).round() as u64).max(1);
        let row = output
            .every
            .map_or_else(|| plan.steps.div_ceil(ROWS).max(1), steps);
        Self {
            row,
            frame: output.frames_every.map_or(row, steps),
        }
    }

    /// Steps from `now` to the next row or frame.
    pub fn to_next(self, now: u64) -> u64 {
        (self.row - now % self.row).min(self.frame - now % self.frame)
    }
}
