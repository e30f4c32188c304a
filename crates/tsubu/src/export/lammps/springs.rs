//! Law `SpringDashpot` for LAMMPS: `gran/hooke/history`, whose damping is a rate times the reduced mass.

use super::super::ready::Ready;
use super::{AXES, Parts, refuse_plane};
use std::fmt::Write as _;
use tsubu_contact::{Normal, Slip, SpringDashpot, Tension};
use tsubu_scene::{SceneError, Shape};

/// Refuses the readings that neither LAMMPS nor LIGGGHTS has.
pub fn refuse_readings(ready: &Ready, law: &SpringDashpot) -> Result<(), SceneError> {
    if law.tension != Tension::NoPull {
        let what = "keeps the dashpot from pulling";
        return Err(ready.refuse("grains.law.tension", what, "write tension: NoPull"));
    }
    if law.slip != Slip::Total {
        let what = "limits spring and dashpot in its own way";
        return Err(ready.refuse("grains.law.slip", what, "write slip: Total"));
    }
    if law.normal != Normal::Closed {
        let what = "takes the normal spring from the overlap";
        return Err(ready.refuse(
            "grains.law.normal_force",
            what,
            "write normal_force: Closed",
        ));
    }
    Ok(())
}

/// kn, kt, γn, γt, μ and the flags of a contact of this reduced mass in kg.
fn constants(law: &SpringDashpot, reduced_mass: f64) -> String {
    format!(
        "{:?} {:?} {:?} {:?} {:?} 1 limit_damping",
        law.normal_stiffness,
        law.tangential_stiffness,
        law.normal_damping / reduced_mass,
        law.tangential_damping / reduced_mass,
        law.friction
    )
}

pub fn parts(
    ready: &Ready,
    law: &SpringDashpot,
    laws: &[SpringDashpot],
) -> Result<Parts, SceneError> {
    refuse_readings(ready, law)?;
    let mass = ready.constants.kind.mass;
    let (mut walls, mut removal) = (Vec::new(), Vec::new());
    for (number, of_wall) in laws.iter().enumerate() {
        walls.extend(plane(ready, number, of_wall)?);
        removal.push(vec![format!("unfix wall_{}", ready.names[number])]);
    }
    let law = *law;
    let pairs = move |share: f64| {
        let law = SpringDashpot {
            normal_damping: law.normal_damping * share,
            tangential_damping: law.tangential_damping * share,
            ..law
        };
        vec![
            // Two equal grains: the reduced mass is half of one.
            format!(
                "pair_style gran/hooke/history {}",
                constants(&law, 0.5 * mass)
            ),
            "pair_coeff * *".into(),
        ]
    };
    Ok(Parts {
        style: "atom_style sphere\nnewton off",
        data: data(ready),
        pairs: Box::new(pairs),
        walls,
        removal,
        loads: Vec::new(),
        integrate: "nve/sphere",
        differs: vec![
            "While a contact slides, LAMMPS stores the spring that with the dashpot makes up the friction; tsubu stores the spring's share of it. The force is the same, what is left when the slide ends is not.".into(),
        ],
    })
}

/// A plane; a wall has no mass, so the reduced mass is the grain's.
fn plane(ready: &Ready, number: usize, law: &SpringDashpot) -> Result<Vec<String>, SceneError> {
    let (wall, name) = (&ready.scene().walls[number], &ready.names[number]);
    let Shape::HalfSpace { point, outward } = wall.shape else {
        let what = format!(
            "has no wall of shape {} as `{}` is; only half-spaces are written",
            wall.shape.name(),
            wall.name
        );
        let remedy = "make it half-spaces, or write the scene for LIGGGHTS, which knows triangles (tsubu export liggghts)";
        return Err(ready.refuse(&format!("walls[{number}].shape"), &what, remedy));
    };
    refuse_plane(ready, number, wall)?;
    let reach = 0.5 * ready.diameter();
    let constants = constants(law, ready.constants.kind.mass);
    Ok(match ready.face(wall, reach) {
        Some(face) => {
            let (low, high) = if face.up {
                (format!("{:?}", face.at), "NULL".to_owned())
            } else {
                ("NULL".to_owned(), format!("{:?}", face.at))
            };
            vec![format!(
                "fix wall_{name} grains wall/gran hooke/history {constants} {}plane {low} {high}",
                AXES[face.axis]
            )]
        }
        None => {
            let p = ready.plane(wall, point, outward, reach);
            vec![
                format!(
                    "region wall_{name} plane {:?} {:?} {:?} {:?} {:?} {:?}",
                    p.x, p.y, p.z, outward.x, outward.y, outward.z
                ),
                format!(
                    "fix wall_{name} grains wall/gran/region hooke/history {constants} region wall_{name}"
                ),
            ]
        }
    })
}

/// Places with diameter and density, as both LAMMPS and LIGGGHTS read spheres.
pub fn spheres(ready: &Ready, types: usize, style: &str) -> String {
    let kind = ready.constants.kind;
    let d = kind.diameter();
    let density = kind.mass / (std::f64::consts::PI / 6.0 * d.powi(3));
    let mut text = ready.data_head(ready.grains.len(), types);
    let _ = write!(text, "\nAtoms{style}\n\n");
    for (i, (x, _)) in ready.grains.iter().enumerate() {
        let _ = writeln!(
            text,
            "{} 1 {d:?} {density:?} {:?} {:?} {:?}",
            i + 1,
            x.x,
            x.y,
            x.z
        );
    }
    text + &ready.velocities(0, " 0 0 0")
}

fn data(ready: &Ready) -> String {
    spheres(ready, 1, " # sphere")
}
