//! The smaller and the larger of two numbers, by one comparison.
//!
//! `f64::min` and `f64::max` look for a NaN besides, five instructions for one. Here a NaN in `a` stays: it is not hidden behind a
//! bound.

/// The smaller of `a` and `b`; `a` where they are equal.
#[inline]
pub(crate) fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The larger of `a` and `b`; `a` where they are equal.
#[inline]
pub(crate) fn most(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
