//! A checked scene back as text, every default filled in, every quantity in SI.

mod flow;
mod grains;
mod walls;
mod water;

use std::fmt::Write;

use glam::DVec3;

use crate::raw::MESH_UNITS;
use crate::scene::{
    Axis, Bed, End, Fill, Initial, Integrator, MeshFile, Output, Region, Scene, Space,
    StartingGrain, Step,
};
use crate::units::{Dimension, write};

impl Scene {
    /// The scene as a complete scene file: it reads back to the same scene, from whatever folder.
    pub fn to_resolved_ron(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write_to(&mut out);
        out
    }

    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "// The scene as it was run: overrides and defaults filled in, in SI units.\n("
        )?;
        writeln!(out, "    title: {},", text(&self.title))?;
        writeln!(out, "    space: {:?},", self.space)?;
        writeln!(
            out,
            "    gravity: {},",
            quantity(Dimension::Acceleration, self.gravity)
        )?;
        self.grains.write_to(out)?;
        let domain = &self.domain;
        match self.space {
            Space::Space => writeln!(
                out,
                "    domain: (x: {}, y: {}, z: {}),",
                axis(domain.x),
                axis(domain.y),
                axis(domain.z)
            )?,
            Space::Plane => writeln!(
                out,
                "    domain: (x: {}, z: {}),",
                axis(domain.x),
                axis(domain.z)
            )?,
        }
        writeln!(out, "    walls: [")?;
        for wall in &self.walls {
            wall.write_to(out, &self.grains)?;
        }
        writeln!(out, "    ],")?;
        self.initial.write_to(out)?;
        self.write_flow(out)?;
        if let Some(water) = &self.water {
            water.write_to(out)?;
        }
        if let Some(still) = &self.still {
            let for_at_least = quantity(Dimension::Time, still.for_at_least);
            let at_most = quantity(Dimension::Time, still.at_most);
            writeln!(
                out,
                "    still: (kinetic_energy: {:?}, for_at_least: {for_at_least}, at_most: {at_most}, damping: {:?}),",
                still.kinetic_energy, still.damping
            )?;
        }
        writeln!(out, "    time: (")?;
        writeln!(out, "        step: {},", step(self.time.step))?;
        writeln!(
            out,
            "        integrator: {},",
            integrator(self.time.integrator)
        )?;
        match self.time.end {
            End::Until(time) => {
                writeln!(out, "        until: {},", quantity(Dimension::Time, time))?
            }
            End::Steps(count) => writeln!(out, "        steps: {count},")?,
        }
        writeln!(out, "    ),")?;
        match self.skin {
            Some(skin) => writeln!(out, "    neighbours: (skin: {skin:?}),")?,
            None => writeln!(out, "    neighbours: (), // the program chooses the skin")?,
        }
        self.write_measures(out)?;
        self.output.write_to(out)?;
        writeln!(out, ")")
    }
}

impl Initial {
    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "    initial: (")?;
        match self {
            Initial::File(path) => {
                writeln!(out, "        file: {},", text(&path.display().to_string()))?
            }
            Initial::Fill(fill) => fill.write_to(out)?,
            Initial::Bed(bed) => bed.write_to(out)?,
            Initial::Grains(grains) => {
                writeln!(out, "        grains: [")?;
                for StartingGrain {
                    at,
                    velocity,
                    population,
                } in grains
                {
                    let (at, velocity) = (
                        triple(Dimension::Length, *at),
                        triple(Dimension::Velocity, *velocity),
                    );
                    let population = match population {
                        0 => String::new(),
                        more => format!(", population: {more}"),
                    };
                    writeln!(
                        out,
                        "            (at: {at}, velocity: {velocity}{population}),"
                    )?;
                }
                writeln!(out, "        ],")?;
            }
        }
        writeln!(out, "    ),")
    }
}

