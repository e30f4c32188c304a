//! Turbulence: random velocities of given intensity, held between switches, that nobody has to store.

use crate::Unphysical;
use crate::unphysical::{demand_not_negative, demand_positive};
use tsubu_model::uniform;

/// What the fluctuations do below the datum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FluctuationsBelow {
    /// None where the mean flow is zero; down to there the value of y = 0 (choice).
    #[default]
    Still,
    /// The value of y = 0 at every depth.
    AtBed,
    /// The printed exponential goes on: stronger the deeper, by 5 % at 1 cm for h = 0.2 m.
    AsPrinted,
}

/// Who shares one draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Draw {
    /// Each grain has its own deviates (choice).
    #[default]
    PerGrain,
    /// All grains feel the same deviates: gusts as wide as the scene.
    Together,
}

/// Fluctuating velocities, normal deviates of intensity
///
/// ```text
/// √u'² = 2.30 u* exp(−y/h),     √v'² = 1.27 u* exp(−y/h)
/// ```
///
/// along the flow and upwards, y in m above the datum, with max(y, 0) for y (choice). They are drawn anew at each
/// switch and held between two. A draw is a function of seed, identity and the number of the switch, so nothing
/// is saved, and neither order nor threads nor a restart matter.
///
/// Validity: the components are independent, so there is no Reynolds stress −u'v', and a grain's draws have no memory
/// beyond one switch and none of its neighbours'. Switching by frequency is a reading: the paper switches every 100
/// steps and calls that 50 Hz, which is right for steps of 0.2 ms, not for the 0.02 ms of its section 3.
/// Cost per grain: an exponential, a logarithm, a root and about five random numbers, no trigonometry.
/// Sources: `Gotoh2001`, eq (15); the intensities are from `Nezu1977`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turbulence {
    /// Intensity at the bed along the flow, in u*.
    pub along: f64,
    /// Intensity at the bed upwards, in u*.
    pub up: f64,
    /// Intensity at the bed across the flow, in u*, felt in space only. The paper is of a plane and has none.
    pub across: f64,
    /// Depth h of the water in m.
    pub depth: f64,
    /// Switches per second, in Hz; the bed's datum is renewed at the same times.
    pub frequency: f64,
    /// Seed of the draws.
    pub seed: u64,
    /// Which reading holds below the datum.
    pub below: FluctuationsBelow,
    /// Who shares one draw.
    pub draw: Draw,
}

impl Turbulence {
    /// Paper B's: 2.30 and 1.27, h = 0.20 m, 50 Hz.
    pub fn open_channel(seed: u64) -> Self {
        Self {
            along: 2.30,
            up: 1.27,
            across: 0.0,
            depth: 0.20,
            frequency: 50.0,
            seed,
            below: FluctuationsBelow::Still,
            draw: Draw::PerGrain,
        }
    }

    /// Mean flow only. The datum is still renewed at 50 Hz.
    pub fn none() -> Self {
        Self {
            along: 0.0,
            up: 0.0,
            ..Self::open_channel(0)
        }
    }

    /// How many switches there have been at time t in s; 0 up to the first. A switch that rounding of t would put
    /// off by less than 1e-9 of a period has happened.
    pub fn switch(&self, time: f64) -> u64 {
        // A cast of a negative number or of none gives 0.
        (time * self.frequency + 1e-9).floor() as u64
    }

    /// What is left of the intensities at height y in m: exp(−y/h), with the reading below the datum.
    /// `flows` says whether the mean flow is above zero there.
    #[inline]
    pub fn decay(&self, y: f64, flows: bool) -> f64 {
        match self.below {
            FluctuationsBelow::Still if !flows => 0.0,
            FluctuationsBelow::Still | FluctuationsBelow::AtBed => (-y.max(0.0) / self.depth).exp(),
            FluctuationsBelow::AsPrinted => (-y / self.depth).exp(),
        }
    }

    /// Fluctuations along, upwards and across in units of u* exp(−y/h), for one grain until the next switch.
    /// The one across costs a second draw and is made only if its intensity is not zero.
    ///
    /// ```
    /// use tsubu_stream::Turbulence;
    /// let water = Turbulence::open_channel(1);
    /// let now = water.fluctuations(7, water.switch(0.021));
    /// assert_eq!(now, water.fluctuations(7, water.switch(0.039)));   // held for 20 ms
    /// assert_ne!(now, water.fluctuations(7, water.switch(0.041)));
    /// assert_ne!(now, water.fluctuations(8, water.switch(0.021)));
    /// ```
    #[inline]
    pub fn fluctuations(&self, identity: u32, switch: u64) -> [f64; 3] {
        let whose = match self.draw {
            Draw::PerGrain => u64::from(identity),
            // Beyond every identity.
            Draw::Together => 1 << 32,
        };
        let [along, up] = if self.along != 0.0 || self.up != 0.0 {
            normal_pair(self.seed, whose, switch.wrapping_mul(2))
        } else {
            [0.0; 2]
        };
        let across = if self.across != 0.0 {
            normal_pair(self.seed, whose, switch.wrapping_mul(2).wrapping_add(1))[0]
        } else {
            0.0
        };
        [self.along * along, self.up * up, self.across * across]
    }

    pub(crate) fn check(&self) -> Result<(), Unphysical> {
        demand_not_negative("intensity along the flow", self.along, "")?;
        demand_not_negative("intensity upwards", self.up, "")?;
        demand_not_negative("intensity across the flow", self.across, "")?;
        demand_positive("depth of the water", self.depth, "m")?;
        demand_positive("frequency of the switches", self.frequency, "Hz")
    }
}

/// Points tried in the square around the disc; that none of them lies in the disc has a chance of 1e-43.
const TRIES: u64 = 64;

/// Two independent normal deviates (mean 0, variance 1) by Marsaglia's polar method.
fn normal_pair(seed: u64, identity: u64, event: u64) -> [f64; 2] {
    let first = event.wrapping_mul(2 * TRIES);
    for number in (0..TRIES).map(|tried| first.wrapping_add(2 * tried)) {
        let a = 2.0 * uniform(seed, identity, number) - 1.0;
        let b = 2.0 * uniform(seed, identity, number.wrapping_add(1)) - 1.0;
        let square = a * a + b * b;
        if square > 0.0 && square < 1.0 {
            let stretch = (-2.0 * square.ln() / square).sqrt();
            return [a * stretch, b * stretch];
        }
    }
    [0.0; 2]
}
