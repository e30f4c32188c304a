//! Moving pictures that open everywhere: GIF, looping for ever, written frame by frame.
//!
//! GIF beats APNG here: shaded grains need few colours, and those few make small files.
//! All frames share one palette, computed once from the colour map and its shades.
//! A frame stores only the rectangle that differs from the frame before.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use gif::{DisposalMethod, Encoder, Frame, Repeat};

use crate::PictureError;
use crate::colour::{self, INK, PAPER, Rgb, UNKNOWN, of_share};
use crate::image::Image;
use crate::whole::partial;

/// Colours of the map in the palette.
const COLOURS: usize = 31;
/// Shades of each: below zero towards the dark rim, above towards the highlight and the paper.
const SHADES: [f32; 7] = [-0.75, -0.5, -0.3, -0.14, 0.0, 0.3, 0.65];
/// The entry that lets the frame before show through.
const UNCHANGED: u8 = 255;

/// A GIF in the making, under a temporary name until it is whole.
pub struct Animation {
    path: PathBuf,
    /// None once the file is finished.
    encoder: Option<Encoder<BufWriter<File>>>,
    size: (usize, usize),
    delay: u16,
    palette: Palette,
    before: Vec<u8>,
    frames: usize,
}

impl Animation {
    /// Begins an animation of images of this size, each shown for `delay`, in hundredths of a second and at least two of them.
    pub fn create(
        path: &Path,
        width: usize,
        height: usize,
        delay: Duration,
    ) -> Result<Self, PictureError> {
        let sides = (u16::try_from(width), u16::try_from(height));
        let (Ok(wide @ 1..), Ok(high @ 1..)) = sides else {
            return Err(PictureError::format(
                path,
                format!(
                    "an animation cannot be {width} × {height} pixels; sides go from 1 to 65535"
                ),
            ));
        };
        let palette = Palette::new();
        let file = File::create(partial(path)).map_err(PictureError::file(path))?;
        let encoder = Encoder::new(BufWriter::new(file), wide, high, &palette.bytes())
            .and_then(|mut encoder| encoder.set_repeat(Repeat::Infinite).map(|()| encoder))
            .map_err(|reason| PictureError::format(path, reason))?;
        let delay = u16::try_from((delay.as_millis() + 5) / 10)
            .unwrap_or(u16::MAX)
            .max(2);
        Ok(Self {
            path: path.to_path_buf(),
            encoder: Some(encoder),
            size: (width, height),
            delay,
            palette,
            before: Vec::new(),
            frames: 0,
        })
    }

    /// Adds a frame; its size must be that of the animation.
    pub fn push(&mut self, image: &Image) -> Result<(), PictureError> {
        image.check(&self.path)?;
        if (image.width, image.height) != self.size {
            return Err(PictureError::format(
                &self.path,
                format!(
                    "a frame of {} × {} pixels in an animation of {} × {}",
                    image.width, image.height, self.size.0, self.size.1
                ),
            ));
        }
        let now: Vec<u8> = image
            .pixels
            .chunks_exact(3)
            .map(|p| self.palette.nearest([p[0], p[1], p[2]]))
            .collect();
        let mut frame = changed(&self.before, &now, self.size);
        frame.delay = self.delay;
        frame.dispose = DisposalMethod::Keep;
        if let Some(encoder) = &mut self.encoder {
            encoder
                .write_frame(&frame)
                .map_err(|reason| PictureError::format(&self.path, reason))?;
        }
        self.before = now;
        self.frames += 1;
        Ok(())
    }

