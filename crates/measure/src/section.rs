//! What lies between a screw and its casing at one moment, and how densely grains lie in the hopper above.

use crate::Slices;
use crate::free::free;
use glam::DVec3;
use tsubu_model::{Damaged, Dim, Kind, Saved, Space, SpinState, View, Words};

/// Most bins of a profile, whatever the options say.
const MOST_BINS: usize = 256;
/// A layer of the hopper counts as full at this share of the densest layer.
const FULL: f64 = 0.75;

/// The axis of a screw and how far from it grains belong to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub point: DVec3,
    /// Of length 1.
    pub direction: DVec3,
    /// Inner radius of the casing in m.
    pub reach: f64,
    /// From where along the axis and with what length the scene repeats, if it does.
    pub repeats: Option<(f64, f64)>,
}

impl Axis {
    /// Place along the axis in m, and the arm from the axis.
    fn locate(&self, x: DVec3) -> (f64, DVec3) {
        let from_point = x - self.point;
        let along = from_point.dot(self.direction);
        let arm = from_point - self.direction * along;
        // Between two builds of the lists a grain may be a little outside the period.
        let place = self.repeats.map_or(along, |(from, period)| {
            let into = (along - from).rem_euclid(period);
            // The remainder of a tiny negative number rounds to the period itself.
            from + if into < period { into } else { 0.0 }
        });
        (place, arm)
    }

    /// Speed along the axis, and around it counter-clockwise seen against its direction; 0 on the axis itself.
    fn speeds(&self, arm: DVec3, v: DVec3) -> (f64, f64) {
        let around = self.direction.cross(arm.normalize_or_zero());
        (v.dot(self.direction), v.dot(around))
    }
}

/// Mass and momenta of the grains in a stretch of the screw.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Load {
    /// In kg.
    pub mass: f64,
    /// Σ m v along the axis, in kg m/s.
    pub axial: f64,
    /// Σ m v around the axis, in kg m/s.
    pub around: f64,
}

impl Saved for Load {
    fn save(&self, words: &mut Words) {
        for value in [self.mass, self.axial, self.around] {
            words.put_number(value);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        for value in [&mut self.mass, &mut self.axial, &mut self.around] {
            *value = words.take_number()?;
        }
        Ok(())
    }
}

impl Load {
    fn add(&mut self, mass: f64, (axial, around): (f64, f64)) {
        self.mass += mass;
        self.axial += mass * axial;
        self.around += mass * around;
    }
}

/// Bins of equal width along the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bins {
    pub from: f64,
    pub width: f64,
    pub count: usize,
}

impl Bins {
    /// Bins of about this width from `range.0` to `range.1`.
    pub fn over(range: (f64, f64), width: f64) -> Self {
        let length = range.1 - range.0;
        // Casts saturate, so nonsense gives one bin or the most.
        let count = ((length / width).round() as usize).clamp(1, MOST_BINS);
        Self {
            from: range.0,
            width: length / count as f64,
            count,
        }
    }

    pub fn middles(&self) -> Vec<f64> {
        (0..self.count)
            .map(|k| self.from + (k as f64 + 0.5) * self.width)
            .collect()
    }

    fn of(&self, along: f64) -> Option<usize> {
        let k = ((along - self.from) / self.width).floor();
        (k >= 0.0 && k < self.count as f64).then_some(k as usize)
    }
}

/// What lies in the section, and in each bin. Grains belong where their centre is; immovable ones are no load.
pub(crate) fn loads<D: Dim, S: SpinState>(
    view: &dyn View<D, S>,
    axis: &Axis,
    section: (f64, f64),
    bins: &Bins,
) -> (Load, Vec<Load>) {
    let mut whole = Load::default();
    let mut parts = vec![Load::default(); bins.count];
    for i in free(view) {
        let (along, arm) = axis.locate(D::to_space(view.position(i)));
        if arm.length_squared() > axis.reach * axis.reach {
            continue;
        }
        let mass = view.kind(i).mass;
        let speeds = axis.speeds(arm, D::to_space(view.velocity(i)));
        if along >= section.0 && along < section.1 {
            whole.add(mass, speeds);
        }
        if let Some(bin) = bins.of(along) {
            parts[bin].add(mass, speeds);
        }
    }
    (whole, parts)
}

/// Bulk density in kg/m³ inside a box; NaN where nothing lies in it.
///
/// The box is shrunk by one diameter (of its largest grain) on each side, so that a box given by the walls measures
/// what walls do not order. It is cut into level layers about two diameters thick, and each grain is shared out to them
/// by the volume of its slices. Layers count that hold at least ¾ of the densest; if there are layers above them that do
/// not, the free surface is in the box, and the uppermost that counts is left out too, because the surface may lie in it.
/// The bulk density is the mass in those layers over their volume.
///
/// Bias: across x and y a grain counts by its centre, which is right on average for a random packing. In rows of a
/// crystal a face may take one row more or less, a share of about d over the width of the box. A hole beside the flow
/// lowers the value.
pub(crate) fn bulk_density<D: Dim, S: SpinState>(view: &dyn View<D, S>, hopper: [DVec3; 2]) -> f64 {
    let (low, high) = (hopper[0].min(hopper[1]), hopper[0].max(hopper[1]));
    let within = |x: DVec3, low: DVec3, high: DVec3| x.cmpge(low).all() && x.cmplt(high).all();
    let grains: Vec<(DVec3, &Kind)> = free(view)
        .map(|i| (D::to_space(view.position(i)), view.kind(i)))
        .filter(|(x, kind)| kind.radius > 0.0 && within(*x, low, high))
        .collect();
    let diameter = grains
        .iter()
        .map(|(_, kind)| kind.diameter())
        .fold(0.0, f64::max);
    let margin = DVec3::splat(diameter);
    let (foot, size) = (low + margin, high - low - 2.0 * margin);
    if grains.is_empty() || size.min_element() <= 0.0 {
        return f64::NAN;
    }
    // A cast saturates, so a tall box gets the most layers.
    let layers = ((size.z / (2.0 * diameter)).round() as usize).clamp(1, MOST_BINS);
    let thick = size.z / layers as f64;
    let mut mass = vec![0.0; layers];
    for (x, kind) in grains {
        let beside = DVec3::new(x.x, x.y, foot.z);
        if !within(beside, foot, foot + size) {
            continue;
        }
        let below = (x.z - kind.radius - foot.z) / thick;
        let above = (x.z + kind.radius - foot.z) / thick;
        // Casts saturate at 0 and the last layer is the most, so the range is never outside.
        let last = (above.max(0.0) as usize).min(layers - 1);
        let first = (below.max(0.0) as usize).min(last);
        for (k, layer) in (first..).zip(&mut mass[first..=last]) {
            let from = foot.z + k as f64 * thick - x.z;
            let share = Space::slab(kind.radius, from, from + thick) / Space::content(kind.radius);
            *layer += kind.mass * share;
        }
    }
    let densest = mass.iter().copied().fold(0.0, f64::max);
    if densest <= 0.0 {
        return f64::NAN;
    }
    let mut full: Vec<usize> = (0..layers).filter(|&k| mass[k] >= FULL * densest).collect();
    let surface_inside = full.last().is_some_and(|top| *top + 1 < layers);
    if surface_inside && full.len() > 1 {
        full.pop();
    }
    let volume = size.x * size.y * thick * full.len() as f64;
    full.iter().map(|&k| mass[k]).sum::<f64>() / volume
}
