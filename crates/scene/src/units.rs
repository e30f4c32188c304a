//! Quantities with units: one table, one reader, one writer.
//!
//! A decimal factor of a unit is applied to the digits before they become a number, so "1.35 mm" is exactly 0.00135.
//!
//! ```
//! use tsubu_scene::units::{Dimension, read};
//! assert_eq!(read(Dimension::Length, "1.35mm")?, 0.00135);
//! assert_eq!(read(Dimension::Acceleration, "9.81 m/s²")?, 9.81);
//! let wrong = read(Dimension::Energy, "5 mm").unwrap_err();
//! assert!(wrong.to_string().contains("“mm” is a length"));
//! # Ok::<(), tsubu_scene::units::UnitError>(())
//! ```

use std::f64::consts::PI;
use std::fmt;

/// What a quantity measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// In m.
    Length,
    /// In s.
    Time,
    /// In kg.
    Mass,
    /// In kg/m³.
    Density,
    /// In Pa.
    Pressure,
    /// In m/s.
    Velocity,
    /// In m/s².
    Acceleration,
    /// In J.
    Energy,
    /// In N/m.
    Stiffness,
    /// In kg/s, a force per velocity.
    Damping,
    /// In rad.
    Angle,
    /// In rad/s.
    AngularVelocity,
    /// In Hz.
    Frequency,
}

/// A unit is worth `factor` × 10^`power` of the SI unit.
struct Unit {
    dimension: Dimension,
    symbol: &'static str,
    factor: f64,
    power: i32,
}

const fn unit(dimension: Dimension, symbol: &'static str, factor: f64, power: i32) -> Unit {
    Unit {
        dimension,
        symbol,
        factor,
        power,
    }
}

use Dimension::*;

/// The first unit of each dimension is the SI unit. Symbols are as [`plain`] leaves them.
const UNITS: &[Unit] = &[
    unit(Length, "m", 1.0, 0),
    unit(Length, "km", 1.0, 3),
    unit(Length, "cm", 1.0, -2),
    unit(Length, "mm", 1.0, -3),
    unit(Length, "um", 1.0, -6),
    unit(Length, "nm", 1.0, -9),
    unit(Time, "s", 1.0, 0),
    unit(Time, "ms", 1.0, -3),
    unit(Time, "us", 1.0, -6),
    unit(Time, "ns", 1.0, -9),
    unit(Time, "min", 60.0, 0),
    unit(Time, "h", 3600.0, 0),
    unit(Mass, "kg", 1.0, 0),
    unit(Mass, "t", 1.0, 3),
    unit(Mass, "g", 1.0, -3),
    unit(Mass, "mg", 1.0, -6),
    unit(Mass, "ug", 1.0, -9),
    unit(Density, "kg/m3", 1.0, 0),
    unit(Density, "g/cm3", 1.0, 3),
    unit(Density, "t/m3", 1.0, 3),
    unit(Pressure, "Pa", 1.0, 0),
    unit(Pressure, "kPa", 1.0, 3),
    unit(Pressure, "MPa", 1.0, 6),
    unit(Pressure, "GPa", 1.0, 9),
    unit(Pressure, "N/m2", 1.0, 0),
    unit(Velocity, "m/s", 1.0, 0),
    unit(Velocity, "cm/s", 1.0, -2),
    unit(Velocity, "mm/s", 1.0, -3),
    unit(Acceleration, "m/s2", 1.0, 0),
    unit(Acceleration, "cm/s2", 1.0, -2),
    unit(Acceleration, "mm/s2", 1.0, -3),
    unit(Energy, "J", 1.0, 0),
    unit(Energy, "kJ", 1.0, 3),
    unit(Energy, "mJ", 1.0, -3),
    unit(Energy, "uJ", 1.0, -6),
    unit(Energy, "nJ", 1.0, -9),
    unit(Energy, "N m", 1.0, 0),
    unit(Stiffness, "N/m", 1.0, 0),
    unit(Stiffness, "kN/m", 1.0, 3),
    unit(Stiffness, "mN/m", 1.0, -3),
    unit(Stiffness, "N/mm", 1.0, 3),
    unit(Damping, "kg/s", 1.0, 0),
    unit(Damping, "g/s", 1.0, -3),
    unit(Damping, "N s/m", 1.0, 0),
    unit(Damping, "Ns/m", 1.0, 0),
    unit(Angle, "rad", 1.0, 0),
    unit(Angle, "deg", PI / 180.0, 0),
    unit(Angle, "°", PI / 180.0, 0),
    unit(AngularVelocity, "rad/s", 1.0, 0),
    unit(AngularVelocity, "deg/s", PI / 180.0, 0),
    unit(AngularVelocity, "rpm", PI / 30.0, 0),
    unit(AngularVelocity, "r/min", PI / 30.0, 0),
    unit(AngularVelocity, "rev/s", 2.0 * PI, 0),
    unit(Frequency, "Hz", 1.0, 0),
    unit(Frequency, "kHz", 1.0, 3),
    unit(Frequency, "1/s", 1.0, 0),
];

