//! Random places without overlap in a box (random sequential addition).

use crate::random::uniform;
use glam::DVec3;
use tsubu_model::{Dim, Domain, Vector};

/// Places tried for one grain before the box counts as full.
const TRIES: u64 = 20_000;

/// A box to fill.
pub(crate) struct Box3 {
    pub min: DVec3,
    pub max: DVec3,
}

/// Places for `count` grains of this diameter where `free` allows it, none overlapping another or sticking
/// out of the box (periodic axes have no side to stick out of). `Err` says how many fitted.
pub(crate) fn fill<D: Dim>(
    region: &Box3,
    count: usize,
    diameter: f64,
    domain: &Domain<D>,
    seed: u64,
    free: &mut dyn FnMut(D::V) -> bool,
) -> Result<Vec<D::V>, usize> {
    let axes = D::V::AXES;
    let (min, max) = (D::from_space(region.min), D::from_space(region.max));
    let full = |a: usize| {
        domain.is_periodic(a) && max.axis(a) - min.axis(a) >= domain.period.axis(a) * (1.0 - 1e-12)
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
        return Err(0);
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
    let width = |a: usize| size.axis(a) / cells[a] as f64;
    let mut grid: Vec<u32> = vec![u32::MAX; cells.iter().product()];
    let cell_of = |x: D::V| -> [usize; 3] {
        let mut c = [0; 3];
        for (a, c) in c.iter_mut().enumerate().take(axes) {
            let w = width(a);
            *c = if w > 0.0 {
                (((x.axis(a) - low.axis(a)) / w) as usize).min(cells[a] - 1)
            } else {
                0
            };
        }
        c
    };
    let index = |c: [usize; 3]| (c[2] * cells[1] + c[1]) * cells[0] + c[0];
    let mut placed: Vec<D::V> = Vec::with_capacity(count);
    let d2 = diameter * diameter;
    for grain in 0..count {
        let spot = (0..TRIES).find_map(|attempt| {
            let x = D::V::from_axes(|a| {
                low.axis(a) + size.axis(a) * uniform(seed, grain as u64, 3 * attempt + a as u64)
            });
            let c = cell_of(x);
            if grid[index(c)] != u32::MAX {
                return None;
            }
            let alone = around(
                c,
                cells,
                [full(0), axes > 1 && full(1), axes > 2 && full(2)],
                axes,
            )
            .all(|n| {
                grid[index(n)] == u32::MAX
                    || domain
                        .nearest(x - placed[grid[index(n)] as usize])
                        .length_squared()
                        >= d2
            });
            // The surfaces are asked last: they cost most.
            (alone && free(x)).then_some((x, c))
        });
        let Some((x, c)) = spot else {
            return Err(grain);
        };
        grid[index(c)] = grain as u32;
        placed.push(x);
    }
    Ok(placed)
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
