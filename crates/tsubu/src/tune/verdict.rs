//! Whether a setting keeps a quantity within a tolerance, the statistical error counted.

use super::pilot::Outcome;
use tsubu::model::mean_of_runs;

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
    let values: Vec<_> = runs
        .iter()
        .map(|r| (r.value, Some(r.uncertainty)))
        .collect();
    let (value, error) = mean_of_runs(&values);
    Mean {
        value,
        error: error.unwrap_or(0.0),
        cost: runs.iter().map(|r| r.cost).sum::<f64>() / runs.len() as f64,
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
