//! The rules of grains: sizes and mass, softening and coarsening.

use super::Rules;
use crate::raw::{RawCoarseRule, RawGrains, RawSize, RawSoftenedDamping};
use crate::scene::{CoarseRule, Grains, Size, SoftenedDamping};

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
        if raw.mass.is_some() && raw.density.is_none() && raw.sizes.is_some() {
            self.refuse(
                "grains.mass",
                "grains of several sizes have no one mass",
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
        let sizes = raw.sizes.as_deref();
        let sizes = sizes.map_or(Vec::new(), |sizes| self.sizes(sizes, diameter, coarse));
        Some(Grains {
            diameter,
            mass,
            sizes,
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

    /// Refuses to soften a law whose stiffness is chosen as it is.
    fn softens(&mut self, raw: &RawGrains) {
        for (field, given) in [
            ("soften", raw.soften.is_some()),
            ("softened_damping", raw.softened_damping.is_some()),
        ] {
            if given && self.springs {
                self.refuse(
                    format!("grains.{field}"),
                    format!("law SpringDashpot is not softened, so {field} would be ignored"),
                    "remove it, and soften by beta in FromTimeStep or by a smaller stiffness",
                );
            }
        }
    }

    fn sizes(&mut self, raw: &[RawSize], largest: f64, coarse: u64) -> Vec<Size> {
        if !self.springs {
            self.refuse(
                "grains.sizes",
                "only grains of the law SpringDashpot come in several sizes",
                "remove sizes, or choose law: SpringDashpot(…)",
            );
        }
        if coarse > 0 {
            self.refuse(
                "grains.coarse",
                "grains of several sizes cannot be coarsened",
                "write coarse: 0, or remove sizes",
            );
        }
        let mut sizes: Vec<Size> = Vec::with_capacity(raw.len());
        for (i, raw) in raw.iter().enumerate() {
            let path = |field: &str| format!("grains.sizes[{i}].{field}");
            let size = Size {
                diameter: self.above_zero(&path("diameter"), "the diameter", raw.diameter.0),
                share: self.above_zero(&path("share"), "the share", raw.share.0),
            };
            if sizes.iter().any(|other| other.diameter == size.diameter) {
                self.refuse(
                    path("diameter"),
                    "two sizes have the same diameter",
                    "write it once, with the sum of the shares",
                );
            }
            if size.diameter > largest {
                self.refuse(
                    path("diameter"),
                    "this size is larger than the diameter of the grains",
                    "grains.diameter is that of the largest size",
                );
            }
            sizes.push(size);
        }
        self.whole(&sizes, largest);
        sizes
    }

    /// Refuses sizes that together are no mixture.
    fn whole(&mut self, sizes: &[Size], largest: f64) {
        if sizes.is_empty() {
            self.refuse(
                "grains.sizes",
                "the list of sizes is empty",
                "list (diameter: …, share: …) for each size, or remove it for grains of one size",
            );
            return;
        }
        if sizes.iter().all(|size| size.diameter < largest) {
            self.refuse(
                "grains.sizes",
                "no size has the diameter of the grains",
                "grains.diameter is that of the largest size: write the same there and here",
            );
        }
        let sum: f64 = sizes.iter().map(|size| size.share).sum();
        if (sum - 1.0).abs() > 1e-6 {
            let sum = (sum * 1e7).round() / 1e7;
            self.refuse(
                "grains.sizes",
                format!("the shares of the sizes add up to {sum}, not to 1"),
                "they are shares of the mass of all grains",
            );
        }
    }
}
