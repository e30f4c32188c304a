//! The figure as shapes and text on 900 × 600 points.

use std::hash::{DefaultHasher, Hash, Hasher};

use kuva::backend::{raster::RasterBackend, svg::SvgBackend};
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::axis::{Scale, drawable, possible};
use super::frame::Frame;
use super::legend::Legend;
use super::marks::{INK, LAYERS, Look, dashed, line, marker, polygon};
use super::{Figure, Kind, Place, Series};
use crate::text;

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 600.0;
const FONT: &str = "DejaVu Sans, Verdana, Arial, sans-serif";

pub(super) fn svg(figure: &Figure) -> String {
    // Without a view box a page could only crop the figure, not scale it.
    let scaling = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" ");
    SvgBackend::new()
        .render_scene(&scene(figure))
        .replacen("<svg ", &scaling, 1)
}

pub(super) fn png(figure: &Figure) -> Result<Vec<u8>, String> {
    RasterBackend { scale: 2.0 }.render_scene(&scene(figure))
}

fn scene(figure: &Figure) -> Scene {
    let mut scene = Scene::new(WIDTH, HEIGHT);
    scene.font_family = Some(FONT.to_string());
    scene.text_color = Some(INK.to_string());

    let mut top = 14.0;
    for line in text::wrap(&figure.title, 24.0, WIDTH - 40.0).iter().take(2) {
        scene.add(text::primitive(
            WIDTH / 2.0,
            top + 22.0,
            line,
            24,
            TextAnchor::Middle,
            INK,
        ));
        top += 30.0;
    }
    let legend = Legend::new(&figure.series, 70.0, WIDTH - 30.0);
    let legend_top = top + 6.0;
    top += legend.height() + 22.0;

    let notes = [figure.caption.clone(), notes(figure, &legend)].join("  ");
    let notes = text::wrap(&notes, 13.0, WIDTH - 40.0);
    let notes = &notes[..notes.len().min(4)];
    let mut bottom = HEIGHT - 10.0 - 17.0 * notes.len() as f64;
    for (row, line) in notes.iter().enumerate() {
        let y = bottom + 12.0 + 17.0 * row as f64;
        scene.add(text::primitive(
            20.0,
            y,
            line,
            13,
            TextAnchor::Start,
            "#666666",
        ));
    }
    bottom -= 68.0;

    let scales = (scale_x(figure), scale_y(figure));
    let frame = Frame::new(figure, scales, WIDTH - 34.0, (top, bottom));
    frame.draw_axes(&mut scene, figure);
    let mut hasher = DefaultHasher::new();
    format!("{figure:?}").hash(&mut hasher);
    // Figures inlined in one page must not share the name of their clipping.
    let id = format!("plot-{:016x}", hasher.finish());
    let (width, height) = (frame.right - frame.left, frame.bottom - frame.top);
    scene.defs.push(format!(
        "<clipPath id=\"{id}\"><rect x=\"{:.2}\" y=\"{:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/></clipPath>",
        frame.left, frame.top
    ));
    scene.add(Primitive::ClipStart {
        x: frame.left,
        y: frame.top,
        width,
        height,
        id,
    });
    let mut drawn = false;
    for kinds in LAYERS {
        for series in figure.series.iter().filter(|s| kinds.contains(&s.kind)) {
            let look = Look::of(&figure.series, series);
            for run in series
                .places
                .split(|p| !shown(figure, series, p))
                .filter(|run| !run.is_empty())
            {
                drawn = true;
                draw_run(&mut scene, &frame, series.kind, &look, run);
            }
        }
    }
    scene.add(Primitive::ClipEnd);
    frame.outline(&mut scene);
    if !drawn {
        let (x, y) = frame.middle();
        scene.add(text::primitive(
            x,
            y,
            "no values to draw",
            20,
            TextAnchor::Middle,
            "#666666",
        ));
    }
    legend.draw(&mut scene, figure, legend_top);
    scene
}

/// The range an axis was asked for goes before the values.
fn scale_x(figure: &Figure) -> Scale {
    let all = figure
        .series
        .iter()
        .flat_map(|s| s.places.iter().filter(|p| shown(figure, s, p)));
    Scale::new(figure.x.log, figure.x.range, all.map(|p| p.x))
}

fn scale_y(figure: &Figure) -> Scale {
    let all = figure
        .series
        .iter()
        .flat_map(|s| s.places.iter().filter(|p| shown(figure, s, p)));
    Scale::new(
        figure.y.log,
        figure.y.range,
        all.flat_map(|p| [p.low, p.y, p.high]),
    )
}

/// Whether a place can be drawn; of an error bar on a logarithmic axis only the positive part is needed.
fn shown(figure: &Figure, series: &Series, place: &Place) -> bool {
    let y = |value| drawable(figure.y.log, value);
    let there = if series.kind == Kind::Band {
        y(place.low) && y(place.high)
    } else {
        y(place.y)
    };
    there && drawable(figure.x.log, place.x) && place.low.is_finite() && place.high.is_finite()
}

/// What the reader must know about values and ranges that are not in the picture.
fn notes(figure: &Figure, legend: &Legend) -> String {
    let left_out: usize = figure
        .series
        .iter()
        .map(|s| s.places.iter().filter(|p| !shown(figure, s, p)).count())
        .sum();
    let mut notes = String::new();
    if left_out > 0 {
        let word = if left_out == 1 { "value" } else { "values" };
        notes = format!("[{left_out} {word} left out: not finite, or not positive on a log axis]");
    }
    for (name, axis) in [("x", &figure.x), ("y", &figure.y)] {
        if axis.range.is_some_and(|range| !possible(axis.log, range)) {
            notes += &format!(" [the {name} range asked for cannot be shown]");
        }
    }
    if legend.left_out > 0 {
        notes += &format!(" [{} labels found no room]", legend.left_out);
    }
    notes
}

fn draw_run(scene: &mut Scene, frame: &Frame, kind: Kind, look: &Look, run: &[Place]) {
    let colour = look.colour.as_str();
    let points: Vec<_> = run.iter().map(|p| frame.at(p.x, p.y)).collect();
    match kind {
        Kind::Theory => dashed(scene, &points, colour, 3.0, look.dash),
        Kind::Line => line(scene, &points, colour, 2.5),
        Kind::Band => {
            let lower = run.iter().rev().map(|p| frame.at(p.x, p.low));
            let around: Vec<_> = run
                .iter()
                .map(|p| frame.at(p.x, p.high))
                .chain(lower)
                .collect();
            polygon(scene, &around, colour, Some(0.3));
        }
        Kind::Points | Kind::Measured => {
            for (place, &at) in run.iter().zip(&points) {
                let (low, high) = (
                    frame.at(place.x, place.low).1,
                    frame.at(place.x, place.high).1,
                );
                if place.high > place.low {
                    line(scene, &[(at.0, low), (at.0, high)], colour, 2.0);
                    for y in [low, high] {
                        line(scene, &[(at.0 - 6.0, y), (at.0 + 6.0, y)], colour, 2.0);
                    }
                }
                marker(scene, look, at);
            }
        }
    }
    if let ([only], Kind::Theory | Kind::Line) = (&points[..], kind) {
        // A line of one place would be invisible.
        line(
            scene,
            &[(only.0 - 8.0, only.1), (only.0 + 8.0, only.1)],
            colour,
            3.0,
        );
    }
}
