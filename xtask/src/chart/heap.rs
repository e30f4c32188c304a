//! The angle of repose of the shipped heap.

use super::scene::{SceneChart, Subject, setting};

/// The scene.
pub fn subject() -> Subject {
    Subject {
        scene: "scenarios/angle_of_repose.ron",
        name: "heap",
        quantity: "angle_of_repose",
        word: "the angle of repose",
        look: 0.02,
        shared: ["output.energies=false", "still.at_most=20 s"]
            .map(str::to_owned)
            .to_vec(),
        cheap: vec!["grains.coarse=3".to_owned()],
        seeds: &["initial.fill.seed=#"],
    }
}

/// Its chart.
pub fn chart() -> SceneChart {
    let n3 = "grains.coarse=3";
    SceneChart {
        subject: subject(),
        title: "Angle of repose: error against cost",
        tries: 3,
        tries_of_reference: 2,
        reference: setting(
            "n = 1, T/40",
            "",
            &["grains.coarse=1", "time.step=PerPeriod(40)"],
        ),
        settings: vec![
            setting("n = 2", "shipped", &[]),
            setting("n = 1", "", &["grains.coarse=1"]),
            setting("n = 3", "grains 8 times larger than real", &[n3]),
            setting(
                "n = 4",
                "grains 16 times larger than real",
                &["grains.coarse=4"],
            ),
            setting("n = 2, T/30", "", &["time.step=PerPeriod(30)"]),
            setting("n = 2, T/40", "", &["time.step=PerPeriod(40)"]),
            setting(
                "n = 3, T/40",
                "grain size",
                &[n3, "time.step=PerPeriod(40)"],
            ),
            setting(
                "n = 3, T/80",
                "grain size",
                &[n3, "time.step=PerPeriod(80)"],
            ),
            setting(
                "n = 4, T/40",
                "grain size",
                &["grains.coarse=4", "time.step=PerPeriod(40)"],
            ),
            setting("n = 2, E/10", "", &["grains.soften=10"]),
            setting("n = 3, E/10", "grain size", &[n3, "grains.soften=10"]),
            setting("n = 3, E/1", "grain size", &[n3, "grains.soften=1"]),
            setting(
                "n = 4, E/1",
                "grain size",
                &["grains.coarse=4", "grains.soften=1"],
            ),
            setting(
                "n = 2, damping softened too",
                "creep, restitution of the real grain kept",
                &["grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 3, damping softened too",
                "grain size, creep",
                &[n3, "grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 2, E/1000, damping softened too",
                "stiffness, creep",
                &["grains.soften=1000", "grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 3, E/1000, damping softened too",
                "grain size, stiffness, creep",
                &[n3, "grains.soften=1000", "grains.softened_damping=Scaled"],
            ),
            setting(
                "n = 2, half the damping",
                "real damping, for the creep of n = 1",
                &["grains.law.damping=Equal(\"0.06285 kg/s\")"],
            ),
            setting(
                "n = 3, a quarter of the damping",
                "real damping, for the creep of n = 1",
                &[n3, "grains.law.damping=Equal(\"0.0314 kg/s\")"],
            ),
            setting(
                "n = 4, an eighth of the damping",
                "real damping, for the creep of n = 1",
                &[
                    "grains.coarse=4",
                    "grains.law.damping=Equal(\"0.0157 kg/s\")",
                ],
            ),
            setting("n = 2, VerletOld", "", &["time.integrator=VerletOld"]),
            setting(
                "n = 3, VerletOld",
                "grain size",
                &[n3, "time.integrator=VerletOld"],
            ),
            setting(
                "n = 3, VerletAveraged(2)",
                "grain size",
                &[n3, "time.integrator=VerletAveraged(sweeps: 2)"],
            ),
            setting(
                "n = 3, VerletAveraged(2), T/12",
                "grain size, step",
                &[
                    n3,
                    "time.integrator=VerletAveraged(sweeps: 2)",
                    "time.step=PerPeriod(12)",
                ],
            ),
            setting(
                "n = 3, DashpotImplicit(2)",
                "grain size",
                &[n3, "time.integrator=DashpotImplicit(sweeps: 2)"],
            ),
            setting(
                "n = 3, DashpotImplicit(2), T/12",
                "grain size, step",
                &[
                    n3,
                    "time.integrator=DashpotImplicit(sweeps: 2)",
                    "time.step=PerPeriod(12)",
                ],
            ),
            setting(
                "n = 2, DashpotImplicit(2), T/12",
                "step",
                &[
                    "time.integrator=DashpotImplicit(sweeps: 2)",
                    "time.step=PerPeriod(12)",
                ],
            ),
            setting(
                "n = 3, rule of Sakai and Koshizuka",
                "grain size",
                &[n3, "grains.coarse_rule=SakaiKoshizuka"],
            ),
            setting(
                "n = 2, rule of Sakai and Koshizuka",
                "",
                &["grains.coarse_rule=SakaiKoshizuka"],
            ),
            setting("n = 2, skin 0.02", "", &["neighbours.skin=0.02"]),
            setting("n = 2, skin 0.2", "", &["neighbours.skin=0.2"]),
        ],
    }
}
