//! Whether a setting keeps a quantity within a tolerance, the statistical error counted.

use super::pilot::Outcome;

/// Mean of some runs, with its standard error: of their scatter and of their own, the larger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
    /// Core-seconds of one run.
    pub cost: f64,
}

/// Mean of one run or more.
pub fn mean(runs: &[Outcome]) -> Mean {
    let n = runs.len() as f64;
    let sum = |f: &dyn Fn(&Outcome) -> f64| runs.iter().map(f).sum::<f64>();
    let value = sum(&|r| r.value) / n;
    let own = sum(&|r| r.uncertainty.powi(2)) / (n * n);
    let scatter = sum(&|r| (r.value - value).powi(2)) / (n * (n - 1.0).max(1.0));
    Mean {
        value,
        error: own.max(scatter).sqrt(),
        cost: sum(&|r| r.cost) / n,
    }
}

/// How far a mean is from the truth as a share of that, and the standard error of it.
pub fn off(mean: Mean, truth: Mean) -> (f64, f64) {
    let ratio = mean.value / truth.value;
    let error = (mean.error / truth.value).hypot(ratio * truth.error / truth.value);
    (ratio - 1.0, error)
}

/// What can be said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Within the tolerance, the standard error added.
    Within,
    /// Beyond it by two standard errors.
    Beyond,
    /// Neither.
    Open,
}

/// The verdict on a mean.
pub fn verdict(mean: Mean, truth: Mean, tolerance: f64) -> Verdict {
    let (off, error) = off(mean, truth);
    match off.abs() {
        x if x + error <= tolerance => Verdict::Within,
        x if x - 2.0 * error > tolerance => Verdict::Beyond,
        _ => Verdict::Open,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(value: f64, uncertainty: f64) -> Outcome {
        Outcome {
            value,
            uncertainty,
            cost: 1.0,
        }
    }

    #[test]
    fn a_mean_knows_the_larger_of_two_errors() {
        // Two runs that agree: their own errors, 0.3/√2. Two that differ by 2: scatter 1.
        assert!((mean(&[run(5.0, 0.3), run(5.0, 0.3)]).error - 0.3 / 2f64.sqrt()).abs() < 1e-12);
        assert!((mean(&[run(4.0, 0.3), run(6.0, 0.3)]).error - 1.0).abs() < 1e-12);
        assert_eq!(mean(&[run(4.0, 0.3)]).error, 0.3);
    }

    #[test]
    fn a_noisy_run_is_neither_in_nor_out() {
        let truth = mean(&[run(100.0, 0.0)]);
        let of = |value, uncertainty| verdict(mean(&[run(value, uncertainty)]), truth, 0.05);
        assert_eq!(of(103.0, 1.0), Verdict::Within);
        assert_eq!(of(103.0, 3.0), Verdict::Open);
        assert_eq!(of(108.0, 1.0), Verdict::Beyond);
        assert_eq!(of(108.0, 2.0), Verdict::Open);
        assert_eq!(of(92.0, 1.0), Verdict::Beyond);
    }
}
