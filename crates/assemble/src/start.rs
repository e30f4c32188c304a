//! Where the grains are at the start, from a file, a list or a random fill; refused if they overlap.

use crate::constants::Constants;
use crate::fill::{Box3, fill};
use tsubu_engine::Placed;
use tsubu_model::{Dim, Domain, Vector};
use tsubu_neighbors::{CellGrid, ChunkList};
use tsubu_scene::{Checked, Initial, SceneError, TouchesAt};

/// Overlap over the diameter above which a start is refused: a settled bed under its own weight has
/// some 1e-4; at a hundredth grains of a stiff law would be shot apart.
const MOST_OVERLAP: f64 = 0.01;

/// Position and velocity of each grain.
pub(crate) fn grains<D: Dim>(
    checked: &Checked,
    constants: &Constants,
    domain: &Domain<D>,
) -> Result<Vec<Placed<D>>, SceneError> {
    let diameter = constants.kind.diameter();
    let grains: Vec<Placed<D>> = match checked.starting_grains()? {
        Some(listed) => {
            if checked.scene.grains.coarse > 0 {
                let what = "grains that are listed one by one cannot be coarsened: a coarse grain stands for several of them";
                return Err(checked.problem(
                    "grains.coarse",
                    what,
                    "set grains.coarse to 0, or fill a region instead",
                ));
            }
            listed
                .iter()
                .map(|g| Placed {
                    position: domain.wrap(D::from_space(g.at)),
                    velocity: D::from_space(g.velocity),
                    kind: 0,
                })
                .collect()
        }
        None => filled(checked, diameter, domain)?,
    };
    refuse_walls(checked, &grains, diameter)?;
    refuse_overlaps(checked, &grains, diameter, domain)?;
    Ok(grains)
}

fn filled<D: Dim>(
    checked: &Checked,
    diameter: f64,
    domain: &Domain<D>,
) -> Result<Vec<Placed<D>>, SceneError> {
    let Initial::Fill(wish) = &checked.scene.initial else {
        return Ok(Vec::new());
    };
    let count = wish.count(diameter, checked.scene.space);
    if count == 0 {
        let what = format!(
            "the region has no room for a single grain of {:.4} mm at this solid fraction",
            diameter * 1e3
        );
        return Err(checked.problem(
            "initial.fill",
            what,
            "enlarge the region, raise solid_fraction or lower grains.coarse",
        ));
    }
    if count > 200_000_000 {
        let what = format!("the fill asks for {count} grains, more than any machine here holds");
        return Err(checked.problem(
            "initial.fill",
            what,
            "shrink the region or raise grains.coarse",
        ));
    }
    let Some(region) = wish.region else {
        return Ok(Vec::new());
    };
    let places = fill::<D>(
        &Box3 {
            min: region.min,
            max: region.max,
        },
        count,
        diameter,
        domain,
        wish.seed,
    );
    places.map(|places| places.into_iter().map(|x| Placed { position: x, velocity: D::V::ZERO, kind: 0 }).collect()).map_err(|fitted| {
        let what = format!("the region has no room: only {fitted} of {count} grains of {:.4} mm could be placed", diameter * 1e3);
        checked.problem("initial.fill", what, "enlarge the region, lower solid_fraction or lower grains.coarse")
    })
}

/// Refuses a grain that starts in a wall: it would be shot off as two overlapping grains are.
fn refuse_walls<D: Dim>(
    checked: &Checked,
    grains: &[Placed<D>],
    diameter: f64,
) -> Result<(), SceneError> {
    for wall in &checked.scene.walls {
        let tsubu_scene::Shape::HalfSpace { point, outward } = &wall.shape else {
            continue;
        };
        let offset = match wall.touches_at {
            TouchesAt::Surface => 0.5 * diameter,
            TouchesAt::Centre => 0.0,
        };
        for (i, grain) in grains.iter().enumerate() {
            let distance = (D::to_space(grain.position) - *point).dot(*outward);
            let overlap = 1.0 - (distance + offset) / diameter;
            if overlap <= MOST_OVERLAP {
                continue;
            }
            let what = if distance < 0.0 {
                format!(
                    "grain {i} starts {} mm behind the wall `{}`",
                    -distance * 1e3,
                    wall.name
                )
            } else {
                format!(
                    "grain {i} and the wall `{}` overlap at the start by {:.1} % of the diameter",
                    wall.name,
                    100.0 * overlap
                )
            };
            return Err(checked.problem(
                "initial",
                what,
                "move the grains, or turn the wall's outward normal towards them",
            ));
        }
    }
    Ok(())
}

fn refuse_overlaps<D: Dim>(
    checked: &Checked,
    grains: &[Placed<D>],
    diameter: f64,
    domain: &Domain<D>,
) -> Result<(), SceneError> {
    let n = grains.len();
    let reach = diameter * (1.0 - MOST_OVERLAP);
    let grid = CellGrid::new(domain, n, |i| grains[i].position, reach);
    let old = |sorted: usize| grid.order[sorted] as usize;
    let mut list = ChunkList::default();
    // Chunk by chunk, as a list's slots are 16-bit.
    for first in (0..n).step_by(32_768) {
        list.build(
            &grid,
            domain,
            first..(first + 32_768).min(n),
            |i| grains[old(i)].position,
            reach,
            n as u32,
        );
        if let Some((slot, j)) = list.iter().next() {
            let (i, j) = (old(first + slot), old(j));
            let apart = domain
                .nearest(grains[i].position - grains[j].position)
                .length();
            let what = format!(
                "grains {} and {} overlap at the start by {:.1} % of their diameter",
                i.min(j),
                i.max(j),
                100.0 * (1.0 - apart / diameter)
            );
            return Err(checked.problem(
                "initial",
                what,
                "move them apart: more than 1 % would shoot them off",
            ));
        }
    }
    Ok(())
}
