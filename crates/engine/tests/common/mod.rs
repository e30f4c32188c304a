//! What the tests of bodies share: soft coke, motions, threads.
#![allow(dead_code)] // each test takes what it needs

use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::Repulsion;
use tsubu_engine::Placed;
use tsubu_model::{Course, Motion, Shift, Space, Span, Turn};

/// Diameter of a grain in m.
pub const D: f64 = 1.35e-3;
/// A step of which some 600 fit into a contact.
pub const FINE: f64 = 2.5e-8;
/// A step of which some ten fit into a contact.
pub const USUAL: f64 = 1.5e-6;

pub fn law() -> Repulsion {
    Repulsion::from_young_modulus(3.1e7, Repulsion::sigma_for_diameter(D), 0.0126, 0.0126, D)
}

pub fn at(position: DVec3, velocity: DVec3) -> Placed<Space> {
    Placed {
        position,
        velocity,
        kind: 0,
    }
}

pub fn steady(velocity: DVec3) -> Motion {
    Motion {
        turn: None,
        shifts: vec![Shift {
            direction: velocity.normalize(),
            course: Course::Steady(velocity.length()),
            span: Span::ALWAYS,
        }],
    }
}

/// About an axis along y.
pub fn turning(point: DVec3, rate: f64) -> Motion {
    Motion {
        turn: Some(Turn {
            point,
            axis: DVec3::Y,
            rate,
            span: Span::ALWAYS,
        }),
        shifts: Vec::new(),
    }
}

/// None for one thread.
pub fn pool(threads: usize) -> Option<Arc<rayon::ThreadPool>> {
    (threads > 1).then(|| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        Arc::new(pool.unwrap())
    })
}

/// Whether the program that runs this holds a name, of a symbol or in its tables of lines. The name is written with a star
/// in it, so that it is not there for being asked.
pub fn program_holds(name: &str) -> bool {
    let program = std::env::current_exe().and_then(std::fs::read).unwrap();
    let name = name.replace('*', "").into_bytes();
    program.windows(name.len()).any(|word| word == name)
}
