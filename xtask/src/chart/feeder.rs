//! The rate of the shipped screw feeder.

use super::scene::{SceneChart, Subject, setting};

/// The scene.
pub fn subject() -> Subject {
    Subject {
        scene: "scenarios/screw_feeder.ron",
        name: "feeder",
        quantity: "mass_rate_from_section",
        word: "the mass rate",
        look: 0.01,
        shared: ["still.at_most=10 s"].map(str::to_owned).to_vec(),
        cheap: vec!["grains.coarse=4".to_owned()],
        seeds: &["initial.fill.seed=#"],
    }
}

/// Its chart, with the rate in the tube: the one with the smaller error.
pub fn chart() -> SceneChart {
    let n4 = "grains.coarse=4";
    let cell = |mm: &str| format!("walls.screw.shape.surface=Grid(cell: \"{mm} mm\")");
    let (cell1, cell4, cell8) = (cell("1"), cell("4"), cell("8"));
    let formula = "walls.screw.shape=Screw(from: (\"0 mm\", \"0 mm\", \"0 mm\"), to: (\"675 mm\", \"0 mm\", \"0 mm\"), shaft: \"55 mm\", outer: \"205 mm\", pitch: \"150 mm\", thickness: \"6 mm\")";
    SceneChart {
        subject: subject(),
        title: "Screw feeder: error of its rate against cost",
        tries: 1,
        tries_of_reference: 1,
        reference: setting("n = 3, E/10", "", &["grains.soften=10"]),
        settings: vec![
            setting("n = 3", "shipped", &[]),
            setting("n = 4", "grain size", &[n4]),
            setting("n = 5", "grain size", &["grains.coarse=5"]),
            setting(
                "n = 5, E/10",
                "grain size",
                &["grains.coarse=5", "grains.soften=10"],
            ),
            setting("n = 4, E/10", "grain size", &[n4, "grains.soften=10"]),
            setting("n = 4, E/30", "grain size", &[n4, "grains.soften=30"]),
            setting("n = 4, E/1", "grain size", &[n4, "grains.soften=1"]),
            setting(
                "n = 4, damping softened too",
                "grain size, creep",
                &[n4, "grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 4, E/10, damping softened too",
                "grain size, creep",
                &[n4, "grains.soften=10", "grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 4, E/1000, damping softened too",
                "grain size, stiffness, creep",
                &[n4, "grains.soften=1000", "grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 5, E/1000, damping softened too",
                "grain size, stiffness, creep",
                &[
                    "grains.coarse=5",
                    "grains.soften=1000",
                    "grains.softened_damping=Scaled",
                ],
            ),
            setting(
                "n = 3, damping softened too",
                "creep",
                &["grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 4, T/40",
                "grain size",
                &[n4, "time.step=PerPeriod(40)"],
            ),
            setting(
                "n = 4, T/80",
                "grain size",
                &[n4, "time.step=PerPeriod(80)"],
            ),
            setting(
                "n = 4, VerletOld",
                "grain size",
                &[n4, "time.integrator=VerletOld"],
            ),
            setting(
                "n = 4, DashpotImplicit(2), T/12",
                "grain size, step",
                &[
                    n4,
                    "time.integrator=DashpotImplicit(sweeps: 2)",
                    "time.step=PerPeriod(12)",
                ],
            ),
            setting("n = 4, cell 1 mm", "grain size", &[n4, cell1.as_str()]),
            setting(
                "n = 4, cell 4 mm",
                "grain size, edges of the flight",
                &[n4, cell4.as_str()],
            ),
            setting(
                "n = 4, cell 8 mm",
                "grain size, edges of the flight",
                &[n4, cell8.as_str()],
            ),
            setting(
                "n = 4, screw of triangles",
                "grain size",
                &[n4, "walls.screw.shape.surface=Exact"],
            ),
            setting("n = 4, screw by formula", "grain size", &[n4, formula]),
            setting(
                "n = 4, touched at centres",
                "grain size, radius at walls",
                &[
                    n4,
                    "walls.screw.touches_at=Centre",
                    "walls.casing.touches_at=Centre",
                    "walls.hopper.touches_at=Centre",
                ],
            ),
            setting(
                "n = 4, no friction of the screw",
                "grain size, friction",
                &[n4, "walls.screw.friction=None"],
            ),
            setting(
                "n = 4, rule of Sakai and Koshizuka",
                "grain size",
                &[n4, "grains.coarse_rule=SakaiKoshizuka"],
            ),
            setting("n = 4, 9 s", "grain size", &[n4, "time.until=9 s"]),
            setting(
                "n = 4, 3.4 s",
                "grain size, time averaged",
                &[n4, "time.until=3.4 s"],
            ),
            setting(
                "n = 5, 9 s",
                "grain size",
                &["grains.coarse=5", "time.until=9 s"],
            ),
            setting(
                "n = 4, skin 0.2",
                "grain size",
                &[n4, "neighbours.skin=0.2"],
            ),
        ],
    }
}
