//! The readers of what strangers may send, each with a corpus of sound and unsound files.

use std::fs;
use std::path::Path;
use tsubu_assemble::{Choices, Simulation, build};
use tsubu_model::Words;
use tsubu_record::{
    Checkpoint, Checkpoints, Column, Frame, FrameWriter, RunFolder, array_in, frame_name,
};
use tsubu_scene::{GrainFile, Source, Space};
use tsubu_sdf::Mesh;
use tsubu_sdf::mesh::{Report, parse_obj, parse_stl};

/// A reader and what it is tried with.
pub struct Reader {
    /// What it reads.
    pub name: &'static str,
    /// Inputs in the quick set.
    pub quick: u64,
    /// Inputs in the full set.
    pub full: u64,
    /// Words that mean something to it.
    pub tokens: &'static [&'static str],
    /// What the inputs are made from.
    pub corpus: fn(&Path) -> Result<Vec<Vec<u8>>, String>,
    /// Reads an input; true if it was taken.
    pub read: fn(&[u8]) -> bool,
}

/// All of them.
pub const READERS: &[Reader] = &[
    Reader {
        name: "scenes",
        quick: 50_000,
        full: 1_000_000,
        tokens: &[
            "1e308",
            "-1",
            "NaN",
            "inf",
            "0",
            "18446744073709551616",
            "(",
            ")",
            "[",
            "]",
            "\"",
            ":",
            ",",
            "/*",
            "//",
            "((((((((((((((((",
            "[[[[[[[[[[[[[[[[",
            "\"1e300 mm\"",
            "\"-5 s\"",
            "name:",
            "Mesh(",
            "Periodic(\"1e-9 mm\")",
            "\u{feff}",
            "\0",
            "ä",
            "r#\"",
            "Some(",
            "..",
        ],
        corpus: |root| {
            files(
                root,
                &["scenarios", "tests/scenes/good", "tests/scenes/bad"],
                "ron",
            )
        },
        read: |input| {
            let Ok(text) = std::str::from_utf8(input) else {
                return false;
            };
            let read = Source::from_text("input.ron", text).check();
            // What is taken can be written, and what is refused can be shown.
            read.map_or_else(
                |error| {
                    error.render(true);
                    false
                },
                |checked| {
                    Source::from_text("again", &checked.scene.to_resolved_ron())
                        .check()
                        .is_ok()
                },
            )
        },
    },
    Reader {
        name: "grain files",
        quick: 100_000,
        full: 1_000_000,
        tokens: &[
            "x", "y", "z", "vx", "d", ",", "\n", "\r", "1e308", "-1", "NaN", "inf", "\"", "#",
            "\u{feff}", ";", "\t",
        ],
        corpus: |_| {
            let texts = [
                "x,y,z\n0,0,0.001\n0.002,0,0.001\n",
                "x,y,z,vx,vy,vz,d\n0,0,0,1,0,0,0.001\n",
                "# grains\n\nz,x,d\n1e-3,2e-3,1e-3\n",
            ];
            Ok(texts.map(|text| text.as_bytes().to_vec()).to_vec())
        },
        read: |input| {
            let text = String::from_utf8_lossy(input);
            [Space::Space, Space::Plane]
                .into_iter()
                .any(|space| GrainFile::parse("input.csv", &text, &[1e-3], space).is_ok())
        },
    },
    Reader {
        name: "STL files",
        quick: 20_000,
        full: 1_000_000,
        tokens: MESHES,
        corpus: |root| {
            let mut corpus = files(root, &["scenarios/meshes", "tests/scenes/good"], "stl")?;
            corpus.retain(|bytes| bytes.len() < 20_000);
            corpus.push(TEXT_STL.as_bytes().to_vec());
            Ok(corpus)
        },
        read: |input| looked_at(parse_stl(input, 1e-3).ok()),
    },
    Reader {
        name: "OBJ files",
        quick: 50_000,
        full: 1_000_000,
        tokens: MESHES,
        corpus: |_| {
            let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3 4\n";
            let parts = "mtllib ../../etc/passwd\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf -4 -3 -2\nf 1//1 2//1 4//1\ng b\nusemtl x\nf 1/1 3/2 4/3\n";
            Ok([quad, parts].map(|text| text.as_bytes().to_vec()).to_vec())
        },
        read: |input| looked_at(parse_obj(input, 1e-3).ok()),
    },
    Reader {
        name: "checkpoint files",
        quick: 50_000,
        full: 1_000_000,
        tokens: &["tsubu checkpoint", "\0\0\0\0\0\0\0\0", "\u{7f}"],
        corpus: |_| {
            let folder = scratch("checkpoint")?;
            let mut corpus = Vec::new();
            for text in SCENES {
                let mut checkpoint = Checkpoint {
                    program: "0".into(),
                    scene: text.into(),
                    files: vec![("a.stl".into(), "00".into())],
                    state: Words::new(),
                };
                running(text)?.save(&mut checkpoint.state);
                let path = Checkpoints::of(&folder).and_then(|all| all.write(1, &checkpoint));
                corpus.push(fs::read(path.map_err(|e| e.to_string())?).map_err(|e| e.to_string())?);
            }
            Ok(corpus)
        },
        read: |input| Checkpoint::parse(input).is_ok(),
    },
    Reader {
        name: "saved states",
        quick: 5_000,
        full: 1_000_000,
        tokens: &[
            "\0\0\0\0\0\0\0\0",
            "\u{1}\0\0\0\0\0\0\0",
            "contacts",
            "grains",
        ],
        // Behind a checksum that fits: what only a malicious file has.
        corpus: |_| {
            let mut corpus = Vec::new();
            for text in SCENES {
                let mut words = Words::new();
                running(text)?.save(&mut words);
                corpus.push(
                    words
                        .all()
                        .iter()
                        .flat_map(|word| word.to_le_bytes())
                        .collect(),
                );
            }
            Ok(corpus)
        },
        read: |input| {
            let eights = input.chunks_exact(8).map(|eight| {
                let mut word = [0; 8];
                word.copy_from_slice(eight);
                u64::from_le_bytes(word)
            });
            let words: Vec<u64> = eights.collect();
            SCENES.iter().any(|text| {
                let Ok(mut run) = running(text) else {
                    return false;
                };
                let taken = run.restore(&mut Words::of(words.clone())).is_ok();
                if taken {
                    run.advance(3);
                    run.look();
                }
                taken
            })
        },
    },
    Reader {
        name: "frames",
        quick: 50_000,
        full: 1_000_000,
        tokens: &[
            "offset=\"",
            "18446744073709551615",
            "Name=\"Points\"",
            "type=\"Float32\"",
            "\0\0\0\0\0\0\0\0",
        ],
        corpus: |_| {
            let folder = scratch("frames")?;
            let points: Vec<[f32; 3]> = (0..40).map(|k| [k as f32, 0.5, -1.0]).collect();
            let frame = Frame {
                points: &points,
                columns: &[("velocity", Column::Vector(&points))],
            };
            let written =
                FrameWriter::new(&folder).and_then(|mut frames| frames.write(0.0, &frame));
            written.map_err(|e| e.to_string())?;
            let bytes = fs::read(folder.path(frame_name(0))).map_err(|e| e.to_string())?;
            Ok(vec![bytes])
        },
        read: |input| array_in(input, "Points").is_some(),
    },
];

