//! What `tune` may turn: each knob with its notches, from the scene's own setting to coarser ones, and one finer for the
//! reference.

use tsubu::scene::{
    CoarseRule, End, Initial, Law, MeshSurface, Scene, Shape, Source, SpringConstants, Step,
};

/// One setting of one knob.
#[derive(Clone, Debug, PartialEq)]
pub struct Notch {
    /// In words, as "Δt × 1.5".
    pub words: String,
    /// Changes of the scene.
    pub sets: Vec<String>,
    /// Predicted cost of a run over that of the scene.
    pub cost: f64,
}

/// A knob that the scene has.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    /// Its name.
    pub name: &'static str,
    /// Coarser than the scene, mildest first.
    pub coarser: Vec<Notch>,
    /// Finer than the scene, mildest first.
    pub finer: Vec<Notch>,
}

fn notch(words: String, set: String, cost: f64) -> Notch {
    Notch {
        words,
        sets: vec![set],
        cost,
    }
}

/// The knobs of a scene. `steady`: the quantity is a mean over time, so that the length of the run is one.
pub fn knobs(scene: &Scene, steady: bool) -> Vec<Knob> {
    let all = [
        step(scene),
        stiffness(scene),
        level(scene),
        cell(scene),
        steady.then(|| length(scene)).flatten(),
    ];
    all.into_iter().flatten().collect()
}

fn step(scene: &Scene) -> Option<Knob> {
    let by = |factor: f64| {
        let set = match scene.time.step {
            // As a share of what the program chose it cannot be said.
            Step::Automatic => return None,
            Step::PerPeriod(n) => format!("PerPeriod({})", n / factor),
            Step::Seconds(s) => format!("Seconds(\"{:e} s\")", s * factor),
            Step::Exactly(s) => format!("Exactly(\"{:e} s\")", s * factor),
        };
        Some(notch(
            format!("Δt × {factor}"),
            format!("time.step={set}"),
            1.0 / factor,
        ))
    };
    Some(Knob {
        name: "step",
        coarser: [1.5, 2.0].into_iter().map(by).collect::<Option<_>>()?,
        finer: [0.5, 0.25].into_iter().map(by).collect::<Option<_>>()?,
    })
}

/// Softer contacts bear a longer step only where the step follows the period.
fn stiffness(scene: &Scene) -> Option<Knob> {
    let follows = matches!(scene.time.step, Step::PerPeriod(_) | Step::Automatic);
    match &scene.grains.law {
        Law::Repulsion { .. } => {
            let soften = scene.grains.soften;
            let by = |factor: f64| {
                let cost = if follows { factor.sqrt().recip() } else { 1.0 };
                let set = format!("grains.soften={}", soften * factor);
                notch(format!("stiffness / {}", soften * factor), set, cost)
            };
            Some(Knob {
                name: "stiffness",
                coarser: vec![by(10.0)],
                finer: if soften > 1.0 {
                    vec![by(0.1f64.max(soften.recip()))]
                } else {
                    Vec::new()
                },
            })
        }
        Law::HertzMindlin(law) => {
            let by = |factor: f64| {
                let cost = if follows { factor.sqrt() } else { 1.0 };
                let set = format!("grains.law.young={:e} Pa", law.young * factor);
                notch(format!("E × {factor}"), set, cost)
            };
            Some(Knob {
                name: "stiffness",
                coarser: vec![by(0.1)],
                finer: vec![by(10.0)],
            })
        }
        Law::SpringDashpot(law) => match law.constants {
            SpringConstants::FromRestitution {
                normal_stiffness, ..
            } => {
                let by = |factor: f64| {
                    let cost = if follows { factor.sqrt() } else { 1.0 };
                    let set = format!(
                        "grains.law.constants.normal_stiffness={:e} N/m",
                        normal_stiffness * factor
                    );
                    notch(format!("kn × {factor}"), set, cost)
                };
                Some(Knob {
                    name: "stiffness",
                    coarser: vec![by(0.1)],
                    finer: vec![by(10.0)],
                })
            }
            // Constants tuned to measured transport, and those given one by one, are the scene's model.
            _ => None,
        },
    }
}

fn level(scene: &Scene) -> Option<Knob> {
    let drawn = matches!(scene.initial, Initial::Fill(_));
    if !drawn || !matches!(scene.grains.law, Law::Repulsion { .. }) || scene.water.is_some() {
        return None;
    }
    let at = |n: u32| {
        let levels =
            i32::try_from(n).unwrap_or(0) - i32::try_from(scene.grains.coarse).unwrap_or(0);
        // Eight times fewer grains, and where the rule enlarges it twice the step.
        let each: f64 = match scene.grains.coarse_rule {
            CoarseRule::SakaiKoshizuka => 8.0,
            _ => 16.0,
        };
        notch(
            format!("n = {n}"),
            format!("grains.coarse={n}"),
            each.powi(-levels),
        )
    };
    let n = scene.grains.coarse;
    Some(Knob {
        name: "level",
        coarser: [n + 1, n + 2]
            .into_iter()
            .filter(|&n| n <= 8)
            .map(at)
            .collect(),
        finer: n.checked_sub(1).map(at).into_iter().collect(),
    })
}

/// All grids of distances at once. A grid of half the cell takes longer to build, a step with it does not.
fn cell(scene: &Scene) -> Option<Knob> {
    let grids: Vec<(&str, f64)> = scene
        .walls
        .iter()
        .filter_map(|wall| match &wall.shape {
            Shape::Mesh {
                surface:
                    MeshSurface::Grid {
                        cell: Some(cell), ..
                    },
                ..
            } => Some((wall.name.as_str(), *cell)),
            _ => None,
        })
        .collect();
    if grids.is_empty() {
        return None;
    }
    let by = |factor: f64| Notch {
        words: format!("cells × {factor}"),
        sets: grids
            .iter()
            .map(|(name, cell)| format!("walls.{name}.shape.surface.cell={} m", cell * factor))
            .collect(),
        cost: 1.0,
    };
    Some(Knob {
        name: "cell",
        coarser: vec![by(2.0)],
        finer: vec![by(0.5)],
    })
}

