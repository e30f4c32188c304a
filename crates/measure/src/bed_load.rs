//! The observer of a bed that water carries along.

use crate::Slices;
use crate::conveying::over;
use crate::free::free;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_6;
use tsubu_model::{Curve, Damaged, Observer, Reading, Saved, SpinState, Vector, View, Words};

/// Contacts with grains from which on a grain is part of the bed: a leaping grain has fewer.
const BED_CONTACTS: u32 = 2;

/// What a [`BedLoad`] needs to know of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct BedLoadOptions {
    /// Length L of the bed along the flow in m: its period along x.
    pub length: f64,
    /// Width b of the bed in m: its period along y; in the plane the diameter of the largest grain.
    pub width: f64,
    /// Diameter d of the largest grain in m.
    pub diameter: f64,
    /// √((ρs/ρ − 1) g d³) in m²/s: the rate at which qB* is 1.
    pub unit: f64,
    /// Shields number τ* of the water, repeated in the report.
    pub shields: f64,
    /// Reference values of qB* at that τ*, by names fit for a column (`meyer_peter_mueller`) and each its own; none of
    /// them `rate`, `steady`, `steady_from`, `looks` or `d1`, ….
    pub expected: Vec<(&'static str, f64)>,
    /// When the water begins to flow, in s.
    pub begins: f64,
    /// Share of the time since then that is dropped before means are taken, 0 to 1.
    pub skip: f64,
    /// Speed along the flow in m/s above which a grain counts as moving.
    pub moving_speed: f64,
    /// Diameters in m of the size classes of a mixture; none for one size.
    pub sizes: Vec<f64>,
}

/// Transport number, height of the bed and profiles of a movable bed. The water flows along x.
///
/// ```text
/// qB* = qB/√((ρs/ρ − 1) g d³),   qB = (π/6) Σ dᵢ³ uᵢ /(L b)
/// ```
///
/// dᵢ diameter in m and uᵢ velocity along the flow in m/s of grain i, d that of the largest grain; L and b length and width
/// of the bed in m. The sum is over all grains, resting ones too, with its sign: what moves against the flow is taken off.
/// Validity: a bed that is alike along its length; one look is the mean over L at one moment. Grains that no force
/// moves (infinite mass: the fixed row) count nowhere, but for the contacts that others have with them.
///
/// Rows, in this order.
/// * `transport` (1): qB* of this moment.
/// * `transport_rate` (m2/s): qB of this moment, volume without pores.
/// * `moving_fraction` (1): share of the grains whose velocity along the flow is above that of the options; NaN without
///   grains, and so is `centre_of_mass`.
/// * `bed_height` (m): mean height of the centres of the bed grains that lie within d of the highest of them. A bed grain
///   has 2 contacts with grains or more (choice), fixed ones included, walls not; NaN if there is none.
/// * `centre_of_mass` (m): its height, weighted by mass.
/// * `transport_d1`, `transport_d2`, … (1): qB* of each class, with the same unit; only if there are `sizes`, in their
///   order. A grain belongs to the class of the nearest diameter, so the classes sum up to `transport`.
///
/// Report. Looks count from `begins` + `skip` × (last look − `begins`), never before `begins`. Means are over them, with
/// uncertainties from blocks ([`crate::Blocked`]). Where fewer than 8 looks count, as before the water has begun,
/// all means are NaN without uncertainty: that few say nothing of their scatter.
/// * `transport`, `transport_rate`, and with `sizes` `transport_d1`, …: means.
/// * `shields` (1): τ* of the options; and for a reference value named `wong_parker`: `transport_wong_parker` (1), as
///   given, and `ratio_to_wong_parker` (1), the mean over it; NaN where the reference is 0.
/// * `moving_fraction`, `bed_height` (over the looks that have one), `centre_of_mass`: means.
/// * `transport_steady`: 1 if the counted looks have a steady part that does not drift ([`crate::Steady::of`]), else 0; and
///   `transport_steady_from` (s), when it begins, absent if there is none. The means are over all counted looks all the
///   same: where it begins late among them, `skip` is too small.
/// * `transport_looks` (1): how many looks count.
///
/// Figures: `transport` over time with the reference values as level lines from `begins` on; `velocity_profile` and
/// `concentration_profile` of the counted looks; `centre_of_mass` over time.
///
/// The profiles are in layers of d/2 from height 0, and a grain belongs where its centre lies. The solid fraction of a
/// layer is in space (π/6) Σ dᵢ³/(L b d/2), in the plane the share of the area (π/4) Σ dᵢ²/(L d/2). The velocity is
/// weighted by the same content, so solid fraction × velocity × d/2, summed over the layers, is qB in space; in the
/// plane, with grains of one size and b = d, it is 3/2 qB. Rows of a crystal show as peaks, which may exceed 1.
///
/// One 0.5 mm grain in ten moves at 0.1 m/s over L = 40 d, b = d: qB = (π/6) d³ · 0.4/(40 d · d) = 2.618e-6 m²/s;
/// over 4.4974e-5 m²/s for quartz in water qB* = 0.0582.
///
/// Source: `Gotoh2001`, fig. 5 (qB* against τ*) and figs 3 and 4 (centre of mass); the plane form is derived.
#[derive(Clone, Debug)]
pub struct BedLoad {
    pub(crate) options: BedLoadOptions,
    pub(crate) looks: Vec<Look>,
}

