//! How strong the water is and how much it carries: Shields number, bed-load rate, and measured relations of the two.

use crate::unphysical::{demand_not_negative, demand_positive};
use crate::{Sediment, Unphysical, Water};
use std::f64::consts::PI;

impl Water {
    /// Shields number τ* = u*²/((ρs/ρ − 1) g d), the shear of the water over the weight of one layer of grains.
    /// u* in m/s. Refused: a negative u*, a grain that does not sink. Source: `Gotoh2001`, fig. 5.
    ///
    /// ```
    /// use tsubu_stream::{Sediment, Water};
    /// // 0.5 mm quartz at u* = 0.05 m/s: 2.5e-3/(1.65 · 9.80665 · 5e-4) = 0.3090.
    /// let tau = Water::fresh().shields(&Sediment::quartz(0.5e-3), 0.05)?;
    /// assert!((tau - 0.3090).abs() < 1e-4);
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub fn shields(&self, sediment: &Sediment, friction_velocity: f64) -> Result<f64, Unphysical> {
        demand_not_negative("friction velocity", friction_velocity, "m/s")?;
        Ok(friction_velocity * friction_velocity
            / (self.submerged_gravity(sediment)? * sediment.diameter))
    }

    /// The friction velocity u* in m/s of a Shields number. Refused: a negative τ*, a grain that does not sink.
    pub fn friction_velocity(&self, sediment: &Sediment, shields: f64) -> Result<f64, Unphysical> {
        demand_not_negative("Shields number", shields, "")?;
        Ok((shields * self.submerged_gravity(sediment)? * sediment.diameter).sqrt())
    }

    /// The friction velocity u* = √(g R S) in m/s of a uniform flow: hydraulic radius R in m (the depth, if the flow
    /// is wide), slope S as a number. It sets the drive of the water only: the tilt of gravity is the
    /// scene's. Validity: small slopes, S = sin ≈ tan. Refused: negative numbers.
    ///
    /// ```
    /// let u = tsubu_stream::Water::fresh().friction_velocity_of_slope(0.20, 1e-3)?;
    /// assert!((u - 0.04429).abs() < 1e-5);   // √(9.80665 · 0.2 · 0.001)
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub fn friction_velocity_of_slope(&self, radius: f64, slope: f64) -> Result<f64, Unphysical> {
        self.check()?;
        demand_not_negative("hydraulic radius", radius, "m")?;
        demand_not_negative("slope", slope, "")?;
        Ok((self.gravity * radius * slope).sqrt())
    }

    /// Transport number qB* = qB/√((ρs/ρ − 1) g d³) of a bed-load rate qB in m²/s ([`bed_load_rate`]).
    /// A rate against the flow is negative. Refused: a grain that does not sink.
    pub fn transport(&self, sediment: &Sediment, rate: f64) -> Result<f64, Unphysical> {
        Ok(rate / self.transport_unit(sediment)?)
    }

    /// √((ρs/ρ − 1) g d³) in m²/s: the rate at which qB* is 1.
    ///
    /// ```
    /// use tsubu_stream::{Sediment, Water};
    /// let unit = Water::fresh().transport_unit(&Sediment::quartz(0.5e-3))?;
    /// assert!((unit / 4.4974e-5 - 1.0).abs() < 1e-4);   // √(1.65 · 9.80665 · 1.25e-10)
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub fn transport_unit(&self, sediment: &Sediment) -> Result<f64, Unphysical> {
        Ok((self.submerged_gravity(sediment)? * sediment.diameter.powi(3)).sqrt())
    }

    /// (ρs/ρ − 1) g in m/s².
    pub fn submerged_gravity(&self, sediment: &Sediment) -> Result<f64, Unphysical> {
        self.check_with(sediment)?;
        Ok((sediment.density / self.density - 1.0) * self.gravity)
    }
}

