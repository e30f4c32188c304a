//! Times the engine alone on a packing: `cargo run -p tsubu-engine --example packing -- packing.csv 400 [threads] [portable|avx2|avx512]`.

use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_engine::{Body, Lanes, NoTally, OneKind, Placed, Setup, TouchesAt, World};
use tsubu_integrate::Scheme;
use tsubu_model::{Domain, Kind, Motion, Space, Still, View};
use tsubu_sdf::HalfSpace;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&args[1]).unwrap();
    let steps: u64 = args[2].parse().unwrap();
    let threads: usize = args.get(3).map_or(1, |t| t.parse().unwrap());
    let lanes = args.get(4).map_or(Lanes::best(), |l| {
        Lanes::ALL.into_iter().find(|x| x.name() == l).unwrap()
    });
    let grains = text
        .lines()
        .skip(1)
        .map(|l| {
            let c: Vec<f64> = l.split(',').map(|x| x.parse().unwrap()).collect();
            Placed {
                position: DVec3::new(c[0], c[1], c[2]),
                velocity: DVec3::ZERO,
                kind: 0,
            }
        })
        .collect();
    let law = Repulsion::new(9.434e-5, 1.203e-3, 3.975e-3, 3.975e-3, 1.35e-3);
    let pool = (threads > 1).then(|| {
        Arc::new(
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap(),
        )
    });
    let mut world: World<Space, Still, OneKind, Repulsion, RepulsiveWall, NoTally> =
        World::new(Setup {
            kinds: OneKind([Kind::with_mass(1.35e-3, 1.7649e-6)]),
            law,
            bodies: vec![Body {
                name: "floor".into(),
                surface: Arc::new(HalfSpace::new(DVec3::ZERO, DVec3::Z)),
                law: RepulsiveWall {
                    grains: law,
                    restitution: None,
                    friction: 0.0,
                },
                touches_at: TouchesAt::Centre,
                removed_at: None,
                motion: Motion::default(),
                waits: false,
            }],
            domain: Domain {
                period: DVec3::new(5.832e-2, 5.832e-2, f64::INFINITY),
            },
            gravity: DVec3::new(0.0, 0.0, -9.80665),
            scheme: Scheme::SymplecticEuler,
            dt: 4.8e-6,
            skin: std::env::var("SKIN")
                .ok()
                .map(|s| s.parse::<f64>().unwrap() * 1.35e-3),
            lanes,
            pool,
            grains,
            gates: Vec::new(),
        });
    world.advance(20);
    let start = std::time::Instant::now();
    world.advance(steps);
    let s = start.elapsed().as_secs_f64();
    println!(
        "{:?} {:.2} M grain-steps/s  {lanes:?} {threads} threads  kinetic {:.6e} J  builds {}  bytes/grain {:.1}",
        world.list_counts(),
        world.len() as f64 * steps as f64 / s / 1e6,
        world.energies().kinetic,
        world.list_builds(),
        world.bytes_per_grain()
    );
}
