//! The rules of the laws between grains.

use super::Rules;
use crate::quantity::{Number, Quantity, Stiffness as StiffnessUnit};
use crate::raw::{
    RawConstants, RawDamping, RawLaw, RawNormalForce, RawResistance, RawRolling, RawSlip,
    RawStiffness, RawTension,
};
use crate::scene::{
    Damping, HertzMindlin, Law, NormalForce, Resistance, RollingResistance, Slip, SpringConstants,
    SpringDashpot, Stiffness, Tension,
};

/// Poisson's ratio when the scene does not say.
const POISSON: f64 = 0.3;

/// Damping ratio of rolling when the scene does not say.
const ROLLING_DAMPING: f64 = 0.3;

impl Rules<'_> {
    /// The law at this path; `diameter` is that of the grains.
    pub(super) fn law(&mut self, at: &str, raw: &RawLaw, diameter: f64) -> Law {
        match raw {
            RawLaw::Repulsion { stiffness, damping } => {
                self.repulsion(at, stiffness, damping, diameter)
            }
            RawLaw::SpringDashpot {
                constants,
                poisson,
                friction,
                tension,
                slip,
                normal_force,
            } => Law::SpringDashpot(SpringDashpot {
                constants: self.spring_constants(at, *constants),
                poisson: self.poisson(at, poisson.as_ref(), constants),
                friction: self.not_negative(&format!("{at}.friction"), "the friction", friction.0),
                tension: match tension {
                    None | Some(RawTension::NoPull) => Tension::NoPull,
                    Some(RawTension::AsPrinted) => Tension::AsPrinted,
                },
                slip: match slip {
                    None | Some(RawSlip::Total) => Slip::Total,
                    Some(RawSlip::AsPrinted) => Slip::AsPrinted,
                },
                normal_force: match normal_force {
                    None | Some(RawNormalForce::Closed) => NormalForce::Closed,
                    Some(RawNormalForce::Incremental) => NormalForce::Incremental,
                },
            }),
            RawLaw::HertzMindlin {
                young,
                poisson,
                restitution,
                friction,
                rolling,
            } => Law::HertzMindlin(HertzMindlin {
                young: self.above_zero(&format!("{at}.young"), "Young's modulus", young.0),
                poisson: self.poisson_of_solid(&format!("{at}.poisson"), poisson.0),
                restitution: self.restitution(
                    &format!("{at}.restitution"),
                    restitution.0,
                    "1 returns all the speed",
                ),
                friction: self.not_negative(&format!("{at}.friction"), "the friction", friction.0),
                rolling: rolling.map(|rolling| self.rolling(&format!("{at}.rolling"), rolling)),
            }),
        }
    }

    /// Poisson's ratio of an elastic solid: from −1, which it cannot reach, to that of one that keeps its volume.
    fn poisson_of_solid(&mut self, path: &str, value: f64) -> f64 {
        if !(value > -1.0 && value <= 0.5) {
            self.refuse(
                path,
                "Poisson's ratio is outside (-1, 0.5]",
                "glass has 0.22, steel 0.3, rubber nearly 0.5",
            );
        }
        value
    }

    fn rolling(&mut self, path: &str, raw: RawRolling) -> RollingResistance {
        let by = match raw.by {
            None | Some(RawResistance::ElasticPlastic) => Resistance::ElasticPlastic,
            Some(RawResistance::Constant) => Resistance::Constant,
        };
        if by == Resistance::Constant && raw.damping.is_some() {
            self.refuse(
                format!("{path}.damping"),
                "a constant couple has no spring, so damping would be ignored",
                "remove it, or write by: ElasticPlastic",
            );
        }
        RollingResistance {
            friction: self.above_zero(
                &format!("{path}.friction"),
                "the rolling friction",
                raw.friction.0,
            ),
            damping: raw.damping.map_or(ROLLING_DAMPING, |damping| {
                let path = format!("{path}.damping");
                self.not_negative(&path, "the damping ratio of rolling", damping.0)
            }),
            by,
        }
    }

    fn spring_constants(&mut self, at: &str, raw: RawConstants) -> SpringConstants {
        let path = |field: &str| format!("{at}.constants.{field}");
        let stiff = |rules: &mut Self, value: Quantity<StiffnessUnit>| {
            rules.above_zero(&path("normal_stiffness"), "the normal stiffness", value.0)
        };
        match raw {
            RawConstants::FromTimeStep { step, tn, cn, beta } => SpringConstants::FromTimeStep {
                step: self.above_zero(&path("step"), "the step of the constants", step.0),
                tn: self.above_zero(&path("tn"), "tn", tn.0),
                cn: self.not_negative(&path("cn"), "cn", cn.0),
                beta: beta.map_or(1.0, |beta| self.above_zero(&path("beta"), "beta", beta.0)),
            },
            RawConstants::Given {
                normal_stiffness,
                normal_damping,
                tangential_stiffness,
                tangential_damping,
            } => SpringConstants::Given {
                normal_stiffness: stiff(self, normal_stiffness),
                normal_damping: self.not_negative(
                    &path("normal_damping"),
                    "the normal damping",
                    normal_damping.0,
                ),
                tangential_stiffness: tangential_stiffness.map(|value| {
                    let path = path("tangential_stiffness");
                    self.not_negative(&path, "the tangential stiffness", value.0)
                }),
                tangential_damping: tangential_damping.map(|value| {
                    let path = path("tangential_damping");
                    self.not_negative(&path, "the tangential damping", value.0)
                }),
            },
            RawConstants::FromRestitution {
                normal_stiffness,
                restitution,
            } => SpringConstants::FromRestitution {
                normal_stiffness: stiff(self, normal_stiffness),
                restitution: self.restitution(
                    &path("restitution"),
                    restitution.0,
                    "1 returns all the speed",
                ),
            },
        }
    }

    fn poisson(&mut self, at: &str, raw: Option<&Number>, constants: &RawConstants) -> f64 {
        let path = format!("{at}.poisson");
        let both_given = matches!(
            constants,
            RawConstants::Given {
                tangential_stiffness: Some(_),
                tangential_damping: Some(_),
                ..
            }
        );
        if raw.is_some() && both_given {
            self.refuse(
                path.as_str(),
                "poisson would be ignored: both tangential constants are given",
                "remove it, or one of tangential_stiffness and tangential_damping",
            );
        }
        raw.map_or(POISSON, |ratio| {
            self.within(
                &path,
                "Poisson's ratio",
                ratio.0,
                [0.0, 0.5],
                "0.3 is usual",
            )
        })
    }

    fn repulsion(
        &mut self,
        at: &str,
        stiffness: &RawStiffness,
        damping: &RawDamping,
        diameter: f64,
    ) -> Law {
        let path = |field: &str| format!("{at}.{field}");
        let stiffness = match stiffness {
            RawStiffness::YoungModulus(modulus) => Stiffness::YoungModulus(self.above_zero(
                &path("stiffness[0]"),
                "Young's modulus",
                modulus.0,
            )),
            RawStiffness::Energy { epsilon, sigma } => {
                let epsilon = self.above_zero(&path("stiffness.epsilon"), "epsilon", epsilon.0);
                let sigma = self.above_zero(&path("stiffness.sigma"), "sigma", sigma.0);
                let fitting = diameter / 2_f64.powf(1.0 / 6.0);
                if sigma > 0.0 && diameter > 0.0 && (sigma / fitting - 1.0).abs() > 0.01 {
                    let what =
                        "the law's reach 2^(1/6) sigma is not the grain's diameter (within 1 %)";
                    self.refuse(
                        path("stiffness.sigma"),
                        what,
                        format!("sigma: \"{fitting:.4e} m\" fits the diameter"),
                    );
                }
                Stiffness::Energy { epsilon, sigma }
            }
        };
        let damping = match damping {
            RawDamping::Equal(both) => {
                Damping::Equal(self.not_negative(&path("damping[0]"), "the damping", both.0))
            }
            RawDamping::Parts { normal, tangential } => Damping::Parts {
                normal: self.not_negative(&path("damping.normal"), "the normal damping", normal.0),
                tangential: self.not_negative(
                    &path("damping.tangential"),
                    "the tangential damping",
                    tangential.0,
                ),
            },
        };
        Law::Repulsion { stiffness, damping }
    }
}
