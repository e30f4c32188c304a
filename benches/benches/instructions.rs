//! How many instructions the parts of a step take, held against recorded counts: `cargo bench -p tsubu-benches --bench instructions`.
//!
//! Counted by `valgrind --tool=callgrind`, as the difference of a short and a long run of this program itself, so that
//! building the scene does not count. A count repeats where a time does not. Where valgrind is absent nothing is held;
//! it knows no AVX-512. A count that is meant to change is recorded anew in [`PARTS`].
//!
//! Every part is first run under `memcheck`: the fenced module reads by indices that it does not look at again, and this says
//! that none of them leads out of what is there.

mod common;

use std::process::{Command, ExitCode};
use tsubu_engine::Lanes;
use tsubu_model::{HitBuffer, Space, Surface, View};
use tsubu_neighbors::{CellGrid, ChunkList};

/// Name, and instructions for each grain and step (or build, or query).
const PARTS: [(&str, f64); 8] = [
    ("repulsion avx2", 374.8),
    ("repulsion portable", 772.8),
    ("mixture avx2", 757.3),
    ("springs avx2", 1317.4),
    ("springs portable", 2999.5),
    ("list build", 3150.6),
    ("sdf query", 281.8),
    ("law", 232.5),
];

/// By which share a count may differ from the recorded one.
const TOLERANCE: f64 = 0.05;

/// Short and long run.
const TIMES: [u64; 2] = [10, 30];

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().collect();
    if let [_, flag, name, times] = &args[..]
        && flag == "--part"
    {
        println!("{}", run(name, times.parse().unwrap_or(1)));
        return ExitCode::SUCCESS;
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("valgrind is not here: no count is held");
        return ExitCode::SUCCESS;
    }
    let mut holds = true;
    for (name, recorded) in PARTS {
        if name.ends_with("avx2") && !Lanes::Avx2.is_here() {
            println!("{name:20} skipped: this machine has no AVX2");
            continue;
        }
        if !is_clean(name) {
            println!("{name:20} reads or writes what is not there, or what was never written");
            holds = false;
        }
        let [short, long] = TIMES.map(|times| counted(name, times));
        let (counts, items) = (long.0 - short.0, short.1);
        let each = counts / (TIMES[1] - TIMES[0]) as f64 / items;
        let ratio = each / recorded;
        let fits = (ratio - 1.0).abs() <= TOLERANCE;
        holds &= fits;
        let word = if fits {
            ""
        } else {
            "  differs by more than 5 %"
        };
        println!("{name:20} {each:9.1} recorded {recorded:9.1} ratio {ratio:.3}{word}");
    }
    if holds {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Instructions of a run of this program that does a part so many times, and how many grains or queries that has.
fn counted(name: &str, times: u64) -> (f64, f64) {
    let program = std::env::current_exe().expect("this program has a path");
    let out = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["--part", name, &times.to_string()])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .expect("valgrind runs");
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    let count = said.lines().find_map(|line| line.split_once("Collected :"));
    let count = count.and_then(|(_, count)| count.trim().parse().ok());
    let items = String::from_utf8_lossy(&out.stdout).trim().parse().ok();
    match (count, items) {
        (Some(count), Some(items)) => (count, items),
        _ => panic!("valgrind counted nothing of {name}:\n{said}"),
    }
}

/// True if valgrind's memcheck finds no fault in a part.
fn is_clean(name: &str) -> bool {
    let program = std::env::current_exe().expect("this program has a path");
    let mut check = Command::new("valgrind");
    check.args(["--quiet", "--error-exitcode=9"]).arg(program);
    check
        .args(["--part", name, "2"])
        .env("RAYON_NUM_THREADS", "1");
    check.output().is_ok_and(|out| out.status.success())
}

/// Does a part so many times; how many grains or queries each time has.
fn run(name: &str, times: u64) -> usize {
    let lanes = if name.ends_with("avx2") {
        Lanes::Avx2
    } else {
        Lanes::Portable
    };
    match name.split_once(' ').map_or(name, |(first, _)| first) {
        "repulsion" => {
            let mut world = common::still_bed(6, lanes);
            world.advance(times);
            world.len()
        }
        "mixture" => {
            let mut world = common::mixed_bed(6, lanes);
            world.advance(times);
            world.len()
        }
        "springs" => {
            let mut world = common::turning_bed(6, lanes);
            world.advance(times);
            world.len()
        }
        "list" => (0..times).map(|_| build_lists()).max().unwrap_or(0),
        "sdf" => {
            let (grid, points, reach) = common::ball();
            let mut hits = HitBuffer::<Space>::default();
            for _ in 0..times {
                hits.hits.clear();
                grid.hits(&points, &reach, &mut hits);
            }
            assert!(hits.hits.len() > points.len() / 4);
            points.len()
        }
        _ => (0..times).map(|_| common::law()).max().unwrap_or(0),
    }
}

/// Cells and lists of a bed; how many grains it has.
fn build_lists() -> usize {
    let (grains, domain) = common::lone_bed(6);
    let cut = 1.05 * common::COKE.0;
    let grid = CellGrid::<Space>::new(&domain, grains.len(), |i| grains[i], cut);
    let sorted: Vec<_> = grid.order.iter().map(|&i| grains[i as usize]).collect();
    let mut list = ChunkList::default();
    list.build(
        &grid,
        &domain,
        0..sorted.len(),
        |i| sorted[i],
        cut,
        sorted.len() as u32,
    );
    assert!(list.entries() > 8 * sorted.len());
    sorted.len()
}
