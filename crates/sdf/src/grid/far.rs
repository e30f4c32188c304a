//! Nodes beyond the band: bounds from the distance to the nodes beside the surface.

use super::nodes::Nodes;
use rayon::prelude::*;

/// Half the diagonal of a cell, in cells, √3/2 and a little for rounding: every point of the surface has a node this close.
const BESIDE: f64 = 0.8661;

/// For each node the square of its distance, in cells, from the nearest node beside the surface,
/// one whose distance is half a cell's diagonal at most;
/// z runs fastest, then x, then y. Source: Felzenszwalb2012.
pub(crate) fn squared_cells(nodes: &Nodes, distances: &[f32]) -> Vec<f32> {
    let [nx, ny, nz] = nodes.counts;
    let beside = (BESIDE * nodes.cell) as f32;
    let mut plane: Vec<f32> = distances
        .par_iter()
        .map(|&d| if d <= beside { 0.0 } else { f32::INFINITY })
        .collect();
    plane.par_chunks_mut(nx * ny).for_each(|slab| {
        let mut line = Line::default();
        for row in slab.chunks_exact_mut(nx) {
            line.transform(nx, |i| row[i]);
            row.copy_from_slice(&line.out);
        }
        for i in 0..nx {
            line.transform(ny, |j| slab[i + nx * j]);
            for j in 0..ny {
                slab[i + nx * j] = line.out[j];
            }
        }
    });
    let mut out = vec![0.0; plane.len()];
    out.par_chunks_mut(nz)
        .enumerate()
        .for_each_init(Line::default, |line, (column, out)| {
            line.transform(nz, |k| plane[column + nx * ny * k]);
            out.copy_from_slice(&line.out);
        });
    out
}

/// Puts bounds where the distance is infinite, and takes half the wall off everywhere.
///
/// A point of the surface closest to x has a node beside it, so the true distance D and the
/// distance E from the nearest such node differ by half a cell's diagonal at most: outside
/// D ≥ max(band, E − h√3/2), inside −D ≥ −(E + h√3/2).
pub(super) fn bounded(
    nodes: &Nodes,
    mut values: Vec<f32>,
    squared: &[f32],
    band: f64,
    half_wall: f64,
) -> Vec<f32> {
    let [nx, ny, nz] = nodes.counts;
    values
        .par_chunks_mut(nx * ny)
        .enumerate()
        .for_each(|(k, slab)| {
            for (column, value) in slab.iter_mut().enumerate() {
                if value.is_infinite() {
                    let cells = f64::from(squared[k + nz * column]).sqrt();
                    let bound = if *value > 0.0 {
                        // Rounding may not lift the bound.
                        band.max(nodes.cell * (cells * (1.0 - 1e-6) - BESIDE))
                    } else {
                        -nodes.cell * (cells * (1.0 + 1e-6) + BESIDE)
                    };
                    *value = bound as f32;
                }
                *value = (f64::from(*value) - half_wall) as f32;
            }
        });
    values
}

/// One line of the transform: the lowest of the parabolas f(q) + (p − q)² at each p.
#[derive(Default)]
struct Line {
    input: Vec<f64>,
    /// Where the parabolas of the lower envelope stand, and from where on each is the lowest.
    stands: Vec<usize>,
    from: Vec<f64>,
    out: Vec<f32>,
}

impl Line {
    fn transform(&mut self, count: usize, value: impl Fn(usize) -> f32) {
        self.input.clear();
        self.input.extend((0..count).map(|q| f64::from(value(q))));
        self.stands.clear();
        self.from.clear();
        for q in 0..count {
            if self.input[q].is_infinite() {
                continue;
            }
            let mut from = f64::NEG_INFINITY;
            while let (Some(&r), Some(&start)) = (self.stands.last(), self.from.last()) {
                let (a, b) = (q as f64, r as f64);
                from = (self.input[q] + a * a - self.input[r] - b * b) / (2.0 * (a - b));
                if from > start {
                    break;
                }
                self.stands.pop();
                self.from.pop();
                from = f64::NEG_INFINITY;
            }
            self.stands.push(q);
            self.from.push(from);
        }
        self.out.clear();
        let mut k = 0;
        for p in 0..count {
            while k + 1 < self.from.len() && self.from[k + 1] < p as f64 {
                k += 1;
            }
            self.out
                .push(self.stands.get(k).map_or(f32::INFINITY, |&q| {
                    let apart = p as f64 - q as f64;
                    (self.input[q] + apart * apart) as f32
                }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_transform_is_the_nearest_marked_node(counts in prop::array::uniform3(2usize..9), marked in prop::collection::vec(any::<prop::sample::Index>(), 1..6)) {
            let nodes = Nodes { low: DVec3::ZERO, cell: 1.0, counts };
            let mut distances = vec![9.0; nodes.count()];
            let marked: Vec<usize> = marked.iter().map(|m| m.index(nodes.count())).collect();
            for &m in &marked {
                distances[m] = 0.0;
            }
            let out = squared_cells(&nodes, &distances);
            for index in 0..nodes.count() {
                let [i, j, k] = nodes.coordinates(index);
                let least = marked.iter().map(|&m| (nodes.place(nodes.coordinates(m)) - nodes.place([i, j, k])).length_squared()).fold(f64::INFINITY, f64::min);
                prop_assert_eq!(f64::from(out[k + counts[2] * (i + counts[0] * j)]), least);
            }
        }
    }
}
