//! A grid as bytes, to be kept between runs. Whatever comes back is checked, not trusted.

use super::nodes::{MOST_NODES, Nodes};
use super::{DistanceGrid, GridError, GridOptions, build};
use crate::mesh::{MOST_FACETS, Mesh};
use glam::DVec3;

/// The first bytes of a stored grid.
const MAGIC: &[u8; 8] = b"tsubuSDF";
/// Raised whenever the bytes or the way of building change, so that old files are built again.
const VERSION: u64 = 1;

impl DistanceGrid {
    /// A number that is the same for the same mesh and options on every machine and run, to name a stored grid by.
    ///
    /// FNV-1a over the version, all vertices, triangles and options. Names of parts do not count.
    pub fn key(mesh: &Mesh, options: &GridOptions) -> u64 {
        let mut hash = Fnv::default();
        hash.add(&VERSION.to_le_bytes());
        for word in option_words(options) {
            hash.add(&word.to_le_bytes());
        }
        hash.add(&(mesh.vertices.len() as u64).to_le_bytes());
        for v in &mesh.vertices {
            for x in v.to_array() {
                hash.add(&x.to_bits().to_le_bytes());
            }
        }
        for v in mesh.triangles.iter().flatten() {
            hash.add(&v.to_le_bytes());
        }
        hash.0
    }

    /// The grid as bytes: magic, version, options, nodes, mesh, values, checksum; little endian.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mesh = &self.mesh;
        let mut out = Vec::with_capacity(
            256 + 24 * mesh.vertices.len() + 12 * mesh.triangles.len() + 4 * self.values.len(),
        );
        out.extend(MAGIC);
        let mut word = |x: u64| out.extend(x.to_le_bytes());
        word(VERSION);
        option_words(&self.options).into_iter().for_each(&mut word);
        self.nodes
            .low
            .to_array()
            .iter()
            .for_each(|x| word(x.to_bits()));
        self.nodes.counts.iter().for_each(|&n| word(n as u64));
        word(mesh.vertices.len() as u64);
        word(mesh.triangles.len() as u64);
        for v in &mesh.vertices {
            v.to_array().iter().for_each(|x| word(x.to_bits()));
        }
        mesh.triangles
            .iter()
            .flatten()
            .for_each(|v| out.extend(v.to_le_bytes()));
        self.values.iter().for_each(|v| out.extend(v.to_le_bytes()));
        let mut sum = Fnv::default();
        sum.add(&out);
        out.extend(sum.0.to_le_bytes());
        out
    }

    /// The grid that [`DistanceGrid::to_bytes`] wrote, to the bit; parts of the mesh are not kept.
    ///
    /// # Errors
    /// [`GridError::Stored`] for anything that is not whole and sound; the options' and the mesh's own errors.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, GridError> {
        let wrong = |reason| GridError::Stored { reason };
        if bytes.get(..8) != Some(MAGIC) {
            return Err(wrong("it is not a distance grid"));
        }
        let (body, sum) = bytes
            .split_at_checked(bytes.len() - 8)
            .ok_or(wrong("it was cut off"))?;
        let mut reader = Reader {
            rest: &body[8.min(body.len())..],
        };
        if reader.word()? != VERSION {
            return Err(wrong("it was made by another version"));
        }
        let mut found = Fnv::default();
        found.add(body);
        if sum != found.0.to_le_bytes() {
            return Err(wrong("its checksum does not fit, it is damaged"));
        }
        let options = read_options(&mut reader)?;
        build::check(&options)?;
        let low = reader.vector()?;
        let counts = [reader.word()?, reader.word()?, reader.word()?];
        let nodes: f64 = counts.iter().map(|&n| n as f64).product();
        if !low.is_finite() || counts.iter().any(|&n| n < 2) || nodes > MOST_NODES {
            return Err(wrong("its nodes make no grid"));
        }
        let (vertices, triangles) = (reader.word()?, reader.word()?);
        // No more is allocated than there are bytes for.
        let sizes = [24.0 * vertices as f64, 12.0 * triangles as f64, 4.0 * nodes];
        if triangles > MOST_FACETS || sizes.iter().sum::<f64>() != reader.rest.len() as f64 {
            return Err(wrong("its length does not fit its contents"));
        }
        let vertices: Result<Vec<DVec3>, GridError> =
            (0..vertices).map(|_| reader.vector()).collect();
        let triangles: Result<Vec<[u32; 3]>, GridError> = (0..triangles)
            .map(|_| Ok([reader.short()?, reader.short()?, reader.short()?]))
            .collect();
        let mesh = Mesh {
            vertices: vertices?,
            triangles: triangles?,
            parts: Vec::new(),
        };
        mesh.check()?;
        let values: Result<Vec<f32>, GridError> = (0..nodes as usize)
            .map(|_| reader.short().map(f32::from_bits))
            .collect();
        let values = values?;
        if !values.iter().all(|v| v.is_finite()) {
            return Err(wrong("a distance in it is not a number"));
        }
        let nodes = Nodes {
            low,
            cell: options.cell,
            counts: counts.map(|n| n as usize),
        };
        Self::from_parts(nodes, values, options, mesh)
    }
}

