//! What a step costs: laws, vector paths, mixtures, tally, direction of damping, schemes; and its parts: a list build, a query
//! of a grid of distances, the law alone.
//! Run with `cargo bench -p tsubu-benches`. Compare rows of one run, never times of two machines.

mod common;

use common::{alike, ball, bed, lone_bed, mixed_bed, repulsion, still_bed, turning_bed, wall};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tsubu_contact::{Repulsion, RepulsiveWall};
use tsubu_engine::{Lanes, NoTally, OneKind, Tally, WithTally, World};
use tsubu_integrate::Scheme;
use tsubu_model::{ContactLaw, HitBuffer, Space, Still, Surface};
use tsubu_neighbors::{CellGrid, ChunkList};

/// Cells of the bed on each axis.
const CELLS: usize = 12;

fn world<L: ContactLaw<Space, Still>, T: Tally>(
    law: L,
    scheme: Scheme,
) -> World<Space, Still, OneKind, L, RepulsiveWall, T> {
    common::world(CELLS, alike(), (law, wall()), Lanes::best(), scheme)
}

fn steps(c: &mut Criterion) {
    let law: Repulsion = repulsion();
    let mut group = c.benchmark_group("step");
    group.throughput(Throughput::Elements(bed(CELLS).0.len() as u64));
    for lanes in Lanes::ALL.into_iter().filter(|l| l.is_here()) {
        let mut still = still_bed(CELLS, lanes);
        group.bench_function(BenchmarkId::new("repulsion", lanes.name()), |b| {
            b.iter(|| still.advance(1))
        });
        let mut turning = turning_bed(CELLS, lanes);
        group.bench_function(BenchmarkId::new("springs", lanes.name()), |b| {
            b.iter(|| turning.advance(1))
        });
        let mut mixed = mixed_bed(CELLS, lanes);
        group.bench_function(BenchmarkId::new("two sizes", lanes.name()), |b| {
            b.iter(|| mixed.advance(1))
        });
    }
    let mut tallied = world::<_, WithTally>(law, Scheme::SymplecticEuler);
    group.bench_function("repulsion, energies tallied", |b| {
        b.iter(|| tallied.advance(1))
    });
    let mut directed = world::<_, NoTally>(law.per_direction(), Scheme::SymplecticEuler);
    group.bench_function("repulsion, damping per direction", |b| {
        b.iter(|| directed.advance(1))
    });
    for scheme in Scheme::ALL {
        let mut run = world::<_, NoTally>(law, scheme);
        group.bench_function(BenchmarkId::new("scheme", scheme.name()), |b| {
            b.iter(|| run.advance(1))
        });
    }
    group.finish();
}

fn parts(c: &mut Criterion) {
    let (grains, domain) = lone_bed(CELLS);
    let cut = 1.05 * common::COKE.0;
    let mut group = c.benchmark_group("part");
    group.throughput(Throughput::Elements(grains.len() as u64));
    group.bench_function("cells and lists", |b| {
        let mut list = ChunkList::default();
        b.iter(|| {
            let grid = CellGrid::new(&domain, grains.len(), |i| grains[i], cut);
            let at = |i: usize| grains[grid.order[i] as usize];
            let all = 0..grains.len();
            list.build(&grid, &domain, all, at, cut, grains.len() as u32);
            list.entries()
        });
    });
    let (grid, points, reach) = ball();
    let mut hits = HitBuffer::<Space>::default();
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("query of a grid of distances", |b| {
        b.iter(|| {
            hits.hits.clear();
            grid.hits(&points, &reach, &mut hits);
            hits.hits.len()
        })
    });
    group.throughput(Throughput::Elements(common::law() as u64));
    group.bench_function("law SpringDashpot", |b| b.iter(common::law));
    group.finish();
}

criterion_group!(benches, steps, parts);
criterion_main!(benches);
