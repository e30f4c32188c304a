//! Transport measured in flumes (`flume.csv` beside this file).

/// A measurement.
struct Row {
    series: &'static str,
    diameter: f64,
    shields: f64,
    transport: f64,
}

/// Bins of τ* of the measured band.
const BINS: [(f64, f64); 12] = [
    (0.05, 0.06),
    (0.06, 0.07),
    (0.07, 0.08),
    (0.08, 0.10),
    (0.10, 0.12),
    (0.12, 0.15),
    (0.15, 0.20),
    (0.20, 0.30),
    (0.30, 0.40),
    (0.40, 0.50),
    (0.50, 0.70),
    (0.70, 1.00),
];

fn rows() -> impl Iterator<Item = Row> {
    let lines = include_str!("flume.csv").lines();
    lines.filter(|l| !l.starts_with('#')).skip(1).map(|line| {
        let mut words = line.split(',');
        let series = words.next().unwrap_or("");
        let mut number = || {
            words
                .next()
                .and_then(|w| w.parse().ok())
                .unwrap_or(f64::NAN)
        };
        Row {
            series,
            diameter: number(),
            shields: number(),
            transport: number(),
        }
    })
}

/// τ* and qB* of all rows but Gilbert's 0.5 mm, and of those.
pub fn points() -> [(Vec<f64>, Vec<f64>); 2] {
    [false, true].map(|wanted| {
        let of_sand = |row: &Row| row.series == "Gilbert 1914" && (row.diameter - 0.5).abs() < 0.01;
        rows()
            .filter(|row| of_sand(row) == wanted && row.shields >= 0.04 && row.transport > 1e-3)
            .map(|row| (row.shields, row.transport))
            .unzip()
    })
}

/// The 10–90 % band of all rows in the bin of this τ*, `None` outside 0.05–1. At 1 it is that of the last bin.
pub fn band(shields: f64) -> Option<[f64; 2]> {
    let at = shields.min(0.999);
    let (low, high) = BINS.into_iter().find(|b| (b.0..b.1).contains(&at))?;
    let mut all: Vec<f64> = rows()
        .filter(|row| (low..high).contains(&row.shields))
        .map(|row| row.transport)
        .collect();
    all.sort_by(f64::total_cmp);
    let quantile = |share: f64| {
        let place = share * (all.len() - 1) as f64;
        let k = place as usize;
        let next = all[(k + 1).min(all.len() - 1)];
        all[k] + (place - k as f64) * (next - all[k])
    };
    Some([quantile(0.1), quantile(0.9)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against quantiles worked out apart from this code, with another program's interpolation of the same kind.
    #[test]
    fn the_band_is_that_of_the_rows() {
        assert_eq!(rows().count(), 991);
        assert!(rows().all(|r| r.transport > 0.0 && r.shields > 0.0 && r.diameter > 0.0));
        let [low, high] = band(0.5).unwrap_or_default();
        assert!(
            (low - 3.582).abs() < 1e-3 && (high - 6.003).abs() < 1e-3,
            "{low} {high}"
        );
        assert!(band(0.01).is_none());
    }
}
