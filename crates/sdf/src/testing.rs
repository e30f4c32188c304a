//! The conformance suite: what every surface must do, whatever its shape.
//!
//! One line enrols a surface, from this crate or from any other:
//!
//! ```
//! use glam::DVec3;
//! use tsubu_model::Space;
//! use tsubu_sdf::Ball;
//! use tsubu_sdf::testing::{Options, conforms};
//! let ball = Ball::<Space>::new(DVec3::ZERO, 0.5)?;
//! let report = conforms::<Space>(&ball, [DVec3::splat(-1.0), DVec3::ONE], &Options::default());
//! assert!(report.breaches.is_empty() && report.points >= 1000);
//! # Ok::<(), tsubu_sdf::Misshapen>(())
//! ```
//!
//! [`conforms`] panics with a report that names each failed [`Check`], the worst point found and the
//! numbers; [`examine`] returns the same as values. The points are fixed: a failure repeats.
//!
//! The true distance of a point is taken from the surface itself: that of its nearest hit. So the
//! suite cannot see a surface that is consistently the wrong one; [`Options::inside`] brings in a
//! word from outside, and [`Options::expects`] says how many hits a concave place has.
//!
//! [`Surface::hits`] may answer for a point inside the body with its nearest hit only. A body that is a
//! union of parts, each with a hit of its own on either side, says so with [`Options::union`].

mod checks;
mod points;
mod report;

pub use report::{Breach, Check, Report};

use tsubu_model::{Dim, Surface};

/// What is known of a surface and how closely it is held to it.
pub struct Options<'a, D: Dim> {
    reach: f64,
    tolerance: f64,
    samples: usize,
    inside: Option<&'a dyn Fn(D::V) -> bool>,
    special: Vec<D::V>,
    expected: Vec<(D::V, f64, usize)>,
    union: bool,
    drawn_within: f64,
}

impl<D: Dim> Default for Options<'_, D> {
    /// Any reach, a tolerance of 1e-9 of the region's diagonal, 1000 points.
    fn default() -> Self {
        Self {
            reach: f64::INFINITY,
            tolerance: 1e-9,
            samples: 1000,
            inside: None,
            special: Vec::new(),
            expected: Vec::new(),
            union: false,
            drawn_within: 0.0,
        }
    }
}

impl<'a, D: Dim> Options<'a, D> {
    /// The surface knows its distance only up to `reach` (m): a narrow band.
    pub fn reach(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// Error of a distance that is allowed, as a share of the region's diagonal. Normals may be off by
    /// its square root: that is what a difference quotient can see.
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// How many points and segments are tried.
    pub fn samples(self, samples: usize) -> Self {
        Self { samples, ..self }
    }

    /// Who is inside the body, told by something other than the surface.
    pub fn inside(self, inside: &'a dyn Fn(D::V) -> bool) -> Self {
        Self {
            inside: Some(inside),
            ..self
        }
    }

    /// Points where formulas break: centres, axes, edges, corners. Numbers must be finite there, and
    /// what else the suite asks must hold.
    pub fn special(mut self, points: impl IntoIterator<Item = D::V>) -> Self {
        self.special.extend(points);
        self
    }

    /// The body is the union of parts, told apart by their features, and every part within reach is a
    /// hit, also where x is inside another. Then its distance is the least of them with its sign, and
    /// the foot of a hit lies on the part that is hit.
    pub fn union(self) -> Self {
        Self {
            union: true,
            ..self
        }
    }

    /// The shell is a picture that may be off the surface by so much (m).
    pub fn drawn_within(self, off: f64) -> Self {
        Self {
            drawn_within: off,
            ..self
        }
    }

    /// At `x` a grain of this reach has so many hits: for corners, gaps and edges.
    pub fn expects(mut self, x: D::V, reach: f64, hits: usize) -> Self {
        self.expected.push((x, reach, hits));
        self
    }
}

/// Panics with a listing unless the surface passes every check in the box `region` (two corners in m).
#[track_caller]
pub fn conforms<D: Dim>(
    surface: &dyn Surface<D>,
    region: [D::V; 2],
    options: &Options<'_, D>,
) -> Report {
    let report = examine(surface, region, options);
    assert!(report.breaches.is_empty(), "{report}");
    report
}

/// Every check that the surface fails, with the worst point of each.
pub fn examine<D: Dim>(
    surface: &dyn Surface<D>,
    region: [D::V; 2],
    options: &Options<'_, D>,
) -> Report {
    let trial = points::Trial::new(surface, region, options);
    let checks = [
        checks::finite(&trial),
        checks::within_reach(&trial),
        checks::found(&trial),
        checks::batch(&trial),
        checks::lipschitz(&trial),
        checks::bound(&trial),
        checks::room(&trial),
        checks::sign(&trial),
        checks::gradient(&trial),
        checks::foot(&trial),
        checks::expected(&trial),
        checks::drawing(&trial),
    ];
    Report::of(trial.points.len(), checks)
}
