//! Limits of the step as built: the Δt between growth and decay is searched for in the engine and held
//! against the limit that the scheme claims.
//!
//! Contacts only push, so they are kept closed by a load: a grain or a column lies on a floor under
//! gravity, a pair is pressed together by a field that pulls its grains in opposite directions. The
//! overlap is 1e-6 d, the disturbance at most a hundredth of that, so the contact is linear. Growth is
//! looked for in the positions: in the mode that alternates from step to step the full-step velocity of
//! a leapfrog is zero.

use crate::validate::check::Tolerance;
use crate::validate::lab::{Lab, name};
use crate::validate::report::Report;
use crate::validate::wca::{Wca, coke, grain};
use glam::DVec3;
use tsubu_contact::restitution::at_zero_force;
use tsubu_integrate::{Packing, Scheme};
use tsubu_model::{Space, Still, View};
use tsubu_picture::Figure;

/// Overlap of a contact under one grain's weight, over its range.
const OVERLAP: f64 = 1e-6;
/// Steps in which growth must show.
const STEPS: u64 = 8000;

/// An arrangement under load.
#[derive(Clone, Copy, Debug)]
pub enum Arrangement {
    /// So many grains on a floor under gravity; one = a wall contact.
    Column(u32),
    /// Two grains pressed together.
    Pair,
}

impl Arrangement {
    /// What `integrate` knows of it.
    pub fn packing(self) -> Packing {
        match self {
            Arrangement::Column(1) => Packing::OneWallContact,
            Arrangement::Column(n) => Packing::Column(n),
            Arrangement::Pair => Packing::Pair,
        }
    }
}

/// A scheme on an arrangement whose contacts have damping ratio ζ on one grain's mass: C = 2ζ√K.
#[derive(Clone, Copy)]
pub struct Case {
    /// The scheme.
    pub scheme: Scheme,
    /// The arrangement.
    pub arrangement: Arrangement,
    /// ζ = γ/2√(km).
    pub zeta: f64,
}

impl Case {
    /// √(k/m) of one grain on a wall, in 1/s.
    pub fn frequency() -> f64 {
        (Wca::of(&coke(0.0)).edge_stiffness() / grain().mass).sqrt()
    }

    /// K = kΔt²/m and C = γΔt/m of one grain at this step; k at the overlap of the first contact.
    pub fn numbers(self, dt: f64) -> (f64, f64) {
        let wca = Wca::of(&coke(0.0));
        let load = OVERLAP * wca.range() * wca.edge_stiffness();
        let stiff = wca.stiffness(wca.at_rest_under(load)) / wca.edge_stiffness();
        let turn = Self::frequency() * dt;
        (stiff * turn * turn, 2.0 * self.zeta * turn)
    }

    /// The Δt at which the claimed limit is used up, by halving; `used` grows with Δt.
    /// None if there is no such step below 50 over the frequency.
    pub fn claimed(self, used: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let (mut low, mut high) = (1e-9 / Self::frequency(), 50.0 / Self::frequency());
        let (k, c) = self.numbers(high);
        if used(k, c) < 1.0 {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let (k, c) = self.numbers(middle);
            if used(k, c) < 1.0 {
                low = middle
            } else {
                high = middle
            }
        }
        Some(low)
    }

    /// True if a small disturbance grows to a hundredth of the overlap, about a thousandfold, at this step.
    pub fn grows(self, dt: f64) -> bool {
        let mass = grain().mass;
        let gamma = 2.0 * self.zeta * mass * Self::frequency();
        let law = coke(gamma);
        let wca = Wca::of(&law);
        let load = OVERLAP * wca.range() * wca.edge_stiffness();
        let overlap = OVERLAP * wca.range();
        let small = 1e-5 * overlap / dt.max(1.0 / Self::frequency());
        let sign = |j: u32| if j.is_multiple_of(2) { small } else { -small };
        let mut lab = Lab::new(grain(), law, self.scheme, dt);
        match self.arrangement {
            Arrangement::Column(n) => {
                let asked = (self.zeta > 0.0).then(|| at_zero_force(self.zeta));
                lab = lab.wall(DVec3::ZERO, DVec3::Z, asked, 0.0);
                lab.gravity = DVec3::Z * (-load / mass);
                let mut height = -grain().radius;
                for j in 0..n {
                    height += wca.at_rest_under(load * f64::from(n - j));
                    lab = lab.grain(DVec3::Z * height, DVec3::Z * sign(j));
                }
                moves(lab.world(), 1e-2 * overlap)
            }
            Arrangement::Pair => {
                let half = DVec3::X * (0.5 * wca.at_rest_under(load));
                lab = lab
                    .grain(-half, DVec3::X * sign(0))
                    .grain(half, DVec3::X * sign(1));
                lab.gravity = DVec3::X * (load / mass);
                moves(lab.pressed(), 1e-2 * overlap)
            }
        }
    }

