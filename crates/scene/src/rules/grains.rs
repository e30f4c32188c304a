//! The rules of grains and their law.

use super::Rules;
use super::river::Readings;
use crate::raw::{RawCoarseRule, RawDamping, RawGrains, RawLaw, RawSoftenedDamping, RawStiffness};
use crate::scene::{CoarseRule, Damping, Grains, Law, SoftenedDamping, Stiffness};

impl Rules<'_> {
    pub(super) fn grains(&mut self, raw: RawGrains) -> Option<Grains> {
        let diameter = self.above_zero("grains.diameter", "the diameter", raw.diameter.0);
        self.exactly_one("grains", &[raw.density.is_some(), raw.mass.is_some()]);
        let volume = std::f64::consts::PI / 6.0 * diameter.powi(3);
        let (field, given, mass) = match (raw.density, raw.mass) {
            (Some(density), _) => (
                "grains.density",
                self.above_zero("grains.density", "the density", density.0),
                density.0 * volume,
            ),
            (None, Some(mass)) => (
                "grains.mass",
                self.above_zero("grains.mass", "the mass", mass.0),
                mass.0,
            ),
            (None, None) => return None,
        };
        if diameter > 0.0 && given > 0.0 && !(mass.is_normal() && (mass / volume).is_normal()) {
            self.refuse(
                field,
                "no grain of this diameter can weigh that",
                "check the units of the diameter and of this value",
            );
        }
        let soften = raw.soften.map_or(1.0, |soften| soften.0);
        if soften < 1.0 {
            self.refuse(
                "grains.soften",
                "soften is below 1",
                "the stiffness is divided by it: 100 makes grains 100 times softer, 1 leaves them",
            );
        }
        if matches!(raw.law, RawLaw::SpringDashpot { .. }) && raw.softened_damping.is_some() {
            self.refuse(
                "grains.softened_damping",
                "law SpringDashpot is not softened, so this would be ignored",
                "remove it",
            );
        }
        let coarse = raw.coarse.map_or(0, |coarse| coarse.0);
        if coarse > 8 {
            self.refuse(
                "grains.coarse",
                "coarse is above 8",
                "each level doubles the diameter: 8 levels already make it 256 times larger",
            );
        }
        Some(Grains {
            diameter,
            mass,
            law: self.law(&raw.law, diameter),
            soften,
            softened_damping: match raw.softened_damping {
                None | Some(RawSoftenedDamping::Kept) => SoftenedDamping::Kept,
                Some(RawSoftenedDamping::Scaled) => SoftenedDamping::Scaled,
                Some(RawSoftenedDamping::NormalScaled) => SoftenedDamping::NormalScaled,
            },
            coarse: coarse.min(8) as u32,
            coarse_rule: match raw.coarse_rule {
                None | Some(RawCoarseRule::Renormalised) => CoarseRule::Renormalised,
                Some(RawCoarseRule::SakaiKoshizuka) => CoarseRule::SakaiKoshizuka,
                Some(RawCoarseRule::RadlRestitution) => CoarseRule::RadlRestitution,
            },
        })
    }

    fn law(&mut self, raw: &RawLaw, diameter: f64) -> Law {
        let (stiffness, damping) = match raw {
            RawLaw::Repulsion { stiffness, damping } => (stiffness, damping),
            RawLaw::SpringDashpot {
                constants,
                poisson,
                friction,
                tension,
                slip,
                normal_force,
            } => {
                let readings = Readings {
                    poisson: poisson.map(|nu| nu.0),
                    friction: friction.0,
                    tension,
                    slip,
                    normal_force,
                };
                return self.springs(constants, &readings);
            }
        };
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
