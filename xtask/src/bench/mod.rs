//! `cargo xtask bench`: the same grains, law and step in our engine and in others, in turns, as ratios.
//!
//! A figure is the median, over rounds, of our rate over the other's in the same round; its spread is the smallest and the
//! largest. Rates count steps only, without reading and setting up. Decks are those of `tsubu export`, so the physics is the
//! same to the last constant; every engine of them runs with the best of a few skins.

mod cases;
mod grains;
mod measure;
mod report;
mod yade;

use crate::peers::{Engine, Peer};
use cases::Case;
use measure::{Ours, Theirs};
use report::Row;
use std::path::Path;

/// What is asked for.
pub struct Wish {
    /// Engines to hold ours against.
    pub against: Vec<Engine>,
    /// Rounds of each pair.
    pub rounds: usize,
    /// Largest number of grains.
    pub most: usize,
    /// Names of scenes; empty for all.
    pub scenes: Vec<String>,
}

/// Runs the side-by-side benches; true if something could be compared.
pub fn run(root: &Path, wish: &Wish) -> Result<bool, String> {
    let mut peers = Vec::new();
    for engine in &wish.against {
        match Peer::find(*engine) {
            Ok(peer) => peers.push(peer),
            Err(why) => println!("note: {why}"),
        }
    }
    let unknown_to_us = |name: &&String| !cases::SCENES.contains(&name.as_str());
    if let Some(unknown) = wish.scenes.iter().find(unknown_to_us) {
        let all = cases::SCENES.join(", ");
        return Err(format!(
            "there is no scene `{unknown}`; the scenes are {all}"
        ));
    }
    let asked = |name: &&str| wish.scenes.is_empty() || wish.scenes.iter().any(|s| s == name);
    let scenes: Vec<&str> = cases::SCENES.into_iter().filter(asked).collect();
    let cases = cases::of(root, &scenes, wish.most)?;
    let mut rows = Vec::new();
    for case in &cases {
        for threads in [1, 2] {
            if peers.is_empty() && threads == 2 && case.grains < 5000 {
                continue;
            }
            rows.extend(side_by_side(root, case, threads, &peers, wish.rounds)?);
        }
    }
    report::write(root, &rows)?;
    Ok(!rows.is_empty())
}

/// Ours against each peer that can say the scene, in turns.
fn side_by_side(
    root: &Path,
    case: &Case,
    threads: usize,
    peers: &[Peer],
    rounds: usize,
) -> Result<Vec<Row>, String> {
    eprintln!(
        "  {} ({}), {} grains, {threads} thread(s)",
        case.scene, case.law, case.grains
    );
    let mut ours = Ours::of(case, threads)?;
    let mut theirs = Vec::new();
    for peer in peers {
        match Theirs::of(root, case, threads, peer)? {
            Some(made) => theirs.push(made),
            None => eprintln!("    {} cannot say this scene", peer.engine.name()),
        }
    }
    let mut rates = vec![Vec::new(); theirs.len()];
    let mut own = Vec::new();
    for _ in 0..rounds {
        let rate = ours.rate()?;
        own.push(rate);
        for (other, rates) in theirs.iter().zip(&mut rates) {
            rates.push(other.rate()?);
        }
    }
    let mut rows = vec![Row::own(case, threads, &own)];
    for (other, rates) in theirs.iter().zip(&rates) {
        rows.push(Row::against(case, threads, other.engine(), &own, rates));
    }
    rows.iter().for_each(|row| println!("{}", row.words()));
    Ok(rows)
}
