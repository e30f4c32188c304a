//! What a step costs: vector paths, tally, direction of damping, schemes; and a list build.
//! Run with `cargo bench -p tsubu-benches`. Compare rows of one run, never times of two machines.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use std::sync::Arc;
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_engine::{
    Body, Lanes, NoTally, OneKind, Placed, Setup, Tally, TouchesAt, WithTally, World,
};
use tsubu_integrate::Scheme;
use tsubu_model::{ContactLaw, Domain, Kind, Motion, Space, Still};
use tsubu_neighbors::{CellGrid, ChunkList};
use tsubu_sdf::HalfSpace;

/// A face-centred cubic bed of paper A's coke, softened by 1000, every grain in touch with twelve:
/// the densest work a force loop can have.
fn bed(cells: usize) -> (Vec<Placed<Space>>, DVec3) {
    let side = 2f64.sqrt() * 1.350e-3 * 0.9999;
    let mut grains = Vec::new();
    for k in 0..2 * cells {
        for j in 0..2 * cells {
            for i in (0..2 * cells).filter(|i| (i + j + k) % 2 == 0) {
                let position = DVec3::new(i as f64, j as f64, k as f64 + 1.4) * (0.5 * side);
                grains.push(Placed {
                    position,
                    velocity: DVec3::ZERO,
                    kind: 0,
                });
            }
        }
    }
    let length = cells as f64 * side;
    (grains, DVec3::new(length, length, f64::INFINITY))
}

const COKE: (f64, f64, f64, f64) = (9.434e-5, 1.203e-3, 3.975e-3, 1.35e-3);

fn world<L: ContactLaw<Space, Still>, T: Tally>(
    law: L,
    lanes: Lanes,
    scheme: Scheme,
) -> World<Space, Still, OneKind, L, RepulsiveWall, T> {
    let (epsilon, sigma, gamma, diameter) = COKE;
    let (grains, period) = bed(12);
    World::new(Setup {
        kinds: OneKind([Kind::with_mass(diameter, 1.7649e-6)]),
        law,
        bodies: vec![Body {
            name: "floor".into(),
            surface: Arc::new(HalfSpace::new(DVec3::ZERO, DVec3::Z)),
            law: RepulsiveWall {
                grains: Repulsion::new(epsilon, sigma, gamma, gamma, diameter),
                restitution: Some(0.5),
                friction: 0.413,
            },
            touches_at: TouchesAt::Surface,
            removed_at: None,
            motion: Motion::default(),
            waits: false,
        }],
        domain: Domain { period },
        gravity: DVec3::new(0.0, 0.0, -9.80665),
        scheme,
        dt: 4.8e-6,
        skin: None,
        lanes,
        pool: None,
        grains,
        gates: Vec::new(),
    })
}

fn steps(c: &mut Criterion) {
    let (epsilon, sigma, gamma, diameter) = COKE;
    let law = Repulsion::new(epsilon, sigma, gamma, gamma, diameter);
    let mut group = c.benchmark_group("step");
    group.throughput(Throughput::Elements(bed(12).0.len() as u64));
    for lanes in Lanes::ALL.into_iter().filter(|l| l.is_here()) {
        let mut plain = world::<_, NoTally>(law, lanes, Scheme::SymplecticEuler);
        group.bench_function(BenchmarkId::new("repulsion", lanes.name()), |b| {
            b.iter(|| plain.advance(1))
        });
    }
    let mut tallied = world::<_, WithTally>(law, Lanes::best(), Scheme::SymplecticEuler);
    group.bench_function("repulsion, energies tallied", |b| {
        b.iter(|| tallied.advance(1))
    });
    let mut directed =
        world::<_, NoTally>(law.per_direction(), Lanes::best(), Scheme::SymplecticEuler);
    group.bench_function("repulsion, damping per direction", |b| {
        b.iter(|| directed.advance(1))
    });
    for scheme in Scheme::ALL {
        let mut run = world::<_, NoTally>(law, Lanes::best(), scheme);
        group.bench_function(BenchmarkId::new("scheme", scheme.name()), |b| {
            b.iter(|| run.advance(1))
        });
    }
    group.finish();
}

fn lists(c: &mut Criterion) {
    let (grains, period) = bed(12);
    let domain = Domain::<Space> { period };
    let at = |i: usize| domain.wrap(grains[i].position);
    let cut = 1.05 * 1.35e-3;
    let mut group = c.benchmark_group("list");
    group.throughput(Throughput::Elements(grains.len() as u64));
    group.bench_function("cells and lists", |b| {
        let mut list = ChunkList::default();
        b.iter(|| {
            let grid = CellGrid::new(&domain, grains.len(), at, cut);
            list.build(
                &grid,
                &domain,
                0..grains.len(),
                |i| at(grid.order[i] as usize),
                cut,
                grains.len() as u32,
            );
            list.entries()
        });
    });
    group.finish();
}

criterion_group!(benches, steps, lists);
criterion_main!(benches);
