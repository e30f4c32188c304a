//! Every surface of the crate on the conformance suite: one line enrols one.

use glam::{DVec2, DVec3};
use tsubu_model::{Plane, Space, Surface};
use tsubu_sdf::testing::{Options, conforms};
use tsubu_sdf::{
    Ball, Cavity, Cone, Cuboid, Cylinder, GrainBody, GrainBodyOptions, HalfSpace, Hand, HollowCone,
    Mesh, Screw, ScrewSize, Torus, Tube,
};

/// A region around the unit box, so that points lie well inside and outside.
const REGION: [DVec3; 2] = [DVec3::splat(-1.0), DVec3::splat(2.0)];
const LEVEL: [DVec2; 2] = [DVec2::splat(-1.0), DVec2::splat(2.0)];

/// A surface in space that is exact at any reach, told who is inside.
#[track_caller]
fn exact(surface: &dyn Surface<Space>, inside: &dyn Fn(DVec3) -> bool, special: &[DVec3]) {
    let options = Options::default()
        .inside(inside)
        .special(special.iter().copied());
    conforms::<Space>(surface, REGION, &options);
}

/// Two points of an axis that lies along no coordinate.
fn axis() -> (DVec3, DVec3) {
    (DVec3::new(0.0, 0.2, 0.1), DVec3::new(0.9, 0.7, 0.8))
}

/// Along the axis as a share of it, and away from it.
fn about(x: DVec3) -> (f64, f64) {
    let (a, b) = axis();
    let share = (x - a).dot(b - a) / (b - a).length_squared();
    (share, (x - a - (b - a) * share).length())
}

/// Points on the axis and its ends.
fn on_axis() -> Vec<DVec3> {
    let (a, b) = axis();
    [-0.5, 0.0, 0.25, 0.5, 1.0, 1.3]
        .map(|s| a + (b - a) * s)
        .to_vec()
}

#[test]
fn half_space() {
    let wall = HalfSpace::<Space>::new(DVec3::splat(0.5), DVec3::new(1.0, 2.0, 3.0));
    exact(
        &wall,
        &|x| (x - 0.5).dot(DVec3::new(1.0, 2.0, 3.0)) < 0.0,
        &[],
    );
}

#[test]
fn ball() {
    let ball = Ball::<Space>::new(DVec3::splat(0.4), 0.5).unwrap();
    exact(&ball, &|x| (x - 0.4).length() < 0.5, &[DVec3::splat(0.4)]);
    exact(
        &Cavity(ball),
        &|x| (x - 0.4).length() > 0.5,
        &[DVec3::splat(0.4)],
    );
    let disc = Ball::<Plane>::new(DVec2::splat(0.4), 0.5).unwrap();
    let options = Options::default().special([DVec2::splat(0.4)]);
    conforms::<Plane>(&disc, LEVEL, &options);
}

#[test]
fn cuboid() {
    let (low, high) = (DVec3::ZERO, DVec3::new(1.0, 0.8, 0.6));
    let inside = |x: DVec3| x.cmpgt(low).all() && x.cmplt(high).all();
    let special = [
        low,
        high,
        0.5 * (low + high),
        DVec3::new(0.5, 0.0, 0.0),
        DVec3::X,
    ];
    let block = Cuboid::<Space>::new(low, high).unwrap();
    exact(&block, &inside, &special);
    exact(&Cavity(block), &|x| !inside(x), &special);
    let options = Options::default()
        .expects(DVec3::splat(0.1), 0.2, 3)
        .expects(DVec3::new(0.1, 0.4, 0.1), 0.2, 2)
        .expects(DVec3::splat(0.3), 0.31, 4);
    conforms::<Space>(&Cavity(block), REGION, &options);
    let rectangle = Cuboid::<Plane>::new(DVec2::ZERO, DVec2::new(1.0, 0.6)).unwrap();
    conforms::<Plane>(
        &rectangle,
        LEVEL,
        &Options::default().special([DVec2::ZERO, DVec2::X]),
    );
    let options = Options::default().expects(DVec2::splat(0.1), 0.2, 2);
    conforms::<Plane>(&Cavity(rectangle), LEVEL, &options);
}

#[test]
fn cylinder() {
    let (a, b) = axis();
    let bar = Cylinder::new(a, b, 0.3).unwrap();
    let inside = |x: DVec3| {
        let (share, away) = about(x);
        (0.0..=1.0).contains(&share) && away < 0.3
    };
    exact(&bar, &inside, &on_axis());
    exact(&Cavity(bar), &|x| !inside(x), &on_axis());
}

#[test]
fn tube() {
    let (a, b) = axis();
    let tube = Tube::new(a, b, 0.3, 0.4).unwrap();
    let wall = |x: DVec3| {
        let (share, away) = about(x);
        (0.0..=1.0).contains(&share) && away > 0.3 && away < 0.4
    };
    exact(&tube, &wall, &on_axis());
    let can = Tube::can(a, b, 0.3, 0.4, 0.1).unwrap();
    let plate = |x: DVec3| {
        let (share, away) = about(x);
        (1.0..=1.0 + 0.1 / (b - a).length()).contains(&share) && away < 0.4
    };
    exact(&can, &|x| wall(x) || plate(x), &on_axis());
}

