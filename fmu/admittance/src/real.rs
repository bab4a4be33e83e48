//! The number that the law computes with, and its elementary functions.
//!
//! [`Real`] is `f64` in the package `admittance` and `f32` in `admittance-f32`, which compiles the same sources. The
//! functions are those of `libm`, called directly: the same digits on every platform, with and without `std`.

use nalgebra::SVector;

/// The law's number: double precision, or single precision in the packages and libraries named f32.
#[cfg(not(feature = "f32"))]
pub type Real = f64;
/// The law's number: double precision, or single precision in the packages and libraries named f32.
#[cfg(feature = "f32")]
pub type Real = f32;

/// Magnitude below which a decaying state counts as zero: squares stay above the denormal numbers.
#[cfg(not(feature = "f32"))]
pub const SMALLEST: Real = 1e-150;
/// Magnitude below which a decaying state counts as zero: squares stay above the denormal numbers.
#[cfg(feature = "f32")]
pub const SMALLEST: Real = 1e-18;

#[cfg(feature = "f32")]
pub use core::f32::consts;
#[cfg(not(feature = "f32"))]
pub use core::f64::consts;

macro_rules! functions {
    ($($(#[$about:meta])* $name:ident($($x:ident),+) -> $result:ty = $double:ident, $single:ident;)+) => {
        $(
            $(#[$about])*
            #[cfg(not(feature = "f32"))]
            #[inline]
            pub fn $name($($x: Real),+) -> $result {
                libm::$double($($x),+)
            }
            $(#[$about])*
            #[cfg(feature = "f32")]
            #[inline]
            pub fn $name($($x: Real),+) -> $result {
                libm::$single($($x),+)
            }
        )+
    };
}

functions! {
    /// |x|
    abs(x) -> Real = fabs, fabsf;
    /// √x
    sqrt(x) -> Real = sqrt, sqrtf;
    /// √(x² + y²), without overflow on the way
    hypot(x, y) -> Real = hypot, hypotf;
    /// sin x and cos x
    sin_cos(x) -> (Real, Real) = sincos, sincosf;
    /// eˣ
    exp(x) -> Real = exp, expf;
    /// eˣ − 1, exact near 0
    exp_m1(x) -> Real = expm1, expm1f;
    /// The smaller one; a NaN gives way to the other
    min(x, y) -> Real = fmin, fminf;
    /// The larger one; a NaN gives way to the other
    max(x, y) -> Real = fmax, fmaxf;
}

/// sat(x): `x` within ±`bound`; NaN stays NaN.
#[inline]
pub fn sat(x: Real, bound: Real) -> Real {
    if x > bound {
        bound
    } else if x < -bound {
        -bound
    } else {
        x
    }
}

/// `x`, but not above `bound`; what is no number is `bound`. One instruction, where [`min`] is seven: it knows which of the two
/// may be none.
#[inline]
pub fn at_most(x: Real, bound: Real) -> Real {
    if x < bound { x } else { bound }
}

/// a/b where `holds`, else 0. It divides by what `holds` allows only: a compiler may else compute the quotient in any
/// case and then choose, and a host may trap a division by 0.
#[inline]
pub fn quotient_if(holds: bool, a: Real, b: Real) -> Real {
    let b = core::hint::black_box(if holds { b } else { 1.0 });
    if holds { a / b } else { 0.0 }
}

/// Whether all numbers of `vectors` are finite: 0·x is 0 for these alone.
#[inline]
pub fn are_finite<const N: usize, const M: usize>(vectors: [&SVector<Real, N>; M]) -> bool {
    let none = vectors
        .into_iter()
        .fold(SVector::zeros(), |none, x| none + x * 0.0);
    none.iter().fold(0.0, |sum, x| sum + x) == 0.0
}

/// Zero in place of a decaying state that would otherwise reach the denormal numbers, where arithmetic is slow. It only
/// ever lowers the energy that the state holds.
#[inline]
pub fn floored(x: Real) -> Real {
    if abs(x) < SMALLEST { 0.0 } else { x }
}
