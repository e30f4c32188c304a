//! The rectangle of a figure: its scales, its grid, and the words along its sides.

use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::Figure;
use super::axis::{Scale, Tick, power_of_ten};
use super::marks::{INK, line};
use crate::text;

/// The size of the numbers along the axes.
const TICK_TEXT: u32 = 17;

/// The rectangle of the axes and the scales along its sides.
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    x: Scale,
    y: Scale,
}

impl Frame {
    /// The rectangle between these sides, less the room for the numbers at its left.
    pub(super) fn new(
        figure: &Figure,
        (x, y): (Scale, Scale),
        right: f64,
        (top, bottom): (f64, f64),
    ) -> Self {
        let mut frame = Self {
            left: 0.0,
            right,
            top,
            bottom,
            x,
            y,
        };
        frame.make_room();
        if figure.equal_aspect && !figure.x.log && !figure.y.log {
            let across = frame.x.span() / (frame.right - frame.left);
            let along = frame.y.span() / (frame.bottom - frame.top);
            frame.x.stretch((along / across).max(1.0));
            frame.y.stretch((across / along).max(1.0));
            frame.make_room();
        }
        frame
    }

    fn make_room(&mut self) {
        self.left = 52.0 + widest(&self.y.ticks(6).0);
    }

    /// Where a place of the figure lies, in pixels.
    pub(super) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.x.share(x) * (self.right - self.left),
            self.bottom - self.y.share(y) * (self.bottom - self.top),
        )
    }

    pub(super) fn draw_axes(&self, scene: &mut Scene, figure: &Figure) {
        let (across, along) = (self.right - self.left, self.bottom - self.top);
        let (mut x_ticks, mut x_power) = self.x.ticks((across / 110.0) as usize);
        let labelled = x_ticks.iter().filter(|t| !t.label.is_empty()).count() as f64;
        if labelled * (widest(&x_ticks) + 14.0) > across {
            (x_ticks, x_power) = self.x.ticks((across / 220.0) as usize);
        }
        let (y_ticks, y_power) = self.y.ticks(6);
        let mut word = |x, y, text: &str, anchor| {
            scene.add(text::primitive(x, y, text, TICK_TEXT, anchor, INK));
        };
        let mut grid = Vec::new();
        for tick in &x_ticks {
            let x = self.left + tick.share * across;
            grid.push((!tick.label.is_empty(), [(x, self.top), (x, self.bottom)]));
            word(x, self.bottom + 24.0, &tick.label, TextAnchor::Middle);
        }
        for tick in &y_ticks {
            let y = self.bottom - tick.share * along;
            grid.push((!tick.label.is_empty(), [(self.left, y), (self.right, y)]));
            word(self.left - 9.0, y + 6.0, &tick.label, TextAnchor::End);
        }
        // Labelled lines over the faint ones.
        grid.sort_by_key(|(labelled, _)| *labelled);
        for (labelled, ends) in grid {
            line(
                scene,
                &ends,
                if labelled { "#d9d9d9" } else { "#f0f0f0" },
                1.0,
            );
        }
        let (x, y) = self.middle();
        let below = scaled(&figure.x.label, x_power);
        let size = fitting(&below, across);
        scene.add(text::primitive(
            x,
            self.bottom + 54.0,
            &below,
            size,
            TextAnchor::Middle,
            INK,
        ));
        let beside = scaled(&figure.y.label, y_power);
        let size = fitting(&beside, along);
        let mut label = text::primitive(26.0, y, &beside, size, TextAnchor::Middle, INK);
        if let Primitive::Text { rotate, .. } = &mut label {
            *rotate = Some(-90.0);
        }
        scene.add(label);
    }

    pub(super) fn outline(&self, scene: &mut Scene) {
        let (l, r, t, b) = (self.left, self.right, self.top, self.bottom);
        line(
            scene,
            &[(l, t), (r, t), (r, b), (l, b), (l, t)],
            "#444444",
            2.0,
        );
    }

    pub(super) fn middle(&self) -> (f64, f64) {
        (
            (self.left + self.right) / 2.0,
            (self.top + self.bottom) / 2.0,
        )
    }
}

/// The label of an axis with the power of ten of its numbers.
fn scaled(label: &str, power: i32) -> String {
    match power {
        0 => label.to_string(),
        _ => format!("{label}, numbers × {}", power_of_ten(power)),
    }
}

fn widest(ticks: &[Tick]) -> f64 {
    ticks
        .iter()
        .map(|tick| text::width(&tick.label, TICK_TEXT.into()))
        .fold(20.0, f64::max)
}

/// The size at which a label of an axis fits along it.
fn fitting(label: &str, length: f64) -> u32 {
    (20.0 * length / text::width(label, 20.0).max(1.0)).clamp(11.0, 20.0) as u32
}
