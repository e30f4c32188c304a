//! The rules of the grains' places at the start.

use glam::DVec3;

use super::Rules;
use super::vectors::lengths;
use crate::quantity::Number;
use crate::raw::{RawBed, RawFill, RawGrain, RawInitial};
use crate::scene::{Axis, Bed, Domain, Fill, Initial, Space, StartingGrain};

/// The most layers of a bed; more is a slip of the pen.
const LAYERS: u64 = 10_000;

/// Distance of a bed's lattice in diameters if the scene says none.
pub(super) const SPACING: f64 = 1.07;

/// Columns across a bed in space whose domain says nothing of y.
pub(super) const WIDTH: f64 = 6.0;

impl Rules<'_> {
    pub(super) fn initial(
        &mut self,
        raw: RawInitial,
        domain: &Domain,
        gravity: f64,
    ) -> Option<Initial> {
        self.exactly_one(
            "initial",
            &[
                raw.file.is_some(),
                raw.fill.is_some(),
                raw.grains.is_some(),
                raw.bed.is_some(),
            ],
        );
        match (raw.file, raw.fill, raw.grains) {
            (Some(file), _, _) => Some(Initial::File(self.file("initial.file", "grain", &file))),
            (None, Some(fill), _) => Some(Initial::Fill(self.fill(&fill, domain))),
            (None, None, Some(grains)) => Some(Initial::Grains(self.listed(&grains))),
            (None, None, None) => {
                let bed = raw.bed?;
                self.bed_fits(domain, gravity);
                Some(Initial::Bed(self.bed(&bed)))
            }
        }
    }

    fn fill(&mut self, raw: &RawFill, domain: &Domain) -> Fill {
        let region = raw.region.as_ref().map(|raw| {
            let region = self.region("initial.fill.region", "region", raw);
            self.inside("initial.fill.region", "region", &region, domain);
            region
        });
        let within = raw
            .within
            .as_ref()
            .map(|raw| self.mesh("initial.fill.within", &raw.file, raw.unit));
        if region.is_none() && within.is_none() {
            self.refuse(
                "initial.fill",
                "the field “region” is missing in fill",
                "add region: (min: …, max: …), or within: (file: …, unit: …) to fill a closed mesh",
            );
        }
        if self.space == Space::Plane && within.is_some() {
            self.refuse(
                "initial.fill.within",
                "a plane scene has no inside of a mesh",
                "fill a region, or write space: Space",
            );
        }
        let solid_fraction = self.solid_fraction(
            "initial.fill.solid_fraction",
            raw.solid_fraction.0,
            ", and make the region larger: the grains settle to a denser bed",
        );
        Fill {
            region,
            within,
            solid_fraction,
            seed: raw.seed.0,
        }
    }

    fn listed(&mut self, raw: &[RawGrain]) -> Vec<StartingGrain> {
        if raw.is_empty() {
            self.refuse(
                "initial.grains",
                "the list of grains is empty",
                "list at least one grain: (at: (\"0 mm\", \"0 mm\", \"0 mm\"))",
            );
        }
        let grain = |(i, raw): (usize, &RawGrain)| {
            let at = lengths(&raw.at);
            self.in_plane(&format!("initial.grains[{i}].at"), at);
            let velocity = raw.velocity.map_or(DVec3::ZERO, |velocity| {
                DVec3::from_array(velocity.0.map(|part| part.0))
            });
            self.in_plane(&format!("initial.grains[{i}].velocity"), velocity);
            StartingGrain {
                at,
                velocity,
                population: raw.population.map_or(0, |number| number.0 as usize),
            }
        };
        raw.iter().enumerate().map(grain).collect()
    }

    fn bed(&mut self, raw: &RawBed) -> Bed {
        let layers = raw.layers.0;
        if layers == 0 {
            self.refuse(
                "initial.bed.layers",
                "a bed needs at least one layer above its fixed row",
                "write their number, such as 10",
            );
        }
        if layers > LAYERS {
            self.refuse(
                "initial.bed.layers",
                format!("a bed has at most {LAYERS} layers"),
                "write a smaller number of layers",
            );
        }
        let number = |raw: &Option<Number>, usual: f64| raw.as_ref().map_or(usual, |raw| raw.0);
        let vacancies = self.not_negative(
            "initial.bed.vacancies",
            "the share of vacancies",
            number(&raw.vacancies, 0.1),
        );
        if vacancies > 0.5 {
            self.refuse(
                "initial.bed.vacancies",
                "the share of vacancies is above the usable share of 0.5",
                "with more than half of its places empty a layer is none: write fewer layers for a thinner bed; 0.1 is usual",
            );
        }
        Bed {
            layers: layers.min(LAYERS) as usize,
            spacing: self.within(
                "initial.bed.spacing",
                "the spacing",
                number(&raw.spacing, SPACING),
                [1.0, 2.0],
                "it is the distance of the lattice in diameters: below 1 the grains would overlap; 1.05 to 1.10 are usual",
            ),
            vacancies,
            roughness: self.within(
                "initial.bed.roughness",
                "the roughness",
                number(&raw.roughness, 1.0 / 3.0),
                [0.0, 1.0],
                "it is the standard deviation of the heights of the fixed row in diameters; 0.333 is usual",
            ),
            seed: raw.seed.map_or(1, |seed| seed.0),
        }
    }

    /// What a bed asks of the rest of the scene.
    fn bed_fits(&mut self, domain: &Domain, gravity: f64) {
        if !self.spins() {
            self.refuse(
                "initial.bed",
                "a bed needs grains that hold by friction: those of law SpringDashpot",
                "choose law: SpringDashpot(…), or start from a fill",
            );
        }
        for (name, axis) in [("x", domain.x), ("y", domain.y)] {
            let there = name == "x" || self.space == Space::Space;
            if there && axis == Axis::Open {
                self.refuse(
                    "initial.bed",
                    format!("a bed has no sides, but the axis {name} does not repeat"),
                    format!("write {name}: Periodic(\"…\") in the domain"),
                );
            }
        }
        if gravity == 0.0 {
            self.refuse(
                "gravity",
                "a bed falls together under gravity, but there is none",
                "give gravity a value, or start from a fill",
            );
        }
    }
}
