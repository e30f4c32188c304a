//! A straight line through neighbouring bins.

/// Least-squares line y = intercept + slope · x with standard errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Rise per unit of x.
    pub slope: f64,
    /// Value at x = 0.
    pub intercept: f64,
    /// Standard deviation of `slope`; `None` for two points.
    pub slope_error: Option<f64>,
    /// Standard deviation of `intercept`; `None` for two points.
    pub intercept_error: Option<f64>,
}

/// The largest correlation of neighbours that is believed: beyond it the inflation would be noise.
const MOST_CORRELATED: f64 = 0.8;

impl Line {
    /// Fits points in the order of x. `None` for fewer than two points or equal abscissae.
    ///
    /// Errors come from the residuals e with n − 2 degrees of freedom. Neighbouring bins share grains,
    /// so they are not independent: r = Σ eᵢeᵢ₊₁ / Σ eᵢ² is taken as the correlation of neighbours
    /// (first-order autoregression, held within 0–0.8) and the errors grow by √((1 + r)/(1 − r)).
    /// A bent flank shows up as correlated residuals and so widens the error, as it should.
    ///
    /// ```
    /// let line = tsubu_measure::Line::fit(&[0.0, 1.0, 2.0, 3.0], &[1.0, 3.0, 5.0, 7.0]).unwrap();
    /// assert_eq!((line.slope, line.intercept), (2.0, 1.0));
    /// ```
    pub fn fit(x: &[f64], y: &[f64]) -> Option<Self> {
        let count = x.len().min(y.len());
        if count < 2 {
            return None;
        }
        let n = count as f64;
        let (x, y) = (&x[..count], &y[..count]);
        let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
        let sxx: f64 = x.iter().map(|x| (x - mx).powi(2)).sum();
        let sxy: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
        let slope = sxy / sxx;
        if !slope.is_finite() {
            return None;
        }
        let residual: Vec<f64> = x
            .iter()
            .zip(y)
            .map(|(x, y)| y - my - slope * (x - mx))
            .collect();
        let square: f64 = residual.iter().map(|e| e * e).sum();
        let neighbours: f64 = residual.windows(2).map(|e| e[0] * e[1]).sum();
        let correlation = if square > 0.0 {
            (neighbours / square).clamp(0.0, MOST_CORRELATED)
        } else {
            0.0
        };
        let variance = square / (n - 2.0) * (1.0 + correlation) / (1.0 - correlation);
        let known = count > 2;
        Some(Self {
            slope,
            intercept: my - slope * mx,
            slope_error: known.then(|| (variance / sxx).sqrt()),
            intercept_error: known.then(|| (variance * (1.0 / n + mx * mx / sxx)).sqrt()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_those_of_the_textbook() {
        // Worked by hand: x = 1..4, y = 1, 3, 2, 4: slope 0.8, residuals −0.3, 0.9, −0.9, 0.3 (so r < 0),
        // s² = 1.8/2, error of the slope √(0.9/5), of the intercept √(0.9 (1/4 + 6.25/5)).
        let line = Line::fit(&[1.0, 2.0, 3.0, 4.0], &[1.0, 3.0, 2.0, 4.0]).unwrap();
        assert!((line.slope - 0.8).abs() < 1e-12 && (line.intercept - 0.5).abs() < 1e-12);
        assert!((line.slope_error.unwrap() - 0.18f64.sqrt()).abs() < 1e-12);
        assert!((line.intercept_error.unwrap() - 1.35f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn correlated_noise_widens_the_error() {
        let x: Vec<f64> = (0..24).map(f64::from).collect();
        let alternating: Vec<f64> = (0..24)
            .map(|i| if i % 2 == 0 { 0.1 } else { -0.1 })
            .collect();
        let in_sixes: Vec<f64> = (0..24)
            .map(|i| if (i / 6) % 2 == 0 { 0.1 } else { -0.1 })
            .collect();
        let [a, b] =
            [alternating, in_sixes].map(|y| Line::fit(&x, &y).unwrap().slope_error.unwrap());
        assert!(b > 1.8 * a, "{a} {b}");
    }

    #[test]
    fn no_line_through_less_than_two_places() {
        assert_eq!(Line::fit(&[1.0], &[1.0]), None);
        assert_eq!(Line::fit(&[1.0, 1.0], &[1.0, 2.0]), None);
        assert!(Line::fit(&[1.0, 2.0], &[1.0, 2.0]).is_some_and(|l| l.slope_error.is_none()));
    }
}
