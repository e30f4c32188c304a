//! The longest step of columns and packings against the largest eigenvalue of their network.

use super::Sheet;
use crate::validate::stability::limits::STEPS;
use crate::validate::stability::pressed::{Arrangement, Case, Contact, frequency, springs};
use std::f64::consts::PI;
use std::fmt::Write as _;
use tsubu_integrate::Scheme;
use tsubu_picture::Figure;

/// Measured and theory may differ by this.
const TOLERANCE: f64 = 0.01;

/// A packing by its name in the CSV.
type Named = (String, Arrangement, Contact);

/// Both maps.
pub fn run(sheet: &Sheet) -> Result<bool, String> {
    Ok(columns(sheet)? & packings(sheet)?)
}

/// K + 2C of one grain at which a column begins to grow, and at which theory says.
fn edge(case: &Case) -> (f64, f64) {
    let dt = case.limit().unwrap_or(f64::NAN);
    let load = |dt: f64| {
        let (k, c) = case.numbers(dt);
        k + 2.0 * c
    };
    (load(case.found(dt, STEPS) * dt), load(dt))
}

fn columns(sheet: &Sheet) -> Result<bool, String> {
    let n: Vec<f64> = (1..=20).map(f64::from).collect();
    let mut csv = "grains,scheme,zeta,K + 2C found,K + 2C of the theory\n".to_owned();
    let mut figure = Figure::new(
        "Columns on a floor",
        "grains (–)",
        "K + 2C of one grain at which growth begins (–)",
    )
    .x_range(0.0, 21.0)
    .y_range(0.0, 4.5);
    let factor = |n: &f64| 2.0 + 2.0 * (2.0 * PI / (2.0 * n + 1.0)).cos();
    let theory: Vec<f64> = n.iter().map(|n| 4.0 / factor(n)).collect();
    figure = figure.theory("4/(2 + 2cos(2π/(2n + 1)))", &n, &theory);
    figure = figure.line("what one contact bears", &[0.0, 21.0], &[4.0, 4.0]);
    let mut worst = 0.0f64;
    for (scheme, zeta) in [
        (Scheme::SymplecticEuler, 0.0),
        (Scheme::SymplecticEuler, 0.3),
        (Scheme::VerletOld, 0.3),
    ] {
        let mut found = Vec::new();
        for n in 1..=20 {
            let case = Case {
                scheme,
                arrangement: Arrangement::Column(n),
                contact: Contact::Repulsion(zeta),
            };
            let (got, theory) = edge(&case);
            worst = worst.max((got / theory - 1.0).abs());
            found.push(got);
            let _ = writeln!(csv, "{n},{},{zeta},{got:?},{theory:?}", scheme.name());
        }
        figure = figure.points(&format!("{}, ζ = {zeta}", scheme.name()), &n, &found, None);
    }
    sheet.write("columns", figure, &csv)?;
    println!(
        "columns of 1–20: K + 2C found is within {:.2} % of theory",
        100.0 * worst
    );
    Ok(worst < TOLERANCE)
}

fn packings(sheet: &Sheet) -> Result<bool, String> {
    let (central, sticking) = (Contact::Repulsion(0.0), |stiff| springs(0.0, stiff, 0.0));
    let groups: [(&str, Vec<Named>); 3] = [
        (
            "columns of 1, 2, 4, 20 and a pair",
            [1, 2, 4, 20]
                .map(Arrangement::Column)
                .into_iter()
                .chain([Arrangement::Pair])
                .map(|a| (format!("{a:?}"), a, central))
                .collect(),
        ),
        (
            "hexagonal and fcc, central springs",
            [Arrangement::Hexagonal, Arrangement::FaceCentredCubic]
                .map(|a| (format!("{a:?}"), a, central))
                .to_vec(),
        ),
        (
            "spheres that turn: wall, pair, hexagonal, fcc, kt = kn/2.6 and kn",
            [1.0 / 2.6, 1.0]
                .into_iter()
                .flat_map(|stiff| {
                    [
                        Arrangement::Column(1),
                        Arrangement::Pair,
                        Arrangement::Hexagonal,
                        Arrangement::FaceCentredCubic,
                    ]
                    .map(|a| {
                        (
                            format!("{a:?} that turns kt/kn = {stiff:.4}"),
                            a,
                            sticking(stiff),
                        )
                    })
                })
                .collect(),
        ),
    ];
    let mut csv = "packing,lambda max m/k of the theory,4/K found\n".to_owned();
    let mut figure = Figure::new(
        "Undamped packings: the stiffest mode",
        "λmax of the network over k/m (–)",
        "4/K at which growth begins (–)",
    )
    .log_x()
    .log_y()
    .theory("Δt² λmax = 4", &[0.8, 100.0], &[0.8, 100.0]);
    let mut worst = 0.0f64;
    for (words, cases) in groups {
        let (mut x, mut y) = (Vec::new(), Vec::new());
        for (name, arrangement, contact) in cases {
            let case = Case {
                scheme: Scheme::SymplecticEuler,
                arrangement,
                contact,
            };
            let (unit, _) = case.numbers(1.0 / frequency());
            let factor = case.network().stiffest() / (frequency() * frequency()) / unit;
            let dt = (4.0 / factor / unit).sqrt() / frequency();
            let (k, _) = case.numbers(dt * case.found(dt, STEPS / 4));
            worst = worst.max((4.0 / k / factor - 1.0).abs());
            let _ = writeln!(csv, "\"{name}\",{factor:?},{:?}", 4.0 / k);
            println!("{name}: λmax m/k = {factor:.4}, 4/K found {:.4}", 4.0 / k);
            x.push(factor);
            y.push(4.0 / k);
        }
        figure = figure.points(words, &x, &y, None);
    }
    sheet.write("packings", figure, &csv)?;
    println!(
        "packings: 4/K found is within {:.2} % of λmax m/k",
        100.0 * worst
    );
    Ok(worst < 2.0 * TOLERANCE)
}
