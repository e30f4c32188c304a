//! Decks of LIGGGHTS: law `SpringDashpot` as `hooke/stiffness` with tangential history, bodies as STL meshes that may move.

mod faces;
mod stl;

use super::lammps::{refuse_readings, spheres};
use super::ready::Ready;
use super::timeline::{Act, Timeline};
use super::{DATA, DUMP, Deck, INPUT};
use faces::Faces;
use glam::DVec3;
use tsubu_assemble::Law;
use tsubu_contact::SpringDashpot;
use tsubu_scene::{Course, Removal, SceneError, Shape, TouchesAt};

/// The contact model; damping is given in kg/s, friction limits what the spring gives, and no force pulls.
const MODEL: &str = "model hooke/stiffness tangential history";
/// Its settings, which a wall takes after its shape.
const SETTINGS: &str = "tangential_damping on absolute_damping on limitForce on";
const AXES: [&str; 3] = ["x", "y", "z"];

/// A wall as the deck says it.
struct Wall {
    /// The commands that make it.
    made: Vec<String>,
    /// Those that take it away.
    removal: Vec<String>,
    /// Its file of triangles.
    file: Option<(String, String)>,
    /// What was left out of it.
    differs: Option<String>,
}

/// The deck of a scene.
pub fn deck(ready: &Ready) -> Result<Deck, SceneError> {
    let Law::SpringDashpot(of) = &ready.constants.law else {
        let what = "is written for law SpringDashpot only: it has none like Repulsion, and its law of Hertz and Mindlin damps otherwise";
        let remedy = "write law SpringDashpot, or write a scene of law Repulsion for LAMMPS (tsubu export lammps)";
        return Err(ready.refuse("grains.law", what, remedy));
    };
    let law = of.law();
    let laws: Vec<_> = of.walls.iter().map(|wall| wall.laws()[0]).collect();
    let laws = &laws[..];
    refuse_readings(ready, law)?;
    let timeline = Timeline::of(ready)?;
    if timeline.damping() != 1.0 {
        let what = "keeps the constants of a contact from the start to the end";
        return Err(ready.refuse("still.damping", what, "write still.damping: 1"));
    }
    let walls: Vec<Wall> = (0..laws.len())
        .map(|number| wall(ready, number))
        .collect::<Result<_, _>>()?;
    let mut lines = head(ready);
    lines.extend(materials(law, laws));
    lines.push(format!("pair_style gran {MODEL} {SETTINGS}"));
    lines.push("pair_coeff * *".into());
    lines.extend(walls.iter().flat_map(|w| w.made.clone()));
    lines.extend(meshes(ready, &walls));
    lines.extend(forces(ready));
    let act = |act| match act {
        Act::FullDamping => Vec::new(),
        Act::Remove(number) => walls[number].removal.clone(),
        Act::Start(number) => started(ready, number),
        Act::Stop(number) => vec![format!("unfix move_{}", ready.names[number])],
    };
    let outlets = ready.scene().outlets.len();
    let run = |steps: &str| {
        if outlets == 0 {
            return vec![format!("run {steps}")];
        }
        let go = (0..outlets).map(|k| format!(" \"delete_atoms region outlet_{k} compress no\""));
        vec![format!("run {steps} every 1000{}", go.collect::<String>())]
    };
    lines.extend(timeline.commands(ready, &act, &run));
    let mut files = vec![
        (INPUT.into(), lines.join("\n") + "\n"),
        (DATA.into(), spheres(ready, laws.len() + 1, "")),
    ];
    let mut differs = differs(ready);
    differs.extend(walls.iter().filter_map(|w| w.differs.clone()));
    files.extend(walls.into_iter().filter_map(|w| w.file));
    Ok(Deck {
        target: ready.target,
        files,
        differs,
        grains: ready.grains.len(),
        wall_grains: 0,
    })
}

