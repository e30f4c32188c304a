//! A step 2 % over the limit grows and one 2 % under does not, for every scheme and packing; and the limits themselves.

use super::limits::claimed_of_packing;
use super::network::Network;
use super::pressed::{Arrangement, Case, Contact, frequency, paper_b, springs};
use crate::validate::check::Tolerance;
use crate::validate::lab::name;
use crate::validate::report::Report;
use std::f64::consts::{PI, SQRT_2};
use tsubu_integrate::Scheme;

/// Steps in which growth at 1.02 must show: |z| − 1 is some 0.08/C there, 0.02 C for explicit Euler.
const STEPS: u64 = 2000;

/// Every scheme with the solves of four sweeps.
const SCHEMES: [Scheme; 5] = Scheme::ALL;

/// What each scheme is tried on.
fn arrangements() -> Vec<Arrangement> {
    let columns = [1, 2, 3, 5, 8, 13, 20].map(Arrangement::Column);
    let packings = [
        Arrangement::Pair,
        Arrangement::Hexagonal,
        Arrangement::FaceCentredCubic,
    ];
    columns.into_iter().chain(packings).collect()
}

/// Dampings that each scheme is tried with. Explicit Euler has none without damping, and one that is known only where the
/// damping is in proportion to the stiffness.
fn contacts(scheme: Scheme) -> Vec<Contact> {
    if scheme == Scheme::ExplicitEuler {
        [0.4, 0.7].map(Contact::Along).to_vec()
    } else {
        vec![
            Contact::Repulsion(0.0),
            Contact::Repulsion(0.0347),
            Contact::Repulsion(0.3),
            Contact::Along(0.3),
        ]
    }
}

/// Counts of cases that grow at 1.02 and at 0.98 of their limit, and of all.
fn counts(cases: &[Case]) -> [f64; 3] {
    let mut counts = [0.0; 3];
    for case in cases {
        let limit = case.limit();
        // A limit that is not found counts on the wrong side of both.
        let grows = [(1.02, false), (0.98, true)]
            .map(|(share, unknown)| limit.map_or(unknown, |dt| case.grows(share * dt, STEPS)));
        if grows != [true, false] {
            eprintln!("  {case:?}: grows at 1.02 and 0.98: {grows:?}");
        }
        counts[0] += f64::from(u8::from(grows[0]));
        counts[1] += f64::from(u8::from(grows[1]));
        counts[2] += 1.0;
    }
    counts
}

fn both_sides(report: &mut Report, what: &str, cases: &[Case]) {
    let [over, under, all] = counts(cases);
    let note =
        "the largest eigenvalue of the network, or the modes of explicit Euler, by a dense library";
    report.check(
        format!("{what}: cases that grow at 1.02 of their limit"),
        all,
        over,
        Tolerance::Absolute(0.0),
        note,
    );
    report.check(
        format!("{what}: cases of {all} that grow at 0.98 of their limit"),
        0.0,
        under,
        Tolerance::Absolute(0.0),
        note,
    );
}

/// The checks.
pub fn run(report: &mut Report) {
    closed_forms(report);
    paper_b_constants(report);
    for scheme in SCHEMES {
        for (what, columns) in [("columns of 1–20", true), ("pair, hexagonal, fcc", false)] {
            let here = arrangements()
                .into_iter()
                .filter(|a| matches!(a, Arrangement::Column(_)) == columns);
            let cases: Vec<Case> = here
                .flat_map(|arrangement| {
                    contacts(scheme).into_iter().map(move |contact| Case {
                        scheme,
                        arrangement,
                        contact,
                    })
                })
                .collect();
            both_sides(report, &format!("{}, {what}", name(scheme)), &cases);
        }
    }
    for scheme in [Scheme::SymplecticEuler, Scheme::VerletOld] {
        let on = [
            Arrangement::Column(1),
            Arrangement::Pair,
            Arrangement::Column(4),
            Arrangement::Hexagonal,
        ];
        let cases: Vec<Case> = on
            .into_iter()
            .flat_map(|arrangement| {
                let of = [
                    springs(0.0, 1.0, 0.0),
                    springs(0.3, 1.0 / 2.6, 2.6f64.sqrt().recip()),
                ];
                of.map(|contact| Case {
                    scheme,
                    arrangement,
                    contact,
                })
            })
            .collect();
        both_sides(
            report,
            &format!("{}, grains that turn", name(scheme)),
            &cases,
        );
    }
    engine_knows(report);
}

/// λmax m/k of a network of undamped contacts.
fn factor(arrangement: Arrangement, contact: Contact) -> f64 {
    let case = Case {
        scheme: Scheme::SymplecticEuler,
        arrangement,
        contact,
    };
    let network: Network = case.network();
    let (k, _) = case.numbers(1.0 / frequency());
    network.stiffest() / (frequency() * frequency()) / k
}

