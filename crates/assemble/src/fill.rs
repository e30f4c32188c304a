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

/// Places for `count` grains of this diameter where `free` allows it, none overlapping another or sticking
/// out of the box (periodic axes have no side to stick out of). `Err` says how many fitted.
///
/// A grain for which random places fail waits until those that are placed have sunk: each in turn moves at random, never
/// up, where it overlaps none. Random addition alone jams at a solid fraction of 0.38, and earlier between walls; sunk
/// grains leave room above them.
pub(crate) fn fill<D: Dim>(
    region: &Box3,
    count: usize,
    diameter: f64,
    domain: &Domain<D>,
    seed: u64,
    free: &mut dyn FnMut(D::V) -> bool,
) -> Result<Vec<D::V>, usize> {
    let mut room = Room::new(region, diameter, domain).ok_or(0usize)?;
    let draw = |grain: usize, event: u64| {
        move |a: usize| uniform(seed, grain as u64, 3 * event + a as u64)
    };
    let mut sinks = 0;
    for grain in 0..count {
        loop {
            // Each round of sinking has its own draws.
            let first = sinks * TRIES;
            let spot = (first..first + TRIES)
                .map(|event| room.at(draw(grain, event)))
                // The surfaces are asked last: they cost most.
                .find(|&x| room.is_free(x, usize::MAX) && free(x));
            if let Some(x) = spot {
                room.put(x);
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
    low: D::V,
    size: D::V,
    diameter: f64,
    domain: &'a Domain<D>,
    /// Axes that are periodic over the whole box.
    full: [bool; 3],
    cells: [usize; 3],
    grid: Vec<u32>,
    placed: Vec<D::V>,
}

/// No grain in this cell.
const EMPTY: u32 = u32::MAX;

impl<'a, D: Dim> Room<'a, D> {
    /// `None` if no grain fits between the sides.
    fn new(region: &Box3, diameter: f64, domain: &'a Domain<D>) -> Option<Self> {
        let axes = D::V::AXES;
        let (min, max) = (D::from_space(region.min), D::from_space(region.max));
        let full = |a: usize| {
            a < axes
                && domain.is_periodic(a)
                && max.axis(a) - min.axis(a) >= domain.period.axis(a) * (1.0 - 1e-12)
        };
        let low = D::V::from_axes(|a| {
            if full(a) {
                min.axis(a)
            } else {
                min.axis(a) + 0.5 * diameter
            }
        });
        let size = D::V::from_axes(|a| {
            if full(a) {
                max.axis(a) - min.axis(a)
            } else {
                max.axis(a) - min.axis(a) - diameter
            }
        });
        if (0..axes).any(|a| size.axis(a) < 0.0) {
            return None;
        }
        // Cells of d/√axes hold at most one centre; partners are at most two cells away (three to be safe in space).
        let cell = diameter / (axes as f64).sqrt();
        let count_of = |a: usize| {
            if a < axes {
                (size.axis(a) / cell).floor().max(1.0) as usize
            } else {
                1
            }
        };
        let cells = [count_of(0), count_of(1), count_of(2)];
        Some(Self {
            low,
            size,
            diameter,
            domain,
            full: [full(0), full(1), full(2)],
            cells,
            grid: vec![EMPTY; cells.iter().product()],
            placed: Vec::new(),
        })
    }

    /// The place of three numbers from 0 to 1.
    fn at(&self, draw: impl Fn(usize) -> f64) -> D::V {
        D::V::from_axes(|a| self.low.axis(a) + self.size.axis(a) * draw(a))
    }

    fn cell(&self, x: D::V) -> [usize; 3] {
        let mut c = [0; 3];
        for (a, c) in c.iter_mut().enumerate().take(D::V::AXES) {
            let w = self.size.axis(a) / self.cells[a] as f64;
            *c = if w > 0.0 {
                (((x.axis(a) - self.low.axis(a)) / w) as usize).min(self.cells[a] - 1)
            } else {
                0
            };
        }
        c
    }

    fn index(&self, c: [usize; 3]) -> usize {
        (c[2] * self.cells[1] + c[1]) * self.cells[0] + c[0]
    }

    /// True if a grain at `x` overlaps none but `itself`.
    fn is_free(&self, x: D::V, itself: usize) -> bool {
        let c = self.cell(x);
        let other = |c: [usize; 3]| {
            let other = self.grid[self.index(c)];
            (other != EMPTY && other as usize != itself).then_some(other as usize)
        };
        let apart = |other: usize| {
            let apart = self.domain.nearest(x - self.placed[other]);
            apart.length_squared() >= self.diameter * self.diameter
        };
        other(c).is_none()
            && around(c, self.cells, self.full, D::V::AXES).all(|n| other(n).is_none_or(apart))
    }

    fn put(&mut self, x: D::V) {
        let at = self.index(self.cell(x));
        self.grid[at] = self.placed.len() as u32;
        self.placed.push(x);
    }

    /// Moves a grain at random, not up, if it has room there.
    fn sink(
        &mut self,
        grain: usize,
        draw: impl Fn(usize) -> f64,
        free: &mut dyn FnMut(D::V) -> bool,
    ) {
        let old = self.placed[grain];
        let step = SINK * self.diameter;
        let new = D::V::from_axes(|a| {
            let by = if a == D::UP {
                -step * draw(a)
            } else {
                step * (2.0 * draw(a) - 1.0)
            };
            let into = old.axis(a) + by - self.low.axis(a);
            let size = self.size.axis(a);
            let into = if self.full[a] {
                into.rem_euclid(size)
            } else {
                into
            };
            self.low.axis(a) + into
        });
        let inside = (0..D::V::AXES)
            .all(|a| (0.0..=self.size.axis(a)).contains(&(new.axis(a) - self.low.axis(a))));
        if inside && self.is_free(new, grain) && free(new) {
            let (from, to) = (self.index(self.cell(old)), self.index(self.cell(new)));
            self.grid[from] = EMPTY;
            self.grid[to] = grain as u32;
            self.placed[grain] = new;
        }
    }
}

/// Cells within two of `c` along each axis, wrapped where the axis repeats. A cell may come twice in a narrow box.
fn around(
    c: [usize; 3],
    cells: [usize; 3],
    wrap: [bool; 3],
    axes: usize,
) -> impl Iterator<Item = [usize; 3]> {
    let reach = move |a: usize| if a < axes { -3i64..=3 } else { 0..=0 };
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
        let places = fill::<Space>(&region, 320, 1.0, &domain, 3, &mut |_| true).unwrap();
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
        let places = fill::<Plane>(&region, 60, 1.0, &plane, 3, &mut |_| true).unwrap();
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
        let count = 270;
        let places = fill::<Space>(&region, count, 1.0, &domain, 5, &mut |x| x.z < 9.2).unwrap();
        assert_eq!(places.len(), count);
        assert!(closest::<Space>(&places, &domain) >= 1.0);
        assert!(places.iter().all(|p| {
            p.x >= 0.0 && p.x <= 6.0 && p.y >= 0.5 && p.y <= 5.5 && p.z >= 0.5 && p.z < 9.2
        }));
    }

    #[test]
    fn a_box_without_room_says_how_many_fitted() {
        let region = Box3 {
            min: DVec3::ZERO,
            max: DVec3::splat(3.0),
        };
        let fitted =
            fill::<Space>(&region, 500, 1.0, &Domain::open(), 1, &mut |_| true).unwrap_err();
        assert!(fitted > 8 && fitted < 40, "{fitted}");
        let flat = Box3 {
            min: DVec3::ZERO,
            max: DVec3::new(3.0, 3.0, 0.5),
        };
        assert_eq!(
            fill::<Space>(&flat, 2, 1.0, &Domain::open(), 1, &mut |_| true),
            Err(0)
        );
    }
}
