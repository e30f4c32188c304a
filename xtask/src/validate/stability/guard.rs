//! The guard against drawn scenes: it refuses every unstable one, no stable one, and names a step that then runs.
//!
//! The scenes are texts as a user writes them, of grains that lie in contact: on a floor or in a groove, in columns, in
//! clusters cut out of a hexagonal and of the fcc lattice, of both laws, in the plane and in space. Their limit comes from
//! the dense matrix of [`network`](super::network), with the contacts found here and the constants worked out here.

use super::network::{Link, Network, only};
use crate::validate::check::Tolerance;
use crate::validate::lab::Draw;
use crate::validate::report::Report;
use crate::validate::wca::Wca;
use glam::{DQuat, DVec3};
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use tsubu_assemble::{Choices, build};
use tsubu_contact::{Repulsion, restitution};
use tsubu_integrate::Scheme;
use tsubu_model::Kind;
use tsubu_scene::Source;

/// Scenes of either sort.
const SCENES: usize = 200;
/// Steps from the limit that are not drawn.
const APART: f64 = 1.05;
/// Overlap over the diameter.
const OVERLAP: f64 = 1e-5;
/// Steps of a run with the step that the guard names.
const RUN: u64 = 400;

const DIAMETER: f64 = 2e-3;
const DENSITY: f64 = 2500.0;

/// The law of a scene.
enum Law {
    /// E in Pa, γn and γt in kg/s, e of the walls.
    Repulsion {
        young: f64,
        damping: [f64; 2],
        walls: Option<f64>,
    },
    /// kn, kt in N/m, ηn, ηt in kg/s.
    Springs {
        stiffness: [f64; 2],
        damping: [f64; 2],
    },
}

/// A drawn scene without its step.
struct Scene {
    space: bool,
    law: Law,
    scheme: Scheme,
    places: Vec<DVec3>,
    /// Points and outward normals of plane walls.
    walls: Vec<(DVec3, DVec3)>,
}

impl Scene {
    fn draw(draw: &mut Draw) -> Self {
        let kind = Kind::sphere(DIAMETER, DENSITY);
        let space = draw.next() < 0.5;
        let (mut places, mut walls) = arrangement(draw, space);
        // In the plane everything turns about y; a cluster without walls lies anyhow.
        let turn = if space {
            DQuat::from_scaled_axis(DVec3::new(draw.next(), draw.next(), draw.next()) * TAU)
        } else {
            DQuat::from_rotation_y(draw.next() * TAU)
        };
        places.iter_mut().for_each(|x| *x = turn * *x);
        walls
            .iter_mut()
            .for_each(|(x, n)| (*x, *n) = (turn * *x, turn * *n));
        let zeta = draw.next();
        let across = draw.next();
        let (law, scheme) = if draw.next() < 0.6 {
            let young = 10f64.powf(6.0 + 3.0 * draw.next());
            let stiffness = young * Repulsion::sigma_for_diameter(DIAMETER);
            let damping = 2.0 * zeta * (stiffness * kind.mass).sqrt();
            let across = if across < 0.5 { 1.0 } else { across };
            let law = Law::Repulsion {
                young,
                damping: [damping, across * damping],
                walls: (draw.next() < 0.5).then(|| 0.3 + 0.6 * draw.next()),
            };
            let sweeps = [1, 2, 4][(draw.next() * 3.0) as usize];
            let schemes = [
                Scheme::SymplecticEuler,
                Scheme::VerletOld,
                Scheme::VerletAveraged { sweeps },
                Scheme::DashpotImplicit { sweeps },
            ];
            (law, schemes[(draw.next() * 4.0) as usize])
        } else {
            let stiffness = 10f64.powf(2.0 + 3.0 * draw.next());
            let damping = 2.0 * zeta * (stiffness * kind.mass).sqrt();
            let law = Law::Springs {
                stiffness: [stiffness, (0.2 + 0.8 * draw.next()) * stiffness],
                damping: [damping, across * damping],
            };
            let schemes = [Scheme::SymplecticEuler, Scheme::VerletOld];
            (law, schemes[(draw.next() * 2.0) as usize])
        };
        Self {
            space,
            law,
            scheme,
            places,
            walls,
        }
    }

