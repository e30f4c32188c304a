//! Law `Repulsion` for LAMMPS: `lj/cut` for the repulsion and `dpd/ext/tstat` at temperature 0 for the damping.
//!
//! Bodies of grains become frozen groups with pair constants of their own; a plane that only repels becomes a wall of the
//! same potential.

use super::super::ready::Ready;
use super::{AXES, Parts, refuse_plane};
use std::fmt::Write as _;
use tsubu_contact::{BodyLaw, Repulsion, RepulsionPair, WallGrains};
use tsubu_model::{ContactLaw, Kind, Space, Still};
use tsubu_scene::{SceneError, Shape};

/// Constants of one pair of types as LAMMPS takes them.
#[derive(Clone, Copy)]
struct Pair {
    epsilon: f64,
    sigma: f64,
    range: f64,
    normal: f64,
    tangential: f64,
}

impl From<RepulsionPair> for Pair {
    fn from(pair: RepulsionPair) -> Self {
        Self {
            epsilon: pair.epsilon24 / 24.0,
            sigma: pair.sigma2.sqrt(),
            range: pair.range2.sqrt(),
            normal: pair.normal_damping,
            tangential: pair.tangential_damping,
        }
    }
}

pub fn parts(ready: &Ready, law: &Repulsion, laws: &[BodyLaw]) -> Result<Parts, SceneError> {
    let kind = ready.constants.kind;
    let own = Pair::from(<Repulsion as ContactLaw<Space, Still>>::pair(
        law, &kind, &kind,
    ));
    let mut of_bodies = Vec::new();
    let (mut walls, mut removal, mut loads) = (Vec::new(), Vec::new(), Vec::new());
    for (number, wall) in laws.iter().enumerate() {
        let name = &ready.names[number];
        match wall {
            BodyLaw::Grains(law) => {
                let pair =
                    <WallGrains as ContactLaw<Space, Still>>::pair(law, &kind, &Kind::immovable());
                of_bodies.push(Pair::from(pair));
                walls.push(format!("group {name} type {}", of_bodies.len() + 1));
                walls.push(format!("compute load_{name} {name} reduce sum fx fy fz"));
                removal.push(vec![
                    format!("uncompute load_{name}"),
                    format!("delete_atoms group {name} compress no"),
                ]);
                loads.extend((1..=3).map(|k| format!("c_load_{name}[{k}]")));
            }
            BodyLaw::Surface(_) => {
                walls.extend(plane(ready, number, own)?);
                removal.push(vec![format!("unfix wall_{name}")]);
                loads.push(format!("f_wall_{name}[1]"));
            }
        }
    }
    // A removed body cannot be asked for its load any more.
    let goes = |wall: &tsubu_scene::Wall| wall.removed != tsubu_scene::Removal::Never;
    if ready.scene().walls.iter().any(goes) {
        loads.clear();
        walls.retain(|line| !line.starts_with("compute load_"));
        removal
            .iter_mut()
            .for_each(|r| r.retain(|line| !line.starts_with("uncompute")));
    }
    let bodies = of_bodies.len();
    let last = bodies + 1;
    if bodies > 0 {
        walls.push(format!("group frozen type 2:{last}"));
        walls.push("neigh_modify exclude group frozen frozen".into());
    }
    let pairs = move |share: f64| {
        let widest = of_bodies.iter().map(|p| p.range).fold(own.range, f64::max);
        let mut lines = vec![format!(
            "pair_style hybrid/overlay lj/cut {widest:?} dpd/ext/tstat 0.0 0.0 {widest:?} 1"
        )];
        // Only grains among themselves settle with a share of the damping, as in a run here.
        lines.extend(coefficients(1, &own, share));
        for (k, pair) in of_bodies.iter().enumerate() {
            lines.extend(coefficients(k + 2, pair, 1.0));
        }
        if !of_bodies.is_empty() {
            lines.push(format!("pair_coeff 2*{last} 2*{last} none"));
        }
        lines.push("pair_modify pair lj/cut shift yes".into());
        lines
    };
    Ok(Parts {
        style: "atom_style atomic",
        data: data(ready, bodies),
        pairs: Box::new(pairs),
        walls,
        removal,
        loads,
        integrate: "nve",
        differs: Vec::new(),
    })
}

