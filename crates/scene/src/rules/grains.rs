//! The rules of grains: diameter and mass, softening and coarsening.

use super::Rules;
use crate::raw::{RawCoarseRule, RawGrains, RawSoftenedDamping};
use crate::scene::{CoarseRule, Grains, SoftenedDamping};

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
        if raw.mass.is_some() && raw.density.is_none() && raw.populations.is_some() {
            self.refuse(
                "grains.mass",
                "grains of several populations have no one mass",
                "give their density instead",
            );
        }
        self.softens(&raw);
        let soften = raw.soften.map_or(1.0, |soften| soften.0);
        if soften < 1.0 {
            self.refuse(
                "grains.soften",
                "soften is below 1",
                "the stiffness is divided by it: 100 makes grains 100 times softer, 1 leaves them",
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
        let further = raw.materials.as_deref().unwrap_or_default();
        self.name_materials(raw.material, further);
        let populations = raw.populations.as_deref();
        let populations = populations.map_or(Vec::new(), |populations| {
            self.populations(populations, diameter, mass / volume)
        });
        let law = self.law("grains.law", &raw.law, diameter);
        let materials = self.further_materials(further, &law, diameter);
        let pairs = self.pairs(raw.pairs.as_deref().unwrap_or_default(), &law);
        Some(Grains {
            diameter,
            mass,
            material: self.materials[0].clone(),
            populations,
            law,
            materials,
            pairs,
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

    /// Refuses to soften a law whose stiffness is chosen as it is.
    fn softens(&mut self, raw: &RawGrains) {
        for (field, given) in [
            ("soften", raw.soften.is_some()),
            ("softened_damping", raw.softened_damping.is_some()),
        ] {
            if given && self.spins() {
                self.refuse(
                    format!("grains.{field}"),
                    format!("law {} is not softened, so {field} would be ignored", self.law),
                    match self.law {
                        "SpringDashpot" => "remove it, and soften by beta in FromTimeStep or by a smaller stiffness",
                        _ => "remove it, and soften by a smaller Young's modulus",
                    },
                );
            }
        }
    }
}
