//! What a [`Conveying`] has to say at the end: means over the steady part, ratios to theory, curves.

use crate::conveying::{Look, over};
use crate::screw::{annulus, mass_rate, volume_per_turn};
use crate::section::Load;
use crate::slope::Measured;
use crate::{Blocked, Conveying, Steady};
use std::borrow::Cow;
use tsubu_model::{Curve, Reading};

impl Conveying {
    /// Entries of the summary, as the documentation of [`Conveying`] says.
    pub(crate) fn conveyed(&self) -> Vec<Reading> {
        let Some(last) = self.looks.last() else {
            return Vec::new();
        };
        let (o, part) = (&self.options, self.part());
        let (speed, bulk) = (part.speed(), part.bulk_density());
        let mass = part.mean(|look| look.section.mass);
        let solid = o.density * annulus(o.casing, o.shaft) * o.length();
        let per_turn = volume_per_turn(o.outer, o.shaft, o.pitch);
        // a ρb: what the formula has when a is measured too.
        let filled = times(mass, 1.0 / o.nominal_mass(1.0, o.length()));
        let fill = quotient(filled, bulk);
        let theory = |density| times(density, mass_rate(1.0, per_turn, speed, 1.0));
        let axial = part.mean(|look| over(look.section.axial, look.section.mass));
        let section_rate = part.mean(|look| look.section.axial / o.length());
        let mut report = vec![
            reading("mass_rate", part.rate, "kg/s"),
            reading("ratio_to_theory", quotient(part.rate, theory(bulk)), "1"),
            reading(
                "ratio_to_theory_measured_a",
                quotient(part.rate, theory(filled)),
                "1",
            ),
            reading("fill_ratio", fill, "1"),
            reading(
                "axial_efficiency",
                times(axial, over(1.0, o.pitch * speed)),
                "1",
            ),
            reading("solid_fraction", times(mass, 1.0 / solid), "1"),
            reading("hopper_bulk_density", bulk, "kg/m3"),
            reading(
                "tangential_speed",
                part.mean(|look| look.tangential_speed),
                "m/s",
            ),
            reading("screw_torque", part.mean(|look| look.torque), "N m"),
            reading("screw_power", part.mean(|look| look.power), "W"),
            reading("mass_rate_from_section", section_rate, "kg/s"),
        ];
        if let Some(steady) = part.steady {
            report.push(Reading::new("steady_from", steady.from, "s"));
            if o.outlet.is_some() {
                report.push(Reading::new("steady_turns", steady.blocks as f64, "rev"));
            }
        }
        let steady = f64::from(u8::from(part.steady.is_some()));
        report.push(Reading::new("steady", steady, "1"));
        report.push(Reading::new("turns", last.turns.abs(), "rev"));
        self.keep_known(&mut report);
        report
    }

    /// Curves for the figures.
    pub(crate) fn figures(&self) -> Vec<Curve> {
        if self.looks.is_empty() {
            return Vec::new();
        }
        let (o, part) = (&self.options, self.part());
        let of = |value: &dyn Fn(&Look) -> f64| self.looks.iter().map(value).collect::<Vec<f64>>();
        let (time, middles) = (of(&|look| look.time), self.bins.middles());
        let curve = |figure, label: &str, axes, x: &[f64], y| Curve {
            figure,
            label: label.into(),
            axes,
            x: x.to_vec(),
            y,
        };
        let mut curves = vec![curve(
            "outlet_mass",
            "through the outlet",
            ["time (s)", "mass (kg)"],
            &time,
            of(&|look| look.outlet_mass),
        )];
        let axes = ["time (s)", "mass rate (kg/s)"];
        let rates = of(&|look| look.mass_rate);
        curves.push(curve("mass_rate", "measured", axes, &time, rates));
        let (bulk, speed) = (part.bulk_density().value, part.speed());
        let per_turn = volume_per_turn(o.outer, o.shaft, o.pitch);
        let theory = of(&|look| mass_rate(1.0, per_turn, look.speed.abs(), bulk));
        curves.push(curve("mass_rate", "theory, a = 1", axes, &time, theory));
        let axes = ["distance along the axis (m)", "axial speed (m/s)"];
        let mass = part.profile(self.bins.count, |load| load.mass);
        let axial = part.profile(self.bins.count, |load| load.axial);
        let mean = axial.iter().zip(&mass).map(|(p, m)| over(*p, *m)).collect();
        curves.push(curve("axial_speed", "measured", axes, &middles, mean));
        let plug = vec![o.pitch * speed; self.bins.count];
        curves.push(curve(
            "axial_speed",
            "one pitch per turn",
            axes,
            &middles,
            plug,
        ));
        let axes = ["distance along the axis (m)", "filling ratio"];
        let full = o.nominal_mass(bulk, self.bins.width) * part.looks.len() as f64;
        let fill = mass.iter().map(|m| m / full).collect();
        curves.push(curve("fill", "measured", axes, &middles, fill));
        // What was not measured, such as a theory without a hopper, is not drawn.
        curves.retain(|curve| curve.y.iter().any(|y| y.is_finite()));
        if o.outlet.is_none() {
            curves.retain(|curve| curve.figure != "outlet_mass");
        }
        curves
    }

