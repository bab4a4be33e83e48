//! Friction of the pad on one surface: the exact projection on the disc that Coulomb's law allows.

use nalgebra::{Matrix2, Vector2};

use crate::FLOOR;

/// A direction in which the pad's mobility has shrunk to this part of the other's has none: the joints hold it, or one that
/// arrives at its stop moves it whatever friction does. The same part of a velocity is none. Rounding leaves 1e-15; real
/// geometry stays far above.
const REDUNDANT: f64 = 1e-11;
/// The last step of Newton's iteration starts from a relative error below this: the step leaves its square.
const CLOSE: f64 = 1e-8;
/// Rounds after which the friction is taken as it is; 2 or 3 are needed.
const ROUNDS: u32 = 80;

/// A pad on one surface, in the two axes of its plane. Without friction it would move at `w`; friction t (N·s) changes that
/// and, through the pose of the arm, the normal impulse:
///
/// ```text
/// w + S t,   n − c·t
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// Mobility S (1/kg), symmetric and positive semidefinite.
    pub S: Matrix2<f64>,
    /// Velocity without friction (m/s).
    pub w: Vector2<f64>,
    /// Normal impulse without friction (N·s).
    pub n: f64,
    /// By how much friction lowers the normal impulse: c.
    pub c: Vector2<f64>,
    /// Coefficient of friction μ.
    pub mu: f64,
}

/// t(γ) = −(u + γ e)/(p + γ (r + γ z)): friction under which the pad moves at −γ t. Where p = 0, γ = 0 is no answer.
struct Answer {
    u: Vector2<f64>,
    e: Vector2<f64>,
    p: f64,
    r: f64,
    z: f64,
}

impl Slip {
    /// Friction t (N·s): it holds the pad where |t| ≤ μ n can, else it has this limit and opposes the velocity.
    ///
    /// ```text
    /// w + S t = −γ t,   γ ≥ 0,   |t| ≤ μ (n − c·t),   γ > 0 only where both sides are equal
    /// ```
    ///
    /// μ (n − c·t)/|t| rises with γ and is nearly linear in it, so that Newton's iteration for its value 1 takes two or
    /// three rounds; an interval around the root guards it.
    #[inline(always)]
    pub fn friction(&self) -> Vector2<f64> {
        let Self { S, w, n, c, mu } = self;
        let (limit, trace) = (mu * n, S.trace());
        let square = w.norm_squared();
        let speed = libm::sqrt(square);
        if limit <= FLOOR || speed <= FLOOR {
            return Vector2::zeros();
        }
        if trace <= 0.0 {
            return w * -(limit / speed);
        }
        let answer = Answer::of(S, trace, w);
        if answer.p > 0.0 {
            let held = answer.at(0.0);
            let most = mu * (n - c.dot(&held));
            if most >= 0.0 && held.norm_squared() <= most * most {
                return held;
            }
        }
        let fast = speed / limit;
        // 1/|t| for a γ far above S: (γ + wᵀ S w/|w|²)/|w|; friction opposite to w lowers its own limit.
        let most = mu * (n + c.dot(w) / fast);
        let mut gamma = if most > 0.0 { speed / most } else { fast } - w.dot(&(S * w)) / square;
        if gamma <= 0.0 {
            gamma = if answer.p > 0.0 { 0.0 } else { 0.5 * fast };
        }
        let (mut low, mut high) = (0.0, f64::INFINITY);
        for _ in 0..ROUNDS {
            let (t, slope) = answer.with_slope(gamma);
            let size = libm::sqrt(t.norm_squared());
            let most = mu * (n - c.dot(&t));
            let over = size - most;
            // over > 0, asked twice, is two masks; asked once it is a branch, of which a third would be guessed wrong.
            low = if size > most { gamma } else { low };
            high = if over > 0.0 { high } else { gamma };
            // d(most/|t|)/dγ · |t|
            let rise = -mu * c.dot(&slope) - most / size * (t.dot(&slope) / size);
            let next = gamma + if rise > 0.0 { over / rise } else { -1.0 };
            gamma = if rise > 0.0 && next > low && next <= high {
                next
            } else if high < f64::INFINITY {
                0.5 * (low + high)
            } else {
                2.0 * gamma + fast
            };
            if over.abs() <= CLOSE * size {
                break;
            }
        }
        answer.at(gamma)
    }
}

impl Answer {
    fn of(S: &Matrix2<f64>, trace: f64, w: &Vector2<f64>) -> Self {
        let det = S[(0, 0)] * S[(1, 1)] - S[(0, 1)] * S[(0, 1)];
        let u = Vector2::new(
            S[(1, 1)] * w.x - S[(0, 1)] * w.y,
            S[(0, 0)] * w.y - S[(0, 1)] * w.x,
        );
        let of_a_plane = |p| Self {
            u,
            e: *w,
            p,
            r: trace,
            z: 1.0,
        };
        let none = REDUNDANT * trace;
        if det > none * trace {
            of_a_plane(det)
        } else if u.norm_squared() > none * none * w.norm_squared() {
            of_a_plane(0.0) // w leaves the line along which friction can move the pad: nothing holds it
        } else {
            // (S + γ) t = (trace + γ) t
            Self {
                u: *w,
                e: Vector2::zeros(),
                p: trace,
                r: 1.0,
                z: 0.0,
            }
        }
    }

