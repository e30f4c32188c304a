//! The rules of water, and what it asks of the rest of the scene.

use super::Rules;
use crate::raw::{RawDatum, RawTurbulence, RawWater};
use crate::scene::{Datum, Flow, FlowProfile, Grains, Initial, Scene, Turbulence, Water};

/// ρ of the water in kg/m³ when the scene does not say.
const DENSITY: f64 = 1000.0;

/// Paper B's turbulence when the scene does not say: Hz, m and the seed.
const FREQUENCY: f64 = 50.0;
const DEPTH: f64 = 0.20;
const SEED: u64 = 1;

/// Contacts from which on a grain belongs to the bed when the scene does not say.
const BED_CONTACTS: u64 = 2;

impl Rules<'_> {
    pub(super) fn water(&mut self, raw: &RawWater) -> Option<Water> {
        let flow = self.strength(raw);
        let begins = raw.begins.map_or(0.0, |time| {
            let name = "the time when the water begins to flow";
            self.not_negative("water.begins", name, time.0)
        });
        let density = raw.density.map_or(DENSITY, |density| {
            self.above_zero("water.density", "the density of the water", density.0)
        });
        let added_mass = raw.added_mass.map_or(0.5, |added| {
            self.not_negative("water.added_mass", "the added mass", added.0)
        });
        let drag = raw.drag.map_or(0.4, |drag| {
            self.not_negative("water.drag", "the drag", drag.0)
        });
        let profile = self.profile(raw);
        let turbulence = self.turbulence(raw.turbulence);
        let shelter = raw.shelter.map_or(0.4, |shelter| {
            let remedy = "it is the share of the drag that is left deep in the bed: 0.4 is usual, 1 is no shelter";
            self.within(
                "water.shelter",
                "the shelter",
                shelter.0,
                [0.0, 1.0],
                remedy,
            )
        });
        let datum = match raw.datum {
            None | Some(RawDatum::Renewed) => Datum::Renewed,
            Some(RawDatum::Frozen) => Datum::Frozen,
            Some(RawDatum::Given(height)) => Datum::Given(height.0),
        };
        let bed_contacts = self.bed_contacts(raw, datum);
        let slope = raw.slope.map_or(0.0, |slope| slope.0);
        if slope.abs() >= 1.0 {
            self.refuse(
                "water.slope",
                "the slope is 45 degrees or more",
                "it is the tangent of the bed's slope, above -1 and below 1: 0.01 falls by 1 cm in 1 m along x",
            );
        }
        Some(Water {
            flow: flow?,
            begins,
            density,
            added_mass,
            drag,
            profile,
            turbulence,
            shelter,
            datum,
            bed_contacts,
            slope,
            drag_by_volume: raw.coarse_drag.is_some(),
        })
    }

    fn strength(&mut self, raw: &RawWater) -> Option<Flow> {
        let (shields, speed) = (&raw.shields, &raw.friction_velocity);
        let over_time = &raw.friction_velocity_over_time;
        self.exactly_one(
            "water",
            &[shields.is_some(), speed.is_some(), over_time.is_some()],
        );
        if let Some(shields) = shields {
            let shields = self.above_zero("water.shields", "the Shields number", shields.0);
            return Some(Flow::Shields(shields));
        }
        let name = "the friction velocity";
        if let Some(speed) = speed {
            let speed = self.above_zero("water.friction_velocity", name, speed.0);
            return Some(Flow::FrictionVelocity(speed));
        }
        let path = "water.friction_velocity_over_time";
        let rows = over_time.as_ref()?.iter();
        let rows: Vec<_> = rows.map(|row| [row.0.0, row.1.0]).collect();
        if let Some(first) = rows.first() {
            self.not_negative(&format!("{path}[0][0]"), "the time", first[0]);
        }
        self.table(path, ["times", name], &rows);
        Some(Flow::OverTime(rows))
    }

    fn profile(&mut self, raw: &RawWater) -> FlowProfile {
        let Some(rows) = &raw.profile else {
            let karman = raw.karman.map_or(0.40, |karman| {
                self.above_zero("water.karman", "karman", karman.0)
            });
            return FlowProfile::Log { karman };
        };
        if raw.karman.is_some() {
            self.refuse(
                "water.karman",
                "a given profile has no von Kármán constant: it would be ignored",
                "remove karman, or the profile",
            );
        }
        let rows: Vec<_> = rows.iter().map(|row| [row.0.0, row.1.0]).collect();
        self.table("water.profile", ["heights", "the velocity"], &rows);
        FlowProfile::Given(rows)
    }

    /// Rows whose first value rises and whose second is a velocity along +x; `names` are those of the two.
    fn table(&mut self, path: &str, [firsts, second]: [&str; 2], rows: &[[f64; 2]]) {
        if rows.is_empty() {
            self.refuse(path, "this table has no rows", "write at least one row");
            return;
        }
        if let Some(i) = (1..rows.len()).find(|&i| rows[i][0] <= rows[i - 1][0]) {
            self.refuse(
                format!("{path}[{i}][0]"),
                format!("the {firsts} do not rise from row to row"),
                "order the rows, and write each once",
            );
        }
        for (i, row) in rows.iter().enumerate() {
            self.not_negative(&format!("{path}[{i}][1]"), second, row[1]);
        }
        if rows.iter().all(|row| row[1] == 0.0) {
            self.refuse(
                path,
                format!("{second} is zero in every row, so the water never flows"),
                "write one above zero, or remove the water",
            );
        }
    }

    fn turbulence(&mut self, raw: Option<RawTurbulence>) -> Turbulence {
        let (frequency, depth, seed) = match raw {
            Some(RawTurbulence::Off) => return Turbulence::Off,
            Some(RawTurbulence::Switched {
                frequency,
                depth,
                seed,
            }) => (frequency, depth, seed),
            None => (None, None, None),
        };
        Turbulence::Switched {
            frequency: frequency.map_or(FREQUENCY, |frequency| {
                let path = "water.turbulence.frequency";
                self.above_zero(path, "the frequency of the turbulence", frequency.0)
            }),
            depth: depth.map_or(DEPTH, |depth| {
                self.above_zero("water.turbulence.depth", "the depth of the water", depth.0)
            }),
            seed: seed.map_or(SEED, |seed| seed.0),
        }
    }

    fn bed_contacts(&mut self, raw: &RawWater, datum: Datum) -> u32 {
        if raw.bed_contacts.is_some() && matches!(datum, Datum::Given(_)) {
            self.refuse(
                "water.bed_contacts",
                "bed_contacts would be ignored: the datum is given",
                "remove it, or write datum: Renewed",
            );
        }
        let contacts = raw.bed_contacts.map_or(BED_CONTACTS, |contacts| contacts.0);
        if contacts > 12 {
            self.refuse(
                "water.bed_contacts",
                "bed_contacts is above 12: no grain has so many neighbours of its size",
                "2 are usual, so that a leaping grain does not lift the datum",
            );
        }
        contacts.min(12) as u32
    }

    /// What water asks of the rest of the scene; the bed asks for the periods and for gravity.
    pub(super) fn water_fits(
        &mut self,
        raw: &RawWater,
        grains: Option<&Grains>,
        initial: Option<&Initial>,
    ) {
        if initial.is_some_and(|initial| !matches!(initial, Initial::Bed(_))) {
            self.refuse(
                "water",
                "water without a bed: nothing says where its bottom is",
                "write initial: (bed: (layers: 10)) and law: SpringDashpot(…), or remove the water",
            );
        }
        if let Some(grains) = grains {
            self.sinks(raw, grains);
            self.coarse_drag(raw, grains);
        }
    }

    /// A bed falls from its lattice: water that looks for it at once finds grains without contacts.
    pub(super) fn bed_has_fallen(&mut self, scene: &Scene) {
        let (Some(water), Initial::Bed(bed)) = (&scene.water, &scene.initial) else {
            return;
        };
        let looks = !matches!(water.datum, Datum::Given(_)) && water.bed_contacts > 0;
        if water.begins != 0.0 || !looks {
            return;
        }
        // Paper B gives ten layers of 0.5 mm 0.4 s: twelve free falls through them.
        let thick = bed.layers as f64 * bed.spacing * scene.grains.diameter;
        let settled = 12e3 * (2.0 * thick / scene.gravity).sqrt();
        let digit = 10_f64.powf(settled.log10().floor()).max(1.0);
        let settled = (settled / digit).ceil() * digit;
        self.refuse(
            "water.begins",
            "the water begins at once, but the bed has yet to fall together: it would find no bed to flow over",
            format!(
                "write begins: \"{settled} ms\" in the block “water” (long enough for such a bed as a rule; time.until counts from the start), or datum: Given(\"…\")"
            ),
        );
    }

    fn sinks(&mut self, raw: &RawWater, grains: &Grains) {
        let density = raw.density.map_or(DENSITY, |density| density.0);
        // The slack forgives the rounding of a density that came from a mass.
        if grains.density() > density * (1.0 + 1e-9) {
            return;
        }
        let field = match raw.density {
            Some(_) => "water.density",
            None => "grains.density",
        };
        self.refuse(
            field,
            "grains no heavier than the water make no bed: they float",
            format!("grains of more than \"{density:?} kg/m3\" sink"),
        );
    }

    fn coarse_drag(&mut self, raw: &RawWater, grains: &Grains) {
        match (grains.coarse > 0, raw.coarse_drag.is_some()) {
            (true, false) => self.refuse(
                "grains.coarse",
                "coarse grains in water need a named rule: their drag grows by λ², their weight by λ³",
                "write coarse_drag: ByVolume in the block “water” for a drag that grows by λ³, or coarse: 0",
            ),
            (false, true) => self.refuse(
                "water.coarse_drag",
                "the grains are not coarse, so coarse_drag would be ignored",
                "remove it, or write coarse: 1 or more",
            ),
            _ => {}
        }
    }
}
