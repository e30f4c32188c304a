//! Grains and their laws as text.

use std::fmt::{Result, Write};

use super::quantity;
use crate::scene::{Damping, Grains, Law, SpringConstants, SpringDashpot, Stiffness};
use crate::units::Dimension;

impl Grains {
    pub(super) fn write_to(&self, out: &mut String) -> Result {
        writeln!(out, "    grains: (")?;
        writeln!(
            out,
            "        diameter: {},",
            quantity(Dimension::Length, self.diameter)
        )?;
        self.write_mass(out)?;
        match &self.law {
            Law::Repulsion { stiffness, damping } => {
                let (stiffness, damping) = (stiffness_of(stiffness), damping_of(damping));
                writeln!(
                    out,
                    "        law: Repulsion(stiffness: {stiffness}, damping: {damping}),"
                )?;
                writeln!(out, "        soften: {:?},", self.soften)?;
                writeln!(
                    out,
                    "        softened_damping: {:?},",
                    self.softened_damping
                )?;
            }
            Law::SpringDashpot(law) => law.write_to(out)?,
        }
        writeln!(out, "        coarse: {},", self.coarse)?;
        writeln!(out, "        coarse_rule: {:?},", self.coarse_rule)?;
        writeln!(out, "    ),")
    }

    fn write_mass(&self, out: &mut String) -> Result {
        if self.sizes.is_empty() {
            let mass = quantity(Dimension::Mass, self.mass);
            return writeln!(out, "        mass: {mass}, // {:.6} kg/m3", self.density());
        }
        let density = quantity(Dimension::Density, self.density_of_the_mass());
        writeln!(out, "        density: {density},\n        sizes: [")?;
        for size in &self.sizes {
            let diameter = quantity(Dimension::Length, size.diameter);
            let share = size.share;
            writeln!(out, "            (diameter: {diameter}, share: {share:?}),")?;
        }
        writeln!(out, "        ],")
    }

    /// A density that gives this mass to the bit: mass over volume is one or two roundings off it.
    fn density_of_the_mass(&self) -> f64 {
        let near = self.density();
        let (up, down) = (near.next_up(), near.next_down());
        let all = [near, up, down, up.next_up(), down.next_down()];
        let gives = |density: &f64| density * self.volume() == self.mass;
        all.into_iter().find(gives).unwrap_or(near)
    }
}

impl SpringDashpot {
    fn write_to(&self, out: &mut String) -> Result {
        writeln!(out, "        law: SpringDashpot(")?;
        let constants = constants_of(&self.constants);
        writeln!(out, "            constants: {constants},")?;
        let follows = !matches!(
            self.constants,
            SpringConstants::Given {
                tangential_stiffness: Some(_),
                tangential_damping: Some(_),
                ..
            }
        );
        if follows {
            writeln!(out, "            poisson: {:?},", self.poisson)?;
        }
        writeln!(out, "            friction: {:?},", self.friction)?;
        writeln!(out, "            tension: {:?},", self.tension)?;
        writeln!(out, "            slip: {:?},", self.slip)?;
        writeln!(out, "            normal_force: {:?},", self.normal_force)?;
        writeln!(out, "        ),")
    }
}

fn constants_of(constants: &SpringConstants) -> String {
    let stiff = |value: f64| quantity(Dimension::Stiffness, value);
    let gamma = |value: f64| quantity(Dimension::Damping, value);
    match *constants {
        SpringConstants::FromTimeStep { step, tn, cn, beta } => format!(
            "FromTimeStep(step: {}, tn: {tn:?}, cn: {cn:?}, beta: {beta:?})",
            quantity(Dimension::Time, step)
        ),
        SpringConstants::Given {
            normal_stiffness,
            normal_damping,
            tangential_stiffness,
            tangential_damping,
        } => {
            let mut fields = format!(
                "normal_stiffness: {}, normal_damping: {}",
                stiff(normal_stiffness),
                gamma(normal_damping)
            );
            if let Some(value) = tangential_stiffness {
                fields += &format!(", tangential_stiffness: {}", stiff(value));
            }
            if let Some(value) = tangential_damping {
                fields += &format!(", tangential_damping: {}", gamma(value));
            }
            format!("Given({fields})")
        }
        SpringConstants::FromRestitution {
            normal_stiffness,
            restitution,
        } => format!(
            "FromRestitution(normal_stiffness: {}, restitution: {restitution:?})",
            stiff(normal_stiffness)
        ),
    }
}

fn stiffness_of(stiffness: &Stiffness) -> String {
    match stiffness {
        Stiffness::YoungModulus(modulus) => {
            format!("YoungModulus({})", quantity(Dimension::Pressure, *modulus))
        }
        Stiffness::Energy { epsilon, sigma } => format!(
            "Energy(epsilon: {}, sigma: {})",
            quantity(Dimension::Energy, *epsilon),
            quantity(Dimension::Length, *sigma)
        ),
    }
}

fn damping_of(damping: &Damping) -> String {
    let gamma = |value: f64| quantity(Dimension::Damping, value);
    match damping {
        Damping::Equal(both) => format!("Equal({})", gamma(*both)),
        Damping::Parts { normal, tangential } => format!(
            "Parts(normal: {}, tangential: {})",
            gamma(*normal),
            gamma(*tangential)
        ),
    }
}
