//! The conformance suite catches surfaces that are wrong on purpose, and names what is wrong.

use glam::DVec3;
use tsubu_model::{Hit, HitBuffer, Space, Surface};
use tsubu_sdf::testing::{Check, Options, Report, examine};
use tsubu_sdf::{Cavity, Cuboid};

/// A closed container with one fault.
struct Broken<F, B> {
    body: Cavity<Cuboid<Space>>,
    /// What is done to the hits of one query before they are handed out.
    spoil: F,
    /// What is done to the lower bound.
    bound: B,
}

impl<F, B> Surface<Space> for Broken<F, B>
where
    F: Fn(DVec3, f64, &mut HitBuffer<Space>) + Send + Sync,
    B: Fn(f64) -> f64 + Send + Sync,
{
    fn lower_bound(&self, x: DVec3) -> f64 {
        (self.bound)(self.body.lower_bound(x))
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            let mut one = HitBuffer::default();
            self.body.hits(&[x], &[reach], &mut one);
            (self.spoil)(x, reach, &mut one);
            for mut hit in one.hits {
                hit.of = of as u32;
                out.hits.push(hit);
            }
        }
    }

    fn outline(&self, _: DVec3, _: DVec3) -> Vec<[DVec3; 2]> {
        Vec::new()
    }
}

fn body() -> Cavity<Cuboid<Space>> {
    Cavity(Cuboid::new(DVec3::ZERO, DVec3::ONE).unwrap())
}

/// The suite's word on a container with this fault.
fn tried(
    spoil: impl Fn(DVec3, f64, &mut HitBuffer<Space>) + Send + Sync,
    bound: impl Fn(f64) -> f64 + Send + Sync,
) -> Report {
    let broken = Broken {
        body: body(),
        spoil,
        bound,
    };
    let inside = |x: DVec3| !(x.cmpgt(DVec3::ZERO).all() && x.cmplt(DVec3::ONE).all());
    let options = Options::default()
        .inside(&inside)
        .special([DVec3::splat(0.5), DVec3::ZERO])
        .expects(DVec3::splat(0.1), 0.2, 3);
    examine::<Space>(&broken, [DVec3::splat(-1.0), DVec3::splat(2.0)], &options)
}

#[test]
fn without_a_fault_the_container_passes() {
    let report = tried(|_, _, _| (), |b| b);
    assert!(report.breaches.is_empty(), "{report}");
}

#[test]
fn a_wrong_sign_is_caught() {
    let report = tried(
        |_, _, out| {
            for hit in &mut out.hits {
                (hit.distance, hit.normal) = (-hit.distance, -hit.normal);
            }
        },
        |b| -b,
    );
    assert!(report.fails(Check::Sign), "{report}");
}

#[test]
fn a_normal_that_points_elsewhere_is_caught() {
    let report = tried(
        |_, _, out| {
            for hit in &mut out.hits {
                hit.normal = (hit.normal + DVec3::new(0.0, 0.01, 0.0)).normalize();
            }
        },
        |b| b,
    );
    assert!(
        report.fails(Check::Gradient) && report.fails(Check::Foot),
        "{report}"
    );
}

#[test]
fn a_normal_that_is_not_of_length_one_is_caught() {
    let report = tried(
        |_, _, out| out.hits.iter_mut().for_each(|hit| hit.normal *= 1.001),
        |b| b,
    );
    assert!(report.fails(Check::Finite), "{report}");
}

#[test]
fn a_hit_that_small_grains_miss_is_caught() {
    let report = tried(
        |_, reach, out| {
            if reach < 0.1 {
                out.hits.clear();
            }
        },
        |b| b,
    );
    assert!(report.fails(Check::Found), "{report}");
}

#[test]
fn a_corner_that_forgets_its_second_wall_is_caught() {
    let report = tried(|_, _, out| out.hits.truncate(1), |b| b);
    assert!(report.fails(Check::Expected), "{report}");
}

#[test]
fn a_face_that_is_not_there_on_one_side_is_caught_as_a_jump() {
    let report = tried(
        |x, _, out| {
            if x.x < 0.5 {
                out.hits.retain(|hit| hit.feature != 4);
            }
        },
        |b| b,
    );
    assert!(report.fails(Check::Lipschitz), "{report}");
}

#[test]
fn a_hit_beyond_the_reach_is_caught() {
    let report = tried(
        |x, reach, out| {
            out.hits.clear();
            body().hits(&[x], &[reach * 1.1], out);
        },
        |b| b,
    );
    assert!(report.fails(Check::Reach), "{report}");
}

#[test]
fn a_bound_above_the_distance_is_caught() {
    let report = tried(|_, _, _| (), |b| b + 1e-6);
    assert!(report.fails(Check::Bound), "{report}");
    // Room for a move follows from the bound, so a grain would sleep too long.
    let report = tried(|_, _, _| (), |b| b + 1e-3);
    assert!(report.fails(Check::Room), "{report}");
}

#[test]
fn a_distance_that_grows_too_fast_is_caught() {
    let report = tried(
        |_, _, out| out.hits.iter_mut().for_each(|hit| hit.distance *= 1.01),
        |b| b,
    );
    assert!(
        report.fails(Check::Lipschitz) && report.fails(Check::Foot),
        "{report}"
    );
}