impl Dimension {
    /// The dimension in words, with its article: "a length".
    pub fn name(self) -> &'static str {
        self.words().0
    }

    /// A quantity of this dimension as it is written in a scene, without quotes.
    pub fn example(self) -> &'static str {
        self.words().1
    }

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Length => ("a length", "1.35 mm"),
            Time => ("a time", "20 ms"),
            Mass => ("a mass", "1.76e-6 kg"),
            Density => ("a density", "1370 kg/m3"),
            Pressure => ("a pressure", "3.096 GPa"),
            Velocity => ("a velocity", "0.5 m/s"),
            Acceleration => ("an acceleration", "9.80665 m/s2"),
            Energy => ("an energy", "0.0943 J"),
            Stiffness => ("a stiffness", "1000 N/m"),
            Damping => ("a damping coefficient", "0.1257 kg/s"),
            Angle => ("an angle", "30 deg"),
            AngularVelocity => ("an angular velocity", "100 rpm"),
            Frequency => ("a frequency", "50 Hz"),
        }
    }

    /// The units of this dimension, the SI unit first.
    pub fn symbols(self) -> impl Iterator<Item = &'static str> {
        UNITS
            .iter()
            .filter(move |unit| unit.dimension == self)
            .map(|unit| unit.symbol)
    }
}

/// Why a text is not the quantity that is expected: what is wrong, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// What is wrong.
    pub what: String,
    /// What to write instead.
    pub remedy: String,
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.what, self.remedy)
    }
}

impl std::error::Error for UnitError {}

/// Reads a quantity into its SI value, always finite.
///
/// # Errors
/// When there is no number, no unit, an unknown unit or one of another dimension, or a number beyond f64.
pub fn read(dimension: Dimension, text: &str) -> Result<f64, UnitError> {
    let expected = format!(
        "write {} such as \"{}\"",
        dimension.name(),
        dimension.example()
    );
    let error = |what: String| UnitError {
        what,
        remedy: expected.clone(),
    };
    let text = text.trim();
    if text.is_empty() {
        return Err(error(format!("{} is missing", dimension.name())));
    }
    let (number, rest) = text.split_at(number_length(text));
    if number.is_empty() {
        return Err(error(format!("“{text}” does not begin with a number")));
    }
    let symbol = plain(rest);
    if symbol.is_empty() {
        return Err(error(format!("“{text}” has no unit")));
    }
    if symbol.starts_with(',') {
        return Err(error(format!(
            "“{text}” has a decimal comma: the decimal sign is a point"
        )));
    }
    let Some(unit) = UNITS.iter().find(|unit| unit.symbol == symbol) else {
        let known: Vec<_> = dimension.symbols().collect();
        let near = crate::error::nearest(&symbol, known.iter().copied());
        let hint = near.map_or(String::new(), |near| format!("did you mean “{near}”? "));
        return Err(UnitError {
            what: format!("unknown unit “{}”", rest.trim()),
            remedy: format!("{hint}units of {}: {}", dimension.name(), known.join(", ")),
        });
    };
    if unit.dimension != dimension {
        return Err(UnitError {
            what: format!(
                "“{}” is {}, but {} is expected here",
                rest.trim(),
                unit.dimension.name(),
                dimension.name()
            ),
            remedy: expected,
        });
    }
    let value = scaled(number, unit.power)
        .map(|value| value * unit.factor)
        .unwrap_or(f64::NAN);
    if value.is_finite() {
        Ok(value)
    } else {
        Err(error(format!("“{text}” is too large a number")))
    }
}

/// Writes an SI value so that [`read`] gives the same number back.
pub fn write(dimension: Dimension, value: f64) -> String {
    let si = dimension.symbols().next().unwrap_or_default();
    format!("{value:?} {si}")
}

/// The number of bytes of the decimal number that the text begins with.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count()
    };
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let start = sign(0);
    let mut end = start + digits(start);
    let mut count = end - start;
    if bytes.get(end) == Some(&b'.') {
        let decimals = digits(end + 1);
        count += decimals;
        end += 1 + decimals;
    }
    if count == 0 {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let from = end + 1 + sign(end + 1);
        let exponent = digits(from);
        if exponent > 0 {
            end = from + exponent;
        }
    }
    end
}

