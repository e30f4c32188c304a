//! What a [`BedLoad`] has to say at the end: means since the water flows, ratios to reference values, curves.

use crate::bed_load::{Layer, Look, of_class};
use crate::blocks::FEWEST;
use crate::conveyed::{measured, reading, times};
use crate::conveying::over;
use crate::slope::Measured;
use crate::{BedLoad, Blocked, Steady};
use std::collections::BTreeMap;
use tsubu_model::{Curve, Reading};

impl BedLoad {
    /// Entries of the summary, as the documentation of [`BedLoad`] says.
    pub(crate) fn carried(&self) -> Vec<Reading> {
        if self.looks.is_empty() {
            return Vec::new();
        }
        let (o, looks) = (&self.options, self.counted());
        let rate = mean(looks, |look| look.rate);
        let transport = times(rate, 1.0 / o.unit);
        let mut report = vec![
            reading("transport", transport, "1"),
            reading("transport_rate", rate, "m2/s"),
        ];
        for k in 0..o.sizes.len() {
            let class = mean(looks, |look| look.rates[k] / o.unit);
            report.push(reading(of_class(k), class, "1"));
        }
        report.push(Reading::new("shields", o.shields, "1"));
        for (name, value) in &o.expected {
            let ratio = times(transport, over(1.0, *value));
            report.push(Reading::new(format!("transport_{name}"), *value, "1"));
            report.push(reading(format!("ratio_to_{name}"), ratio, "1"));
        }
        let moving = mean(looks, |look| look.moving_fraction);
        let height = mean(looks, |look| look.bed_height);
        let centre = mean(looks, |look| look.centre_of_mass);
        report.push(reading("moving_fraction", moving, "1"));
        report.push(reading("bed_height", height, "m"));
        report.push(reading("centre_of_mass", centre, "m"));
        let (time, rates) = (of(looks, |look| look.time), of(looks, |look| look.rate));
        let steady = Steady::of(&time, &rates).filter(|steady| !steady.drift);
        let is_steady = f64::from(u8::from(steady.is_some()));
        report.push(Reading::new("transport_steady", is_steady, "1"));
        if let Some(steady) = steady {
            report.push(Reading::new("transport_steady_from", steady.from, "s"));
        }
        report.push(Reading::new("transport_looks", looks.len() as f64, "1"));
        report
    }

    /// The looks that count in means.
    fn counted(&self) -> &[Look] {
        let o = &self.options;
        let last = self.looks.last().map_or(f64::NAN, |look| look.time);
        let from = o.begins + o.skip * (last - o.begins).max(0.0);
        // The clock is a sum of steps; one that is due counts.
        let due = |look: &Look| look.time >= from - 1e-9 * last.abs();
        let first = self.looks.iter().position(due);
        &self.looks[first.unwrap_or(self.looks.len())..]
    }

    /// Curves for the figures.
    pub(crate) fn figures(&self) -> Vec<Curve> {
        let (Some(first), Some(last)) = (self.looks.first(), self.looks.last()) else {
            return Vec::new();
        };
        let o = &self.options;
        let curve = |figure, label: &str, axes, x: &[f64], y| Curve {
            figure,
            label: label.into(),
            axes,
            x: x.to_vec(),
            y,
        };
        let time = of(&self.looks, |look| look.time);
        let axes = ["time (s)", "transport qB*"];
        let transport = of(&self.looks, |look| look.rate / o.unit);
        let mut curves = vec![curve("transport", "measured", axes, &time, transport)];
        let flows = [o.begins.max(first.time).min(last.time), last.time];
        for (name, value) in &o.expected {
            let label = name.replace('_', " ");
            curves.push(curve("transport", &label, axes, &flows, vec![*value; 2]));
        }
        let (looks, thick) = (self.counted(), self.layer());
        let layers = summed(looks);
        let middle = |k: &i64| (*k as f64 + 0.5) * thick;
        // A layer without grains has no velocity.
        let (there, speed): (Vec<f64>, Vec<f64>) = layers
            .iter()
            .filter(|(_, layer)| layer.solid > 0.0)
            .map(|(k, layer)| (middle(k), layer.carried / layer.solid))
            .unzip();
        let axes = ["height (m)", "velocity along the flow (m/s)"];
        curves.push(curve("velocity_profile", "measured", axes, &there, speed));
        let (there, solid): (Vec<f64>, Vec<f64>) = layers
            .iter()
            .map(|(k, layer)| (middle(k), layer.solid / looks.len() as f64))
            .unzip();
        let axes = ["height (m)", "solid fraction"];
        let figure = "concentration_profile";
        curves.push(curve(figure, "measured", axes, &there, solid));
        let axes = ["time (s)", "height of the centre of mass (m)"];
        let centre = of(&self.looks, |look| look.centre_of_mass);
        curves.push(curve("centre_of_mass", "measured", axes, &time, centre));
        // What was not measured is not drawn.
        curves.retain(|curve| curve.y.iter().any(|y| y.is_finite()));
        curves
    }
}

fn of(looks: &[Look], value: impl Fn(&Look) -> f64) -> Vec<f64> {
    looks.iter().map(value).collect()
}

/// NaN over looks that are too few.
fn mean(looks: &[Look], value: impl Fn(&Look) -> f64) -> Measured {
    let enough = looks.len() >= FEWEST;
    measured(Blocked::of(&of(looks, value)).filter(|_| enough))
}

/// Layers summed over looks, with an empty one beside each that has none there, so that a gap is drawn as one however wide.
fn summed(looks: &[Look]) -> BTreeMap<i64, Layer> {
    let mut sum: BTreeMap<i64, Layer> = BTreeMap::new();
    for (k, layer) in looks.iter().flat_map(|look| &look.layers) {
        let all = sum.entry(*k).or_default();
        all.solid += layer.solid;
        all.carried += layer.carried;
    }
    let held: Vec<i64> = sum.keys().copied().collect();
    for k in held {
        sum.entry(k.saturating_sub(1)).or_default();
        sum.entry(k.saturating_add(1)).or_default();
    }
    sum
}
