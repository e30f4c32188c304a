//! `cargo xtask meshes`: the STL files of the screw feeder, written from the numbers of paper A, and of the hopper.
//!
//! Lengths in mm, the screw's axis is the x axis, z is up. The right-handed screw conveys towards +x
//! when it turns *clockwise* seen from the outlet, that is by a negative angle about +x: its faces
//! lie at x = p·φ/2π, so turned by α they stand at x = p·(φ − α)/2π, and a plug that cannot turn is
//! carried by −p·α/2π: one pitch towards +x for every turn of −2π.

mod feeder;
mod hopper;

use std::fs;
use std::path::Path;
use tsubu_model::Shell;
use tsubu_sdf::mesh::{Mesh, write_stl};

/// Where the files go, from the root of the workspace.
pub const FOLDER: &str = "scenarios/meshes";

/// The turn of a right-handed screw that carries towards +x.
const TURN: &str = "the screw is right-handed: it conveys towards +x when it turns by a negative angle \
about +x (clockwise seen from the outlet); a plug that cannot turn advances 150 mm per turn";

/// Writes the files and says what is in them.
pub fn run(root: &Path) -> Result<bool, String> {
    let folder = root.join(FOLDER);
    let fail =
        |what: &Path, e: std::io::Error| format!("{} cannot be written: {e}", what.display());
    fs::create_dir_all(&folder).map_err(|e| fail(&folder, e))?;
    println!(
        "file          shells  triangles    bytes  volume, l   x, mm           y, mm           z, mm"
    );
    for (name, shells) in files()? {
        let path = folder.join(format!("{name}.stl"));
        let bytes = stl(name, &shells);
        fs::write(&path, &bytes).map_err(|e| fail(&path, e))?;
        println!("{}", row(name, &shells, bytes.len()));
    }
    println!(
        "chords within {} mm of the surfaces; {TURN}",
        1e3 * feeder::CHORD
    );
    Ok(true)
}

