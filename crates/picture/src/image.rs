//! A picture in memory: rows of red, green and blue, from the upper left corner.

use std::path::Path;

use crate::PictureError;
use crate::colour::{self, Rgb};
use crate::text;

/// A picture in memory, three bytes to a pixel, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue of every pixel: `3 * width * height` bytes.
    pub pixels: Vec<u8>,
}

impl Image {
    /// A picture of one colour.
    pub(crate) fn new(width: usize, height: usize, colour: Rgb) -> Self {
        Self {
            width,
            height,
            pixels: colour.repeat(width * height),
        }
    }

    /// The colour of a pixel, or none outside of the picture.
    pub fn pixel(&self, x: usize, y: usize) -> Option<Rgb> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let at = 3 * (y * self.width + x);
        let bytes = self.pixels.get(at..at + 3)?;
        Some([bytes[0], bytes[1], bytes[2]])
    }

    /// Writes the picture as PNG.
    pub fn save_png(&self, path: &Path) -> Result<(), PictureError> {
        self.check(path)?;
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(&self.pixels))
            .map_err(|reason| PictureError::format(path, reason))?;
        crate::whole::write(path, bytes)
    }

    /// Whether the fields, which anybody may set, belong together and fit the formats.
    pub(crate) fn check(&self, path: &Path) -> Result<(), PictureError> {
        let fits = (1..=65_535).contains(&self.width) && (1..=65_535).contains(&self.height);
        if fits && self.pixels.len() == 3 * self.width * self.height {
            return Ok(());
        }
        Err(PictureError::format(
            path,
            format!(
                "an image of {} × {} pixels cannot have {} bytes; sides go from 1 to 65535 with three bytes to a pixel",
                self.width,
                self.height,
                self.pixels.len()
            ),
        ))
    }

    /// Lays a colour over a pixel; outside of the picture nothing happens.
    pub(crate) fn blend(&mut self, x: i64, y: i64, over: Rgb, share: f32) {
        let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else {
            return;
        };
        if let Some(below) = self.pixel(x, y) {
            let at = 3 * (y * self.width + x);
            self.pixels[at..at + 3].copy_from_slice(&colour::mix(below, over, share));
        }
    }

    pub(crate) fn fill(&mut self, x: i64, y: i64, width: i64, height: i64, over: Rgb) {
        for row in y..y + height {
            for column in x..x + width {
                self.blend(column, row, over, 1.0);
            }
        }
    }

    /// Writes a line of text with its upper left corner at (x, y) and returns its width.
    pub(crate) fn write(&mut self, x: i64, y: i64, line: &str, size: u32) -> i64 {
        let Some(ink) = text::coverage(line, size) else {
            return 0;
        };
        for (row, inks) in ink.ink.chunks_exact(ink.width).enumerate().take(ink.height) {
            for (column, &share) in inks.iter().enumerate() {
                if share > 0 {
                    self.blend(
                        x + column as i64,
                        y + row as i64,
                        colour::INK,
                        f32::from(share) / 255.0,
                    );
                }
            }
        }
        ink.width as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_whose_bytes_do_not_match_its_sides_is_refused_by_name() {
        let broken = Image {
            width: 3,
            height: 2,
            pixels: vec![0; 5],
        };
        let error = broken.save_png(Path::new("broken.png")).unwrap_err();
        assert_eq!(error.path(), Path::new("broken.png"));
        assert!(error.to_string().contains("3 × 2"), "{error}");
    }

    #[test]
    fn a_picture_comes_back_from_its_file() {
        let path = std::env::temp_dir().join(format!("tsubu-picture-{}.png", std::process::id()));
        let mut image = Image::new(40, 30, colour::PAPER);
        image.write(2, 2, "µm", 14);
        image.save_png(&path).unwrap();
        let mut reader =
            png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&path).unwrap()))
                .read_info()
                .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(pixels, image.pixels);
        assert!(
            pixels.chunks_exact(3).any(|p| p[0] < 80),
            "the text left no ink"
        );
    }
}