    /// How many frames there are so far.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Closes the file and gives it its name; an animation without frames is an error and leaves nothing.
    pub fn finish(mut self) -> Result<PathBuf, PictureError> {
        if self.frames == 0 {
            return Err(PictureError::format(
                &self.path,
                "an animation needs at least one frame",
            ));
        }
        if let Some(encoder) = self.encoder.take() {
            let whole = encoder
                .into_inner()
                .map_err(|reason| PictureError::format(&self.path, reason))
                .and_then(|mut file| file.flush().map_err(PictureError::file(&self.path)))
                .and_then(|()| {
                    std::fs::rename(partial(&self.path), &self.path)
                        .map_err(PictureError::file(&self.path))
                });
            if whole.is_err() {
                let _ = std::fs::remove_file(partial(&self.path));
            }
            whole?;
        }
        Ok(self.path.clone())
    }
}

impl Drop for Animation {
    /// An animation given up leaves no file behind.
    fn drop(&mut self) {
        if self.encoder.take().is_some() {
            let _ = std::fs::remove_file(partial(&self.path));
        }
    }
}

/// The frame that turns `before` into `now`: the rectangle that differs, see-through where nothing changed.
fn changed(before: &[u8], now: &[u8], (width, height): (usize, usize)) -> Frame<'static> {
    let differs = |x: usize, y: usize| before.get(y * width + x) != Some(&now[y * width + x]);
    let row = |y: usize| (0..width).any(|x| differs(x, y));
    // Without any change one pixel carries the delay.
    let top = (0..height).find(|&y| row(y)).unwrap_or(0);
    let bottom = (top..height).rev().find(|&y| row(y)).unwrap_or(top) + 1;
    let column = |x: usize| (top..bottom).any(|y| differs(x, y));
    let left = (0..width).find(|&x| column(x)).unwrap_or(0);
    let right = (left..width).rev().find(|&x| column(x)).unwrap_or(left) + 1;
    let pixels = (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y)));
    let buffer: Vec<u8> = pixels
        .map(|(x, y)| {
            if differs(x, y) {
                now[y * width + x]
            } else {
                UNCHANGED
            }
        })
        .collect();
    Frame {
        left: left as u16,
        top: top as u16,
        width: (right - left) as u16,
        height: (bottom - top) as u16,
        transparent: Some(UNCHANGED),
        buffer: buffer.into(),
        ..Frame::default()
    }
}

/// At most 255 colours and, for every colour, the nearest of them, found once.
struct Palette {
    colours: Vec<Rgb>,
    /// By the upper six bits of red, green and blue; `u16::MAX` where not yet asked.
    nearest: Vec<u16>,
}

impl Palette {
    fn new() -> Self {
        let mut colours = vec![PAPER, INK, UNKNOWN];
        for i in 0..COLOURS {
            let pure = of_share(i as f32 / (COLOURS - 1) as f32);
            colours.extend(SHADES.map(|shade| match shade {
                dark if dark < 0.0 => colour::mix(pure, [15, 15, 25], -dark),
                light => colour::mix(pure, PAPER, light),
            }));
        }
        let greys = 255 - colours.len();
        colours.extend(
            (0..greys).map(|i| colour::mix(INK, PAPER, (i + 1) as f32 / (greys + 1) as f32)),
        );
        Self {
            colours,
            nearest: vec![u16::MAX; 1 << 18],
        }
    }

