//! Several materials: one value of a law for each pair of them.

use tsubu_model::{ContactLaw, Dim, Kind, Linear, Push, SpinState, Touch};

/// A law that holds a value for each pair of materials; the law itself knows of one pair only.
///
/// The rows are the materials of grains, the columns those of their partners: as many for grains among themselves, one for a wall.
/// [`Kind::material`](tsubu_model::Kind::material) says which row and column. In the loop nothing is looked up that
/// several kinds of one material would not look up too.
///
/// Source: a choice of layout; what two materials make of each other is in the values.
///
/// ```
/// use tsubu_contact::{PerPair, SpringDashpot};
/// use tsubu_model::{ContactLaw, Kind, Space, Spins};
/// let law = |friction| SpringDashpot::new(1.0e3, 0.4e3, 0.1, 0.06, friction);
/// // Friction 0.5 between glass, 0.3 between glass and rubber, 0.9 between rubber.
/// let laws = PerPair::table(vec![law(0.5), law(0.3), law(0.3), law(0.9)], 2);
/// let bead = Kind::sphere(2.0e-3, 2500.0);
/// let pair = ContactLaw::<Space, Spins>::pair(&laws, &bead, &bead.of(1));
/// assert_eq!(pair.friction, 0.3);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PerPair<L> {
    laws: Vec<L>,
    columns: usize,
}

impl<L> PerPair<L> {
    /// One material.
    pub fn one(law: L) -> Self {
        Self {
            laws: vec![law],
            columns: 1,
        }
    }

    /// Row by row, with so many columns.
    ///
    /// # Panics
    /// If there is no column, or the last row is not whole.
    pub fn table(laws: Vec<L>, columns: usize) -> Self {
        assert!(
            columns > 0 && !laws.is_empty() && laws.len().is_multiple_of(columns),
            "a table has whole rows"
        );
        Self { laws, columns }
    }

    /// All values, row by row.
    pub fn laws(&self) -> &[L] {
        &self.laws
    }

    /// The same table with each value changed.
    pub fn map<M>(&self, change: impl FnMut(&L) -> M) -> PerPair<M> {
        PerPair {
            laws: self.laws.iter().map(change).collect(),
            columns: self.columns,
        }
    }

    /// The value for a grain of one material against a partner of another.
    fn of(&self, a: &Kind, b: &Kind) -> &L {
        &self.laws[a.material * self.columns + b.material]
    }
}

impl<D: Dim, S: SpinState, L: ContactLaw<D, S>> ContactLaw<D, S> for PerPair<L> {
    type Pair = L::Pair;
    type Memory = L::Memory;
    const ROLLS: bool = L::ROLLS;

    fn pair(&self, a: &Kind, b: &Kind) -> L::Pair {
        self.of(a, b).pair(a, b)
    }

    fn range(pair: &L::Pair) -> f64 {
        L::range(pair)
    }

    #[inline(always)]
    fn force(pair: &L::Pair, touch: &Touch<D, S>, memory: &mut L::Memory, dt: f64) -> Push<D, S> {
        L::force(pair, touch, memory, dt)
    }

    fn stored(pair: &L::Pair, touch: &Touch<D, S>, memory: &L::Memory) -> f64 {
        L::stored(pair, touch, memory)
    }

    fn linear(pair: &L::Pair, touch: &Touch<D, S>, dt: f64) -> Linear {
        L::linear(pair, touch, dt)
    }
}
