//! Momentum of the grains and the force they exert on all bodies.

use crate::conveying::over;
use crate::free::free;
use tsubu_model::{Damaged, Dim, Observer, Reading, Saved, SpinState, Vector, View, Words};

/// Forces and momentum as a whole.
///
/// Rows: `momentum_x`, `momentum_z` (kg m/s) of the grains; `force_on_bodies_x`, `force_on_bodies_z` (N), the sum over the
/// bodies that stand; `support` = (force on bodies along gravity)/(weight of the grains), which is 1 for grains
/// at rest and on average over any time between two states of rest; NaN without gravity or weight.
///
/// Grains that no force moves (infinite mass: a fixed row, driven grains) have neither momentum nor weight here. They are no bodies either:
/// what lies on them is not in `support`, which is then the share that the bodies carry, 0 for a bed on a fixed row.
/// Not told apart: the force of such a grain that itself presses into a body is in the force on that body.
///
/// Two grains of weight 3 N on a floor that feels 6 N: `support` = 1.
#[derive(Clone, Debug, Default)]
pub struct Balance {
    support: Option<f64>,
}

impl Balance {
    /// An observer that has not looked yet.
    pub fn new() -> Self {
        Self::default()
    }
}

impl Saved for Balance {
    fn save(&self, words: &mut Words) {
        words.put_part("balance");
        words.put_maybe(self.support);
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("balance")?;
        self.support = words.take_maybe()?;
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Balance {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let mut momentum = D::V::ZERO;
        let mut weight = 0.0;
        let gravity = view.gravity();
        for i in free(view) {
            momentum += view.velocity(i) * view.kind(i).mass;
            weight += view.kind(i).weight * gravity.length();
        }
        let force = view
            .bodies()
            .iter()
            .filter(|body| body.removed_at.is_none())
            .fold(D::V::ZERO, |sum, body| sum + body.force);
        let support = over(force.dot(gravity), gravity.length() * weight);
        self.support = Some(support);
        let (momentum, force) = (D::to_space(momentum), D::to_space(force));
        vec![
            Reading::new("momentum_x", momentum.x, "kg m/s"),
            Reading::new("momentum_z", momentum.z, "kg m/s"),
            Reading::new("force_on_bodies_x", force.x, "N"),
            Reading::new("force_on_bodies_z", force.z, "N"),
            Reading::new("support", support, "1"),
        ]
    }

    fn report(&self) -> Vec<Reading> {
        self.support
            .iter()
            .map(|support| Reading::new("support", *support, "1"))
            .collect()
    }
}
