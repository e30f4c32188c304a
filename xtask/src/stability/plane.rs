//! Growth over (K, C) for every integrator, one grain pressed on a wall.

use super::Sheet;
use crate::validate::stability::pressed::{Arrangement, Case, Contact, frequency};
use std::fmt::Write as _;
use tsubu_integrate::Scheme;
use tsubu_picture::Figure;

/// Points along each axis.
const POINTS: u32 = 24;
/// Steps that make the difference between fast and slow growth, and the longest run.
const SOON: u64 = 100;
const STEPS: u64 = 4000;
/// Share of the limit within which a point lies on the line and is not judged.
const ON_THE_LINE: f64 = 0.01;

/// A scheme with the part of the plane that shows its boundary, and the boundary as (C, K) corners.
struct Part {
    scheme: Scheme,
    file: &'static str,
    most: (f64, f64),
    boundary: &'static str,
    corners: &'static [&'static [(f64, f64)]],
}

const PARTS: [Part; 5] = [
    Part {
        scheme: Scheme::SymplecticEuler,
        file: "plane_symplectic_euler",
        most: (2.4, 5.0),
        boundary: "K + 2C = 4",
        corners: &[&[(0.0, 4.0), (2.0, 0.0)]],
    },
    Part {
        scheme: Scheme::VerletOld,
        file: "plane_verlet_old",
        most: (2.4, 5.0),
        boundary: "K + 2C = 4",
        corners: &[&[(0.0, 4.0), (2.0, 0.0)]],
    },
    Part {
        scheme: Scheme::VerletAveraged { sweeps: 4 },
        file: "plane_verlet_averaged",
        most: (6.0, 6.0),
        boundary: "K = 4",
        corners: &[&[(0.0, 4.0), (6.0, 4.0)]],
    },
    Part {
        scheme: Scheme::DashpotImplicit { sweeps: 4 },
        file: "plane_dashpot_implicit",
        most: (6.0, 18.0),
        boundary: "K = 4 + 2C",
        corners: &[&[(0.0, 4.0), (6.0, 16.0)]],
    },
    Part {
        scheme: Scheme::ExplicitEuler,
        file: "plane_explicit_euler",
        most: (5.0, 5.0),
        boundary: "K = C and C = 2 + K/2",
        corners: &[&[(0.0, 0.0), (4.0, 4.0)], &[(2.0, 0.0), (4.0, 4.0)]],
    },
];

/// The maps; true if no point off a line lies on its wrong side.
pub fn run(sheet: &Sheet) -> Result<bool, String> {
    let mut held = true;
    for part in &PARTS {
        held &= map(sheet, part)?;
    }
    Ok(held)
}

fn map(sheet: &Sheet, part: &Part) -> Result<bool, String> {
    let limit = part.scheme.limit();
    let mut csv =
        "K,C,steps to grow a hundredfold (empty: not within 4000),share of the limit\n".to_owned();
    // Dies out, grows soon, grows late.
    let mut classes = [(); 3].map(|()| (Vec::new(), Vec::new()));
    let (mut wrong, mut judged) = (0, 0);
    let at = |k: u32, most: f64| (f64::from(k) + 0.5) * most / f64::from(POINTS);
    for row in 0..POINTS {
        for column in 0..POINTS {
            let (c, k) = (at(column, part.most.0), at(row, part.most.1));
            let case = Case {
                scheme: part.scheme,
                arrangement: Arrangement::Column(1),
                contact: Contact::Repulsion(0.5 * c / k.sqrt()),
            };
            let grown = case.grown_after(k.sqrt() / frequency(), STEPS);
            let used = limit.used(k, c);
            let class = match grown {
                None => 0,
                Some(steps) if steps <= SOON => 1,
                Some(_) => 2,
            };
            classes[class].0.push(c);
            classes[class].1.push(k);
            if (used - 1.0).abs() > ON_THE_LINE {
                judged += 1;
                wrong += u32::from(grown.is_some() != (used > 1.0));
            }
            let steps = grown.map_or(String::new(), |steps| steps.to_string());
            let _ = writeln!(csv, "{k:?},{c:?},{steps},{used:?}");
        }
    }
    let mut figure = Figure::new(
        &format!("{}, one grain on a wall", part.scheme.name()),
        "C = ηΔt/m (–)",
        "K = kΔt²/m (–)",
    )
    .x_range(0.0, part.most.0)
    .y_range(0.0, part.most.1);
    let words = [
        "dies out",
        "grows a hundredfold within 100 steps",
        "grows later",
    ];
    for (words, (c, k)) in words.iter().zip(&classes) {
        if !c.is_empty() {
            figure = figure.points(words, c, k, None);
        }
    }
    for corners in part.corners {
        let (c, k): (Vec<f64>, Vec<f64>) = corners.iter().copied().unzip();
        figure = figure.theory(part.boundary, &c, &k);
    }
    sheet.write(part.file, figure, &csv)?;
    println!(
        "{}: {wrong} of {judged} points on the wrong side of {}",
        part.scheme.name(),
        part.boundary
    );
    Ok(wrong == 0)
}
