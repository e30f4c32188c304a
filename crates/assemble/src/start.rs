//! Where the grains are at the start, from a file, a list or a random fill; refused if they overlap.

use crate::bed::{bed, sites};
use crate::constants::Constants;
use crate::fill::{Box3, fill};
use crate::surfaces::read_mesh;
use glam::DVec3;
use std::sync::Arc;
use tsubu_engine::Placed;
use tsubu_model::{Dim, Domain, HitBuffer, Surface, Vector};
use tsubu_neighbors::{CellGrid, ChunkList};
use tsubu_scene::{Checked, Fill, Initial, MeshFile, Region, SceneError, Space, TouchesAt, Wall};
use tsubu_sdf::mesh::{Report, Verdict};
use tsubu_sdf::{ExactMesh, Winding};

/// Overlap over the diameter above which a start of real grains is refused: a settled bed under its own weight has
/// some 1e-4; at a hundredth grains of a stiff law would be shot apart.
const MOST_OVERLAP: f64 = 0.01;

/// The same for the grains of this scene: of softened ones the overlap that stores as much, up to a tenth.
fn most_overlap(checked: &Checked) -> f64 {
    (MOST_OVERLAP * checked.scene.grains.soften.sqrt()).min(0.1)
}

/// Bytes that a grain takes while a run is built and goes: lines, lists and their scratch, with some room.
const BYTES_PER_GRAIN: f64 = 400.0;

/// Most grains of a scene.
const MOST_GRAINS: f64 = 2e8;

/// Position and velocity of each grain.
pub(crate) fn grains<D: Dim>(
    checked: &Checked,
    constants: &Constants,
    domain: &Domain<D>,
    surfaces: &[Arc<dyn Surface<D>>],
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
                    kind: g.population,
                })
                .collect()
        }
        None => match &checked.scene.initial {
            Initial::Bed(wanted) => {
                refuse_crowd(
                    checked,
                    "initial.bed",
                    "bed",
                    sites::<D>(wanted, diameter, domain),
                )?;
                bed::<D>(wanted, diameter, &checked.scene.grains.populations, domain)
            }
            _ => filled(checked, constants, domain, surfaces)?,
        },
    };
    let diameters: Vec<f64> = grains
        .iter()
        .map(|g| constants.diameter_of(g.kind))
        .collect();
    refuse_walls(checked, &grains, &diameters, surfaces)?;
    refuse_overlaps(checked, &grains, &diameters, diameter, domain)?;
    Ok(grains)
}

/// Refuses what this machine, or a limit set on this process, has no memory for: asked before anything is made, as a
/// program that runs out on the way can only fall.
fn refuse_without_memory(
    checked: &Checked,
    path: &str,
    kind: &str,
    count: f64,
) -> Result<(), SceneError> {
    let bytes = count * BYTES_PER_GRAIN;
    let mut probe = Vec::<u8>::new();
    let there = probe.try_reserve_exact(bytes as usize).is_ok();
    // Memory that nobody looks at need not be asked for at all.
    std::hint::black_box(&mut probe);
    if there {
        return Ok(());
    }
    let what = format!(
        "the {kind} asks for {count:.0} grains, which take about {:.1} GB of memory, and this machine does not give as much",
        bytes / 1e9
    );
    let remedy = "shrink it, raise grains.coarse, or run it where there is more memory";
    Err(checked.problem(path, what, remedy).by_machine())
}

/// Refuses more grains than memory holds, before any is placed.
fn refuse_crowd(checked: &Checked, path: &str, kind: &str, count: f64) -> Result<(), SceneError> {
    if count <= MOST_GRAINS {
        return refuse_without_memory(checked, path, kind, count);
    }
    let what = format!("the {kind} asks for {count:.0} grains, more than any machine here holds");
    Err(checked.problem(path, what, "shrink it or raise grains.coarse"))
}

