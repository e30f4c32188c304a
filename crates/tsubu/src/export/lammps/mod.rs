//! Decks of LAMMPS: law `Repulsion` as its two pair styles, law `SpringDashpot` as `gran/hooke/history`.

mod repulsion;
mod springs;

pub use springs::{refuse_readings, spheres};

use super::ready::Ready;
use super::timeline::{Act, Timeline};
use super::{DATA, DUMP, Deck, INPUT};
use glam::DVec3;
use tsubu_assemble::Law;
use tsubu_scene::{Course, SceneError, Wall};

/// The letters of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The parts of a deck that the law decides.
struct Parts {
    /// Atom style and what it needs.
    style: &'static str,
    data: String,
    /// Pair styles and their constants at a share of the damping.
    pairs: Box<dyn Fn(f64) -> Vec<String>>,
    /// What follows the data: groups, walls.
    walls: Vec<String>,
    /// What each wall's removal takes.
    removal: Vec<Vec<String>>,
    /// What the load on each wall is called, for the table of the log.
    loads: Vec<String>,
    integrate: &'static str,
    differs: Vec<String>,
}

/// The deck of a scene.
pub fn deck(ready: &Ready) -> Result<Deck, SceneError> {
    let parts = match &ready.constants.law {
        Law::Repulsion(of) => {
            let walls: Vec<_> = of.walls.iter().map(|wall| wall.laws()[0]).collect();
            repulsion::parts(ready, of.law(), &walls)?
        }
        Law::SpringDashpot(of) => {
            let walls: Vec<_> = of.walls.iter().map(|wall| wall.laws()[0]).collect();
            springs::parts(ready, of.law(), &walls)?
        }
        Law::HertzMindlin(_) | Law::HertzMindlinRolling(_) => {
            let what = "has a law of Hertz and Mindlin, but with another damping: the restitution would not be the one asked for";
            let remedy = "write law SpringDashpot or Repulsion";
            return Err(ready.refuse("grains.law", what, remedy));
        }
    };
    let timeline = Timeline::of(ready)?;
    let mut lines = head(ready, &parts);
    lines.extend((parts.pairs)(timeline.damping()));
    lines.extend(parts.walls.iter().cloned());
    lines.extend(forces(ready, &parts));
    let act = |act| match act {
        Act::FullDamping => (parts.pairs)(1.0),
        Act::Remove(wall) => parts.removal[wall].clone(),
        Act::Start(wall) => started(ready, wall),
        Act::Stop(wall) => vec![
            format!("unfix move_{0}", ready.names[wall]),
            format!("velocity {} set 0 0 0", ready.names[wall]),
        ],
    };
    lines.extend(timeline.commands(ready, &act, &|steps| vec![format!("run {steps}")]));
    Ok(Deck {
        target: ready.target,
        files: vec![
            (INPUT.into(), lines.join("\n") + "\n"),
            (DATA.into(), parts.data),
        ],
        differs: differs(ready, parts.differs),
        grains: ready.grains.len(),
        wall_grains: ready.wall_grains.iter().map(Vec::len).sum(),
    })
}

