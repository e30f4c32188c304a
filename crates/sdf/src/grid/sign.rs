//! Which nodes are inside: one winding number for each region that the surface does not cut.

use super::nodes::Nodes;
use crate::winding::Winding;
use rayon::prelude::*;
use std::ops::Range;

/// Makes the distances of inner nodes negative.
///
/// The ball around a node that reaches to the surface holds no surface. Where the balls of two
/// neighbours meet, the edge between them is free of it, so both are on the same side. Regions grow
/// over such edges; the winding number of a closed mesh is constant on each, and is asked
/// at the node furthest from the surface, where its approximation is best. A leak is not possible.
pub(super) fn give_signs(nodes: &Nodes, values: &mut [f32], winding: &Winding) {
    // Rounding to f32 must not join two sides.
    let least = (nodes.cell * (1.0 + 1e-5)) as f32;
    let mut order: Vec<u32> = Vec::with_capacity(values.len());
    let mut known = vec![false; values.len()];
    let mut regions: Vec<(Range<usize>, u32)> = Vec::new();
    for start in 0..values.len() {
        if known[start] {
            continue;
        }
        known[start] = true;
        let (first, mut next, mut furthest) = (order.len(), order.len(), start);
        order.push(start as u32);
        while next < order.len() {
            let here = order[next] as usize;
            next += 1;
            if values[here] > values[furthest] {
                furthest = here;
            }
            each_neighbour(nodes, here, |there| {
                if !known[there] && values[here] + values[there] > least {
                    known[there] = true;
                    order.push(there as u32);
                }
            });
        }
        regions.push((first..order.len(), furthest as u32));
    }
    // The corner of the grid lies outside: its region is the first and needs no asking.
    let inside: Vec<bool> = regions
        .par_iter()
        .enumerate()
        .map(|(r, (_, node))| {
            r > 0 && winding.inside(nodes.place(nodes.coordinates(*node as usize)))
        })
        .collect();
    for ((range, _), _) in regions
        .into_iter()
        .zip(inside)
        .filter(|(_, inside)| *inside)
    {
        for &node in &order[range] {
            values[node as usize] = -values[node as usize];
        }
    }
}

fn each_neighbour(nodes: &Nodes, index: usize, mut visit: impl FnMut(usize)) {
    let at = nodes.coordinates(index);
    let [nx, ny, _] = nodes.counts;
    for (axis, step) in [1, nx, nx * ny].into_iter().enumerate() {
        if at[axis] > 0 {
            visit(index - step);
        }
        if at[axis] + 1 < nodes.counts[axis] {
            visit(index + step);
        }
    }
}
