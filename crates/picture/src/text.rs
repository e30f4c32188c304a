//! Text for both kinds of picture: cleaned, measured, wrapped, and turned into coverage of pixels.

use kuva::backend::raster::RasterBackend;
use kuva::render::color::Color;
use kuva::render::render::{Primitive, Scene, TextAnchor};

/// How much ink each pixel of a line of text holds, 0 to 255.
pub(crate) struct Coverage {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) ink: Vec<u8>,
}

/// The text without characters that XML forbids.
pub(crate) fn clean(text: &str) -> String {
    let forbidden = |c: char| c.is_control() || c == '\u{fffe}' || c == '\u{ffff}';
    text.chars()
        .map(|c| if forbidden(c) { ' ' } else { c })
        .collect()
}

/// A drawing primitive for one line of text; every `$` stays a plain character.
pub(crate) fn primitive(
    x: f64,
    y: f64,
    text: &str,
    size: u32,
    anchor: TextAnchor,
    colour: &str,
) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: clean(text).replace('$', "\\$"),
        size,
        anchor,
        rotate: None,
        bold: false,
        color: Some(Color::from(colour)),
    }
}

/// The width of a line in pixels, about: the viewer of an SVG may use another font, so this errs to the wide side.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let advance = |c: char| match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '|' | '\'' | '!' | ' ' => 0.36,
        'f' | 'r' | 't' | '(' | ')' | '/' | '-' | '[' | ']' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 0.98,
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' => 0.45,
        'A'..='Z' => 0.75,
        '\u{2e80}'.. => 1.05,
        _ => 0.64,
    };
    size * text.chars().map(advance).sum::<f64>()
}

/// The text in lines no wider than `limit` pixels, broken at spaces, and a word longer than a line broken anywhere.
pub(crate) fn wrap(text: &str, size: f64, limit: f64) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in clean(text).split_whitespace() {
        let joined = if line.is_empty() {
            word.to_string()
        } else {
            format!("{line} {word}")
        };
        if width(&joined, size) <= limit {
            line = joined;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for c in word.chars() {
            line.push(c);
            if width(&line, size) > limit {
                lines.push(std::mem::take(&mut line));
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// One line of text as coverage, or none where there is nothing to draw.
pub(crate) fn coverage(text: &str, size: u32) -> Option<Coverage> {
    let text: String = text.chars().take(200).collect();
    if text.trim().is_empty() {
        return None;
    }
    let mut scene = Scene::new(
        (width(&text, size.into()) * 1.2).ceil() + 4.0,
        (f64::from(size) * 1.4).ceil(),
    );
    scene.add(primitive(
        0.0,
        f64::from(size) * 1.05,
        &text,
        size,
        TextAnchor::Start,
        "#000000",
    ));
    let bytes = RasterBackend { scale: 1.0 }.render_scene(&scene).ok()?;
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut pixels).ok()?;
    let (wide, height) = (info.width as usize, info.height as usize);
    let ink: Vec<u8> = pixels
        .chunks_exact(4)
        .take(wide * height)
        .map(|p| 255 - p[0])
        .collect();
    // The scene is a little too wide by design; the blank columns at its end are cut off.
    let used = (0..wide)
        .rev()
        .find(|&x| (0..height).any(|y| ink[y * wide + x] > 0))?
        + 1;
    let ink = ink
        .chunks_exact(wide)
        .flat_map(|row| row[..used].iter().copied())
        .collect();
    Some(Coverage {
        width: used,
        height,
        ink,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_drawn_as_wide_as_it_is_measured_within_a_quarter() {
        for text in ["speed (m/s)", "µ = 0.5, θ = 27.3°", "iiiiiiii", "WWWW"] {
            let drawn = coverage(text, 16).map_or(0.0, |c| c.width as f64);
            let measured = width(text, 16.0);
            assert!(
                drawn <= measured * 1.05 && drawn > measured * 0.7,
                "{text}: {drawn} {measured}"
            );
        }
    }

    #[test]
    fn wrapped_lines_hold_every_letter_and_keep_the_limit() {
        let text = "cargo xtask validate repose --all averyveryverylongwordwithoutanyspace";
        let lines = wrap(text, 14.0, 150.0);
        assert!(lines.iter().all(|line| width(line, 14.0) <= 150.0 + 14.0));
        assert_eq!(lines.concat().replace(' ', ""), text.replace(' ', ""));
    }
}
