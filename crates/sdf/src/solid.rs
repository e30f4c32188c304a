//! What exact shapes share: the feet of a point on their surface, and which of them are hits.

use std::fmt;
use tsubu_model::{Dim, HitBuffer};

/// A body whose distance is known exactly everywhere, inside and outside.
///
/// A *foot* of a point x is a place y of the surface where |x − y| is locally least. Its distance is
/// positive if x lies on the outer side of the surface there.
/// What [`Surface::hits`](tsubu_model::Surface::hits) makes of them:
/// - x outside the body: every foot that x is on the outer side of, so that a grain in a concave
///   corner is held by both walls;
/// - x inside: the nearest foot only, because the way out of a thin wall is the short one, and pushes
///   from both of its faces would fight each other.
pub trait Solid<D: Dim>: Send + Sync {
    /// Signed distance of `x` from the surface in m, negative inside.
    fn distance(&self, x: D::V) -> f64;
    /// Appends the feet of `x`, the nearest one always among them; `of` is the number of the point.
    fn feet(&self, x: D::V, of: u32, out: &mut HitBuffer<D>);
}

/// Why numbers make no body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misshapen(String);

impl fmt::Display for Misshapen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Misshapen {}

/// An error that says `what`, unless it holds.
pub(crate) fn demand(holds: bool, what: impl FnOnce() -> String) -> Result<(), Misshapen> {
    if holds {
        Ok(())
    } else {
        Err(Misshapen(what()))
    }
}

/// A length that is finite and positive.
pub(crate) fn demand_length(name: &str, length: f64) -> Result<(), Misshapen> {
    demand(length > 0.0 && length.is_finite(), || {
        format!("the {name} must be a positive length, not {length} m")
    })
}

/// The hits of a solid, from its feet.
pub(crate) fn hits_of<D: Dim, S: Solid<D> + ?Sized>(
    solid: &S,
    x: &[D::V],
    reach: &[f64],
    out: &mut HitBuffer<D>,
) {
    for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
        let start = out.hits.len();
        solid.feet(x, of as u32, out);
        keep_hits(start, reach, out);
    }
}

/// Of the feet from `start` on keeps those that are hits within `reach`.
pub(crate) fn keep_hits<D: Dim>(start: usize, reach: f64, out: &mut HitBuffer<D>) {
    let feet = &out.hits[start..];
    let nearest =
        (0..feet.len()).min_by(|&a, &b| feet[a].distance.abs().total_cmp(&feet[b].distance.abs()));
    let Some(nearest) = nearest else { return };
    let inside = feet[nearest].distance < 0.0;
    let mut kept = start;
    for number in start..out.hits.len() {
        let foot = out.hits[number];
        let right_side = if inside {
            number - start == nearest
        } else {
            foot.distance >= 0.0
        };
        if right_side && foot.distance < reach {
            out.hits[kept] = foot;
            kept += 1;
        }
    }
    out.hits.truncate(kept);
}