fn head(ready: &Ready) -> Vec<String> {
    let boundary = ready.periodic().map(|p| if p { "p" } else { "m" });
    let mut lines = vec![
        format!("# {}", ready.title()),
        "# Written by `tsubu export liggghts`; SI units. README.md says how to run it and what differs.".into(),
        format!("variable skin index {:?}", ready.skin()),
        "units si".into(),
        "atom_style granular".into(),
        "atom_modify map array".into(),
        format!("boundary {}", boundary.join(" ")),
        "newton off".into(),
        "communicate single vel yes".into(),
    ];
    if ready.periodic() == [true, true, false] {
        lines.push("processors * * 1".into());
    }
    lines.extend([
        format!("read_data {DATA}"),
        "neighbor ${skin} bin".into(),
        "neigh_modify every 1 delay 0 check yes".into(),
        "group grains type 1".into(),
    ]);
    lines
}

/// Constants by pair of types: grains are type 1, each wall has its own.
fn materials(law: &SpringDashpot, walls: &[SpringDashpot]) -> Vec<String> {
    let types = walls.len() + 1;
    let table = |name: &str, of: fn(&SpringDashpot) -> f64| {
        let entry = |(a, b): (usize, usize)| match (a, b) {
            (0, k) | (k, 0) if k > 0 => of(&walls[k - 1]),
            _ => of(law),
        };
        let all = (0..types).flat_map(|a| (0..types).map(move |b| (a, b)));
        let values: String = all.map(|ab| format!(" {:?}", entry(ab))).collect();
        format!("fix {name} all property/global {name} peratomtypepair {types}{values}")
    };
    vec![
        table("kn", |l| l.normal_stiffness),
        table("kt", |l| l.tangential_stiffness),
        table("gamman_abs", |l| l.normal_damping),
        table("gammat_abs", |l| l.tangential_damping),
        table("coefficientFriction", |l| l.friction),
    ]
}

/// A plane along an axis, or a file of triangles.
fn wall(ready: &Ready, number: usize) -> Result<Wall, SceneError> {
    let (wall, name) = (&ready.scene().walls[number], &ready.names[number]);
    let (path, material) = (format!("walls[{number}]"), number + 2);
    if let Shape::HalfSpace { .. } = wall.shape {
        let Some(face) = ready.face(wall, 0.5 * ready.diameter()) else {
            let what = format!("has no plane that leans, as `{}` does", wall.name);
            let remedy = "write it as a Cuboid or a Mesh";
            return Err(ready.refuse(&format!("{path}.shape"), &what, remedy));
        };
        if wall.motion.is_some() {
            let what = format!("keeps the plane `{}` at rest", wall.name);
            let remedy = "leave its motion out, or make it a Mesh";
            return Err(ready.refuse(&format!("{path}.motion"), &what, remedy));
        }
        return Ok(Wall {
            made: vec![format!(
                "fix wall_{name} all wall/gran {MODEL} primitive type {material} {}plane {:?} {SETTINGS}",
                AXES[face.axis], face.at
            )],
            removal: vec![format!("unfix wall_{name}")],
            file: None,
            differs: None,
        });
    }
    let Some(shell) = ready.shells[number]
        .as_ref()
        .filter(|s| !s.triangles.is_empty())
    else {
        let what = format!("takes triangles, and `{}` has none", wall.name);
        return Err(ready.refuse(&format!("{path}.shape"), &what, "write it as a Mesh"));
    };
    if wall.touches_at == TouchesAt::Centre {
        let what = format!("lets grains touch `{}` at their surface only", wall.name);
        return Err(ready.refuse(
            &format!("{path}.touches_at"),
            &what,
            "write touches_at: Surface",
        ));
    }
    if let Shape::Mesh {
        thickness: Some(_), ..
    } = wall.shape
    {
        let what = format!(
            "takes the triangles of `{}` as they are, without a thickness",
            wall.name
        );
        return Err(ready.refuse(&format!("{path}.shape.thickness"), &what, "close the mesh"));
    }
    if wall.removed != Removal::Never {
        let what = format!(
            "knows its meshes from the start to the end, `{}` too",
            wall.name
        );
        let remedy = "write it as a half-space, or leave it in its place";
        return Err(ready.refuse(&format!("{path}.removed"), &what, remedy));
    }
    let file = format!("{name}.stl");
    let faces = Faces::of(shell);
    let differs = (faces.needles + faces.inner > 0).then(|| {
        format!(
            "Of `{}` {} needle triangles and {} faces between its own parts are left out, at which LIGGGHTS would stop; no grain notices either.",
            wall.name, faces.needles, faces.inner
        )
    });
    Ok(Wall {
        made: vec![format!(
            "fix {name} all mesh/surface file {file} type {material} heal auto_remove_duplicates curvature_tolerant yes"
        )],
        removal: Vec::new(),
        file: Some((file, stl::text(&faces.triangles, name))),
        differs,
    })
}

