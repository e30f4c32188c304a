//! What a picture of grains must show.

use super::*;
use proptest::prelude::*;

const LOW: [f32; 3] = [-1.0; 3];
const HIGH: [f32; 3] = [1.0; 3];

fn small() -> View<'static> {
    View {
        width: 121,
        height: 81,
        ..View::default()
    }
}

#[test]
fn the_nearer_grain_hides_the_farther_from_every_side() {
    let centres = [[0.0, -0.5, 0.0], [0.0, 0.5, 0.0]];
    let scene = Scene3 {
        centres: &centres,
        radii: Radii::Same(0.4),
        values: &[0.2, 0.9],
        ..Scene3::default()
    };
    let front = Camera::front(LOW, HIGH);
    let back = Camera {
        look: [0.0, -1.0, 0.0],
        ..front
    };
    assert_eq!(
        scene.draw(&front, &small()).pixel(60, 40),
        Some(of_share(0.2))
    );
    assert_eq!(
        scene.draw(&back, &small()).pixel(60, 40),
        Some(of_share(0.9))
    );
}

#[test]
fn right_is_right_and_up_is_up() {
    let centres = [[0.7, 0.0, 0.7]];
    let scene = Scene3 {
        centres: &centres,
        radii: Radii::Same(0.2),
        values: &[0.5],
        ..Scene3::default()
    };
    let image = scene.draw(&Camera::front(LOW, HIGH), &small());
    let inked = |x: usize, y: usize| image.pixel(x, y) != Some(PAPER);
    assert!(inked(60 + 27, 40 - 27) && !inked(60 - 27, 40 - 27) && !inked(60 + 27, 40 + 27));
    let plane = [[0.7, -0.7, 0.0]];
    let scene = Scene3 {
        centres: &plane,
        radii: Radii::Same(0.2),
        values: &[0.5],
        ..Scene3::default()
    };
    let image = scene.draw(&Camera::above([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]), &small());
    assert!(image.pixel(60 + 27, 40 + 27) != Some(PAPER));
}

#[test]
fn a_wall_in_front_tints_the_grain_and_one_behind_does_not() {
    let wall = |y: f32| Quad {
        corner: [-0.9, y, -0.9],
        edges: [[1.8, 0.0, 0.0], [0.0, 0.0, 1.8]],
    };
    let draw = |quads: &[Quad]| {
        let scene = Scene3 {
            centres: &[[0.0; 3]],
            radii: Radii::Same(0.5),
            values: &[0.5],
            quads,
            ..Scene3::default()
        };
        scene.draw(&Camera::front(LOW, HIGH), &small())
    };
    assert_eq!(draw(&[wall(0.9)]).pixel(60, 40), draw(&[]).pixel(60, 40));
    assert_ne!(draw(&[wall(-0.9)]).pixel(60, 40), draw(&[]).pixel(60, 40));
    assert_ne!(
        draw(&[wall(0.9)]).pixel(60, 8),
        draw(&[]).pixel(60, 8),
        "the wall itself is seen"
    );
}

#[test]
fn a_value_that_is_not_a_number_is_grey() {
    let scene = Scene3 {
        centres: &[[0.0; 3]],
        radii: Radii::Same(0.5),
        values: &[f32::NAN],
        ..Scene3::default()
    };
    assert_eq!(
        scene
            .draw(&Camera::front(LOW, HIGH), &small())
            .pixel(60, 40),
        Some(UNKNOWN)
    );
}

#[test]
fn one_thread_and_many_give_the_same_bytes() {
    let centres: Vec<[f32; 3]> = (0..3000u32)
        .map(|i| {
            [17u32, 29, 41].map(|p| (i.wrapping_mul(p * 2_654_435) % 1000) as f32 / 500.0 - 1.0)
        })
        .collect();
    let values: Vec<f32> = (0..3000).map(|i| i as f32 / 3000.0).collect();
    let quads = [Quad {
        corner: [-1.0, 0.0, -1.0],
        edges: [[2.0, 0.1, 0.0], [0.0, 0.0, 2.0]],
    }];
    let scene = Scene3 {
        centres: &centres,
        radii: Radii::Same(0.05),
        values: &values,
        quads: &quads,
        segments: &[],
        faces: &[],
    };
    let view = View {
        width: 400,
        height: 300,
        label: "speed (m/s)",
        time: "t = 1.00 s",
        ..View::default()
    };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| scene.draw(&Camera::oblique(LOW, HIGH), &view))
    };
    assert!(with(1) == with(3));
}

