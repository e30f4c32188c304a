//! Meshes and random numbers for tests.

use super::Mesh;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A small generator: tests need the same numbers on every run, not good ones.
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// Between 0 and 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Each coordinate between −1 and 1.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - DVec3::ONE
    }

    /// A point of the box.
    pub fn within(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        low + (self.vector() + DVec3::ONE) * 0.5 * (high - low)
    }
}

/// A surface over a grid of `m` × `n` parameters; equal points are one vertex.
pub(crate) fn sheet(m: usize, n: usize, at: impl Fn(usize, usize) -> DVec3) -> Mesh {
    let mut soup = Vec::new();
    for i in 0..m {
        for j in 0..n {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            soup.push([a, b, c]);
            soup.push([a, c, d]);
        }
    }
    let mut mesh = Mesh::from_soup(&soup, Vec::new()).unwrap();
    mesh.weld(1e-9);
    mesh
}

/// A sphere of `n` strips around the origin.
pub(crate) fn ball(radius: f64, n: usize) -> Mesh {
    sheet(n, 2 * n, |i, j| {
        let (theta, phi) = (
            PI * i as f64 / n as f64,
            TAU * (j % (2 * n)) as f64 / (2 * n) as f64,
        );
        radius
            * DVec3::new(
                theta.sin() * phi.cos(),
                theta.sin() * phi.sin(),
                theta.cos(),
            )
    })
}

/// A torus around z.
pub(crate) fn torus(major: f64, minor: f64, n: usize) -> Mesh {
    sheet(n, n, |i, j| {
        let (u, v) = (
            TAU * (i % n) as f64 / n as f64,
            TAU * (j % n) as f64 / n as f64,
        );
        let r = major + minor * v.cos();
        DVec3::new(r * u.cos(), r * u.sin(), minor * v.sin())
    })
}

/// A box around the origin, each face of n × n squares.
pub(crate) fn cuboid(size: DVec3, n: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let face = sheet(n, n, |i, j| {
                let mut x = DVec3::ZERO;
                let (s, t) = (i as f64 / n as f64 - 0.5, j as f64 / n as f64 - 0.5);
                x[axis] = 0.5 * side;
                x[(axis + 1) % 3] = s * side;
                x[(axis + 2) % 3] = t;
                x * size
            });
            append(&mut mesh, &face);
        }
    }
    mesh.weld(1e-9 * size.min_element());
    mesh
}

/// A strip with one half turn.
pub(crate) fn moebius(n: usize) -> Mesh {
    sheet(n, 1, |i, j| {
        let (u, s) = (
            TAU * (i % n) as f64 / n as f64,
            if i == n { 1 - j } else { j },
        );
        let w = 0.2 * (s as f64 - 0.5);
        let r = 1.0 + w * (0.5 * u).cos();
        DVec3::new(r * u.cos(), r * u.sin(), w * (0.5 * u).sin())
    })
}

/// Adds the other mesh's triangles.
pub(crate) fn append(mesh: &mut Mesh, other: &Mesh) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(&other.vertices);
    mesh.triangles
        .extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
}

/// The mesh moved.
pub(crate) fn moved(mut mesh: Mesh, by: DVec3) -> Mesh {
    mesh.vertices.iter_mut().for_each(|v| *v += by);
    mesh
}

/// Every hundredth or so of the triangles taken out, by a fixed random choice.
pub(crate) fn with_holes(mut mesh: Mesh, share: f64) -> Mesh {
    let mut random = Random::new(11);
    mesh.triangles.retain(|_| random.unit() >= share);
    mesh
}
