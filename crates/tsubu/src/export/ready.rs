//! What both targets need of a scene: its constants, its grains, its walls; and what neither can say.

use super::Target;
use glam::DVec3;
use std::fmt::Write as _;
use std::sync::Arc;
use tsubu_assemble::{Choices, Constants, Plan, Simulation, build, wall_grains};
use tsubu_model::Shell;
use tsubu_scene::{
    Axis, Checked, Fate, Initial, Integrator, Scene, SceneError, Space, TouchesAt, Wall,
};

/// A scene worked out for a deck.
pub struct Ready<'a> {
    pub target: Target,
    pub checked: &'a Checked,
    pub constants: Constants,
    /// Places and velocities in order of identity.
    pub grains: Vec<(DVec3, DVec3)>,
    /// The wall grains of each wall; none of one that is a surface.
    pub wall_grains: Vec<Vec<DVec3>>,
    /// The triangles of each wall that has some.
    pub shells: Vec<Option<Arc<Shell>>>,
    /// Names of the walls, fit for the other engine.
    pub names: Vec<String>,
    /// Steps between frames, if frames are wanted.
    pub frames: Option<u64>,
    /// Steps from the start, or from the moment of stillness.
    pub steps: u64,
}

impl<'a> Ready<'a> {
    pub fn of(
        target: Target,
        checked: &'a Checked,
        choices: &Choices,
        frames: &dyn Fn(&Plan) -> Option<u64>,
    ) -> Result<Self, SceneError> {
        refuse(target, checked)?;
        let built = build(checked, choices)?;
        let mut shells = vec![None; checked.scene.walls.len()];
        for machine in built.simulation.machines() {
            shells[machine.number] = machine.shell;
        }
        Ok(Self {
            target,
            checked,
            grains: Simulation::state(&*built.simulation),
            wall_grains: wall_grains(checked)?,
            shells,
            names: names(&checked.scene.walls),
            frames: frames(&built.plan),
            steps: built.plan.steps,
            constants: built.plan.constants,
        })
    }

    pub fn scene(&self) -> &Scene {
        &self.checked.scene
    }

    /// A refusal: `what` follows the target's name.
    pub fn refuse(&self, path: &str, what: &str, remedy: &str) -> SceneError {
        refusal(self.target, self.checked, path, what, remedy)
    }

    /// Diameter of a grain in m.
    pub fn diameter(&self) -> f64 {
        self.constants.kind.diameter()
    }

    /// Which axes are periodic.
    pub fn periodic(&self) -> [bool; 3] {
        let domain = self.scene().domain;
        [domain.x, domain.y, domain.z].map(|axis| axis != Axis::Open)
    }

    /// The box that all of it stands in, a grain's diameter wider along open axes.
    pub fn room(&self) -> [DVec3; 2] {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let shells = self.shells.iter().flatten().flat_map(|s| &s.vertices);
        let places = self.grains.iter().map(|g| &g.0);
        for &x in places
            .chain(self.wall_grains.iter().flatten())
            .chain(shells)
        {
            (low, high) = (low.min(x), high.max(x));
        }
        (low, high) = (low - self.diameter(), high + self.diameter());
        let domain = self.scene().domain;
        for (k, axis) in [domain.x, domain.y, domain.z].into_iter().enumerate() {
            if let Axis::Periodic(length) = axis {
                (low[k], high[k]) = (0.0, length);
            }
        }
        [low, high]
    }

    /// Head of a data file: counts and the box.
    pub fn data_head(&self, atoms: usize, types: usize) -> String {
        let [low, high] = self.room();
        let mut text = format!(
            "# {}\n\n{atoms} atoms\n{types} atom types\n\n",
            self.title()
        );
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let _ = writeln!(text, "{:?} {:?} {axis}lo {axis}hi", low[k], high[k]);
        }
        text
    }

    /// The section `Velocities`, with as many zeros after the three components as the atom style wants; empty at rest.
    pub fn velocities(&self, others: usize, zeros: &str) -> String {
        if self.grains.iter().all(|(_, v)| *v == DVec3::ZERO) {
            return String::new();
        }
        let mut text = "\nVelocities\n\n".to_owned();
        let resting = std::iter::repeat_n(DVec3::ZERO, others);
        for (i, v) in self.grains.iter().map(|g| g.1).chain(resting).enumerate() {
            let _ = writeln!(text, "{} {:?} {:?} {:?}{zeros}", i + 1, v.x, v.y, v.z);
        }
        text
    }

    /// The title, on one line.
    pub fn title(&self) -> String {
        self.scene().title.replace(['\n', '\r'], " ")
    }

    /// The skin that the deck starts with, in m: some hundredths of a grain serve a bed, and a run may set another.
    pub fn skin(&self) -> f64 {
        let share = self.scene().skin.unwrap_or(0.08);
        share * self.diameter()
    }

    /// A wall that is a plane along an axis: the axis, whether it looks up that axis, and where it stands when grains of
    /// the target touch it at a distance of `reach` in m from their centre.
    pub fn face(&self, wall: &Wall, reach: f64) -> Option<Face> {
        let tsubu_scene::Shape::HalfSpace { point, outward } = wall.shape else {
            return None;
        };
        let axis = (0..3).find(|&k| outward[k].abs() > 1.0 - 1e-12)?;
        let up = outward[axis] > 0.0;
        let at = self.plane(wall, point, outward, reach)[axis];
        Some(Face { axis, up, at })
    }

    /// The point of a plane moved so that the target, whose grains touch it at `reach` from their centre, gives the contact
    /// of the scene, where s = R + d/2 or s = R.
    pub fn plane(&self, wall: &Wall, point: DVec3, outward: DVec3, reach: f64) -> DVec3 {
        let d = self.diameter();
        let touches = match wall.touches_at {
            TouchesAt::Surface => 0.5 * d,
            TouchesAt::Centre => d,
        };
        point + outward * (touches - reach)
    }
}

