//! What the marks of a figure mean, in rows above it, where it can hide nothing.

use kuva::render::render::{Scene, TextAnchor};

use super::marks::{INK, LAYERS, Look, dashed, marker, rectangle};
use super::{Figure, Kind, Series};
use crate::text;

const SIZE: u32 = 17;
const ROW: f64 = 26.0;
/// More rows would leave no room for the plot.
const MOST_ROWS: usize = 7;

/// The labels of a figure, each once, and where each stands.
pub(super) struct Legend<'a> {
    entries: Vec<(&'a str, f64, usize)>,
    /// How many labels found no room.
    pub(super) left_out: usize,
}

impl<'a> Legend<'a> {
    /// The labels of the series in rows from `left` to `right`.
    pub(super) fn new(series: &'a [Series], left: f64, right: f64) -> Self {
        let mut entries: Vec<(&str, f64, usize)> = Vec::new();
        let (mut x, mut row, mut left_out) = (left, 0, 0);
        for (index, one) in series.iter().enumerate() {
            let label = one.label.as_str();
            if label.is_empty() || series[..index].iter().any(|s| s.label == label) {
                continue;
            }
            let width = 62.0 + text::width(&short(label), SIZE.into());
            if x > left && x + width > right {
                (x, row) = (left, row + 1);
            }
            if row < MOST_ROWS {
                entries.push((label, x, row));
            } else {
                left_out += 1;
            }
            x += width;
        }
        Self { entries, left_out }
    }

    pub(super) fn height(&self) -> f64 {
        self.entries
            .last()
            .map_or(0.0, |(_, _, row)| ROW * (row + 1) as f64)
    }

    pub(super) fn draw(&self, scene: &mut Scene, figure: &Figure, top: f64) {
        for &(label, x, row) in &self.entries {
            let y = top + ROW * (row as f64 + 0.5);
            for kinds in LAYERS {
                let same = |s: &&Series| s.label == label && kinds.contains(&s.kind);
                for series in figure.series.iter().filter(same) {
                    let look = Look::of(&figure.series, series);
                    let colour = look.colour.as_str();
                    match series.kind {
                        Kind::Theory | Kind::Line => {
                            dashed(scene, &[(x, y), (x + 30.0, y)], colour, 3.0, look.dash)
                        }
                        Kind::Band => rectangle(scene, x, y - 8.0, 30.0, 16.0, colour),
                        Kind::Points | Kind::Measured => marker(scene, &look, (x + 15.0, y)),
                    }
                }
            }
            let label = short(label);
            scene.add(text::primitive(
                x + 38.0,
                y + 6.0,
                &label,
                SIZE,
                TextAnchor::Start,
                INK,
            ));
        }
    }
}

/// A label that fits in one row.
fn short(label: &str) -> String {
    let mut short: String = label.chars().take(70).collect();
    if short.len() < label.len() {
        short.push('…');
    }
    short
}