/// All meshes are one wall: LIGGGHTS takes no second of that kind.
fn meshes(ready: &Ready, walls: &[Wall]) -> Option<String> {
    let names = walls.iter().zip(&ready.names);
    let names: Vec<&str> = names
        .filter(|(wall, _)| wall.file.is_some())
        .map(|(_, name)| name.as_str())
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "fix wall_meshes all wall/gran {MODEL} mesh n_meshes {} meshes {} {SETTINGS}",
            names.len(),
            names.join(" ")
        )
    })
}

/// Weight, integration, outlets, and what is written.
fn forces(ready: &Ready) -> Vec<String> {
    let scene = ready.scene();
    let mut lines = Vec::new();
    if scene.gravity > 0.0 {
        lines.push(format!(
            "fix weight all gravity {:?} vector 0 0 -1",
            scene.gravity
        ));
    }
    lines.push("fix drift all nve/sphere".into());
    for (number, outlet) in scene.outlets.iter().enumerate() {
        let (a, b) = (outlet.region.min, outlet.region.max);
        lines.push(format!(
            "region outlet_{number} block {:?} {:?} {:?} {:?} {:?} {:?} units box",
            a.x, b.x, a.y, b.y, a.z, b.z
        ));
    }
    lines.extend([
        format!("timestep {:?}", ready.constants.dt),
        "compute ke grains ke".into(),
        "thermo 1000".into(),
        "thermo_style custom step atoms c_ke".into(),
        "thermo_modify lost error norm no".into(),
    ]);
    if let Some(frames) = ready.frames {
        lines.push(format!("variable every index {frames}"));
        lines.push(format!(
            "dump frames grains custom ${{every}} {DUMP} id type x y z vx vy vz"
        ));
        lines.push(
            "dump_modify frames sort id first yes format \"%d %d %.9g %.9g %.9g %.9g %.9g %.9g\""
                .into(),
        );
    }
    lines
}

/// A mesh begins to move.
fn started(ready: &Ready, number: usize) -> Vec<String> {
    let name = &ready.names[number];
    let Some(motion) = &ready.scene().walls[number].motion else {
        return Vec::new();
    };
    let three = |v: DVec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
    let how = match (&motion.turn, motion.shifts.first()) {
        (Some(turn), _) => format!(
            "rotate origin {} axis {} period {:?}",
            three(turn.point),
            three(turn.axis * turn.rate.signum()),
            std::f64::consts::TAU / turn.rate.abs()
        ),
        (None, Some(shift)) => match shift.course {
            Course::Steady(speed) => format!("linear {}", three(shift.direction * speed)),
            Course::Swing {
                amplitude,
                frequency,
            } => format!(
                "wiggle amplitude {} period {:?}",
                three(shift.direction * amplitude),
                1.0 / frequency
            ),
        },
        (None, None) => return Vec::new(),
    };
    vec![format!("fix move_{name} all move/mesh mesh {name} {how}")]
}

fn differs(ready: &Ready) -> Vec<String> {
    let mut all = vec![
        "Where the tangential spring exceeds μ times the normal force, LIGGGHTS gives that much and no dashpot; tsubu limits spring and dashpot together.".to_owned(),
        "The lever arm of the tangential force is the radius less half the overlap; in tsubu it is the radius.".to_owned(),
    ];
    if ready.shells.iter().any(Option::is_some) {
        all.push("Walls are the triangles themselves; a grid of distances of tsubu rounds edges off by up to half a cell.".into());
    }
    if ready.scene().time.integrator == tsubu_scene::Integrator::SymplecticEuler {
        all.push(
            "It starts with half a kick (velocity Verlet, damping from the half-step velocity)."
                .into(),
        );
    }
    if !ready.scene().outlets.is_empty() {
        all.push("Grains in an outlet go every 1000 steps, not at the cadence of tsubu.".into());
    }
    all
}
