//! Springs, beds and water as text.

use std::fmt::{Result, Write};

use super::quantity;
use crate::scene::{
    Bed, Datum, Flow, FlowProfile, SpringConstants, SpringDashpot, Turbulence, Water,
};
use crate::units::Dimension;

pub(super) fn springs(law: &SpringDashpot) -> String {
    let stiffness = |value: f64| quantity(Dimension::Stiffness, value);
    let damping = |value: f64| quantity(Dimension::Damping, value);
    let constants = match law.constants {
        SpringConstants::FromTimeStep { step, tn, cn, beta } => format!(
            "FromTimeStep(step: {}, tn: {tn:?}, cn: {cn:?}, beta: {beta:?})",
            quantity(Dimension::Time, step)
        ),
        SpringConstants::FromRestitution {
            normal_stiffness,
            restitution,
        } => format!(
            "FromRestitution(normal_stiffness: {}, restitution: {restitution:?})",
            stiffness(normal_stiffness)
        ),
        SpringConstants::Given {
            normal_stiffness,
            tangential_stiffness,
            normal_damping,
            tangential_damping,
        } => {
            let across = tangential_stiffness
                .map(|k| format!(", tangential_stiffness: {}", stiffness(k)))
                .unwrap_or_default();
            let damped = tangential_damping
                .map(|c| format!(", tangential_damping: {}", damping(c)))
                .unwrap_or_default();
            format!(
                "Given(normal_stiffness: {}, normal_damping: {}{across}{damped})",
                stiffness(normal_stiffness),
                damping(normal_damping)
            )
        }
    };
    format!(
        "SpringDashpot(constants: {constants}, poisson: {:?}, friction: {:?}, tension: {:?}, slip: {:?}, normal_force: {:?})",
        law.poisson, law.friction, law.tension, law.slip, law.normal_force
    )
}

impl Bed {
    pub(super) fn write_to(&self, out: &mut String) -> Result {
        let Bed {
            layers,
            spacing,
            vacancies,
            roughness,
            seed,
        } = self;
        writeln!(
            out,
            "        bed: (layers: {layers}, spacing: {spacing:?}, vacancies: {vacancies:?}, roughness: {roughness:?}, seed: {seed}),"
        )
    }
}

impl Water {
    pub(super) fn write_to(&self, out: &mut String) -> Result {
        let speed = |value: f64| quantity(Dimension::Velocity, value);
        let rows = |rows: &[[f64; 2]], dimension: Dimension| {
            let row =
                |row: &[f64; 2]| format!("({}, {})", quantity(dimension, row[0]), speed(row[1]));
            format!("[{}]", rows.iter().map(row).collect::<Vec<_>>().join(", "))
        };
        writeln!(out, "    water: (")?;
        match &self.flow {
            Flow::Shields(shields) => writeln!(out, "        shields: {shields:?},")?,
            Flow::FrictionVelocity(value) => {
                writeln!(out, "        friction_velocity: {},", speed(*value))?;
            }
            Flow::OverTime(table) => writeln!(
                out,
                "        friction_velocity_over_time: {},",
                rows(table, Dimension::Time)
            )?,
        }
        writeln!(
            out,
            "        begins: {},",
            quantity(Dimension::Time, self.begins)
        )?;
        writeln!(
            out,
            "        density: {},",
            quantity(Dimension::Density, self.density)
        )?;
        writeln!(
            out,
            "        added_mass: {:?}, drag: {:?},",
            self.added_mass, self.drag
        )?;
        match &self.profile {
            FlowProfile::Log { karman } => writeln!(out, "        karman: {karman:?},")?,
            FlowProfile::Given(table) => {
                writeln!(out, "        profile: {},", rows(table, Dimension::Length))?;
            }
        }
        match self.turbulence {
            Turbulence::Off => writeln!(out, "        turbulence: Off,")?,
            Turbulence::Switched {
                frequency,
                depth,
                seed,
            } => writeln!(
                out,
                "        turbulence: Switched(frequency: {}, depth: {}, seed: {seed}),",
                quantity(Dimension::Frequency, frequency),
                quantity(Dimension::Length, depth)
            )?,
        }
        writeln!(out, "        shelter: {:?},", self.shelter)?;
        match self.datum {
            Datum::Given(height) => {
                writeln!(
                    out,
                    "        datum: Given({}),",
                    quantity(Dimension::Length, height)
                )?;
            }
            datum => writeln!(out, "        datum: {datum:?},")?,
        }
        writeln!(
            out,
            "        bed_contacts: {}, slope: {:?},",
            self.bed_contacts, self.slope
        )?;
        if self.drag_by_volume {
            writeln!(out, "        coarse_drag: ByVolume,")?;
        }
        writeln!(out, "    ),")
    }
}
