//! One run of the section: one pitch of the screw in its tube, without ends.
//!
//! A wall that is touched at the centres (s = R) acts as one that is touched at the surface (s = R + d'/2) and stands
//! δ = d'/2 further in. The most a screw can carry, area × pitch, over (π/4)(Ds² − ds²) p is then
//! C(δ) = ((Rc − δ)² − (rs + δ)²)/(R² − rs²) · (p − t − 2δ)/p, with R, rs and Rc the radii of flight, shaft and casing, p the
//! pitch and t the thickness of the flight; C(0) = 1.22. Both readings are given the same share of that room, because the
//! same mass does not fit: at n = 4 it would take a solid fraction of 0.56 of the room, where the hopper's bed has 0.52.

use crate::validate::kept::Measured;
use crate::validate::scenes::changed;
use std::path::Path;

/// The shipped scene.
pub const SCENE: &str = "scenarios/screw_section.ron";

/// Radii of flight, shaft and casing, pitch and thickness of the flight, m.
pub const FLIGHT: f64 = 0.1025;
pub const SHAFT: f64 = 0.0275;
pub const CASING: f64 = 0.1148;
pub const PITCH: f64 = 0.150;
const THICKNESS: f64 = 0.006;

/// Density of the solid, kg/m³, and mass of the grains in a pitch where walls are touched at the surface, kg.
pub const DENSITY: f64 = 1370.0;
const MASS: f64 = 2.75;
/// Volume of the box that the scene fills, m³.
const BOX: f64 = PITCH * 4.0 * CASING * CASING;

/// The most a screw can carry over (π/4)(Ds² − ds²) p, its walls moved in by δ in m.
pub fn most(inward: f64) -> f64 {
    let area = (CASING - inward).powi(2) - (SHAFT + inward).powi(2);
    area / (FLIGHT * FLIGHT - SHAFT * SHAFT) * (PITCH - THICKNESS - 2.0 * inward) / PITCH
}

/// Volume that a full screw moves per turn, m³.
pub fn per_turn() -> f64 {
    std::f64::consts::PI * (FLIGHT * FLIGHT - SHAFT * SHAFT) * PITCH
}

/// One run of the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rung {
    /// Coarse level n.
    pub coarse: u32,
    /// Turns per minute.
    pub rpm: f64,
    /// From the start of the screw.
    pub turns: f64,
    /// Walls are touched at the centres.
    pub at_centres: bool,
}

impl Rung {
    /// As the table calls it.
    pub fn name(&self) -> String {
        let place = if self.at_centres {
            "s = R"
        } else {
            "s = R + d/2"
        };
        let Rung {
            coarse, rpm, turns, ..
        } = self;
        format!("section, n = {coarse}, {rpm} r/min, {place}, {turns} turns")
    }

    /// λ = 2ⁿ.
    pub fn lambda(&self) -> f64 {
        f64::from(1u32 << self.coarse)
    }

    /// Diameter of a coarse grain, m.
    pub fn diameter(&self) -> f64 {
        1.350e-3 * self.lambda()
    }

    /// The room of the screw over (π/4)(Ds² − ds²) p.
    pub fn most(&self) -> f64 {
        let inward = if self.at_centres {
            0.5 * self.diameter()
        } else {
            0.0
        };
        most(inward)
    }

    /// Mass of grains, kg: the same share of the room.
    pub fn mass(&self) -> f64 {
        MASS * self.most() / most(0.0)
    }

    fn sets(&self) -> Vec<String> {
        let place = if self.at_centres { "Centre" } else { "Surface" };
        vec![
            format!("grains.coarse={}", self.coarse),
            format!("walls.screw.motion.turn.rate=-{} rpm", self.rpm),
            format!("walls.screw.touches_at={place}"),
            format!("walls.casing.touches_at={place}"),
            format!(
                "initial.fill.solid_fraction={}",
                self.mass() / DENSITY / BOX
            ),
            format!("time.until={} s", 60.0 * self.turns / self.rpm),
        ]
    }

    /// What the run measured, from the folder of finished runs or run now.
    pub fn measured(&self, root: &Path, fingerprint: u64) -> Result<Measured, String> {
        let Rung { coarse, rpm, .. } = self;
        let place = if self.at_centres { "centre" } else { "surface" };
        let file = root.join(format!(
            "target/validate/screw/{fingerprint:016x}-section-n{coarse}-{rpm}rpm-{place}-{}turns.csv",
            self.turns
        ));
        match Measured::kept(&file) {
            Some(measured) => Ok(measured),
            None => {
                eprintln!("  {} …", self.name());
                Measured::of_run(&changed(&root.join(SCENE), &self.sets())?, &file, None, 1)
            }
        }
    }
}

/// A rung and what it gave.
pub struct Found {
    /// What was run.
    pub rung: Rung,
    /// What it measured.
    pub measured: Measured,
}

impl Found {
    /// Mass rate with its error, kg/s.
    pub fn rate(&self) -> (f64, f64) {
        self.measured.get("mass_rate")
    }

    /// Axial speed over p n, with the error of the rate, which is that of the same sum.
    pub fn efficiency(&self) -> (f64, f64) {
        let (rate, error) = self.rate();
        let value = self.measured.get("axial_efficiency").0;
        (value, value * error / rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_room_shrinks_with_the_grain_as_worked_by_hand() {
        // d' = 21.6 mm: (104.0² − 38.3²)/9750 · 122.4/150.
        assert!((most(0.0108) - 0.7825).abs() < 1e-4);
        assert!((most(0.0027) - 1.1044).abs() < 1e-4);
        assert!((per_turn() - 4.5946e-3).abs() < 1e-7);
    }
}
