//! Shaded spheres and walls, drawn by the processor: what a heap or a machine looks like, coloured by a value.
//!
//! The view is parallel, without perspective, so lengths can be compared anywhere in the picture.
//! The same scene gives the same bytes for any number of threads.

use crate::colour::{PAPER, UNKNOWN, of_share};
use crate::image::Image;

mod labels;
mod raster;

/// What is drawn; grains with a place or size that is not finite are left out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scene3<'a> {
    /// Where the grains are.
    pub centres: &'a [[f32; 3]],
    /// How large they are.
    pub radii: Radii<'a>,
    /// The value of each grain that gives its colour; grey where there is none.
    pub values: &'a [f32],
    /// Walls, drawn translucent with an outline.
    pub quads: &'a [Quad],
    /// Lines, for edges of machines.
    pub segments: &'a [Segment],
    /// Triangles of machines, opaque: the three corners of each.
    pub faces: &'a [[[f32; 3]; 3]],
}

/// The radii of grains.
#[derive(Clone, Copy, Debug)]
pub enum Radii<'a> {
    /// All grains have this radius.
    Same(f32),
    /// Each grain has its own.
    Each(&'a [f32]),
}

impl Default for Radii<'_> {
    fn default() -> Self {
        Self::Same(0.0)
    }
}

/// A straight line between two points.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// One end.
    pub from: [f32; 3],
    /// The other end.
    pub to: [f32; 3],
}

/// A parallelogram: a corner and the two edges that leave it.
#[derive(Clone, Copy, Debug)]
pub struct Quad {
    /// A corner.
    pub corner: [f32; 3],
    /// The two edges that leave the corner.
    pub edges: [[f32; 3]; 2],
}

/// From where the scene is seen; the box from `low` to `high` fills the picture.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// The direction in which the viewer looks.
    pub look: [f32; 3],
    /// What is up in the picture.
    pub up: [f32; 3],
    /// The lower corner of the box to show.
    pub low: [f32; 3],
    /// The upper corner of the box to show.
    pub high: [f32; 3],
}

impl Camera {
    /// From the front: x to the right, z up.
    pub fn front(low: [f32; 3], high: [f32; 3]) -> Self {
        Self {
            look: [0.0, 1.0, 0.0],
            up: [0.0, 0.0, 1.0],
            low,
            high,
        }
    }

    /// From above, and the view of plane scenes: x to the right, y up.
    pub fn above(low: [f32; 3], high: [f32; 3]) -> Self {
        Self {
            look: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            low,
            high,
        }
    }

    /// From the front, somewhat from the right and above, for scenes with depth.
    pub fn oblique(low: [f32; 3], high: [f32; 3]) -> Self {
        Self {
            look: [-0.45, 0.8, -0.4],
            up: [0.0, 0.0, 1.0],
            low,
            high,
        }
    }

    /// Right, up and towards the viewer as unit vectors; an impossible camera looks from the front.
    fn axes(&self) -> [[f32; 3]; 3] {
        let towards = unit(self.look.map(|c| -c)).unwrap_or([0.0, -1.0, 0.0]);
        let right = [self.up, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
        let right = right
            .into_iter()
            .find_map(|up| unit(cross(up, towards)))
            .unwrap_or([1.0, 0.0, 0.0]);
        [right, cross(towards, right), towards]
    }
}

/// The picture around the scene: its size, what the colours mean, and the time.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Pixels in a row, at most 8192.
    pub width: usize,
    /// Rows, at most 8192.
    pub height: usize,
    /// The values of the first and the last colour.
    pub range: (f32, f32),
    /// What the colours mean, with the unit: `"speed (m/s)"`; without it there is no colour bar.
    pub label: &'a str,
    /// The line in the upper left corner, usually the time: `"t = 1.20 s"`.
    pub time: &'a str,
}

impl Default for View<'_> {
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            range: (0.0, 1.0),
            label: "",
            time: "",
        }
    }
}

