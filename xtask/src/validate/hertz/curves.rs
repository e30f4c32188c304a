//! The digitised curves of the benchmark (`chung_ooi.csv` beside this file).
//!
//! *Error of reading, taken before any comparison:* 2 % of what the axis spans, from the least to the largest value of all series of
//! a panel. A symbol of a printed figure is about so wide, and its middle is found to half of that on either axis. Where x is known
//! (whole degrees of incidence) the readings are off by 0.1 to 0.2 % of the axis, so this is on the generous side.

use super::largest;

/// Share of the axis by which a reading may be off.
pub const READING: f64 = 0.02;

/// A digitised series: x and y.
pub type Curve = (Vec<f64>, Vec<f64>);

struct Row {
    test: &'static str,
    quantity: &'static str,
    series: &'static str,
    x: f64,
    y: f64,
}

fn rows() -> impl Iterator<Item = Row> {
    let lines = include_str!("chung_ooi.csv").lines();
    lines.filter(|l| !l.starts_with('#')).skip(1).map(|line| {
        // The name of a series may hold commas and stands in quotes.
        let mut parts = line.split('"');
        let mut words = parts.next().unwrap_or("").split(',');
        let (test, quantity) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
        let series = parts.next().unwrap_or("");
        let mut numbers = parts.next().unwrap_or("").split(',').skip(1);
        let mut number = || {
            numbers
                .next()
                .and_then(|w| w.parse().ok())
                .unwrap_or(f64::NAN)
        };
        Row {
            test,
            quantity,
            series,
            x: number(),
            y: number(),
        }
    })
}

/// A series of a panel, named by how its quantity and its series begin.
pub fn curve(test: u32, quantity: &str, series: &str) -> Curve {
    rows()
        .filter(|row| {
            row.test == test.to_string()
                && row.quantity.starts_with(quantity)
                && row.series.starts_with(series)
        })
        .map(|row| (row.x, row.y))
        .unzip()
}

/// By how much a reading of y may be off in this panel.
pub fn reading(test: u32, quantity: &str) -> f64 {
    let (_, all) = curve(test, quantity, "");
    let span = |from: f64, f: fn(f64, f64) -> f64| all.iter().copied().fold(from, f);
    READING * (span(f64::NEG_INFINITY, f64::max) - span(f64::INFINITY, f64::min))
}

/// The largest |got(x) − y| of the points that `counts` picks by their x.
pub fn off(curve: &Curve, counts: impl Fn(f64) -> bool, got: impl Fn(f64) -> f64) -> f64 {
    let points = curve.0.iter().zip(&curve.1).filter(|(x, _)| counts(**x));
    largest(points.map(|(&x, &y)| got(x) - y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_are_read_whole_and_an_absent_one_is_empty() {
        let (x, y) = curve(4, "tangential", "experiment");
        assert_eq!((x.len(), x[0], y[0]), (10, 2.23762, 0.79654));
        assert_eq!(curve(1, "normal", "glass").0.len(), 15);
        assert!(curve(3, "", "").0.is_empty());
        assert!((reading(4, "tangential") / READING - (0.982702 - 0.598847)).abs() < 1e-12);
    }
}
