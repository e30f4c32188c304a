//! The rules of the laws between grains.

use super::Rules;
use crate::quantity::{Number, Quantity, Stiffness as StiffnessUnit};
use crate::raw::{
    RawConstants, RawDamping, RawLaw, RawNormalForce, RawSlip, RawStiffness, RawTension,
};
use crate::scene::{
    Damping, Law, NormalForce, Slip, SpringConstants, SpringDashpot, Stiffness, Tension,
};

/// Poisson's ratio when the scene does not say.
const POISSON: f64 = 0.3;

impl Rules<'_> {
    pub(super) fn law(&mut self, raw: &RawLaw, diameter: f64) -> Law {
        match raw {
            RawLaw::Repulsion { stiffness, damping } => {
                self.repulsion(stiffness, damping, diameter)
            }
            RawLaw::SpringDashpot {
                constants,
                poisson,
                friction,
                tension,
                slip,
                normal_force,
            } => Law::SpringDashpot(SpringDashpot {
                constants: self.spring_constants(*constants),
                poisson: self.poisson(poisson.as_ref(), constants),
                friction: self.not_negative("grains.law.friction", "the friction", friction.0),
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
        }
    }

    fn spring_constants(&mut self, raw: RawConstants) -> SpringConstants {
        let path = |field: &str| format!("grains.law.constants.{field}");
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

    fn poisson(&mut self, raw: Option<&Number>, constants: &RawConstants) -> f64 {
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
                "grains.law.poisson",
                "poisson would be ignored: both tangential constants are given",
                "remove it, or one of tangential_stiffness and tangential_damping",
            );
        }
        raw.map_or(POISSON, |ratio| {
            self.within(
                "grains.law.poisson",
                "Poisson's ratio",
                ratio.0,
                [0.0, 0.5],
                "0.3 is usual",
            )
        })
    }

    fn repulsion(&mut self, stiffness: &RawStiffness, damping: &RawDamping, diameter: f64) -> Law {
        let stiffness = match stiffness {
            RawStiffness::YoungModulus(modulus) => Stiffness::YoungModulus(self.above_zero(
                "grains.law.stiffness[0]",
                "Young's modulus",
                modulus.0,
            )),
            RawStiffness::Energy { epsilon, sigma } => {
                let epsilon = self.above_zero("grains.law.stiffness.epsilon", "epsilon", epsilon.0);
                let sigma = self.above_zero("grains.law.stiffness.sigma", "sigma", sigma.0);
                let fitting = diameter / 2_f64.powf(1.0 / 6.0);
                if sigma > 0.0 && diameter > 0.0 && (sigma / fitting - 1.0).abs() > 0.01 {
                    let what =
                        "the law's reach 2^(1/6) sigma is not the grain's diameter (within 1 %)";
                    self.refuse(
                        "grains.law.stiffness.sigma",
                        what,
                        format!("sigma: \"{fitting:.4e} m\" fits the diameter"),
                    );
                }
                Stiffness::Energy { epsilon, sigma }
            }
        };
        let damping = match damping {
            RawDamping::Equal(both) => {
                Damping::Equal(self.not_negative("grains.law.damping[0]", "the damping", both.0))
            }
            RawDamping::Parts { normal, tangential } => Damping::Parts {
                normal: self.not_negative(
                    "grains.law.damping.normal",
                    "the normal damping",
                    normal.0,
                ),
                tangential: self.not_negative(
                    "grains.law.damping.tangential",
                    "the tangential damping",
                    tangential.0,
                ),
            },
        };
        Law::Repulsion { stiffness, damping }
    }
}
