//! Filling a body with grains on a face-centred cubic lattice: a wall made of grains.

use crate::solid::{Misshapen, demand, demand_length};
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;
use tsubu_model::{HitBuffer, Space, Surface};

/// What becomes of parts too thin to hold a whole grain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Thin {
    /// They stay empty: every grain lies wholly inside the body.
    #[default]
    Leave,
    /// One layer of grains in their middle, sticking out of both faces alike.
    OneLayer,
}

/// How near two grains of a layer may be, in radii. At 1.5 three neighbours leave a hole of at most
/// half a radius between them, so that no grain larger than half a wall grain slips through.
const LAYER: f64 = 1.5;
/// Places of the search for thin parts, in radii.
const SEEDS: f64 = 0.5;
/// The cosine between the outward normals of two faces that count as opposite: a wedge of 37° does.
const OPPOSITE: f64 = -0.8;
/// Tries to find the middle between two faces; opposite ones need ten at most.
const MOST_TRIES: usize = 30;
/// The most places that are tried; above it a radius is more likely a slip of units.
const MOST: f64 = 2e9;

/// Centres of grains of radius `rs` (m) on an fcc lattice inside a body.
///
/// Nearest neighbours touch: lattice constant a = 2√2·rs, four grains per a³, solid fraction
/// π/(3√2) = 0.7405. The lattice begins at `bounds[0]` + rs, its axes are the coordinate axes.
/// A place is taken if its whole grain is inside: distance ≤ −rs, to 1e-9·rs. Paper A's body of
/// grains (`Sumitomo2024`, §4) is this.
///
/// With [`Thin::OneLayer`] a part thinner than 2 rs between two opposite faces gets grains on its
/// middle surface too, at least 1.5 rs from each other and from those of the lattice, and never
/// farther than about 1.5 rs from a place of the middle surface that is missing one. Their spheres
/// stick out of both faces by rs − half the thickness: a body of grains is thicker there than its
/// surface. Edges of thick parts are not filled up.
///
/// An error if `rs` is not a positive length or so small that more than 2e9 places would be tried. Rows of
/// places are walked in strides of the distance, on all cores; the result does not depend on them.
///
/// ```
/// use glam::DVec3;
/// use tsubu_model::Space;
/// use tsubu_sdf::{Cuboid, Thin, fill_fcc};
/// // A block of 40 × 40 × 40 mm, grains of 2.5 mm radius: a = 7.071 mm.
/// let corners = [DVec3::ZERO, DVec3::splat(0.040)];
/// let block = Cuboid::<Space>::new(corners[0], corners[1])?;
/// let grains = fill_fcc(&block, corners, 0.0025, Thin::Leave)?;
/// assert_eq!(grains.len(), 500);                     // ten layers of fifty
/// # Ok::<(), tsubu_sdf::Misshapen>(())
/// ```
pub fn fill_fcc(
    surface: &dyn Surface<Space>,
    bounds: [DVec3; 2],
    rs: f64,
    thin: Thin,
) -> Result<Vec<DVec3>, Misshapen> {
    demand_length("radius of wall grains", rs)?;
    let size = bounds[1] - bounds[0];
    demand(size.is_finite() && size.min_element() >= 0.0, || {
        format!("the box to fill runs from {} to {}", bounds[0], bounds[1])
    })?;
    let finest = if thin == Thin::OneLayer {
        SEEDS * rs
    } else {
        rs
    };
    let places = (size / finest + 1.0).element_product();
    demand(places < MOST, || {
        format!("grains of {rs} m in a box of {size} m would need {places:.1e} places to be tried")
    })?;
    let mut centres = lattice(surface, bounds, rs);
    if thin == Thin::OneLayer {
        add_layer(surface, bounds, rs, &mut centres);
    }
    Ok(centres)
}

/// How many steps of this length lie within `free`, at least one.
fn stride(free: f64, step: f64) -> u64 {
    // Rounding may not carry over a place at the end.
    ((free / step * (1.0 - 1e-9)) as u64).max(1)
}

