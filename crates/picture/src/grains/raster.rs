//! Which grain or wall each pixel shows, and how light falls on it.
//!
//! A pixel is the mean of 2 × 2 samples, which softens all edges.
//! The picture is cut into bands of rows that know nothing of each other, and within a band grains are taken in their order, so threads cannot matter.

use rayon::prelude::*;

use super::{Projection, Scene3, View};
use crate::colour::{self, INK, PAPER, Rgb};
use crate::image::Image;

/// Samples along each side of a pixel.
const FINE: usize = 2;
/// Rows of pixels in a band.
const BAND: usize = 12;
/// No grain.
const NONE: u32 = u32::MAX;
/// Half the width of a line, in pixels.
const HALF_LINE: f32 = 0.9;
/// How strongly a wall covers what is behind it.
const WALL: f32 = 0.10;
const WALL_COLOUR: Rgb = [90, 105, 120];
/// The light comes from the upper left, from behind the viewer.
const LIGHT: [f32; 3] = [-0.45, 0.55, 0.70];
/// Where the light falls as it does on the middle of a grain, within this, the colour is that of the value.
const FULL: f32 = 0.03;

/// A grain in samples.
struct Disc {
    x: f32,
    y: f32,
    depth: f32,
    radius: f32,
    colour: Rgb,
}

/// A line in samples, with depth.
struct Stroke {
    from: [f32; 3],
    to: [f32; 3],
}

/// A triangle in samples, with the light that falls on it already in its colour.
struct Face {
    corners: [[f32; 3]; 3],
    colour: Rgb,
}

impl Face {
    /// `None` if it is seen from its edge or has no place.
    fn new(corners: [[f32; 3]; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let edge = |to: [f32; 3]| -> [f32; 3] { std::array::from_fn(|i| to[i] - a[i]) };
        // Samples count rows downwards; the normal is taken with y upwards, towards the viewer.
        let [n, m] = [edge(b), edge(c)].map(|e| [e[0], -e[1], e[2]]);
        let normal = super::unit(super::cross(n, m))?;
        let seen = corners.iter().flatten().all(|c| c.abs() < 1e9) && normal[2].abs() > 1e-3;
        let towards = if normal[2] < 0.0 { -1.0 } else { 1.0 };
        let lit = towards * super::dot(normal, LIGHT);
        seen.then(|| Self {
            corners,
            colour: colour::mix([70, 74, 80], [225, 228, 232], lit.clamp(0.0, 1.0)),
        })
    }
}

/// A parallelogram in samples: corner, edges, and the plane through it.
struct Sheet {
    corner: [f32; 3],
    edges: [[f32; 3]; 2],
    area: f32,
}

pub(super) fn draw(scene: &Scene3, projection: &Projection, view: &View, image: &mut Image) {
    let fine = |point| projection.place(point).map(|c| c * FINE as f32);
    let scale = projection.scale * FINE as f32;
    let discs: Vec<Disc> = scene
        .centres
        .par_iter()
        .enumerate()
        .map(|(index, &centre)| {
            let [x, y, depth] = fine(centre);
            // A grain never shrinks below what a sample can see.
            let radius = (scene.radius(index) * scale).max(0.75);
            Disc {
                x,
                y,
                depth,
                radius,
                colour: scene.colour(index, view.range),
            }
        })
        .collect();
    let mut strokes: Vec<Stroke> = scene
        .segments
        .iter()
        .map(|s| Stroke {
            from: fine(s.from),
            to: fine(s.to),
        })
        .collect();
    let mut sheets = Vec::new();
    for quad in scene.quads {
        let [a, b, c, d] = quad.corners().map(fine);
        strokes.extend([(a, b), (b, c), (c, d), (d, a)].map(|(from, to)| Stroke { from, to }));
        let edges = [b, d].map(|end| std::array::from_fn(|i| end[i] - a[i]));
        let area = edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0];
        // A wall seen along its plane is only its outline.
        if area.abs() > 1.0 && area.is_finite() {
            sheets.push(Sheet {
                corner: a,
                edges,
                area,
            });
        }
    }
    let faces: Vec<Face> = scene
        .faces
        .iter()
        .filter_map(|corners| Face::new(corners.map(fine)))
        .collect();
    strokes.retain(|s| s.from.iter().chain(&s.to).all(|c| c.abs() < 1e9));

