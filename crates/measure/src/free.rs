//! Which grains forces move.

use tsubu_model::{Dim, Kind, SpinState, View};

/// False for a grain of infinite mass, such as the fixed row under a bed or a driven grain: it has no momentum, energy
/// or weight to measure.
pub(crate) fn is_free(kind: &Kind) -> bool {
    kind.mass.is_finite()
}

/// Indices of the grains that forces move, ascending.
pub(crate) fn free<D: Dim, S: SpinState>(view: &dyn View<D, S>) -> impl Iterator<Item = usize> {
    (0..view.len()).filter(move |&i| is_free(view.kind(i)))
}