/// The number times 10^power, rounded once.
fn scaled(number: &str, power: i32) -> Option<f64> {
    let (mantissa, exponent) = match number.split_once(['e', 'E']) {
        // An exponent beyond i32 overflows or vanishes whatever the unit.
        Some((mantissa, exponent)) => match exponent.parse::<i32>() {
            Ok(exponent) => (mantissa, exponent),
            Err(_) => return number.parse().ok(),
        },
        None => (number, 0),
    };
    format!("{mantissa}e{}", exponent.saturating_add(power))
        .parse()
        .ok()
}

/// The symbol with powers as plain digits, micro as u, and one space for a product.
fn plain(symbol: &str) -> String {
    let mut out = String::with_capacity(symbol.len());
    for sign in symbol.trim().chars() {
        match sign {
            '^' => {}
            '²' => out.push('2'),
            '³' => out.push('3'),
            'µ' | 'μ' => out.push('u'),
            '·' | '⋅' | '*' => out.push(' '),
            other => out.push(other),
        }
    }
    let words: Vec<_> = out.split_whitespace().collect();
    words.join(" ").replace(" / ", "/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn many_spellings() {
        for (dimension, text, value) in [
            (Length, "1.350 mm", 0.00135),
            (Length, " 58.32mm ", 0.05832),
            (Length, "2e3 µm", 0.002),
            (Length, "2 μm", 2e-6),
            (Length, "-.5 cm", -0.005),
            (Length, "5. m", 5.0),
            (Acceleration, "9.81 m/s^2", 9.81),
            (Acceleration, "9.81 m/s²", 9.81),
            (Density, "2.65 g/cm³", 2650.0),
            (Damping, "1 N·s/m", 1.0),
            (Damping, "1 Ns/m", 1.0),
            (Stiffness, "0.2 N/m", 0.2),
            (Stiffness, "5 mN / m", 0.005),
            (Stiffness, "2 N/mm", 2000.0),
            (Pressure, "3.096 GPa", 3.096e9),
            (Time, "1.5 min", 90.0),
            (AngularVelocity, "60 rpm", 2.0 * PI),
            (AngularVelocity, "6.5 rad/s", 6.5),
            (AngularVelocity, "1 rev/s", 2.0 * PI),
            (Frequency, "50 Hz", 50.0),
            (Frequency, "0.05 kHz", 50.0),
            (Frequency, "50 1/s", 50.0),
        ] {
            assert_eq!(read(dimension, text), Ok(value), "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (dimension, text, message) in [
            (Length, "", "a length is missing"),
            (Length, "NaN m", "does not begin with a number"),
            (Length, "inf m", "does not begin with a number"),
            (Length, "1.35", "has no unit"),
            (Length, "1,35 mm", "decimal comma"),
            (Length, "1.35 mmm", "did you mean “mm”?"),
            (Pressure, "3 Gpa", "did you mean “GPa”?"),
            (Length, "1e400 m", "too large"),
            (Length, "1e99999999999 m", "too large"),
            (AngularVelocity, "1.7e308 rev/s", "too large"),
            (
                Energy,
                "5 mm",
                "“mm” is a length, but an energy is expected here",
            ),
            (Length, "1 e mm", "unknown unit"),
            (
                Frequency,
                "60 rpm",
                "“rpm” is an angular velocity, but a frequency is expected here",
            ),
            (AngularVelocity, "60 rmp", "did you mean “rpm”?"),
            (
                Stiffness,
                "1 N/m2",
                "“N/m2” is a pressure, but a stiffness is expected here",
            ),
        ] {
            let error = read(dimension, text)
                .map_or_else(|error| error.to_string(), |value| value.to_string());
            assert!(error.contains(message), "{text}: {error}");
        }
    }

    #[test]
    fn no_symbol_stands_for_two_units() {
        for (i, unit) in UNITS.iter().enumerate() {
            assert!(
                UNITS[..i].iter().all(|other| other.symbol != unit.symbol),
                "{}",
                unit.symbol
            );
            assert_eq!(plain(unit.symbol), unit.symbol);
        }
    }

    proptest! {
        #[test]
        fn what_is_written_reads_back(value in proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO) {
            for dimension in [Length, Time, Mass, Density, Pressure, Velocity, Acceleration, Energy, Stiffness, Damping, Angle, AngularVelocity, Frequency] {
                prop_assert_eq!(read(dimension, &write(dimension, value)), Ok(value));
            }
        }

        #[test]
        fn any_text_is_read_or_refused(text in ".*", tail in "[-+0-9.eE µm/s²^]*") {
            for text in [&text, &tail] {
                if let Ok(value) = read(Length, text) {
                    prop_assert!(value.is_finite());
                }
            }
        }
    }
}