fn filled<D: Dim>(
    checked: &Checked,
    constants: &Constants,
    domain: &Domain<D>,
    surfaces: &[Arc<dyn Surface<D>>],
) -> Result<Vec<Placed<D>>, SceneError> {
    let scene = &checked.scene;
    let diameter = constants.kind.diameter();
    let Initial::Fill(wish) = &scene.initial else {
        return Ok(Vec::new());
    };
    let inside = wish
        .within
        .as_ref()
        .map(|file| Inside::of(checked, file))
        .transpose()?;
    let region = wish
        .region
        .or_else(|| inside.as_ref().map(|i| i.region))
        .unwrap_or(Region {
            min: DVec3::ZERO,
            max: DVec3::ZERO,
        });
    let size = region.max - region.min;
    let room = match (&inside, scene.space) {
        (Some(inside), _) => inside.volume_in(&region),
        (None, Space::Space) => size.x * size.y * size.z,
        (None, Space::Plane) => size.x * size.z,
    };
    let counts = counts_in(wish, room, constants, checked);
    let count = counts
        .iter()
        .fold(0usize, |sum, (_, count)| sum.saturating_add(*count));
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
    refuse_crowd(checked, "initial.fill", "fill", count as f64)?;
    let kinds: Vec<usize> = counts
        .into_iter()
        .flat_map(|(kind, count)| std::iter::repeat_n(kind, count))
        .collect();
    // Bodies within the region are filled around; a wall without end that cuts it is a mistake, refused later.
    let bodies: Vec<(&Arc<dyn Surface<D>>, &Wall)> = surfaces
        .iter()
        .zip(&scene.walls)
        .filter(|(surface, _)| surface.bounds().is_some())
        .collect();
    let mut hits = HitBuffer::default();
    let mut free = |x: D::V, diameter: f64| {
        let clear = bodies.iter().all(|(surface, wall)| {
            let reach = clearance(wall, diameter);
            if surface.lower_bound(x) >= reach {
                return true;
            }
            hits.hits.clear();
            surface.hits(&[x], &[reach], &mut hits);
            hits.hits.is_empty()
        });
        let holds = |inside: &Inside| inside.holds(D::to_space(x), 0.5 * diameter);
        clear && inside.as_ref().is_none_or(holds)
    };
    let diameters: Vec<f64> = kinds
        .iter()
        .map(|&kind| constants.diameter_of(kind))
        .collect();
    let places = fill::<D>(
        &Box3 {
            min: region.min,
            max: region.max,
        },
        &diameters,
        domain,
        wish.seed,
        &mut free,
    );
    let placed = |(position, kind)| Placed {
        position,
        velocity: D::V::ZERO,
        kind,
    };
    places.map(|places| places.into_iter().zip(kinds).map(placed).collect()).map_err(|fitted| {
        let what = format!("the region has no room: only {fitted} of {count} grains of {:.4} mm could be placed", diameter * 1e3);
        checked.problem("initial.fill", what, "enlarge the region, lower solid_fraction or lower grains.coarse")
    })
}

/// How many grains of each kind a fill asks for, those of large diameter first: each population takes its share of what the
/// solid fraction makes of the room (m³, in the plane m²).
fn counts_in(
    wish: &Fill,
    room: f64,
    constants: &Constants,
    checked: &Checked,
) -> Vec<(usize, usize)> {
    let scene = &checked.scene;
    let populations = &scene.grains.populations;
    let count = |kind: usize, room: f64| {
        let diameter = constants.diameter_of(kind);
        (kind, wish.count_in(room, diameter, scene.space))
    };
    if populations.is_empty() {
        return vec![count(0, room)];
    }
    // Shares of mass become shares of volume; in the plane spheres are counted by their discs, so there of area.
    let taken = |k: usize| {
        let flat = match scene.space {
            Space::Space => 1.0,
            Space::Plane => populations[k].diameter,
        };
        populations[k].share / populations[k].density / flat
    };
    let whole: f64 = (0..populations.len()).map(taken).sum();
    let mut order: Vec<usize> = (0..populations.len()).collect();
    order.sort_by(|&a, &b| populations[b].diameter.total_cmp(&populations[a].diameter));
    let of = |k: usize| count(k, room * taken(k) / whole);
    order.into_iter().map(of).collect()
}

