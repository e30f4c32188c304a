//! Paper B's law for grains that turn: springs, dashpots and Coulomb friction, with a memory of the contact.

mod pair;
mod stretch;

pub use pair::SpringDashpotPair;
pub use stretch::Stretch;

use crate::restitution;
use std::f64::consts::PI;
use tsubu_model::{Constants, Quantity};

/// Linear springs and dashpots along and across the normal, with Coulomb friction, for grains that spin.
///
/// ```text
/// δ = range − r,   v_n = v·n,   v_c = v + n × (r_i ω_i + r_j ω_j),   v_s = v_c − v_n n     while r < range, no force beyond
/// e_n = kn δ,                   d_n = −ηn v_n,     f_n = e_n + d_n along n
/// e_s ← e_s − ks v_s Δt,        d_s = −ηs v_s,     f_s = e_s + d_s across n, |f_s| limited by friction
/// F_i = f_n n + f_s,            torque on i = −r_i n × f_s,   on j = −r_j n × f_s
/// ```
///
/// | symbol | field | unit |
/// |---|---|---|
/// | kn, ks | `normal_stiffness`, `tangential_stiffness` | N/m |
/// | ηn, ηs | `normal_damping`, `tangential_damping` | kg/s |
/// | μ | `friction` | – |
///
/// n points from the partner to the grain, v is the relative velocity of the centres, v_c that of the
/// two surfaces at the contact. The range is the sum of the radii, or the grain's diameter against
/// `Kind::immovable()`: the wall is the grain's mirror, and one law serves grains and walls.
/// What is remembered is [`Stretch`]: e_n and, in axial form n × e_s, the tangential spring. As n turns
/// the spring turns with it, keeping its length. The springs hold e_n²/(2kn) + |e_s|²/(2ks).
///
/// Three readings are open, as values: [`Tension`], [`Slip`] and [`Normal`] say each exactly. The
/// defaults never pull and keep |f_s| ≤ μ f_n; the paper's own are the variants `AsPrinted` and
/// [`Normal::Incremental`]. In every reading |e_s| ≤ μ e_n, and work against the springs is all that
/// they can return. While a contact slides its whole tangential force counts as slip, what the spring
/// then takes up or gives back included.
///
/// **Units of the paper.** For Δt = 2.0e-4 s, d = 0.5 mm it prints kn = 2.54e2, ks = 9.78e1 N/m,
/// ηn = 4.58e-1, ηs = 2.84e-1 Ns/m: the values with mass in grams. In SI they are a thousandth:
///
/// ```
/// use std::f64::consts::PI;
/// use tsubu_contact::SpringDashpot;
/// let m = (2650.0 + 0.5 * 1000.0) * PI / 6.0 * 0.5e-3_f64.powi(3);    // kg, added mass C_M = 0.5 included
/// let sand = SpringDashpot::from_time_step(2.0e-4, m, 20.0, 1.0, 0.3, 0.577);
/// assert!((sand.normal_stiffness - 0.25435).abs() < 5e-6);            // N/m
/// assert!((sand.tangential_stiffness - 0.09783).abs() < 5e-6);        // N/m
/// assert!((sand.normal_damping - 4.580e-4).abs() < 5e-8);             // kg/s
/// assert!((sand.tangential_damping - 2.840e-4).abs() < 5e-8);         // kg/s
/// ```
///
/// What it is *not*: the stiffness is set by the step, not by a material, and is the same at any
/// overlap and for any two grains (for a mixture take the constants of the largest). There is no
/// resistance to rolling or to twisting about n, and a pair that turns about its own n leaves the
/// stretch behind. Lever arms are the radii: at an overlap δ a pair that turns as one body at Ω slips by
/// δΩ, and angular momentum is kept up to δ|f_s| per unit of time. Softness: at β = 15.8
/// ([`scaled_by`](Self::scaled_by), Δt = 2.0e-5 s) a grain of 0.5 mm sinks 2 % of d under its own weight
/// in water and 21 % under ten layers, which is no longer a packing of touching spheres.
///
/// Source: `Gotoh2001`, section 2; restitution `Schwager2007`.
///
/// ```
/// use tsubu_contact::SpringDashpot;
/// # let m = 3150.0 * std::f64::consts::PI / 6.0 * 0.5e-3_f64.powi(3);
/// let bed = SpringDashpot::from_time_step(2.0e-5, m, 20.0, 1.3, 0.3, 0.577).scaled_by(15.8);
/// let weight = (2650.0 - 1000.0) * std::f64::consts::PI / 6.0 * 0.5e-3_f64.powi(3) * 9.81;    // N, in water
/// assert!((weight / bed.normal_stiffness / 0.5e-3 - 0.0208).abs() < 1e-4);  // overlap over d
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDashpot {
    /// kn in N/m.
    pub normal_stiffness: f64,
    /// ks in N/m.
    pub tangential_stiffness: f64,
    /// ηn in kg/s.
    pub normal_damping: f64,
    /// ηs in kg/s.
    pub tangential_damping: f64,
    /// μ.
    pub friction: f64,
    /// When the normal force ends.
    pub tension: Tension,
    /// How friction limits the tangential force.
    pub slip: Slip,
    /// How the normal spring is counted.
    pub normal: Normal,
}

