//! Outlets, inlets and measures.

use proptest::collection::vec;
use proptest::option::of;
use proptest::prelude::*;
use tsubu_scene::*;

use super::{region, size};

/// Outlets at x below zero, and boxes in which grains are put above it: a grain put into an outlet is refused.
pub fn flow() -> impl Strategy<Value = (Vec<Outlet>, Vec<Inlet>)> {
    let source = || region().prop_map(|region| moved(region, 1e4));
    let recycle = (source(), any::<u64>()).prop_map(|(into, seed)| Fate::Recycle { into, seed });
    let then = prop_oneof![Just(Fate::Delete), recycle];
    let outlet = (region(), then).prop_map(|(region, then)| Outlet {
        name: String::new(),
        region: moved(region, -1e4),
        then,
    });
    let inlet =
        (source(), 1e-6_f64..0.36, any::<u64>()).prop_map(|(region, solid_fraction, seed)| Inlet {
            name: String::new(),
            region,
            solid_fraction,
            seed,
        });
    (vec(outlet, 0..3), vec(inlet, 0..3)).prop_map(|(mut outlets, mut inlets)| {
        for (i, outlet) in outlets.iter_mut().enumerate() {
            outlet.name = format!("outlet {i}");
        }
        for (i, inlet) in inlets.iter_mut().enumerate() {
            inlet.name = format!("inlet {i}");
        }
        (outlets, inlets)
    })
}

fn moved(mut region: Region, along_x: f64) -> Region {
    region.min.x += along_x;
    region.max.x += along_x;
    region
}

/// A measure; its wall and its outlet are numbers of any size, see [`fitting`].
pub fn conveying() -> impl Strategy<Value = Conveying> {
    let places = (any::<usize>(), of(any::<usize>()), of(region()));
    let sizes = (size(), size(), 1.01_f64..9.0, 1.01_f64..9.0);
    (places, sizes, -1e3_f64..1e3, 1e-3_f64..1e3).prop_map(
        |((screw, outlet, hopper), (pitch, shaft, outer, casing), from, long)| Conveying {
            screw,
            pitch,
            outer: shaft * outer,
            shaft,
            section: [from, from + long],
            casing: shaft * outer * casing,
            hopper,
            outlet,
        },
    )
}

/// The measure of one of these walls, which turns, and of one of so many outlets, if any; `None` without a wall.
pub fn fitting(mut measure: Conveying, walls: &[Wall], outlets: usize) -> Option<Conveying> {
    measure.outlet = measure
        .outlet
        .and_then(|number| number.checked_rem(outlets));
    measure.screw = walls.iter().position(|wall| {
        let turn = wall.motion.as_ref().and_then(|motion| motion.turn);
        turn.is_some_and(|turn| turn.rate != 0.0)
    })?;
    if let Shape::Screw {
        shaft,
        outer,
        pitch,
        ..
    } = walls[measure.screw].shape
    {
        (measure.shaft, measure.outer, measure.pitch) = (shaft, outer, pitch);
        measure.casing = outer * 1.1;
    }
    Some(measure)
}