/// Every file: its name and its closed shells in m.
fn files() -> Result<[(&'static str, Vec<Shell>); 9], String> {
    let screw = feeder::screw().map_err(|e| e.to_string())?;
    let section = feeder::screw_section().map_err(|e| e.to_string())?;
    Ok([
        ("screw", vec![screw.mesh(feeder::CHORD)]),
        ("screw_section", vec![section.mesh(feeder::CHORD)]),
        ("casing", feeder::casing().map_err(|e| e.to_string())?),
        ("hopper", feeder::hopper().map_err(|e| e.to_string())?),
        ("fill", feeder::fill().map_err(|e| e.to_string())?),
        ("hopper_full", vec![feeder::wide_hopper()]),
        ("fill_full", vec![feeder::wide_fill()]),
        ("cone", vec![hopper::hopper(feeder::CHORD)]),
        ("cone_inside", vec![hopper::inside(feeder::CHORD)]),
    ])
}

/// The file of some shells given in m, in mm.
fn stl(name: &str, shells: &[Shell]) -> Vec<u8> {
    let mut mesh = Mesh::default();
    for shell in shells {
        let first = mesh.vertices.len() as u32;
        mesh.vertices
            .extend(shell.vertices.iter().map(|v| *v * 1e3));
        let shifted = shell.triangles.iter().map(|t| t.map(|c| c + first));
        mesh.triangles.extend(shifted);
    }
    write_stl(
        &mesh,
        &format!("tsubu {name}, binary STL, mm, z up, from cargo xtask meshes"),
    )
}

fn row(name: &str, shells: &[Shell], bytes: usize) -> String {
    let triangles: usize = shells.iter().map(|s| s.triangles.len()).sum();
    let litres: f64 = shells.iter().map(tsubu_sdf::volume).sum::<f64>() * 1e3;
    let corners = shells.iter().flat_map(|s| &s.vertices);
    let range = |axis: usize| {
        let (low, high) = corners
            .clone()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x[axis]), high.max(x[axis]))
            });
        format!("{:7.1}…{:<7.1}", 1e3 * low, 1e3 * high)
    };
    format!(
        "{:<12} {:>7} {triangles:>10} {bytes:>8} {litres:>10.4} {} {} {}",
        format!("{name}.stl"),
        shells.len(),
        range(0),
        range(1),
        range(2)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;
    use std::f64::consts::PI;

    /// The triangles of a file, in mm.
    fn triangles(bytes: &[u8]) -> Vec<[glam::DVec3; 3]> {
        let mesh = tsubu_sdf::mesh::parse_stl(bytes, 1.0).unwrap();
        (0..mesh.triangles.len()).map(|t| mesh.corners(t)).collect()
    }

    /// Volume in mm³ of what an STL file encloses; panics unless every edge belongs to exactly two
    /// triangles that run through it oppositely.
    fn closed_volume(name: &str, bytes: &[u8]) -> f64 {
        let triangles = triangles(bytes);
        let mut edges = HashMap::<[[u64; 3]; 2], i32>::new();
        let mut six = 0.0;
        for t in &triangles {
            let key = t.map(|x| x.to_array().map(f64::to_bits));
            for k in 0..3 {
                *edges.entry([key[k], key[(k + 1) % 3]]).or_default() += 1;
            }
            let [a, b, c] = *t;
            six += a.dot(b.cross(c));
        }
        for (&[a, b], &count) in &edges {
            assert_eq!(edges.get(&[b, a]), Some(&count), "{name}: an open edge");
        }
        six / 6.0
    }

    #[test]
    fn every_shell_is_closed_and_has_the_volume_of_its_formula() {
        let (r, wide) = (114.8f64, 124.8f64);
        let ring = PI * (wide * wide - r * r);
        let trough = (0.5 * ring + 2.0 * 10.0 * 160.0) * 318.0;
        let end = 249.6 * (124.8 + 160.0) * 10.0;
        let over = (249.6 * 160.0 - 0.5 * PI * 119.8 * 119.8) * 10.0;
        let screw = |length: f64| {
            let turns = (length - 12.0) / 150.0;
            let flight = 0.5 * 6.0 * (102.5 * 102.5 - 27.5 * 27.5) * 2.0 * PI * turns;
            PI * 27.5 * 27.5 * length + flight
        };
        let expected = [
            screw(675.0),
            screw(450.0),
            trough + ring * 232.0 + end + over,
            840.0 * 10.0 * 2.0 * (338.0 + 249.6),
            306.0 * 218.0 * 880.0,
            // Outside less inside, frusta of rectangles: h/6 (A₁ + 4 Aₘ + A₂).
            1200.0 / 6.0
                * ((338.0 * 249.6 + 4.0 * 779.0 * 634.8 + 1220.0 * 1020.0)
                    - (318.0 * 229.6 + 4.0 * 759.0 * 614.8 + 1200.0 * 1000.0)),
            1150.0 / 6.0 * (280.0 * 190.0 + 4.0 * 690.0 * 550.0 + 1100.0 * 910.0),
            hopper::volumes()[0] * 1e9,
            hopper::volumes()[1] * 1e9,
        ];
        for ((name, shells), expected) in files().unwrap().into_iter().zip(expected) {
            // Each shell by itself first: a gap must not be mended by a neighbour's edge.
            for shell in &shells {
                let one = stl(name, std::slice::from_ref(shell));
                let volume = closed_volume(name, &one);
                assert!(volume > 0.0, "{name} is inside out");
            }
            let volume = closed_volume(name, &stl(name, &shells));
            assert!(
                (volume / expected - 1.0).abs() < 5e-3,
                "{name}: {volume} mm³ against {expected}"
            );
        }
    }

    #[test]
    fn the_shipped_files_are_those_that_the_command_writes() {
        let folder = crate::root().join(FOLDER);
        for (name, shells) in files().unwrap() {
            let shipped = fs::read(folder.join(format!("{name}.stl"))).unwrap();
            let (a, b) = (triangles(&shipped), triangles(&stl(name, &shells)));
            assert_eq!(a.len(), b.len(), "{name}: run cargo xtask meshes");
            for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
                // Sines differ by a bit between machines, not by more.
                assert!((*a - *b).length() < 1e-3, "{name}: run cargo xtask meshes");
            }
        }
    }

    #[test]
    fn the_triangles_of_the_screw_lie_within_the_chord_that_is_printed() {
        let screw = feeder::screw().unwrap();
        let bytes = stl("screw", &[screw.mesh(feeder::CHORD)]);
        let mut farthest = 0.0f64;
        for t in triangles(&bytes) {
            let [a, b, c] = t.map(|x| x * 1e-3);
            for x in [
                a,
                (a + b) / 2.0,
                (b + c) / 2.0,
                (c + a) / 2.0,
                (a + b + c) / 3.0,
            ] {
                farthest = farthest.max(tsubu_sdf::Solid::distance(&screw, x).abs());
            }
        }
        println!("farthest {farthest:.3e} m");
        assert!(farthest < feeder::CHORD, "{farthest} m");
    }

    #[test]
    fn the_turn_that_is_printed_carries_a_plug_towards_the_outlet() {
        use tsubu_model::{Motion, Span, Surface, Turn};
        let screw = feeder::screw().unwrap();
        // 60 r/min with the sign that the output states.
        let motion = Motion {
            turn: Some(Turn {
                point: glam::DVec3::ZERO,
                axis: glam::DVec3::X,
                rate: -std::f64::consts::TAU,
                span: Span::ALWAYS,
            }),
            shifts: Vec::new(),
        };
        // A point on the front face stays on the face when it advances 150 mm per turn straight ahead.
        let start = glam::DVec3::new(0.153, 0.07, 0.0);
        for k in 0..=20 {
            let t = f64::from(k) * 0.1;
            let plug = start + glam::DVec3::X * (0.150 * t);
            let distance = screw.lower_bound(motion.at(t).to_body(plug));
            assert!(
                distance.abs() < 1e-12,
                "{distance} m off the face after {t} s"
            );
        }
        assert!(TURN.contains("negative angle"));
    }
}
