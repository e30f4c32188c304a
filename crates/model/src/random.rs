//! Random numbers from (seed, identity, event): nothing to save, the same for any order of work.

/// A number in [0, 1) that depends on nothing but its three arguments: the SplitMix64 finaliser, one round
/// for each of identity, event and a constant. `identity` is whose number it is, `event` which of its numbers.
///
/// Its values are part of what a seed means and never change.
///
/// ```
/// assert_eq!(tsubu_model::uniform(42, 7, 3), 12853779526540.0 / 2f64.powi(53));
/// ```
pub fn uniform(seed: u64, identity: u64, event: u64) -> f64 {
    let mut z = seed;
    for word in [identity, event, 0x5851_f42d_4c95_7f2d] {
        z = z
            .wrapping_add(word.wrapping_mul(0x9e37_79b9_7f4a_7c15))
            .wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
    }
    (z >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole numbers of 2⁻⁵³ from the same recipe written apart from this code, in another language.
    #[test]
    fn bits_are_those_of_the_recipe() {
        let cases = [
            ([1, 0, 0], 3692752486287056u64),
            ([1, 7, 0], 5275988924800914),
            ([42, 7, 3], 12853779526540),
            (
                [(1 << 63) + 5, 4_000_000_000, 123_456_789],
                3046767443920011,
            ),
        ];
        for ([seed, identity, event], bits) in cases {
            assert_eq!(
                uniform(seed, identity, event) * (1u64 << 53) as f64,
                bits as f64
            );
        }
    }

    #[test]
    fn is_flat_and_uncorrelated_between_neighbours() {
        let n = 40_000u64;
        let draws: Vec<f64> = (0..n).map(|i| uniform(1, i, 0)).collect();
        let mean = draws.iter().sum::<f64>() / n as f64;
        // Standard error of the mean of a flat draw: 1/√(12 n); five of them.
        assert!(
            (mean - 0.5).abs() < 5.0 / (12.0 * n as f64).sqrt(),
            "{mean}"
        );
        let product = draws
            .windows(2)
            .map(|w| (w[0] - 0.5) * (w[1] - 0.5))
            .sum::<f64>()
            / n as f64;
        assert!(
            product.abs() < 5.0 / (12.0 * (n as f64).sqrt()),
            "{product}"
        );
        assert_ne!(uniform(1, 7, 0), uniform(2, 7, 0));
        assert_ne!(uniform(1, 7, 0), uniform(1, 7, 1));
    }
}
