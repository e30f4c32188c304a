//! Grains for the bench: beds cut out of or laid together from one settled packing, a gas, a hopper.

use crate::validate::lab::Draw;
use glam::DVec3;
use std::fmt::Write as _;
use std::path::Path;
use tsubu_assemble::Simulation;
use tsubu_model::{Space, Surface};
use tsubu_sdf::HollowCone;
use tsubu_sdf::mesh::{Mesh, write_stl};

/// Side of the packing's box and diameter of its grains, in m.
const SIDE: f64 = 58.32e-3;
const D: f64 = 1.350e-3;

/// How a bed is made of the packing.
#[derive(Clone, Copy, Debug)]
pub enum Cut {
    /// A column whose sides are 1/k of the packing's.
    Part(u32),
    /// k × k packings side by side.
    Tiles(u32),
}

/// About 1e3, 1e4, 1e5 and 1e6 grains.
pub const CUTS: [Cut; 4] = [Cut::Part(10), Cut::Part(3), Cut::Tiles(1), Cut::Tiles(3)];

/// A bed as a grain file, the side of its box in m and its number of grains.
pub fn bed(root: &Path, cut: Cut) -> Result<(String, f64, usize), String> {
    let path = root.join("benches/scenes/packing.csv");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let read = |line: &str| -> Option<DVec3> {
        let values: Option<Vec<f64>> = line.split(',').map(|w| w.trim().parse().ok()).collect();
        let [x, y, z] = values?[..] else { return None };
        Some(DVec3::new(x, y, z))
    };
    let all: Vec<DVec3> = text.lines().skip(1).filter_map(read).collect();
    let (places, side) = match cut {
        Cut::Part(k) => {
            let side = SIDE / f64::from(k);
            (column(&all, side), side)
        }
        Cut::Tiles(k) => {
            let shifts =
                (0..k * k).map(|t| DVec3::new(f64::from(t % k), f64::from(t / k), 0.0) * SIDE);
            (
                shifts
                    .flat_map(|s| all.iter().map(move |x| *x + s))
                    .collect(),
                SIDE * f64::from(k),
            )
        }
    };
    Ok((rows(&places), side, places.len()))
}

/// The grains of a column of the packing that fit where it meets itself; a few at the seam are left out.
fn column(all: &[DVec3], side: f64) -> Vec<DVec3> {
    let inside: Vec<DVec3> = all
        .iter()
        .copied()
        .filter(|x| x.x < side && x.y < side)
        .collect();
    let image = |d: f64| d - side * (d / side).round();
    let at_seam = |x: &DVec3| [x.x, x.y].iter().any(|c| *c < D || *c > side - D);
    let (seam, mut kept): (Vec<DVec3>, Vec<DVec3>) = inside.into_iter().partition(at_seam);
    let mut placed: Vec<DVec3> = Vec::new();
    for x in seam {
        let free = placed.iter().all(|y| {
            let d = x - *y;
            let near = DVec3::new(image(d.x), image(d.y), d.z);
            // Neighbours of the packing itself lie as they lie.
            near == d || near.length() > 0.998 * D
        });
        if free {
            placed.push(x);
        }
    }
    kept.extend(placed);
    kept
}

/// A gas at a solid fraction of 0.1 on a cubic lattice, with normal deviates of 0.1 m/s as velocities; the side of its box.
pub fn gas(count: usize) -> (String, f64) {
    let volume = std::f64::consts::PI / 6.0 * D.powi(3) * count as f64 / 0.1;
    let side = volume.cbrt();
    let along = (count as f64).cbrt().ceil() as usize;
    let step = side / along as f64;
    let mut draw = Draw(3);
    let mut text = "x,y,z,vx,vy,vz\n".to_owned();
    for k in 0..count {
        let cell = DVec3::new(
            (k % along) as f64,
            (k / along % along) as f64,
            (k / along / along) as f64,
        );
        let x = (cell + 0.5) * step;
        let v: [f64; 3] = std::array::from_fn(|_| 0.1 * draw.normal());
        let _ = writeln!(
            text,
            "{:?},{:?},{:?},{:?},{:?},{:?}",
            x.x, x.y, x.z, v[0], v[1], v[2]
        );
    }
    (text, side)
}

/// A hopper as STL in m: a cone of half-angle about 26° to an opening of 8 grains, a silo above it.
pub fn hopper() -> Result<Vec<u8>, String> {
    let mut triangles = Vec::new();
    let mut vertices = Vec::new();
    let parts = [
        (DVec3::ZERO, DVec3::Z * 18e-3, [5.4e-3, 14.8e-3]),
        // A hair above the cone: faces that lie back to back stop LIGGGHTS.
        (DVec3::Z * 18.1e-3, DVec3::Z * 60e-3, [14.8e-3, 14.8e-3]),
    ];
    for (from, to, [a, b]) in parts {
        let cone = HollowCone::new(from, to, a, b, 2e-3).map_err(|e| e.to_string())?;
        let shell = Surface::<Space>::shell(&cone).ok_or("a cone is drawn with triangles")?;
        let first = vertices.len() as u32;
        vertices.extend(shell.vertices);
        triangles.extend(shell.triangles.iter().map(|t| t.map(|k| k + first)));
    }
    let mesh = Mesh::from(tsubu_model::Shell {
        vertices,
        triangles,
    });
    Ok(write_stl(&mesh, "hopper"))
}

fn rows(places: &[DVec3]) -> String {
    let mut text = "x,y,z\n".to_owned();
    for x in places {
        let _ = writeln!(text, "{:?},{:?},{:?}", x.x, x.y, x.z);
    }
    text
}

/// Places and velocities of a run as a grain file, without grains that have fallen below a height in m.
pub fn state(run: &dyn Simulation, above: f64) -> String {
    let mut text = "x,y,z,vx,vy,vz\n".to_owned();
    for (x, v) in run.state().into_iter().filter(|(x, _)| x.z > above) {
        let _ = writeln!(
            text,
            "{:?},{:?},{:?},{:?},{:?},{:?}",
            x.x, x.y, x.z, v.x, v.y, v.z
        );
    }
    text
}

/// Number of grains of a file.
pub fn count(file: &Path) -> Result<usize, String> {
    let text = std::fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
    Ok(text.lines().count().saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is cut out still is a packing: of the 992 grains over that share of the floor some are missing at the seam, where
    /// nearly all of so narrow a column are, and none overlaps across it.
    #[test]
    fn a_column_keeps_nearly_all_and_overlaps_nowhere() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let (text, side, count) = bed(&root, Cut::Part(10)).unwrap();
        assert!((650..=992).contains(&count), "{count}");
        let places: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|l| l.split(',').map(|w| w.parse().unwrap()).collect())
            .collect();
        let image = |d: f64| d - side * (d / side).round();
        for (k, a) in places.iter().enumerate() {
            for b in &places[..k] {
                let d = DVec3::new(image(a[0] - b[0]), image(a[1] - b[1]), a[2] - b[2]);
                assert!(d.length() > 0.99 * D, "{a:?} {b:?}");
            }
        }
    }
}