    let (width, height) = (image.width, image.height);
    let mut bands: Vec<Vec<u32>> = vec![Vec::new(); height.div_ceil(BAND)];
    let limit = (height * FINE) as f32;
    for (index, disc) in discs.iter().enumerate() {
        // Written so that what is not a number fails.
        let seen = disc.x.abs() < 1e9
            && disc.depth.abs() < 1e9
            && disc.radius < 1e9
            && scene.radius(index) > 0.0
            && disc.y + disc.radius >= 0.0
            && disc.y - disc.radius < limit;
        if seen {
            let band = |y: f32| (y.max(0.0) as usize / (BAND * FINE)).min(bands.len() - 1);
            let (first, last) = (band(disc.y - disc.radius), band(disc.y + disc.radius));
            bands[first..=last]
                .iter_mut()
                .for_each(|band| band.push(index as u32));
        }
    }
    image
        .pixels
        .par_chunks_mut(3 * width * BAND)
        .zip(&bands)
        .enumerate()
        .for_each(|(band, (pixels, inside))| {
            let mut samples = Samples::new(
                width * FINE,
                band * BAND * FINE,
                pixels.len() / (3 * width) * FINE,
            );
            for &index in inside {
                samples.disc(index, &discs[index as usize]);
            }
            faces.iter().for_each(|face| samples.face(face));
            samples.shade(&discs);
            sheets.iter().for_each(|sheet| samples.sheet(sheet));
            strokes.iter().for_each(|stroke| samples.stroke(stroke));
            samples.gather(width, pixels);
        });
}

/// The samples of one band.
struct Samples {
    width: usize,
    first_row: usize,
    rows: usize,
    depth: Vec<f32>,
    grain: Vec<u32>,
    colour: Vec<Rgb>,
}

impl Samples {
    fn new(width: usize, first_row: usize, rows: usize) -> Self {
        let count = width * rows;
        Self {
            width,
            first_row,
            rows,
            depth: vec![f32::NEG_INFINITY; count],
            grain: vec![NONE; count],
            colour: vec![PAPER; count],
        }
    }