/// The fcc places whose grains lie inside.
fn lattice(surface: &dyn Surface<Space>, [low, high]: [DVec3; 2], rs: f64) -> Vec<DVec3> {
    let half = std::f64::consts::SQRT_2 * rs;
    let deep_enough = rs * (1.0 - 1e-9);
    let count = |a: usize| {
        let room = high[a] - low[a] - 2.0 * rs;
        // A last layer that fits but for rounding is tried; the distance decides.
        (room / half + 1e-9).floor()
    };
    let counts = [count(0), count(1), count(2)];
    if counts.iter().any(|&c| c < 0.0) {
        return Vec::new();
    }
    let [nx, ny, nz] = counts.map(|c| c as u64);
    let layer = |k: u64| {
        let mut probe = Probe::new(surface);
        let mut taken = Vec::new();
        for j in 0..=ny {
            // Every second place of the grid of half constants, in a chequerboard.
            let mut i = (j + k) % 2;
            while i <= nx {
                let x = low + rs + half * DVec3::new(i as f64, j as f64, k as f64);
                // How far around no grain is inside.
                let free = surface.lower_bound(x) + deep_enough;
                if free <= 0.0 && probe.depth(x, 0.0) >= deep_enough {
                    taken.push(x);
                }
                i += 2 * stride(free, 2.0 * half);
            }
        }
        taken
    };
    (0..=nz).into_par_iter().flat_map_iter(layer).collect()
}

/// Adds grains on the middle surface of parts thinner than a grain.
fn add_layer(
    surface: &dyn Surface<Space>,
    [low, high]: [DVec3; 2],
    rs: f64,
    centres: &mut Vec<DVec3>,
) {
    let mut near = Near::new(LAYER * rs);
    for &x in centres.iter() {
        near.add(x);
    }
    let step = SEEDS * rs;
    let [nx, ny, nz] = ((high - low) / step).ceil().to_array().map(|n| n as u64);
    let layer = |k: u64| {
        let mut probe = Probe::new(surface);
        let mut middles = Vec::new();
        for j in 0..=ny {
            let mut i = 0;
            while i <= nx {
                let seed = low + step * DVec3::new(i as f64, j as f64, k as f64);
                match probe.face(seed, step) {
                    Ok(face) => {
                        middles.extend(probe.middle(face, rs));
                        i += 1;
                    }
                    Err(free) => i += stride(free, step),
                }
            }
        }
        middles
    };
    let middles: Vec<DVec3> = (0..=nz).into_par_iter().flat_map_iter(layer).collect();
    // In the order of the seeds, since each grain keeps later ones away.
    for middle in middles {
        if !near.has_one_at(middle) {
            near.add(middle);
            centres.push(middle);
        }
    }
}

/// Asks a surface about one point at a time.
struct Probe<'a> {
    surface: &'a dyn Surface<Space>,
    out: HitBuffer<Space>,
}

impl<'a> Probe<'a> {
    fn new(surface: &'a dyn Surface<Space>) -> Self {
        Self {
            surface,
            out: HitBuffer::default(),
        }
    }