#[test]
fn time_and_colour_bar_are_written_and_keep_off_the_grains() {
    let scene = Scene3 {
        centres: &[[0.0; 3]],
        radii: Radii::Same(1.0),
        values: &[0.0],
        ..Scene3::default()
    };
    let plain = View {
        width: 400,
        height: 300,
        ..View::default()
    };
    let worded = View {
        label: "speed (m/s)",
        time: "t = 1.00 s",
        ..plain
    };
    let camera = Camera::front(LOW, HIGH);
    let image = scene.draw(&camera, &worded);
    let inked = |x: std::ops::Range<usize>, y: std::ops::Range<usize>| {
        x.flat_map(|x| y.clone().map(move |y| (x, y)))
            .any(|(x, y)| image.pixel(x, y).is_some_and(|p| p[0] < 90))
    };
    assert!(inked(14..100, 8..34), "no time");
    assert!(inked(280..400, 8..34), "no label");
    assert!(scene.draw(&camera, &plain).pixel(395, 150) == Some(PAPER));
}

fn nasty() -> impl Strategy<Value = f32> {
    prop_oneof![
        Just(0.0),
        Just(f32::NAN),
        Just(f32::INFINITY),
        Just(f32::NEG_INFINITY),
        Just(f32::MAX),
        Just(1e-40),
        any::<f32>(),
        -2.0f32..2.0,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]
    #[test]
    fn no_number_panics(
        points in prop::collection::vec([nasty(), nasty(), nasty()], 4..9),
        radii in prop::collection::vec(nasty(), 0..9),
        values in prop::collection::vec(nasty(), 0..9),
        range in (nasty(), nasty()),
        width in 0usize..300, height in 0usize..200,
    ) {
        let quads = [Quad { corner: points[0], edges: [points[1], points[2]] }];
        let segments = [Segment { from: points[0], to: points[3] }];
        let scene = Scene3 {
            centres: &points, radii: Radii::Each(&radii), values: &values, quads: &quads, segments: &segments, faces: &[],
        };
        let (low, high) = scene.bounds();
        let view = View { width, height, range, label: "l", time: "t" };
        for camera in [Camera::oblique(low, high), Camera { look: points[0], up: points[1], low: points[2], high: points[3] }] {
            let image = scene.draw(&camera, &view);
            prop_assert_eq!(image.pixels.len(), 3 * width.max(1) * height.max(1));
        }
    }
}

#[test]
fn a_triangle_hides_what_is_behind_it_and_not_what_is_before() {
    let look = |face_at: f32| {
        let face = [
            [-3.0, face_at, -3.0],
            [3.0, face_at, -3.0],
            [0.0, face_at, 4.0],
        ];
        let scene = Scene3 {
            centres: &[[0.0; 3]],
            radii: Radii::Same(0.5),
            values: &[1.0],
            faces: &[face],
            ..Scene3::default()
        };
        let camera = Camera::front([-3.0; 3], [3.0; 3]);
        let view = View {
            width: 121,
            height: 121,
            ..View::default()
        };
        let image = scene.draw(&camera, &view);
        (image.pixel(60, 60), image.pixel(45, 75), image.pixel(3, 3))
    };
    // The viewer looks along +y: a face at -1 lies before the grain.
    let (middle, beside, corner) = look(-1.0);
    assert_eq!(
        middle, beside,
        "the face is of one colour and hides the grain"
    );
    assert_ne!(beside, corner);
    let (middle, beside, _) = look(1.0);
    assert_eq!(middle, Some(crate::colour::of_share(1.0)));
    assert_ne!(middle, beside);
}
