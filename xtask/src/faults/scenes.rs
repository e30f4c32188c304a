//! Short versions of the shipped scenes: a second or two each, with all that they are made of.

/// A scene, shortened.
pub struct Short {
    /// Name of its file in `scenarios`.
    pub name: &'static str,
    /// What is changed, as after `--set`.
    pub changes: &'static [&'static str],
}

/// The grains need not become still, so the wall goes or the screw starts at once.
const AT_ONCE: [&str; 2] = ["still.kinetic_energy=1e9", "still.for_at_least=20 ms"];

/// One of each kind: a wall that goes, a screw with an outlet, a screw in a periodic box, a bed under water.
pub const SHORT: [Short; 4] = [
    Short {
        name: "angle_of_repose",
        changes: &[
            "grains.coarse=3",
            AT_ONCE[0],
            AT_ONCE[1],
            "time.until=0.15 s",
            "output.every=5 ms",
            "output.frames_every=10 ms",
        ],
    },
    Short {
        name: "screw_feeder",
        changes: &[
            "grains.coarse=4",
            AT_ONCE[0],
            AT_ONCE[1],
            "time.until=0.1 s",
            "output.every=5 ms",
            "output.frames_every=20 ms",
        ],
    },
    Short {
        name: "screw_section",
        changes: &[
            AT_ONCE[0],
            AT_ONCE[1],
            "time.until=0.1 s",
            "output.every=5 ms",
            "output.frames_every=20 ms",
        ],
    },
    Short {
        name: "movable_bed",
        changes: &[
            "water.begins=0.1 s",
            "time.until=0.2 s",
            "output.frames_every=20 ms",
        ],
    },
];

/// The paper's 200 000 grains, coarser; only in the full set.
pub const LARGE: Short = Short {
    name: "screw_feeder_full",
    changes: &[
        "grains.coarse=4",
        AT_ONCE[0],
        AT_ONCE[1],
        "time.until=20 ms",
        "output.every=2 ms",
        "output.frames_every=10 ms",
    ],
};

impl Short {
    /// The arguments of `tsubu run` for it, into this folder.
    pub fn run(&self, root: &std::path::Path, out: &str) -> Vec<String> {
        let scene = root.join("scenarios").join(format!("{}.ron", self.name));
        let mut words = vec!["run".to_owned(), scene.display().to_string()];
        words.extend(["--out".into(), out.into()]);
        for change in self.changes {
            words.extend(["--set".into(), (*change).to_owned()]);
        }
        words
    }
}
