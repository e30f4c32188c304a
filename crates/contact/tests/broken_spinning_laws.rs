//! The conformance suite for grains that turn is tested too: springs broken on purpose, each caught by the right check.

use tsubu_contact::testing::{Check, Claims, breaches_spinning};
use tsubu_contact::{Normal, Slip, SpringDashpot, SpringDashpotPair, Stretch, Tension};
use tsubu_model::{
    Constants, ContactLaw, Dim, Kind, Linear, Plane, Push, Quantity, Space, Spins, Touch, Vector,
};

/// One thing wrong with a law that is otherwise [`SpringDashpot`].
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    /// The torque turns the grains the wrong way.
    TwistReversed,
    /// The torque has an arm of half the radius.
    TwistHalved,
    /// The spin enters the slip with the wrong sign.
    SpinReversed,
    /// The slip is that of the centres: a grain that rolls is braked.
    SpinForgotten,
    /// The last bit of what is remembered depends on which grain is asked.
    MemoryNotEven,
    /// The tangential spring is remembered as a vector, which turns round with n.
    MemoryOfOneSide,
    /// A contact that has ended leaves its stretch behind.
    MemoryKept,
    /// The stretch does not turn with the contact: a part along n stays in it.
    NotProjected,
    /// The force is limited and the spring is not: it is stretched on while it slides.
    StretchedWithoutLimit,
    /// Friction 0.1 % above the limit.
    FrictionOverTheLimit,
    /// The stored energy forgets the tangential spring.
    StretchForgotten,
    /// The tangential spring is a fifth stiffer than it says.
    StifferThanSaid,
    /// The springs are counted with a step 1 % too long.
    LongStep,
    /// The tangential dashpot pushes along with the slip.
    DashpotDrives,
    /// Friction pulls a little to one hand.
    Handed,
    /// The slip gets the factor 1 + |v|/(1 m/s).
    StraySpeed,
}

#[derive(Clone, Copy, Debug)]
struct Broken {
    springs: SpringDashpot,
    fault: Fault,
}

/// A sign that changes with the direction of n.
fn side<D: Dim>(n: D::V) -> f64 {
    if n.axis(0) > 0.0 { 1.0 } else { -1.0 }
}

impl<D: Dim> ContactLaw<D, Spins> for Broken {
    type Pair = (SpringDashpotPair, Fault);
    type Memory = Stretch<D>;

    fn pair(&self, a: &Kind, b: &Kind) -> Self::Pair {
        let pair = <SpringDashpot as ContactLaw<D, Spins>>::pair(&self.springs, a, b);
        (pair, self.fault)
    }

    fn range((pair, _): &Self::Pair) -> f64 {
        pair.range
    }

    fn force(
        (pair, fault): &Self::Pair,
        touch: &Touch<D, Spins>,
        memory: &mut Stretch<D>,
        dt: f64,
    ) -> Push<D, Spins> {
        let (mut pair, mut touch, mut dt) = (*pair, *touch, dt);
        let (n, inside) = (touch.normal(), touch.r() < pair.range);
        let before = *memory;
        match fault {
            Fault::SpinReversed => touch.spin = -touch.spin,
            Fault::SpinForgotten => touch.spin = D::W::ZERO,
            Fault::MemoryOfOneSide => memory.tangential = memory.tangential * side::<D>(n),
            Fault::StifferThanSaid => pair.tangential_stiffness *= 1.2,
            Fault::LongStep => dt *= 1.01,
            Fault::StraySpeed => {
                touch.velocity = touch.velocity * (1.0 + touch.velocity.length());
            }
            _ => {}
        }
        let mut push = <SpringDashpot as ContactLaw<D, Spins>>::force(&pair, &touch, memory, dt);
        match fault {
            Fault::TwistReversed => push.twist = -push.twist,
            Fault::TwistHalved => push.twist = push.twist * 0.5,
            Fault::MemoryNotEven if side::<D>(n) > 0.0 => memory.normal *= 1.0 + f64::EPSILON,
            Fault::MemoryOfOneSide => memory.tangential = memory.tangential * side::<D>(n),
            Fault::MemoryKept if !inside => *memory = before,
            Fault::NotProjected if inside => {
                let along = before.tangential - D::across(before.tangential, n);
                memory.tangential += along;
                push.twist = push.twist - along;
            }
            Fault::StretchedWithoutLimit if inside => {
                let slip = D::moment(n, touch.velocity) - D::across(touch.spin, n);
                memory.tangential =
                    D::across(before.tangential, n) - slip * (pair.tangential_stiffness * dt);
            }
            Fault::FrictionOverTheLimit if push.slip != D::V::ZERO => {
                push.slip = push.slip * 1.001;
                push.twist = push.twist * 1.001;
            }
            Fault::DashpotDrives => {
                let drag = push.viscous - n * push.viscous.dot(n);
                push.viscous = push.viscous - drag * 2.0;
                push.twist += D::moment(n, drag) * 2.0;
            }
            Fault::Handed => {
                let size = 0.01 * push.twist.length();
                let more = D::across(D::W::from_axes(|_| size), n);
                push.elastic += D::turned(more, n);
                push.twist = push.twist - more;
            }
            _ => {}
        }
        push
    }

