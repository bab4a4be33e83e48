//! Quotients that a host with traps on may see.

/// a/b where `holds`, else 0. It divides by what `holds` allows only: a compiler may else compute the quotient in any case
/// and then choose, and a host may trap a division by 0.
#[inline]
pub(crate) fn quotient_if(holds: bool, a: f64, b: f64) -> f64 {
    let b = core::hint::black_box(if holds { b } else { 1.0 });
    if holds { a / b } else { 0.0 }
}
