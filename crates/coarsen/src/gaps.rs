//! Gaps of a scene against the coarse grain: a grain wider than a gap changes what is modelled.

use crate::Level;
use std::fmt;

/// A named gap of the scene: a clearance, an opening, a slot.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// What the scene calls it.
    pub name: String,
    /// Width in m.
    pub width: f64,
}

impl Gap {
    /// A gap of this name and width in m.
    pub fn new(name: impl Into<String>, width: f64) -> Self {
        Self {
            name: name.into(),
            width,
        }
    }
}

/// Refuses a level at which the narrowest gap is under one coarse diameter d' = λ d.
/// `diameter` is that of the real grain (n = 0) in m.
///
/// One d' is the point where a grain no longer passes at all; results begin to depend on λ far
/// earlier, below 6 to 10 d' (crate page).
///
/// ```
/// use tsubu_coarsen::{Gap, Level, check_gaps};
/// // Paper A's screw: clearance 12.3 mm, coke of 1.350 mm: 1.14 d' at n = 3, 0.57 d' at n = 4.
/// let gaps = [Gap::new("clearance", 12.3e-3), Gap::new("outlet", 324e-3)];
/// assert!(check_gaps(&gaps, 1.350e-3, Level::new(3)).is_ok());
/// let narrow = check_gaps(&gaps, 1.350e-3, Level::new(4)).unwrap_err();
/// assert_eq!(narrow.to_string(), "the gap `clearance` is 12.30 mm, narrower than one grain of \
///     d' = 21.60 mm at n = 4; the largest level that fits every gap is n = 3");
/// ```
pub fn check_gaps(gaps: &[Gap], diameter: f64, level: Level) -> Result<(), NarrowGap> {
    // A width that is no number counts as the narrowest: it is never wide enough.
    let known = |gap: &Gap| {
        if gap.width.is_nan() {
            f64::NEG_INFINITY
        } else {
            gap.width
        }
    };
    let Some(narrowest) = gaps.iter().min_by(|a, b| known(a).total_cmp(&known(b))) else {
        return Ok(());
    };
    let fits = |level: &Level| narrowest.width >= level.lambda() * diameter;
    if fits(&level) {
        return Ok(());
    }
    let largest = (0..level.n()).rev().map(Level::new).find(fits);
    Err(NarrowGap {
        gap: narrowest.clone(),
        coarse_diameter: level.lambda() * diameter,
        level,
        largest,
    })
}

/// A gap is narrower than one coarse grain.
#[derive(Clone, Debug, PartialEq)]
pub struct NarrowGap {
    /// The narrowest gap.
    pub gap: Gap,
    /// d' in m at the level asked for.
    pub coarse_diameter: f64,
    /// The level asked for.
    pub level: Level,
    /// The largest level that fits every gap; `None` if not even the real grain does.
    pub largest: Option<Level>,
}

impl fmt::Display for NarrowGap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            gap,
            coarse_diameter,
            level,
            largest,
        } = self;
        let (width, diameter) = (millimetres(gap.width), millimetres(*coarse_diameter));
        write!(
            f,
            "the gap `{}` is {width}, narrower than one grain of d' = {diameter} at {level}; ",
            gap.name
        )?;
        match largest {
            Some(largest) => write!(f, "the largest level that fits every gap is {largest}"),
            None => write!(f, "not even the real grain (n = 0) fits"),
        }
    }
}

impl std::error::Error for NarrowGap {}

/// A length in mm with four significant digits.
fn millimetres(metres: f64) -> String {
    let value = metres * 1e3;
    let decimals = (3.0 - value.abs().log10().floor()).clamp(0.0, 9.0);
    // A zero or no number has no leading digit; the cast then gives 9 or 0 decimals, both fine.
    format!("{value:.*} mm", decimals as usize)
}