    /// Red, green and blue in turn, filled up to 256 colours.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colours.concat();
        bytes.resize(3 * 256, 0);
        bytes
    }

    fn nearest(&mut self, [r, g, b]: Rgb) -> u8 {
        let cell = (usize::from(r >> 2) << 12) | (usize::from(g >> 2) << 6) | usize::from(b >> 2);
        if self.nearest[cell] == u16::MAX {
            // The middle of the cell, so that the answer does not depend on who asked first.
            let middle = [r, g, b].map(|c| i32::from(c & 0xfc) + 2);
            let distance = |c: &Rgb| {
                let d: [i32; 3] = std::array::from_fn(|i| i32::from(c[i]) - middle[i]);
                3 * d[0] * d[0] + 6 * d[1] * d[1] + d[2] * d[2]
            };
            let best = self
                .colours
                .iter()
                .enumerate()
                .min_by_key(|(_, c)| distance(c));
            self.nearest[cell] = best.map_or(0, |(index, _)| index as u16);
        }
        self.nearest[cell] as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(name: &str) -> PathBuf {
        std::env::temp_dir().join(format!("tsubu-{name}-{}.gif", std::process::id()))
    }

    fn frame(spot: usize) -> Image {
        let mut image = Image::new(30, 20, PAPER);
        image.fill(spot as i64, 5, 4, 4, of_share(0.5));
        image
    }

    /// Every frame as a viewer shows it.
    fn decode(path: &Path) -> (Vec<Vec<u8>>, Repeat) {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(File::open(path).unwrap()).unwrap();
        let (mut screen, mut frames) = (vec![0; 30 * 20 * 3], Vec::new());
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            for (i, p) in frame
                .buffer
                .chunks_exact(4)
                .enumerate()
                .filter(|(_, p)| p[3] > 0)
            {
                let x = usize::from(frame.left) + i % usize::from(frame.width);
                let y = usize::from(frame.top) + i / usize::from(frame.width);
                screen[3 * (30 * y + x)..][..3].copy_from_slice(&p[..3]);
            }
            frames.push(screen.clone());
        }
        (frames, decoder.repeat())
    }

    #[test]
    fn every_frame_comes_back_and_the_animation_loops() {
        let path = place("frames");
        let mut animation = Animation::create(&path, 30, 20, Duration::from_millis(40)).unwrap();
        // The fourth frame equals the third: a rest must not be lost.
        for spot in [0, 3, 20, 20, 7] {
            animation.push(&frame(spot)).unwrap();
        }
        assert!(!path.exists(), "half an animation must not carry the name");
        assert_eq!(animation.finish().unwrap(), path);
        let (frames, repeat) = decode(&path);
        std::fs::remove_file(&path).unwrap();
        assert_eq!((frames.len(), repeat), (5, Repeat::Infinite));
        for (shown, spot) in frames.iter().zip([0, 3, 20, 20, 7]) {
            let off = shown
                .iter()
                .zip(&frame(spot).pixels)
                .map(|(a, b)| a.abs_diff(*b))
                .max();
            assert!(
                off <= Some(10),
                "frame with the spot at {spot} is off by {off:?}"
            );
        }
    }

    #[test]
    fn an_animation_given_up_or_empty_leaves_nothing() {
        let path = place("given-up");
        let mut animation = Animation::create(&path, 30, 20, Duration::ZERO).unwrap();
        animation.push(&frame(1)).unwrap();
        drop(animation);
        assert!(!partial(&path).exists());
        assert!(
            Animation::create(&path, 30, 20, Duration::ZERO)
                .unwrap()
                .finish()
                .is_err()
        );
        assert!(!partial(&path).exists() && !path.exists());
    }

    #[test]
    fn wrong_sizes_are_refused_with_the_path() {
        let path = place("sizes");
        assert!(Animation::create(&path, 0, 20, Duration::ZERO).is_err());
        assert!(Animation::create(&path, 70_000, 20, Duration::ZERO).is_err());
        let mut animation = Animation::create(&path, 31, 20, Duration::ZERO).unwrap();
        let error = animation.push(&frame(1)).unwrap_err();
        assert!(error.to_string().contains("30 × 20") && error.path() == path);
    }

    #[test]
    fn colours_of_the_map_and_the_paper_survive_the_palette() {
        let mut palette = Palette::new();
        assert!(palette.colours.len() <= 255);
        for colour in (0..=100)
            .map(|i| of_share(i as f32 / 100.0))
            .chain([PAPER, INK, UNKNOWN])
        {
            let nearest = palette.nearest(colour);
            let found = palette.colours[usize::from(nearest)];
            let off = (0..3).map(|i| found[i].abs_diff(colour[i])).max();
            assert!(off <= Some(12), "{colour:?} became {found:?}");
        }
        let paper = palette.nearest(PAPER);
        assert_eq!(palette.colours[usize::from(paper)], PAPER);
    }
}