/// What one look found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Look {
    pub time: f64,
    /// qB in m²/s, of all and by class.
    pub rate: f64,
    pub rates: Vec<f64>,
    pub moving_fraction: f64,
    pub bed_height: f64,
    pub centre_of_mass: f64,
    /// By their number upward from height 0; only those that hold a grain.
    pub layers: BTreeMap<i64, Layer>,
}

/// Grains of a layer.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Layer {
    /// Solid fraction.
    pub solid: f64,
    /// Sum of solid fraction times velocity along the flow.
    pub carried: f64,
}

impl BedLoad {
    /// An observer that has not looked yet.
    pub fn new(options: BedLoadOptions) -> Self {
        Self {
            options,
            looks: Vec::new(),
        }
    }

    /// Thickness of the layers of the profiles in m.
    pub(crate) fn layer(&self) -> f64 {
        0.5 * self.options.diameter
    }

    /// Number of the class whose diameter is nearest, of equals the first.
    fn class(&self, diameter: f64) -> Option<usize> {
        let off = |k: &usize| (self.options.sizes[*k] - diameter).abs();
        (0..self.options.sizes.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
    }

    fn look<D: Slices, S: SpinState>(&self, view: &dyn View<D, S>) -> Look {
        let o = &self.options;
        let layer_content =
            o.length * <D as Slices>::across(Some(o.width), 0.0, 0.0) * self.layer();
        let mut look = Look {
            time: view.time(),
            rate: 0.0,
            rates: vec![0.0; o.sizes.len()],
            moving_fraction: f64::NAN,
            bed_height: bed_height(view, o.diameter),
            centre_of_mass: f64::NAN,
            layers: BTreeMap::new(),
        };
        let (mut grains, mut moving) = (0.0, 0.0);
        let (mut mass, mut moment) = (0.0, 0.0);
        for i in free(view) {
            let (kind, speed) = (view.kind(i), view.velocity(i).axis(0));
            let height = view.position(i).axis(D::UP);
            let rate = FRAC_PI_6 * kind.diameter().powi(3) * speed / (o.length * o.width);
            look.rate += rate;
            if let Some(class) = self.class(kind.diameter()) {
                look.rates[class] += rate;
            }
            grains += 1.0;
            moving += f64::from(u8::from(speed > o.moving_speed));
            mass += kind.mass;
            moment += kind.mass * height;
            // A cast saturates, so a grain that flew off is in some layer far away.
            let layer = look.layers.entry((height / self.layer()).floor() as i64);
            let (layer, solid) = (layer.or_default(), D::content(kind.radius) / layer_content);
            layer.solid += solid;
            layer.carried += solid * speed;
        }
        look.moving_fraction = over(moving, grains);
        look.centre_of_mass = over(moment, mass);
        look
    }

    fn row(&self, look: &Look) -> Vec<Reading> {
        let unit = self.options.unit;
        let mut row = vec![
            Reading::new("transport", look.rate / unit, "1"),
            Reading::new("transport_rate", look.rate, "m2/s"),
            Reading::new("moving_fraction", look.moving_fraction, "1"),
            Reading::new("bed_height", look.bed_height, "m"),
            Reading::new("centre_of_mass", look.centre_of_mass, "m"),
        ];
        for (k, rate) in look.rates.iter().enumerate() {
            row.push(Reading::new(of_class(k), rate / unit, "1"));
        }
        row
    }
}

/// Name of the transport of a class.
pub(crate) fn of_class(k: usize) -> String {
    format!("transport_d{}", k + 1)
}

/// As the documentation of [`BedLoad`] says; the water finds its datum by the same rule.
fn bed_height<D: Slices, S: SpinState>(view: &dyn View<D, S>, diameter: f64) -> f64 {
    let mut contacts = vec![0u32; view.len()];
    view.touching(&mut |pair| {
        contacts[pair.i] += 1;
        contacts[pair.j] += 1;
    });
    let bed: Vec<f64> = free(view)
        .filter(|&i| contacts[i] >= BED_CONTACTS)
        .map(|i| view.position(i).axis(D::UP))
        .collect();
    let top = bed.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let near = bed.iter().filter(|height| **height >= top - diameter);
    let (sum, count) = near.fold((0.0, 0.0), |(sum, count), height| {
        (sum + height, count + 1.0)
    });
    over(sum, count)
}

impl Saved for Look {
    fn save(&self, words: &mut Words) {
        for value in [
            self.time,
            self.rate,
            self.moving_fraction,
            self.bed_height,
            self.centre_of_mass,
        ] {
            words.put_number(value);
        }
        words.put_numbers(&self.rates);
        words.put_whole(self.layers.len() as u64);
        for (number, layer) in &self.layers {
            words.put_whole(*number as u64);
            words.put_number(layer.solid);
            words.put_number(layer.carried);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        for value in [
            &mut self.time,
            &mut self.rate,
            &mut self.moving_fraction,
            &mut self.bed_height,
            &mut self.centre_of_mass,
        ] {
            *value = words.take_number()?;
        }
        self.rates = words.take_numbers()?;
        self.layers.clear();
        for _ in 0..words.take_count(3)? {
            let number = words.take_whole()? as i64;
            let layer = Layer {
                solid: words.take_number()?,
                carried: words.take_number()?,
            };
            self.layers.insert(number, layer);
        }
        Ok(())
    }
}

impl Saved for BedLoad {
    fn save(&self, words: &mut Words) {
        words.put_part("bed load");
        words.put_whole(self.looks.len() as u64);
        self.looks.iter().for_each(|look| look.save(words));
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        words.take_part("bed load")?;
        self.looks.clear();
        for _ in 0..words.take_count(7)? {
            let mut look = Look::default();
            look.restore(words)?;
            if look.rates.len() != self.options.sizes.len() {
                let what = "a look at the bed has another number of sizes";
                return Err(Damaged(what.into()));
            }
            self.looks.push(look);
        }
        Ok(())
    }
}

impl<D: Slices, S: SpinState> Observer<D, S> for BedLoad {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let look = self.look(view);
        let row = self.row(&look);
        self.looks.push(look);
        row
    }

    fn report(&self) -> Vec<Reading> {
        self.carried()
    }

    fn curves(&self) -> Vec<Curve> {
        self.figures()
    }
}