#[test]
fn cone() {
    let (a, b) = axis();
    for (base, top) in [(0.4, 0.2), (0.0, 0.4), (0.4, 0.0)] {
        let inside = |x: DVec3| {
            let (share, away) = about(x);
            (0.0..=1.0).contains(&share) && away < base + (top - base) * share
        };
        let cone = Cone::frustum(a, b, base, top).unwrap();
        exact(&cone, &inside, &on_axis());
        exact(&Cavity(cone), &|x| !inside(x), &on_axis());
        let wide = 0.05 * (1.0 + (top - base) * (top - base) / (b - a).length_squared()).sqrt();
        let wall = |x: DVec3| {
            let (share, away) = about(x);
            let inner = base + (top - base) * share;
            (0.0..=1.0).contains(&share) && away > inner && away < inner + wide
        };
        let hollow = HollowCone::new(a, b, base, top, 0.05).unwrap();
        exact(&hollow, &wall, &on_axis());
    }
}

#[test]
fn torus() {
    let (a, b) = axis();
    let torus = Torus::new(a, b - a, 0.6, 0.2).unwrap();
    let inside = |x: DVec3| {
        let (share, away) = about(x);
        (away - 0.6).hypot(share * (b - a).length()) < 0.2
    };
    exact(&torus, &inside, &on_axis());
}

#[test]
fn screw() {
    for (size, hand) in [
        (
            ScrewSize {
                shaft: 0.0275,
                outer: 0.1025,
                pitch: 0.150,
                thickness: 0.006,
            },
            Hand::Right,
        ),
        (
            ScrewSize {
                shaft: 0.03,
                outer: 0.09,
                pitch: 0.25,
                thickness: 0.05,
            },
            Hand::Left,
        ),
    ] {
        let l = 0.45;
        let screw = Screw::new(DVec3::ZERO, DVec3::X * l, size, hand).unwrap();
        let inside = |x: DVec3| {
            let away = x.y.hypot(x.z);
            if away <= size.shaft && x.x >= 0.0 && x.x <= l {
                return true;
            }
            let turn = x.z.atan2(x.y) / std::f64::consts::TAU;
            let turn = if hand == Hand::Right { turn } else { -turn };
            // The middle of the flight at this azimuth, turn by turn.
            let middle = |k: i32| size.pitch * (turn + f64::from(k));
            let exists = |m: f64| m >= size.thickness && m <= l - size.thickness;
            away <= size.outer
                && (-2..6)
                    .any(|k| exists(middle(k)) && (x.x - middle(k)).abs() <= 0.5 * size.thickness)
        };
        let t = size.thickness;
        let special = [
            DVec3::ZERO,
            DVec3::X * 0.2,
            DVec3::X * l,
            DVec3::new(-0.1, 0.0, 0.0),
            // On the edges of rim and root, on a face, on the rim.
            DVec3::new(size.pitch + 0.5 * t, size.outer, 0.0),
            DVec3::new(size.pitch + 0.5 * t, size.shaft, 0.0),
            DVec3::new(size.pitch - 0.5 * t, 0.05, 0.0),
            DVec3::new(size.pitch, size.outer, 0.0),
        ];
        let region = [DVec3::new(-0.1, -0.15, -0.15), DVec3::new(0.55, 0.15, 0.15)];
        // In the corner of shaft and flight, a third of a thickness from each.
        let (high, near) = (size.shaft + 0.3 * t, size.pitch + 0.5 * t + 0.3 * t);
        let options = Options::default()
            .inside(&inside)
            .special(special)
            .samples(3000)
            .expects(DVec3::new(near, high, 0.0), 0.4 * t, 2);
        conforms::<Space>(&screw, region, &options);
    }
}

/// The body of grains that fills a surface.
fn of_grains(surface: &dyn Surface<Space>, radius: f64, reach: f64) -> GrainBody {
    let shell = surface.shell().unwrap();
    let mesh = Mesh::from(shell);
    GrainBody::build(&mesh, &GrainBodyOptions::new(radius, reach)).unwrap()
}

#[test]
fn bodies_of_grains() {
    // A block with few large grains, a plate with one layer that sticks out, and a screw.
    let block = Cuboid::<Space>::new(DVec3::ZERO, DVec3::new(1.0, 0.8, 0.6)).unwrap();
    let plate = Cuboid::<Space>::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.1)).unwrap();
    let size = ScrewSize {
        shaft: 0.15,
        outer: 0.5,
        pitch: 0.6,
        thickness: 0.1,
    };
    let screw = Screw::new(DVec3::ZERO, DVec3::X, size, Hand::Right).unwrap();
    for (surface, radius) in [
        (&block as &dyn Surface<Space>, 0.07),
        (&plate, 0.08),
        (&screw, 0.05),
    ] {
        // Grains that reach further than the cells do are found all the same.
        for reach in [0.05, 0.5] {
            let body = of_grains(surface, radius, reach);
            let inside = |x: DVec3| body.centres().iter().any(|c| (*c - x).length() < radius);
            let first = body.centres()[0];
            // The corners of the mesh are off the wall grains by what the lattice leaves free there.
            let options = Options::default()
                .union()
                .drawn_within(5.0 * radius)
                .inside(&inside)
                .special([first, first + DVec3::X * radius])
                .samples(600)
                .expects(first - DVec3::X * (1.5 * radius), 0.50001 * radius, 1)
                .expects(first, f64::INFINITY, body.count());
            conforms::<Space>(&body, REGION, &options);
        }
    }
}
