//! What the machine can do at most: numbers streamed and multiplied, by one thread and by two.
//! Run with `cargo bench -p tsubu-benches --bench roofline`, before or after the scenes that are held against it.

use std::hint::black_box;
use std::time::Instant;

/// Rounds of each measurement; the fastest counts, since others use the machine too.
const ROUNDS: usize = 7;

fn main() {
    for threads in [1, 2] {
        let rate = best(threads, || multiply_add(20_000_000));
        println!("multiply-add, {threads} threads: {rate:.2} thousand million a second");
    }
    for megabytes in [1, 4, 16, 64, 256] {
        for threads in [1, 2] {
            let many = megabytes * (1 << 20) / 8 / threads;
            let rate = best(threads, || stream(many));
            println!(
                "update of {megabytes} MB, {threads} threads: {rate:.1} thousand million bytes a second each way"
            );
        }
    }
}

/// The most of `ROUNDS` rounds, in thousand million a second over all threads: `work` says how many it did in how many seconds.
fn best(threads: usize, work: impl Fn() -> (f64, f64) + Sync) -> f64 {
    let round = || {
        std::thread::scope(|scope| {
            let all: Vec<_> = (0..threads).map(|_| scope.spawn(&work)).collect();
            let done = all.into_iter().filter_map(|thread| thread.join().ok());
            done.map(|(many, seconds)| many / seconds / 1e9)
                .sum::<f64>()
        })
    };
    (0..ROUNDS).map(|_| round()).fold(0.0, f64::max)
}

/// Sixteen independent chains of a multiplication and an addition.
fn multiply_add(times: usize) -> (f64, f64) {
    let mut chains: [f64; 16] = std::array::from_fn(|k| 1.0 + 0.01 * k as f64);
    let (factor, term) = (black_box(0.999_999), black_box(1e-6));
    let start = Instant::now();
    for _ in 0..times {
        for chain in &mut chains {
            *chain = *chain * factor + term;
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    black_box(chains);
    ((chains.len() * times) as f64, seconds)
}

/// Numbers read, changed and written, all of them several times.
fn stream(many: usize) -> (f64, f64) {
    let mut numbers = vec![1.0f64; many];
    let times = (1 << 27) / many + 1;
    let start = Instant::now();
    for _ in 0..times {
        for number in &mut numbers {
            *number += 1.0;
        }
        black_box(&mut numbers);
    }
    ((8 * many * times) as f64, start.elapsed().as_secs_f64())
}
