//! Crest, front and angle of repose of a profile.
//!
//! All of it is written for a heap against a standing wall at `back` that falls away from that wall to
//! either side: distances s ≥ 0 are counted from the wall outward.
//!
//! The angle of repose depends on the method by several degrees; two are given.
//! * [`flank_angle`]: θ = atan of the slope of the line fitted to the flank between 85 % and 15 % of the height
//!   of the crest, the rule of the wall-removal tests (`Zhou2002`, as quoted in secondary sources; the
//!   paper itself was not checked). It leaves the rounded crest and the thin toe out.
//! * [`runout_angle`]: θ = atan((h_back − d/2)/(s_front)): from the surface at the back wall to the front.

use crate::{Line, Profile};
use tsubu_model::{Damaged, Saved, Words};

/// Where a heap stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Grain diameter d in m (of this level of coarse-graining).
    pub diameter: f64,
    /// x of the standing wall in m.
    pub back: f64,
    /// x of the opposite wall in m, if there is one that the deposit may reach.
    pub far: Option<f64>,
}

/// A value with its standard deviation, if known. NaN if it cannot be measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Its standard deviation.
    pub uncertainty: Option<f64>,
}

impl Saved for Measured {
    fn save(&self, words: &mut Words) {
        words.put_number(self.value);
        words.put_maybe(self.uncertainty);
    }

    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
        self.value = words.take_number()?;
        self.uncertainty = words.take_maybe()?;
        Ok(())
    }
}

const UNKNOWN: Measured = Measured {
    value: f64::NAN,
    uncertainty: None,
};

/// A heap as seen from its back wall: distance outward and height of each bin.
struct Outward {
    s: Vec<f64>,
    h: Vec<f64>,
    /// +1 if outward is towards larger x.
    sign: f64,
    /// Distance of the opposite wall; infinite if there is none.
    far: f64,
}

impl Outward {
    fn new(profile: &Profile, stand: &Stand) -> Self {
        let weight: f64 = profile.height.iter().sum();
        let mean = profile
            .x
            .iter()
            .zip(&profile.height)
            .map(|(x, h)| x * h)
            .sum::<f64>()
            / weight;
        let sign = if stand.far.unwrap_or(mean) < stand.back {
            -1.0
        } else {
            1.0
        };
        let far = stand
            .far
            .map_or(f64::INFINITY, |far| (far - stand.back).abs());
        let mut bins: Vec<(f64, f64)> = profile
            .x
            .iter()
            .map(|x| sign * (x - stand.back))
            .zip(profile.height.iter().copied())
            .collect();
        bins.retain(|(s, _)| *s > 0.0 && *s < far);
        if sign < 0.0 {
            bins.reverse();
        }
        let (s, h) = bins.into_iter().unzip();
        Self { s, h, sign, far }
    }

    /// Number of the highest bin; of equals the innermost.
    fn crest(&self) -> Option<usize> {
        (0..self.h.len())
            .filter(|&k| self.h[k] > 0.0)
            .reduce(|best, k| if self.h[k] > self.h[best] { k } else { best })
    }

    /// First bin from `start` outward that is lower than `level`; the number of bins if there is none.
    fn below(&self, start: usize, level: f64) -> usize {
        (start..self.h.len())
            .find(|&k| self.h[k] < level)
            .unwrap_or(self.h.len())
    }

    /// Place and height of bin `k`; beyond the last one the ground.
    fn at(&self, k: usize, bin: f64) -> (f64, f64) {
        match (self.s.get(k), self.s.last()) {
            (Some(s), _) => (*s, self.h[k]),
            (None, Some(last)) => (last + bin, 0.0),
            (None, None) => (0.0, 0.0),
        }
    }

    /// The bin at which the height passes `level` between `start` and `end`: midway between the first
    /// bin below and the last one above, so that roughness does not favour either.
    fn passes(&self, level: f64, start: usize, end: usize) -> usize {
        let first = self.below(start, level).min(end);
        let last = (start..end)
            .rev()
            .find(|&k| self.h[k] >= level)
            .map_or(start, |k| k + 1);
        first.midpoint(last)
    }

    /// Distance from the back wall at which the height first falls to `level` outward of the crest.
    fn falls_to(&self, level: f64, bin: f64) -> Option<f64> {
        let k = self.below(self.crest()?, level);
        let ((s0, h0), (s1, h1)) = (self.at(k.checked_sub(1)?, bin), self.at(k, bin));
        Some((s0 + (h0 - level) / (h0 - h1) * (s1 - s0)).min(self.far))
    }

    /// Distance of the front, with its uncertainty.
    fn front(&self, bin: f64, d: f64) -> Option<(f64, f64)> {
        let front = self.falls_to(0.5 * d, bin)?;
        let blur = self
            .falls_to(0.75 * d, bin)
            .zip(self.falls_to(0.25 * d, bin))
            .map_or(d, |(inner, outer)| 0.5 * (outer - inner));
        Some((front, blur.hypot(bin / 12f64.sqrt())))
    }

    /// The line through bins `range` whose distance lies within `within`.
    fn line(&self, range: std::ops::Range<usize>, within: [f64; 2]) -> Option<(Line, usize)> {
        let kept: Vec<usize> = range
            .filter(|&k| self.s[k] > within[0] && self.s[k] < within[1])
            .collect();
        let pick = |from: &[f64]| kept.iter().map(|&k| from[k]).collect::<Vec<f64>>();
        Line::fit(&pick(&self.s), &pick(&self.h)).map(|line| (line, kept.len()))
    }
}

