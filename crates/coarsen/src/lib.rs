//! Coarse-graining: fewer, larger grains that stand for the real ones.
//!
//! A rule is a map (quantity, value, λ) → value over the constants that a law or a kind of grain
//! lists. It knows no law, so it works on all of them. λ = 2ⁿ after n renormalisations ([`Level`]).
//! Positions, velocities, time and the box are never scaled.
//!
//! ```
//! use tsubu_coarsen::{CoarseRule, Level, Renormalised, coarsen};
//! use tsubu_contact::Repulsion;
//! use tsubu_model::Kind;
//! // Paper A's coke and its step of a twentieth of a period, three times renormalised.
//! let (grain, law) = (Kind::sphere(1.350e-3, 1370.0), Repulsion::new(9.434e-2, 1.203e-3, 0.1257, 0.1257, 1.350e-3));
//! let level = Level::new(3);
//! let (coarse, law) = (coarsen(&Renormalised, &grain, level)?, coarsen(&Renormalised, &law, level)?);
//! assert!((coarse.diameter() - 10.8e-3).abs() < 1e-9);                          // d' in m
//! assert!((law.normal_damping - 8.05).abs() < 0.01);                            // γ' in kg/s
//! assert!((Renormalised.step_factor(level.lambda()) * 1.529e-7 - 1.22e-6).abs() < 5e-9);  // Δt' in s
//! # Ok::<(), tsubu_coarsen::TooCoarse>(())
//! ```
//!
//! # The rules
//!
//! | | [`Renormalised`] | [`SakaiKoshizuka`] | [`RadlRestitution`] |
//! |---|---|---|---|
//! | length (d, σ) | λ | λ | λ |
//! | mass | λ³ | λ³ | λ³ |
//! | energy (ε) | λ³ | λ⁵ | λ³ |
//! | stiffness (k) | λ | λ³ | λ |
//! | damping (γ, η) | λ² | λ³ | λ² ζ(e_c)/ζ(e) |
//! | restitution (e) | 1 | 1 | e → e_c = √(1 + (e² − 1)λ) |
//! | pure numbers (μ, ν) | 1 | 1 | 1 |
//! | step Δt | λ | 1 | λ |
//! | cost | λ⁻⁴ | λ⁻³ | λ⁻⁴ |
//!
//! # What is kept and what is not
//!
//! | | [`Renormalised`] | [`SakaiKoshizuka`] | [`RadlRestitution`] |
//! |---|---|---|---|
//! | density, weight per volume | kept | kept | kept |
//! | modulus E = k/d, static stress at a given strain | kept | × λ² | kept |
//! | ζ and e of a pair | kept | kept | changed on purpose |
//! | overlap ratio δ/d at a given impact speed | kept | × 1/λ | kept but for the damping |
//! | duration of a contact | × λ | kept | × λ |
//! | energy lost to collisions per volume and time | × 1/λ | × 1/λ | kept |
//!
//! No rule keeps what depends on the size of a grain: the inertial number I = γ̇ d √(ρ/P) grows with
//! λ and the collision rate falls with it; Beverloo's empty annulus (D − kλd) widens; a gap of a few
//! d' lets fewer grains through or none ([`check_gaps`]). Where tangential contact forces are viscous,
//! the creep viscosity of a packing grows with λ under [`Renormalised`], so a heap of coarse
//! grains creeps λ times slower: compare levels at equal time and say so.
//!
//! Validity: dense, slow flow; smallest opening at least 6 d', better 8 to 10.
//! Exact similarity would need the geometry to scale with the grain (`Feng2014`).
//!
//! # Grains and walls
//!
//! Constants of grain–wall contacts go through a rule too. For walls use [`Renormalised`] also where
//! the grains use [`RadlRestitution`]: the energy that walls take per area and time does not
//! depend on λ, so there is nothing to correct.
//!
//! # Where the λ³/λ/λ² rule comes from, and who claims it
//!
//! [`Renormalised`] is paper A's rule (`Sumitomo2024`). The same scaling of contacts (E fixed, k ∝ λ,
//! γ ∝ λ², e and μ as they are) was published in 2009 (`Bierwisch2009`), and k ∝ d again in
//! 2015 (`Thakur2015`).
//! The rule is claimed by patents: US 10,013,514 B2 (also US 2017/0017737, JP 6472346 B2, EP 3121741;
//! `Hirose2018`) for granular matter; related are US 2011/0246167 and US 2016/0342772 for molecular
//! dynamics, WO 2018/198273 and JP 2025-155164. Whether they bind a given use, and what the earlier
//! publication means for them, is a question for counsel; nothing here is legal advice.

mod gaps;
mod level;
mod radl;
mod renormalised;
mod rule;
mod sakai_koshizuka;

pub use gaps::{Gap, NarrowGap, check_gaps};
pub use level::Level;
pub use radl::{NotARestitution, RadlRestitution};
pub use renormalised::Renormalised;
pub use rule::{CoarseRule, TooCoarse, coarsen};
pub use sakai_koshizuka::SakaiKoshizuka;
