//! Transport of the shipped bed.

use super::scene::{SceneChart, Subject, setting};

/// The scene.
pub fn subject() -> Subject {
    Subject {
        scene: "scenarios/movable_bed.ron",
        name: "bed",
        quantity: "transport",
        word: "the transport qB*",
        look: 0.002,
        shared: Vec::new(),
        cheap: vec![
            "initial.bed.layers=3".to_owned(),
            "water.begins=30 ms".to_owned(),
            "time.until=80 ms".to_owned(),
        ],
        seeds: &["initial.bed.seed=#", "water.turbulence=Switched(seed: #)"],
    }
}

/// Its chart. β softens: its reference has the shipped one, since paper B tuned it.
pub fn chart() -> SceneChart {
    let short = "time.until=1 s";
    let long = "time.until=4 s";
    SceneChart {
        subject: subject(),
        title: "Transport of the movable bed: error against cost",
        tries: 6,
        tries_of_reference: 12,
        reference: setting(
            "Δt = 1.5 µs, 4 s",
            "",
            &["time.step=Exactly(\"1.5 us\")", long],
        ),
        settings: vec![
            setting("Δt = 3 µs", "shipped", &[]),
            setting("Δt = 2 µs", "", &["time.step=Exactly(\"2 us\")"]),
            setting("Δt = 1.5 µs", "", &["time.step=Exactly(\"1.5 us\")"]),
            setting("1 s", "time averaged", &[short]),
            setting("2.5 s", "", &["time.until=2.5 s"]),
            setting("4 s", "", &[long]),
            setting("0.7 s", "time averaged", &["time.until=0.7 s"]),
            setting("5 layers", "depth", &["initial.bed.layers=5"]),
            setting("5 layers, 4 s", "depth", &["initial.bed.layers=5", long]),
            setting("3 layers", "depth", &["initial.bed.layers=3"]),
            setting(
                "3 layers, 1 s",
                "depth, time averaged",
                &["initial.bed.layers=3", short],
            ),
            setting("7 layers", "depth", &["initial.bed.layers=7"]),
            setting("15 layers", "", &["initial.bed.layers=15"]),
            setting(
                "20 grains long",
                "length",
                &["domain.x=Periodic(\"10.7 mm\")"],
            ),
            setting(
                "20 grains long, 4 s",
                "length",
                &["domain.x=Periodic(\"10.7 mm\")", long],
            ),
            setting(
                "10 grains long, 4 s",
                "length",
                &["domain.x=Periodic(\"5.35 mm\")", long],
            ),
            setting("80 grains long", "", &["domain.x=Periodic(\"42.8 mm\")"]),
            setting(
                "80 grains long, 4 s",
                "",
                &["domain.x=Periodic(\"42.8 mm\")", long],
            ),
            setting("turbulence off", "turbulence", &["water.turbulence=Off"]),
            setting(
                "turbulence at 500 Hz",
                "correlation of turbulence",
                &["water.turbulence=Switched(frequency: \"500 Hz\")"],
            ),
            setting("β = 30", "stiffness", &["grains.law.constants.beta=30"]),
            setting(
                "β = 8",
                "the tuned stiffness",
                &["grains.law.constants.beta=8"],
            ),
            setting(
                "β = 4",
                "the tuned stiffness",
                &["grains.law.constants.beta=4"],
            ),
            setting(
                "slip as printed",
                "the cap on the tangential dashpot",
                &["grains.law.slip=AsPrinted"],
            ),
            setting(
                "tension as printed, β = 1",
                "the tuned stiffness",
                &[
                    "grains.law.tension=AsPrinted",
                    "grains.law.constants.beta=1",
                ],
            ),
            setting("friction 0.3", "friction", &["grains.law.friction=0.3"]),
            setting(
                "damping αcn = 0.65",
                "damping",
                &["grains.law.constants.cn=0.65"],
            ),
            setting(
                "damping αcn = 0.65, Δt = 6 µs",
                "damping, step",
                &[
                    "grains.law.constants.cn=0.65",
                    "time.step=Exactly(\"6 us\")",
                ],
            ),
            setting("VerletOld", "", &["time.integrator=VerletOld"]),
            setting("skin 0.3", "", &["neighbours.skin=0.3"]),
            setting("in space", "", &["space=Space"]),
        ],
    }
}
