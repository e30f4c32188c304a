//! Random places without overlap in a box: random sequential addition, and where that jams, grains sink to make room.

use glam::DVec3;
use tsubu_model::{Dim, Domain, Vector, uniform};

/// Places tried for one grain before the box counts as full.
const TRIES: u64 = 20_000;
/// Times that all grains are asked to sink before the box is full for good, and how many of them are made in one go.
const MOST_SINKS: u64 = 400;
const SINKS: u64 = 20;
/// Longest move of a sinking grain along each axis, in diameters.
const SINK: f64 = 0.3;

/// A box to fill.
pub(crate) struct Box3 {
    pub min: DVec3,
    pub max: DVec3,
}

/// What says whether a grain of a diameter may be at a place, as far as others are not concerned.
pub(crate) type Free<'f, D> = dyn FnMut(<D as Dim>::V, f64) -> bool + 'f;

/// Places for grains of these diameters where `free` allows it, none overlapping another or sticking
/// out of the box (periodic axes have no side to stick out of). `Err` says how many fitted. The largest had better come first.
///
/// A grain for which random places fail waits until those that are placed have sunk: each in turn moves at random, never
/// up, where it overlaps none. Random addition alone jams at a solid fraction of 0.38, and earlier between walls; sunk
/// grains leave room above them.
pub(crate) fn fill<D: Dim>(
    region: &Box3,
    diameters: &[f64],
    domain: &Domain<D>,
    seed: u64,
    free: &mut Free<'_, D>,
) -> Result<Vec<D::V>, usize> {
    let mut room = Room::new(region, diameters, domain).ok_or(0usize)?;
    let draw = |grain: usize, event: u64| {
        move |a: usize| uniform(seed, grain as u64, 3 * event + a as u64)
    };
    let mut sinks = 0;
    for (grain, &diameter) in diameters.iter().enumerate() {
        loop {
            // Each round of sinking has its own draws.
            let first = sinks * TRIES;
            let spot = (first..first + TRIES)
                .map(|event| room.at(diameter, draw(grain, event)))
                // The surfaces are asked last: they cost most.
                .find(|&x| room.is_free(x, grain) && free(x, diameter));
            if let Some(x) = spot {
                room.placed.push(x);
                room.enter(grain);
                break;
            }
            if sinks >= MOST_SINKS || grain == 0 {
                return Err(grain);
            }
            for _ in 0..SINKS {
                sinks += 1;
                for other in 0..grain {
                    room.sink(other, draw(other, (1 << 48) + sinks), free);
                }
            }
        }
    }
    Ok(room.placed)
}

/// The box, the grains that are placed, and which cell each is in.
struct Room<'a, D: Dim> {
    min: D::V,
    max: D::V,
    diameters: &'a [f64],
    domain: &'a Domain<D>,
    /// Axes that are periodic over the whole box.
    full: [bool; 3],
    /// Cells at least as wide as the largest grain: partners are one cell away at most.
    cells: [usize; 3],
    /// First grain of each cell, and the next one in the cell of each grain.
    first: Vec<u32>,
    next: Vec<u32>,
    placed: Vec<D::V>,
}

/// No further grain in this cell.
const NONE: u32 = u32::MAX;

impl<'a, D: Dim> Room<'a, D> {
    /// `None` if a grain does not fit between the sides.
    fn new(region: &Box3, diameters: &'a [f64], domain: &'a Domain<D>) -> Option<Self> {
        let axes = D::V::AXES;
        let (min, max) = (D::from_space(region.min), D::from_space(region.max));
        let full = |a: usize| {
            a < axes
                && domain.is_periodic(a)
                && max.axis(a) - min.axis(a) >= domain.period.axis(a) * (1.0 - 1e-12)
        };
        let full = [full(0), full(1), full(2)];
        let largest = diameters.iter().copied().fold(0.0, f64::max);
        let extent = |a: usize| max.axis(a) - min.axis(a);
        if (0..axes).any(|a| !full[a] && extent(a) < largest) {
            return None;
        }
        let count_of = |a: usize| {
            if a < axes {
                (extent(a) / largest).floor().max(1.0) as usize
            } else {
                1
            }
        };
        let cells = [count_of(0), count_of(1), count_of(2)];
        Some(Self {
            min,
            max,
            diameters,
            domain,
            full,
            cells,
            first: vec![NONE; cells.iter().product()],
            next: vec![NONE; diameters.len()],
            placed: Vec::with_capacity(diameters.len()),
        })
    }