    fn stiffness(&self) -> f64 {
        match self.law {
            Law::Repulsion { young, .. } => young * Repulsion::sigma_for_diameter(DIAMETER),
            Law::Springs { stiffness, .. } => stiffness[0],
        }
    }

    /// √(k/m) of one grain in 1/s.
    fn frequency(&self) -> f64 {
        (self.stiffness() / Kind::sphere(DIAMETER, DENSITY).mass).sqrt()
    }

    fn network(&self) -> Network {
        let kind = Kind::sphere(DIAMETER, DENSITY);
        let turns = matches!(self.law, Law::Springs { .. });
        let arm = if turns { kind.radius } else { 0.0 };
        let link = |i: usize, j: Option<usize>, apart: DVec3| {
            let (along, across) = match self.law {
                Law::Repulsion {
                    young,
                    damping,
                    walls,
                } => {
                    let sigma = Repulsion::sigma_for_diameter(DIAMETER);
                    let wca = Wca {
                        // E = k/σ, k = 72·2^(−1/3) ε/σ².
                        epsilon: young * sigma.powi(3) / (72.0 / 2f64.cbrt()),
                        sigma,
                    };
                    let k = wca.stiffness(apart.length());
                    let at_wall = 2.0
                        * walls.map_or(0.0, restitution::ratio_from_restitution)
                        * (kind.mass * wca.edge_stiffness()).sqrt();
                    if j.is_some() {
                        ([k, damping[0]], [0.0, damping[1]])
                    } else {
                        ([k, at_wall], [0.0; 2])
                    }
                }
                Law::Springs { stiffness, damping } => {
                    ([stiffness[0], damping[0]], [stiffness[1], damping[1]])
                }
            };
            Link {
                i,
                j,
                normal: apart.normalize(),
                along,
                across,
                arms: [arm, if j.is_some() { arm } else { 0.0 }],
            }
        };
        let mut links = Vec::new();
        for (i, a) in self.places.iter().enumerate() {
            for (j, b) in self.places.iter().enumerate().skip(i + 1) {
                if (*a - *b).length() < DIAMETER {
                    links.push(link(i, Some(j), *a - *b));
                }
            }
            for (point, outward) in &self.walls {
                let distance = (*a - *point).dot(*outward);
                if distance < kind.radius {
                    links.push(link(i, None, *outward * (distance + kind.radius)));
                }
            }
        }
        let free = match (self.space, turns) {
            (true, true) => only(&[0, 1, 2, 3, 4, 5]),
            (true, false) => only(&[0, 1, 2]),
            (false, true) => only(&[0, 2, 4]),
            (false, false) => only(&[0, 2]),
        };
        Network::new(self.places.len(), &kind, &links, free)
    }

