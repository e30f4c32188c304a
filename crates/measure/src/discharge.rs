//! The observer of a hopper that empties through an opening.

use crate::Steady;
use crate::free::free;
use crate::section::bulk_density;
use glam::DVec3;
use tsubu_model::{Curve, Damaged, Dim, Observer, Reading, Saved, SpinState, View, Words};

/// The opening of a hopper, lengths in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opening {
    /// A circle of this diameter.
    Circle(f64),
    /// A slot of this width, over the depth of the scene.
    Slot {
        /// Its width.
        width: f64,
        /// Depth of the scene.
        depth: f64,
    },
}

impl Opening {
    /// Beverloo's rate in kg/s for grains of this diameter (m), bulk density (kg/m³) and gravity (m/s²).
    ///
    /// ```text
    /// circle: W = C ρb √g (D − k d)^(5/2),        C = 0.58, k = 1.4
    /// slot:   W = 1.03 ρb √g depth (D − k d)^(3/2)
    /// ```
    ///
    /// It holds for openings of six grains and more, under more than their width of grains, in bins 2.5 times as wide. Measured C
    /// lie in 0.55–0.65, k in 1.3–1.6; the 1.03 of slots is known less well.
    ///
    /// Sources: `Beverloo1961`; of slots `Myers1971`.
    ///
    /// ```
    /// use tsubu_measure::Opening;
    /// // 3 mm beads of 1500 kg/m³ through 30 mm: 0.58 · 1500 · 3.1316 · 0.0258^2.5 = 0.2913 kg/s.
    /// let rate = Opening::Circle(0.030).beverloo(3.0e-3, 1500.0, 9.80665);
    /// assert!((rate / 0.2913 - 1.0).abs() < 1e-3);
    /// ```
    pub fn beverloo(&self, diameter: f64, bulk_density: f64, gravity: f64) -> f64 {
        let free = |width: f64| (width - K * diameter).max(0.0);
        match *self {
            Opening::Circle(width) => C * bulk_density * gravity.sqrt() * free(width).powf(2.5),
            Opening::Slot { width, depth } => {
                SLOT * bulk_density * gravity.sqrt() * depth * free(width).powf(1.5)
            }
        }
    }
}

/// Beverloo's constants for a circle, and the constant of a slot.
const C: f64 = 0.58;
const K: f64 = 1.4;
const SLOT: f64 = 1.03;

/// The box over the opening counts as full while it holds this share of what it held when the flow began.
const FULL: f64 = 0.9;

/// What a [`Discharge`] needs to know of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct DischargeOptions {
    /// Number of the outlet among the passages of the view.
    pub outlet: usize,
    /// The opening above it.
    pub opening: Opening,
    /// Two opposite corners of a box over the opening, inside the bin, m: its density is ρb, and as long as it is full the
    /// rate counts.
    pub bin: [DVec3; 2],
    /// Diameter of the grains in m; of a mixture the mean by mass.
    pub diameter: f64,
}

/// The rate at which a hopper empties, beside Beverloo's.
///
/// Rows: `outlet_mass` (kg) through the outlet so far; `mass_rate` (kg/s), its growth since the last look, NaN at the first;
/// `bin_mass` (kg) of the grains in the box.
///
/// Report: `mass_rate` (kg/s), the slope of the outlet's mass over its steady part ([`Steady::of_count`]), looked for from the first
/// grain that left until the box over the opening was no longer full (90 % of what it held then); `steady` (1 or 0) says whether there
/// is one without a drift, else the mean over all of that time is taken; `steady_from` (s); `hopper_bulk_density` (kg/m³), at the last look
/// before a body was taken away and a grain left; `beverloo_rate` (kg/s), [`Opening::beverloo`] with it; `ratio_to_beverloo`.
///
/// Figure: `outlet_mass`, with Beverloo's slope from the steady part on.
///
/// Source: `Beverloo1961`.
#[derive(Clone, Debug)]
pub struct Discharge {
    options: DischargeOptions,
    gravity: f64,
    /// At the last look before the opening was opened, or where it always was before a grain left, kg/m³.
    bulk_density: f64,
    looks: Vec<Look>,
}

#[derive(Clone, Copy, Debug)]
struct Look {
    time: f64,
    outlet: f64,
    bin: f64,
}

impl Discharge {
    /// An observer that has not looked yet.
    pub fn new(options: DischargeOptions) -> Self {
        Self {
            options,
            gravity: 0.0,
            bulk_density: f64::NAN,
            looks: Vec::new(),
        }
    }

