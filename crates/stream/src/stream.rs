//! The water as a whole: what it does to grains at one moment.

use crate::unphysical::{demand, demand_positive};
use crate::{
    BED_CONTACTS, Bed, Current, Datum, Grains, LogLaw, NoBed, Profile, Shelter, Table, Turbulence,
    Unphysical, Water, bed_level,
};
use tsubu_model::Dim;

/// Everything that can be chosen about a stream.
///
/// ```
/// use tsubu_stream::{Setting, Shelter, Stream};
/// // Paper B's water over 0.5 mm grains at u* = 0.05 m/s, seed 1, but without shelter.
/// let water = Stream::new(Setting { shelter: Shelter::none(), ..Setting::over_grains(0.5e-3, 0.05, 1) })?;
/// # Ok::<(), tsubu_stream::Unphysical>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Constants of water and drag.
    pub water: Water,
    /// Mean flow over u*.
    pub profile: Profile,
    /// u* in m/s over time in s.
    pub friction_velocity: Table,
    /// Fluctuations.
    pub turbulence: Turbulence,
    /// Sheltering.
    pub shelter: Shelter,
    /// Contacts from which on a grain belongs to the bed; 0 counts every grain, also one that leaps.
    pub bed_contacts: u32,
    /// When y = 0 is found.
    pub datum: Datum,
    /// Diameter of the largest grain in m: the thickness of the layer whose mean height is y = 0.
    pub largest_diameter: f64,
}

impl Setting {
    /// Paper B's flow over a bed whose largest grain has this diameter in m, at a steady u* in m/s.
    /// Nothing is checked before [`Stream::new`]. Source: `Gotoh2001`, section 2 (4).
    pub fn over_grains(largest_diameter: f64, friction_velocity: f64, seed: u64) -> Self {
        Self {
            water: Water::fresh(),
            profile: Profile::Log(LogLaw::over_grains(largest_diameter)),
            friction_velocity: Table::constant(friction_velocity),
            turbulence: Turbulence::open_channel(seed),
            shelter: Shelter::among_grains(largest_diameter),
            bed_contacts: BED_CONTACTS,
            datum: Datum::Renewed,
            largest_diameter,
        }
    }
}

/// A stream of water over a bed. It flows along axis 0; heights are along [`Dim::UP`].
///
/// [`renew`](Stream::renew) once per step, then [`push`](Stream::push), or [`at`](Stream::at) and
/// [`Current::force`] grain by grain. Nothing is allocated after `new`.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    setting: Setting,
    bed: Bed,
}

impl Stream {
    /// A stream that has not yet seen its bed, unless the datum is given.
    /// Refused: any number of the setting that water cannot have.
    pub fn new(setting: Setting) -> Result<Self, Unphysical> {
        setting.water.check()?;
        setting.profile.check()?;
        let speed = "friction velocity";
        setting
            .friction_velocity
            .demand_not_negative(speed, "m/s")?;
        setting.turbulence.check()?;
        setting.shelter.check()?;
        let diameter = setting.largest_diameter;
        demand_positive("diameter of the largest grain", diameter, "m")?;
        let mut bed = Bed::default();
        if let Datum::Given(level) = setting.datum {
            demand(
                level.is_finite(),
                "height of the bed",
                level,
                "a height in m",
            )?;
            bed.level = Some(level);
        }
        Ok(Self { setting, bed })
    }

    /// What was chosen.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    /// The state, for a checkpoint.
    pub fn bed(&self) -> Bed {
        self.bed
    }

    /// Puts a saved state back: from here on the stream does what it would have done.
    pub fn restore(&mut self, bed: Bed) {
        self.bed = bed;
    }

    /// True if [`renew`](Stream::renew) would look at the grains at time t in s: contacts need not be counted otherwise.
    pub fn is_due(&self, time: f64) -> bool {
        match self.setting.datum {
            Datum::Given(_) => false,
            Datum::Frozen => self.bed.level.is_none(),
            Datum::Renewed => self.bed.switch != Some(self.setting.turbulence.switch(time)),
        }
    }

    /// Finds the datum anew if it is due, from height in m and number of contacts of each grain ([`bed_level`]).
    /// True if there is a new one. If all grains are up in the water, the former datum stays until the next switch.
    /// Refused: no bed, now or before; the stream then still pushes nothing.
    pub fn renew(
        &mut self,
        time: f64,
        grains: impl Iterator<Item = (f64, u32)> + Clone,
    ) -> Result<bool, NoBed> {
        if !self.is_due(time) {
            return Ok(false);
        }
        let contacts = self.setting.bed_contacts;
        let found = bed_level(grains, self.setting.largest_diameter, contacts);
        let level = found.or(self.bed.level).ok_or(NoBed { contacts })?;
        self.bed = Bed {
            level: Some(level),
            switch: Some(self.setting.turbulence.switch(time)),
        };
        Ok(found.is_some())
    }

    /// The stream at time t in s; `None` before it has a bed.
    pub fn at(&self, time: f64) -> Option<Current<'_>> {
        Some(Current {
            setting: &self.setting,
            level: self.bed.level?,
            friction_velocity: self.setting.friction_velocity.at(time),
            switch: self.setting.turbulence.switch(time),
        })
    }

    /// Adds the drag in N at time t in s to the force on every grain. Before there is a bed it adds nothing.
    /// Refused: slices of different lengths; then no force is changed.
    pub fn push<D: Dim>(
        &self,
        time: f64,
        grains: Grains<'_, D>,
        force: &mut [D::V],
    ) -> Result<(), Unphysical> {
        grains.demand_as_many_as(force.len())?;
        let Some(current) = self.at(time) else {
            return Ok(());
        };
        for (i, force) in force.iter_mut().enumerate() {
            *force += current.force::<D>(
                grains.position[i],
                grains.velocity[i],
                grains.identity[i],
                grains.diameter[i],
            );
        }
        Ok(())
    }

    /// Drag of the mean flow on a grain at rest at height y in m over its submerged weight, per unit of its τ*:
    ///
    /// ```text
    /// (3/4) CD ε(y) (U(y)/u*)²
    /// ```
    ///
    /// A pure number of the height: 12.0 at y = d/2 and 3.33 at y = 0 for paper B's water (derived).
    pub fn drag_over_weight(&self, y: f64) -> f64 {
        let shape = self.setting.profile.over_friction_velocity(y);
        0.75 * self.setting.water.drag * self.setting.shelter.factor(y) * shape * shape
    }

    /// The Shields number at which the mean flow alone slides a grain at height y in m that friction μ holds:
    /// μ over [`drag_over_weight`](Stream::drag_over_weight), infinite where the water stands.
    /// Refused: a negative μ.
    ///
    /// ```
    /// use tsubu_stream::{Setting, Stream};
    /// let (d, friction) = (0.5e-3, 0.577);
    /// let water = Stream::new(Setting::over_grains(d, 0.05, 1))?;
    /// assert!((water.threshold(0.5 * d, friction)? - 0.048).abs() < 5e-4);
    /// assert!((water.threshold(0.0, friction)? - 0.173).abs() < 5e-4);
    /// # Ok::<(), tsubu_stream::Unphysical>(())
    /// ```
    pub fn threshold(&self, y: f64, friction: f64) -> Result<f64, Unphysical> {
        crate::unphysical::demand_not_negative("friction coefficient", friction, "")?;
        let ratio = self.drag_over_weight(y);
        if ratio > 0.0 {
            Ok(friction / ratio)
        } else {
            Ok(f64::INFINITY)
        }
    }
}
