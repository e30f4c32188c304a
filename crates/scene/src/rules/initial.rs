//! The rules of the grains' places at the start.

use std::path::PathBuf;

use glam::DVec3;

use super::Rules;
use crate::raw::{RawFill, RawGrain, RawInitial};
use crate::scene::{Axis, Domain, Fill, Initial, Space, StartingGrain};

impl Rules<'_> {
    pub(super) fn initial(&mut self, raw: RawInitial, domain: &Domain) -> Option<Initial> {
        self.exactly_one(
            "initial",
            &[raw.file.is_some(), raw.fill.is_some(), raw.grains.is_some()],
        );
        match (raw.file, raw.fill, raw.grains) {
            (Some(file), _, _) => Some(Initial::File(self.file(&file))),
            (None, Some(fill), _) => Some(Initial::Fill(self.fill(&fill, domain))),
            (None, None, Some(grains)) => Some(Initial::Grains(self.listed(&grains))),
            (None, None, None) => None,
        }
    }

    fn file(&mut self, file: &str) -> PathBuf {
        if file.trim().is_empty() {
            self.refuse(
                "initial.file",
                "the path of the grain file is empty",
                "write its path, relative to the scene's folder",
            );
        }
        let path = self.folder.join(file);
        std::path::absolute(&path).unwrap_or(path)
    }

    fn fill(&mut self, raw: &RawFill, domain: &Domain) -> Fill {
        let min = DVec3::from_array(raw.region.min.0.map(|length| length.0));
        let max = DVec3::from_array(raw.region.max.0.map(|length| length.0));
        self.in_plane("initial.fill.region.min", min);
        self.in_plane("initial.fill.region.max", max);
        let axes = [
            ("x", domain.x, min.x, max.x),
            ("y", domain.y, min.y, max.y),
            ("z", domain.z, min.z, max.z),
        ];
        for (i, (name, axis, low, high)) in axes.into_iter().enumerate() {
            let flat = self.space == Space::Plane && name == "y";
            if low >= high && !flat {
                let what = format!("the region's max is not above its min along {name}");
                self.refuse(
                    format!("initial.fill.region.max[{i}]"),
                    what,
                    "min is the corner of the smallest x, y and z",
                );
            }
            if let Axis::Periodic(length) = axis {
                // The slack forgives the rounding of decimals.
                let slack = 1e-9 * length;
                for (corner, value) in [("min", low), ("max", high)] {
                    if !(-slack..=length + slack).contains(&value) {
                        let what = format!(
                            "the region leaves the periodic box along {name}, which runs from 0 to {length:?} m"
                        );
                        self.refuse(
                            format!("initial.fill.region.{corner}[{i}]"),
                            what,
                            "keep the region inside",
                        );
                    }
                }
            }
        }
        let solid_fraction = self.above_zero(
            "initial.fill.solid_fraction",
            "the solid fraction",
            raw.solid_fraction.0,
        );
        let (limit, jam) = match self.space {
            Space::Space => (0.36, "0.38"),
            Space::Plane => (0.5, "0.55 of the area"),
        };
        if solid_fraction > limit {
            let what =
                format!("random placing cannot reach this solid fraction: it jams near {jam}");
            let remedy = format!(
                "write at most {limit}, and make the region larger: the grains settle to a denser bed"
            );
            self.refuse("initial.fill.solid_fraction", what, remedy);
        }
        Fill {
            min,
            max,
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
            let at = DVec3::from_array(raw.at.0.map(|length| length.0));
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
