//! From values to places along an axis: the range shown, the ticks, and their labels.

/// Values beyond this cannot be drawn: sums of two of them would overflow.
const LARGEST: f64 = 1e300;

/// A range of values along a number of pixels.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    log: bool,
    /// The range shown, as logarithms to base ten on a logarithmic axis.
    low: f64,
    high: f64,
}

/// A mark on an axis; those without a label are drawn small.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Where, as a share of the axis from its low end.
    pub(super) share: f64,
    pub(super) label: String,
}

/// Whether an axis can show the value at all.
pub(super) fn drawable(log: bool, value: f64) -> bool {
    value.is_finite() && value.abs() < LARGEST && (!log || value > 0.0)
}

impl Scale {
    /// The scale that shows `asked`, if that is possible, or else all drawable values with some room.
    pub(super) fn new(
        log: bool,
        asked: Option<(f64, f64)>,
        values: impl Iterator<Item = f64>,
    ) -> Self {
        let inner = |value: f64| if log { value.log10() } else { value };
        if let Some((low, high)) = asked.filter(|&range| possible(log, range)) {
            return Self {
                log,
                low: inner(low),
                high: inner(high),
            };
        }
        let (mut low, mut high) = values
            .filter(|&value| drawable(log, value))
            .map(inner)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (low.min(v), high.max(v))
            });
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        let span = high - low;
        let size = low.abs().max(high.abs());
        let room = if span > 1e-9 * size && span > 1e-290 {
            0.06 * span
        } else if log {
            0.5
        } else if size > 1e-290 {
            0.1 * size
        } else {
            1.0
        };
        Self {
            log,
            low: low - room,
            high: high + room,
        }
    }

    /// Where a value lies, as a share of the axis from its low end; a value that cannot be drawn lies far below.
    pub(super) fn share(&self, value: f64) -> f64 {
        let inner = if !self.log {
            value
        } else if value > 0.0 {
            value.log10()
        } else {
            return -10.0;
        };
        ((inner - self.low) / self.span()).clamp(-1e3, 1e3)
    }

    pub(super) fn span(&self) -> f64 {
        self.high - self.low
    }

    /// Widens the range about its middle.
    pub(super) fn stretch(&mut self, factor: f64) {
        let room = 0.5 * self.span() * (factor - 1.0);
        if room.is_finite() && room < LARGEST {
            self.low -= room;
            self.high += room;
        }
    }

    /// The ticks, about `count` of them labelled, and the power of ten by which the labels are to be multiplied.
    pub(super) fn ticks(&self, count: usize) -> (Vec<Tick>, i32) {
        if !self.log {
            return self.linear_ticks(self.low, self.high, count);
        }
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        if self.span() < 0.85 {
            // Less than a decade or so: round numbers, at their logarithmic places.
            return self.linear_ticks(10f64.powf(self.low), 10f64.powf(self.high), count);
        }
        let stride = (self.span() / count.max(1) as f64).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for decade in first..=last {
            if decade.rem_euclid(stride) == 0 {
                ticks.push(self.tick(f64::from(decade), power_of_ten(decade)));
            }
            for digit in (2..10).filter(|_| stride == 1 && self.span() < 8.0) {
                let labelled = self.span() < 2.0 && (digit == 2 || digit == 5);
                let label = if labelled {
                    short(f64::from(digit), decade)
                } else {
                    String::new()
                };
                ticks.push(self.tick(f64::from(decade) + f64::from(digit).log10(), label));
            }
        }
        ticks.retain(|tick| (-1e-9..=1.0 + 1e-9).contains(&tick.share));
        (ticks, 0)
    }

    fn tick(&self, inner: f64, label: String) -> Tick {
        Tick {
            share: (inner - self.low) / self.span(),
            label,
        }
    }

    fn linear_ticks(&self, low: f64, high: f64, count: usize) -> (Vec<Tick>, i32) {
        let rough = (high - low) / count.max(1) as f64;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * decade)
            .into_iter()
            .find(|s| *s >= rough * 0.8);
        let Some(step) = step.filter(|s| s.is_finite() && *s > 0.0) else {
            return (Vec::new(), 0);
        };
        let size = low.abs().max(high.abs());
        let exponent = size.log10().floor() as i32;
        let exponent = if (-3..5).contains(&exponent) {
            0
        } else {
            exponent
        };
        let decimals =
            (f64::from(exponent) - (step * 1.0001).log10().floor()).clamp(0.0, 12.0) as usize;
        let ticks = (0..=count * 3).map(|i| ((low / step - 1e-9).ceil() + i as f64) * step);
        let ticks = ticks
            .take_while(|value| *value <= high + 1e-9 * step)
            .map(|value| {
                let value = if value.abs() < 1e-9 * step {
                    0.0
                } else {
                    value
                };
                // Two divisions: a power of ten beyond 308 does not exist.
                let half = exponent / 2;
                let shown = value / 10f64.powi(half) / 10f64.powi(exponent - half);
                Tick {
                    share: self.share(value),
                    label: format!("{shown:.decimals$}").replace('-', "−"),
                }
            });
        (
            ticks.filter(|tick| tick.share.is_finite()).collect(),
            exponent,
        )
    }
}

/// Whether a range asked for can be shown.
pub(super) fn possible(log: bool, (low, high): (f64, f64)) -> bool {
    let roomy = high - low > 1e-9 * low.abs().max(high.abs()) && high - low > 1e-290;
    drawable(log, low) && drawable(log, high) && roomy
}

/// 10ⁿ as one reads it best.
pub(super) fn power_of_ten(exponent: i32) -> String {
    if (-2..=3).contains(&exponent) {
        return short(1.0, exponent);
    }
    let digits = exponent.to_string();
    let raised = digits.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => c
            .to_digit(10)
            .and_then(|d| char::from_u32('⁰' as u32 + d))
            .unwrap_or(c),
    });
    format!("10{}", raised.collect::<String>())
}

fn short(digit: f64, decade: i32) -> String {
    if (-3..=3).contains(&decade) {
        let decimals = usize::try_from(-decade).unwrap_or(0);
        format!("{:.decimals$}", digit * 10f64.powi(decade))
    } else {
        format!("{digit}·{}", power_of_ten(decade))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(log: bool, low: f64, high: f64) -> (Vec<String>, i32) {
        let (ticks, exponent) = Scale::new(log, Some((low, high)), std::iter::empty()).ticks(6);
        (
            ticks
                .into_iter()
                .map(|t| t.label)
                .filter(|l| !l.is_empty())
                .collect(),
            exponent,
        )
    }

    #[test]
    fn ticks_are_round_numbers_and_tiny_units_share_a_power_of_ten() {
        assert_eq!(
            labels(false, 0.0, 1.0).0,
            ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]
        );
        assert_eq!(
            labels(false, -1.0, 1.0).0,
            ["−1.0", "−0.5", "0.0", "0.5", "1.0"]
        );
        assert_eq!(
            labels(false, 0.0, 3e-17),
            (
                ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]
                    .map(String::from)
                    .to_vec(),
                -17
            )
        );
        assert_eq!(
            labels(true, 1e-12, 1e-9).0,
            ["10⁻¹²", "10⁻¹¹", "10⁻¹⁰", "10⁻⁹"]
        );
        assert_eq!(labels(true, 0.1, 2.0).0, ["0.1", "0.2", "0.5", "1", "2"]);
    }

    #[test]
    fn a_decade_is_as_long_as_the_next() {
        let scale = Scale::new(true, Some((1e-12, 1e-8)), std::iter::empty());
        assert!((scale.share(1e-10) - 0.5).abs() < 1e-12);
    }
}
