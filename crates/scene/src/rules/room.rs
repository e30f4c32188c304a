//! The rules of the domain and of boxes in it.

use super::Rules;
use super::vectors::lengths;
use crate::raw::{RawAxis, RawDomain, RawRegion};
use crate::scene::{Axis, Domain, Region, Space};

impl Rules<'_> {
    /// The domain; a bed in space that says nothing of y repeats at its usual width.
    pub(super) fn domain(
        &mut self,
        raw: RawDomain,
        width_of_bed: Option<f64>,
        gravity: f64,
    ) -> Domain {
        if self.space == Space::Plane && raw.y.is_some() {
            self.refuse(
                "domain.y",
                "a plane scene has no y axis",
                "remove y, or write space: Space",
            );
        }
        if gravity > 0.0 && matches!(raw.z, Some(RawAxis::Periodic(_))) {
            self.refuse(
                "domain.z",
                "grains would fall for ever through a periodic z",
                "write z: Open, or gravity: \"0 m/s2\"",
            );
        }
        let y = match (raw.y, width_of_bed) {
            (None, Some(width)) if self.space == Space::Space => Axis::Periodic(width),
            (y, _) => self.axis("domain.y", y),
        };
        Domain {
            x: self.axis("domain.x", raw.x),
            y,
            z: self.axis("domain.z", raw.z),
        }
    }

    fn axis(&mut self, path: &str, raw: Option<RawAxis>) -> Axis {
        match raw {
            None | Some(RawAxis::Open) => Axis::Open,
            Some(RawAxis::Periodic(length)) => Axis::Periodic(self.above_zero(
                &format!("{path}[0]"),
                "the periodic length",
                length.0,
            )),
        }
    }

    /// A box, whatever the domain; `name` is what it is called in messages.
    pub(super) fn region(&mut self, path: &str, name: &str, raw: &RawRegion) -> Region {
        let (min, max) = (lengths(&raw.min), lengths(&raw.max));
        self.in_plane(&format!("{path}.min"), min);
        self.in_plane(&format!("{path}.max"), max);
        for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let flat = self.space == Space::Plane && axis == "y";
            if min[i] >= max[i] && !flat {
                self.refuse(
                    format!("{path}.max[{i}]"),
                    format!("the {name}'s max is not above its min along {axis}"),
                    "min is the corner of the smallest x, y and z",
                );
            }
        }
        Region { min, max }
    }

    /// Refuses a box in which grains are to be placed, but which leaves the periodic box.
    pub(super) fn inside(&mut self, path: &str, name: &str, region: &Region, domain: &Domain) {
        for (i, axis, length) in periods(domain) {
            // The slack forgives the rounding of decimals.
            let slack = 1e-9 * length;
            for (corner, value) in [("min", region.min[i]), ("max", region.max[i])] {
                if !(-slack..=length + slack).contains(&value) {
                    let what = format!(
                        "the {name} leaves the periodic box along {axis}, which runs from 0 to {length:?} m"
                    );
                    self.refuse(
                        format!("{path}.{corner}[{i}]"),
                        what,
                        format!("keep the {name} inside"),
                    );
                }
            }
        }
    }

    /// Refuses a solid fraction that random placing does not reach.
    pub(super) fn solid_fraction(&mut self, path: &str, value: f64, instead: &str) -> f64 {
        let value = self.above_zero(path, "the solid fraction", value);
        let (limit, jam) = match self.space {
            Space::Space => (0.36, "0.38"),
            Space::Plane => (0.5, "0.55 of the area"),
        };
        if value > limit {
            let what =
                format!("random placing cannot reach this solid fraction: it jams near {jam}");
            self.refuse(path, what, format!("write at most {limit}{instead}"));
        }
        value
    }
}

/// The periodic axes: their number, name and length.
pub(super) fn periods(domain: &Domain) -> impl Iterator<Item = (usize, &'static str, f64)> {
    let axes = [("x", domain.x), ("y", domain.y), ("z", domain.z)];
    axes.into_iter()
        .enumerate()
        .filter_map(|(i, (name, axis))| match axis {
            Axis::Open => None,
            Axis::Periodic(length) => Some((i, name, length)),
        })
}
