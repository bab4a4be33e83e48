//! Normal numbers by a counter: number k of a stream is a function of seed, k and axis alone.
//!
//! Nothing has to be drawn in order, so a sensor's noise does not depend on how an importer steps, and a saved state
//! needs no generator.

/// Mixes all bits of `z` (the finalizer of SplitMix64; Steele, Lea, Flood 2014).
const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// 64 random bits that belong to three numbers.
const fn hash(seed: u64, k: u64, channel: u64) -> u64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15; // 2⁶⁴ / golden ratio
    let bits = mix(seed.wrapping_add(GOLDEN));
    let bits = mix(bits.wrapping_add(k).wrapping_add(GOLDEN));
    mix(bits.wrapping_add(channel).wrapping_add(GOLDEN))
}

/// Uniform in [0, 1), on a grid of 2⁻⁵³.
fn uniform(bits: u64) -> f64 {
    const GRID: f64 = 1.0 / (1_u64 << 53) as f64;
    (bits >> 11) as f64 * GRID
}

/// A normal number of mean 0 and standard deviation 1 for sample `k` of `axis` (Box and Muller 1958). It does not exceed
/// 8.6 in size, so it is always finite.
pub fn normal(seed: i32, k: u64, axis: u64) -> f64 {
    let seed = u64::from(seed as u32);
    let radius = 1.0 - uniform(hash(seed, k, 2 * axis)); // in (0, 1]
    let turn = uniform(hash(seed, k, 2 * axis + 1));
    (-2.0 * libm::log(radius)).sqrt() * libm::cos(2.0 * core::f64::consts::PI * turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: u64 = 200_000;

    fn mean(f: impl Fn(u64) -> f64) -> f64 {
        (0..N).map(f).sum::<f64>() / N as f64
    }

    /// Five standard deviations of a mean of N terms of this deviation.
    fn five(deviation: f64) -> f64 {
        5.0 * deviation / (N as f64).sqrt()
    }

    #[test]
    fn moments_are_those_of_the_normal_distribution() {
        for (seed, axis) in [(0, 0), (1, 1), (-1, 2), (i32::MIN, 0)] {
            let x = |k| normal(seed, k, axis);
            assert!(mean(x).abs() < five(1.0));
            assert!((mean(|k| x(k).powi(2)) - 1.0).abs() < five(2.0_f64.sqrt()));
            assert!(mean(|k| x(k).powi(3)).abs() < five(15.0_f64.sqrt()));
            assert!((mean(|k| x(k).powi(4)) - 3.0).abs() < five(96.0_f64.sqrt()));
            // P(|x| > 2) = 4.55 %
            let beyond = mean(|k| f64::from(u8::from(x(k).abs() > 2.0)));
            assert!(
                (beyond - 0.0455).abs() < five(0.0455_f64.sqrt()),
                "{beyond}"
            );
        }
    }

    #[test]
    fn neighbours_axes_and_seeds_are_uncorrelated() {
        for lag in 1..4 {
            assert!(mean(|k| normal(7, k, 0) * normal(7, k + lag, 0)).abs() < five(1.0));
            assert!(mean(|k| normal(7, k, 0) * normal(7, k + lag, 1)).abs() < five(1.0));
            assert!(mean(|k| normal(7, k + lag, 0) * normal(8, k, 0)).abs() < five(1.0));
        }
        assert!(mean(|k| normal(7, k, 0) * normal(7, k, 1)).abs() < five(1.0));
        assert!(mean(|k| normal(7, k, 0) * normal(7, k, 2)).abs() < five(1.0));
        assert!(mean(|k| normal(7, k, 0) * normal(8, k, 0)).abs() < five(1.0));
    }
}
