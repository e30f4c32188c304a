//! Sheltering: grains among others feel less of the flow.

use crate::Unphysical;
use crate::unphysical::{demand, demand_place, demand_positive};

/// What the shelter does below the height −y₀, where the printed square would make it rise again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShelterBelow {
    /// ε = ε0 (choice): shelter does not end with depth.
    #[default]
    Floor,
    /// The formula as printed: ε rises again towards 1 deep in the bed.
    AsPrinted,
}

/// The share ε of the drag that a grain at height y feels:
///
/// ```text
/// ε = ε0 + (1 − ε0) [1 − exp{−((y + y₀)/ksr)²}]
/// ```
///
/// y in m above the bed's datum. From ε0 at y = −y₀ it rises to 1 within a few ksr. The paper calls ε0 the value at
/// the datum; by its own formula that is 0.436 for ε0 = 0.4, y₀ = d/4 and ksr = d, and the formula is what is used.
/// Cost: one exponential, none below −y₀ by default. Source: `Gotoh2001`, eq (16).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shelter {
    /// ε0, between 0 and 1; 1 is no shelter at all.
    pub floor: f64,
    /// ksr in m.
    pub roughness: f64,
    /// y₀ in m.
    pub offset: f64,
    /// Which reading holds below −y₀.
    pub below: ShelterBelow,
}

impl Shelter {
    /// On a bed whose largest grain has this diameter in m: ε0 = 0.4, ksr = d, y₀ = d/4.
    ///
    /// ```
    /// use tsubu_stream::Shelter;
    /// // Half a diameter above the datum: 0.4 + 0.6 (1 − exp(−0.5625)) = 0.6581.
    /// assert!((Shelter::among_grains(0.5e-3).factor(0.25e-3) - 0.6581).abs() < 1e-4);
    /// ```
    pub fn among_grains(largest_diameter: f64) -> Self {
        Self {
            floor: 0.4,
            roughness: largest_diameter,
            offset: 0.25 * largest_diameter,
            below: ShelterBelow::Floor,
        }
    }

    /// No shelter: ε = 1 everywhere.
    pub fn none() -> Self {
        Self {
            floor: 1.0,
            roughness: 1.0,
            offset: 0.0,
            below: ShelterBelow::Floor,
        }
    }

    /// ε at height y in m.
    #[inline]
    pub fn factor(&self, y: f64) -> f64 {
        let x = (y + self.offset) / self.roughness;
        if x <= 0.0 && self.below == ShelterBelow::Floor {
            return self.floor;
        }
        self.floor + (1.0 - self.floor) * (1.0 - (-x * x).exp())
    }

    pub(crate) fn check(&self) -> Result<(), Unphysical> {
        demand(
            (0.0..=1.0).contains(&self.floor),
            "shelter's floor",
            self.floor,
            "a number from 0 to 1",
        )?;
        demand_positive("shelter's roughness", self.roughness, "m")?;
        demand_place("shelter's offset", self.offset)
    }
}
