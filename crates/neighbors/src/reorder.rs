//! Putting per-grain arrays into the sorted order in place.

/// Applies `order[new] = old` to arrays by following cycles: no second copy of the grains.
#[derive(Default)]
pub struct Reorder {
    done: Vec<bool>,
}

impl Reorder {
    /// Moves `items` so that the new `items[k]` is the old `items[order[k]]`.
    pub fn apply<T>(&mut self, order: &[u32], items: &mut [T]) {
        self.done.clear();
        self.done.resize(order.len(), false);
        for start in 0..order.len() {
            if self.done[start] {
                continue;
            }
            let mut here = start;
            loop {
                self.done[here] = true;
                let from = order[here] as usize;
                if from == start {
                    break;
                }
                items.swap(here, from);
                here = from;
            }
        }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.done.capacity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn reorders_like_a_gather(order in Just((0..50u32).collect::<Vec<_>>()).prop_shuffle()) {
            let mut items: Vec<u32> = (100..150).collect();
            let expected: Vec<u32> = order.iter().map(|&o| items[o as usize]).collect();
            Reorder::default().apply(&order, &mut items);
            prop_assert_eq!(items, expected);
        }
    }
}
