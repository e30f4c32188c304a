//! One check: what theory expects, what the simulation gave, and how far they may be apart.

use serde::Serialize;

/// Where the expected value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Evidence {
    /// A closed form, a quadrature or an exact property.
    Analytic,
    /// Another program.
    CrossCode,
    /// A measurement in a laboratory.
    Experiment,
}

/// How far the value may lie from the expected one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Tolerance {
    /// |got − expected| ≤ this × |expected|.
    Relative(f64),
    /// |got − expected| ≤ this.
    Absolute(f64),
    /// got ≤ expected.
    AtMost,
    /// got ≥ expected.
    AtLeast,
    /// A number to read, neither passed nor failed.
    Information,
}

impl Tolerance {
    fn holds(self, expected: f64, got: f64) -> bool {
        match self {
            Tolerance::Relative(share) => (got - expected).abs() <= share * expected.abs(),
            Tolerance::Absolute(by) => (got - expected).abs() <= by,
            Tolerance::AtMost => got <= expected,
            Tolerance::AtLeast => got >= expected,
            Tolerance::Information => true,
        }
    }

    /// As the table shows it.
    pub fn words(self) -> String {
        match self {
            Tolerance::Relative(share) => format!("±{share:.0e} rel"),
            Tolerance::Absolute(by) => format!("±{by:.0e}"),
            Tolerance::AtMost => "at most".into(),
            Tolerance::AtLeast => "at least".into(),
            Tolerance::Information => "–".into(),
        }
    }
}

/// One row of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    /// The suite that it belongs to.
    pub suite: &'static str,
    /// What is compared.
    pub name: String,
    /// The value that theory gives.
    pub expected: f64,
    /// The value of the simulation.
    pub got: f64,
    /// How far the two may be apart.
    pub tolerance: Tolerance,
    /// Where `expected` comes from.
    pub evidence: Evidence,
    /// Whether it holds. NaN never does.
    pub pass: bool,
    /// Why this tolerance, and what else a reader should know.
    pub note: String,
}

impl Check {
    /// Compares.
    pub fn new(
        suite: &'static str,
        name: String,
        expected: f64,
        got: f64,
        tolerance: Tolerance,
        evidence: Evidence,
        note: &str,
    ) -> Self {
        let pass = tolerance.holds(expected, got);
        let note = note.to_string();
        Self {
            suite,
            name,
            expected,
            got,
            tolerance,
            evidence,
            pass,
            note,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passes(expected: f64, got: f64, tolerance: Tolerance) -> bool {
        Check::new(
            "t",
            "n".into(),
            expected,
            got,
            tolerance,
            Evidence::Analytic,
            "",
        )
        .pass
    }

    #[test]
    fn each_tolerance_holds_on_one_side_of_its_bound_only() {
        assert!(passes(2.0, 2.019, Tolerance::Relative(0.01)));
        assert!(!passes(2.0, 2.021, Tolerance::Relative(0.01)));
        assert!(passes(0.0, -0.01, Tolerance::Absolute(0.01)));
        assert!(!passes(0.0, -0.011, Tolerance::Absolute(0.01)));
        assert!(passes(1.0, 1.0, Tolerance::AtMost) && !passes(1.0, 1.1, Tolerance::AtMost));
        assert!(passes(1.0, 1.0, Tolerance::AtLeast) && !passes(1.0, 0.9, Tolerance::AtLeast));
    }

    #[test]
    fn not_a_number_never_passes_a_comparison() {
        for tolerance in [
            Tolerance::Relative(1.0),
            Tolerance::Absolute(1.0),
            Tolerance::AtMost,
            Tolerance::AtLeast,
        ] {
            assert!(!passes(1.0, f64::NAN, tolerance));
        }
    }
}
