//! The rules of the grains' places at the start.

use glam::DVec3;

use super::Rules;
use super::vectors::lengths;
use crate::raw::{RawFill, RawGrain, RawInitial};
use crate::scene::{Domain, Fill, Initial, Space, StartingGrain};

impl Rules<'_> {
    pub(super) fn initial(&mut self, raw: RawInitial, domain: &Domain) -> Option<Initial> {
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
            (None, None, None) => raw.bed.map(|bed| Initial::Bed(self.bed(&bed, domain))),
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
            StartingGrain { at, velocity }
        };
        raw.iter().enumerate().map(grain).collect()
    }
}
