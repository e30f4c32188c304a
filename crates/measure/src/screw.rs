//! What a screw should convey: formulas of the trade, against which a run is held.

use std::f64::consts::{FRAC_PI_4, PI};

/// Area in m² of the annulus between two diameters in m: (π/4)(D² − d²).
pub fn annulus(outer: f64, inner: f64) -> f64 {
    FRAC_PI_4 * (outer * outer - inner * inner)
}

/// Volume in m³ that a full screw moves per turn: (π/4)(Ds² − ds²) p, with Ds the outer diameter of the flight, ds
/// that of the shaft and p the pitch, all in m.
///
/// The thickness of the flight is not taken off, nor is the clearance to the casing counted.
///
/// ```
/// // Paper A: Ds 205 mm, ds 55 mm, pitch 150 mm.
/// let volume = tsubu_measure::screw::volume_per_turn(0.205, 0.055, 0.150);
/// assert!((volume - 4.5946e-3).abs() < 1e-7);
/// assert!((volume * 3600.0 * 100.0 / 60.0 - 27.57).abs() < 0.005); // m³/h at 100 r/min
/// ```
pub fn volume_per_turn(outer: f64, shaft: f64, pitch: f64) -> f64 {
    annulus(outer, shaft) * pitch
}

/// Mass rate in kg/s by volume: Q = a (π/4)(Ds² − ds²) p n_s ρb.
///
/// a filling ratio (1), the volume per turn in m³ from [`volume_per_turn`], n_s turns per second, ρb bulk density
/// in kg/m³. It holds for grains that advance by one pitch per turn, so that none turns with the screw and none
/// is left behind in the clearance; see [`vortex_efficiency`] for what rotation costs.
///
/// Source: `Sumitomo2024`.
///
/// ```
/// use tsubu_measure::screw;
/// // Paper A's screw at 100 r/min, full, with grains of 1370 kg/m³ at a packing of 0.60: 6.29 kg/s.
/// let volume = screw::volume_per_turn(0.205, 0.055, 0.150);
/// assert!((screw::mass_rate(1.0, volume, 100.0 / 60.0, 0.60 * 1370.0) - 6.29).abs() < 0.01);
/// ```
pub fn mass_rate(filling: f64, volume_per_turn: f64, turns: f64, bulk_density: f64) -> f64 {
    filling * volume_per_turn * turns * bulk_density
}

/// Share of the rate that is left when the grains turn with the screw.
///
/// η_VR = 1 − (V_T/ωR)·2/(1 + ds/Ds), V_T/ωR = 1 − 1/(1 + tan α tan(α + φ)), tan α = p/(π Ds), φ = atan μ: grains leave
/// the flight at the friction angle φ to its normal, and their tangential speed V_T is the same at every radius, that at the tip.
/// Ds, ds, p in m; μ friction between flight and grains. For a full, enclosed screw whose grains slip on the
/// flight at full μ; α + φ must be less than 90°. The annulus outside the flight is taken to rest.
///
/// Source: `Roberts1999`.
///
/// ```
/// // Paper A's screw with μ = 0.413 loses 22 %.
/// let left = tsubu_measure::screw::vortex_efficiency(0.205, 0.055, 0.150, 0.413);
/// assert!((left - 0.775).abs() < 1e-3);
/// ```
pub fn vortex_efficiency(outer: f64, shaft: f64, pitch: f64, friction: f64) -> f64 {
    let helix = (pitch / (PI * outer)).atan();
    let axial = 1.0 / (1.0 + helix.tan() * (helix + friction.atan()).tan());
    1.0 - (1.0 - axial) * 2.0 / (1.0 + shaft / outer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_costs_what_the_table_of_the_theory_says() {
        for (friction, expected) in [
            (0.2, 0.849),
            (0.3, 0.814),
            (0.413, 0.775),
            (0.5, 0.745),
            (0.6, 0.710),
        ] {
            let found = vortex_efficiency(0.205, 0.055, 0.150, friction);
            assert!((found - expected).abs() < 1e-3, "{friction}: {found}");
        }
        // Without friction flights still push along their normal: 0.919, not 1.
        assert!((vortex_efficiency(0.205, 0.055, 0.150, 0.0) - 0.919).abs() < 1e-3);
    }
}
