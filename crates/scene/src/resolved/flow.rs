//! Outlets, inlets and measures as text.

use std::fmt::{Result, Write};

use super::{quantity, region, text};
use crate::scene::{Conveying, Fate, Opening, Scene};
use crate::units::Dimension;

impl Scene {
    pub(super) fn write_flow(&self, out: &mut String) -> Result {
        writeln!(out, "    outlets: [")?;
        for outlet in &self.outlets {
            let then = match &outlet.then {
                Fate::Delete => "Delete".into(),
                Fate::Recycle { into, seed } => format!("Recycle({}, seed: {seed})", region(into)),
            };
            let (name, region) = (text(&outlet.name), region(&outlet.region));
            writeln!(
                out,
                "        (name: {name}, region: ({region}), then: {then}),"
            )?;
        }
        writeln!(out, "    ],\n    inlets: [")?;
        for inlet in &self.inlets {
            let (name, region) = (text(&inlet.name), region(&inlet.region));
            let (solid_fraction, seed) = (inlet.solid_fraction, inlet.seed);
            writeln!(
                out,
                "        (name: {name}, region: ({region}), solid_fraction: {solid_fraction:?}, seed: {seed}),"
            )?;
        }
        writeln!(out, "    ],")
    }

    pub(super) fn write_measures(&self, out: &mut String) -> Result {
        writeln!(out, "    measures: (")?;
        if let Some(bed) = &self.measures.bed {
            writeln!(out, "        bed: (skip: {:?}),", bed.skip)?;
        }
        if let Some(discharge) = &self.measures.discharge {
            let outlet = self.outlets.get(discharge.outlet).map_or("", |o| &o.name);
            let opening = match discharge.opening {
                Opening::Circle(width) => format!("Circle({})", quantity(Dimension::Length, width)),
                Opening::Slot(width) => format!("Slot({})", quantity(Dimension::Length, width)),
            };
            writeln!(
                out,
                "        discharge: (outlet: {}, opening: {opening}, bin: ({})),",
                text(outlet),
                region(&discharge.bin)
            )?;
        }
        if let Some(conveying) = &self.measures.conveying {
            self.write_conveying(conveying, out)?;
        }
        writeln!(out, "    ),")
    }

    fn write_conveying(&self, conveying: &Conveying, out: &mut String) -> Result {
        // The names that the numbers of a checked scene stand for.
        let screw = self.walls.get(conveying.screw).map(|wall| &wall.name);
        let outlet = conveying.outlet.and_then(|number| self.outlets.get(number));
        writeln!(out, "        conveying: (")?;
        for (field, name) in [("screw", screw), ("outlet", outlet.map(|out| &out.name))] {
            if let Some(name) = name {
                writeln!(out, "            {field}: {},", text(name))?;
            }
        }
        conveying.write_to(out)?;
        writeln!(out, "        ),")
    }
}

impl Conveying {
    fn write_to(&self, out: &mut String) -> Result {
        let length = |value: f64| quantity(Dimension::Length, value);
        for (field, value) in [
            ("pitch", self.pitch),
            ("outer", self.outer),
            ("shaft", self.shaft),
            ("casing", self.casing),
        ] {
            writeln!(out, "            {field}: {},", length(value))?;
        }
        let section = self.section.map(length).join(", ");
        writeln!(out, "            section: ({section}),")?;
        match &self.hopper {
            Some(hopper) => writeln!(out, "            hopper: ({}),", region(hopper)),
            None => Ok(()),
        }
    }
}