fn length(scene: &Scene) -> Option<Knob> {
    let End::Until(until) = scene.time.end else {
        return None;
    };
    // What comes before the flow is not shortened.
    let begins = scene.water.as_ref().map_or(0.0, |water| water.begins);
    let by = |factor: f64| {
        let end = begins + (until - begins) * factor;
        notch(
            format!("{end:.3} s long"),
            format!("time.until={end} s"),
            end / until,
        )
    };
    Some(Knob {
        name: "length",
        coarser: vec![by(0.5)],
        finer: vec![by(2.0), by(4.0)],
    })
}

/// The scene as it is, single notches and pairs of two knobs, cheapest first; only what is predicted to be cheaper than the
/// scene, which comes last.
pub fn candidates(knobs: &[Knob]) -> Vec<Notch> {
    let mut all = vec![Notch {
        words: "as it is".to_owned(),
        sets: Vec::new(),
        cost: 1.0,
    }];
    for (k, knob) in knobs.iter().enumerate() {
        all.extend(knob.coarser.iter().cloned());
        // A coarser or a finer notch of another knob beside it: a coarse level may need stiffer grains.
        for other in &knobs[k + 1..] {
            let turned = |knob: &Knob| -> Vec<Notch> {
                knob.coarser
                    .iter()
                    .chain(knob.finer.first())
                    .cloned()
                    .collect()
            };
            for a in turned(knob) {
                for b in turned(other) {
                    all.push(both(&a, &b));
                }
            }
        }
    }
    all.retain(|n| n.cost < 1.0 || n.sets.is_empty());
    all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    all
}

/// Two notches at once.
pub fn both(a: &Notch, b: &Notch) -> Notch {
    Notch {
        words: format!("{}, {}", a.words, b.words),
        sets: a.sets.iter().chain(&b.sets).cloned().collect(),
        cost: a.cost * b.cost,
    }
}

/// The scene with its knobs turned finer, stiffness first, as far as the predicted cost stays below `most` times its own.
pub fn reference(knobs: &[Knob], most: f64) -> Option<Notch> {
    let mut turned: Option<Notch> = None;
    for name in ["stiffness", "step", "cell", "length"] {
        let Some(knob) = knobs.iter().find(|k| k.name == name) else {
            continue;
        };
        let so_far = turned.clone();
        let with = |finer: &Notch| so_far.as_ref().map_or(finer.clone(), |t| both(t, finer));
        let best = knob.finer.iter().map(with).rfind(|n| n.cost <= most);
        turned = best.or(turned);
    }
    turned
}

/// Lays a notch over a scene.
pub fn turned(source: &Source, notch: &Notch) -> Result<Source, tsubu::scene::SceneError> {
    let mut source = source.clone();
    for set in &notch.sets {
        source.set(set)?;
    }
    Ok(source)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_shipped(name: &str, steady: bool) -> (Source, Vec<Knob>) {
        let file = format!("{}/../../scenarios/{name}.ron", env!("CARGO_MANIFEST_DIR"));
        let source = Source::read(file).unwrap_or_else(|e| panic!("{e}"));
        let checked = source.check().unwrap_or_else(|e| panic!("{e}"));
        (source, knobs(&checked.scene, steady))
    }

    /// Every notch of the shipped scenes is a scene, and what is set is what is read.
    #[test]
    fn every_notch_of_the_shipped_scenes_checks() {
        let cases: [(&str, &[&str]); 3] = [
            ("angle_of_repose", &["step", "stiffness", "level"]),
            (
                "screw_feeder",
                &["step", "stiffness", "level", "cell", "length"],
            ),
            ("movable_bed", &["step", "length"]),
        ];
        for (name, expected) in cases {
            let (source, knobs) = of_shipped(name, name != "angle_of_repose");
            assert_eq!(
                knobs.iter().map(|k| k.name).collect::<Vec<_>>(),
                expected,
                "{name}"
            );
            for notch in candidates(&knobs)
                .iter()
                .chain(reference(&knobs, 12.0).iter())
            {
                let checked = turned(&source, notch).and_then(|s| s.check());
                assert!(checked.is_ok(), "{name}, {}: {checked:?}", notch.words);
            }
        }
    }

    #[test]
    fn candidates_come_cheapest_first_and_no_three_knobs_at_once() {
        let (_, knobs) = of_shipped("screw_feeder", true);
        let all = candidates(&knobs);
        assert!(all.windows(2).all(|two| two[0].cost <= two[1].cost));
        assert_eq!(all.last().map(|n| n.sets.len()), Some(0));
        // A cell is set for each of three walls.
        assert!(
            all.iter().all(|n| n.words.split(", ").count() <= 2),
            "{all:?}"
        );
    }

    #[test]
    fn a_reference_is_finer_and_within_its_means() {
        for name in ["angle_of_repose", "screw_feeder", "movable_bed"] {
            let (_, knobs) = of_shipped(name, name != "angle_of_repose");
            for most in [2.5, 12.0, 40.0] {
                if let Some(finer) = reference(&knobs, most) {
                    assert!((1.0..=most).contains(&finer.cost), "{name}: {finer:?}");
                }
            }
            assert!(reference(&knobs, 12.0).is_some(), "{name}");
        }
    }
}
