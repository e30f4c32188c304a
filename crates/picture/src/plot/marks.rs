//! The marks of a figure: how each series looks, and the lines, areas and points that are drawn.

use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive, Scene};

use super::{Kind, Series};
use crate::colour;

/// Text, and the line of theory.
pub(super) const INK: &str = "#222222";

/// Bands lie below, points above.
pub(super) const LAYERS: [&[Kind]; 3] = [
    &[Kind::Band],
    &[Kind::Line, Kind::Theory],
    &[Kind::Measured, Kind::Points],
];

/// How a series looks; series of the same label look the same.
pub(super) struct Look {
    pub(super) colour: String,
    /// Which of four shapes its points have; none for the first set of values measured by others.
    shape: Option<usize>,
    /// How its line is broken; none for an unbroken one.
    pub(super) dash: Option<&'static str>,
}

/// Lines of theory after each other, all in ink.
const DASHES: [Option<&str>; 4] = [None, Some("10 6"), Some("3 5"), Some("14 5 3 5")];
/// Values measured by others, set after set.
const GREYS: [&str; 3] = ["#8c8c8c", "#4d4d4d", "#b5b5b5"];

impl Look {
    pub(super) fn of(all: &[Series], series: &Series) -> Self {
        let before = |kinds: &[Kind]| {
            let mut labels: Vec<&str> = Vec::new();
            for other in all.iter().filter(|s| kinds.contains(&s.kind)) {
                if other.label == series.label {
                    break;
                }
                if !labels.contains(&other.label.as_str()) {
                    labels.push(&other.label);
                }
            }
            labels.len()
        };
        match series.kind {
            Kind::Theory => Self {
                colour: INK.to_owned(),
                shape: None,
                dash: DASHES[before(&[Kind::Theory]) % DASHES.len()],
            },
            Kind::Measured => {
                let set = before(&[Kind::Measured]);
                Self {
                    colour: GREYS[set % GREYS.len()].to_owned(),
                    shape: (set > 0).then_some(set % 4),
                    dash: None,
                }
            }
            Kind::Line | Kind::Points | Kind::Band => {
                let colour = before(&[Kind::Line, Kind::Points, Kind::Band]) % colour::SERIES.len();
                Self {
                    colour: colour::hex(colour::SERIES[colour]),
                    shape: Some(before(&[Kind::Points]) % 4),
                    dash: None,
                }
            }
        }
    }
}

/// The shape of points differs from series to series, so that colour is never the only difference.
pub(super) fn marker(scene: &mut Scene, look: &Look, (x, y): (f64, f64)) {
    let r = 6.0;
    let shape: &[(f64, f64)] = match look.shape {
        Some(1) => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        Some(2) => &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
        Some(3) => &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)],
        circle => {
            scene.add(Primitive::Circle {
                cx: x,
                cy: y,
                r: if circle.is_none() { 5.0 } else { r },
                fill: Color::from(look.colour.as_str()),
                fill_opacity: None,
                stroke: None,
                stroke_width: None,
            });
            return;
        }
    };
    let points: Vec<_> = shape
        .iter()
        .map(|(dx, dy)| (x + r * dx, y + r * dy))
        .collect();
    polygon(scene, &points, &look.colour, None);
}

pub(super) fn polygon(
    scene: &mut Scene,
    points: &[(f64, f64)],
    colour: &str,
    opacity: Option<f64>,
) {
    let corners: Vec<String> = points
        .iter()
        .map(|(x, y)| format!("{x:.2} {y:.2}"))
        .collect();
    scene.add(Primitive::Path(Box::new(PathData {
        d: format!("M {} Z", corners.join(" L ")),
        fill: Some(Color::from(colour)),
        stroke: Color::None,
        stroke_width: 0.0,
        opacity,
        stroke_dasharray: None,
    })));
}

pub(super) fn rectangle(scene: &mut Scene, x: f64, y: f64, width: f64, height: f64, colour: &str) {
    polygon(
        scene,
        &[
            (x, y),
            (x + width, y),
            (x + width, y + height),
            (x, y + height),
        ],
        colour,
        Some(0.3),
    );
}

pub(super) fn line(scene: &mut Scene, points: &[(f64, f64)], colour: &str, width: f64) {
    dashed(scene, points, colour, width, None);
}

pub(super) fn dashed(
    scene: &mut Scene,
    points: &[(f64, f64)],
    colour: &str,
    width: f64,
    dash: Option<&str>,
) {
    scene.add(Primitive::PolyLine {
        points: points.to_vec(),
        stroke: Color::from(colour),
        stroke_width: width,
        stroke_dasharray: dash.map(str::to_owned),
    });
}
