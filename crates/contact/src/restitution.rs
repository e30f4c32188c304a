//! Restitution and damping ratio of the linear spring–dashpot collision, both ends of contact.
//!
//! A contact m* ẍ = −k x − η ẋ with ζ = η/(2√(k m*)) can end when the overlap is zero or, where
//! nothing may pull, when the force is zero. The two give different restitution for the same ζ.
//! Source: `Schwager2007`.

use std::f64::consts::PI;

/// e when the contact ends at zero overlap: exp(−πζ/√(1−ζ²)); 0 for ζ ≥ 1.
///
/// ```
/// let e = tsubu_contact::restitution::at_zero_overlap(0.0347);
/// assert!((e - 0.8967).abs() < 2e-4);   // paper A's coke, a pair
/// ```
pub fn at_zero_overlap(zeta: f64) -> f64 {
    if zeta >= 1.0 {
        0.0
    } else {
        (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp()
    }
}

/// e when the contact ends at zero force (no pull), for any ζ ≥ 0.
///
/// ```
/// use tsubu_contact::restitution::at_zero_force;
/// assert!((at_zero_force(0.3) - 0.45098).abs() < 1e-5);
/// assert!((at_zero_force(1.0) - 0.13534).abs() < 1e-5);
/// assert!((at_zero_force(5.0) - 0.009285).abs() < 1e-6);
/// ```
pub fn at_zero_force(zeta: f64) -> f64 {
    let gap = 1.0 - zeta * zeta;
    // Near ζ = 1 both forms are 0/0; the limit is e⁻².
    let exponent = if gap.abs() < 1e-12 {
        2.0
    } else if gap > 0.0 {
        2.0 * zeta * zeta.acos() / gap.sqrt()
    } else {
        2.0 * zeta * zeta.acosh() / (-gap).sqrt()
    };
    (-exponent).exp()
}

/// ζ that gives restitution `e` in (0, 1] when the contact ends at zero force.
///
/// ```
/// use tsubu_contact::restitution::{at_zero_force, ratio_from_restitution};
/// assert!((at_zero_force(ratio_from_restitution(0.5)) - 0.5).abs() < 1e-12);
/// ```
pub fn ratio_from_restitution(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while at_zero_force(high) > e && high < 1e12 {
        high *= 2.0;
    }
    // at_zero_force falls strictly with ζ; 200 halvings reach the last bit.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if at_zero_force(middle) > e {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// ζ as the paper prints it, for a contact that ends at zero overlap: −ln e/√(π² + ln² e).
///
/// ```
/// let zeta = tsubu_contact::restitution::ratio_as_printed(0.5);
/// assert!((zeta - 0.2155).abs() < 1e-4);
/// ```
pub fn ratio_as_printed(e: f64) -> f64 {
    let ln = e.ln();
    -ln / (PI * PI + ln * ln).sqrt()
}