/// The dense matrices against closed forms.
fn closed_forms(report: &mut Report) {
    // Loads differ along a column by up to 20 overlaps of 4e-6, and stiffness by 21 times that.
    let note = "closed form; the stiffness of the lowest of 20 grains is 1.7e-3 larger, the mean half of that";
    for n in [1, 2, 4, 20] {
        report.check(
            format!("column of {n}: λmax m/k of the dense matrix"),
            2.0 + 2.0 * (2.0 * PI / (2.0 * f64::from(n) + 1.0)).cos(),
            factor(Arrangement::Column(n), Contact::Repulsion(0.0)),
            Tolerance::Relative(1e-3),
            note,
        );
    }
    let smooth = Contact::Repulsion(0.0);
    for (what, expected, arrangement, contact) in [
        ("pair", 2.0, Arrangement::Pair, smooth),
        ("hexagonal", 6.0, Arrangement::Hexagonal, smooth),
        ("fcc", 8.0, Arrangement::FaceCentredCubic, smooth),
        (
            "pair that rolls, kt = kn",
            2.0 + 5.0,
            Arrangement::Pair,
            springs(0.0, 1.0, 0.0),
        ),
        (
            "hexagonal, spheres that turn, kt = kn",
            30.0,
            Arrangement::Hexagonal,
            springs(0.0, 1.0, 0.0),
        ),
    ] {
        report.check(
            format!("{what}: λmax m/k of the dense matrix"),
            expected,
            factor(arrangement, contact),
            Tolerance::Relative(1e-3),
            "closed form",
        );
    }
    // Paper B: K = 2π²/αtn² and C = 2√2 π αcn/αtn of one grain; αcn at which K + 2C times the factor is 4.
    let k = 2.0 * PI * PI / 400.0;
    for (what, factor, printed) in [
        ("a long chain", 4.0, 1.07),
        ("hexagonal, smooth", 6.0, 0.695),
    ] {
        let cn = (4.0 / factor - k) / 2.0 * 20.0 / (2.0 * SQRT_2 * PI);
        report.check(
            format!("αcn at the limit, αtn = 20, {what}"),
            printed,
            cn,
            Tolerance::Relative(5e-3),
            "two or three digits",
        );
    }
}

/// Paper B's (20, 1.3) on each arrangement: λmax[M^-½(Δt²K + 2ΔtC)M^-½], stable below 4.
fn paper_b_constants(report: &mut Report) {
    for (what, expected, arrangement, sticks) in [
        ("a wall, rolling", 2.92, Arrangement::Column(1), true),
        ("a pair, pressing", 2.41, Arrangement::Pair, false),
        ("a pair, rolling", 5.84, Arrangement::Pair, true),
        ("a column of 4", 4.25, Arrangement::Column(4), false),
        ("hexagonal, smooth", 7.23, Arrangement::Hexagonal, false),
        ("hexagonal, rolling", 26.2, Arrangement::Hexagonal, true),
    ] {
        let case = Case {
            scheme: Scheme::SymplecticEuler,
            arrangement,
            contact: paper_b(1.3, sticks),
        };
        let dt = SQRT_2 * PI / 20.0 / frequency();
        report.check(
            format!("paper B's (20, 1.3), {what}: λmax of the dense matrix"),
            expected,
            4.0 * case.network().used(case.scheme, dt),
            Tolerance::Relative(3e-3),
            "three digits, worked out apart from this code",
        );
    }
}

/// The engine's own power method, and the closed forms of `integrate`, against the dense matrix.
fn engine_knows(report: &mut Report) {
    let mut worst = [0.0f64; 2];
    let cases = arrangements().into_iter().flat_map(|arrangement| {
        let of = [
            Contact::Repulsion(0.0),
            Contact::Repulsion(0.3),
            springs(0.3, 1.0 / 2.6, 2.6f64.sqrt().recip()),
        ];
        // A packing in space that turns has 648 coordinates: too many for a quick check.
        let of = of
            .into_iter()
            .take(if arrangement == Arrangement::FaceCentredCubic {
                2
            } else {
                3
            });
        of.map(move |contact| Case {
            scheme: Scheme::SymplecticEuler,
            arrangement,
            contact,
        })
    });
    for case in cases {
        let dt = case.limit().unwrap_or(f64::NAN);
        worst[0] = worst[0].max((case.stiffest_mode(dt) / 4.0 - 1.0).abs());
        if let (Some(claimed), Contact::Repulsion(_)) = (claimed_of_packing(&case), case.contact) {
            worst[1] = worst[1].max((claimed / dt - 1.0).abs());
        }
    }
    report.check(
        "the engine's stiffest mode over the dense one, all arrangements: largest difference",
        0.01,
        worst[0],
        Tolerance::AtMost,
        "1 % asked of the guard",
    );
    report.check(
        "limits of integrate over the dense one, all arrangements: largest difference of Δt",
        1e-3,
        worst[1],
        Tolerance::AtMost,
        "closed form, but for the loads of a column",
    );
}
