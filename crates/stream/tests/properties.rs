//! What holds for any constants: direction of drag, bounds and shape of profile and shelter, units.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use tsubu_model::{Plane, Space};
use tsubu_stream::{
    Datum, FluctuationsBelow, LogLaw, Profile, Setting, Shelter, ShelterBelow, Stream, Table,
    Water, bed_level,
};

fn speed() -> impl Strategy<Value = f64> {
    -5.0..5.0f64
}

fn stream(d: f64, u: f64, seed: u64) -> Setting {
    Setting {
        datum: Datum::Given(0.0),
        ..Setting::over_grains(d, u, seed)
    }
}

proptest! {
    /// Drag is along w, of length ½ρεCD A2 d² w², and turns with w. Ten roundings: 1e-13.
    #[test]
    fn drag_is_along_the_relative_velocity(x in speed(), y in speed(), z in speed(), d in 1e-5..0.1f64, shelter in 0.0..1.0f64) {
        let (water, w) = (Water::fresh(), DVec3::new(x, y, z));
        let force = water.drag(d, shelter, w);
        let length = 0.5 * 1000.0 * shelter * 0.4 * 0.25 * std::f64::consts::PI * d * d * w.length_squared();
        prop_assert!(force.dot(w) >= 0.0);
        prop_assert!((force.dot(w) - force.length() * w.length()).abs() <= 1e-13 * length * w.length());
        prop_assert!((force.length() - length).abs() <= 1e-13 * length);
        // A quarter turn is exact.
        let turned = water.drag(d, shelter, DVec3::new(-y, x, z));
        prop_assert!((turned - DVec3::new(-force.y, force.x, force.z)).length() <= 1e-13 * length);
        // In the plane and in space it is the same force.
        let flat = water.drag(d, shelter, DVec2::new(x, y));
        prop_assert!((flat.extend(0.0) - water.drag(d, shelter, DVec3::new(x, y, 0.0))).length() <= 1e-13 * length);
    }

    /// In standing or flowing water, a grain that outruns its water is slowed: force · (water − grain) ≥ 0.
    #[test]
    fn a_grain_is_driven_towards_its_water(x in speed(), z in speed(), y in -5.0..20.0f64, seed in 0..u64::MAX, identity in 0..u32::MAX) {
        let d = 1e-3;
        let water = Stream::new(stream(d, 0.1, seed)).unwrap();
        let current = water.at(0.3).unwrap();
        let (place, velocity) = (DVec2::new(7.0, y * d), DVec2::new(x, z));
        let relative = current.velocity::<Plane>(place, identity) - velocity;
        prop_assert!(current.force::<Plane>(place, velocity, identity, d).dot(relative) >= 0.0);
    }

    /// ε lies in [ε0, 1], and grows with height above −y₀; the default stays at ε0 below, the printed one mirrors.
    #[test]
    fn shelter_is_bounded_and_grows(floor in 0.0..1.0f64, d in 1e-5..0.1f64, y in -10.0..10.0f64, step in 0.0..1.0f64) {
        let shelter = Shelter { floor, ..Shelter::among_grains(d) };
        let (low, high) = (shelter.factor(y * d), shelter.factor((y + step) * d));
        prop_assert!(floor <= low && low <= high && high <= 1.0);
        if y < -0.25 {
            prop_assert_eq!(low, floor);
        }
        let printed = Shelter { below: ShelterBelow::AsPrinted, ..shelter };
        let mirrored = printed.factor((-0.5 - y) * d);
        prop_assert!((printed.factor(y * d) - mirrored).abs() < 1e-12);
        if y > -0.25 {
            prop_assert_eq!(printed.factor(y * d), low);
        }
        prop_assert_eq!(Shelter::none().factor(y * d), 1.0);
    }

    /// U never falls with height, is zero up to its zero, and is continuous: no steeper than 30.1/(κ ksr).
    #[test]
    fn the_mean_flow_grows_continuously(roughness in 1e-5..0.1f64, offset in 0.0..1.0f64, karman in 0.3..0.5f64, y in -3.0..50.0f64, step in 0.0..0.1f64) {
        let law = LogLaw { roughness, offset: offset * roughness, karman };
        let (low, high) = (y * roughness, (y + step) * roughness);
        let rise = law.over_friction_velocity(high) - law.over_friction_velocity(low);
        // Rounding of the logarithm and its argument: 1e-12.
        prop_assert!(rise >= 0.0 && rise <= 30.1 / karman * step + 1e-12, "{rise}");
        prop_assert_eq!(law.over_friction_velocity(law.zero() - 1e-9 * roughness), 0.0);
        prop_assert!(law.over_friction_velocity(law.zero() + 1e-9 * roughness) < 1e-6);
    }

    /// A profile measured on the law itself gives the law back: at the rows to rounding, between them below it (the
    /// logarithm bends down). And it scales with u*.
    #[test]
    fn a_measured_profile_follows_its_rows(y in 0.0..1.0f64, u in 0.01..1.0f64) {
        let law = LogLaw::over_grains(1e-3);
        let heights = [law.zero(), 0.0, 1e-3, 5e-3, 20e-3];
        let rows: Vec<_> = heights.iter().map(|y| [*y, u * law.over_friction_velocity(*y)]).collect();
        let measured = Profile::measured(&rows, u).unwrap();
        for y in heights {
            prop_assert!((measured.over_friction_velocity(y) - law.over_friction_velocity(y)).abs() < 1e-12);
        }
        let y = law.zero() + y * (20e-3 - law.zero());
        prop_assert!(measured.over_friction_velocity(y) <= law.over_friction_velocity(y) + 1e-12);
        // Held beyond the rows.
        prop_assert_eq!(measured.over_friction_velocity(1.0), measured.over_friction_velocity(20e-3));
        prop_assert_eq!(measured.over_friction_velocity(-1.0), 0.0);
    }

    /// Any units: lengths × l, masses × m, times × t in everything that goes in make forces × m l/t² come out.
    #[test]
    fn the_force_knows_no_units(l in 0.1..10.0f64, m in 0.1..10.0f64, t in 0.1..10.0f64, y in -1.0..20.0f64, x in speed(), z in speed(), seed in 0..1000u64) {
        let (d, u, moment) = (2e-3, 0.1, 0.51);
        // Turbulence begins at once where the mean flow does: no rounding may decide that.
        prop_assume!((y + 0.25 - 1.0 / 30.1).abs() > 1e-6);
        let fine = stream(d, u, seed);
        let mut scaled = stream(l * d, l / t * u, seed);
        scaled.water.density *= m / l.powi(3);
        scaled.water.gravity *= l / (t * t);
        scaled.turbulence.depth *= l;
        scaled.turbulence.frequency /= t;
        let force = |setting: Setting, l: f64, t: f64| {
            let stream = Stream::new(setting).unwrap();
            let (place, velocity) = (DVec3::new(0.0, 0.0, y * d * l), DVec3::new(x, 0.3, z) * (l / t));
            stream.at(moment * t).unwrap().force::<Space>(place, velocity, 5, d * l)
        };
        let (one, other) = (force(fine, 1.0, 1.0) * (m * l / (t * t)), force(scaled, l, t));
        prop_assert!((one - other).length() <= 1e-9 * one.length(), "{one} {other}");
    }

    /// A bed that is lifted lifts its datum, and the datum lies within one d below the highest bed grain.
    #[test]
    fn the_datum_moves_with_the_bed(bed in prop::collection::vec((0.0..10.0f64, 0u32..6), 1..40), lift in -5.0..5.0f64) {
        let level = bed_level(bed.iter().copied(), 1.0, 2);
        let lifted = bed_level(bed.iter().map(|(y, contacts)| (y + lift, *contacts)), 1.0, 2);
        let top = bed.iter().filter(|grain| grain.1 >= 2).map(|grain| grain.0).reduce(f64::max);
        prop_assert_eq!(level.is_some(), top.is_some());
        if let (Some(level), Some(lifted), Some(top)) = (level, lifted, top) {
            prop_assert!(level <= top + 1e-12 && level >= top - 1.0 - 1e-12);
            // A grain that lies one d below to rounding may fall in or out; those cases are rare and not asked for.
            let edge = bed.iter().any(|grain| (grain.0 - (top - 1.0)).abs() < 1e-9);
            prop_assert!(edge || (lifted - level - lift).abs() < 1e-12);
        }
    }

    /// Between its rows a table lies between their values; at a row it is the row.
    #[test]
    fn a_table_interpolates(values in prop::collection::vec(-1e3..1e3f64, 1..12), x in -2.0..14.0f64) {
        let rows: Vec<[f64; 2]> = values.iter().enumerate().map(|(i, v)| [i as f64, *v]).collect();
        let table = Table::new(rows.clone()).unwrap();
        for [x, value] in &rows {
            prop_assert_eq!(table.at(*x), *value);
        }
        let last = values.len() - 1;
        let (below, above) = (x.floor().clamp(0.0, last as f64), x.ceil().clamp(0.0, last as f64));
        let (a, b) = (values[below as usize], values[above as usize]);
        prop_assert!(table.at(x) >= a.min(b) - 1e-9 && table.at(x) <= a.max(b) + 1e-9);
    }
}

/// The readings below the datum, at half of it, and deep: what each leaves of the intensity.
#[test]
fn fluctuations_below_the_datum_follow_the_reading() {
    let at = |below: FluctuationsBelow, y: f64, flows: bool| {
        let setting = stream(1e-3, 0.1, 1);
        tsubu_stream::Turbulence {
            below,
            ..setting.turbulence
        }
        .decay(y, flows)
    };
    use FluctuationsBelow::{AsPrinted, AtBed, Still};
    // exp(0.01/0.2) and exp(−0.01/0.2).
    assert!((at(AsPrinted, -0.01, false) - 1.051271).abs() < 1e-6);
    assert_eq!(at(AtBed, -0.01, false), 1.0);
    assert_eq!(at(Still, -0.01, false), 0.0);
    assert_eq!(at(Still, -1e-4, true), 1.0);
    for below in [AsPrinted, AtBed, Still] {
        assert!((at(below, 0.01, true) - 0.951229).abs() < 1e-6);
    }
}
