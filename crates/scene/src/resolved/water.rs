//! Water as text.

use std::fmt::{Result, Write};

use super::quantity;
use crate::scene::{Datum, Flow, FlowProfile, Turbulence, Water};
use crate::units::Dimension;

impl Water {
    pub(super) fn write_to(&self, out: &mut String) -> Result {
        writeln!(out, "    water: (")?;
        let flow = match &self.flow {
            Flow::Shields(shields) => format!("shields: {shields:?}"),
            Flow::FrictionVelocity(speed) => {
                let speed = quantity(Dimension::Velocity, *speed);
                format!("friction_velocity: {speed}")
            }
            Flow::OverTime(rows) => {
                let rows = table(Dimension::Time, rows);
                format!("friction_velocity_over_time: {rows}")
            }
        };
        let profile = match &self.profile {
            FlowProfile::Log { karman } => format!("karman: {karman:?}"),
            FlowProfile::Given(rows) => format!("profile: {}", table(Dimension::Length, rows)),
        };
        let begins = quantity(Dimension::Time, self.begins);
        let density = quantity(Dimension::Density, self.density);
        writeln!(out, "        {flow},")?;
        writeln!(out, "        begins: {begins},")?;
        writeln!(out, "        density: {density},")?;
        writeln!(out, "        added_mass: {:?},", self.added_mass)?;
        writeln!(out, "        drag: {:?},", self.drag)?;
        writeln!(out, "        {profile},")?;
        writeln!(out, "        turbulence: {},", turbulence(&self.turbulence))?;
        writeln!(out, "        shelter: {:?},", self.shelter)?;
        match self.datum {
            Datum::Given(height) => {
                let height = quantity(Dimension::Length, height);
                writeln!(out, "        datum: Given({height}),")?;
            }
            found => {
                writeln!(out, "        datum: {found:?},")?;
                writeln!(out, "        bed_contacts: {},", self.bed_contacts)?;
            }
        }
        writeln!(out, "        slope: {:?},", self.slope)?;
        if self.drag_by_volume {
            writeln!(out, "        coarse_drag: ByVolume,")?;
        }
        writeln!(out, "    ),")
    }
}

fn turbulence(turbulence: &Turbulence) -> String {
    match *turbulence {
        Turbulence::Off => "Off".into(),
        Turbulence::Switched {
            frequency,
            depth,
            seed,
        } => format!(
            "Switched(frequency: {}, depth: {}, seed: {seed})",
            quantity(Dimension::Frequency, frequency),
            quantity(Dimension::Length, depth)
        ),
    }
}

/// Rows of a quantity of this dimension and a velocity.
fn table(dimension: Dimension, rows: &[[f64; 2]]) -> String {
    let rows: Vec<_> = rows
        .iter()
        .map(|[first, speed]| {
            let speed = quantity(Dimension::Velocity, *speed);
            format!("({}, {speed})", quantity(dimension, *first))
        })
        .collect();
    format!("[{}]", rows.join(", "))
}
