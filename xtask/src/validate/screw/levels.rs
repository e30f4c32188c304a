//! What the levels say together: the order in λ, a straight line to the real grain, figures.

use super::section::{Found, most};
use crate::validate::kept::Measured;
use crate::validate::report::Report;
use tsubu_picture::Figure;

/// A straight line in λ through two levels, taken to λ = 1: value and error.
///
/// With f(λ) = f₀ + c λ and two measured values at λ and 2λ, f(1) = f(λ) − (f(2λ) − f(λ))(λ − 1)/λ.
fn at_real_grain(lambda: f64, fine: (f64, f64), coarse: (f64, f64)) -> (f64, f64) {
    let share = (lambda - 1.0) / lambda;
    (
        fine.0 - (coarse.0 - fine.0) * share,
        ((1.0 + share) * fine.1).hypot(share * coarse.1),
    )
}

/// The ladder of the section at 60 r/min: order, extrapolation, figures.
pub fn levels(report: &mut Report, found: &[Found]) -> Result<(), String> {
    let mut efficiency = Figure::new(
        "One pitch of the screw at 60 r/min, n = 2, 3, 4",
        "grain diameter d' (mm)",
        "axial speed over p n (–)",
    );
    let mut rate = Figure::new(
        "One pitch of the screw at 60 r/min, n = 2, 3, 4",
        "grain diameter d' (mm)",
        "mass rate (kg/s)",
    );
    for (at_centres, place) in [(false, "s = R + d/2"), (true, "s = R")] {
        // From n = 2 up.
        let rungs: Vec<&Found> = found
            .iter()
            .filter(|f| f.rung.at_centres == at_centres)
            .collect();
        let x: Vec<f64> = rungs.iter().map(|f| f.rung.diameter() * 1e3).collect();
        let values: Vec<(f64, f64)> = rungs.iter().map(|f| f.efficiency()).collect();
        let rates: Vec<(f64, f64)> = rungs.iter().map(|f| f.rate()).collect();
        let [fine, middle, coarse] = values[..] else {
            return Err("the ladder has three rungs".into());
        };
        let order = ((coarse.0 - middle.0) / (middle.0 - fine.0)).log2();
        report.tell(
            format!("ladder, 60 r/min, {place}: order of the axial efficiency in λ"),
            order,
            "log2 of the ratio of its changes from n = 4 to 3 and from 3 to 2; NaN if they differ in sign",
        );
        let lambda = rungs[0].rung.lambda();
        let (at_one, error) = at_real_grain(lambda, fine, middle);
        report.tell(
            format!("ladder, 60 r/min, {place}: axial efficiency taken to λ = 1"),
            at_one,
            &format!(
                "straight in λ through n = 3 and n = 2, whatever the order; ± {error:.4} of the two"
            ),
        );
        let (rate_at_one, rate_error) = at_real_grain(lambda, rates[0], rates[1]);
        report.tell(
            format!("ladder, 60 r/min, {place}: mass rate taken to λ = 1, kg/s"),
            rate_at_one,
            &format!("as above; ± {rate_error:.4}"),
        );
        let line = [1.350, x[1]];
        let (y, e): (Vec<f64>, Vec<f64>) = values.into_iter().unzip();
        efficiency = efficiency.points(place, &x, &y, Some(&e)).line(
            &format!("{place}: straight in λ to n = 0"),
            &line,
            &[at_one, middle.0],
        );
        let middle = rates[1].0;
        let (y, e): (Vec<f64>, Vec<f64>) = rates.into_iter().unzip();
        rate = rate.points(place, &x, &y, Some(&e)).line(
            &format!("{place}: straight in λ to n = 0"),
            &line,
            &[rate_at_one, middle],
        );
    }
    // What s = R gives if only the room differs.
    let surface = found
        .iter()
        .find(|f| !f.rung.at_centres)
        .map_or(f64::NAN, |f| f.rate().0);
    let x: Vec<f64> = (0..=40).map(|k| 1.350 + 0.5 * f64::from(k)).collect();
    let room: Vec<f64> = x
        .iter()
        .map(|d| surface * most(0.5e-3 * d) / most(0.0))
        .collect();
    rate = rate.theory("s = R + d/2 at n = 2, times C(d'/2)/C(0)", &x, &room);
    report.figure("screw_ladder", efficiency)?;
    report.figure("screw_ladder_rate", rate)
}

/// The whole feeder at 60 r/min: what changes from n = 4 to n = 3, and where a straight line goes.
pub fn feeder(report: &mut Report, n3: &Measured, n4: &Measured) {
    for (what, words) in [
        ("mass_rate", "mass rate, kg/s"),
        ("ratio_to_theory", "rate over theory at a = 1"),
        ("fill_ratio", "filling ratio a"),
        ("axial_efficiency", "axial efficiency"),
    ] {
        let (fine, coarse) = (n3.get(what), n4.get(what));
        let error = fine.0 / coarse.0 * (fine.1 / fine.0).hypot(coarse.1 / coarse.0);
        report.tell(
            format!("feeder, 60 r/min: {words}, n = 3 over n = 4"),
            fine.0 / coarse.0,
            &format!("± {error:.3}"),
        );
        let (value, error) = at_real_grain(8.0, fine, coarse);
        report.tell(
            format!("feeder, 60 r/min: {words}, taken to λ = 1"),
            value,
            &format!(
                "straight in λ through n = 4 and n = 3, an assumption; ± {error:.3} of the two"
            ),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_taken_to_the_real_grain() {
        // 1 − 0.01 λ is 0.99 at λ = 1; its error is that of 2 × fine less coarse, a little less.
        let (value, error) = at_real_grain(4.0, (0.96, 0.1), (0.92, 0.0));
        assert!((value - 0.99).abs() < 1e-12 && (error - 0.175).abs() < 1e-12);
    }
}