/// How [`SpringDashpot`] reads "no tension". In both, e_n < 0 (the incremental spring past its rest) is no force at all.
///
/// Source: `Gotoh2001`, section 2, whose words allow both.
///
/// ```
/// assert_eq!(tsubu_contact::Tension::default(), tsubu_contact::Tension::NoPull);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tension {
    /// f_n = max(e_n + d_n, 0); where that is 0 there is no tangential force and no stretch either. A
    /// collision ends at zero force: e = [`restitution::at_zero_force`]. What is cut counts as viscous.
    #[default]
    NoPull,
    /// Only e_n < 0 cuts, so f_n = e_n + d_n < 0 while the grains part: the dashpot pulls. A collision ends
    /// at zero overlap, e = [`restitution::at_zero_overlap`], and with ζ ≥ 1 never: the grains are glued.
    AsPrinted,
}

/// How friction limits the tangential force of [`SpringDashpot`]. In both the spring is limited first: |e_s| ≤ μ e_n.
///
/// Source: `AsPrinted` is `Gotoh2001`, section 2; `Total` is a choice.
///
/// ```
/// assert_eq!(tsubu_contact::Slip::default(), tsubu_contact::Slip::Total);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slip {
    /// |e_s + d_s| ≤ μ max(f_n, 0), f_n after the reading of the tension. Where that bites, both are
    /// multiplied by μ f_n/|e_s + d_s| and the spring keeps its share of the force as its stretch. So it never
    /// holds more than it gives, and small steps have a limit: in a steady slide
    /// |e_s| = max(μ f_n − |d_s|, 0). A slide that slows to rest hands over from dashpot to spring within ηs/ks.
    #[default]
    Total,
    /// Where |e_s| would exceed μ e_n, f_s = e_s with |e_s| = μ e_n, without a dashpot. Where it does not,
    /// f_s = e_s + d_s without a limit: |f_s| > μ f_n while the dashpot is large or the grains part.
    AsPrinted,
}

/// How [`SpringDashpot`] counts the normal spring.
///
/// Source: `Incremental` is `Gotoh2001`, section 2; `Closed` is its limit for small steps.
///
/// ```
/// assert_eq!(tsubu_contact::Normal::default(), tsubu_contact::Normal::Closed);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normal {
    /// e_n = kn δ.
    #[default]
    Closed,
    /// e_n ← e_n − kn v_n Δt, from e_n = −kn v_n Δt at the first step. It is ahead of kn δ by kn times what was left
    /// of the gap one step before the touch: at most kn |v_n| Δt, and of first order in the step.
    Incremental,
}

impl SpringDashpot {
    /// From kn, ks (N/m), ηn, ηs (kg/s) and μ, in the default readings.
    ///
    /// ```
    /// let law = tsubu_contact::SpringDashpot::new(1.0e3, 0.4e3, 0.1, 0.06, 0.5);
    /// assert!((law.damping_ratio(2.5e-6) - 1.0).abs() < 1e-12);      // ζ of a reduced mass of 2.5 mg: critical
    /// ```
    pub fn new(
        normal_stiffness: f64,
        tangential_stiffness: f64,
        normal_damping: f64,
        tangential_damping: f64,
        friction: f64,
    ) -> Self {
        Self {
            normal_stiffness,
            tangential_stiffness,
            normal_damping,
            tangential_damping,
            friction,
            tension: Tension::default(),
            slip: Slip::default(),
            normal: Normal::default(),
        }
    }

    /// From kn (N/m) and ηn (kg/s), the tangential ones by Poisson's ratio ν.
    ///
    /// ```text
    /// ks = kn/(2(1 + ν)),   ηs = ηn/√(2(1 + ν))
    /// ```
    ///
    /// Source: `Gotoh2001`, section 2.
    fn isotropic(normal_stiffness: f64, normal_damping: f64, poisson: f64, friction: f64) -> Self {
        let ratio = 2.0 * (1.0 + poisson);
        Self::new(
            normal_stiffness,
            normal_stiffness / ratio,
            normal_damping,
            normal_damping / ratio.sqrt(),
            friction,
        )
    }