const MESHES: &[&str] = &[
    "1e308",
    "-1e308",
    "nan",
    "inf",
    "1e39",
    "0",
    "solid",
    "facet normal 0 0 1",
    "outer loop",
    "vertex",
    "endloop",
    "endsolid",
    "v 0 0 0\n",
    "f 1 2 3\n",
    "f 0 0 0\n",
    "f -9 9 4294967296\n",
    "mtllib /etc/passwd\n",
    "\n",
    "\r",
    "#",
    "\u{ff}\u{ff}\u{ff}\u{7f}",
];

const TEXT_STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid a\n";

/// Small scenes with everything that is saved: memory, a wall that goes, a body that turns, gates, water.
const SCENES: [&str; 2] = [
    r#"(
        title: "Six grains, a wall that goes, an outlet", space: Plane, gravity: "9.80665 m/s2",
        grains: (diameter: "1 mm", density: "2500 kg/m3",
            law: SpringDashpot(constants: FromTimeStep(step: "20 us", tn: 20, cn: 1.3, beta: 15.8), poisson: 0.3, friction: 0.5, tension: NoPull)),
        walls: [
            (name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.4),
            (name: "left", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (1, 0, 0)), restitution: 0.5, friction: 0.4, removed: At("1 ms")),
        ],
        initial: (grains: [
            (at: ("0.5 mm", "0 mm", "0.5 mm")), (at: ("1.5 mm", "0 mm", "0.5 mm")), (at: ("2.5 mm", "0 mm", "0.5 mm")),
            (at: ("1 mm", "0 mm", "1.37 mm")), (at: ("2 mm", "0 mm", "1.37 mm")), (at: ("1.5 mm", "0 mm", "2.24 mm")),
        ]),
        outlets: [(name: "out", region: (min: ("-50 mm", "0 mm", "-50 mm"), max: ("-1 mm", "0 mm", "50 mm")), then: Delete)],
        time: (until: "50 ms"),
    )"#,
    r#"(
        title: "Three grains in space, energies", gravity: "9.80665 m/s2",
        grains: (diameter: "1 mm", density: "2500 kg/m3",
            law: Repulsion(stiffness: YoungModulus("10 MPa"), damping: Equal("0.01 kg/s"))),
        domain: (x: Periodic("5 mm"), y: Periodic("5 mm")),
        walls: [(name: "floor", shape: HalfSpace(point: ("0 mm", "0 mm", "0 mm"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.4)],
        initial: (grains: [(at: ("1 mm", "1 mm", "0.5 mm")), (at: ("2 mm", "1 mm", "0.5 mm")), (at: ("1.5 mm", "1.5 mm", "1.4 mm"))]),
        time: (until: "50 ms"), output: (energies: true),
    )"#,
];