    /// The rows and columns of this band that a span of samples covers.
    fn clip(
        &self,
        x: (f32, f32),
        y: (f32, f32),
    ) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        let within = |low: f32, high: f32, first: usize, count: usize| {
            let low = (low.floor().max(first as f32) as usize)
                .saturating_sub(first)
                .min(count);
            let high = (high.ceil().max(first as f32) as usize)
                .saturating_sub(first)
                .min(count);
            low..high
        };
        (
            within(x.0, x.1, 0, self.width),
            within(y.0, y.1, self.first_row, self.rows),
        )
    }

    fn disc(&mut self, index: u32, disc: &Disc) {
        let (x, y, r) = (disc.x, disc.y, disc.radius);
        let (_, rows) = self.clip((x - r, x + r), (y - r, y + r));
        for row in rows {
            let dy = (self.first_row + row) as f32 + 0.5 - y;
            let half = (r * r - dy * dy).max(0.0).sqrt();
            let (columns, _) = self.clip((x - half, x + half), (y, y));
            for column in columns {
                let dx = column as f32 + 0.5 - x;
                let height = r * r - dx * dx - dy * dy;
                if height < 0.0 {
                    continue;
                }
                let depth = disc.depth + height.sqrt();
                let at = row * self.width + column;
                if depth > self.depth[at] {
                    self.depth[at] = depth;
                    self.grain[at] = index;
                }
            }
        }
    }

    fn face(&mut self, face: &Face) {
        let [a, b, c] = face.corners;
        let span = |i: usize| (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let (columns, rows) = self.clip(span(0), span(1));
        for row in rows {
            for column in columns.clone() {
                let x = column as f32 + 0.5 - a[0];
                let y = (self.first_row + row) as f32 + 0.5 - a[1];
                let u = (x * (c[1] - a[1]) - y * (c[0] - a[0])) / area;
                let v = (y * (b[0] - a[0]) - x * (b[1] - a[1])) / area;
                let depth = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]);
                let at = row * self.width + column;
                if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && depth > self.depth[at] {
                    self.depth[at] = depth;
                    self.grain[at] = NONE;
                    self.colour[at] = face.colour;
                }
            }
        }
    }

    /// Light on the grains: full colour where a grain faces the viewer, a small highlight, a dark rim.
    fn shade(&mut self, discs: &[Disc]) {
        for (at, &grain) in self.grain.iter().enumerate() {
            if grain == NONE {
                continue;
            }
            let disc = &discs[grain as usize];
            let x = ((at % self.width) as f32 + 0.5 - disc.x) / disc.radius;
            let y = (disc.y - (self.first_row + at / self.width) as f32 - 0.5) / disc.radius;
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            let lit = LIGHT[0] * x + LIGHT[1] * y + LIGHT[2] * z - LIGHT[2];
            let mut colour = if lit > FULL {
                colour::mix(
                    disc.colour,
                    [255; 3],
                    0.55 * (lit - FULL) / (1.0 - LIGHT[2] - FULL),
                )
            } else if lit < -FULL {
                colour::mix(disc.colour, [0; 3], (-0.45 * (lit + FULL)).min(0.5))
            } else {
                disc.colour
            };
            // The rim is about a pixel wide whatever the size, but never more than the outer fifth.
            let rim = (FINE as f32 * 1.1 / disc.radius).clamp(0.03, 0.2);
            let inside = ((1.0 - (x * x + y * y).sqrt()) / rim).clamp(0.0, 1.0);
            colour = colour::mix(colour, [15, 15, 25], 0.55 * (1.0 - inside));
            self.colour[at] = colour;
        }
    }

    fn sheet(&mut self, sheet: &Sheet) {
        let [a, b] = sheet.edges;
        let span = |i: usize| {
            let ends = [0.0, a[i], b[i], a[i] + b[i]].map(|d| sheet.corner[i] + d);
            (
                ends.into_iter().fold(f32::INFINITY, f32::min),
                ends.into_iter().fold(f32::NEG_INFINITY, f32::max),
            )
        };
        let (columns, rows) = self.clip(span(0), span(1));
        for row in rows {
            for column in columns.clone() {
                let x = column as f32 + 0.5 - sheet.corner[0];
                let y = (self.first_row + row) as f32 + 0.5 - sheet.corner[1];
                let u = (x * b[1] - y * b[0]) / sheet.area;
                let v = (a[0] * y - a[1] * x) / sheet.area;
                let at = row * self.width + column;
                let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
                if inside && sheet.corner[2] + u * a[2] + v * b[2] >= self.depth[at] {
                    self.colour[at] = colour::mix(self.colour[at], WALL_COLOUR, WALL);
                }
            }
        }
    }

    fn stroke(&mut self, stroke: &Stroke) {
        let (from, to) = (stroke.from, stroke.to);
        let half = HALF_LINE * FINE as f32;
        let along = [to[0] - from[0], to[1] - from[1]];
        let square = (along[0] * along[0] + along[1] * along[1]).max(1e-12);
        let (low, high) = (from[1].min(to[1]) - half, from[1].max(to[1]) + half);
        let (_, rows) = self.clip((0.0, 0.0), (low, high));
        for row in rows {
            let y = (self.first_row + row) as f32 + 0.5;
            // Only the columns near the line in this row, so that long lines stay cheap.
            let reach = |s: f32| (y + s * (half + 1.0) - from[1]) / along[1];
            let shares = if along[1].abs() < 1e-3 {
                (0.0, 1.0)
            } else {
                (reach(-1.0), reach(1.0))
            };
            let [p, q] = [shares.0, shares.1].map(|s| from[0] + s.clamp(0.0, 1.0) * along[0]);
            let (columns, _) =
                self.clip((p.min(q) - 2.0 * half, p.max(q) + 2.0 * half), (0.0, 0.0));
            for column in columns {
                let x = column as f32 + 0.5;
                let share = ((x - from[0]) * along[0] + (y - from[1]) * along[1]) / square;
                let share = share.clamp(0.0, 1.0);
                let (dx, dy) = (
                    x - from[0] - share * along[0],
                    y - from[1] - share * along[1],
                );
                let depth = from[2] + share * (to[2] - from[2]) + half;
                let at = row * self.width + column;
                if dx * dx + dy * dy <= half * half && depth >= self.depth[at] {
                    self.colour[at] = colour::mix(self.colour[at], INK, 0.8);
                }
            }
        }
    }

    /// The mean of the samples of each pixel.
    fn gather(&self, width: usize, pixels: &mut [u8]) {
        for (at, pixel) in pixels.chunks_exact_mut(3).enumerate() {
            let corner = at / width * FINE * self.width + at % width * FINE;
            let mut sum = [0u32; 3];
            for sample in
                (0..FINE * FINE).map(|i| self.colour[corner + i / FINE * self.width + i % FINE])
            {
                (0..3).for_each(|i| sum[i] += u32::from(sample[i]));
            }
            (0..3).for_each(|i| pixel[i] = ((sum[i] + 2) / (FINE * FINE) as u32) as u8);
        }
    }
}
