//! The words around the grains: the time, and a bar that says what the colours mean.

use super::View;
use crate::colour::{INK, of_share};
use crate::image::Image;
use crate::text;

const SIZE: u32 = 16;
const BAR: i64 = 16;

/// Whether the picture is large enough for words.
fn roomy(width: usize, height: usize) -> bool {
    width >= 240 && height >= 160
}

/// The room kept free of grains at the left, right, top and bottom, in pixels.
pub(super) fn room(width: usize, height: usize, view: &View) -> [f32; 4] {
    let edge = 0.02 * width.min(height) as f32;
    if !roomy(width, height) {
        return [edge; 4];
    }
    let right = if view.label.is_empty() {
        edge
    } else {
        bar_room(view) as f32
    };
    let top = if view.time.is_empty() { edge } else { 40.0 };
    [edge, right, top.max(edge), edge]
}

/// The words at the bar: low, middle and high value.
fn marks(view: &View) -> [String; 3] {
    let (low, high) = view.range;
    let size = low.abs().max(high.abs());
    let write = |value: f32| match size {
        s if !(1e-3..1e5).contains(&s) && s != 0.0 => format!("{value:.1e}"),
        s if s >= 100.0 => format!("{value:.0}"),
        s if s >= 10.0 => format!("{value:.1}"),
        s if s >= 1.0 => format!("{value:.2}"),
        s if s >= 0.1 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    };
    [low, 0.5 * low + 0.5 * high, high].map(|value| write(value).replace('-', "−"))
}

fn bar_room(view: &View) -> i64 {
    let widest = marks(view)
        .iter()
        .map(|mark| text::width(mark, SIZE.into()))
        .fold(0.0, f64::max);
    let label = text::width(view.label, SIZE.into());
    (widest + 8.0 + BAR as f64).max(label).min(220.0) as i64 + 24
}

pub(super) fn draw(image: &mut Image, view: &View) {
    if !roomy(image.width, image.height) {
        return;
    }
    image.write(14, 10, view.time, SIZE + 2);
    if view.label.is_empty() {
        return;
    }
    let left = image.width as i64 - bar_room(view) + 8;
    image.write(left, 12, view.label, SIZE);
    let (top, bottom) = (46, image.height as i64 - 24);
    image.fill(left - 1, top - 1, BAR + 2, bottom - top + 2, INK);
    for y in top..bottom {
        let share = (bottom - 1 - y) as f32 / (bottom - 1 - top).max(1) as f32;
        image.fill(left, y, BAR, 1, of_share(share));
    }
    for (index, mark) in marks(view).iter().enumerate() {
        let y = bottom - 1 - (bottom - 1 - top) * index as i64 / 2;
        image.fill(left + BAR, y, 5, 1, INK);
        image.write(left + BAR + 9, y - 11, mark, SIZE);
    }
}
