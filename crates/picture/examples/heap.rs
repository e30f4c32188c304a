//! Draws a plot, a picture and an animation of grains poured onto a heap, without any physics.
//!
//! `cargo run -p tsubu-picture --example heap`, then look into `target/`.

use std::path::Path;
use std::time::{Duration, Instant};

use tsubu_picture::{Animation, Camera, Figure, PictureError, Quad, Radii, Scene3, Segment, View};

/// Numbers from 0 to 1 that look random and are the same every time.
fn random(index: usize, draw: usize) -> f32 {
    let mut z = (index as u64)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .wrapping_add(draw as u64 + 1);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
}

/// Grain `index` of a heap at a time: it falls from above onto its place.
fn grain(index: usize, count: usize, time: f32) -> ([f32; 3], f32) {
    let layer = (index as f32 / count as f32).powf(1.5);
    let z = 0.04 * layer;
    let reach = 0.1 * (1.0 - layer);
    let (angle, out) = (
        std::f32::consts::TAU * random(index, 0),
        random(index, 1).sqrt() * reach,
    );
    let landing = 0.15 + 1.6 * index as f32 / count as f32 + 0.1 * random(index, 2);
    let falling = (landing - time).max(0.0);
    let height = z + 1.2 * falling * falling;
    let speed = if time < landing {
        2.4 * (1.2 - falling).max(0.0) * 0.35
    } else {
        0.8 * (-(time - landing) * 5.0).exp()
    };
    (
        [
            out * angle.cos() * 1.3,
            out * angle.sin() * 0.6,
            height + 0.002,
        ],
        speed,
    )
}

