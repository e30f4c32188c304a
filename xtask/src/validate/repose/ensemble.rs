//! Several seeds of one case: means and spread.

use super::runs::{Case, EVERY, History};
use rayon::prelude::*;
use std::path::Path;

/// The histories of one case over its seeds.
pub struct Ensemble {
    /// The case (its seed is the first).
    pub case: Case,
    /// One history per seed.
    pub histories: Vec<History>,
}

impl Ensemble {
    /// Runs the seeds 1…`seeds` side by side.
    pub fn gather(case: Case, seeds: u64, root: &Path, fingerprint: u64) -> Result<Self, String> {
        eprintln!(
            "  heap n = {}, γ × {}, E/{}, {seeds} seeds …",
            case.coarse, case.gamma, case.soften
        );
        let run = |seed| Case { seed, ..case }.history(root, fingerprint);
        let histories = (1..=seeds)
            .into_par_iter()
            .map(run)
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self { case, histories })
    }

    /// Rows that every seed has.
    pub fn rows(&self) -> usize {
        let rows = self.histories.iter().map(|h| h.rows.len());
        rows.min().unwrap_or(0)
    }

    /// λ = 2^n.
    pub fn lambda(&self) -> f64 {
        f64::from(1u32 << self.case.coarse)
    }

    /// Mean and standard deviation over the seeds of a column at row `k`.
    pub fn value(&self, name: &str, k: usize) -> (f64, f64) {
        self.over_seeds(|h| h.column(name)[k])
    }

    /// The same of the change since the removal of the wall, as a positive number.
    pub fn change(&self, name: &str, k: usize) -> (f64, f64) {
        let (mean, spread) = self.over_seeds(|h| {
            let column = h.column(name);
            column[k] - column[0]
        });
        (mean.abs(), spread)
    }

    /// Times, mean change, and one standard deviation below and above.
    pub fn band(&self, name: &str) -> (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>) {
        let rows = self.rows();
        let t = (0..rows).map(|k| k as f64 * EVERY).collect();
        let all: Vec<(f64, f64)> = (0..rows).map(|k| self.change(name, k)).collect();
        let mean = all.iter().map(|p| p.0).collect();
        let low = all.iter().map(|p| p.0 - p.1).collect();
        let high = all.iter().map(|p| p.0 + p.1).collect();
        (t, mean, low, high)
    }

    fn over_seeds(&self, pick: impl Fn(&History) -> f64) -> (f64, f64) {
        let values: Vec<f64> = self.histories.iter().map(pick).collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
        (mean, variance.sqrt())
    }
}