    /// Where centres of grains of this diameter begin along an axis, and how far they go.
    fn span(&self, diameter: f64, a: usize) -> (f64, f64) {
        let (min, max) = (self.min.axis(a), self.max.axis(a));
        if self.full[a] {
            (min, max - min)
        } else {
            (min + 0.5 * diameter, max - min - diameter)
        }
    }

    /// The place of three numbers from 0 to 1.
    fn at(&self, diameter: f64, draw: impl Fn(usize) -> f64) -> D::V {
        D::V::from_axes(|a| {
            let (low, size) = self.span(diameter, a);
            low + size * draw(a)
        })
    }

    fn cell(&self, x: D::V) -> [usize; 3] {
        let mut c = [0; 3];
        for (a, c) in c.iter_mut().enumerate().take(D::V::AXES) {
            let w = (self.max.axis(a) - self.min.axis(a)) / self.cells[a] as f64;
            *c = (((x.axis(a) - self.min.axis(a)) / w) as usize).min(self.cells[a] - 1);
        }
        c
    }

    fn index(&self, c: [usize; 3]) -> usize {
        (c[2] * self.cells[1] + c[1]) * self.cells[0] + c[0]
    }

    /// The grains of a cell.
    fn grains_in(&self, c: [usize; 3]) -> impl Iterator<Item = usize> + '_ {
        let mut at = self.first[self.index(c)];
        std::iter::from_fn(move || {
            let grain = (at != NONE).then_some(at as usize)?;
            at = self.next[grain];
            Some(grain)
        })
    }

    /// True if the grain at `x` would overlap no other.
    fn is_free(&self, x: D::V, grain: usize) -> bool {
        let clear = |other: usize| {
            let apart = self.domain.nearest(x - self.placed[other]);
            let reach = 0.5 * (self.diameters[grain] + self.diameters[other]);
            other == grain || apart.length_squared() >= reach * reach
        };
        around(self.cell(x), self.cells, self.full, D::V::AXES)
            .all(|c| self.grains_in(c).all(clear))
    }

    /// Into the cell where it is.
    fn enter(&mut self, grain: usize) {
        let at = self.index(self.cell(self.placed[grain]));
        self.next[grain] = self.first[at];
        self.first[at] = grain as u32;
    }

    /// Out of the cell where it is.
    fn leave(&mut self, grain: usize) {
        let at = self.index(self.cell(self.placed[grain]));
        let after = self.next[grain];
        if self.first[at] == grain as u32 {
            self.first[at] = after;
            return;
        }
        let before = self
            .grains_in(self.cell(self.placed[grain]))
            .find(|&other| self.next[other] == grain as u32);
        if let Some(before) = before {
            self.next[before] = after;
        }
    }

    /// Moves a grain at random, not up, if it has room there.
    fn sink(&mut self, grain: usize, draw: impl Fn(usize) -> f64, free: &mut Free<'_, D>) {
        let (old, diameter) = (self.placed[grain], self.diameters[grain]);
        let step = SINK * diameter;
        let new = D::V::from_axes(|a| {
            let (low, size) = self.span(diameter, a);
            let by = if a == D::UP {
                -step * draw(a)
            } else {
                step * (2.0 * draw(a) - 1.0)
            };
            let into = old.axis(a) + by - low;
            let into = if self.full[a] {
                into.rem_euclid(size)
            } else {
                into
            };
            low + into
        });
        let inside = (0..D::V::AXES).all(|a| {
            let (low, size) = self.span(diameter, a);
            (0.0..=size).contains(&(new.axis(a) - low))
        });
        if inside && self.is_free(new, grain) && free(new, diameter) {
            self.leave(grain);
            self.placed[grain] = new;
            self.enter(grain);
        }
    }
}

