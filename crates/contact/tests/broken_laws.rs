//! The conformance suite is tested too: laws broken on purpose, each caught by the right check.

use tsubu_contact::testing::{Check, Claims, breaches, collide, conforms, rebounds_with};
use tsubu_contact::{Repulsion, RepulsiveWall, RepulsiveWallPair};
use tsubu_model::{
    Constants, ContactLaw, Dim, Kind, Linear, Numbers, Push, Quantity, Space, SpinState, Still,
    Touch, Vector,
};

/// One thing wrong with a law that is otherwise [`RepulsiveWall`].
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    /// γ = 2ζ m k: a root forgotten. In SI the number is even plausible (3.4 kg/s for 1.3).
    StrayRoot,
    /// The force times (distance/1 m)^½: a length to the wrong power.
    StrayLength,
    /// `mapped` forgets that friction and damping belong to the list.
    ForgottenConstant,
    /// The last bit depends on which grain is asked.
    NotOddInTheLastBit,
    /// Friction 0.1 % above the limit.
    FrictionOverTheLimit,
    /// The dashpot is not clamped and pulls.
    PullKept,
    /// The stored energy is 0.01 % off.
    PotentialOff,
    /// A constant cohesion that begins with a jump.
    Jump,
    /// The Lennard-Jones tail is not cut.
    TailKept,
    /// A formula that overflows at the far-away dummy and multiplies infinity by zero.
    NanFarAway,
    /// The dashpot pushes along with the motion.
    DashpotDrives,
    /// The laboratory's x axis is special.
    SpecialAxis,
    /// `linear` reports the stiffness at the range instead of the slope at this overlap.
    StiffnessOfFirstTouch,
    /// Parting grains push harder than approaching ones (told apart by memory).
    UnloadsHarder,
}

#[derive(Clone, Copy, Debug)]
struct Broken {
    wall: RepulsiveWall,
    fault: Fault,
}

impl<D: Dim, S: SpinState> ContactLaw<D, S> for Broken {
    type Pair = (RepulsiveWallPair, Fault);
    /// The distance at the step before, 0 if none.
    type Memory = [f64; 1];

    fn pair(&self, a: &Kind, b: &Kind) -> Self::Pair {
        let mut pair = <RepulsiveWall as ContactLaw<D, S>>::pair(&self.wall, a, b);
        if self.fault == Fault::StrayRoot {
            pair.damping *= pair.damping / 0.5;
        }
        (pair, self.fault)
    }

    fn range((pair, _): &Self::Pair) -> f64 {
        <RepulsiveWall as ContactLaw<D, S>>::range(pair)
    }

    fn force(
        (pair, fault): &Self::Pair,
        touch: &Touch<D, S>,
        memory: &mut [f64; 1],
        dt: f64,
    ) -> Push<D, S> {
        let mut push = <RepulsiveWall as ContactLaw<D, S>>::force(pair, touch, &mut [], dt);
        let inside = if touch.r2 < pair.repulsion.range2 {
            1.0
        } else {
            0.0
        };
        let r = touch.r();
        match fault {
            Fault::StrayRoot
            | Fault::ForgottenConstant
            | Fault::PotentialOff
            | Fault::StiffnessOfFirstTouch => {}
            Fault::StrayLength => push.elastic = push.elastic * r.sqrt(),
            Fault::NotOddInTheLastBit if touch.apart.axis(0) > 0.0 => {
                push.elastic = push.elastic * (1.0 + f64::EPSILON)
            }
            Fault::NotOddInTheLastBit => {}
            Fault::FrictionOverTheLimit => push.slip = push.slip * 1.001,
            Fault::PullKept => {
                let n = touch.normal();
                push.viscous = n * (-pair.damping * touch.velocity.dot(n) * inside);
            }
            Fault::Jump => {
                push.elastic += touch.normal() * (-1e-3 * inside * pair.repulsion.epsilon24 / r)
            }
            Fault::TailKept => {
                let s6 = (pair.repulsion.sigma2 / touch.r2).powi(3);
                push.elastic =
                    touch.apart * (pair.repulsion.epsilon24 / touch.r2 * s6 * (2.0 * s6 - 1.0));
            }
            Fault::NanFarAway => {
                push.elastic = push.elastic * (touch.r2.powi(6) / touch.r2.powi(6))
            }
            Fault::DashpotDrives => push.viscous = -push.viscous,
            Fault::SpecialAxis => {
                let viscous = push.viscous;
                push.viscous =
                    D::V::from_axes(|a| viscous.axis(a) * if a == 0 { 1.01 } else { 1.0 });
            }
            Fault::UnloadsHarder => {
                let parting = memory[0] != 0.0 && r > memory[0];
                push.elastic = push.elastic * if parting { 1.01 } else { 1.0 };
                memory[0] = r;
            }
        }
        // What is over is forgotten.
        memory[0] *= inside;
        push
    }

    fn stored((pair, fault): &Self::Pair, touch: &Touch<D, S>, _memory: &[f64; 1]) -> f64 {
        let factor = if *fault == Fault::PotentialOff {
            1.0001
        } else {
            1.0
        };
        factor * <RepulsiveWall as ContactLaw<D, S>>::stored(pair, touch, &[])
    }

    fn linear((pair, fault): &Self::Pair, touch: &Touch<D, S>, dt: f64) -> Linear {
        let mut linear = <RepulsiveWall as ContactLaw<D, S>>::linear(pair, touch, dt);
        if *fault == Fault::FrictionOverTheLimit {
            linear.tangential_damping *= 1.001;
        }
        if *fault == Fault::StiffnessOfFirstTouch && linear.normal_stiffness > 0.0 {
            // φ''(r_c) = 72·2^(−1/3) ε/σ², independent of the overlap.
            linear.normal_stiffness =
                57.146_437_9 * pair.repulsion.epsilon24 / 24.0 / pair.repulsion.sigma2;
        }
        linear
    }
}