    fn text(&self, step: f64) -> String {
        let mm = |x: DVec3| {
            let x = x * 1e3;
            format!(
                "(\"{:.12} mm\", \"{:.12} mm\", \"{:.12} mm\")",
                x.x,
                if self.space { x.y } else { 0.0 },
                x.z
            )
        };
        let mut walls = String::new();
        for (number, (point, outward)) in self.walls.iter().enumerate() {
            let e = match self.law {
                Law::Repulsion { walls: Some(e), .. } => format!(", restitution: {e:?}"),
                _ => String::new(),
            };
            let _ = write!(
                walls,
                "(name: \"w{number}\", shape: HalfSpace(point: {}, outward: ({:?}, {:?}, {:?})){e}),",
                mm(*point),
                outward.x,
                if self.space { outward.y } else { 0.0 },
                outward.z
            );
        }
        let law = match self.law {
            Law::Repulsion {
                young,
                damping: [n, t],
                ..
            } => format!(
                "Repulsion(stiffness: YoungModulus(\"{young:?} Pa\"), damping: Parts(normal: \"{n:?} kg/s\", tangential: \"{t:?} kg/s\"))"
            ),
            Law::Springs {
                stiffness: [kn, kt],
                damping: [n, t],
            } => format!(
                "SpringDashpot(constants: Given(normal_stiffness: \"{kn:?} N/m\", tangential_stiffness: \"{kt:?} N/m\", normal_damping: \"{n:?} kg/s\", tangential_damping: \"{t:?} kg/s\"), friction: 0.5)"
            ),
        };
        let scheme = match self.scheme.sweeps() {
            0 => self.scheme.name().to_owned(),
            sweeps => format!("{}(sweeps: {sweeps})", self.scheme.name()),
        };
        let grains: String = self
            .places
            .iter()
            .map(|&x| format!("(at: {}),", mm(x)))
            .collect();
        format!(
            "(title: \"drawn\", space: {}, gravity: \"0 m/s2\", grains: (diameter: \"{} mm\", density: \"{DENSITY} kg/m3\", law: {law}),
            walls: [{walls}], initial: (grains: [{grains}]),
            time: (step: Exactly(\"{step:?} s\"), integrator: {scheme}, steps: {RUN}), output: (animation: false))",
            if self.space { "Space" } else { "Plane" },
            DIAMETER * 1e3,
        )
    }
}

/// Places and walls, unturned; y = 0 in the plane.
fn arrangement(draw: &mut Draw, space: bool) -> (Vec<DVec3>, Vec<(DVec3, DVec3)>) {
    let pitch = DIAMETER * (1.0 - OVERLAP);
    // Half a pitch from a wall: as deep as two grains in each other.
    let floor = vec![(DVec3::ZERO, DVec3::Z)];
    let up = |j: usize| DVec3::Z * pitch * (0.5 + j as f64);
    let sort = draw.next();
    if sort < 0.15 {
        (vec![up(0)], floor)
    } else if sort < 0.3 {
        // A groove: the second wall leans by 40° to 140°.
        let lean = (40.0 + 100.0 * draw.next()).to_radians();
        let outward = DVec3::new(lean.sin(), 0.0, lean.cos());
        let point = up(0) - outward * (0.5 * pitch);
        (vec![up(0)], vec![floor[0], (point, outward)])
    } else if sort < 0.5 {
        let count = 2 + (draw.next() * 6.0) as usize;
        ((0..count).map(up).collect(), floor)
    } else {
        let count = 2 + (draw.next() * 9.0) as usize;
        (cluster(draw, count, space, pitch), Vec::new())
    }
}

/// A connected cluster of a hexagonal lattice, or in space of the fcc one.
fn cluster(draw: &mut Draw, count: usize, space: bool, pitch: f64) -> Vec<DVec3> {
    let root = 0.5f64.sqrt();
    let ways: Vec<DVec3> = if space {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .into_iter()
            .flat_map(|(a, b)| {
                [
                    DVec3::new(a, b, 0.0),
                    DVec3::new(a, 0.0, b),
                    DVec3::new(0.0, a, b),
                ]
            })
            .map(|way| way * root)
            .collect()
    } else {
        (0..6)
            .map(|k| {
                let (sin, cos) = (PI / 3.0 * f64::from(k)).sin_cos();
                DVec3::new(cos, 0.0, sin)
            })
            .collect()
    };
    let mut sites = vec![DVec3::ZERO];
    while sites.len() < count {
        let from = sites[(draw.next() * sites.len() as f64) as usize];
        let site = from + ways[(draw.next() * ways.len() as f64) as usize];
        if sites.iter().all(|other| (site - *other).length() > 0.5) {
            sites.push(site);
        }
    }
    sites.into_iter().map(|site| site * pitch).collect()
}

/// What the guard said of a scene with this step: the step that it names if it refused.
fn asked(scene: &Scene, step: f64) -> Result<Option<f64>, String> {
    let text = scene.text(step);
    let checked = Source::from_text("drawn", &text)
        .check()
        .map_err(|e| format!("{e}\n{text}"))?;
    match build(&checked, &one_thread()) {
        Ok(_) => Ok(None),
        Err(error) => {
            let message = error.to_string();
            let named = message.split("use a step below ").nth(1);
            let named = named.and_then(|rest| rest.split(' ').next()?.parse().ok());
            match named.filter(|_| message.contains("is over its limit")) {
                Some(step) => Ok(Some(step)),
                None => Err(message),
            }
        }
    }
}

fn one_thread() -> Choices {
    Choices {
        threads: Some(1),
        ..Choices::default()
    }
}

/// True if the scene runs with this step: accepted, without trouble, and no faster than its overlaps can make it.
fn runs(scene: &Scene, step: f64) -> Result<bool, String> {
    let checked = Source::from_text("drawn", &scene.text(step))
        .check()
        .map_err(|e| e.to_string())?;
    let Ok(built) = build(&checked, &one_thread()) else {
        return Ok(false);
    };
    let mut run = built.simulation;
    run.advance(RUN);
    // All that the contacts hold, in one grain.
    let contacts = 6.0 * scene.places.len() as f64;
    let most = 2.0 * scene.frequency() * OVERLAP * DIAMETER * contacts.sqrt();
    let fastest = run
        .state()
        .iter()
        .map(|(_, v)| v.length())
        .fold(0.0, f64::max);
    Ok(run.steps() == RUN && fastest < most)
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    let mut draw = Draw(11);
    let (mut unstable, mut stable) = (0, 0);
    let (mut refused, mut wrongly, mut named, mut least) = (0, 0, 0, f64::INFINITY);
    let mut drawn = 0;
    while unstable < SCENES || stable < SCENES {
        drawn += 1;
        if drawn > 20 * SCENES {
            return Err("too few scenes have a limit".into());
        }
        let scene = Scene::draw(&mut draw);
        let network = scene.network();
        let most = 50.0 / scene.frequency();
        let Some(limit) = network.limit(scene.scheme, most) else {
            continue;
        };
        // Half of them within a third of the limit.
        let over = draw.next() < 0.5;
        let way = APART
            * if draw.next() < 0.5 {
                1.0 + 0.3 * draw.next()
            } else {
                1.0 + 4.0 * draw.next()
            };
        let step = if over { limit * way } else { limit / way };
        // The limit of a solve that stops early may be none further up: what is near must be on one side.
        let sides =
            [1.0 / APART, 1.0, APART].map(|share| network.used(scene.scheme, share * step) >= 1.0);
        if sides != [over; 3] {
            continue;
        }
        if over && unstable < SCENES {
            unstable += 1;
            if let Some(step) = asked(&scene, step)? {
                refused += 1;
                named += usize::from(runs(&scene, step)?);
                least = least.min(step / limit);
            } else {
                eprintln!("  accepted at {way:.2} of its limit:\n{}", scene.text(step));
            }
        } else if !over && stable < SCENES {
            stable += 1;
            if asked(&scene, step)?.is_some() {
                wrongly += 1;
                eprintln!(
                    "  refused at 1/{way:.2} of its limit:\n{}",
                    scene.text(step)
                );
            }
        }
    }
    let all = SCENES as f64;
    let note = "limits by the dense matrix of the scene's contacts; 5 % or more away from them";
    let exactly = Tolerance::Absolute(0.0);
    report.check(
        "unstable scenes of 200 that the guard refuses",
        all,
        refused as f64,
        exactly,
        note,
    );
    report.check(
        "stable scenes of 200 that the guard refuses",
        0.0,
        wrongly as f64,
        exactly,
        note,
    );
    report.check(
        "refused scenes of 200 that run with the step that the guard names",
        all,
        named as f64,
        exactly,
        "400 steps, no faster than the overlaps can make them",
    );
    report.check(
        "the step that the guard names over the exact limit, the least",
        0.9,
        least,
        Tolerance::AtLeast,
        "halved in 64 parts of a factor of two, and 2 % off",
    );
    Ok(())
}
