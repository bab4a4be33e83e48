//! What a number may be.

/// The numbers from `low` to `high`, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest accepted value; −∞: none.
    pub low: f64,
    /// Largest accepted value; ∞: none. Infinity itself is never accepted.
    pub high: f64,
    /// The range in words.
    pub expected: &'static str,
}

/// Smallest accepted sample period, gain, mass or limit, in SI units: what lies below is a mistake in a unit.
pub const SMALLEST: f64 = 1e-6;

/// Any finite value.
pub const FINITE: Range = Range {
    low: f64::NEG_INFINITY,
    high: f64::INFINITY,
    expected: "a finite value",
};
/// Not less than 0.
pub const NOT_NEGATIVE: Range = Range {
    low: 0.0,
    expected: "a finite value not less than 0",
    ..FINITE
};
/// Greater than 0, and not by a mistake in a unit.
pub const POSITIVE: Range = Range {
    low: SMALLEST,
    expected: "a finite value, at least 1e-6",
    ..FINITE
};
/// A factor of growth.
pub const AT_LEAST_ONE: Range = Range {
    low: 1.0,
    expected: "a finite value, at least 1",
    ..FINITE
};

impl Range {
    /// From `low` to `high`, in the words of `expected`.
    pub const fn new(low: f64, high: f64, expected: &'static str) -> Self {
        Self {
            low,
            high,
            expected,
        }
    }

    /// The same with bounds as single precision has them: what C wrote as `1e-6f` is not below 1e-6.
    #[must_use]
    pub const fn single(self) -> Self {
        Self {
            low: self.low as f32 as f64,
            high: self.high as f32 as f64,
            ..self
        }
    }

    /// Whether single precision has its bounds: each is infinite, or finite there too.
    pub const fn is_single(&self) -> bool {
        single(self.low) && single(self.high)
    }

    /// Whether `value` lies in it; NaN and infinity lie in none.
    pub const fn contains(&self, value: f64) -> bool {
        value.is_finite() && self.low <= value && value <= self.high
    }
}

const fn single(bound: f64) -> bool {
    bound.is_infinite() || (bound as f32).is_finite()
}
