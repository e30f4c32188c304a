//! The rules of the measures that a scene asks for.

use super::Rules;
use crate::quantity::{Length, Quantity};
use crate::raw::{RawBedMeasure, RawConveying, RawDischarge, RawMeasures, RawOpening};
use crate::scene::{
    Axis, BedMeasure, Conveying, Discharge, Domain, Measures, Opening, Outlet, Shape, Space, Wall,
};

/// Share of the flow's time that is dropped when the scene does not say.
const SKIP: f64 = 0.25;

impl Rules<'_> {
    pub(super) fn measures(
        &mut self,
        raw: Option<&RawMeasures>,
        walls: &[Wall],
        outlets: &[Outlet],
        domain: &Domain,
        water: bool,
    ) -> Measures {
        let conveying = raw.and_then(|raw| raw.conveying.as_ref());
        let bed = raw.and_then(|raw| raw.bed);
        let discharge = raw.and_then(|raw| raw.discharge.as_ref());
        if let (Some(_), Some(_)) = (conveying, discharge) {
            self.refuse(
                "measures.discharge",
                "a scene measures one rate: that of a screw or that of a hopper",
                "remove discharge, or conveying",
            );
        }
        Measures {
            conveying: conveying.map(|raw| self.conveying(raw, walls, outlets, domain)),
            bed: self.bed_measure(bed, water),
            discharge: discharge.map(|raw| self.discharge(raw, outlets, domain)),
        }
    }

    /// Where water flows its transport is measured, asked for or not.
    fn bed_measure(&mut self, raw: Option<RawBedMeasure>, water: bool) -> Option<BedMeasure> {
        if raw.is_some() && !water {
            self.refuse(
                "measures.bed",
                "no water moves a bed here, so this measure would be ignored",
                "remove it, or add the block “water”",
            );
        }
        let skip = raw.and_then(|raw| raw.skip).map_or(SKIP, |skip| skip.0);
        if !(0.0..1.0).contains(&skip) {
            self.refuse(
                "measures.bed.skip",
                "skip is outside [0, 1)",
                "it is the share of the flow's time that is dropped before means are taken; 0.25 is usual",
            );
        }
        water.then_some(BedMeasure { skip })
    }

    fn discharge(&mut self, raw: &RawDischarge, outlets: &[Outlet], domain: &Domain) -> Discharge {
        let path = |field: &str| format!("measures.discharge.{field}");
        let names = outlets.iter().map(|outlet| outlet.name.as_str());
        let outlet = self.found(&path("outlet"), "outlet", &raw.outlet, names);
        let mut width = |length: Quantity<Length>| {
            self.above_zero(&path("opening[0]"), "the width of the opening", length.0)
        };
        let opening = match raw.opening {
            RawOpening::Circle(diameter) => Opening::Circle(width(diameter)),
            RawOpening::Slot(across) => Opening::Slot(width(across)),
        };
        let deep = self.space == Space::Plane || domain.y != Axis::Open;
        match opening {
            Opening::Circle(_) if self.space == Space::Plane => self.refuse(
                path("opening"),
                "a plane scene has no circular opening",
                "write Slot(\"…\"), or space: Space",
            ),
            Opening::Slot(_) if !deep => self.refuse(
                path("opening"),
                "a slot is as deep as the scene, but the axis y does not repeat",
                "write y: Periodic(\"…\") in the domain, or Circle(\"…\")",
            ),
            _ => {}
        }
        Discharge {
            outlet: outlet.unwrap_or(0),
            opening,
            bin: self.region(&path("bin"), "box", &raw.bin),
        }
    }

    fn conveying(
        &mut self,
        raw: &RawConveying,
        walls: &[Wall],
        outlets: &[Outlet],
        domain: &Domain,
    ) -> Conveying {
        let path = |field: &str| format!("measures.conveying.{field}");
        if self.space == Space::Plane {
            self.refuse(
                "measures.conveying",
                "a screw does not convey in a plane scene",
                "remove the measure, or write space: Space",
            );
        }
        let names = walls.iter().map(|wall| wall.name.as_str());
        let screw = self.found(&path("screw"), "wall", &raw.screw, names);
        let names = outlets.iter().map(|outlet| outlet.name.as_str());
        let outlet = raw.outlet.as_ref();
        let outlet = outlet.and_then(|outlet| self.found(&path("outlet"), "outlet", outlet, names));
        let conveying = Conveying {
            screw: screw.unwrap_or(0),
            pitch: self.above_zero(&path("pitch"), "the pitch", raw.pitch.0),
            outer: self.above_zero(&path("outer"), "the outer diameter", raw.outer.0),
            shaft: self.not_negative(&path("shaft"), "the diameter of the shaft", raw.shaft.0),
            section: raw.section.0.map(|length| length.0),
            casing: self.above_zero(&path("casing"), "the diameter of the casing", raw.casing.0),
            hopper: raw
                .hopper
                .as_ref()
                .map(|raw| self.region(&path("hopper"), "box", raw)),
            outlet,
        };
        self.above(
            &path("outer"),
            ["the outer diameter", "that of the shaft"],
            conveying.outer,
            conveying.shaft,
        );
        self.above(
            &path("casing"),
            ["the diameter of the casing", "that of the screw"],
            conveying.casing,
            conveying.outer,
        );
        let [first, last] = conveying.section;
        if first >= last {
            self.refuse(
                path("section[1]"),
                "the section does not end behind its beginning",
                "write it as (beginning, end), along the axis of the screw's turn from the turn's point",
            );
        }
        if let Some(wall) = screw.and_then(|screw| walls.get(screw)) {
            self.turns(&path("screw"), wall);
            self.agrees(wall, &conveying);
            self.counts_once(wall, &conveying, domain);
        }
        conveying
    }

    /// The place of a name in its list.
    fn found<'a>(
        &mut self,
        path: &str,
        kind: &str,
        name: &str,
        names: impl Iterator<Item = &'a str> + Clone,
    ) -> Option<usize> {
        let found = names.clone().position(|other| other == name);
        if found.is_none() {
            let all: Vec<_> = names.collect();
            let remedy = if all.is_empty() {
                format!("the scene has no {kind}: add one of this name")
            } else {
                format!("write one of {}", all.join(", "))
            };
            self.refuse(path, format!("no {kind} is named “{name}”"), remedy);
        }
        found
    }

    fn turns(&mut self, path: &str, wall: &Wall) {
        let turn = wall.motion.as_ref().and_then(|motion| motion.turn);
        if turn.is_none_or(|turn| turn.rate == 0.0) {
            self.refuse(
                path,
                format!(
                    "the wall “{}” does not turn, so it conveys nothing",
                    wall.name
                ),
                "give it a motion: (turn: (point: …, axis: …, rate: …)) of a rate other than zero",
            );
        }
    }

    /// A section along a periodic axis holds no grain twice.
    fn counts_once(&mut self, wall: &Wall, conveying: &Conveying, domain: &Domain) {
        let [first, last] = conveying.section;
        let period = conveying.period(wall, domain);
        // The slack forgives the rounding of decimals.
        if let Some(period) = period.filter(|period| last - first > period * (1.0 + 1e-9)) {
            self.refuse(
                "measures.conveying.section[1]",
                format!("the section is longer than the period of {period:?} m along the screw"),
                "end it at most one period behind its beginning",
            );
        }
    }

    /// Where the wall's shape says what the measure says, both say the same.
    fn agrees(&mut self, wall: &Wall, conveying: &Conveying) {
        let Shape::Screw {
            shaft,
            outer,
            pitch,
            ..
        } = wall.shape
        else {
            return;
        };
        for (field, said, is) in [
            ("pitch", conveying.pitch, pitch),
            ("outer", conveying.outer, outer),
            ("shaft", conveying.shaft, shaft),
        ] {
            // The slack forgives the rounding of units.
            if (said - is).abs() > 1e-9 * is.abs() {
                self.refuse(
                    format!("measures.conveying.{field}"),
                    format!("the shape of the wall “{}” has another {field}", wall.name),
                    format!("write {field}: \"{is:?} m\", as the shape has it"),
                );
            }
        }
    }
}