    /// The steady part of what the outlet passes: whole turns of the screw, since the rate swings once a turn,
    /// from one turn after the section has filled. It drifts where the filling of the section does, which is known better
    /// than the rate of a few turns.
    fn steady(&self, time: &[f64], mass: &[f64]) -> Option<Steady> {
        let half = &self.looks[self.looks.len() / 2..];
        let (a, b) = (half.first()?, half.last()?);
        let turn = over(b.time - a.time, (b.turns - a.turns).abs());
        // What passes a section that repeats does not swing with the turns.
        if !turn.is_finite() || self.options.outlet.is_none() {
            return Steady::of_count(time, mass);
        }
        let section: Vec<f64> = self.looks.iter().map(|look| look.section.mass).collect();
        let filling = Steady::of(time, &section)?;
        let full = filling.from;
        // Full from the first look on, but for what does not fill a cell of the search.
        let at_once = time.get(5).is_none_or(|t| full < *t);
        let from = if at_once {
            f64::NEG_INFINITY
        } else {
            full + turn
        };
        Steady::of_periods(time, mass, turn, from).map(|rate| Steady {
            drift: rate.drift || filling.drift,
            ..rate
        })
    }

    /// The steady part, or else the second half.
    fn part(&self) -> Part<'_> {
        let time: Vec<f64> = self.looks.iter().map(|look| look.time).collect();
        let mass: Vec<f64> = self.looks.iter().map(|look| look.outlet_mass).collect();
        let steady = self.steady(&time, &mass).filter(|steady| !steady.drift);
        let half = time
            .first()
            .zip(time.last())
            .map_or(0.0, |(a, b)| 0.5 * (a + b));
        let from = steady.map_or(half, |steady| steady.from);
        let first = time.partition_point(|t| *t < from - 1e-9 * from.abs());
        let rate = match steady {
            Some(steady) => Measured {
                value: steady.mean,
                uncertainty: Some(steady.uncertainty),
            },
            None => measured(Blocked::of_count(&time[first..], &mass[first..])),
        };
        Part {
            steady,
            rate,
            looks: &self.looks[first..],
        }
    }
}

/// The looks over which means are taken.
struct Part<'a> {
    steady: Option<Steady>,
    rate: Measured,
    looks: &'a [Look],
}

impl Part<'_> {
    fn mean(&self, value: impl Fn(&Look) -> f64) -> Measured {
        measured(Blocked::of(
            &self.looks.iter().map(value).collect::<Vec<_>>(),
        ))
    }

    /// Turns per second.
    fn speed(&self) -> f64 {
        let ends = self.looks.first().zip(self.looks.last());
        ends.map_or(f64::NAN, |(a, b)| {
            over((b.turns - a.turns).abs(), b.time - a.time)
        })
    }

    fn bulk_density(&self) -> Measured {
        self.mean(|look| look.bulk_density)
    }

    /// Sum of the profiles, for each bin.
    fn profile(&self, bins: usize, value: impl Fn(&Load) -> f64) -> Vec<f64> {
        let sum = |k: usize| self.looks.iter().map(|look| value(&look.profile[k])).sum();
        (0..bins).map(sum).collect()
    }
}

/// A mean as a measured value; NaN if there is none.
pub(crate) fn measured(mean: Option<Blocked>) -> Measured {
    Measured {
        value: mean.map_or(f64::NAN, |mean| mean.mean),
        uncertainty: mean.and_then(|mean| mean.uncertainty),
    }
}

pub(crate) fn times(a: Measured, factor: f64) -> Measured {
    Measured {
        value: a.value * factor,
        uncertainty: a.uncertainty.map(|error| (error * factor).abs()),
    }
}

/// Quotient of two measured values as if they were independent.
fn quotient(a: Measured, b: Measured) -> Measured {
    let value = over(a.value, b.value);
    let part = |a: f64, b: f64| (a / b.abs()).abs();
    Measured {
        value,
        uncertainty: a
            .uncertainty
            .zip(b.uncertainty)
            .map(|(ea, eb)| part(ea, b.value).hypot(value * part(eb, b.value)))
            .filter(|error| error.is_finite()),
    }
}

/// A reading with its uncertainty, if known and there is a value.
pub(crate) fn reading(
    name: impl Into<Cow<'static, str>>,
    measured: Measured,
    unit: &'static str,
) -> Reading {
    Reading {
        name: name.into(),
        value: measured.value,
        uncertainty: measured
            .uncertainty
            .filter(|error| error.is_finite() && measured.value.is_finite()),
        unit,
    }
}
