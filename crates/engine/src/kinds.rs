//! One kind of grain or several, as a type: with one kind the loop reads no index and no table.

use tsubu_model::Kind;

/// The kinds of a scene.
pub trait KindSet: Send + Sync + 'static {
    /// True if the kind of a grain has to be looked up.
    const INDEXED: bool;
    /// All kinds.
    fn all(&self) -> &[Kind];
}

/// All grains are alike: no index is read.
#[derive(Clone, Copy, Debug)]
pub struct OneKind(pub [Kind; 1]);

/// Several kinds; each grain's line carries the number of its kind.
#[derive(Clone, Debug)]
pub struct ManyKinds(pub Vec<Kind>);

impl KindSet for OneKind {
    const INDEXED: bool = false;
    fn all(&self) -> &[Kind] {
        &self.0
    }
}

impl KindSet for ManyKinds {
    const INDEXED: bool = true;
    fn all(&self) -> &[Kind] {
        &self.0
    }
}

/// The kind of a line among `all`, read only if there are several.
#[inline(always)]
pub(crate) fn pick<K: KindSet, T>(all: &[T], kind: usize) -> &T {
    if K::INDEXED { &all[kind] } else { &all[0] }
}
