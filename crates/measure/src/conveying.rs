//! The observer of a screw that conveys grains.

use crate::screw::annulus;
use crate::section::{Axis, Bins, Load, bulk_density, loads};
use glam::DVec3;
use std::f64::consts::TAU;
use tsubu_model::{
    BodyState, Curve, Damaged, Dim, Observer, Reading, Saved, SpinState, View, Words,
};

/// Bins of a profile along the axis per pitch.
const BINS_PER_PITCH: f64 = 4.0;

/// What a [`Conveying`] needs to know of the scene. Lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub struct ConveyingOptions {
    /// Number of the body that is the screw, in the order of the scene.
    pub screw: usize,
    /// Number of the outlet among the passages of the view; `None` for a stretch without one, whose rate is that of the
    /// section.
    pub outlet: Option<usize>,
    /// A point of the axis; places along the axis are counted from it.
    pub point: DVec3,
    /// Direction in which the screw conveys; any length but zero.
    pub direction: DVec3,
    /// Where along the axis the section of the screw begins and ends that is measured: well inside the tube.
    pub section: (f64, f64),
    /// Where along the axis the profiles begin and end: the whole screw.
    pub along: (f64, f64),
    /// Length after which the scene repeats along the axis, if it does: then neither section nor profiles are longer.
    pub period: Option<f64>,
    /// Pitch p.
    pub pitch: f64,
    /// Outer diameter of the flight Ds.
    pub outer: f64,
    /// Diameter of the shaft ds.
    pub shaft: f64,
    /// Inner diameter of the casing.
    pub casing: f64,
    /// Two opposite corners of a box in the hopper that stays full of grains, z up; `None` without a hopper.
    pub hopper: Option<[DVec3; 2]>,
    /// Density of the grains' solid in kg/m³.
    pub density: f64,
}

impl ConveyingOptions {
    pub(crate) fn length(&self) -> f64 {
        self.section.1 - self.section.0
    }

    /// Mass over this is the filling ratio of a stretch: ρb (π/4)(Ds² − ds²) length.
    pub(crate) fn nominal_mass(&self, bulk_density: f64, length: f64) -> f64 {
        bulk_density * annulus(self.outer, self.shaft) * length
    }
}

/// Rate, speeds, filling and torque of a screw conveyor or feeder, held against Q = a (π/4)(Ds² − ds²) p n_s ρb
/// ([`crate::screw`]). For scenes in space.
///
/// Rows, in this order. Grains count where their centre is; driven grains do not count.
/// * `outlet_mass` (kg): through the outlet so far.
/// * `mass_rate` (kg/s): its growth since the last look; NaN at the first.
/// * `section_mass` (kg): grains in the section, within the radius of the casing.
/// * `axial_speed`, `tangential_speed` (m/s): their mean, weighted by mass, along the axis and around it, positive
///   with the screw's spin; NaN for an empty section.
/// * `section_solid_fraction` (1): their volume, mass over the solid's density, over the annulus between casing and shaft
///   times the length of the section. The volume of the flight is not taken off, so the space is overestimated by
///   about the thickness of the flight over the pitch.
/// * `fill_ratio` (1): a = section mass/(ρb (π/4)(Ds² − ds²) length), as in the formula. It can exceed 1 because grains
///   lie in the clearance too: up to (casing² − ds²)/(Ds² − ds²), 1.27 for paper A's screw.
/// * `hopper_bulk_density` ρb (kg/m³): in the box, less one diameter at each side and whatever is above the
///   free surface; NaN if nothing lies in the box. Of level layers two diameters thick those count that
///   hold at least ¾ of the densest. Bias: a hole beside the flow lowers it; sideways grains count by their centre, so
///   a crystal's rows may move it by d over the width of the box.
/// * `screw_torque` (N m): that the drive gives about the axis, positive if it drives the spin.
/// * `screw_power` (W): of the drive.
/// * `turns` (rev): since the first look. Exact if the screw turns less than half a turn more or less between looks than
///   the mean of its speeds at both says.
///
/// Report. The outlet's rate is steady from one turn after the section has filled, in whole turns ([`crate::Steady::of_periods`]),
/// unless the filling of the section drifts; means are over that part, or over the second half of the time if there
/// is none, and `steady` (1 or 0) says which. Uncertainties are from blocks ([`crate::Blocked`]), and of
/// quotients from both parts as if they were independent.
/// * `mass_rate` Q (kg/s): the slope of the outlet's mass.
/// * `ratio_to_theory` = Q/(volume per turn · n_s ρb), a = 1; `ratio_to_theory_measured_a`: divided by the
///   measured a besides, so ρb drops out of it. n_s is from the turns in the same part.
/// * `fill_ratio` a, from the mean section mass and the mean ρb; `solid_fraction`; `hopper_bulk_density`.
/// * `axial_efficiency`: mean axial speed over p n_s; `tangential_speed`; `screw_torque`; `screw_power`.
/// * `mass_rate_from_section` (kg/s): Σ m v_axial/length, which is (section mass/length) × axial speed: in steady flow it
///   must agree with Q.
/// * `steady_from` (s) and `steady_turns` (rev), how many whole turns `mass_rate` is the mean of: absent if nothing is steady;
///   `steady`; `turns`.
///
/// Figures: `outlet_mass`, `mass_rate` with the theory at a = 1 and the n_s of each look, `axial_speed` and `fill` along the axis.
///
/// Without an outlet, as in a stretch of tube that repeats along the axis, nothing leaves: there is no `outlet_mass`, and the mass
/// that has passed is the integral of Σ m v_axial/length over time, by trapezia between the looks. `mass_rate` is its slope over the
/// steady part ([`Steady::of_count`](crate::Steady::of_count)), which need not be whole turns: turning a screw without ends is the same as
/// shifting it along, so what the whole period holds knows no angle. Without a hopper there is no ρb, and so no
/// `hopper_bulk_density`, `fill_ratio`, `ratio_to_theory`, nor their figures.
///
/// Sources: `Sumitomo2024` for the formula, `Roberts1999` for what rotation costs.
#[derive(Clone, Debug)]
pub struct Conveying {
    pub(crate) options: ConveyingOptions,
    axis: Axis,
    pub(crate) bins: Bins,
    pub(crate) looks: Vec<Look>,
    /// At which the screw stood at the last look, in rad.
    angle: f64,
}

