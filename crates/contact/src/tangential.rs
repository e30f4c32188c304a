//! What laws with tangential springs share.

use tsubu_model::{Dim, Kind, Vector};

/// An axial spring q = n × f of a contact whose normal is now n: what is left of it across n, with its former length.
/// The plane in which it lies turns with the contact. In a plane scene there is nothing to turn.
#[inline(always)]
pub(crate) fn carried<D: Dim>(spring: D::W, n: D::V) -> D::W {
    if <D::W as Vector>::AXES == 1 {
        return spring;
    }
    let across = D::across(spring, n);
    // The floor makes 0 of 0/0.
    let shortened = across.length_squared().max(f64::MIN_POSITIVE);
    across * (spring.length_squared() / shortened).sqrt()
}

/// What to multiply a vector of this length by, so that it does not exceed the limit.
#[inline(always)]
pub(crate) fn share(limit: f64, length: f64) -> f64 {
    (limit / length.max(f64::MIN_POSITIVE)).min(1.0)
}

/// True for the flat side of a wall: no radius, no mass that moves.
pub(crate) fn is_flat(kind: &Kind) -> bool {
    kind.radius == 0.0 && kind.mass.is_infinite()
}

/// Radius of a partner as far as it counts for the range: a wall is the grain's mirror, a fixed grain keeps its own radius.
pub(crate) fn mirrored(kind: &Kind, partner: &Kind) -> f64 {
    if is_flat(kind) {
        partner.radius
    } else {
        kind.radius
    }
}
