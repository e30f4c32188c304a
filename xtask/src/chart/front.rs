//! Points of a chart and the front of those that nothing beats in both cost and error.

/// One setting of the knobs, and what it gave.
#[derive(Clone, Debug)]
pub struct Point {
    /// As the table calls it.
    pub name: String,
    /// What it leaves out or coarsens.
    pub gives_up: String,
    /// Mean cost of a run: seconds of one core, or instructions.
    pub cost: f64,
    /// Root mean square error of one run against the reference, as a share of it: bias and scatter together.
    pub error: f64,
    /// Standard error of that.
    pub uncertainty: f64,
    /// True if the shipped scene is set so.
    pub is_default: bool,
}

/// Indices of the front, cheapest first: each costs less than all that err less.
pub fn front(points: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len())
        .filter(|&k| points[k].error.is_finite() && points[k].cost.is_finite())
        .collect();
    order.sort_by(|&a, &b| {
        let by = |k: usize| (points[k].cost, points[k].error);
        by(a)
            .partial_cmp(&by(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut least = f64::INFINITY;
    order.retain(|&k| {
        let better = points[k].error < least;
        least = least.min(points[k].error);
        better
    });
    order
}

/// How far a point lies above the front, in its own standard errors and those of the front's point at no more cost; 0 on the
/// front.
pub fn above(points: &[Point], front: &[usize], k: usize) -> f64 {
    let cheaper = front
        .iter()
        .rev()
        .find(|&&f| points[f].cost <= points[k].cost);
    cheaper.map_or(0.0, |&f| {
        let by = (points[k].error - points[f].error).max(0.0);
        if by == 0.0 {
            0.0
        } else {
            by / points[k].uncertainty.hypot(points[f].uncertainty)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point((cost, error): (f64, f64)) -> Point {
        Point {
            name: String::new(),
            gives_up: String::new(),
            cost,
            error,
            uncertainty: 0.1,
            is_default: false,
        }
    }

    proptest! {
        /// No point beats one of the front in both, and every other point is beaten by one of it.
        #[test]
        fn nothing_beats_the_front(values in prop::collection::vec((0.1..9.0f64, 0.1..9.0f64), 1..40)) {
            let points: Vec<Point> = values.into_iter().map(point).collect();
            let front = front(&points);
            let beats = |a: &Point, b: &Point| a.cost <= b.cost && a.error < b.error;
            for (k, p) in points.iter().enumerate() {
                prop_assert_eq!(front.contains(&k), !points.iter().any(|q| beats(q, p) || (q.cost < p.cost && q.error <= p.error)));
                prop_assert_eq!(above(&points, &front, k) > 0.0, front.iter().any(|&f| beats(&points[f], p)));
            }
        }
    }
}