impl Bed {
    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "        bed: (")?;
        writeln!(out, "            layers: {},", self.layers)?;
        writeln!(out, "            spacing: {:?},", self.spacing)?;
        writeln!(out, "            vacancies: {:?},", self.vacancies)?;
        writeln!(out, "            roughness: {:?},", self.roughness)?;
        writeln!(out, "            seed: {},", self.seed)?;
        writeln!(out, "        ),")
    }
}

impl Fill {
    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "        fill: (")?;
        if let Some(corners) = &self.region {
            writeln!(out, "            region: ({}),", region(corners))?;
        }
        if let Some(mesh) = &self.within {
            writeln!(out, "            within: ({}),", mesh_file(mesh))?;
        }
        writeln!(
            out,
            "            solid_fraction: {:?},",
            self.solid_fraction
        )?;
        writeln!(out, "            seed: {},", self.seed)?;
        writeln!(out, "        ),")
    }
}

impl Output {
    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(out, "    output: (")?;
        if let Some(every) = self.every {
            writeln!(out, "        every: {},", quantity(Dimension::Time, every))?;
        }
        writeln!(out, "        frames: {},", self.frames)?;
        if let Some(every) = self.frames_every {
            writeln!(
                out,
                "        frames_every: {},",
                quantity(Dimension::Time, every)
            )?;
        }
        writeln!(out, "        energies: {},", self.energies)?;
        writeln!(out, "        animation: {},", self.animation)?;
        writeln!(out, "    ),")
    }
}

/// A text in quotes; what RON cannot hold as it is, escaped.
pub(crate) fn text(text: &str) -> String {
    let mut out = String::from("\"");
    for sign in text.chars() {
        match sign {
            '"' | '\\' => out.extend(['\\', sign]),
            sign if sign.is_control() => out.extend(sign.escape_unicode()),
            sign => out.push(sign),
        }
    }
    out.push('"');
    out
}

fn quantity(dimension: Dimension, value: f64) -> String {
    format!("\"{}\"", write(dimension, value))
}

fn triple(dimension: Dimension, value: DVec3) -> String {
    format!(
        "({})",
        value
            .to_array()
            .map(|part| quantity(dimension, part))
            .join(", ")
    )
}

fn numbers(value: DVec3) -> String {
    let parts = value.to_array().map(|part| format!("{part:?}"));
    format!("({})", parts.join(", "))
}

/// The corners of a box, without brackets around them.
fn region(region: &Region) -> String {
    let corner = |value| triple(Dimension::Length, value);
    format!("min: {}, max: {}", corner(region.min), corner(region.max))
}

/// The fields of a mesh file, without brackets around them.
fn mesh_file(mesh: &MeshFile) -> String {
    let known = MESH_UNITS.iter().find(|(_, metres)| *metres == mesh.unit);
    // A scene made by hand may have another unit; that is refused when it is read, not written as a false one.
    let unit = known.map_or_else(
        || quantity(Dimension::Length, mesh.unit),
        |(symbol, _)| text(symbol),
    );
    format!(
        "file: {}, unit: {unit}",
        text(&mesh.path.display().to_string())
    )
}

fn axis(axis: Axis) -> String {
    match axis {
        Axis::Open => "Open".into(),
        Axis::Periodic(length) => format!("Periodic({})", quantity(Dimension::Length, length)),
    }
}

fn step(step: Step) -> String {
    match step {
        Step::Automatic => "Automatic".to_owned(),
        Step::PerPeriod(count) => format!("PerPeriod({count:?})"),
        Step::Seconds(time) => format!("Seconds({})", quantity(Dimension::Time, time)),
        Step::Exactly(time) => format!("Exactly({})", quantity(Dimension::Time, time)),
    }
}

fn integrator(integrator: Integrator) -> String {
    match integrator {
        Integrator::VerletAveraged { sweeps } => format!("VerletAveraged(sweeps: {sweeps})"),
        Integrator::DashpotImplicit { sweeps } => format!("DashpotImplicit(sweeps: {sweeps})"),
        plain => format!("{plain:?}"),
    }
}