    fn stored((pair, fault): &Self::Pair, touch: &Touch<D, Spins>, memory: &Stretch<D>) -> f64 {
        let mut memory = *memory;
        if *fault == Fault::StretchForgotten {
            memory.tangential = D::W::ZERO;
        }
        <SpringDashpot as ContactLaw<D, Spins>>::stored(pair, touch, &memory)
    }

    fn linear((pair, _): &Self::Pair, touch: &Touch<D, Spins>, dt: f64) -> Linear {
        <SpringDashpot as ContactLaw<D, Spins>>::linear(pair, touch, dt)
    }
}

impl Constants for Broken {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        self.springs.constants()
    }

    fn mapped(&self, f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            springs: self.springs.mapped(f),
            ..*self
        }
    }
}

fn sand() -> Kind {
    Kind::sphere(0.5e-3, 2650.0)
}

fn springs() -> SpringDashpot {
    SpringDashpot::from_restitution(0.25, 0.9, 0.5 * sand().mass, 0.3, 0.577)
}

fn promised() -> Claims {
    Claims::default().friction(0.577).never_pulls()
}

/// The checks that a law fails for two equal grains.
fn failed<D: Dim, L: ContactLaw<D, Spins> + Constants>(law: &L, claims: Claims) -> Vec<Check> {
    breaches_spinning::<D, L>(law, &sand(), &sand(), claims)
        .iter()
        .map(|breach| breach.check)
        .collect()
}

/// In space, in the plane.
fn failed_in_both(fault: Fault) -> [Vec<Check>; 2] {
    // The normal spring must be counted for the step to matter.
    let springs = if fault == Fault::LongStep {
        springs().normal(Normal::Incremental)
    } else {
        springs()
    };
    let law = Broken { springs, fault };
    [
        failed::<Space, _>(&law, promised()),
        failed::<Plane, _>(&law, promised()),
    ]
}

/// Faults of one kind fail one check and no other, in space and in the plane.
#[test]
fn a_single_fault_is_named() {
    let expected = [
        (Fault::MemoryNotEven, Check::Odd),
        (Fault::MemoryKept, Check::Range),
        (Fault::StretchedWithoutLimit, Check::Stretch),
        (Fault::FrictionOverTheLimit, Check::Coulomb),
        (Fault::StretchForgotten, Check::Potential),
    ];
    for (fault, check) in expected {
        for failed in failed_in_both(fault) {
            assert_eq!(failed, [check], "{fault:?}");
        }
    }
}

/// Faults that break several laws at once fail all the checks that ask about them.
#[test]
fn a_fault_with_consequences_is_named_with_them() {
    let expected: [(Fault, &[Check]); 10] = [
        (
            Fault::TwistReversed,
            &[Check::Twist, Check::Collision, Check::Momentum],
        ),
        (
            Fault::TwistHalved,
            &[Check::Twist, Check::Collision, Check::Momentum],
        ),
        (
            Fault::SpinReversed,
            &[Check::Rolling, Check::Dashpot, Check::Linear, Check::Loop],
        ),
        (Fault::SpinForgotten, &[Check::Rolling, Check::Dashpot]),
        // Where n crosses the plane in which the sign changes the stretch jumps.
        (Fault::MemoryOfOneSide, &[Check::Odd, Check::Turning]),
        (Fault::StifferThanSaid, &[Check::Linear, Check::Potential]),
        (Fault::LongStep, &[Check::Linear, Check::Potential]),
        (
            Fault::DashpotDrives,
            &[Check::Dashpot, Check::Linear, Check::Collision],
        ),
        (Fault::Handed, &[Check::Turning]),
        (Fault::StraySpeed, &[Check::Units]),
    ];
    for (fault, checks) in expected {
        for failed in failed_in_both(fault) {
            assert!(
                checks.iter().all(|check| failed.contains(check)),
                "{fault:?}: {failed:?}"
            );
        }
    }
}

/// In the plane a stretch has nowhere to go and the fault is none; in space it leaves a torque about n.
#[test]
fn a_stretch_that_is_not_projected_is_named_in_space() {
    let [space, plane] = failed_in_both(Fault::NotProjected);
    assert_eq!(space, [Check::Twist, Check::Momentum]);
    assert_eq!(plane, []);
}

/// What a reading does not keep must not be promised of it.
#[test]
fn false_promises_are_named() {
    let printed = springs().slip(Slip::AsPrinted);
    assert_eq!(failed::<Plane, _>(&printed, promised()), [Check::Coulomb]);
    let printed = springs().tension(Tension::AsPrinted);
    assert_eq!(failed::<Plane, _>(&printed, promised()), [Check::Tension]);
    let unclaimed = Claims::default().never_pulls();
    assert_eq!(failed::<Space, _>(&springs(), unclaimed), [Check::Coulomb]);
}

/// The report names the state with its spin, and the numbers.
#[test]
fn the_report_says_what_where_and_how_much() {
    let law = Broken {
        springs: springs(),
        fault: Fault::TwistHalved,
    };
    let found = breaches_spinning::<Plane, _>(&law, &sand(), &sand(), promised());
    let report = found[0].to_string();
    for part in [
        "Twist: twist = −n × force",
        "at overlap",
        "r_a ω_a + r_b ω_b",
        "times the tolerance",
    ] {
        assert!(report.contains(part), "{part} is missing in: {report}");
    }
}
