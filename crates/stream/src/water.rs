//! Water and the grains in it: submerged weight, added mass, drag.

use crate::Unphysical;
use crate::unphysical::{demand, demand_positive};
use std::f64::consts::PI;
use tsubu_model::{Kind, Vector};

/// A grain of the bed: a solid sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sediment {
    /// Diameter d in m.
    pub diameter: f64,
    /// Density ρs in kg/m³.
    pub density: f64,
}

impl Sediment {
    /// Quartz sand of this diameter in m: 2650 kg/m³, paper B's σ/ρ = 2.65 in water of 1000 kg/m³.
    pub fn quartz(diameter: f64) -> Self {
        Self {
            diameter,
            density: 2650.0,
        }
    }

    /// Volume in m³: A3 d³ with A3 = π/6.
    pub fn volume(&self) -> f64 {
        PI / 6.0 * self.diameter.powi(3)
    }
}

/// The constants of clear water: it acts on grains, and they do not act on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Density ρ in kg/m³.
    pub density: f64,
    /// Gravity g in m/s², used for Shields and transport numbers; the weight of a grain is the engine's.
    pub gravity: f64,
    /// Drag coefficient CD. One number at every Reynolds number: paper B's 0.4 is that of a sphere in fast flow.
    pub drag: f64,
    /// Added-mass coefficient CM.
    pub added_mass: f64,
}

impl Water {
    /// 1000 kg/m³, g = 9.80665 m/s², and CD = 0.4, CM = 0.5 of paper B. Source: `Gotoh2001`, section 2 (1).
    pub fn fresh() -> Self {
        Self {
            density: 1000.0,
            gravity: 9.80665,
            drag: 0.4,
            added_mass: 0.5,
        }
    }

    /// The drag on a grain in N:
    ///
    /// ```text
    /// F = ½ ρ ε CD A2 d² |w| w,     A2 = π/4
    /// ```
    ///
    /// `relative` is w in m/s, water less grain, in two or three dimensions; `diameter` is d in m and
    /// `shelter` is ε ([`crate::Shelter`]). Cost: one root.
    ///
    /// Validity: CD = 0.4 belongs to Reynolds numbers wd/ν above about 1000; sand of 0.5 mm moves at 10 to 500
    /// and feels more. There is no lift, no force from the water's own acceleration and no history force.
    /// Explicit steps must be short against m/(2 · ½ρεCD A2 d² |w|): 2.6 ms for sand of 0.5 mm at 1 m/s.
    /// Source: `Gotoh2001`, eqs (4), (5).
    ///
    /// ```
    /// use tsubu_stream::Water;
    /// // 0.5 mm at w = (0.3, −0.4) m/s: ½ · 1000 · 0.4 · π/4 · 0.25e-6 · 0.5 = 1.9635e-5 kg/s, times w.
    /// let force = Water::fresh().drag(0.5e-3, 1.0, glam::DVec2::new(0.3, -0.4));
    /// assert!((force.x - 5.890e-6).abs() < 1e-9 && (force.y + 7.854e-6).abs() < 1e-9);
    /// ```
    #[inline]
    pub fn drag<V: Vector>(&self, diameter: f64, shelter: f64, relative: V) -> V {
        let area = 0.25 * PI * diameter * diameter;
        relative * (0.5 * self.density * shelter * self.drag * area * relative.length())
    }

    /// The grain as the engine moves it under water:
    ///
    /// ```text
    /// mass    (ρs + CM ρ) A3 d³     what a force accelerates
    /// weight  (ρs − ρ) A3 d³        what gravity pulls
    /// inertia ρs π d⁵/60            turning drags no water along
    /// ```
    ///
    /// Refused: a diameter or density that is not positive, and a grain that would float (ρs ≤ ρ).
    /// Source: `Gotoh2001`, eqs (1) to (3).
    ///
    /// ```
    /// use tsubu_stream::{Sediment, Water};
    /// let sand = Water::fresh().grain(&Sediment::quartz(0.5e-3))?;
    /// assert!((sand.mass / 2.0617e-7 - 1.0).abs() < 1e-4);     // kg: 3150 · 6.545e-11
    /// assert!((sand.weight / 1.0799e-7 - 1.0).abs() < 1e-4);   // kg: 1650 · 6.545e-11
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub fn grain(&self, sediment: &Sediment) -> Result<Kind, Unphysical> {
        self.check_with(sediment)?;
        let volume = sediment.volume();
        let dry = Kind::sphere(sediment.diameter, sediment.density);
        Ok(Kind {
            mass: (sediment.density + self.added_mass * self.density) * volume,
            weight: (sediment.density - self.density) * volume,
            ..dry
        })
    }

    /// Refused: density or gravity that is not positive, CD or CM that is negative.
    pub(crate) fn check(&self) -> Result<(), Unphysical> {
        demand_positive("density of the water", self.density, "kg/m³")?;
        demand_positive("gravity", self.gravity, "m/s²")?;
        crate::unphysical::demand_not_negative("drag coefficient", self.drag, "")?;
        crate::unphysical::demand_not_negative("added-mass coefficient", self.added_mass, "")
    }

    /// The same, with a grain that sinks in this water.
    pub(crate) fn check_with(&self, sediment: &Sediment) -> Result<(), Unphysical> {
        self.check()?;
        demand_positive("diameter of the grain", sediment.diameter, "m")?;
        demand_positive("density of the grain", sediment.density, "kg/m³")?;
        let remedy = format!(
            "more than {} kg/m³: a grain no heavier than water makes no bed",
            self.density
        );
        demand(
            sediment.density > self.density && sediment.density.is_finite(),
            "density of the grain",
            sediment.density,
            &remedy,
        )
    }
}