fn coefficients(partner: usize, pair: &Pair, share: f64) -> [String; 2] {
    let Pair {
        epsilon,
        sigma,
        range,
        normal,
        tangential,
    } = pair;
    [
        format!("pair_coeff 1 {partner} lj/cut {epsilon:?} {sigma:?} {range:?}"),
        format!(
            "pair_coeff 1 {partner} dpd/ext/tstat {:?} {:?} 0 0 {range:?}",
            normal * share,
            tangential * share
        ),
    ]
}

/// A plane that only repels; grains of LAMMPS are points, so they touch it at the range of the law.
fn plane(ready: &Ready, number: usize, own: Pair) -> Result<Vec<String>, SceneError> {
    let (wall, name) = (&ready.scene().walls[number], &ready.names[number]);
    let of_grains = "or make it a body of grains: shape: Mesh(…, surface: Grains(radius: …)), restitution: None, friction: None";
    if wall.restitution.is_some() || wall.friction.is_some() {
        let field = if wall.friction.is_some() {
            "friction"
        } else {
            "restitution"
        };
        let what = format!(
            "has no wall with restitution and friction for grains without spin, as `{}` is",
            wall.name
        );
        let remedy = format!(
            "leave both out (--set walls.{0}.restitution=None --set walls.{0}.friction=None), {of_grains}",
            wall.name
        );
        return Err(ready.refuse(&format!("walls[{number}].{field}"), &what, &remedy));
    }
    let Shape::HalfSpace { point, outward } = wall.shape else {
        let what = format!(
            "has no wall of shape {} as `{}` is; only half-spaces are written",
            wall.shape.name(),
            wall.name
        );
        return Err(ready.refuse(
            &format!("walls[{number}].shape"),
            &what,
            &format!("make it half-spaces, {of_grains}"),
        ));
    };
    refuse_plane(ready, number, wall)?;
    // The scene's s is R + d/2 or R; LAMMPS takes the distance itself for s.
    let d = ready.diameter();
    let potential = format!("lj126 {:?} {:?} {:?}", own.epsilon, own.sigma, own.range);
    Ok(match ready.face(wall, d) {
        Some(face) => {
            let side = if face.up { "lo" } else { "hi" };
            vec![format!(
                "fix wall_{name} grains wall/lj126 {}{side} {:?} {:?} {:?} {:?}",
                AXES[face.axis], face.at, own.epsilon, own.sigma, own.range
            )]
        }
        None => {
            let p = ready.plane(wall, point, outward, d);
            vec![
                format!(
                    "region wall_{name} plane {:?} {:?} {:?} {:?} {:?} {:?}",
                    p.x, p.y, p.z, outward.x, outward.y, outward.z
                ),
                format!("fix wall_{name} grains wall/region wall_{name} {potential}"),
            ]
        }
    })
}

fn data(ready: &Ready, bodies: usize) -> String {
    let others: usize = ready.wall_grains.iter().map(Vec::len).sum();
    let atoms = ready.grains.len() + others;
    let mut text = ready.data_head(atoms, bodies + 1);
    text += "\nMasses\n\n";
    for kind in 1..=bodies + 1 {
        // What is frozen is never moved by a force; its mass is asked for and not used.
        let _ = writeln!(text, "{kind} {:?}", ready.constants.kind.mass);
    }
    text += "\nAtoms # atomic\n\n";
    let grains = ready.grains.iter().map(|(x, _)| (1, *x));
    let of_walls = ready.wall_grains.iter().filter(|w| !w.is_empty());
    let frozen = of_walls
        .enumerate()
        .flat_map(|(k, places)| places.iter().map(move |x| (k + 2, *x)));
    for (i, (kind, x)) in grains.chain(frozen).enumerate() {
        let _ = writeln!(text, "{} {kind} {:?} {:?} {:?}", i + 1, x.x, x.y, x.z);
    }
    text + &ready.velocities(others, "")
}