    /// The nearest place: distance and normal, if it is nearer than `reach`.
    fn nearest(&mut self, x: DVec3, reach: f64) -> Option<(f64, DVec3)> {
        self.out.hits.clear();
        self.surface.hits(&[x], &[reach], &mut self.out);
        let hits = self.out.hits.iter();
        let hit = hits.min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()))?;
        Some((hit.distance, hit.normal))
    }

    /// How deep inside a point is in m; negative outside, where it is not known beyond `reach`.
    fn depth(&mut self, x: DVec3, reach: f64) -> f64 {
        let nearest = self.nearest(x, reach);
        nearest.map_or(-reach, |(distance, _)| -distance)
    }

    /// The nearest place of the surface and its normal, if it is within `step` of the seed; else how
    /// far around the seed there is none within `step` either, in m.
    fn face(&mut self, seed: DVec3, step: f64) -> Result<(DVec3, DVec3), f64> {
        let bound = self.surface.lower_bound(seed);
        if bound >= step {
            return Err(bound - step);
        }
        match self.nearest(seed, step) {
            None => Err(0.0),
            Some((distance, _)) if distance < -step => Err(-distance - step),
            Some((distance, normal)) => Ok((seed - normal * distance, normal)),
        }
    }

    /// The middle between a face, given by a place and its normal, and the opposite one, if the two
    /// are less than 2 rs apart.
    fn middle(&mut self, (face, normal): (DVec3, DVec3), rs: f64) -> Option<DVec3> {
        let at = |s: f64| face - normal * s;
        // Inwards the depth is the way gone until the opposite face is as near: the middle. Beyond it
        // the depth falls as fast as the way grows, if that face is parallel, so that the next try is
        // in the middle of both; another face takes a few tries more.
        let mut top = rs;
        for tries in 0.. {
            let depth = self.depth(at(top), 2.0 * rs);
            if depth >= top - 1e-7 * rs {
                break;
            }
            if tries == MOST_TRIES {
                return None;
            }
            top = 0.5 * (top + depth);
        }
        // A part that holds a whole grain, or the face of a point.
        if top >= rs * (1.0 - 1e-6) || top <= 1e-6 * rs {
            return None;
        }
        let aside = (0.01 * rs).min(0.5 * top);
        // Only between two faces that look away from each other: not at the edge of a thick part.
        let before = self.nearest(at(top - aside), 0.0)?.1;
        let after = self.nearest(at(top + aside), 0.0)?.1;
        (before.dot(after) < OPPOSITE).then(|| at(top))
    }
}

/// Points in cells of one spacing, to ask whether one is nearer than that.
struct Near {
    spacing: f64,
    cells: HashMap<[i64; 3], Vec<DVec3>>,
}

impl Near {
    fn new(spacing: f64) -> Self {
        Self {
            spacing,
            cells: HashMap::new(),
        }
    }

    fn cell(&self, x: DVec3) -> [i64; 3] {
        (x / self.spacing).floor().to_array().map(|c| c as i64)
    }

    fn add(&mut self, x: DVec3) {
        self.cells.entry(self.cell(x)).or_default().push(x);
    }

