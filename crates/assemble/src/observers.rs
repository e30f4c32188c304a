//! From what a scene asks to measure to the observers of a run.

use crate::constants::Constants;
use crate::grain::{clear_water, sediment};
use crate::water::friction_velocity;
use std::sync::Arc;
use tsubu_measure::{
    Balance, BedLoad, BedLoadOptions, Conveying, ConveyingOptions, Discharge, DischargeOptions,
    Energy, Flow, Heap, HeapOptions, Loads, Opening, Slices, Structure,
};
use tsubu_model::{Dim, Domain, Observer, SpinState, Surface, Vector};
use tsubu_scene as scene;
use tsubu_scene::{Removal, Shape};
use tsubu_stream::TransportCurve;

/// The measures of a screw conveyor; its axis points the way it feeds.
fn conveying_of<D: Dim>(
    scene: &scene::Scene,
    wanted: &scene::Conveying,
    surfaces: &[Arc<dyn Surface<D>>],
) -> Option<Conveying> {
    let screw = &scene.walls[wanted.screw];
    let turn = screw.motion.as_ref()?.turn?;
    let section = (wanted.section[0], wanted.section[1]);
    let period = wanted.period(screw, &scene.domain);
    let ends = surfaces[wanted.screw].bounds().map(|[low, high]| {
        let (a, b) = (
            (low - turn.point).dot(turn.axis),
            (high - turn.point).dot(turn.axis),
        );
        (a.min(b), a.max(b))
    });
    Some(Conveying::new(ConveyingOptions {
        screw: wanted.screw,
        outlet: wanted.outlet,
        point: turn.point,
        direction: turn.axis,
        section,
        // Where the scene repeats there is no more of it than a period, however long the screw.
        along: ends.filter(|_| period.is_none()).unwrap_or(section),
        period,
        pitch: wanted.pitch,
        outer: wanted.outer,
        shaft: wanted.shaft,
        casing: wanted.casing,
        hopper: wanted.hopper.map(|hopper| [hopper.min, hopper.max]),
        density: scene.grains.density(),
    }))
}

/// The measures of a hopper that empties.
fn discharge_of<D: Dim>(
    wanted: &scene::Discharge,
    constants: &Constants,
    domain: &Domain<D>,
) -> DischargeOptions {
    let diameter = constants.mean_diameter();
    let depth = if D::V::AXES == 3 {
        domain.period.axis(1)
    } else {
        diameter
    };
    DischargeOptions {
        outlet: wanted.outlet,
        opening: match wanted.opening {
            scene::Opening::Circle(width) => Opening::Circle(width),
            scene::Opening::Slot(width) => Opening::Slot { width, depth },
        },
        bin: [wanted.bin.min, wanted.bin.max],
        diameter,
    }
}

/// The transport of a bed, beside the relations of the books.
fn bed_load_of<D: Dim>(
    scene: &scene::Scene,
    constants: &Constants,
    domain: &Domain<D>,
) -> Option<BedLoad> {
    let (water, wanted) = (scene.water.as_ref()?, scene.measures.bed?);
    let (clear, sand) = (clear_water(water, scene.gravity), sediment(&scene.grains));
    // All were checked when the water was made.
    let speed = friction_velocity(scene, water).ok()?;
    let shields = clear.shields(&sand, speed).ok()?;
    let unit = clear.transport_unit(&sand).ok()?;
    let diameter = constants.kind.diameter();
    let relation = |name, curve: TransportCurve| curve.transport(shields).ok().map(|q| (name, q));
    Some(BedLoad::new(BedLoadOptions {
        length: domain.period.axis(0),
        width: if D::V::AXES == 3 {
            domain.period.axis(1)
        } else {
            diameter
        },
        diameter,
        unit,
        shields,
        expected: [
            relation("meyer_peter_mueller", TransportCurve::MEYER_PETER_MULLER),
            relation("wong_parker", TransportCurve::WONG_PARKER),
        ]
        .into_iter()
        .flatten()
        .collect(),
        begins: water.begins,
        skip: wanted.skip,
        moving_speed: 0.1 * (clear.submerged_gravity(&sand).ok()? * sand.diameter).sqrt(),
        sizes: scene
            .grains
            .populations
            .iter()
            .map(|s| s.diameter)
            .collect(),
    }))
}

/// All that look at a run, in the order of their rows.
pub(crate) fn observers_of<D: Slices, S: SpinState>(
    scene: &scene::Scene,
    constants: &Constants,
    domain: &Domain<D>,
    surfaces: &[Arc<dyn Surface<D>>],
    movers: &[bool],
) -> Vec<Box<dyn Observer<D, S>>> {
    let mut observers: Vec<Box<dyn Observer<D, S>>> = Vec::new();
    let depth = (D::V::AXES == 3 && domain.is_periodic(1)).then(|| domain.period.axis(1));
    let removed = scene.walls.iter().find(|w| w.removed != Removal::Never);
    // A gate that lets a hopper empty leaves no heap.
    if let Some(removed) = removed.filter(|_| scene.measures.discharge.is_none()) {
        // A wall that stays and looks along x is the back, one that looks against it the far end.
        let upright = |sign: f64| {
            scene.walls.iter().find_map(|w| {
                let Shape::HalfSpace { point, outward } = &w.shape else {
                    return None;
                };
                (w.removed == Removal::Never && sign * outward.x > 0.999).then_some(point.x)
            })
        };
        observers.push(Box::new(Heap::new(HeapOptions {
            diameter: constants.kind.diameter(),
            depth,
            back: upright(1.0).unwrap_or(0.0),
            far: upright(-1.0),
            release: Some(removed.name.clone()),
            snapshots: vec![0.1, 0.2, 0.4, 0.6, 1.0, 1.4, 2.0, 3.0, 5.0],
        })));
    }
    if let Some(wanted) = &scene.measures.conveying {
        let conveying = conveying_of(scene, wanted, surfaces);
        observers.extend(conveying.map(|c| Box::new(c) as Box<dyn Observer<D, S>>));
    }
    if let Some(wanted) = &scene.measures.discharge {
        observers.push(Box::new(Discharge::new(discharge_of(
            wanted, constants, domain,
        ))));
    }
    observers.extend(
        bed_load_of(scene, constants, domain).map(|o| Box::new(o) as Box<dyn Observer<D, S>>),
    );
    if scene.output.energies {
        observers.push(Box::new(Energy::new()));
    }
    if !scene.outlets.is_empty() || !scene.inlets.is_empty() {
        observers.push(Box::new(Flow::new()));
    }
    observers.push(Box::new(Structure::new(depth)));
    observers.push(Box::new(Balance::new()));
    observers.push(Box::new(Loads::new(movers.to_vec())));
    observers
}