    /// The largest Δt without growth, over `around`, by halving between 0.8 and 1.25 of it.
    pub fn found(self, around: f64) -> f64 {
        let (mut low, mut high) = (0.8, 1.25);
        if self.grows(low * around) || !self.grows(high * around) {
            return f64::NAN;
        }
        for _ in 0..11 {
            let middle = 0.5 * (low + high);
            if self.grows(middle * around) {
                high = middle
            } else {
                low = middle
            }
        }
        0.5 * (low + high)
    }
}

/// Anything that steps and can be looked at.
trait Steps: View<Space, Still> {
    fn go(&mut self, steps: u64);
}

impl Steps for crate::validate::lab::Dry {
    fn go(&mut self, steps: u64) {
        self.advance(steps);
    }
}

impl Steps for crate::validate::lab::Mixed {
    fn go(&mut self, steps: u64) {
        self.advance(steps);
    }
}

/// True if a grain leaves its place by more than `far`, looked at every few steps, odd and even ones.
fn moves(mut world: impl Steps, far: f64) -> bool {
    let start: Vec<_> = (0..world.len())
        .map(|i| (world.identity(i), world.position(i)))
        .collect();
    let home = |id: u32| start.iter().find(|s| s.0 == id).map_or(DVec3::NAN, |s| s.1);
    for _ in 0..STEPS / 9 {
        world.go(9);
        let furthest =
            (0..world.len()).map(|i| (world.position(i) - home(world.identity(i))).length());
        // Written so that NaN counts as growth.
        if !furthest.into_iter().all(|distance| distance <= far) {
            return true;
        }
    }
    false
}

/// The checks.
pub fn run(report: &mut Report) -> Result<(), String> {
    // Just above the limit the growth per step is 4ε/C: a thousandfold within 8000 steps for ε > 2e-4 C.
    let note =
        "1 % asked by the issue; the search resolves 0.02 % and growth shows above 0.02 % of C";
    let schemes = [
        Scheme::SymplecticEuler,
        Scheme::VerletOld,
        Scheme::VerletAveraged { sweeps: 4 },
        Scheme::DashpotImplicit { sweeps: 4 },
    ];
    let mut figure = Figure::new(
        "Limits of the step, one wall contact",
        "C = γΔt/m (–)",
        "K = kΔt²/m (–)",
    )
    .x_range(0.0, 11.0)
    .y_range(0.0, 26.0);
    for scheme in schemes {
        let mut at = (Vec::new(), Vec::new());
        for zeta in [0.0, 0.0347, 0.3, 1.0, 3.0] {
            let case = Case {
                scheme,
                arrangement: Arrangement::Column(1),
                zeta,
            };
            let dt = case
                .claimed(|k, c| scheme.limit().used(k, c))
                .unwrap_or(f64::NAN);
            let share = case.found(dt);
            let (k, c) = case.numbers(share * dt);
            at.0.push(c);
            at.1.push(k);
            let (k, c) = case.numbers(dt);
            let what = format!(
                "limit at a wall, {}, K = {k:.3}, C = {c:.3}: Δt found over claimed",
                name(scheme)
            );
            report.check(what, 1.0, share, Tolerance::Absolute(0.01), note);
        }
        figure = figure.points(&name(scheme), &at.0, &at.1, None);
    }
    let claimed = "claimed: K + 2C = 4, K = 4, K = 4 + 2C";
    figure = figure
        .theory(claimed, &[0.0, 2.0], &[4.0, 0.0])
        .theory(claimed, &[0.0, 11.0], &[4.0, 4.0])
        .theory(claimed, &[0.0, 11.0], &[4.0, 26.0]);
    for scheme in [Scheme::SymplecticEuler, Scheme::VerletOld] {
        for zeta in [0.0, 0.3, 1.0] {
            let case = Case {
                scheme,
                arrangement: Arrangement::Pair,
                zeta,
            };
            limit_of_packing(report, case, note);
        }
    }
    for n in 2..=8 {
        let zeta = 0.3;
        limit_of_packing(
            report,
            Case {
                scheme: Scheme::SymplecticEuler,
                arrangement: Arrangement::Column(n),
                zeta,
            },
            note,
        );
    }
    limit_of_packing(
        report,
        Case {
            scheme: Scheme::VerletOld,
            arrangement: Arrangement::Column(8),
            zeta: 0.3,
        },
        note,
    );
    report.figure("collision_limits", figure)
}

fn limit_of_packing(report: &mut Report, case: Case, note: &str) {
    let packing = case.arrangement.packing();
    let dt = case
        .claimed(|k, c| case.scheme.limit().used_by_packing(k, c, packing))
        .unwrap_or(f64::NAN);
    let (k, c) = case.numbers(dt);
    let what = format!(
        "limit of {:?}, {}, K = {k:.3}, C = {c:.3}: Δt found over claimed",
        case.arrangement,
        name(case.scheme)
    );
    report.check(what, 1.0, case.found(dt), Tolerance::Absolute(0.01), note);
}