impl Constants for Broken {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        self.wall.constants()
    }

    fn mapped(&self, f: impl FnMut(Quantity, f64) -> f64) -> Self {
        let mut wall = self.wall.mapped(f);
        if self.fault == Fault::ForgottenConstant {
            wall.grains.epsilon = self.wall.grains.epsilon;
        }
        Self { wall, ..*self }
    }
}

fn broken(fault: Fault) -> Broken {
    let grains = Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3);
    // One per cent of hysteresis would drown in the dashpot of e = 0.5.
    let restitution = if fault == Fault::UnloadsHarder {
        None
    } else {
        Some(0.5)
    };
    Broken {
        wall: RepulsiveWall {
            grains,
            restitution,
            friction: 0.413,
        },
        fault,
    }
}

fn failed(fault: Fault) -> Vec<Check> {
    let claims = Claims::default().friction(0.413).never_pulls();
    let grain = Kind::sphere(1.350e-3, 1370.0);
    breaches::<Space, _>(&broken(fault), &grain, &Kind::immovable(), claims)
        .iter()
        .map(|b| b.check)
        .collect()
}

/// Faults of one kind fail one check and no other: the suite says what is wrong, not just that it is.
#[test]
fn a_single_fault_is_named() {
    let expected = [
        (Fault::StrayRoot, Check::Units),
        (Fault::ForgottenConstant, Check::Units),
        (Fault::NotOddInTheLastBit, Check::Odd),
        (Fault::FrictionOverTheLimit, Check::Coulomb),
        (Fault::PotentialOff, Check::Potential),
        (Fault::StiffnessOfFirstTouch, Check::Linear),
    ];
    for (fault, check) in expected {
        assert_eq!(failed(fault), [check], "{fault:?}");
    }
}

/// Faults that break several laws at once fail all the checks that ask about them.
#[test]
fn a_fault_with_consequences_is_named_with_them() {
    let expected: [(Fault, &[Check]); 8] = [
        // Slope and potential stay those of the unscaled force.
        (
            Fault::StrayLength,
            &[Check::Potential, Check::Linear, Check::Units],
        ),
        // Where the clamp makes the two parts cancel, one per cent more of one of them pulls.
        (Fault::SpecialAxis, &[Check::Turning, Check::Tension]),
        (Fault::PullKept, &[Check::Tension]),
        (Fault::Jump, &[Check::Rest, Check::Potential]),
        (Fault::TailKept, &[Check::Range]),
        (Fault::NanFarAway, &[Check::Range]),
        (Fault::DashpotDrives, &[Check::Dashpot, Check::Collision]),
        // Only paths can tell: every single state is right.
        (Fault::UnloadsHarder, &[Check::Loop, Check::Collision]),
    ];
    for (fault, checks) in expected {
        let failed = failed(fault);
        assert!(
            checks.iter().all(|check| failed.contains(check)),
            "{fault:?}: {failed:?}"
        );
    }
}

/// With the pull kept a contact ends at zero overlap, and ζ of the force-free end (0.255276 for 0.5)
/// gives exp(−πζ/√(1−ζ²)) = 0.43629, not 0.5. The collision's own step costs ζπ/20000 = 4e-5 of it.
#[test]
#[should_panic(expected = "restitution 0.5 asked for")]
fn a_kept_pull_spoils_the_restitution() {
    let grain = Kind::sphere(1.350e-3, 1370.0);
    let slow = collide::<Space, _>(&broken(Fault::PullKept), &grain, &Kind::immovable(), 0.01);
    let restitution = slow.map_or(f64::NAN, |rebound| rebound.restitution);
    assert!((restitution - 0.43629).abs() < 5e-5, "got {restitution}");
    rebounds_with::<Space, _>(
        &broken(Fault::PullKept),
        &grain,
        &Kind::immovable(),
        0.5,
        0.012,
    );
}

/// The report names check, state and numbers, and the unit that the formula treats worst
/// (γ² for γ is wrong by one power of mass and one of 1/time; the factor on time is the larger).
#[test]
fn the_report_says_what_where_and_how_much() {
    let claims = Claims::default().friction(0.413);
    let grain = Kind::sphere(1.350e-3, 1370.0);
    let found = breaches::<Space, _>(
        &broken(Fault::StrayRoot),
        &grain,
        &Kind::immovable(),
        claims,
    );
    let report = found[0].to_string();
    for part in [
        "Units: the same force in any units",
        "time × 1/7.3",
        "in SI",
        "at overlap",
        "times the tolerance",
    ] {
        assert!(report.contains(part), "{part} is missing in: {report}");
    }
}

#[test]
#[should_panic(expected = "slip force")]
fn friction_must_be_claimed() {
    let grain = Kind::sphere(1.350e-3, 1370.0);
    conforms(
        &broken(Fault::StrayRoot).wall,
        &grain,
        &Kind::immovable(),
        Claims::default(),
    );
}

/// A law whose range is no number is refused before any other check.
#[test]
fn a_law_without_scales_is_refused() {
    let law = Repulsion::new(f64::NAN, 1.203e-3, 0.1, 0.1, 1.350e-3);
    let grain = Kind::sphere(1.350e-3, 1370.0);
    let found = breaches::<Space, _>(&law, &grain, &grain, Claims::default());
    assert_eq!(
        found.iter().map(|b| b.check).collect::<Vec<_>>(),
        [Check::Scales]
    );
    assert_eq!(
        <<Repulsion as ContactLaw<Space, Still>>::Memory as Numbers>::N,
        0,
        "the exemplar remembers nothing"
    );
}
