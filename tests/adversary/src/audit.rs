//! The physical claim, from what anyone can see: energy that left by (Δq; −tau) less what came by (f_h; K v_m/alpha).
//!
//! Nothing here asks the law's own ledger: v_m is found from the nominal's equation of motion, which holds whatever limits
//! the force, M_n (2 v_m − 2 v_n)/T = f_h − D_n v_m − alpha f/K, and from the bounds.

use admittance::{Bounds, Gains, Settings};

/// A sum that keeps what rounding takes from it (Neumaier), and the sum of the terms' sizes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum {
    total: f64,
    rest: f64,
    size: f64,
}

impl Sum {
    /// Adds `term`, which was computed from numbers as large as `size`.
    pub fn add(&mut self, term: f64, size: f64) {
        let total = self.total + term;
        self.rest += if self.total.abs() >= term.abs() {
            (self.total - total) + term
        } else {
            (term - total) + self.total
        };
        self.total = total;
        self.size += size;
    }

    /// The sum.
    pub fn value(&self) -> f64 {
        self.total + self.rest
    }

    /// The sum of the sizes: times a few epsilons, how far rounding can have carried the value.
    pub fn size(&self) -> f64 {
        self.size
    }
}

/// Energy that the human's port brings in a sample, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Supply {
    /// (K/alpha) f_h v_m T.
    pub energy: f64,
    /// The same with every term of v_m taken at its size.
    pub size: f64,
}

impl Supply {
    /// Of one axis: `[hold, damping]`, `[f_h, felt, q_n, dq_n]`.
    pub fn of_axis(
        settings: &Settings,
        gains: &Gains,
        bounds: &Bounds,
        [hold, damping]: [f64; 2],
        [f_h, felt, q_n, dq_n]: [f64; 4],
    ) -> Self {
        let (T, alpha) = (settings.T, settings.alpha);
        let terms = [2.0 * gains.M_n * dq_n / T, f_h, -alpha * felt / gains.K];
        let mass = 2.0 * gains.M_n / T + gains.D_n + damping;
        let free = terms.iter().sum::<f64>() / mass;
        // The bounds: an interval for v_m that contains 0.
        let high = ((bounds.q_max - q_n) / T).min(bounds.speed).max(0.0);
        let low = ((bounds.q_min - q_n) / T).max(-bounds.speed).min(0.0);
        let v_m = if hold > 0.0 {
            0.0
        } else {
            free.max(low).min(high)
        };
        let size: f64 = terms.iter().map(|term| term.abs()).sum::<f64>() / mass;
        // q_max − q_n rounds too.
        let size = if v_m == free {
            size
        } else {
            v_m.abs() + q_n.abs() / T
        };
        let port = gains.K / alpha * f_h * T;
        Self {
            energy: port * v_m,
            size: port.abs() * size,
        }
    }

    /// Both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            energy: self.energy + other.energy,
            size: self.size + other.size,
        }
    }
}