/// Height of the highest bin in m; NaN without grains.
pub fn crest_height(profile: &Profile) -> f64 {
    profile.height.iter().copied().fold(f64::NAN, f64::max)
}

/// The front in m: from the crest outward, where the height first falls to d/2, interpolated between the centres of bins.
///
/// So a grain that lies apart does not move it. A deposit that reaches the opposite wall ends there.
/// NaN without grains or when nothing is as high as d/2. The uncertainty takes the height to be known to
/// d/4: half the distance between the places where it falls to 3d/4 and to d/4, joined with b/√12 for the bin b.
pub fn front(profile: &Profile, stand: &Stand) -> Measured {
    let view = Outward::new(profile, stand);
    match view.front(profile.bin, stand.diameter) {
        Some((s, error)) => Measured {
            value: stand.back + view.sign * s,
            uncertainty: Some(error),
        },
        None => UNKNOWN,
    }
}

/// Slope of the flank in degrees, falling outward positive.
///
/// The fit takes all bins between the places where the height passes 85 % and 15 % of the crest: each place
/// midway between the first bin below and the last bin above, because starting at the first low bin and
/// ending at the last high one would flatten a rough flank. The uncertainty joins the error of the fit ([`Line::fit`]) and that of
/// the bulk fraction: σ² = σ_fit² + (tan θ σ_φ/φ)², in degrees times cos² θ.
///
/// Fewer than three such bins: a face too steep for the bins. Then the angle is that of the chord
/// over them, with the uncertainty of two places known to one bin each; it is a lower bound for a vertical face.
/// A bed that reaches the opposite wall without falling that far has no flank: then the line goes
/// through all bins more than d away from both walls, which is about 0° for a flat bed.
/// NaN where there is nothing to fit.
pub fn flank_angle(profile: &Profile, stand: &Stand) -> Measured {
    let view = Outward::new(profile, stand);
    let d = stand.diameter;
    let (Some(crest), Some((front, _))) = (view.crest(), view.front(profile.bin, d)) else {
        return UNKNOWN;
    };
    let end = view
        .below(crest, 0.5 * d)
        .max(view.below(crest, 0.15 * view.h[crest]));
    let upper = view.passes(0.85 * view.h[crest], crest, end);
    let lower = view.passes(0.15 * view.h[crest], upper, end);
    let against_wall = front > view.far - d;
    let free = if against_wall {
        [d, view.far - d]
    } else {
        [0.0, f64::INFINITY]
    };
    let enough = |found: &(Line, usize)| found.1 >= 3;

    let flank = view.line(upper..lower, free).filter(enough);
    let fitted = if flank.is_none() && against_wall {
        view.line(0..view.s.len(), free).filter(enough)
    } else {
        flank
    };
    if let Some((line, _)) = fitted {
        let relative = profile.bulk_uncertainty / profile.bulk_fraction;
        let error = line
            .slope_error
            .map(|e| e.hypot(line.slope * relative))
            .filter(|e| e.is_finite());
        return in_degrees(-line.slope, error);
    }
    let Some(above) = upper.checked_sub(1) else {
        return UNKNOWN;
    };
    if against_wall {
        return UNKNOWN;
    }
    let ((s0, h0), (s1, h1)) = (view.at(above, profile.bin), view.at(lower, profile.bin));
    let tangent = (h0 - h1) / (s1 - s0);
    in_degrees(
        tangent,
        Some(tangent.abs() * profile.bin / 6f64.sqrt() / (s1 - s0)),
    )
}

/// Height over run-out in degrees: atan((h_back − d/2)/s_front).
///
/// h_back is the height at the back wall, from the line through the bins between 1 d and 6 d from it (the first
/// diameter lies looser against the wall); the front is where the height is d/2, so d/2 is taken off
/// above as well: on a straight flank the two methods agree whatever the grain size.
/// The uncertainty joins those of h_back, of the front and of the bulk fraction.
/// NaN without grains, if fewer than two bins lie there, or if the deposit is held up by the opposite wall.
pub fn runout_angle(profile: &Profile, stand: &Stand) -> Measured {
    let view = Outward::new(profile, stand);
    let d = stand.diameter;
    let Some((front, front_error)) = view.front(profile.bin, d) else {
        return UNKNOWN;
    };
    if front > view.far - d {
        return UNKNOWN;
    }
    let Some((line, _)) = view.line(0..view.s.len(), [d, front.min(6.0 * d)]) else {
        return UNKNOWN;
    };
    let tangent = (line.intercept - 0.5 * d) / front;
    let error = line.intercept_error.map(|e| {
        let height = (e / front).powi(2) + (tangent * front_error / front).powi(2);
        (height + (tangent * profile.bulk_uncertainty / profile.bulk_fraction).powi(2)).sqrt()
    });
    in_degrees(tangent, error.filter(|e| e.is_finite()))
}

/// Angle of a slope: dθ = d(tan θ) cos² θ.
fn in_degrees(tangent: f64, error: Option<f64>) -> Measured {
    let cos2 = 1.0 / (1.0 + tangent * tangent);
    Measured {
        value: tangent.atan().to_degrees(),
        uncertainty: error.map(|e| (e * cos2).to_degrees()),
    }
}