/// A scene some steps on its way.
fn running(text: &str) -> Result<Box<dyn Simulation>, String> {
    let checked = Source::from_text("small.ron", text).check();
    let choices = Choices {
        threads: Some(1),
        ..Choices::default()
    };
    let built = checked.and_then(|checked| build(&checked, &choices));
    let mut run = built.map_err(|e| e.to_string())?.simulation;
    run.look();
    run.advance(300);
    Ok(run)
}

/// A run folder that is thrown away with the process's next one of that name.
fn scratch(name: &str) -> Result<RunFolder, String> {
    let path = std::env::temp_dir().join(format!("tsubu-faults-{name}-{}", std::process::id()));
    fs::remove_dir_all(&path).ok();
    RunFolder::create(Some(&path), "unused", false).map_err(|e| e.to_string())
}

/// A mesh that was taken is looked at, as `tsubu mesh` does.
fn looked_at(mesh: Option<Mesh>) -> bool {
    if let Some(mesh) = &mesh {
        mesh.check().ok();
        Report::of(mesh).unit_doubt();
    }
    mesh.is_some()
}

/// The files of some folders with this ending.
fn files(root: &Path, folders: &[&str], ending: &str) -> Result<Vec<Vec<u8>>, String> {
    let mut paths = Vec::new();
    for folder in folders {
        let entries = fs::read_dir(root.join(folder)).map_err(|e| format!("{folder}: {e}"))?;
        paths.extend(entries.flatten().map(|entry| entry.path()));
    }
    paths.retain(|path| path.extension().is_some_and(|e| e == ending));
    paths.sort();
    paths
        .iter()
        .map(|path| fs::read(path).map_err(|e| format!("{}: {e}", path.display())))
        .collect()
}