    fn has_one_at(&self, x: DVec3) -> bool {
        let [i, j, k] = self.cell(x);
        let around = |c: i64| c - 1..=c + 1;
        around(i).any(|i| {
            around(j).any(|j| {
                around(k).any(|k| {
                    let cell = self.cells.get(&[i, j, k]);
                    cell.is_some_and(|points| {
                        points.iter().any(|p| (*p - x).length() < self.spacing)
                    })
                })
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ball, Cuboid, Hand, Screw, ScrewSize};
    use std::f64::consts::PI;

    fn closest_pair(points: &[DVec3]) -> f64 {
        let mut least = f64::INFINITY;
        for (k, a) in points.iter().enumerate() {
            for b in &points[k + 1..] {
                least = least.min((*a - *b).length());
            }
        }
        least
    }

    #[test]
    fn a_ball_is_filled_to_the_density_of_fcc_and_no_grain_sticks_out() {
        let ball = Ball::<Space>::new(DVec3::ONE, 1.0).unwrap();
        let rs = 0.05;
        let centres = fill_fcc(&ball, ball.bounds_of(), rs, Thin::Leave).unwrap();
        for &x in &centres {
            assert!((x - DVec3::ONE).length() + rs <= 1.0 + 1e-9);
        }
        assert!((closest_pair(&centres) - 2.0 * rs).abs() < 1e-12);
        // Centres fill a ball of radius 1 − rs with one per 4√2 rs³.
        let expected = 4.0 / 3.0 * PI * 0.95f64.powi(3) / (4.0 * 2f64.sqrt() * rs.powi(3));
        let share = centres.len() as f64 / expected;
        assert!((share - 1.0).abs() < 0.02, "{share}");
        let solid = centres.len() as f64 * (rs / 0.95).powi(3);
        assert!((solid - PI / (3.0 * 2f64.sqrt())).abs() < 0.02, "{solid}");
        // Every grain of the ball but those near its surface has twelve neighbours.
        let middle = centres
            .iter()
            .min_by(|a, b| (**a - 1.0).length().total_cmp(&(**b - 1.0).length()))
            .unwrap();
        let touching = centres
            .iter()
            .filter(|x| (**x - *middle).length() < 2.01 * rs);
        assert_eq!(touching.count(), 13);
    }

    #[test]
    fn a_thin_plate_gets_one_layer_in_its_middle_only_if_asked_for() {
        let rs = 0.05;
        let bounds = [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.06)];
        let plate = Cuboid::<Space>::new(bounds[0], bounds[1]).unwrap();
        assert!(
            fill_fcc(&plate, bounds, rs, Thin::Leave)
                .unwrap()
                .is_empty()
        );
        let layer = fill_fcc(&plate, bounds, rs, Thin::OneLayer).unwrap();
        assert!(layer.iter().all(|x| (x.z - 0.03).abs() < 1e-9));
        assert!(closest_pair(&layer) >= LAYER * rs);
        for i in 0..=90 {
            for j in 0..=90 {
                let x = DVec3::new(0.05 + 0.01 * f64::from(i), 0.05 + 0.01 * f64::from(j), 0.03);
                let gap = layer.iter().map(|c| (*c - x).length()).fold(9.0, f64::min);
                assert!(gap < (LAYER + SEEDS) * rs, "{x} is {gap} from the layer");
            }
        }
    }

    #[test]
    fn a_thick_block_has_no_thin_parts() {
        let bounds = [DVec3::ZERO, DVec3::splat(0.5)];
        let block = Cuboid::<Space>::new(bounds[0], bounds[1]).unwrap();
        let plain = fill_fcc(&block, bounds, 0.05, Thin::Leave).unwrap();
        assert!(!plain.is_empty());
        assert_eq!(
            fill_fcc(&block, bounds, 0.05, Thin::OneLayer).unwrap(),
            plain
        );
    }

    #[test]
    fn the_flight_of_a_screw_gets_a_layer_where_grains_are_thicker_than_it() {
        let size = ScrewSize {
            shaft: 0.0275,
            outer: 0.1025,
            pitch: 0.150,
            thickness: 0.006,
        };
        let screw = Screw::new(DVec3::ZERO, DVec3::X * 0.2, size, Hand::Right).unwrap();
        let (rs, bounds) = (0.0054, Surface::bounds(&screw).unwrap());
        let away = |x: &DVec3| x.y.hypot(x.z);
        let shaft = fill_fcc(&screw, bounds, rs, Thin::Leave).unwrap();
        assert!(!shaft.is_empty() && shaft.iter().all(|x| away(x) <= size.shaft - rs + 1e-9));
        let all = fill_fcc(&screw, bounds, rs, Thin::OneLayer).unwrap();
        assert_eq!(all[..shaft.len()], shaft);
        let flight: Vec<_> = all.iter().filter(|x| away(x) > size.shaft + rs).collect();
        for x in &flight {
            let over = x.x - size.pitch * x.z.atan2(x.y) / std::f64::consts::TAU;
            let off = over - size.pitch * (over / size.pitch).round();
            assert!(off.abs() < 1e-5, "{off} m off the middle of the flight");
        }
        // One grain per 1.5–2.5 rs² of the middle surface.
        let turns = (0.2 - 0.012) / 0.150;
        let area = turns * PI * (size.outer.powi(2) - (size.shaft + rs).powi(2));
        let each = area * 1.06 / flight.len() as f64 / (rs * rs);
        assert!(each > 1.5 && each < 3.5, "{each} rs² each");
    }

    #[test]
    fn a_radius_that_cannot_be_meant_is_refused() {
        let ball = Ball::<Space>::new(DVec3::ONE, 1.0).unwrap();
        let fill = |rs| fill_fcc(&ball, ball.bounds_of(), rs, Thin::Leave);
        assert!(fill(0.0).is_err() && fill(f64::NAN).is_err());
        assert!(fill(1e-6).unwrap_err().to_string().contains("places"));
        assert!(fill(1.5).unwrap().is_empty());
    }

    impl Ball<Space> {
        fn bounds_of(&self) -> [DVec3; 2] {
            Surface::<Space>::bounds(self).unwrap()
        }
    }
}
