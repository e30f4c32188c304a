//! Where the bed is: the datum y = 0 from which all heights of the water are counted.

use std::fmt;

/// Contacts from which on a grain belongs to the bed (choice): a leaping grain has fewer and must not lift the datum.
pub const BED_CONTACTS: u32 = 2;

/// The datum: the mean height of the centres of the bed grains that lie within `diameter` of the highest one.
///
/// `grains` gives height in m and number of contacts of each; `diameter` is the largest grain's in m.
/// `contacts` is how many make a grain part of the bed, usually [`BED_CONTACTS`]; `None` if no grain has them. The sum runs in the order of the grains.
/// Source: `Gotoh2001`, section 2 (4), which does not say what makes a grain part of the bed.
///
/// ```
/// use tsubu_stream::bed_level;
/// // In units of d: a leaping grain at 9, the highest bed grain at 5, one beside it, one too deep to count.
/// let grains = [(9.0, 0), (5.0, 3), (4.5, 4), (3.5, 6)];
/// assert_eq!(bed_level(grains.into_iter(), 1.0, 2), Some(4.75));
/// ```
pub fn bed_level(
    grains: impl Iterator<Item = (f64, u32)> + Clone,
    diameter: f64,
    contacts: u32,
) -> Option<f64> {
    let bed = grains
        .filter(|grain| grain.1 >= contacts)
        .map(|grain| grain.0);
    let top = bed.clone().fold(f64::NEG_INFINITY, f64::max);
    let (sum, count) = bed
        .filter(|height| *height >= top - diameter)
        .fold((0.0, 0u32), |(sum, count), height| {
            (sum + height, count + 1)
        });
    (count > 0).then(|| sum / f64::from(count))
}

/// When the datum is found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Datum {
    /// At the start and at every switch of the turbulence (choice): the water follows the bed.
    #[default]
    Renewed,
    /// At the start only. Transport dies as grains hide below it.
    Frozen,
    /// Given, as a height in m.
    Given(f64),
}

/// What a stream knows of its bed: all of its state, to be saved and restored with a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bed {
    /// Height of the datum in m, once it was found.
    pub level: Option<f64>,
    /// The switch at which it was last looked for.
    pub switch: Option<u64>,
}

/// The water was asked to flow where there is no bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoBed {
    /// Contacts from which on a grain belongs to the bed.
    pub contacts: u32,
}

impl fmt::Display for NoBed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no grain has {} contacts, so the water has no bed: let the grains settle before \
             it flows, or give the height of the bed",
            self.contacts
        )
    }
}

impl std::error::Error for NoBed {}
