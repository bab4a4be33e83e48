//! Numbers in messages.

use core::fmt;

/// A number in a message: in digits where they are few, with an exponent where they would be many.
///
/// ```
/// use fmu_declaration::Brief;
/// assert_eq!(format!("{} s, {} s, {}", Brief(0.02), Brief(1e300), Brief(f64::NAN)), "0.02 s, 1e300 s, NaN");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brief<T>(pub T);

impl<T: Copy + Into<f64> + fmt::Display + fmt::LowerExp> fmt::Display for Brief<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        let size = value.into().abs();
        // Up to sixteen digits before the point, and a tenth of a microsecond behind it.
        let long = size.is_finite() && size != 0.0 && !(1e-7..1e16).contains(&size);
        if long {
            write!(f, "{value:e}")
        } else {
            write!(f, "{value}")
        }
    }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    #[test]
    fn no_finite_number_is_long_and_each_is_read_back_bit_for_bit() {
        let mut bits = 1_u64;
        for _ in 0..100_000 {
            // Knuth's generator: all exponents come.
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from_bits(bits);
            if value.is_nan() {
                continue;
            }
            let text = std::format!("{}", Brief(value));
            assert!(text.len() <= 26, "{text}");
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn everyday_numbers_are_written_in_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (1.0, "1"),
            (1e-7, "0.0000001"),
            (-1e15, "-1000000000000000"),
            (1e16, "1e16"),
            (-2.5e-9, "-2.5e-9"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(std::format!("{}", Brief(value)), text);
        }
        assert_eq!(
            std::format!("{} {}", Brief(0.1_f32), Brief(f32::MAX)),
            "0.1 3.4028235e38"
        );
    }
}