/// What one look found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Look {
    pub time: f64,
    /// Through the outlet, or without one through the section.
    pub outlet_mass: f64,
    pub mass_rate: f64,
    pub section: Load,
    /// Positive with the screw's spin.
    pub tangential_speed: f64,
    pub bulk_density: f64,
    pub torque: f64,
    pub power: f64,
    /// Turns so far and turns per second, counter-clockwise seen against the axis.
    pub turns: f64,
    pub speed: f64,
    pub profile: Vec<Load>,
}

impl Conveying {
    /// An observer that has not looked yet.
    pub fn new(options: ConveyingOptions) -> Self {
        Self {
            axis: Axis {
                point: options.point,
                direction: options.direction.normalize_or(DVec3::X),
                reach: 0.5 * options.casing,
                repeats: options.period.map(|period| (options.section.0, period)),
            },
            bins: Bins::over(options.along, options.pitch / BINS_PER_PITCH),
            looks: Vec::new(),
            angle: 0.0,
            options,
        }
    }

    /// Turns since the first look: by the mean speed between looks, then to the angle at which the screw stands.
    fn turns(&mut self, time: f64, speed: f64, angle: f64) -> f64 {
        let turned = self.looks.last().map_or(0.0, |last| {
            let about = 0.5 * (last.speed + speed) * (time - last.time);
            let off = (angle - self.angle) / TAU - about;
            last.turns + about + off - off.round()
        });
        self.angle = angle;
        turned
    }

    fn look<D: Dim, S: SpinState>(&mut self, view: &dyn View<D, S>) -> Look {
        let time = view.time();
        let (section, profile) = loads(view, &self.axis, self.options.section, &self.bins);
        let rate = section.axial / self.options.length();
        let outlet_mass = match self.options.outlet {
            Some(outlet) => view
                .passages()
                .get(outlet)
                .map_or(f64::NAN, |outlet| outlet.mass),
            None => self.looks.last().map_or(0.0, |last| {
                let before = last.section.axial / self.options.length();
                last.outlet_mass + 0.5 * (before + rate) * (time - last.time)
            }),
        };
        let drive = view
            .bodies()
            .get(self.options.screw)
            .map_or(Drive::NONE, |screw| Drive::of(screw, &self.axis));
        let sense = if drive.speed < 0.0 { -1.0 } else { 1.0 };
        Look {
            time,
            outlet_mass,
            mass_rate: self.looks.last().map_or(f64::NAN, |last| {
                over(outlet_mass - last.outlet_mass, time - last.time)
            }),
            section,
            tangential_speed: sense * over(section.around, section.mass),
            bulk_density: self
                .options
                .hopper
                .map_or(f64::NAN, |hopper| bulk_density(view, hopper)),
            torque: sense * drive.torque,
            power: drive.power,
            turns: self.turns(time, drive.speed, drive.angle),
            speed: drive.speed,
            profile,
        }
    }