#[test]
fn a_number_that_is_none_at_a_centre_is_caught() {
    let report = tried(
        |x, _, out| {
            if x == DVec3::splat(0.5) {
                out.hits.iter_mut().for_each(|hit| hit.normal *= f64::NAN);
            }
        },
        |b| b,
    );
    assert!(report.fails(Check::Finite), "{report}");
}

#[test]
fn a_shell_beside_the_surface_and_bounds_that_cut_it_are_caught() {
    struct Misdrawn(Cuboid<Space>, bool);
    impl Surface<Space> for Misdrawn {
        fn lower_bound(&self, x: DVec3) -> f64 {
            self.0.lower_bound(x)
        }
        fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
            self.0.hits(x, reach, out);
        }
        fn outline(&self, low: DVec3, high: DVec3) -> Vec<[DVec3; 2]> {
            self.0.outline(low, high)
        }
        fn bounds(&self) -> Option<[DVec3; 2]> {
            let short = if self.1 { 0.0 } else { 0.1 };
            self.0.bounds().map(|[low, high]| [low + short, high])
        }
        fn shell(&self) -> Option<tsubu_model::Shell> {
            let mut shell = self.0.shell()?;
            if self.1 {
                shell.vertices[3].x += 1e-3;
            }
            Some(shell)
        }
    }
    let region = [DVec3::splat(-1.0), DVec3::splat(2.0)];
    let block = Cuboid::new(DVec3::ZERO, DVec3::ONE).unwrap();
    for which in [false, true] {
        let report = examine::<Space>(&Misdrawn(block, which), region, &Options::default());
        assert!(report.fails(Check::Drawing), "{report}");
        assert_eq!(report.breaches.len(), 1);
    }
}

#[test]
fn points_of_a_batch_that_are_mixed_up_are_caught() {
    struct Swapped(Cavity<Cuboid<Space>>);
    impl Surface<Space> for Swapped {
        fn lower_bound(&self, x: DVec3) -> f64 {
            self.0.lower_bound(x)
        }
        fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
            let start = out.hits.len();
            self.0.hits(x, reach, out);
            for hit in &mut out.hits[start..] {
                hit.of = (x.len() as u32 - 1) - hit.of;
            }
        }
        fn outline(&self, _: DVec3, _: DVec3) -> Vec<[DVec3; 2]> {
            Vec::new()
        }
    }
    let region = [DVec3::splat(-1.0), DVec3::splat(2.0)];
    let report = examine::<Space>(&Swapped(body()), region, &Options::default());
    assert!(report.fails(Check::Batch), "{report}");
}

/// Two balls that overlap, with one fault in the hits of a query.
struct Balls<F>(F);

const BALLS: [DVec3; 2] = [DVec3::splat(0.3), DVec3::splat(0.6)];

impl<F: Fn(&mut Vec<Hit<Space>>) + Send + Sync> Surface<Space> for Balls<F> {
    fn lower_bound(&self, x: DVec3) -> f64 {
        let away = BALLS.map(|c| (x - c).length() - 0.4);
        away[0].min(away[1])
    }

    fn hits(&self, x: &[DVec3], reach: &[f64], out: &mut HitBuffer<Space>) {
        for (of, (&x, &reach)) in x.iter().zip(reach).enumerate() {
            let mut hits = Vec::new();
            for (feature, c) in (0u32..).zip(BALLS) {
                let distance = (x - c).length() - 0.4;
                if distance < reach {
                    hits.push(Hit {
                        of: of as u32,
                        distance,
                        normal: (x - c).normalize(),
                        feature,
                    });
                }
            }
            (self.0)(&mut hits);
            out.hits.extend(hits);
        }
    }

    fn outline(&self, _: DVec3, _: DVec3) -> Vec<[DVec3; 2]> {
        Vec::new()
    }
}

fn union(spoil: impl Fn(&mut Vec<Hit<Space>>) + Send + Sync) -> Report {
    let inside = |x: DVec3| BALLS.iter().any(|c| (x - *c).length() < 0.4);
    let options = Options::default().union().inside(&inside);
    examine::<Space>(
        &Balls(spoil),
        [DVec3::splat(-1.0), DVec3::splat(2.0)],
        &options,
    )
}

#[test]
fn a_union_passes_and_one_that_loses_the_part_it_is_in_is_caught() {
    let report = union(|_| ());
    assert!(report.breaches.is_empty(), "{report}");
    // Of several hits only the one whose surface is nearest: then the sign is wrong within the other.
    let report = union(|hits| {
        hits.sort_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
        hits.truncate(1);
    });
    assert!(
        report.fails(Check::Sign) && report.fails(Check::Lipschitz),
        "{report}"
    );
    // Normals of one part bent: its feet are off it.
    let report = union(|hits| {
        for hit in hits.iter_mut().filter(|h| h.feature == 1) {
            hit.normal = (hit.normal + DVec3::X * 0.01).normalize();
        }
    });
    assert!(report.fails(Check::Foot), "{report}");
}
