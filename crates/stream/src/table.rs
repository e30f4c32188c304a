//! A quantity given by rows: straight between them, held at both ends.

use crate::Unphysical;
use crate::unphysical::demand;

/// Rows (x, value), x increasing: straight lines between rows, the first and the last value beyond them.
///
/// The friction velocity u*(t) in m/s over s is one, and so is a measured profile ([`crate::Profile::measured`]).
///
/// ```
/// use tsubu_stream::Table;
/// // A flood that rises within two seconds: u* in m/s over time in s.
/// let flood = Table::new(vec![[0.0, 0.02], [2.0, 0.06]])?;
/// assert_eq!([flood.at(-1.0), flood.at(9.0)], [0.02, 0.06]);
/// assert!((flood.at(1.0) - 0.04).abs() < 1e-15);
/// # Ok::<(), tsubu_stream::Unphysical>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    rows: Vec<[f64; 2]>,
}

impl Table {
    /// The same value everywhere.
    pub fn constant(value: f64) -> Self {
        Self {
            rows: vec![[0.0, value]],
        }
    }

    /// A table of these rows. Refused: no rows, numbers that are not finite, x that does not increase.
    pub fn new(rows: Vec<[f64; 2]>) -> Result<Self, Unphysical> {
        demand(
            !rows.is_empty(),
            "number of rows of a table",
            0.0,
            "one row or more",
        )?;
        for (number, row) in rows.iter().enumerate() {
            let lost = row.iter().find(|value| !value.is_finite());
            let what = format!("row {number} of a table, counted from 0,");
            demand(
                lost.is_none(),
                &what,
                *lost.unwrap_or(&0.0),
                "finite numbers",
            )?;
        }
        for pair in rows.windows(2) {
            let what = format!("row of a table that follows x = {}", pair[0][0]);
            demand(
                pair[1][0] > pair[0][0],
                &what,
                pair[1][0],
                "rows with increasing x",
            )?;
        }
        Ok(Self { rows })
    }

    /// The value at `x`. Cost: a bisection over the rows.
    pub fn at(&self, x: f64) -> f64 {
        let above = self.rows.partition_point(|row| row[0] <= x);
        match (above.checked_sub(1), self.rows.get(above)) {
            (None, Some(first)) => first[1],
            (Some(last), None) => self.rows[last][1],
            (Some(below), Some(&[x1, v1])) => {
                let [x0, v0] = self.rows[below];
                v0 + (v1 - v0) * ((x - x0) / (x1 - x0))
            }
            // No rows: `new` lets none through.
            (None, None) => 0.0,
        }
    }

    /// Its rows.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// Refused if a value is negative; `what` names the values.
    pub(crate) fn demand_not_negative(&self, what: &str, unit: &str) -> Result<(), Unphysical> {
        self.rows
            .iter()
            .try_for_each(|row| crate::unphysical::demand_not_negative(what, row[1], unit))
    }
}
