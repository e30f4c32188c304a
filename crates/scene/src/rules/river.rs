//! The rules of springs and dashpots, of a bed and of the water over it.

use super::Rules;
use crate::raw::{
    RawBed, RawBedMeasure, RawDatum, RawNormalForce, RawSlip, RawSpringConstants, RawTension,
    RawTurbulence, RawWater,
};
use crate::scene::{
    Axis, Bed, BedMeasure, Datum, Domain, Flow, FlowProfile, Grains, Initial, Integrator, Law,
    NormalForce, Scene, Slip, Space, SpringConstants, SpringDashpot, Tension, Turbulence, Water,
};

/// Paper B's water where the scene does not say.
const FREQUENCY: f64 = 50.0;
const DEPTH: f64 = 0.20;
const SHELTER: f64 = 0.4;
const BED_CONTACTS: u64 = 2;
const SKIP: f64 = 0.25;

/// What the raw law says beside its constants.
pub(super) struct Readings<'a> {
    pub poisson: Option<f64>,
    pub friction: f64,
    pub tension: &'a Option<RawTension>,
    pub slip: &'a Option<RawSlip>,
    pub normal_force: &'a Option<RawNormalForce>,
}

impl Rules<'_> {
    pub(super) fn springs(&mut self, raw: &RawSpringConstants, readings: &Readings) -> Law {
        let path = |field: &str| format!("grains.law.constants.{field}");
        let constants = match raw {
            RawSpringConstants::FromTimeStep { step, tn, cn, beta } => {
                SpringConstants::FromTimeStep {
                    step: self.above_zero(&path("step"), "the step", step.0),
                    tn: self.above_zero(&path("tn"), "tn", tn.0),
                    cn: self.not_negative(&path("cn"), "cn", cn.0),
                    beta: self.above_zero(&path("beta"), "beta", beta.map_or(1.0, |beta| beta.0)),
                }
            }
            RawSpringConstants::FromRestitution {
                normal_stiffness,
                restitution,
            } => {
                if !(restitution.0 > 0.0 && restitution.0 <= 1.0) {
                    self.refuse(
                        path("restitution"),
                        "the restitution is outside (0, 1]",
                        "1 returns all the speed",
                    );
                }
                SpringConstants::FromRestitution {
                    normal_stiffness: self.above_zero(
                        &path("normal_stiffness"),
                        "the stiffness",
                        normal_stiffness.0,
                    ),
                    restitution: restitution.0,
                }
            }
            RawSpringConstants::Given {
                normal_stiffness,
                tangential_stiffness,
                normal_damping,
                tangential_damping,
            } => {
                let mut part = |field: &str, name: &str, value: f64| {
                    self.not_negative(&path(field), name, value)
                };
                SpringConstants::Given {
                    tangential_stiffness: tangential_stiffness
                        .map(|k| part("tangential_stiffness", "the stiffness", k.0)),
                    normal_damping: part("normal_damping", "the damping", normal_damping.0),
                    tangential_damping: tangential_damping
                        .map(|c| part("tangential_damping", "the damping", c.0)),
                    normal_stiffness: self.above_zero(
                        &path("normal_stiffness"),
                        "the stiffness",
                        normal_stiffness.0,
                    ),
                }
            }
        };
        let poisson = readings.poisson.unwrap_or(0.3);
        if !(0.0..=0.5).contains(&poisson) {
            self.refuse(
                "grains.law.poisson",
                "Poisson's ratio is outside [0, 0.5]",
                "0.3 is usual",
            );
        }
        Law::SpringDashpot(SpringDashpot {
            constants,
            poisson,
            friction: self.not_negative("grains.law.friction", "the friction", readings.friction),
            tension: match readings.tension {
                None | Some(RawTension::NoPull) => Tension::NoPull,
                Some(RawTension::AsPrinted) => Tension::AsPrinted,
            },
            slip: match readings.slip {
                None | Some(RawSlip::Total) => Slip::Total,
                Some(RawSlip::AsPrinted) => Slip::AsPrinted,
            },
            normal_force: match readings.normal_force {
                None | Some(RawNormalForce::Closed) => NormalForce::Closed,
                Some(RawNormalForce::Incremental) => NormalForce::Incremental,
            },
        })
    }

    pub(super) fn bed(&mut self, raw: &RawBed, domain: &Domain) -> Bed {
        let usual = |value: &Option<crate::quantity::Number>, usual: f64| {
            value.as_ref().map_or(usual, |value| value.0)
        };
        if raw.layers.0 == 0 {
            self.refuse(
                "initial.bed.layers",
                "a bed needs at least one layer above its fixed row",
                "write layers: 10",
            );
        }
        let mut within = |field: &str, value: f64, low: f64, high: f64, why: &str| {
            if !(low..=high).contains(&value) {
                self.refuse(
                    format!("initial.bed.{field}"),
                    format!("{field} is outside [{low}, {high}]"),
                    why,
                );
            }
            value
        };
        let bed = Bed {
            layers: raw.layers.0.min(1_000_000) as usize,
            spacing: within(
                "spacing",
                usual(&raw.spacing, 1.07),
                1.0,
                2.0,
                "it is the distance of the lattice over the diameter, usually 1.05 to 1.10",
            ),
            vacancies: within(
                "vacancies",
                usual(&raw.vacancies, 0.1),
                0.0,
                0.5,
                "it is the share of the lattice that is left empty: with more than half the layers are none",
            ),
            roughness: within(
                "roughness",
                usual(&raw.roughness, 1.0 / 3.0),
                0.0,
                1.0,
                "it is the standard deviation of the fixed row's heights over the diameter",
            ),
            seed: raw.seed.map_or(1, |seed| seed.0),
        };
        let periodic = |axis: Axis| matches!(axis, Axis::Periodic(_));
        for (name, axis) in [("x", domain.x), ("y", domain.y)] {
            if !periodic(axis) && (name == "x" || self.space == Space::Space) {
                self.refuse(
                    "initial.bed",
                    format!("a bed has no sides, but the axis {name} does not repeat"),
                    format!("write domain: ({name}: Periodic(\"20 mm\"), …)"),
                );
            }
        }
        bed
    }

    pub(super) fn water(&mut self, raw: &RawWater) -> Option<Water> {
        self.exactly_one(
            "water",
            &[
                raw.shields.is_some(),
                raw.friction_velocity.is_some(),
                raw.friction_velocity_over_time.is_some(),
            ],
        );
        let flow = match (
            &raw.shields,
            &raw.friction_velocity,
            &raw.friction_velocity_over_time,
        ) {
            (Some(shields), ..) => {
                Flow::Shields(self.above_zero("water.shields", "the Shields number", shields.0))
            }
            (None, Some(speed), _) => Flow::FrictionVelocity(self.above_zero(
                "water.friction_velocity",
                "the friction velocity",
                speed.0,
            )),
            (None, None, Some(rows)) => {
                let rows: Vec<[f64; 2]> = rows.iter().map(|(t, u)| [t.0, u.0]).collect();
                self.rising("water.friction_velocity_over_time", "times", &rows);
                Flow::OverTime(rows)
            }
            (None, None, None) => return None,
        };
        let profile = match &raw.profile {
            None => FlowProfile::Log {
                karman: self.above_zero(
                    "water.karman",
                    "von Kármán's constant",
                    raw.karman.map_or(0.40, |karman| karman.0),
                ),
            },
            Some(rows) => {
                if raw.karman.is_some() {
                    self.refuse(
                        "water.karman",
                        "a given profile has no von Kármán constant: it would be ignored",
                        "remove karman, or the profile",
                    );
                }
                let rows: Vec<[f64; 2]> = rows.iter().map(|(y, u)| [y.0, u.0]).collect();
                self.rising("water.profile", "heights", &rows);
                FlowProfile::Given(rows)
            }
        };
        let turbulence = match raw.turbulence {
            Some(RawTurbulence::Off) => Turbulence::Off,
            None => Turbulence::Switched {
                frequency: FREQUENCY,
                depth: DEPTH,
                seed: 1,
            },
            Some(RawTurbulence::Switched {
                frequency,
                depth,
                seed,
            }) => Turbulence::Switched {
                frequency: self.above_zero(
                    "water.turbulence.frequency",
                    "the frequency",
                    frequency.map_or(FREQUENCY, |f| f.0),
                ),
                depth: self.above_zero(
                    "water.turbulence.depth",
                    "the depth",
                    depth.map_or(DEPTH, |h| h.0),
                ),
                seed: seed.map_or(1, |seed| seed.0),
            },
        };
        let shelter = raw.shelter.map_or(SHELTER, |shelter| shelter.0);
        if !(0.0..=1.0).contains(&shelter) {
            self.refuse(
                "water.shelter",
                "the shelter is outside [0, 1]",
                "it is the share of the drag that is left at the bed; 1 is no shelter",
            );
        }
        let slope = raw.slope.map_or(0.0, |slope| slope.0);
        if slope.abs() >= 1.0 {
            self.refuse(
                "water.slope",
                "the slope is 45 degrees or more",
                "it is the tangent of the bed's slope, such as 0.01",
            );
        }
        Some(Water {
            flow,
            begins: self.not_negative("water.begins", "the time", raw.begins.map_or(0.0, |t| t.0)),
            density: self.above_zero(
                "water.density",
                "the density",
                raw.density.map_or(1000.0, |rho| rho.0),
            ),
            added_mass: self.not_negative(
                "water.added_mass",
                "the added mass",
                raw.added_mass.map_or(0.5, |c| c.0),
            ),
            drag: self.not_negative("water.drag", "the drag", raw.drag.map_or(0.4, |c| c.0)),
            profile,
            turbulence,
            shelter,
            datum: match raw.datum {
                None | Some(RawDatum::Renewed) => Datum::Renewed,
                Some(RawDatum::Frozen) => Datum::Frozen,
                Some(RawDatum::Given(height)) => Datum::Given(height.0),
            },
            bed_contacts: raw
                .bed_contacts
                .map_or(BED_CONTACTS, |n| n.0)
                .min(u64::from(u32::MAX)) as u32,
            slope,
            drag_by_volume: raw.coarse_drag.is_some(),
        })
    }

    /// Rows whose first number rises and whose second is not negative.
    fn rising(&mut self, path: &str, name: &str, rows: &[[f64; 2]]) {
        if rows.is_empty() {
            self.refuse(path, "the table has no rows", "write at least one row");
        }
        if rows.windows(2).any(|pair| pair[1][0] <= pair[0][0]) {
            self.refuse(
                path,
                format!("the {name} do not rise"),
                "write the rows in rising order, each once",
            );
        }
        if rows.iter().any(|row| row[1] < 0.0) {
            self.refuse(
                path,
                "a velocity of the table is negative",
                "the water flows along +x: write zero or more",
            );
        }
    }

    pub(super) fn bed_measure(
        &mut self,
        raw: &Option<RawBedMeasure>,
        water: bool,
    ) -> Option<BedMeasure> {
        let skip = raw
            .as_ref()
            .and_then(|raw| raw.skip)
            .map_or(SKIP, |skip| skip.0);
        if !(0.0..1.0).contains(&skip) {
            self.refuse(
                "measures.bed.skip",
                "skip is outside [0, 1)",
                "it is the share of the flow's time that is dropped before means are taken",
            );
        }
        if raw.is_some() && !water {
            self.refuse(
                "measures.bed",
                "no water moves a bed here, so this measure would be ignored",
                "remove it, or add water: (shields: 0.5)",
            );
        }
        water.then_some(BedMeasure { skip })
    }

    /// What law, bed and water ask of the rest of the scene.
    pub(super) fn river(&mut self, scene: &Scene) {
        let springs = matches!(scene.grains.law, Law::SpringDashpot(_));
        if springs {
            self.with_springs(scene);
        }
        if matches!(scene.initial, Initial::Bed(_)) && !springs {
            self.refuse(
                "initial.bed",
                "a bed needs grains that hold by friction",
                "write law: SpringDashpot(…)",
            );
        }
        let Some(water) = &scene.water else { return };
        if !springs || !matches!(scene.initial, Initial::Bed(_)) {
            self.refuse(
                "water",
                "water without a bed: nothing says where its bottom is",
                "write initial: (bed: (layers: 10)) and law: SpringDashpot(…), or remove the water",
            );
        }
        if scene.gravity == 0.0 {
            self.refuse(
                "gravity",
                "water needs gravity: the Shields number is measured against weight",
                "give gravity a value",
            );
        }
        self.sinks(&scene.grains, water);
        if scene.grains.coarse > 0 && !water.drag_by_volume {
            self.refuse(
                "water",
                "coarse grains in water need a named rule: their drag grows as λ², their weight as λ³",
                "write coarse_drag: ByVolume, which gives a coarse grain the drag of the grains it stands for; or coarse: 0",
            );
        }
        if scene.grains.coarse == 0 && water.drag_by_volume {
            self.refuse(
                "water.coarse_drag",
                "the grains are not coarse, so this rule would be ignored",
                "remove it, or write coarse: 1 or more",
            );
        }
    }

    fn sinks(&mut self, grains: &Grains, water: &Water) {
        if grains.density() <= water.density {
            self.refuse(
                "water.density",
                "grains no heavier than the water make no bed: they float",
                format!("the grains have {:.0} kg/m3", grains.density()),
            );
        }
    }

    fn with_springs(&mut self, scene: &Scene) {
        if scene.grains.soften != 1.0 {
            self.refuse(
                "grains.soften",
                "law SpringDashpot is not softened by soften",
                "raise beta, or lower the stiffness that is given",
            );
        }
        if scene.output.energies {
            self.refuse(
                "output.energies",
                "the energies of springs that slip are not tallied yet",
                "write energies: false",
            );
        }
        let solved = matches!(
            scene.time.integrator,
            Integrator::VerletAveraged { .. } | Integrator::DashpotImplicit { .. }
        );
        if solved {
            self.refuse(
                "time.integrator",
                "this scheme solves for velocities, not for spins",
                "write integrator: SymplecticEuler or VerletOld",
            );
        }
        for (i, wall) in scene.walls.iter().enumerate() {
            if wall.shape.wall_grains().is_some() {
                self.refuse(
                    format!("walls[{i}].shape"),
                    "a body built of grains is made for law Repulsion",
                    "write surface: Grid() or Exact",
                );
            }
        }
    }
}