/// A plane along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    pub axis: usize,
    /// True if the grains are on the side of larger coordinates.
    pub up: bool,
    pub at: f64,
}

/// What neither target is told.
fn refuse(target: Target, checked: &Checked) -> Result<(), SceneError> {
    let scene = &checked.scene;
    let no =
        |path: &str, what: &str, remedy: &str| Err(refusal(target, checked, path, what, remedy));
    if scene.water.is_some() {
        return no(
            "water",
            "has no such water over a bed",
            "run the scene here",
        );
    }
    if !scene.grains.populations.is_empty() {
        let what = "is not given mixtures yet";
        return no(
            "grains.populations",
            what,
            "leave the populations out, or run it here",
        );
    }
    if let Some(wall) = scene.walls.iter().position(|wall| wall.material.is_some()) {
        let remedy = "give the wall its restitution and friction instead";
        return no(
            &format!("walls[{wall}].material"),
            "is not given materials yet",
            remedy,
        );
    }
    if scene.space == Space::Plane {
        return no(
            "space",
            "is given scenes in space only",
            "write space: Space, or run it here",
        );
    }
    if matches!(scene.initial, Initial::Bed(_)) {
        let remedy = "fill a region, or start from a file";
        return no(
            "initial.bed",
            "cannot be given a bed with its fixed row",
            remedy,
        );
    }
    if !matches!(
        scene.time.integrator,
        Integrator::SymplecticEuler | Integrator::VerletOld
    ) {
        let what = "takes the damping at the half-step velocity and knows no other scheme";
        return no(
            "time.integrator",
            what,
            "write SymplecticEuler or VerletOld",
        );
    }
    if let Some(inlet) = scene.inlets.first() {
        let what = format!(
            "is not told of inlet `{}`, which keeps a box filled",
            inlet.name
        );
        return no(
            "inlets",
            &what,
            "leave the inlet out, and fill a larger region at the start",
        );
    }
    for (number, outlet) in scene.outlets.iter().enumerate() {
        if outlet.then != Fate::Delete {
            let what = format!(
                "cannot put the grains of outlet `{}` back at random places",
                outlet.name
            );
            let path = format!("outlets[{number}].then");
            let remedy = format!(
                "write then: Delete (--set outlets.{}.then=Delete)",
                outlet.name
            );
            return no(&path, &what, &remedy);
        }
    }
    for (number, wall) in scene.walls.iter().enumerate() {
        let Some(motion) = &wall.motion else { continue };
        if motion.shifts.len() + usize::from(motion.turn.is_some()) > 1 {
            let what = format!("gives wall `{}` one motion, a turn or a shift", wall.name);
            let path = format!("walls[{number}].motion");
            return no(&path, &what, "leave one of them");
        }
    }
    Ok(())
}

fn refusal(target: Target, checked: &Checked, path: &str, what: &str, remedy: &str) -> SceneError {
    checked.problem(path, format!("{} {what}", target.title()), remedy)
}

/// Names of letters, digits and underscores, no two alike.
fn names(walls: &[Wall]) -> Vec<String> {
    let plain = |wall: &Wall| -> String {
        let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        wall.name.chars().map(letter).collect()
    };
    let mut names: Vec<String> = Vec::new();
    for (number, wall) in walls.iter().enumerate() {
        let name = plain(wall);
        let taken = names.contains(&name);
        names.push(if taken {
            format!("{name}_{number}")
        } else {
            name
        });
    }
    names
}
