//! The kinematic limit: a plug that cannot turn is advanced by one pitch per turn.
//!
//! One grain in a square channel along the screw can only move along the axis; the flight pushes it from
//! behind, and a little friction of the floor keeps it there. Whatever the law, it then goes at p n, so the
//! ratio to theory is exactly 1.

use crate::validate::check::Tolerance;
use crate::validate::report::Report;
use tsubu_assemble::{Choices, Simulation, build};
use tsubu_scene::Source;

/// A grain of n = 3 in a channel at the bottom of the screw, the screw at 60 r/min; `more` are further fields.
fn scene(shape: &str, more: &str) -> String {
    format!(
        r#"(
    title: "A plug that cannot turn",
    gravity: "9.80665 m/s2",
    grains: (
        diameter: "10.8 mm", density: "1370 kg/m3",
        law: Repulsion(stiffness: YoungModulus("31 MPa"), damping: Equal("8.04 kg/s")),
    ),
    walls: [
        (name: "screw", shape: {shape}, restitution: 0.5, friction: 0.413, motion: (
            turn: (point: ("0 mm", "0 mm", "0 mm"), axis: (1, 0, 0), rate: "-60 rpm"),
        )),
        (name: "right", shape: HalfSpace(point: ("0 mm", "-5.41 mm", "0 mm"), outward: (0, 1, 0)), restitution: 0.5),
        (name: "left", shape: HalfSpace(point: ("0 mm", "5.41 mm", "0 mm"), outward: (0, -1, 0)), restitution: 0.5),
        (name: "bottom", shape: HalfSpace(point: ("0 mm", "0 mm", "-75.41 mm"), outward: (0, 0, 1)), restitution: 0.5, friction: 0.1),
        (name: "top", shape: HalfSpace(point: ("0 mm", "0 mm", "-64.59 mm"), outward: (0, 0, -1)), restitution: 0.5),
    ],
    initial: (grains: [(at: ("140 mm", "0 mm", "-70 mm"))]),
    time: (step: PerPeriod(20), until: "3.2 s"),{more}
)"#
    )
}

/// A pitch that repeats, and its measures.
const SECTION: &str = r#"
    domain: (x: Periodic("150 mm")),
    measures: (conveying: (
        screw: "screw", pitch: "150 mm", outer: "205 mm", shaft: "55 mm", casing: "229.6 mm",
        section: ("0 mm", "150 mm"),
    )),"#;

/// Advance per turn over two turns, once the flight has caught up with the grain, in pitches.
fn advance(report: &Report, shape: &str) -> Result<f64, String> {
    let (mut run, dt) = built(report, shape, "")?;
    let mut at = |t: f64| {
        let due = (t / dt).round() as u64;
        run.advance(due.saturating_sub(run.steps()));
        (run.state()[0].0.x, run.time())
    };
    let (start, end) = (at(1.0), at(3.0));
    // The screw turns once per second.
    Ok((end.0 - start.0) / 0.150 / (end.1 - start.1))
}

/// What the measures say of a grain that goes round a pitch without ends.
fn around(report: &Report, shape: &str) -> Result<f64, String> {
    let (mut run, dt) = built(report, shape, SECTION)?;
    // The flight has caught up with the grain after a second.
    run.advance((1.0 / dt).round() as u64);
    let each = (0.001 / dt).round() as u64;
    run.look();
    while !run.is_over() {
        run.advance(each);
        run.look();
    }
    let found = run
        .report()
        .into_iter()
        .find(|r| r.name == "axial_efficiency");
    Ok(found.map_or(f64::NAN, |r| r.value))
}

/// The scene on one thread, and its step.
fn built(report: &Report, shape: &str, more: &str) -> Result<(Box<dyn Simulation>, f64), String> {
    let meshes = report.root().join("scenarios/meshes");
    let shape = shape.replace("meshes", &meshes.display().to_string());
    let checked = Source::from_text("a plug that cannot turn", &scene(&shape, more))
        .check()
        .map_err(|e| e.to_string())?;
    let built = build(
        &checked,
        &Choices {
            threads: Some(1),
            ..Choices::default()
        },
    )
    .map_err(|e| e.to_string())?;
    Ok((built.simulation, built.plan.constants.dt))
}

pub fn run(report: &mut Report) -> Result<(), String> {
    for (name, shape) in [
        (
            "analytic",
            "Screw(from: (\"0 mm\", \"0 mm\", \"0 mm\"), to: (\"675 mm\", \"0 mm\", \"0 mm\"), shaft: \"55 mm\", outer: \"205 mm\", pitch: \"150 mm\", thickness: \"6 mm\")",
        ),
        (
            "grid of distances, cell 2 mm",
            "Mesh(file: \"meshes/screw.stl\", unit: \"mm\", surface: Grid(cell: \"2 mm\"))",
        ),
        (
            "triangles",
            "Mesh(file: \"meshes/screw.stl\", unit: \"mm\", surface: Exact)",
        ),
    ] {
        report.check(
            format!("a plug that cannot turn, screw as {name}: advance per turn over the pitch"),
            1.0,
            advance(report, shape)?,
            Tolerance::Relative(1e-3),
            "pure kinematics; the issue asks for 0.1 %",
        );
    }
    report.check(
        "a plug that cannot turn in a pitch without ends: axial speed over p n",
        1.0,
        around(
            report,
            "Mesh(file: \"meshes/screw_section.stl\", unit: \"mm\", surface: Grid(cell: \"2 mm\"))",
        )?,
        Tolerance::Relative(2e-3),
        "pure kinematics, through the end of the period and back in twice; the grain chatters on the flight by 2 % of its speed and is looked at 2200 times",
    );
    Ok(())
}
