//! The start of a river bed: a fixed row, and above it a lattice with vacancies that falls on it.

use glam::DVec3;
use std::f64::consts::TAU;
use tsubu_engine::Placed;
use tsubu_model::{Dim, Domain, Vector, uniform};
use tsubu_scene::{Bed, Population};

/// Where what a seed gives is used; events of one identity differ.
const HEIGHT: u64 = 0;
const VACANT: u64 = 2;
const JITTER: u64 = 3;
const SIZE: u64 = 6;

/// Grains of a bed, the fixed ones last: they are of the last kind, the others of the kinds of `populations` in their order, or
/// of kind 0.
///
/// The fixed row lies at z = 0 with heights of standard deviation `roughness` d. The lattice above has the distance
/// `spacing` d and begins clear of the highest fixed grain; every site is shifted at random within its slack, so that no
/// column stands on end. Of a mixture each site takes a population at random, in proportion to the numbers share/(ρ d³).
pub(crate) fn bed<D: Dim>(
    bed: &Bed,
    diameter: f64,
    populations: &[Population],
    domain: &Domain<D>,
) -> Vec<Placed<D>> {
    let columns = |axis: usize| columns(bed, diameter, domain.period.axis(axis));
    let (nx, dx) = columns(0);
    let (ny, dy) = if D::V::AXES == 3 {
        columns(1)
    } else {
        (1, 0.0)
    };
    let site = |ix: usize, iy: usize| {
        let y = if dy > 0.0 {
            (iy as f64 + 0.5) * dy
        } else {
            0.0
        };
        DVec3::new((ix as f64 + 0.5) * dx, y, 0.0)
    };
    let at = |place: DVec3, kind: usize| Placed {
        position: domain.wrap(D::from_space(place)),
        velocity: D::V::ZERO,
        kind,
    };
    let row: Vec<DVec3> = (0..nx * ny)
        .map(|k| {
            let height = bed.roughness * diameter * normal(bed.seed, k as u64);
            site(k % nx, k / nx) + DVec3::Z * height
        })
        .collect();
    let top = row.iter().map(|x| x.z).fold(0.0, f64::max);
    let slack = 0.5 * (bed.spacing - 1.0) * diameter;
    let mut grains = Vec::new();
    for layer in 0..bed.layers {
        for k in 0..nx * ny {
            let whose = ((layer + 1) * nx * ny + k) as u64;
            let draw = |event: u64| uniform(bed.seed, whose, event);
            if draw(VACANT) < bed.vacancies {
                continue;
            }
            let shift = DVec3::new(
                2.0 * draw(JITTER) - 1.0,
                if dy > 0.0 {
                    2.0 * draw(JITTER + 1) - 1.0
                } else {
                    0.0
                },
                2.0 * draw(JITTER + 2) - 1.0,
            );
            let height = top + (layer as f64 + 1.0) * bed.spacing * diameter;
            // Half of the slack each, so that two neighbours stay clear.
            let place = site(k % nx, k / nx) + DVec3::Z * height + shift * (0.5 * slack);
            grains.push(at(place, pick(populations, draw(SIZE))));
        }
    }
    grains.extend(row.into_iter().map(|x| at(x, populations.len().max(1))));
    grains
}

/// Columns along a period, and their distance.
fn columns(bed: &Bed, diameter: f64, period: f64) -> (usize, f64) {
    let count = (period / (bed.spacing * diameter)).floor().max(1.0);
    (count as usize, period / count)
}

/// How many sites a bed has, the fixed row included.
pub(crate) fn sites<D: Dim>(bed: &Bed, diameter: f64, domain: &Domain<D>) -> f64 {
    let level = D::V::AXES - 1;
    let columns = |axis: usize| columns(bed, diameter, domain.period.axis(axis)).0 as f64;
    (0..level).map(columns).product::<f64>() * (bed.layers as f64 + 1.0)
}

/// A population by a number in [0, 1).
fn pick(populations: &[Population], draw: f64) -> usize {
    let number = |one: &Population| one.share / (one.density * one.diameter.powi(3));
    let mut left = draw * populations.iter().map(number).sum::<f64>();
    for (k, one) in populations.iter().enumerate() {
        left -= number(one);
        if left < 0.0 {
            return k;
        }
    }
    populations.len().saturating_sub(1)
}

/// A normal deviate of mean 0 and variance 1, cut at three: a fixed grain further up would stand alone.
fn normal(seed: u64, whose: u64) -> f64 {
    let (a, b) = (
        uniform(seed, whose, HEIGHT),
        uniform(seed, whose, HEIGHT + 1),
    );
    ((-2.0 * (1.0 - a).ln()).sqrt() * (TAU * b).cos()).clamp(-3.0, 3.0)
}