/// Cells next to `c` along each axis, wrapped where the axis repeats. A cell may come twice in a narrow box.
fn around(
    c: [usize; 3],
    cells: [usize; 3],
    wrap: [bool; 3],
    axes: usize,
) -> impl Iterator<Item = [usize; 3]> {
    let reach = move |a: usize| if a < axes { -1i64..=1 } else { 0..=0 };
    let step = move |a: usize, by: i64| -> Option<usize> {
        let n = cells[a] as i64;
        let to = c[a] as i64 + by;
        if wrap[a] {
            Some(to.rem_euclid(n) as usize)
        } else {
            (0..n).contains(&to).then_some(to as usize)
        }
    };
    reach(2).flat_map(move |dz| {
        reach(1).flat_map(move |dy| {
            reach(0).filter_map(move |dx| Some([step(0, dx)?, step(1, dy)?, step(2, dz)?]))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};
    use tsubu_model::{Plane, Space};

    fn closest<D: Dim>(places: &[D::V], domain: &Domain<D>) -> f64 {
        let mut least = f64::INFINITY;
        for (i, &a) in places.iter().enumerate() {
            for &b in &places[..i] {
                least = least.min(domain.nearest(a - b).length());
            }
        }
        least
    }

    #[test]
    fn grains_do_not_overlap_not_even_through_the_boundary() {
        let domain = Domain::<Space> {
            period: DVec3::new(f64::INFINITY, 5.0, f64::INFINITY),
        };
        let region = Box3 {
            min: DVec3::ZERO,
            max: DVec3::new(10.0, 5.0, 12.0),
        };
        let places = fill::<Space>(&region, &[1.0; 320], &domain, 3, &mut |_, _| true).unwrap();
        assert!(closest::<Space>(&places, &domain) >= 1.0);
        assert!(
            places
                .iter()
                .all(|p| p.x >= 0.5 && p.x <= 9.5 && p.z >= 0.5 && p.z <= 11.5)
        );
        assert!(
            places.iter().any(|p| p.y < 0.3 || p.y > 4.7),
            "a periodic side holds no grain back"
        );
        let plane = Domain::<Plane> {
            period: DVec2::INFINITY,
        };
        let places = fill::<Plane>(&region, &[1.0; 60], &plane, 3, &mut |_, _| true).unwrap();
        assert!(closest::<Plane>(&places, &plane) >= 1.0);
    }

    #[test]
    fn grains_sink_where_random_places_alone_would_not_do() {
        let domain = Domain::<Space> {
            period: DVec3::new(6.0, f64::INFINITY, f64::INFINITY),
        };
        let region = Box3 {
            min: DVec3::ZERO,
            max: DVec3::new(6.0, 6.0, 10.0),
        };
        // 0.405 of what they may fill: random addition alone jams at 0.384 even without walls.
        let sizes = [1.0; 270];
        let places = fill::<Space>(&region, &sizes, &domain, 5, &mut |x, _| x.z < 9.2).unwrap();
        assert_eq!(places.len(), sizes.len());
        assert!(closest::<Space>(&places, &domain) >= 1.0);
        assert!(places.iter().all(|p| {
            p.x >= 0.0 && p.x <= 6.0 && p.y >= 0.5 && p.y <= 5.5 && p.z >= 0.5 && p.z < 9.2
        }));
    }

    #[test]
    fn small_grains_fill_the_room_between_large_ones() {
        let domain = Domain::<Space> {
            period: DVec3::new(8.0, 8.0, f64::INFINITY),
        };
        let region = Box3 {
            min: DVec3::ZERO,
            max: DVec3::splat(8.0),
        };
        // A solid fraction of 0.45 together, sizes 1 : 5, which neither size alone reaches here.
        let sizes: Vec<f64> = [vec![2.0; 42], vec![0.4; 1640]].concat();
        let places = fill::<Space>(&region, &sizes, &domain, 2, &mut |_, _| true).unwrap();
        for (i, (&a, da)) in places.iter().zip(&sizes).enumerate() {
            for (&b, db) in places[..i].iter().zip(&sizes) {
                assert!(domain.nearest(a - b).length() >= 0.5 * (da + db));
            }
            assert!(a.z >= 0.5 * da && a.z <= 8.0 - 0.5 * da);
        }
    }

    #[test]
    fn a_box_without_room_says_how_many_fitted() {
        let region = Box3 {
            min: DVec3::ZERO,
            max: DVec3::splat(3.0),
        };
        let fitted =
            fill::<Space>(&region, &[1.0; 500], &Domain::open(), 1, &mut |_, _| true).unwrap_err();
        assert!(fitted > 8 && fitted < 40, "{fitted}");
        let flat = Box3 {
            min: DVec3::ZERO,
            max: DVec3::new(3.0, 3.0, 0.5),
        };
        assert_eq!(
            fill::<Space>(&flat, &[1.0; 2], &Domain::open(), 1, &mut |_, _| true),
            Err(0)
        );
    }
}
