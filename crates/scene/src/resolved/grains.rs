//! Grains and their laws as text.

use std::fmt::{Result, Write};

use super::{quantity, text};
use crate::scene::{
    Damping, Grains, HertzMindlin, Law, Material, Resistance, SpringConstants, SpringDashpot,
    Stiffness,
};
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
        writeln!(out, "        law: {},", law_of(&self.law, "        ")?)?;
        if let Law::Repulsion { .. } = self.law {
            writeln!(out, "        soften: {:?},", self.soften)?;
            writeln!(
                out,
                "        softened_damping: {:?},",
                self.softened_damping
            )?;
        }
        self.write_materials(out)?;
        writeln!(out, "        coarse: {},", self.coarse)?;
        writeln!(out, "        coarse_rule: {:?},", self.coarse_rule)?;
        writeln!(out, "    ),")
    }

    fn write_mass(&self, out: &mut String) -> Result {
        if self.populations.is_empty() {
            let mass = quantity(Dimension::Mass, self.mass);
            return writeln!(out, "        mass: {mass}, // {:.6} kg/m3", self.density());
        }
        let density = quantity(Dimension::Density, self.density_of_the_mass());
        writeln!(out, "        density: {density},\n        populations: [")?;
        for one in &self.populations {
            writeln!(
                out,
                "            (diameter: {}, share: {:?}, density: {}, material: {}),",
                quantity(Dimension::Length, one.diameter),
                one.share,
                quantity(Dimension::Density, one.density),
                text(self.material_name(one.material))
            )?;
        }
        writeln!(out, "        ],")
    }

    fn write_materials(&self, out: &mut String) -> Result {
        writeln!(out, "        material: {},", text(&self.material))?;
        if self.materials.is_empty() {
            return Ok(());
        }
        writeln!(out, "        materials: [")?;
        for Material { name, law } in &self.materials {
            let law = law_of(law, "            ")?;
            writeln!(out, "            (name: {}, law: {law}),", text(name))?;
        }
        writeln!(out, "        ],\n        pairs: [")?;
        for pair in &self.pairs {
            let [a, b] = pair.of.map(|number| text(self.material_name(number)));
            write!(out, "            (of: ({a}, {b})")?;
            if let Some(restitution) = pair.restitution {
                write!(out, ", restitution: {restitution:?}")?;
            }
            if !matches!(self.law, Law::Repulsion { .. }) {
                write!(out, ", friction: {:?}", pair.friction)?;
            }
            if let Some(friction) = pair.rolling_friction {
                write!(out, ", rolling_friction: {friction:?}")?;
            }
            writeln!(out, "),")?;
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

/// A law as it is written, its closing bracket at this indent.
fn law_of(law: &Law, indent: &str) -> std::result::Result<String, std::fmt::Error> {
    Ok(match law {
        Law::Repulsion { stiffness, damping } => {
            let (stiffness, damping) = (stiffness_of(stiffness), damping_of(damping));
            format!("Repulsion(stiffness: {stiffness}, damping: {damping})")
        }
        Law::SpringDashpot(law) => springs_of(law, indent)?,
        Law::HertzMindlin(law) => hertz_of(law),
    })
}

fn hertz_of(law: &HertzMindlin) -> String {
    let rolling = law.rolling.map_or(String::new(), |rolling| {
        let damping = match rolling.by {
            Resistance::Constant => String::new(),
            Resistance::ElasticPlastic => format!(", damping: {:?}", rolling.damping),
        };
        format!(
            ", rolling: (friction: {:?}{damping}, by: {:?})",
            rolling.friction, rolling.by
        )
    });
    format!(
        "HertzMindlin(young: {}, poisson: {:?}, restitution: {:?}, friction: {:?}{rolling})",
        quantity(Dimension::Pressure, law.young),
        law.poisson,
        law.restitution,
        law.friction
    )
}

fn springs_of(law: &SpringDashpot, indent: &str) -> std::result::Result<String, std::fmt::Error> {
    let mut out = String::new();
    writeln!(out, "SpringDashpot(")?;
    let constants = constants_of(&law.constants);
    writeln!(out, "{indent}    constants: {constants},")?;
    let follows = !matches!(
        law.constants,
        SpringConstants::Given {
            tangential_stiffness: Some(_),
            tangential_damping: Some(_),
            ..
        }
    );
    if follows {
        writeln!(out, "{indent}    poisson: {:?},", law.poisson)?;
    }
    writeln!(out, "{indent}    friction: {:?},", law.friction)?;
    writeln!(out, "{indent}    tension: {:?},", law.tension)?;
    writeln!(out, "{indent}    slip: {:?},", law.slip)?;
    writeln!(out, "{indent}    normal_force: {:?},", law.normal_force)?;
    write!(out, "{indent})")?;
    Ok(out)
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
