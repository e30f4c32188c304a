//! The words alone: a contact law written against `tsubu-model` and nothing else.
//! Run it with `cargo run -p tsubu-model --example own_law`.

use glam::DVec3;
use tsubu_model::{ContactLaw, Dim, Kind, Linear, Push, Space, SpinState, Still, Touch};

/// A linear spring without damping: F = k (reach − r) n.
struct Spring {
    stiffness: f64,
}

impl<D: Dim, S: SpinState> ContactLaw<D, S> for Spring {
    /// Stiffness in N/m and range in m.
    type Pair = (f64, f64);
    type Memory = [f64; 0];

    fn pair(&self, a: &Kind, b: &Kind) -> (f64, f64) {
        (self.stiffness, a.radius + b.radius)
    }

    fn range(pair: &(f64, f64)) -> f64 {
        pair.1
    }

    fn force(pair: &(f64, f64), touch: &Touch<D, S>, _: &mut [f64; 0], _dt: f64) -> Push<D, S> {
        let overlap = (pair.1 - touch.r()).max(0.0);
        Push {
            elastic: touch.normal() * (pair.0 * overlap),
            ..Push::none()
        }
    }

    fn stored(pair: &(f64, f64), touch: &Touch<D, S>, _: &[f64; 0]) -> f64 {
        0.5 * pair.0 * (pair.1 - touch.r()).max(0.0).powi(2)
    }

    fn linear(pair: &(f64, f64), _: &Touch<D, S>, _dt: f64) -> Linear {
        Linear {
            normal_stiffness: pair.0,
            ..Linear::default()
        }
    }
}

fn main() {
    let bead = Kind::sphere(2.0e-3, 2500.0);
    let law = Spring { stiffness: 1.0e4 };
    let pair = <Spring as ContactLaw<Space, Still>>::pair(&law, &bead, &bead);
    println!(
        "a bead of {:.3e} kg, two of them pressed together",
        bead.mass
    );
    println!(
        "{:>12} {:>12} {:>12}",
        "overlap (µm)", "force (N)", "energy (J)"
    );
    for overlap in [0.0, 1.0, 2.0, 5.0, 10.0] {
        let apart = DVec3::X * (2.0e-3 - 1e-6 * overlap);
        let touch = Touch::<Space, Still> {
            apart,
            velocity: DVec3::ZERO,
            r2: apart.length_squared(),
            reach: 2.0e-3,
            spin: Default::default(),
            roll: Default::default(),
        };
        let push = Spring::force(&pair, &touch, &mut [], 1e-6);
        let energy = Spring::stored(&pair, &touch, &[]);
        println!(
            "{overlap:>12.1} {:>12.4e} {energy:>12.4e}",
            push.total().length()
        );
    }
}