impl Scene3<'_> {
    /// The box that holds all grains and walls, to place a camera; for an animation, of its widest frame.
    pub fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let mut hold = |point: [f32; 3], reach: f32| {
            if point.iter().all(|c| c.is_finite()) && reach.is_finite() {
                low = std::array::from_fn(|i| low[i].min(point[i] - reach));
                high = std::array::from_fn(|i| high[i].max(point[i] + reach));
            }
        };
        for (index, &centre) in self.centres.iter().enumerate() {
            hold(centre, self.radius(index));
        }
        self.quads
            .iter()
            .flat_map(Quad::corners)
            .for_each(|corner| hold(corner, 0.0));
        self.segments
            .iter()
            .flat_map(|s| [s.from, s.to])
            .chain(self.faces.iter().copied().flatten())
            .for_each(|end| hold(end, 0.0));
        if low[0] > high[0] {
            ([0.0; 3], [1.0; 3])
        } else {
            (low, high)
        }
    }

    /// Draws the scene.
    ///
    /// ```
    /// use tsubu_picture::{Camera, Radii, Scene3, View};
    ///
    /// let scene = Scene3 { centres: &[[0.0; 3]], radii: Radii::Same(1.0), values: &[0.5], ..Scene3::default() };
    /// let (low, high) = scene.bounds();
    /// let image = scene.draw(&Camera::front(low, high), &View { width: 101, height: 101, ..View::default() });
    /// assert_eq!(image.pixel(50, 50), Some(tsubu_picture::colour::of_share(0.5)));
    /// ```
    pub fn draw(&self, camera: &Camera, view: &View) -> Image {
        let (width, height) = (view.width.clamp(1, 8192), view.height.clamp(1, 8192));
        let mut image = Image::new(width, height, PAPER);
        let room = labels::room(width, height, view);
        raster::draw(
            self,
            &Projection::new(camera, width, height, room),
            view,
            &mut image,
        );
        labels::draw(&mut image, view);
        image
    }

    fn radius(&self, index: usize) -> f32 {
        match self.radii {
            Radii::Same(radius) => radius,
            Radii::Each(radii) => radii.get(index).copied().unwrap_or(f32::NAN),
        }
    }

    fn colour(&self, index: usize, (low, high): (f32, f32)) -> [u8; 3] {
        match self.values.get(index) {
            // Where all values are equal the range is empty, and its first colour serves.
            Some(value) if value.is_finite() && high <= low => {
                of_share(if *value > high { 1.0 } else { 0.0 })
            }
            Some(value) => of_share((value - low) / (high - low)),
            None => UNKNOWN,
        }
    }
}

impl Quad {
    fn corners(&self) -> [[f32; 3]; 4] {
        let [a, b] = self.edges;
        let plus = |p: [f32; 3], q: [f32; 3]| std::array::from_fn(|i| p[i] + q[i]);
        let first = plus(self.corner, a);
        [self.corner, first, plus(first, b), plus(self.corner, b)]
    }
}

/// From places to pixels: x to the right, y downwards, the third coordinate towards the viewer.
struct Projection {
    axes: [[f32; 3]; 3],
    middle: [f32; 3],
    centre: [f32; 2],
    scale: f32,
}

impl Projection {
    /// `room` is kept free at the left, right, top and bottom, in pixels.
    fn new(camera: &Camera, width: usize, height: usize, room: [f32; 4]) -> Self {
        let axes = camera.axes();
        let middle = std::array::from_fn(|i| 0.5 * camera.low[i] + 0.5 * camera.high[i]);
        let middle = if middle.iter().all(|c: &f32| c.is_finite()) {
            middle
        } else {
            [0.0; 3]
        };
        let half: [f32; 3] =
            std::array::from_fn(|i| (0.5 * camera.high[i] - 0.5 * camera.low[i]).abs());
        let extent = |axis: [f32; 3]| (0..3).map(|i| axis[i].abs() * half[i]).sum::<f32>();
        let [left, right, top, bottom] = room;
        let free =
            [width as f32 - left - right, height as f32 - top - bottom].map(|side| side.max(1.0));
        let scale = (free[0] / (2.0 * extent(axes[0]))).min(free[1] / (2.0 * extent(axes[1])));
        let scale = if scale.is_finite() && scale > 0.0 {
            scale
        } else {
            free[0].min(free[1]) / 2.0
        };
        Self {
            axes,
            middle,
            centre: [left + 0.5 * free[0], top + 0.5 * free[1]],
            scale,
        }
    }

    fn place(&self, point: [f32; 3]) -> [f32; 3] {
        let away: [f32; 3] = std::array::from_fn(|i| point[i] - self.middle[i]);
        let [right, up, towards] = self.axes.map(|axis| dot(axis, away) * self.scale);
        [self.centre[0] + right, self.centre[1] - up, towards]
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(a: [f32; 3]) -> Option<[f32; 3]> {
    let length = dot(a, a).sqrt();
    (length.is_finite() && length > 1e-6).then(|| a.map(|c| c / length))
}

#[cfg(test)]
mod tests;