fn main() -> Result<(), PictureError> {
    let target = Path::new("target");
    let friction: Vec<f64> = (0..=50).map(|i| 0.01 + 0.02 * f64::from(i)).collect();
    let theory: Vec<f64> = friction
        .iter()
        .map(|m| 32.0 * (1.0 - (-3.5 * m).exp()))
        .collect();
    let shifted = |by: f64| theory.iter().map(|a| a + by).collect::<Vec<_>>();
    let few: Vec<f64> = friction.iter().step_by(7).copied().collect();
    let seen: Vec<f64> = few
        .iter()
        .enumerate()
        .map(|(i, m)| 32.0 * (1.0 - (-3.5 * m).exp()) + [0.6, -0.8, 0.3][i % 3])
        .collect();
    let repose = Figure::new(
        "Angle of repose against friction",
        "friction coefficient µ (–)",
        "angle of repose (°)",
    )
    .theory("theory", &friction, &theory)
    .band(
        "simulation, ten seeds",
        &friction,
        &shifted(-1.5),
        &shifted(1.5),
    )
    .points(
        "simulation, ten seeds",
        &few,
        &seen,
        Some(&vec![1.0; few.len()]),
    )
    .measured(
        "measured",
        &[0.15, 0.35, 0.5, 0.62, 0.9],
        &[13.1, 24.0, 25.5, 29.3, 29.9],
    )
    .y_range(0.0, 35.0)
    .caption("cargo run -p tsubu-picture --example heap (invented numbers)")
    .save(&target.join("demo_plot"))?;
    let steps: Vec<f64> = (0..9).map(|i| 1e-7 * 2f64.powi(i)).collect();
    let order = |factor: f64, power: i32| {
        steps
            .iter()
            .map(|s| factor * (s / 1e-7).powi(power))
            .collect::<Vec<_>>()
    };
    let errors = Figure::new(
        "Error of one bounce",
        "time step Δt (s)",
        "relative error of energy (–)",
    )
    .log_x()
    .log_y()
    .theory("second order", &steps, &order(1e-12, 2))
    .line("velocity Verlet", &steps, &order(1.7e-12, 2))
    .points("symplectic Euler", &steps, &order(3e-9, 1), None)
    .points("with friction", &steps, &order(2e-11, 2), None)
    .caption("cargo run -p tsubu-picture --example heap (invented numbers)")
    .save(&target.join("demo_errors"))?;

    let count = 5000;
    let floor = Quad {
        corner: [-0.15, -0.08, 0.0],
        edges: [[0.3, 0.0, 0.0], [0.0, 0.16, 0.0]],
    };
    let back = Quad {
        corner: [-0.15, 0.08, 0.0],
        edges: [[0.3, 0.0, 0.0], [0.0, 0.0, 0.1]],
    };
    let pole = Segment {
        from: [-0.15, -0.08, 0.0],
        to: [-0.15, -0.08, 0.1],
    };
    let radii: Vec<f32> = (0..count).map(|i| 0.0015 + 0.0008 * random(i, 3)).collect();
    let camera = Camera::oblique([-0.15, -0.08, 0.0], [0.15, 0.08, 0.1]);
    let path = target.join("demo_heap.gif");
    let mut animation = Animation::create(&path, 800, 400, Duration::from_millis(50))?;
    let (mut drawing, mut writing) = (Duration::ZERO, Duration::ZERO);
    for step in 0..60 {
        let time = step as f32 / 30.0;
        let (centres, values): (Vec<_>, Vec<_>) = (0..count).map(|i| grain(i, count, time)).unzip();
        let scene = Scene3 {
            centres: &centres,
            radii: Radii::Each(&radii),
            values: &values,
            quads: &[floor, back],
            segments: &[pole],
            faces: &[],
        };
        let label = format!("t = {time:.2} s");
        let view = View {
            width: 800,
            height: 400,
            range: (0.0, 1.0),
            label: "speed (m/s)",
            time: &label,
        };
        let start = Instant::now();
        let image = scene.draw(&camera, &view);
        drawing += start.elapsed();
        let start = Instant::now();
        animation.push(&image)?;
        writing += start.elapsed();
        if step == 40 {
            image.save_png(&target.join("demo_heap.png"))?;
            let front = Camera::front([-0.15, 0.0, 0.0], [0.15, 0.0, 0.1]);
            scene
                .draw(&front, &view)
                .save_png(&target.join("demo_heap_front.png"))?;
        }
    }
    let path = animation.finish()?;
    println!(
        "60 frames of {count} grains: {:.0} ms drawing, {:.0} ms writing",
        drawing.as_secs_f64() * 1e3,
        writing.as_secs_f64() * 1e3
    );

    let many = 100_000;
    let centres: Vec<[f32; 3]> = (0..many)
        .map(|i| [random(i, 0), random(i, 1), 0.5 * random(i, 2)])
        .collect();
    let values: Vec<f32> = centres.iter().map(|c| c[2] * 2.0).collect();
    let scene = Scene3 {
        centres: &centres,
        radii: Radii::Same(0.008),
        values: &values,
        ..Scene3::default()
    };
    let (low, high) = scene.bounds();
    let view = View {
        label: "height (m)",
        time: "100 000 grains",
        ..View::default()
    };
    let start = Instant::now();
    let image = scene.draw(&Camera::oblique(low, high), &view);
    println!(
        "{many} grains at 960 × 540: {:.0} ms",
        start.elapsed().as_secs_f64() * 1e3
    );
    image.save_png(&target.join("demo_many.png"))?;

    // A plane scene: a heap in rows, x to the right, y up.
    let rows = (0..26).flat_map(|row| {
        (0..80 - 3 * row).map(move |i| {
            [
                (i as f32 - 0.5 * (79 - 3 * row) as f32) * 2.0,
                row as f32 * 1.74 + 1.0,
                0.0,
            ]
        })
    });
    let plane: Vec<[f32; 3]> = rows.collect();
    let values: Vec<f32> = plane
        .iter()
        .map(|c| (c[0] * 0.15).sin() * 0.5 + 0.5)
        .collect();
    let ground = [Segment {
        from: [-85.0, 0.0, 0.0],
        to: [85.0, 0.0, 0.0],
    }];
    let scene = Scene3 {
        centres: &plane,
        radii: Radii::Same(1.0),
        values: &values,
        segments: &ground,
        quads: &[],
        faces: &[],
    };
    let (low, high) = scene.bounds();
    let view = View {
        label: "rotation (rad)",
        time: "plane heap",
        ..View::default()
    };
    scene
        .draw(&Camera::above(low, high), &view)
        .save_png(&target.join("demo_plane.png"))?;

    for file in repose.iter().chain(&errors).chain([&path]) {
        println!(
            "{} {} kB",
            file.display(),
            std::fs::metadata(file).map_or(0, |m| m.len() / 1000)
        );
    }
    Ok(())
}