    /// From the last look before a grain left to the last one at which the box was full.
    fn flowing(&self) -> &[Look] {
        let begin = self.looks.iter().position(|look| look.outlet > 0.0);
        let Some(begin) = begin.map(|first| first.saturating_sub(1)) else {
            return &[];
        };
        let flow = &self.looks[begin..];
        let full = flow[0].bin * FULL;
        let end = flow.iter().position(|look| look.bin < full);
        &flow[..end.unwrap_or(flow.len())]
    }

    /// The rate, its uncertainty, from when on, and whether it is steady.
    fn rate(&self) -> Option<(f64, f64, f64, bool)> {
        let flow = self.flowing();
        let time: Vec<f64> = flow.iter().map(|look| look.time).collect();
        let mass: Vec<f64> = flow.iter().map(|look| look.outlet).collect();
        if let Some(steady) = Steady::of_count(&time, &mass) {
            let steady_part = (steady.mean, steady.uncertainty, steady.from, !steady.drift);
            return Some(steady_part);
        }
        let (first, last) = (flow.first()?, flow.last()?);
        let span = last.time - first.time;
        let mean = (last.outlet - first.outlet) / span;
        (span > 0.0).then_some((mean, f64::NAN, first.time, false))
    }

    fn beverloo(&self) -> f64 {
        let Self { options, .. } = self;
        options
            .opening
            .beverloo(options.diameter, self.bulk_density, self.gravity)
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Discharge {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let outlet = view.passages()[self.options.outlet].mass;
        self.gravity = D::to_space(view.gravity()).length();
        // Grains fall for a while between the opening and the outlet, and by then they lie looser.
        let opened = view.bodies().iter().any(|body| body.removed_at.is_some());
        if outlet == 0.0 && !opened {
            self.bulk_density = bulk_density(view, self.options.bin);
        }
        let [low, high] = self.options.bin;
        let inside = |x: DVec3| x.cmpge(low).all() && x.cmple(high).all();
        let bin = free(view)
            .filter(|&i| inside(D::to_space(view.position(i))))
            .map(|i| view.kind(i).mass)
            .sum();
        let look = Look {
            time: view.time(),
            outlet,
            bin,
        };
        let rate = self.looks.last().map_or(f64::NAN, |former| {
            (look.outlet - former.outlet) / (look.time - former.time)
        });
        self.looks.push(look);
        vec![
            Reading::new("outlet_mass", outlet, "kg"),
            Reading::new("mass_rate", rate, "kg/s"),
            Reading::new("bin_mass", bin, "kg"),
        ]
    }

    fn report(&self) -> Vec<Reading> {
        let Some((rate, error, from, steady)) = self.rate() else {
            return Vec::new();
        };
        let theory = self.beverloo();
        vec![
            Reading::new("mass_rate", rate, "kg/s").give_or_take(error),
            Reading::new("steady", f64::from(u8::from(steady)), "1"),
            Reading::new("steady_from", from, "s"),
            Reading::new("hopper_bulk_density", self.bulk_density, "kg/m3"),
            Reading::new("beverloo_rate", theory, "kg/s"),
            Reading::new("ratio_to_beverloo", rate / theory, "1").give_or_take(error / theory),
        ]
    }

    fn curves(&self) -> Vec<Curve> {
        let curve = |label: &str, x: Vec<f64>, y: Vec<f64>| Curve {
            figure: "outlet_mass",
            label: label.to_owned(),
            axes: ["time (s)", "mass through the opening (kg)"],
            x,
            y,
        };
        let Some((_, _, from, _)) = self.rate() else {
            return Vec::new();
        };
        let (Some(first), Some(last)) = (
            self.looks.iter().find(|look| look.time >= from),
            self.flowing().last(),
        ) else {
            return Vec::new();
        };
        let measured = curve(
            "tsubu",
            self.looks.iter().map(|look| look.time).collect(),
            self.looks.iter().map(|look| look.outlet).collect(),
        );
        let gone = self.beverloo() * (last.time - first.time);
        let theory = curve(
            "Beverloo's rate, from the steady part on",
            vec![first.time, last.time],
            vec![first.outlet, first.outlet + gone],
        );
        vec![measured, theory]
    }
}

impl Saved for Discharge {
    fn save(&self, words: &mut Words) {
        words.put_part("discharge");
        words.put_number(self.gravity);
        words.put_number(self.bulk_density);
        let numbers: Vec<f64> = self
            .looks
            .iter()
            .flat_map(|look| [look.time, look.outlet, look.bin])
            .collect();
        words.put_numbers(&numbers);
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("discharge")?;
        self.gravity = words.take_number()?;
        self.bulk_density = words.take_number()?;
        let numbers = words.take_numbers()?;
        let look = |three: &[f64]| Look {
            time: three[0],
            outlet: three[1],
            bin: three[2],
        };
        self.looks = numbers.chunks_exact(3).map(look).collect();
        Ok(())
    }
}
