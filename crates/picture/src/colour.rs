//! Colours that colour-blind readers can tell apart: viridis for values, Okabe and Ito's for series.

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// The background of every picture of grains: a light warm grey, so that white highlights remain visible.
pub const PAPER: Rgb = [247, 247, 244];
/// Text and outlines.
pub const INK: Rgb = [34, 34, 34];
/// A grain whose value is not a number.
pub const UNKNOWN: Rgb = [150, 150, 150];

/// Okabe and Ito's colours in the order in which series take them; black is kept for theory, and yellow is too faint on white.
pub const SERIES: [Rgb; 6] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
];

/// Eleven equidistant colours of viridis (van der Walt and Smith 2015).
const VIRIDIS: [Rgb; 11] = [
    [68, 1, 84],
    [72, 37, 118],
    [65, 68, 135],
    [53, 96, 141],
    [42, 120, 142],
    [33, 144, 140],
    [34, 168, 132],
    [67, 191, 113],
    [122, 209, 81],
    [187, 223, 39],
    [253, 231, 37],
];

/// The colour of a share from 0 to 1: viridis, a little lightened so that shading and outlines remain visible at its dark end.
///
/// Beyond 0 and 1 it is cut, and what is not a number is grey.
///
/// ```
/// assert_eq!(tsubu_picture::colour::of_share(0.5), [66, 161, 157]);
/// ```
pub fn of_share(share: f32) -> Rgb {
    if share.is_nan() {
        return UNKNOWN;
    }
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f32;
    let below = (place as usize).min(VIRIDIS.len() - 2);
    let viridis = mix(VIRIDIS[below], VIRIDIS[below + 1], place - below as f32);
    mix(viridis, [255; 3], 0.15)
}

/// A colour between two, `share` of the way from the first.
pub fn mix(from: Rgb, to: Rgb, share: f32) -> Rgb {
    // Rounded by hand: `round` is a call on the plainest processors, and this runs for every sample of a picture.
    std::array::from_fn(|i| {
        let from = f32::from(from[i]);
        (from + (f32::from(to[i]) - from) * share + 0.5) as u8
    })
}

/// A colour as `#rrggbb`.
pub(crate) fn hex(colour: Rgb) -> String {
    format!("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brightness_rises_along_the_map_so_it_reads_in_grey() {
        let grey =
            |c: Rgb| 0.2126 * f32::from(c[0]) + 0.7152 * f32::from(c[1]) + 0.0722 * f32::from(c[2]);
        let brightness: Vec<f32> = (0..=40).map(|i| grey(of_share(i as f32 / 40.0))).collect();
        assert!(brightness.windows(2).all(|pair| pair[1] > pair[0]));
        assert_eq!(of_share(f32::NAN), UNKNOWN);
        assert_eq!(of_share(f32::INFINITY), of_share(1.0));
    }
}