fn option_words(options: &GridOptions) -> [u64; 5] {
    [
        options.cell.to_bits(),
        options.band.to_bits(),
        // No wall is thinner than four cells, so zero is free to mean none.
        options.thickness.unwrap_or(0.0).to_bits(),
        options.most_bytes,
        u64::from(options.exact_edges),
    ]
}

fn read_options(reader: &mut Reader) -> Result<GridOptions, GridError> {
    let (cell, band, thickness) = (reader.number()?, reader.number()?, reader.number()?);
    let most_bytes = reader.word()?;
    let exact_edges = match reader.word()? {
        0 => false,
        1 => true,
        _ => {
            return Err(GridError::Stored {
                reason: "an option is neither yes nor no",
            });
        }
    };
    Ok(GridOptions {
        cell,
        band,
        thickness: (thickness != 0.0).then_some(thickness),
        most_bytes,
        exact_edges,
    })
}

/// Takes numbers off the front.
struct Reader<'a> {
    rest: &'a [u8],
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], GridError> {
        let (first, rest) = self
            .rest
            .split_first_chunk::<N>()
            .ok_or(GridError::Stored {
                reason: "it was cut off",
            })?;
        self.rest = rest;
        Ok(*first)
    }

    fn word(&mut self) -> Result<u64, GridError> {
        self.take().map(u64::from_le_bytes)
    }

    fn short(&mut self) -> Result<u32, GridError> {
        self.take().map(u32::from_le_bytes)
    }

    fn number(&mut self) -> Result<f64, GridError> {
        self.word().map(f64::from_bits)
    }

    fn vector(&mut self) -> Result<DVec3, GridError> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }
}

/// The FNV-1a hash of 64 bits: each step can be undone, so one changed byte always changes the result.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples;
    use proptest::prelude::*;
    use std::sync::OnceLock;

    fn grid(thickness: Option<f64>, exact_edges: bool) -> DistanceGrid {
        let options = GridOptions {
            thickness,
            exact_edges,
            ..GridOptions::new(0.1, 0.3)
        };
        DistanceGrid::build(&samples::ball(0.5, 8), &options, &|_| ()).unwrap()
    }

    #[test]
    fn a_grid_comes_back_to_the_bit() {
        for (thickness, exact) in [(None, false), (Some(0.4), false), (None, true)] {
            let grid = grid(thickness, exact);
            let bytes = grid.to_bytes();
            let back = DistanceGrid::from_bytes(&bytes).unwrap();
            assert_eq!(back.to_bytes(), bytes);
            assert_eq!(back.options, grid.options);
            assert_eq!(back.body_box, grid.body_box);
        }
    }

    #[test]
    fn the_key_is_stable_and_sees_every_change() {
        let cube = samples::cuboid(DVec3::ONE, 1);
        let options = GridOptions::new(0.1, 0.3);
        let key = DistanceGrid::key(&cube, &options);
        assert_eq!(key, DistanceGrid::key(&cube.clone(), &options));
        let mut other = cube.clone();
        other.vertices[3].y += 1e-15;
        assert_ne!(key, DistanceGrid::key(&other, &options));
        let mut other = cube.clone();
        other.triangles.swap(0, 1);
        assert_ne!(key, DistanceGrid::key(&other, &options));
        assert_ne!(
            key,
            DistanceGrid::key(
                &cube,
                &GridOptions {
                    exact_edges: true,
                    ..options
                }
            )
        );
        // FNV-1a of "a", from the hash's own definition.
        let mut hash = Fnv::default();
        hash.add(b"a");
        assert_eq!(hash.0, 0xaf63_dc4c_8601_ec8c);
    }

    #[test]
    fn foreign_bytes_are_refused() {
        for bytes in [
            b"".as_slice(),
            b"tsubuSDF",
            b"tsubuSDFtsubu",
            b"hello world, hello world",
        ] {
            assert!(matches!(
                DistanceGrid::from_bytes(bytes),
                Err(GridError::Stored { .. })
            ));
        }
    }

    /// The bytes with a checksum that fits: what remains to be caught is in the fields.
    fn summed(mut bytes: Vec<u8>) -> Vec<u8> {
        let end = bytes.len() - 8;
        let mut sum = Fnv::default();
        sum.add(&bytes[..end]);
        bytes[end..].copy_from_slice(&sum.0.to_le_bytes());
        bytes
    }

    /// Made once: it is damaged hundreds of times.
    fn stored() -> Vec<u8> {
        static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
        BYTES.get_or_init(|| grid(None, false).to_bytes()).clone()
    }

    proptest! {
        #[test]
        fn a_flipped_bit_or_a_cut_is_noticed(at in any::<prop::sample::Index>(), bit in 0u8..8, cut in any::<prop::sample::Index>()) {
            let bytes = stored();
            let mut flipped = bytes.clone();
            flipped[at.index(bytes.len())] ^= 1 << bit;
            prop_assert!(DistanceGrid::from_bytes(&flipped).is_err());
            prop_assert!(DistanceGrid::from_bytes(&bytes[..cut.index(bytes.len())]).is_err());
        }

        #[test]
        fn forged_fields_give_an_answer(at in 8usize..160, value in any::<u8>()) {
            let mut bytes = stored();
            bytes[at] = value;
            if let Ok(grid) = DistanceGrid::from_bytes(&summed(bytes)) {
                // Whatever was accepted can be asked.
                let _ = grid.distance_and_normal(DVec3::splat(0.1));
            }
        }
    }
}