fn head(ready: &Ready, parts: &Parts) -> Vec<String> {
    let boundary = ready.periodic().map(|p| if p { "p" } else { "s" });
    let mut lines = vec![
        format!("# {}", ready.title()),
        "# Written by `tsubu export lammps`; SI units. README.md says how to run it and what differs.".into(),
        format!("variable skin index {:?}", ready.skin()),
        "variable digits index 9".into(),
        "units si".into(),
        parts.style.into(),
        format!("boundary {}", boundary.join(" ")),
        "comm_modify vel yes".into(),
    ];
    // A bed is cut along its floor, so that no process holds air only.
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

/// Weight, integration, outlets, and what is written.
fn forces(ready: &Ready, parts: &Parts) -> Vec<String> {
    let scene = ready.scene();
    let mut lines = Vec::new();
    if scene.gravity > 0.0 {
        lines.push(format!(
            "fix weight grains gravity {:?} vector 0 0 -1",
            scene.gravity
        ));
    }
    lines.push(format!("fix drift grains {}", parts.integrate));
    for (number, outlet) in scene.outlets.iter().enumerate() {
        let (a, b) = (outlet.region.min, outlet.region.max);
        lines.push(format!(
            "region outlet_{number} block {:?} {:?} {:?} {:?} {:?} {:?}",
            a.x, b.x, a.y, b.y, a.z, b.z
        ));
        lines.push(format!(
            "fix outlet_{number} grains evaporate 1000 1000000 outlet_{number} 1"
        ));
    }
    if !(ready.periodic()[0] && ready.periodic()[1]) {
        // Without it a process could hold air only.
        lines.push("fix even all balance 1000 1.1 shift xyz 10 1.05".into());
    }
    lines.push(format!("timestep {:?}", ready.constants.dt));
    lines.push("compute ke grains ke".into());
    lines.push("thermo 1000".into());
    lines.push(format!(
        "thermo_style custom step atoms c_ke {}",
        parts.loads.join(" ")
    ));
    lines.push("thermo_modify lost error flush yes".into());
    if let Some(frames) = ready.frames {
        lines.push(format!("variable every index {frames}"));
        lines.push(format!(
            "dump frames grains custom ${{every}} {DUMP} id type x y z vx vy vz"
        ));
        lines.push("dump_modify frames sort id first yes format float %.${digits}g".into());
    }
    lines
}

/// A body of grains begins to move.
fn started(ready: &Ready, number: usize) -> Vec<String> {
    let name = &ready.names[number];
    let Some(motion) = &ready.scene().walls[number].motion else {
        return Vec::new();
    };
    let three = |v: DVec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
    let how = match (&motion.turn, motion.shifts.first()) {
        (Some(turn), _) => {
            let axis = turn.axis * turn.rate.signum();
            let period = std::f64::consts::TAU / turn.rate.abs();
            format!(
                "rotate {} {} {period:?} units box",
                three(turn.point),
                three(axis)
            )
        }
        (None, Some(shift)) => match shift.course {
            Course::Steady(speed) => format!("linear {} units box", three(shift.direction * speed)),
            Course::Swing {
                amplitude,
                frequency,
            } => format!(
                "wiggle {} {:?} units box",
                three(shift.direction * amplitude),
                1.0 / frequency
            ),
        },
        (None, None) => return Vec::new(),
    };
    vec![format!("fix move_{name} {name} move {how}")]
}

/// Refuses a plane that moves or that lies across a period: the walls of LAMMPS that are planes rest.
fn refuse_plane(ready: &Ready, number: usize, wall: &Wall) -> Result<(), SceneError> {
    if wall.motion.is_some() {
        let what = format!("keeps the plane `{}` at rest", wall.name);
        let remedy = "leave its motion out, or make it a body of grains";
        return Err(ready.refuse(&format!("walls[{number}].motion"), &what, remedy));
    }
    let across = ready.face(wall, 0.0).filter(|f| ready.periodic()[f.axis]);
    if across.is_some() {
        let what = format!("has no plane across a periodic axis, as `{}` is", wall.name);
        return Err(ready.refuse(&format!("walls[{number}].shape"), &what, "open that axis"));
    }
    Ok(())
}

/// What holds of every deck, and what the law adds.
fn differs(ready: &Ready, of_law: Vec<String>) -> Vec<String> {
    let mut all = of_law;
    if ready.scene().time.integrator == tsubu_scene::Integrator::SymplecticEuler {
        all.push("It starts with half a kick (velocity Verlet, damping from the half-step velocity): places are those of SymplecticEuler but for that first half kick, velocities are half a step older.".into());
    }
    if !ready.scene().outlets.is_empty() {
        all.push("Grains in an outlet go every 1000 steps, not at the cadence of tsubu.".into());
    }
    all
}
