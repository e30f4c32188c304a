//! The rules of outlets and inlets.

use super::Rules;
use super::room::periods;
use crate::raw::{RawFate, RawInlet, RawOutlet, RawRegion};
use crate::scene::{Domain, Fate, Inlet, Outlet, Region};

const TWO: &str = "two outlets or inlets";

impl Rules<'_> {
    pub(super) fn flow(
        &mut self,
        raw_outlets: Vec<RawOutlet>,
        raw_inlets: Vec<RawInlet>,
        domain: &Domain,
    ) -> (Vec<Outlet>, Vec<Inlet>) {
        let mut outlets: Vec<Outlet> = Vec::with_capacity(raw_outlets.len());
        for (i, raw) in raw_outlets.into_iter().enumerate() {
            let twice = outlets.iter().any(|outlet| outlet.name == raw.name);
            outlets.push(self.outlet(i, raw, twice, domain));
        }
        let mut inlets: Vec<Inlet> = Vec::with_capacity(raw_inlets.len());
        for (i, raw) in raw_inlets.into_iter().enumerate() {
            let twice = outlets.iter().any(|outlet| outlet.name == raw.name)
                || inlets.iter().any(|inlet| inlet.name == raw.name);
            inlets.push(self.inlet(&format!("inlets[{i}]"), raw, twice, domain));
        }
        // A grain that is put where it leaves at once would be counted for ever.
        for (i, outlet) in outlets.iter().enumerate() {
            if let Fate::Recycle { into, .. } = &outlet.then {
                self.outside(&format!("outlets[{i}].then"), into, &outlets);
            }
        }
        for (i, inlet) in inlets.iter().enumerate() {
            self.outside(&format!("inlets[{i}].region"), &inlet.region, &outlets);
        }
        (outlets, inlets)
    }

    fn outlet(&mut self, number: usize, raw: RawOutlet, twice: bool, domain: &Domain) -> Outlet {
        let path = &format!("outlets[{number}]");
        self.name(path, ["an outlet", TWO], &raw.name, twice);
        let region_path = format!("{path}.region");
        let region = self.region(&region_path, "region", &raw.region);
        for (i, axis, length) in periods(domain) {
            if region.min[i] > length || region.max[i] < 0.0 {
                self.refuse(
                    region_path.clone(),
                    format!(
                        "no grain gets there: the periodic axis {axis} runs from 0 to {length:?} m"
                    ),
                    "move the region into the periodic box",
                );
            }
        }
        let then = match raw.then {
            None | Some(RawFate::Delete) => Fate::Delete,
            Some(RawFate::Recycle { min, max, seed }) => {
                let path = format!("{path}.then");
                let region = self.region(&path, "box", &RawRegion { min, max });
                self.inside(&path, "box", &region, domain);
                Fate::Recycle {
                    into: region,
                    seed: seed.map_or(number as u64, |seed| seed.0),
                }
            }
        };
        Outlet {
            name: raw.name,
            region,
            then,
        }
    }

    fn inlet(&mut self, path: &str, raw: RawInlet, twice: bool, domain: &Domain) -> Inlet {
        self.name(path, ["an inlet", TWO], &raw.name, twice);
        let region_path = format!("{path}.region");
        let region = self.region(&region_path, "region", &raw.region);
        self.inside(&region_path, "region", &region, domain);
        let solid_fraction = self.solid_fraction(
            &format!("{path}.solid_fraction"),
            raw.solid_fraction.0,
            ": the grains below pack denser by themselves",
        );
        Inlet {
            name: raw.name,
            region,
            solid_fraction,
            seed: raw.seed.0,
        }
    }

    /// Refuses to put grains into an outlet.
    fn outside(&mut self, path: &str, region: &Region, outlets: &[Outlet]) {
        for outlet in outlets {
            if region.overlaps(&outlet.region) {
                let name = &outlet.name;
                self.refuse(
                    path,
                    format!(
                        "grains put in here may be in the outlet “{name}”, and would leave at once"
                    ),
                    "keep this box and the outlet's region apart",
                );
            }
        }
    }
}