    /// Constants that a step Δt (s) resolves, for grains of mass m (kg, added mass included).
    ///
    /// ```text
    /// kn = 2π² m/(αtn Δt)²,   ηn = αcn 2√(m kn),   ks = kn/(2(1 + ν)),   ηs = ηn/√(2(1 + ν))
    /// ```
    ///
    /// αtn steps go to the period 2π√(m/2kn) of a mass between two springs; αcn is ηn over the critical
    /// 2√(m kn) of one spring. ηn Δt/m = 2√2 π αcn/αtn whatever Δt: with the damping taken from the old
    /// velocity one contact with a wall is stable for kn Δt²/m + 2 ηn Δt/m < 4; a packing needs a smaller step.
    ///
    /// Source: `Gotoh2001`, section 2: αtn = 20, αcn = 1.3, ν = 0.3. The numbers are with [`SpringDashpot`].
    ///
    /// ```
    /// let law = tsubu_contact::SpringDashpot::from_time_step(2.0e-5, 2.0617e-7, 20.0, 1.3, 0.3, 0.577);
    /// assert!((law.normal_damping * 2.0e-5 / 2.0617e-7 - 0.5776).abs() < 1e-4);
    /// ```
    pub fn from_time_step(
        dt: f64,
        mass: f64,
        alpha_tn: f64,
        alpha_cn: f64,
        poisson: f64,
        friction: f64,
    ) -> Self {
        let stiffness = 2.0 * PI * PI * mass / (alpha_tn * dt).powi(2);
        let damping = alpha_cn * 2.0 * (mass * stiffness).sqrt();
        Self::isotropic(stiffness, damping, poisson, friction)
    }

    /// Constants that give a head-on collision this restitution e in (0, 1], at any speed.
    ///
    /// ```text
    /// ηn = 2ζ√(m* kn),   ζ from e by [`restitution::ratio_from_restitution`]
    /// ```
    ///
    /// m* is the reduced mass in kg: half the mass for equal grains, the mass itself against a wall. It holds for
    /// [`Tension::NoPull`]; as printed the same ζ gives less. The tangential constants follow as in
    /// [`from_time_step`](Self::from_time_step).
    ///
    /// Source: `Schwager2007`.
    ///
    /// ```
    /// let law = tsubu_contact::SpringDashpot::from_restitution(1.0e4, 0.5, 1.0e-3, 0.3, 0.5);
    /// assert!((law.damping_ratio(1.0e-3) - 0.255276).abs() < 1e-6);
    /// assert!((law.normal_damping - 1.61451).abs() < 1e-5);    // kg/s
    /// ```
    pub fn from_restitution(
        normal_stiffness: f64,
        restitution: f64,
        reduced_mass: f64,
        poisson: f64,
        friction: f64,
    ) -> Self {
        let zeta = restitution::ratio_from_restitution(restitution);
        let damping = 2.0 * zeta * (reduced_mass * normal_stiffness).sqrt();
        Self::isotropic(normal_stiffness, damping, poisson, friction)
    }

    /// αtn and αcn multiplied by β together: kn and ks over β², ηn and ηs unchanged.
    ///
    /// Source: `Gotoh2001`; bed load asks for β = 15.8.
    ///
    /// ```
    /// let law = tsubu_contact::SpringDashpot::new(1.0e3, 0.4e3, 0.1, 0.06, 0.5).scaled_by(10.0);
    /// assert_eq!((law.normal_stiffness, law.tangential_stiffness), (10.0, 4.0));
    /// assert_eq!((law.normal_damping, law.tangential_damping), (0.1, 0.06));
    /// ```
    pub fn scaled_by(self, beta: f64) -> Self {
        Self {
            normal_stiffness: self.normal_stiffness / (beta * beta),
            tangential_stiffness: self.tangential_stiffness / (beta * beta),
            ..self
        }
    }

    /// The same with this reading of the tension.
    pub fn tension(self, tension: Tension) -> Self {
        Self { tension, ..self }
    }

    /// The same with this reading of friction.
    pub fn slip(self, slip: Slip) -> Self {
        Self { slip, ..self }
    }

    /// The same with this way to count the normal spring.
    pub fn normal(self, normal: Normal) -> Self {
        Self { normal, ..self }
    }

    /// ζ = ηn/(2√(kn m*)), m* the reduced mass in kg.
    pub fn damping_ratio(&self, reduced_mass: f64) -> f64 {
        self.normal_damping / (2.0 * (self.normal_stiffness * reduced_mass).sqrt())
    }
}

/// The constants of the contact; the readings are no constants and stay as they are.
impl Constants for SpringDashpot {
    fn constants(&self) -> Vec<(&'static str, Quantity, f64)> {
        vec![
            (
                "normal_stiffness",
                Quantity::Stiffness,
                self.normal_stiffness,
            ),
            (
                "tangential_stiffness",
                Quantity::Stiffness,
                self.tangential_stiffness,
            ),
            ("normal_damping", Quantity::Damping, self.normal_damping),
            (
                "tangential_damping",
                Quantity::Damping,
                self.tangential_damping,
            ),
            ("friction", Quantity::Number, self.friction),
        ]
    }

    fn mapped(&self, mut f: impl FnMut(Quantity, f64) -> f64) -> Self {
        Self {
            normal_stiffness: f(Quantity::Stiffness, self.normal_stiffness),
            tangential_stiffness: f(Quantity::Stiffness, self.tangential_stiffness),
            normal_damping: f(Quantity::Damping, self.normal_damping),
            tangential_damping: f(Quantity::Damping, self.tangential_damping),
            friction: f(Quantity::Number, self.friction),
            ..*self
        }
    }
}