/// Bed-load rate qB in m²/s, grain volume without pores per width and time:
///
/// ```text
/// qB = (π/6) Σ d³ u /(L b)
/// ```
///
/// `grains` gives diameter d in m and velocity u in m/s along the flow of each grain over the bed's `length` L and
/// `width` b in m. A plane scene is one grain wide: b = d, the largest of a mixture (choice).
/// Refused: a length or width that is not positive. Source: `Gotoh2001` plots it in fig. 5; the plane form is derived.
///
/// ```
/// // One 0.5 mm grain in ten moves at 0.1 m/s along 40 d: (π/6) d³ · 4 · 0.1 /(40 d · d) = 2.618e-6 m²/s.
/// let d = 0.5e-3;
/// let grains = (0..40).map(|i| (d, if i % 10 == 0 { 0.1 } else { 0.0 }));
/// assert!((tsubu_stream::bed_load_rate(grains, 40.0 * d, d)? - 2.618e-6).abs() < 1e-9);
/// # Ok::<(), tsubu_stream::Unphysical>(())
/// ```
pub fn bed_load_rate(
    grains: impl Iterator<Item = (f64, f64)>,
    length: f64,
    width: f64,
) -> Result<f64, Unphysical> {
    demand_positive("length of the bed", length, "m")?;
    demand_positive("width of the bed", width, "m")?;
    let sum: f64 = grains.map(|(d, u)| d * d * d * u).sum();
    Ok(PI / 6.0 * sum / (length * width))
}

/// A measured relation of transport to Shields number: qB* = a (τ* − τc)ⁿ above the threshold, 0 below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransportCurve {
    /// Its name in a legend.
    pub name: &'static str,
    /// Factor a.
    pub factor: f64,
    /// Threshold τc.
    pub threshold: f64,
    /// Exponent n.
    pub exponent: f64,
}

impl TransportCurve {
    /// 8 (τ* − 0.047)^1.5, on a plane bed without the factor for the drag of bed forms.
    /// Validity: grains of 0.4 to 30 mm, slopes of 0.04 to 2 %. The curve over what was measured, in the
    /// median: 2.7 for its own authors' flume (89 runs with qB* > 1e-3), 0.74 for `Gilbert1914`, 0.5 mm, τ* 0.2 to 1 (202). Source: `MeyerPeter1948`.
    ///
    /// ```
    /// use tsubu_stream::TransportCurve;
    /// // 8 · 0.453^1.5 = 2.439.
    /// assert!((TransportCurve::MEYER_PETER_MULLER.transport(0.5)? - 2.439).abs() < 1e-3);
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub const MEYER_PETER_MULLER: Self = Self {
        name: "Meyer-Peter & Müller 1948",
        factor: 8.0,
        threshold: 0.047,
        exponent: 1.5,
    };

    /// 3.97 (τ* − 0.0495)^1.5: the same measurements without the correction for bed forms.
    /// The curve over what was measured, in the median: 1.21 for the flume runs it is fitted to, but 0.36 for
    /// sand of 0.5 mm at τ* 0.2 to 1 (`Gilbert1914`). Source: `WongParker2006`.
    pub const WONG_PARKER: Self = Self {
        name: "Wong & Parker 2006",
        factor: 3.97,
        threshold: 0.0495,
        exponent: 1.5,
    };

    /// 4.93 (τ* − 0.047)^1.60: the other form of the same fit. Source: `WongParker2006`.
    pub const WONG_PARKER_FREE_EXPONENT: Self = Self {
        name: "Wong & Parker 2006, exponent 1.60",
        factor: 4.93,
        threshold: 0.047,
        exponent: 1.60,
    };

    /// qB* at this Shields number. Refused: a negative τ*.
    pub fn transport(&self, shields: f64) -> Result<f64, Unphysical> {
        demand_not_negative("Shields number", shields, "")?;
        Ok(self.factor * (shields - self.threshold).max(0.0).powf(self.exponent))
    }
}
