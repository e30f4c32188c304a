//! The mean of several runs' summaries.

use super::{Entry, Summary};
use tsubu_model::mean_of_runs;

impl Summary {
    /// The means over runs that differ by chance alone, such as those of several seeds; `runs` in any order.
    ///
    /// Means and their standard errors are those of [`mean_of_runs`]. A value that some run does not have is null: a mean over the others would be
    /// another quantity. Facts stay if all runs agree on them. Names stand in the order of the first run.
    ///
    /// 1.0 ± 0.1 and 1.4 ± 0.1 give 1.2 ± 0.2.
    pub fn over(runs: &[&Summary]) -> Summary {
        let mut mean = Summary::new();
        let Some(first) = runs.first() else {
            return mean;
        };
        for (name, entry) in &first.entries {
            let all = runs.iter().map(|run| run.entry(name));
            if let Entry::Value { unit, .. } = entry {
                let values: Vec<_> = all.map(number).collect();
                let (value, uncertainty) = mean_of_runs(&values);
                mean.measured(name, value, uncertainty, unit);
            } else if all.clone().all(|other| other == Some(entry)) {
                mean.put(name, entry.clone());
            }
        }
        mean
    }

    /// A value and its uncertainty by name, if there is a value of this name; NaN if it is null.
    pub fn value(&self, name: &str) -> Option<(f64, Option<f64>)> {
        match self.entry(name)? {
            value @ Entry::Value { .. } => Some(number(Some(value))),
            _ => None,
        }
    }

    fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|e| e.0 == name).map(|e| &e.1)
    }
}

/// A number and its uncertainty; NaN for what is none.
fn number(entry: Option<&Entry>) -> (f64, Option<f64>) {
    match entry {
        Some(Entry::Value {
            value, uncertainty, ..
        }) => (value.unwrap_or(f64::NAN), *uncertainty),
        _ => (f64::NAN, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn run(transport: f64, own: Option<f64>, seed: u64) -> Summary {
        let mut summary = Summary::new();
        summary
            .text("title", "a bed")
            .whole("seed", seed)
            .measured("transport", transport, own, "1")
            .plain("shields", 0.1, "1");
        summary
    }

    fn over(runs: &[Summary]) -> Value {
        let runs: Vec<&Summary> = runs.iter().collect();
        serde_json::from_str(&Summary::over(&runs).to_json().unwrap()).unwrap()
    }

    /// Three values by hand: mean 2, variance 1, standard error 1/√3 = 0.577; own errors of 0.3 each give 0.173, of 3 each 1.732.
    #[test]
    fn the_larger_of_scatter_and_own_errors_is_given() {
        let three = |own| [1.0, 2.0, 3.0].map(|x| run(x, own, x as u64));
        for (own, expected) in [(None, 0.57735), (Some(0.3), 0.57735), (Some(3.0), 1.73205)] {
            let mean = over(&three(own));
            assert_eq!(mean["transport"]["value"], 2.0);
            let error = mean["transport"]["uncertainty"].as_f64().unwrap();
            assert!((error - expected).abs() < 1e-5, "{error}");
        }
    }

    #[test]
    fn what_all_agree_on_stays_and_has_no_scatter() {
        let mean = over(&[1.0, 2.0, 3.0].map(|x| run(x, None, x as u64)));
        assert_eq!(mean["title"], "a bed");
        assert!(mean.get("seed").is_none());
        assert_eq!(
            mean["shields"],
            json!({"value": 0.1, "uncertainty": null, "unit": "1"})
        );
    }

    #[test]
    fn one_run_keeps_its_own_error_and_none_gives_nothing() {
        let mean = over(&[run(1.5, Some(0.25), 1)]);
        assert_eq!(
            mean["transport"],
            json!({"value": 1.5, "uncertainty": 0.25, "unit": "1"})
        );
        assert_eq!(over(&[]), json!({}));
    }

    #[test]
    fn a_value_that_a_run_lacks_is_null() {
        let mut with = run(1.0, None, 1);
        with.plain("steady_from", 0.5, "s");
        let mean = over(&[with, run(f64::NAN, None, 2)]);
        assert!(mean["steady_from"]["value"].is_null());
        assert!(mean["transport"]["value"].is_null() && mean["transport"]["note"].is_string());
    }
}