/// Distance of a grain's centre from a wall at which they begin to touch.
fn clearance(wall: &Wall, diameter: f64) -> f64 {
    match wall.touches_at {
        TouchesAt::Surface => 0.5 * diameter,
        TouchesAt::Centre => diameter,
    }
}

/// The inside of a closed mesh that is to be filled.
struct Inside {
    winding: Winding,
    surface: ExactMesh,
    region: Region,
}

impl Inside {
    fn of(checked: &Checked, file: &MeshFile) -> Result<Self, SceneError> {
        let path = "initial.fill.within.file";
        let mesh = read_mesh(checked, path, file)?;
        if Report::of(&mesh).verdict == Verdict::OpenSheet {
            let what = "this mesh is an open sheet: it has no inside to fill";
            return Err(checked.problem(path, what, "close it, or fill a region"));
        }
        let (mesh, _) = mesh.repaired();
        let surface = ExactMesh::body(&mesh)
            .map_err(|e| checked.problem(path, e.to_string(), "mend the mesh"))?;
        let [min, max] = mesh.bounds();
        Ok(Self {
            winding: Winding::new(&mesh),
            surface,
            region: Region { min, max },
        })
    }

    /// True if a ball of this radius about `x` lies inside.
    fn holds(&self, x: DVec3, radius: f64) -> bool {
        self.winding.inside(x) && self.surface.closest(x, radius).is_none()
    }

    /// Volume of the part within a box, m³: the share of points of a regular lattice that are inside.
    fn volume_in(&self, region: &Region) -> f64 {
        let (low, high) = (
            region.min.max(self.region.min),
            region.max.min(self.region.max),
        );
        let size = (high - low).max(DVec3::ZERO);
        const SIDE: usize = 32;
        let inside = (0..SIDE * SIDE * SIDE)
            .filter(|k| {
                let cell = [k % SIDE, k / SIDE % SIDE, k / SIDE / SIDE].map(|c| c as f64 + 0.5);
                self.winding
                    .inside(low + size * DVec3::from(cell) / SIDE as f64)
            })
            .count();
        size.x * size.y * size.z * inside as f64 / (SIDE * SIDE * SIDE) as f64
    }
}

/// Refuses a grain that starts in a wall: it would be shot off as two overlapping grains are.
fn refuse_walls<D: Dim>(
    checked: &Checked,
    grains: &[Placed<D>],
    diameters: &[f64],
    surfaces: &[Arc<dyn Surface<D>>],
) -> Result<(), SceneError> {
    let mut hits = HitBuffer::default();
    for (wall, surface) in checked.scene.walls.iter().zip(surfaces) {
        for (i, (grain, &diameter)) in grains.iter().zip(diameters).enumerate() {
            let offset = match wall.touches_at {
                TouchesAt::Surface => 0.5 * diameter,
                TouchesAt::Centre => 0.0,
            };
            let reach = clearance(wall, diameter);
            if surface.lower_bound(grain.position) >= reach {
                continue;
            }
            hits.hits.clear();
            surface.hits(&[grain.position], &[reach], &mut hits);
            let nearest = hits.hits.iter().map(|hit| hit.distance);
            let distance = nearest.fold(f64::INFINITY, f64::min);
            let overlap = 1.0 - (distance + offset) / diameter;
            if overlap <= most_overlap(checked) {
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
    diameters: &[f64],
    largest: f64,
    domain: &Domain<D>,
) -> Result<(), SceneError> {
    let n = grains.len();
    let reach = largest * (1.0 - most_overlap(checked));
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
        for (slot, j) in list.iter() {
            let (i, j) = (old(first + slot), old(j));
            let apart = domain
                .nearest(grains[i].position - grains[j].position)
                .length();
            let diameter = 0.5 * (diameters[i] + diameters[j]);
            if apart >= diameter * (1.0 - most_overlap(checked)) {
                continue;
            }
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
