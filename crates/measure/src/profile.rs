//! The height of a deposit along x.

use crate::{Deposit, Slices};
use tsubu_model::{Damaged, Saved, SpinState, View, Words};

/// How a profile is cut into bins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileOptions {
    /// Width of a bin in m; about one grain diameter.
    pub bin: f64,
    /// Some edge of a bin in m: the place of a wall, so that no bin reaches through it.
    pub origin: f64,
    /// Period along y in m; `None` = walled or open: the extent of the grains. Ignored in the plane.
    pub depth: Option<f64>,
}

/// Equivalent height of a deposit in bins along x.
///
/// hₖ = Vₖ / (b W φ): Vₖ content of the grains in bin k (m³, in the plane m²), each sphere split exactly
/// over the bins it covers; b width of the bin, W depth (m, in the plane 1), φ the bulk fraction
/// measured in the same deposit ([`Deposit`]).
///
/// It is the height at which the deposit would stand if it were everywhere as dense as inside: the
/// content-conserving form of the surface where the solid fraction falls to half of the bulk, to which
/// it is equal for a sharp or symmetric transition. The reason to prefer it: no threshold, no
/// highest grain; its mean depends on the grain size only through the looser layer at floor and walls (a
/// constant share of d in height, which leaves slopes alone), so levels of coarse-graining can be compared.
/// Σ hₖ b W φ is the content of the deposit, exactly.
///
/// Not for overhangs and hollows, whose height is that of their filling. Slopes carry the relative
/// error of φ. Loose grains are left out as [`Deposit`] says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Centres of the bins in m, ascending and evenly spaced.
    pub x: Vec<f64>,
    /// Equivalent heights in m.
    pub height: Vec<f64>,
    /// Width of a bin in m.
    pub bin: f64,
    /// Solid fraction well inside the deposit; NaN if there are no grains.
    pub bulk_fraction: f64,
    /// Its standard deviation; NaN if not known.
    pub bulk_uncertainty: f64,
}

impl Saved for Profile {
    fn save(&self, words: &mut Words) {
        words.put_numbers(&self.x);
        words.put_numbers(&self.height);
        for value in [self.bin, self.bulk_fraction, self.bulk_uncertainty] {
            words.put_number(value);
        }
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        self.x = words.take_numbers()?;
        self.height = words.take_numbers()?;
        for value in [
            &mut self.bin,
            &mut self.bulk_fraction,
            &mut self.bulk_uncertainty,
        ] {
            *value = words.take_number()?;
        }
        Ok(())
    }
}

/// No more bins than this: a finer bin is widened, so that a mistyped width cannot fill the memory.
const MOST_BINS: f64 = 1e5;

impl Profile {
    /// The profile of a view's deposit. Empty if there are no grains or the bin is not positive.
    pub fn of<D: Slices, S: SpinState>(view: &dyn View<D, S>, options: ProfileOptions) -> Self {
        Self::of_deposit(
            view,
            &Deposit::of(view, options.depth),
            options.bin,
            options.origin,
        )
    }

    /// The same for a deposit that was already found in this view.
    pub fn of_deposit<D: Slices, S: SpinState>(
        view: &dyn View<D, S>,
        deposit: &Deposit,
        bin: f64,
        origin: f64,
    ) -> Self {
        let mut profile = Self {
            x: Vec::new(),
            height: Vec::new(),
            bin,
            bulk_fraction: deposit.bulk_fraction,
            bulk_uncertainty: deposit.bulk_uncertainty,
        };
        let span = |i: usize| {
            let (x, r) = (
                D::to_space(view.position(i)).x - origin,
                view.kind(i).radius,
            );
            (x - r, x + r)
        };
        let (low, high) = deposit
            .grains
            .iter()
            .map(|&i| span(i))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), (a, b)| {
                (l.min(a), h.max(b))
            });
        if !(bin > 0.0 && bin.is_finite() && low < high) {
            return profile;
        }
        let bin = bin.max((high - low) / MOST_BINS);
        let first = (low / bin).floor();
        let count = ((high / bin).ceil() - first).max(1.0) as usize;
        let mut content = vec![0.0; count];
        for &i in &deposit.grains {
            let (from, to) = span(i);
            let (centre, radius) = (0.5 * (from + to), view.kind(i).radius);
            let from_bin = ((from / bin).floor() - first) as usize;
            let to_bin = ((to / bin).floor() - first) as usize;
            for (k, content) in content
                .iter_mut()
                .enumerate()
                .take(to_bin + 1)
                .skip(from_bin)
            {
                let edge = (first + k as f64) * bin - centre;
                *content += D::slab(radius, edge, edge + bin);
            }
        }
        let area = bin * deposit.depth * deposit.bulk_fraction;
        profile.bin = bin;
        profile.x = (0..count)
            .map(|k| origin + (first + k as f64 + 0.5) * bin)
            .collect();
        profile.height = content.into_iter().map(|c| c / area).collect();
        profile
    }

    /// Area under the profile in m²: content of the deposit / (W φ).
    pub fn area(&self) -> f64 {
        self.bin * self.height.iter().sum::<f64>()
    }
}
