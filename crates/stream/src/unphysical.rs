//! The error of this crate: a number that water or grains cannot have.

use std::fmt;

/// A number that the formulas of this crate refuse, with what it should be.
///
/// ```
/// use tsubu_stream::{Sediment, Water};
/// let refused = Water::fresh().shields(&Sediment::quartz(0.5e-3), -0.05).unwrap_err();
/// assert_eq!(refused.to_string(), "the friction velocity is -0.05: give zero or a positive number in m/s");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Unphysical {
    /// What the number is.
    pub what: String,
    /// The number.
    pub value: f64,
    /// What to give instead.
    pub remedy: String,
}

impl fmt::Display for Unphysical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the {} is {}: give {}",
            self.what, self.value, self.remedy
        )
    }
}

impl std::error::Error for Unphysical {}

/// The error for `value`, unless `holds`.
pub(crate) fn demand(holds: bool, what: &str, value: f64, remedy: &str) -> Result<(), Unphysical> {
    if holds {
        return Ok(());
    }
    Err(Unphysical {
        what: what.into(),
        value,
        remedy: remedy.into(),
    })
}

/// A finite number above zero.
pub(crate) fn demand_positive(what: &str, value: f64, unit: &str) -> Result<(), Unphysical> {
    let holds = value > 0.0 && value.is_finite();
    let remedy = format!("a positive number{}", in_unit(unit));
    demand(holds, what, value, &remedy)
}

/// A finite number, zero or above.
pub(crate) fn demand_not_negative(what: &str, value: f64, unit: &str) -> Result<(), Unphysical> {
    let holds = value >= 0.0 && value.is_finite();
    let remedy = format!("zero or a positive number{}", in_unit(unit));
    demand(holds, what, value, &remedy)
}

/// A place: a finite length.
pub(crate) fn demand_place(what: &str, value: f64) -> Result<(), Unphysical> {
    demand(value.is_finite(), what, value, "a length in m")
}

/// ` in m/s`, or nothing for a pure number.
fn in_unit(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" in {unit}")
    }
}
