//! Closed forms of the elastic contact and of gross sliding, and a plain integration of the impact without micro-slip. All from
//! moduli, radii and masses: nothing here asks the law.

use tsubu_contact::Elastic;
use tsubu_model::Kind;

/// ∫ of a Hertzian collision: t = 2.943275 δ/v, 4√π Γ(2/5)/(5 Γ(9/10)).
const DURATION: f64 = 2.943_275;

/// A material with its density in kg/m³.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// E in Pa and ν.
    pub elastic: Elastic,
    /// ρ in kg/m³.
    pub density: f64,
}

/// A material from E in GPa, ν and ρ.
pub const fn material(young_gpa: f64, poisson: f64, density: f64) -> Material {
    Material {
        elastic: Elastic {
            young: young_gpa * 1e9,
            poisson,
        },
        density,
    }
}

impl Material {
    /// A solid sphere of this radius in m.
    pub fn sphere(&self, radius: f64) -> Kind {
        Kind::sphere(2.0 * radius, self.density)
    }
}

/// Hertz's contact of a sphere with another or with a flat wall.
///
/// ```text
/// k = (4/3) E* √R*,   δ = (5 m* v²/(4k))^(2/5),   F = k δ^(3/2),   t = 2.943275 δ/v
/// ```
pub struct Hertz {
    /// k in N/m^(3/2).
    pub stiffness: f64,
    /// m* in kg.
    pub mass: f64,
}

impl Hertz {
    /// Of a sphere and what it meets; `None` is a flat wall that does not move.
    pub fn of(ball: (&Kind, &Elastic), partner: (Option<&Kind>, &Elastic)) -> Self {
        let yields = |m: &Elastic| (1.0 - m.poisson * m.poisson) / m.young;
        let modulus = 1.0 / (yields(ball.1) + yields(partner.1));
        let (curved, light) = partner
            .0
            .map_or((0.0, 0.0), |kind| (1.0 / kind.radius, 1.0 / kind.mass));
        let radius = 1.0 / (1.0 / ball.0.radius + curved);
        Self {
            stiffness: 4.0 / 3.0 * modulus * radius.sqrt(),
            mass: 1.0 / (1.0 / ball.0.mass + light),
        }
    }

    /// Largest overlap in m at an approach of `speed` m/s.
    pub fn deepest(&self, speed: f64) -> f64 {
        (5.0 * self.mass * speed * speed / (4.0 * self.stiffness)).powf(0.4)
    }

    /// Largest force in N.
    pub fn force(&self, speed: f64) -> f64 {
        self.stiffness * self.deepest(speed).powf(1.5)
    }

    /// Duration in s.
    pub fn duration(&self, speed: f64) -> f64 {
        DURATION * self.deepest(speed) / speed
    }
}

/// What a tangential spring does when the overlap changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spring {
    /// Its force stays under loading and shrinks with the stiffness under unloading: ours, which gives no energy away.
    Shrinks,
    /// Its force is the present stiffness times the way: it gains force, and energy, from loading alone.
    OfTheWay,
    /// Its force grows by stiffness times way and never shrinks.
    Increments,
}

/// Impact of a solid sphere on a rigid wall with a tangential stiffness of no slip, in reduced form: overlap, normal speed, slip.
/// Speeds are over that of the normal approach.
#[derive(Clone, Copy, Debug)]
pub struct NoSlip {
    /// ν of the sphere.
    pub poisson: f64,
    /// Damping ratio of the contact, normal and tangential.
    pub damping: f64,
    /// μ.
    pub friction: f64,
    /// The rule of the spring.
    pub spring: Spring,
    /// Its stiffness over 8 G* √(R δ).
    pub share: f64,
}

/// After the impact: normal speed, slip of the contact point, tangential momentum given over m.
#[derive(Clone, Copy, Debug)]
pub struct After {
    pub normal: f64,
    pub slip: f64,
    pub impulse: f64,
}

impl NoSlip {
    /// m = R = k = 1 and normal speed 1; 20 000 steps of symplectic Euler to a Hertzian duration leave 1e-4.
    pub fn impact(&self, slip: f64) -> After {
        // 8 G*/((4/3) E*) of a sphere on a rigid wall, and 7/2: a solid sphere's slip changes by 7/2 of its momentum.
        let ratio = self.share * 3.0 * (1.0 - self.poisson) / (2.0 - self.poisson);
        let turning = 3.5;
        let dt = DURATION * (1.25f64).powf(0.4) / 20_000.0;
        let normal_damping = 2.0 * self.damping * 1.25f64.sqrt();
        let tangential_damping = 2.0 * self.damping * (5.0 / 6.0 * ratio).sqrt();
        let (mut overlap, mut approach, mut now) = (0.0f64, 1.0f64, slip);
        let (mut spring, mut way, mut impulse, mut before) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
        for _ in 0..1_000_000 {
            overlap += approach * dt;
            if overlap <= 0.0 {
                break;
            }
            let (root, quarter) = (overlap.sqrt(), overlap.powf(0.25));
            let press = (overlap * root + normal_damping * quarter * approach).max(0.0);
            let stiffness = ratio * root;
            spring = match self.spring {
                Spring::Shrinks => {
                    let shrink = if before > 0.0 {
                        (stiffness / before).min(1.0)
                    } else {
                        1.0
                    };
                    spring * shrink - stiffness * now * dt
                }
                Spring::OfTheWay => -stiffness * (way + now * dt),
                Spring::Increments => spring - stiffness * now * dt,
            };
            before = stiffness;
            let limit = self.friction * overlap * root;
            spring = spring.clamp(-limit, limit);
            let whole = spring - tangential_damping * quarter * now;
            let most = self.friction * press;
            let force = whole.clamp(-most, most);
            if force != whole {
                spring *= force / whole;
            }
            way = -spring / stiffness;
            approach -= press * dt;
            now += turning * force * dt;
            impulse += force * dt;
        }
        After {
            normal: -approach,
            slip: now,
            impulse,
        }
    }
}