    fn at(&self, gamma: f64) -> Vector2<f64> {
        (self.u + self.e * gamma) / -(self.p + gamma * (self.r + gamma * self.z))
    }

    /// t and dt/dγ.
    fn with_slope(&self, gamma: f64) -> (Vector2<f64>, Vector2<f64>) {
        let inverse = 1.0 / (self.p + gamma * (self.r + gamma * self.z));
        let t = (self.u + self.e * gamma) * -inverse;
        let slope = (self.e + t * (self.r + 2.0 * gamma * self.z)) * -inverse;
        (t, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slip(S: [f64; 3], w: [f64; 2], c: [f64; 2], mu: f64) -> Slip {
        Slip {
            S: Matrix2::new(S[0], S[1], S[1], S[2]),
            w: w.into(),
            n: 2.0,
            c: c.into(),
            mu,
        }
    }

    /// How far `t` is from Coulomb's law, relative.
    fn violation(slip: &Slip, t: &Vector2<f64>) -> f64 {
        let (w, most) = (slip.w + slip.S * t, slip.mu * (slip.n - slip.c.dot(t)));
        let beyond = (t.norm() - most) / most;
        if w.norm() <= 1e-14 * slip.w.norm() {
            return beyond;
        }
        beyond.abs().max((t / most + w / w.norm()).norm())
    }

    #[test]
    fn with_equal_mobility_friction_is_the_holding_force_shortened_to_its_limit() {
        for angle in [0.0_f64, 15.0, 30.0, 45.0, 100.0, -170.0] {
            let (s, c) = angle.to_radians().sin_cos();
            for size in [0.3, 0.799_999, 0.800_001, 5.0, 1e6] {
                let t = slip(
                    [0.1, 0.0, 0.1],
                    [0.1 * size * c, 0.1 * size * s],
                    [0.0; 2],
                    0.4,
                )
                .friction();
                let expected = Vector2::new(c, s) * -size.min(0.8);
                assert!(
                    (t - expected).norm() < 1e-15 * size.max(1.0),
                    "{angle} {size} {t}"
                );
            }
        }
    }

    #[test]
    fn friction_obeys_coulombs_law_for_any_mobility_and_coupling() {
        // Condition numbers up to 1e4, slow and fast, with and without a normal that gives way.
        for (k, S) in [
            [0.1, 0.0, 0.1],
            [0.1, 0.09, 0.1],
            [1.0, -0.01, 2e-4],
            [1e-3, 0.0, 9.0],
        ]
        .into_iter()
        .enumerate()
        {
            for angle in 0..72 {
                let (sin, cos) = (f64::from(angle) * 5.0).to_radians().sin_cos();
                for size in [1e-3, 0.04, 0.3, 7.0, 1e4] {
                    for c in [[0.0, 0.0], [0.3, -0.2], [-0.5, 0.9]] {
                        let slip = slip(S, [size * cos, size * sin], c, 0.4);
                        let t = slip.friction();
                        let off = violation(&slip, &t);
                        // Roundings of w where S t cancels most of it: some 1e-16 of |w| over what is left.
                        let left = (slip.w + slip.S * t).norm() / slip.w.norm();
                        assert!(
                            off < 1e-14 + 3e-15 / left.max(1e-14),
                            "{k} {angle} {size} {c:?}: {off:e}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn along_a_line_that_the_joints_leave_friction_acts_along_it() {
        let along = Vector2::new(0.6, 0.8);
        let S = along * along.transpose() * 0.2;
        for size in [0.1, 3.0] {
            let slip = Slip {
                S,
                w: along * size,
                n: 2.0,
                c: Vector2::zeros(),
                mu: 0.4,
            };
            let expected = along * -(size / 0.2_f64).min(0.8);
            assert!((slip.friction() - expected).norm() < 1e-15, "{size}");
        }
    }

    #[test]
    fn across_that_line_a_pad_is_not_held_and_friction_still_opposes_its_velocity() {
        let (along, across) = (Vector2::new(0.6, 0.8), Vector2::new(-0.8, 0.6));
        for (S, size) in [(0.2, 0.1), (0.2, 3.0), (0.0, 3.0)] {
            let slip = Slip {
                S: along * along.transpose() * S,
                w: along * size + across * 0.01,
                n: 2.0,
                c: Vector2::zeros(),
                mu: 0.4,
            };
            let t = slip.friction();
            assert!(violation(&slip, &t) < 1e-13, "{S} {size} {t}");
            assert!((across.dot(&(slip.w + slip.S * t)) - 0.01).abs() < 1e-15);
        }
    }

    #[test]
    fn nothing_rubs_without_a_normal_a_coefficient_or_a_velocity() {
        for (n, mu, w) in [
            (0.0, 0.4, 1.0),
            (-1.0, 0.4, 1.0),
            (2.0, 0.0, 1.0),
            (2.0, 0.4, 0.0),
        ] {
            let slip = Slip {
                S: Matrix2::identity() * 0.1,
                w: Vector2::new(w, 2.0 * w),
                n,
                c: Vector2::zeros(),
                mu,
            };
            assert_eq!(slip.friction(), Vector2::zeros());
        }
    }
}
