//! The mean flow over the bed as a multiple of the friction velocity.

use crate::unphysical::{demand_place, demand_positive};
use crate::{Table, Unphysical};

/// The rough-wall law, with zero flow below the height where the logarithm is zero:
///
/// ```text
/// U/u* = (1/κ) ln(30.1 (y + y₀)/ksr)     for y > ksr/30.1 − y₀,     else 0
/// ```
///
/// y in m above the bed's datum ([`crate::bed_level`]). Continuous: it leaves zero with the slope 30.1/(κ ksr).
/// Validity: the lower fifth of a deep flow; nothing ends it at a free surface. The paper prints no κ: 0.40 gives
/// the ratios of drag to weight that this crate's tests hold, 0.41 makes the drag 4.8 % weaker.
/// That the flow is zero below is a choice; the printed logarithm would turn negative.
/// Cost: one logarithm, none below. Source: `Gotoh2001`, eq (14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogLaw {
    /// Equivalent roughness ksr in m: the paper's is the diameter, here the largest of a mixture (choice).
    pub roughness: f64,
    /// Offset y₀ in m of the logarithm's origin below the datum: the paper's is d/4.
    pub offset: f64,
    /// von Kármán's constant κ.
    pub karman: f64,
}

/// The number in the rough-wall law.
const ROUGH: f64 = 30.1;

impl LogLaw {
    /// Over a bed whose largest grain has this diameter in m: ksr = d, y₀ = d/4, κ = 0.40.
    ///
    /// ```
    /// use tsubu_stream::LogLaw;
    /// // Half a diameter above the datum: ln(30.1 · 0.75)/0.40 = 7.792.
    /// assert!((LogLaw::over_grains(0.5e-3).over_friction_velocity(0.25e-3) - 7.792).abs() < 1e-3);
    /// ```
    pub fn over_grains(largest_diameter: f64) -> Self {
        Self {
            roughness: largest_diameter,
            offset: 0.25 * largest_diameter,
            karman: 0.40,
        }
    }

    /// U/u* at height y in m.
    #[inline]
    pub fn over_friction_velocity(&self, y: f64) -> f64 {
        let argument = ROUGH * (y + self.offset) / self.roughness;
        if argument > 1.0 {
            argument.ln() / self.karman
        } else {
            0.0
        }
    }

    /// The height in m below which the water stands: ksr/30.1 − y₀.
    pub fn zero(&self) -> f64 {
        self.roughness / ROUGH - self.offset
    }
}

/// The mean flow along the first axis as a function of height, U(y)/u*. It scales with u*, also while u* changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// The rough-wall law.
    Log(LogLaw),
    /// Given by rows: height in m above the datum, U/u*.
    Measured(Table),
}

impl Profile {
    /// A measured profile: rows of height in m above the datum and speed U in m/s, and the friction velocity in m/s
    /// at which they were measured. Beyond the rows the first and the last speed hold, so begin with a row of
    /// zero speed where the water stands.
    /// Refused: a friction velocity that is not positive, heights that do not increase, a negative speed.
    ///
    /// ```
    /// use tsubu_stream::Profile;
    /// let flow = Profile::measured(&[[0.0, 0.0], [0.01, 0.30]], 0.05)?;
    /// assert!((flow.over_friction_velocity(0.005) - 3.0).abs() < 1e-12);   // 0.15/0.05
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub fn measured(rows: &[[f64; 2]], friction_velocity: f64) -> Result<Self, Unphysical> {
        demand_positive("friction velocity", friction_velocity, "m/s")?;
        let shape = rows
            .iter()
            .map(|[y, speed]| [*y, speed / friction_velocity])
            .collect();
        let profile = Self::Measured(Table::new(shape)?);
        profile.check()?;
        Ok(profile)
    }

    /// U/u* at height y in m above the datum.
    #[inline]
    pub fn over_friction_velocity(&self, y: f64) -> f64 {
        match self {
            Self::Log(law) => law.over_friction_velocity(y),
            Self::Measured(table) => table.at(y),
        }
    }

    pub(crate) fn check(&self) -> Result<(), Unphysical> {
        match self {
            Self::Log(law) => {
                demand_positive("roughness", law.roughness, "m")?;
                demand_positive("Kármán constant", law.karman, "")?;
                demand_place("offset of the logarithm", law.offset)
            }
            Self::Measured(table) => table.demand_not_negative("speed of a measured profile", ""),
        }
    }
}
