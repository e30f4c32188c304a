//! Single pairs of grains, for what is not the force loop: energies, touching pairs, the linear solve, the modes.

use crate::kinds::KindSet;
use crate::line::{Layout, Line, has_second_line};
use crate::world::{Tally, World};
use tsubu_model::{ContactLaw, Domain, SpinState, Touch, Vector};

/// All grains, and the constants of their pairs.
pub(crate) struct Pairs<'a, D: Layout, P> {
    pub lines: &'a [Line],
    pub spins: &'a [Line],
    pub pairs: &'a [P],
    pub kinds: usize,
    pub domain: &'a Domain<D>,
}

impl<'a, D: Layout, P> Pairs<'a, D, P> {
    /// The contact of grains `i` and `j` and the constants of their pair.
    pub fn touch<S: SpinState, K: KindSet>(&self, i: usize, j: usize) -> (&'a P, Touch<D, S>) {
        let (a, b) = (&self.lines[i], &self.lines[j]);
        let apart = self.domain.nearest(a.position::<D>() - b.position::<D>());
        let spin = |k: usize, line: &Line| {
            let with = if const { has_second_line::<D, S>() } {
                &self.spins[k]
            } else {
                line
            };
            with.spin::<D, S>()
        };
        let (of_a, of_b) = (spin(i, a), spin(j, b));
        let touch = Touch {
            apart,
            velocity: a.velocity::<D>() - b.velocity::<D>(),
            r2: apart.length_squared(),
            reach: a.0[D::RADIUS] + b.0[D::RADIUS],
            spin: of_a * a.0[D::RADIUS] + of_b * b.0[D::RADIUS],
            roll: of_a - of_b,
        };
        let pair = if K::INDEXED {
            &self.pairs[a.kind::<D>() * self.kinds + b.kind::<D>()]
        } else {
            &self.pairs[0]
        };
        (pair, touch)
    }
}

impl<D, S, K, L, W, T> World<D, S, K, L, W, T>
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    W: ContactLaw<D, S>,
    T: Tally,
{
    pub(crate) fn pairs(&self) -> Pairs<'_, D, L::Pair> {
        Pairs {
            lines: &self.lines,
            spins: &self.spins,
            pairs: &self.pairs,
            kinds: self.kinds.all().len(),
            domain: &self.domain,
        }
    }
}
