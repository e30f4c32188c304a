//! Real laws and real collisions under each rule: what the table of the crate page promises, measured.

use tsubu_coarsen::{
    CoarseRule, Level, NotARestitution, RadlRestitution, Renormalised, SakaiKoshizuka, coarsen,
};
use tsubu_contact::testing::{Claims, collide, conforms};
use tsubu_contact::{Repulsion, RepulsiveWall, restitution};
use tsubu_model::{ContactLaw, Kind, Quantity, Space, Still};

fn coke() -> Repulsion {
    Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3)
}

fn grain() -> Kind {
    Kind::sphere(1.350e-3, 1370.0)
}

/// e of a pair of coke by the linear spring's relation: 0.8967 (theory note, section 7b).
fn coke_restitution() -> f64 {
    restitution::at_zero_overlap(coke().damping_ratio(0.5 * grain().mass))
}

fn radl(e: f64) -> RadlRestitution {
    RadlRestitution::new(e).expect("a restitution in (0, 1]")
}

/// Relative difference.
fn off(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// Paper A's coke at n = 3: numbers of the theory note, section 2.3, to the digits printed there.
#[test]
fn coke_at_level_three_has_the_printed_numbers() {
    let level = Level::new(3);
    let grain = coarsen(&Renormalised, &grain(), level).unwrap();
    let law = coarsen(&Renormalised, &coke(), level).unwrap();
    assert!(off(grain.diameter(), 10.8e-3) < 1e-12);
    assert!(
        (law.normal_damping - 8.05).abs() < 0.006,
        "{}",
        law.normal_damping
    );
    assert!((Renormalised.step_factor(level.lambda()) * 1.53e-7 - 1.22e-6).abs() < 6e-9);
    // The law still belongs to grains of its own size: nothing is scaled twice when pairs are mixed.
    assert_eq!(law.diameter, grain.diameter());
}

/// A head-on collision of two coarse grains: restitution, duration, deepest overlap.
fn coarse_collision(rule: &dyn CoarseRule, n: u32, speed: f64) -> [f64; 3] {
    let level = Level::new(n);
    let law = coarsen(rule, &coke(), level).unwrap();
    let kind = coarsen(rule, &grain(), level).unwrap();
    let range = 2f64.powf(1.0 / 6.0) * law.sigma;
    let rebound = collide::<Space, _>(&law, &kind, &kind, speed).unwrap();
    [
        rebound.restitution,
        rebound.duration,
        range - rebound.closest,
    ]
}

/// The coarse collision is the real one in scaled numbers, so only rounding (1e-9 of the overlap)
/// may differ, stiffening included: e × 1, duration × λ, overlap × λ.
#[test]
fn a_renormalised_pair_collides_similarly() {
    for speed in [0.1, 10.0] {
        let fine = coarse_collision(&Renormalised, 0, speed);
        for n in 1..=4 {
            let (coarse, lambda) = (
                coarse_collision(&Renormalised, n, speed),
                Level::new(n).lambda(),
            );
            for (i, factor) in [1.0, lambda, lambda].into_iter().enumerate() {
                assert!(
                    off(coarse[i], factor * fine[i]) < 1e-9,
                    "{n} {speed}: {coarse:?} {fine:?}"
                );
            }
        }
    }
}

/// e, duration and overlap in metres are kept, up to the stiffening that the overlap ratio brings: at
/// 0.1 m/s the duration is 1.6e-4 below the harmonic limit (theory note, section 4.4), and a coarse
/// grain comes nearer to that limit.
#[test]
fn a_sakai_koshizuka_pair_collides_at_the_same_pace() {
    let fine = coarse_collision(&SakaiKoshizuka, 0, 0.1);
    for n in 1..=4 {
        let coarse = coarse_collision(&SakaiKoshizuka, n, 0.1);
        assert!(
            (0..3).all(|i| off(coarse[i], fine[i]) < 2e-4),
            "{n}: {coarse:?} {fine:?}"
        );
    }
}

/// The coarse pair rebounds with e_c = √(1 + (e² − 1)λ) though only its damping was changed. e = 0.89677 is
/// the theory note's for 0.1 m/s (section 4.4); its last digit moves e_c by 4e-5, the collision's own
/// step by 4e-5 and stiffening by less: 2e-4.
#[test]
fn a_radl_pair_rebounds_with_the_corrected_restitution() {
    let rule = radl(coke_restitution());
    for (n, lambda) in [(1, 2.0), (2, 4.0)] {
        let e_c = (1.0 - lambda * (1.0 - 0.89677f64.powi(2))).sqrt();
        let [restitution, ..] = coarse_collision(&rule, n, 0.1);
        assert!(
            (restitution - e_c).abs() < 2e-4,
            "n = {n}: {restitution}, expected {e_c}"
        );
    }
}

/// 1/(1 − 0.8967²) = 5.10: λ = 4 is the last level. The error names what and how far.
#[test]
fn radl_is_refused_beyond_its_limit() {
    let error = coarsen(&radl(coke_restitution()), &coke(), Level::new(3)).unwrap_err();
    assert_eq!(
        (error.constant, error.largest()),
        ("normal_damping", Level::new(2))
    );
    let text = error.to_string();
    assert!(
        text.contains("λ must stay below 5.10") && text.contains("largest level is n = 2"),
        "{text}"
    );

    // A wall of e = 0.5 has no room at all (1/0.75 = 1.33): Radl's rule is for grains.
    let wall = RepulsiveWall {
        grains: coke(),
        restitution: Some(0.5),
        friction: 0.413,
    };
    let error = coarsen(&radl(1.0), &wall, Level::new(1)).unwrap_err();
    assert_eq!(
        (error.constant, error.largest()),
        ("restitution", Level::new(0))
    );

    for value in [0.0, -0.1, 1.01, f64::NAN] {
        assert!(
            matches!(RadlRestitution::new(value), Err(NotARestitution { .. })),
            "{value}"
        );
    }
}

/// Without loss there is nothing to correct, and the damping of zero stays zero.
#[test]
fn radl_leaves_elastic_grains_alone() {
    let law = coarsen(
        &radl(1.0),
        &Repulsion::new(9.434e-2, 1.203e-3, 0.0, 0.0, 1.350e-3),
        Level::new(6),
    )
    .unwrap();
    assert_eq!(law.normal_damping, 0.0);
    assert_eq!(radl(1.0).scale(Quantity::Restitution, 1.0, 64.0), 1.0);
}

/// A coarse law is a law: it passes the suite like the real one.
#[test]
fn coarse_laws_conform() {
    let level = Level::new(2);
    for rule in [
        &Renormalised as &dyn CoarseRule,
        &SakaiKoshizuka,
        &radl(coke_restitution()),
    ] {
        let kind = coarsen(rule, &grain(), level).unwrap();
        conforms(
            &coarsen(rule, &coke(), level).unwrap(),
            &kind,
            &kind,
            Claims::default(),
        );
    }
    let wall = RepulsiveWall {
        grains: coke(),
        restitution: Some(0.5),
        friction: 0.413,
    };
    let kind = coarsen(&Renormalised, &grain(), level).unwrap();
    let claims = Claims::default().friction(0.413).never_pulls();
    conforms(
        &coarsen(&Renormalised, &wall, level).unwrap(),
        &kind,
        &Kind::immovable(),
        claims,
    );
}

/// e and μ stay, so γw = 2ζ√(mk) grows as √(λ³ λ) = λ²: 64 × 1.3091 kg/s at n = 3, from
/// ζ = 0.255276 (force-free end, e = 0.5), m = 1.76490e-6 kg, k = 3.72524e6 N/m. Half a last digit is 0.0032.
#[test]
fn a_coarse_wall_keeps_its_restitution() {
    let wall = RepulsiveWall {
        grains: coke(),
        restitution: Some(0.5),
        friction: 0.413,
    };
    let (level, wall_kind) = (Level::new(3), Kind::immovable());
    let coarse = coarsen(&Renormalised, &wall, level).unwrap();
    assert_eq!((coarse.restitution, coarse.friction), (Some(0.5), 0.413));
    let kind = coarsen(&Renormalised, &grain(), level).unwrap();
    let pair = <RepulsiveWall as ContactLaw<Space, Still>>::pair(&coarse, &kind, &wall_kind);
    assert!(
        (pair.damping - 64.0 * 1.3091).abs() < 0.004,
        "{}",
        pair.damping
    );
}