    fn row(&self, look: &Look) -> Vec<Reading> {
        let o = &self.options;
        let mass = look.section.mass;
        let space = annulus(o.casing, o.shaft) * o.length();
        let nominal = o.nominal_mass(look.bulk_density, o.length());
        let mut row = vec![
            Reading::new("outlet_mass", look.outlet_mass, "kg"),
            Reading::new("mass_rate", look.mass_rate, "kg/s"),
            Reading::new("section_mass", mass, "kg"),
            Reading::new("axial_speed", over(look.section.axial, mass), "m/s"),
            Reading::new("tangential_speed", look.tangential_speed, "m/s"),
            Reading::new("section_solid_fraction", mass / o.density / space, "1"),
            Reading::new("fill_ratio", mass / nominal, "1"),
            Reading::new("hopper_bulk_density", look.bulk_density, "kg/m3"),
            Reading::new("screw_torque", look.torque, "N m"),
            Reading::new("screw_power", look.power, "W"),
            Reading::new("turns", look.turns.abs(), "rev"),
        ];
        self.keep_known(&mut row);
        row
    }

    /// Leaves out what a stretch without outlet or hopper cannot say.
    pub(crate) fn keep_known(&self, readings: &mut Vec<Reading>) {
        const OF_THE_HOPPER: [&str; 3] = ["hopper_bulk_density", "fill_ratio", "ratio_to_theory"];
        let (outlet, hopper) = (self.options.outlet.is_some(), self.options.hopper.is_some());
        readings.retain(|reading| {
            (outlet || reading.name != "outlet_mass")
                && (hopper || !OF_THE_HOPPER.contains(&&*reading.name))
        });
    }
}

/// What the screw does to the grains at one moment, about the axis of the options.
struct Drive {
    torque: f64,
    power: f64,
    /// In turns per second, and the angle in rad.
    speed: f64,
    angle: f64,
}

impl Drive {
    /// Of a body that is not there.
    const NONE: Self = Self {
        torque: f64::NAN,
        power: f64::NAN,
        speed: f64::NAN,
        angle: f64::NAN,
    };

    fn of<D: Dim>(screw: &BodyState<D>, axis: &Axis) -> Self {
        let (pose, force) = (&screw.pose, D::to_space(screw.force));
        // The body's torque is about its pivot; that of a body without rotation may be anywhere.
        let torque = screw.torque + (pose.pivot + pose.shift - axis.point).cross(force);
        let across = axis.direction.any_orthonormal_vector();
        let now = pose.turn * across;
        Self {
            torque: -torque.dot(axis.direction),
            power: screw.power(),
            speed: pose.spin.dot(axis.direction) / TAU,
            angle: now.dot(axis.direction.cross(across)).atan2(now.dot(across)),
        }
    }
}

impl Look {
    /// Every number but those of the profile.
    fn numbers(&mut self) -> [&mut f64; 9] {
        [
            &mut self.time,
            &mut self.outlet_mass,
            &mut self.mass_rate,
            &mut self.tangential_speed,
            &mut self.bulk_density,
            &mut self.torque,
            &mut self.power,
            &mut self.turns,
            &mut self.speed,
        ]
    }
}

impl Saved for Look {
    fn save(&self, words: &mut Words) {
        for number in self.clone().numbers() {
            words.put_number(*number);
        }
        self.section.save(words);
        words.put_whole(self.profile.len() as u64);
        self.profile.iter().for_each(|load| load.save(words));
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        for number in self.numbers() {
            *number = words.take_number()?;
        }
        self.section.restore(words)?;
        self.profile = vec![Load::default(); words.take_count(3)?];
        self.profile
            .iter_mut()
            .try_for_each(|load| load.restore(words))
    }
}

impl Saved for Conveying {
    fn save(&self, words: &mut Words) {
        words.put_part("conveying");
        words.put_number(self.angle);
        words.put_whole(self.looks.len() as u64);
        self.looks.iter().for_each(|look| look.save(words));
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("conveying")?;
        self.angle = words.take_number()?;
        self.looks.clear();
        for _ in 0..words.take_count(13)? {
            let mut look = Look::default();
            look.restore(words)?;
            if look.profile.len() != self.bins.count {
                let what = "a profile along the screw has another number of bins";
                return Err(Damaged(what.into()));
            }
            self.looks.push(look);
        }
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Conveying {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let look = self.look(view);
        let row = self.row(&look);
        self.looks.push(look);
        row
    }

    fn report(&self) -> Vec<Reading> {
        self.conveyed()
    }

    fn curves(&self) -> Vec<Curve> {
        self.figures()
    }
}

/// Quotient of two numbers that is not a number where it is not defined.
pub(crate) fn over(a: f64, b: f64) -> f64 {
    if b == 0.0 { f64::NAN } else { a / b }
}
