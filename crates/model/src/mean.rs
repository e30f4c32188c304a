//! The mean of runs that differ by chance alone.

/// Mean of values with their own uncertainties, and the standard error of it.
///
/// ```text
/// x = Σ xᵢ/n,    u² = max(Σ (xᵢ − x)²/(n (n − 1)), Σ uᵢ²/n²)
/// ```
///
/// By the scatter of the n runs, or by their own uncertainties uᵢ, whichever is larger, since each may miss what the other
/// sees. Where neither is known (one run, or runs that are all alike, without their own) there is no error; so too where a
/// value is no number, and then the mean is none either. NaN for no values. Units: those of the values.
///
/// ```
/// use tsubu_model::mean_of_runs;
/// let (mean, error) = mean_of_runs(&[(1.0, Some(0.1)), (1.4, Some(0.1))]);
/// assert!((mean - 1.2).abs() < 1e-15 && (error.unwrap_or(0.0) - 0.2).abs() < 1e-15);
/// assert_eq!(mean_of_runs(&[(3.0, None)]), (3.0, None));
/// ```
pub fn mean_of_runs(values: &[(f64, Option<f64>)]) -> (f64, Option<f64>) {
    let n = values.len() as f64;
    let alike = values.windows(2).all(|two| two[0].0 == two[1].0);
    let mean = match values.first() {
        None => f64::NAN,
        // A sum of equal numbers may be rounded.
        Some(first) if alike => first.0,
        Some(_) => values.iter().map(|v| v.0).sum::<f64>() / n,
    };
    let scatter = (!alike)
        .then(|| values.iter().map(|v| (v.0 - mean).powi(2)).sum::<f64>() / (n * (n - 1.0)));
    let own: Option<f64> = values.iter().map(|v| v.1.map(|u| u * u)).sum();
    let own = own.map(|sum| sum / (n * n));
    let larger = scatter.into_iter().chain(own).reduce(f64::max);
    (mean, larger.map(f64::sqrt).filter(|_| mean.is_finite()))
}
